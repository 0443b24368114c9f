(define (f x)
  (display 'it’s')
  (display “hello”)
  (* x 2))
(f 1
