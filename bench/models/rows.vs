; The same as rows of rows: one cylinder, one row, one grid.
(define-parameter count 50)
(define (repeat o n step) (unite (map (lambda (i) (do-move o (* i step))) (iota n))))
(draw (repeat (repeat (make-cylinder (xyz 0 0 0) 2 1) count (vxyz 3 0 0)) count (vxyz 0 3 0)))
