; Assertions for the conformance suite. (check expression => datum) compares with equal?; (check-true e) and (check-error e) say the rest;
; (checked) prints how many hold, after a line for each that does not.

(define %total 0)
(define %failed 0)

(define (%report form thunk expected)
  (set! %total (- %total -1))                ; a script may redefine +
  (let ((got (call/cc (lambda (k)
                        (with-exception-handler
                         (lambda (e) (k (list 'raised (if (error-object? e) (error-object-message e) e))))
                         thunk)))))
    (if (not (equal? got expected))
        (begin
          (set! %failed (+ %failed 1))
          (display "FAILS: ") (write form)
          (display " gave ") (write got)
          (display ", not ") (write expected)
          (newline)))))

(define (%raises? thunk)
  (call/cc (lambda (k)
             (with-exception-handler (lambda (e) (k #t)) (lambda () (thunk) #f)))))

(define-syntax check
  (syntax-rules (=>)
    ((_ e => expected) (%report 'e (lambda () e) 'expected))))

(define-syntax check-true
  (syntax-rules () ((_ e) (%report 'e (lambda () (if e #t #f)) #t))))

(define-syntax check-error
  (syntax-rules () ((_ e) (%report '(error-of e) (lambda () (%raises? (lambda () e))) #t))))

(define (checked)
  (if (= %failed 0)
      (begin (display "all hold: ") (display (- %total %failed)) (newline))
      (begin (display %failed) (display " of ") (display %total) (display " fail") (newline))))
