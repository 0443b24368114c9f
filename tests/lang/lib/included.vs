(define i1 1)
(define i2 2)
