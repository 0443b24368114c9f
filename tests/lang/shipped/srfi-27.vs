; SRFI 27, as it comes with the language
(import (scheme base) (scheme write) (srfi 27))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (let loop ((i 0)) (or (= i 100) (and (<= 0 (random-integer 6) 5) (loop (+ i 1)))))) ; expect: #t
(show (< 0 (random-real) 1)) ; expect: #t
(show (let* ((s (make-random-source)) (r (random-source-make-integers s)) (state (random-source-state-ref s)) (a (list (r 1000) (r 1000)))) (random-source-state-set! s state) (equal? a (list (r 1000) (r 1000))))) ; expect: #t
(show (let ((s (make-random-source)) (t (make-random-source))) (random-source-pseudo-randomize! s 1 2) (random-source-pseudo-randomize! t 1 2) (= ((random-source-make-integers s) 100000) ((random-source-make-integers t) 100000)))) ; expect: #t
(show (random-source? default-random-source)) ; expect: #t
