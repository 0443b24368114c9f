(define name "tower)
(define (f x)
  (display "hello"))
(f 1)
