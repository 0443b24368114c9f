; Names that are near, words of other languages, forms written wrong: what the message says
(define (said thunk) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (if (error-object? e) (error-object-message e) e))) thunk))))
(define-syntax told (syntax-rules () ((_ e) (begin (display (said (lambda () (eval 'e (interaction-environment))))) (newline)))))
(told (pointx 2))              ; expect: pointx is not defined; perhaps point?
(define (point-x p) 1)
(told (pointx 2))              ; expect: pointx is not defined; did you mean point-x?
(define (box-height b) b)
(told (boxheight 1))           ; expect: boxheight is not defined; did you mean box-height?
(told (define-macro (f x) x))  ; expect: define-macro is not defined; write (define-syntax name (syntax-rules () ((_ argument ...) template)))
(told (for/first ([i 3]) i))   ; expect: for/first is not defined; write (let loop ([l list]) (cond [(null? l) #f] [(wanted? (car l)) (car l)] [else (loop (cdr l))])), or (find wanted? list)
(told (cond (> 3 2) 'big))     ; expect: a clause of cond is in parentheses with its test: ((> x 3) 'big)
(told (cond #t 1))             ; expect: a clause of cond is (test value ...), as in (cond [(> x 3) 1] [else 2]), not
(told (cond ((= 1 2) 3) else 4)) ; expect: a clause of cond is (test value ...), as in (cond [(> x 3) 1] [else 2]), not
(told (assert (= 1 2) "floors" (+ 1 2))) ; expect: assertion failed:
(told (begin (assert #t (error "never worked out")) 'holds)) ; expect: holds
