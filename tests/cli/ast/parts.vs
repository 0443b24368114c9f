(define (column foot) ; stands on foot
  (make-cylinder foot height 0.3))
(define height 4)
