; The same for a macro of the program's, in an expression
(define-syntax odd (er-macro-transformer (lambda (form rename compare) (map car (cdr form)))))
(define (f x)
  (list x
    (odd 5 6))) ; expect error: car: expected a pair, got 5
