; Solids that are handed over.
(define (repeat object n #:step [step any? (vxyz 30 0 0)])
  (unite (map (lambda (i) (do-move object (* i step))) (iota n))))
(define (drilled plate hole) (subtract plate (repeat hole 3) (do-move (repeat hole 3 #:step (vxyz 30 2 0)) (vxyz 0 30 0))))
(define row (drilled (make-box (xyz -15 -15 0) (xyz 75 50 10)) (make-cylinder (xyz 0 0 -1) 12 6)))
(draw (repeat row 2 #:step (vxyz 0 80 5)))
