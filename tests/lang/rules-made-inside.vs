; A scope that is made while a rule runs lies in that rule's: its path and flags go on, and two such draw their own chance
(define drawn '())
(define (note s) (set! drawn (cons (list (scope-path s) (flag? s 'wet) (random 1000000)) drawn)) s)
(define-rule (stalk [self turtle-scope?]) [(=> (note))])
(define-rule (pot [self box-scope?]) [(=> (foot) (stalk))])
(define (foot s) (make-turtle-scope (scope-corner s 0 0 0) uz ux 1 1))
(define-rule (pots [self box-scope?]) [(=> (scope-repeat 'x 1 (lambda (s) (with-flags s '(wet) pot))))])
(pots (make-box-scope origin 2 1 1))
(displayln (caar drawn)) ; expect: ((pots repeat 1) (pots flags 1) (pot make-turtle-scope 0) (pot stalk 0))
(displayln (map cadr drawn)) ; expect: (#t #t)
(displayln (= (third (car drawn)) (third (cadr drawn)))) ; expect: #f
(displayln (scope-path (foot (make-box-scope origin 2 1 1)))) ; expect: ()
