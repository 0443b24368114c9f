; An error inside what a macro made points at the user's text
(define-syntax my-unless (syntax-rules () ((_ c e) (if c #f e))))
(define (f x)
  (my-unless #f (car x)))
(f 5) ; expect error 4: car
