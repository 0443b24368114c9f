; (match), as it comes with the language
(import (scheme base) (scheme write) (match))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (match '(1 (2 3) 4) ((a (b ...) c) (list a b c)))) ; expect: (1 (2 3) 4)
(show (match '(circle 1 2) (('square s) s) (('circle x y) (list 'c x y)))) ; expect: (c 1 2)
(show (match 5 ((? string? s) s) ((? number? n) (* n n)))) ; expect: 25
(show (match '(a b c d) ((first rest ...) rest))) ; expect: (b c d)
(show (match-let (((a b) '(1 2))) (+ a b))) ; expect: 3
(show (match #(1 2 3) (#(a b c) (list c b a)))) ; expect: (3 2 1)
(show (match '(1 2 3) ((1 _ x) x) (_ 'other))) ; expect: 3
(show (match '((a 1) (b 2)) (((key value) ...) (list key value)))) ; expect: ((a b) (1 2))
(show (match '(x x) ((a a) 'same) (_ 'different))) ; expect: same
; patterns with a mark of repetition in the middle, twice, at least so often; improper lists
(show (match '(1 2 3 4 5) ((a ... y z) (list a y z)))) ; expect: ((1 2 3) 4 5)
(show (match '(1 2 3 . 4) ((a ... . z) (list a z)))) ; expect: ((1 2 3) 4)
(show (match '(1 2) ((a ..3) 'three) ((a ..2) a))) ; expect: (1 2)
(show (match '((a 1 2) (b 3)) (((k v ...) ...) (list k v)))) ; expect: ((a b) ((1 2) (3)))
(show (match '((1 2) (1 3)) (((a b) (a c)) (list a b c)))) ; expect: (1 2 3)
(show (match '(1 (2 #(3 4))) ((a (b #(c d))) (list a b c d)))) ; expect: (1 2 3 4)
(show (let ((ring (list 1 2))) (set-cdr! (cdr ring) ring) (match ring ((a ...) 'list) (_ 'ring)))) ; expect: ring
; combined patterns
(show (match 5 ((and (? number?) x (not 4)) (list 'n x)))) ; expect: (n 5)
(show (map (lambda (v) (match v ((or ('a x) ('b x y)) x) (_ 'none))) '((a 7) (b 8 9) (b 8)))) ; expect: (7 8 none)
(show (match '(3 4) (((= - x) y) (list x y)))) ; expect: (-3 4)
(show (match '(a 7) (`(b ,x) 1) (`(a ,x) x))) ; expect: 7
(show (match '(1 2 3) (`(,a ...) a))) ; expect: (1 2 3)
; (=> next) goes on with the next clause
(show (match 5 (x (=> next) (if (> x 3) (next) 'small)) (_ 'big))) ; expect: big
; hygiene: a pattern's names do not meet those of the expansion, nor the program's names the library's
(show (let ((if list) (value 1)) (match 1 (1 value)))) ; expect: 1
(define-syntax heads (syntax-rules () ((_ v) (match v (((a b (... ...)) (... ...)) a)))))
(show (heads '((1 2) (3)))) ; expect: (1 3)
; the other forms
(show ((match-lambda* ((a b) (+ a b))) 1 2)) ; expect: 3
(show ((match-lambda ((a b) (+ a b)) (x x)) 5)) ; expect: 5
(show (match-let loop ((n 5) ((a b) '(0 1))) (if (= n 0) a (loop (- n 1) (list b (+ a b)))))) ; expect: 5
(show (match-let* (((a b) '(1 2)) (c (+ a b))) (list a b c))) ; expect: (1 2 3)
(show (match-letrec (((ev od) (list (lambda (n) (if (= n 0) #t (od (- n 1)))) (lambda (n) (if (= n 0) #f (ev (- n 1))))))) (ev 10))) ; expect: #t
; a body is in tail position; a long list costs a step an item
(show (let loop ((n 100000)) (match n (0 'done) (n (loop (- n 1)))))) ; expect: done
(show (match (make-list 100000 1) ((a ... b) (length a)))) ; expect: 99999
(show (guard (e (#t (error-object-message e))) (match 9 (1 2)))) ; expect: "match: no pattern fits"
(match 1 ((a ... b ...) 1)) ; expect error: a list has one mark of repetition, and here are two: (b ...)
