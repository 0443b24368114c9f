(define (grid n)
  (vector-length (make-vector (* n n) 0)))
(display (grid 10000))
