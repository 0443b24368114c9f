(define (depth n)
  (+ 1 (depth n)))
(display (depth 0))
