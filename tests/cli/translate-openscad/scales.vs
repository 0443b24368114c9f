; a scale by three factors: in place, about a point, through a procedure
(define (stretched o factors) (do-scale o origin factors))
(draw (stretched (make-box (xyz -1 -1 -1) 2 2 2) '(1.6 1.6 3)))
(draw (do-scale (make-box (xy 5 0) 1 1 1) (xy 5 0) (list 2 1 1/2)))
(draw (do-scale (make-box (xy -5 0) 1 1 1) (xy -5 0) 2))
