; SRFI 133, as it comes with the language
(import (scheme base) (scheme write) (srfi 133))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (vector-index even? #(1 3 4))) ; expect: 2
(show (vector-fold + 0 #(1 2 3))) ; expect: 6
(show (vector-map + #(1 2) #(10 20))) ; expect: #(11 22)
(show (vector-unfold (lambda (i x) (values x (- x 1))) 4 0)) ; expect: #(0 -1 -2 -3)
(show (vector-count even? #(1 2 4))) ; expect: 2
(show (vector-binary-search #(1 3 5 7) 5 -)) ; expect: 2
(show (vector-cumulate + 0 #(1 2 3))) ; expect: #(1 3 6)
(show (vector-concatenate (list #(1) #(2 3)))) ; expect: #(1 2 3)
(show (let ((v (vector 1 2 3))) (vector-swap! v 0 2) v)) ; expect: #(3 2 1)
(show (vector= eq? #(a b) #(a b))) ; expect: #t
(show (reverse-vector->list #(1 2 3))) ; expect: (3 2 1)
