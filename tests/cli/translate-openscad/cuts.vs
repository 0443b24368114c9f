; A ball and a box, cut by planes.
(define (cut p) (do-slice (make-sphere p 10) (make-plane p (vxyz 1 2 3))))
(draw (cut (xyz 0 0 0)))
(draw (do-slice (make-box (xyz 20 -5 -5) (xyz 30 5 5)) uz))
(draw (intersect (make-box (xyz 35 -5 -5) (xyz 45 5 5))
                 (make-half-space (make-plane (xyz 40 0 0) (xyz 41 0 0) (xyz 40 1 0.3)))))
