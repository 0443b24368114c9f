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
(show (vector-merge < #(1 3) #(0 2 9) 0 2 0 2)) ; expect: #(0 1 2 3)
(show (let ((v (make-vector 5 'x))) (vector-merge! < v #(1 3) #(2) 1) v)) ; expect: #(x 1 2 3 x)
(show (let ((v (vector 9 3 1 2 0))) (vector-sort! < v 1 4) v)) ; expect: #(9 1 2 3 0)
(show (let* ((v (vector 1 1 2 2 3)) (n (vector-delete-neighbor-dups! = v))) (list n (vector-copy v 0 n)))) ; expect: (3 #(1 2 3))
(show (list (vector-find-median < #(4 1 3 2) #f) (vector-find-median < #() 'none) (vector-find-median < #(4 1) #f list))) ; expect: (5/2 none (1 4))
(show (let ((v (vector 5 1 3))) (list (vector-select! < v 1) (vector-sorted? < v)))) ; expect: (3 #t)
(show (list-merge (lambda (a b) (< (car a) (car b))) '((1 a)) '((0 b) (1 b)))) ; expect: ((0 b) (1 a) (1 b))
