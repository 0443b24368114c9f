; Several values reach whoever takes several; where one is expected, they are an error at the call that gave them
(define (said thunk) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (if (error-object? e) (error-object-message e) e))) thunk))))
(define-syntax told (syntax-rules () ((_ e) (begin (display (said (lambda () e))) (newline)))))
(define (two) (values 1 2))
(told (list (values 1 2)))                                           ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (list (values)))                                               ; expect: no value came where one is expected
(told (list (floor/ 7 2)))                                           ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (+ 1 (call/cc (lambda (k) (k 1 2)))))                          ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (let ((x (values 1 2))) (cons x x)))                           ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (list (two)))                                                  ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (list (dynamic-wind two two two)))                             ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (list (apply values '(1 2 3))))                                ; expect: 3 values came where one is expected; let-values, receive or call-with-values take several
(told (if (two) 1 2))                                                ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (map (lambda (x) (values)) '(1 2)))                            ; expect: no value came where one is expected
(told (vector-ref (vector 1 2) (two)))                               ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (list (force (delay (values 1 2)))))                           ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (list (parameterize () (values 1 2))))                         ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(told (guard (e (#t 'caught)) (list (two))))                         ; expect: caught
(define (deep n) (if (= n 0) (values 1 2) (+ 1 (deep (- n 1)))))     ; the receiver's frame lies in the heap
(told (deep 100000))                                                 ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
; what takes several
(told (begin (values 1 2) 3))                                        ; expect: 3
(told (begin (call/cc (lambda (k) (k 1 2))) 4))                      ; expect: 4
(told (begin (values) (two) 5))                                      ; expect: 5
(told (call-with-values two list))                                   ; expect: (1 2)
(told (call-with-values (lambda () (dynamic-wind list two list)) list)) ; expect: (1 2)
(told (call-with-values (lambda () (call/cc (lambda (k) (k 1 2 3)))) list)) ; expect: (1 2 3)
(told (call-with-values (lambda () (let ((x 1)) (if x (two) 5))) list))  ; expect: (1 2)
(told (receive (a . b) (two) (list a b)))                            ; expect: (1 (2))
(told (let () (define-values (a b) (two)) (list a b)))               ; expect: (1 2)
(told (let*-values (((a b) (two)) ((c) (+ a b))) (list a b c)))      ; expect: (1 2 3)
(for-each (lambda (x) (values)) '(1 2))
(define (through n) (if (= n 0) (two) (call-with-values (lambda () (through (- n 1))) values)))
(told (call-with-values (lambda () (through 10000)) list))           ; expect: (1 2)
; many registers: calls past the 240th register
(define-syntax wide (syntax-rules () ((_ e) (let ((a (list 1 2 3)) (b e)) e b))))
(told (wide (two)))                                                  ; expect: 2 values came where one is expected; let-values, receive or call-with-values take several
(define z (two)) ; expect error: 2 values came where one is expected
