(define (f a)
  (display a))
)
(define (g b)
  (f b))
(g (1.5,2]
(display 1,5)
