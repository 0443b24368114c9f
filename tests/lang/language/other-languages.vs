; Words of other languages are looked up before their operands, so that the message is about the word
(define (complaint thunk)
  (guard (e (#t (error-object-message e))) (thunk)))
(displayln (complaint (lambda () (defun f (x) x)))) ; expect: defun is not defined; write (define (name argument ...) body ...)
(displayln (complaint (lambda () (setq x 5))))      ; expect: setq is not defined; write (define x 5), or (set! x 5) to change it
(displayln (complaint (lambda () (difference a b)))) ; expect: difference is not defined; subtract is the name here: (subtract a b ...)
(define (cube x) (* x x x))
(displayln (cube 3))                                 ; expect: 27
(1 2 3) ; expect error: a gvector (vxyz 1 2 3)
