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
