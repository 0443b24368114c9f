; Regions with holes, and an island in a hole.
(define (frame w h t)
  (make-region (make-rectangle (xyz 0 0 1) (xyz w h 1))
               (make-rectangle (xyz t t 1) (xyz (- w t) (- h t) 1))))
(draw (do-extrude (frame 8 5 0.5) 0.2))
(define washer (make-donut (xyz 15 3 0) 1 2))
(draw (do-extrude washer -0.75))
(draw (do-extrude (make-region (make-circle (xyz 4 2.5 0) 0.5) (make-circle (xyz 4 2.5 0) 4) (make-circle (xyz 4 2.5 0) 2)
                               (make-regular-polygon (xyz 20 20 0) 3 5)) 0.9))
