; An error inside a macro's procedure, called by the library, is at the use of the macro
(define-syntax broken (er-macro-transformer (lambda (form rename compare) (error "this macro wants more of" (cdr form)))))
(define (inside)
  (let ([x 1])
    (struct 5))) ; expect error: a structure is written (struct name (field ...)), and not (struct 5)
