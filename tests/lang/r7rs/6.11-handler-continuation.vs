; A continuation is a procedure like others, as a handler too
(displayln (call/cc (lambda (k) (with-exception-handler k (lambda () (raise 'oops))))))                ; expect: oops
(displayln (call/cc (lambda (k) (with-exception-handler k (lambda () (+ 1 (raise-continuable 'go)))))))  ; expect: go
(displayln (error-object-message (call/cc (lambda (k) (with-exception-handler k (lambda () (error "bad" 1)))))))  ; expect: bad
(displayln (error-object? (call/cc (lambda (k) (with-exception-handler k (lambda () (car 5)))))))        ; expect: #t
; leaving through it runs what is after, and the outer handler is in force again
(define said '())
(define (say x) (set! said (cons x said)))
(displayln (call/cc (lambda (outer)
  (with-exception-handler outer
    (lambda ()
      (say (call/cc (lambda (inner)
        (with-exception-handler inner
          (lambda () (dynamic-wind (lambda () (say 'in)) (lambda () (raise 'first)) (lambda () (say 'out))))))))
      (raise 'second))))))                                                                                ; expect: second
(displayln (reverse said))                                                                                ; expect: (in out first)
; a contract's predicate that fails still says no, under such a handler too
(define (small? x) (< x 10))
(define (f [x small?]) x)
(displayln (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (error-object-message e))) (lambda () (f 'text))))))  ; expect: f: x must be small?, got
(displayln (error-object? (call/cc (lambda (k) (with-exception-handler k (lambda () (f 'text)))))))      ; expect: #t
