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
(show (list (vector-index-right even? #(2 4 5)) (vector-skip even? #(2 4 5)) (vector-skip-right odd? #(2 4 5)) (vector-index < #(1 2) #(0 3)))) ; expect: (1 2 1 1)
(show (list (vector-any + #(1 2) #(3)) (vector-every odd? #(1 3)) (vector-any even? #(1)) (vector-every even? #(2 3)))) ; expect: (4 #t #f #f)
(show (list (vector-fold-right cons '() #(1 2)) (vector-fold (lambda (s a b) (+ s (* a b))) 0 #(1 2) #(3 4 5)))) ; expect: (((() . 2) . 1) 11)
(show (call-with-values (lambda () (vector-partition even? #(1 2 3 4))) list)) ; expect: (#(2 4 1 3) 2)
(show (let ((v (vector 1 2 3 4))) (vector-reverse! v 1) (vector-map! - v) v)) ; expect: #(-1 -4 -3 -2)
(show (let ((v (vector 1 2 3 4))) (vector-reverse-copy! v 0 #(7 8 9) 1) v)) ; expect: #(9 8 3 4)
(show (list (vector-reverse-copy #(1 2 3) 1) (vector-append-subvectors #(1 2 3) 0 1 #(4 5) 1 2) (reverse-list->vector '(1 2)))) ; expect: (#(3 2) #(1 5) #(2 1))
(show (list (vector-unfold-right (lambda (i x) (values (cons i x) (+ x 1))) 3 0) (vector-empty? #()) (vector= = #(1) #(1 2)) (vector=  =))) ; expect: (#((0 . 2) (1 . 1) (2 . 0)) #t #f #t)
(vector-index even? '(1 2)) ; expect error: vector-index
