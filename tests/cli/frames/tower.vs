(define-parameter twist 0.0)
(define-parameter n 3)
(for ([i (in-range 12)])
  (draw (do-rotate (make-box (xyz -2 -2 i) (xyz 2 2 (+ i 0.9))) (xyz 0 0 0) (vxyz 0 0 1) (degrees->radians (* i twist (/ 1.0 12))))))
