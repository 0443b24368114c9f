; a program may redefine any name: its own code sees it, also what was compiled before; the library does not
(define failures 0)
(define-syntax check
  (syntax-rules ()
    ((_ wanted expression)
     (let ((w wanted) (v expression))
       (unless (equal? w v)
         (set! failures (add1 failures))
         (write 'expression) (display " gave ") (write v) (display ", wanted ") (write w) (newline))))))
;; redefinition
(define (uses-car x) (car x))
(define car cdr)
(check '(2) (uses-car '(1 2)))
(check '((1) (2)) (map list '(1 2)))
(define (list . x) 'mine)
(check '(2 3) (map (lambda (x) (+ x 1)) '(1 2)))
(check 'mine (list 1 2))
(define old+ +)
(define (+ . x) (apply old+ 100 x))
(check 103 (+ 1 2))
(display failures) (newline)   ; expect: 0
