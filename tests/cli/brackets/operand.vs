(define (roof w)
  (unite
    (make-box (xyz 0 0 0) (xyz w 1 1))
    (do-move (make-sphere (xyz 0 0 0) 1 (vxyz 0 0 w))
    (make-cylinder (xyz 0 0 0) 1 w)))
(roof 3)
