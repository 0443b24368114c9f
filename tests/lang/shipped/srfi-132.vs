; SRFI 132, as it comes with the language
(import (scheme base) (scheme write) (srfi 132))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (list-sort < '(3 1 2))) ; expect: (1 2 3)
(show (vector-sort < #(3 1 2))) ; expect: #(1 2 3)
(show (list-merge < '(1 3) '(2 4))) ; expect: (1 2 3 4)
(show (list-delete-neighbor-dups = '(1 1 2 3 3))) ; expect: (1 2 3)
(show (list-stable-sort (lambda (a b) (< (car a) (car b))) '((1 a) (0 b) (1 c) (0 d)))) ; expect: ((0 b) (0 d) (1 a) (1 c))
(show (vector-find-median < #(5 1 3) #f)) ; expect: 3
(show (let ((v (vector 3 1 2))) (vector-sort! < v) v)) ; expect: #(1 2 3)
(show (list-sorted? < '(1 3 2))) ; expect: #f
