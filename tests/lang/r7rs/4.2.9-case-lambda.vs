; R7RS 4.1.7 and 4.2.9: include-ci; case-lambda, whose clauses may have contracts here
(load "lib/check.vs")

(define range (case-lambda ((e) (range 0 e)) ((b e) (do ((r '() (cons e r)) (e (- e 1) (- e 1))) ((< e b) r)))))
(check (range 3) => (0 1 2))
(check (range 3 5) => (3 4))
(define counted (case-lambda (() 0) ((a) 1) ((a . more) (list a more)) (all all)))
(check (counted) => 0)
(check (counted 'x) => 1)
(check (counted 1 2 3) => (1 (2 3)))
(define area (case-lambda (([r number?]) (* r r)) (([a number?] [b symbol?]) (list a b))))
(check (area 3) => 9)
(check (area 3 'four) => (3 four))
(check-error (area 'x))
(check-error (area 1 2))
(check-error (area))
(check-error (area 1 2 3))

(include-ci "lib/shouting.vs")
(check (quiet-sum 1 2) => 3)
(check quiet-word => loud)
(check said => "As It Is")
(check 'Case => Case)
(check (eq? 'Case 'case) => #f)
(define-library (loud) (export quiet-sum) (import (scheme base)) (include-ci "lib/shouting.vs"))
(import (prefix (loud) l:))
(check (l:quiet-sum 2 3) => 5)

(checked) ; expect: all hold: 17
