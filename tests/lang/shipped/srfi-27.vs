; SRFI 27, as it comes with the language
(import (scheme base) (scheme write) (srfi 27))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (let loop ((i 0)) (or (= i 100) (and (<= 0 (random-integer 6) 5) (loop (+ i 1)))))) ; expect: #t
(show (< 0 (random-real) 1)) ; expect: #t
(show (let* ((s (make-random-source)) (r (random-source-make-integers s)) (state (random-source-state-ref s)) (a (list (r 1000) (r 1000)))) (random-source-state-set! s state) (equal? a (list (r 1000) (r 1000))))) ; expect: #t
(show (let ((s (make-random-source)) (t (make-random-source))) (random-source-pseudo-randomize! s 1 2) (random-source-pseudo-randomize! t 1 2) (= ((random-source-make-integers s) 100000) ((random-source-make-integers t) 100000)))) ; expect: #t
(show (random-source? default-random-source)) ; expect: #t
; sources do not disturb each other, and the default source is the generator of random
(define (draws s) (let ((r (random-source-make-integers s))) (list (r 1000000) (r 1000000))))
(show (let* ((s (make-random-source)) (t (make-random-source)) (a (draws s))) (random-integer 5) (equal? a (draws t)))) ; expect: #t
(show (let ((state (random-source-state-ref default-random-source))) (let ((a (random-integer 1000000))) (random-source-state-set! default-random-source state) (= a (random-integer 1000000))))) ; expect: #t
(show (let ((s (make-random-source)) (t (make-random-source))) (random-source-pseudo-randomize! t 2 1) (equal? (draws s) (draws t)))) ; expect: #f
(show (let ((r (random-source-make-reals (make-random-source) 1/4))) (let loop ((i 0)) (or (= i 50) (and (memv (r) '(1/4 1/2 3/4)) (loop (+ i 1))))))) ; expect: #t
(show (let ((s (make-random-source))) (random-source-randomize! s) (< 0 ((random-source-make-reals s)) 1))) ; expect: #t
(random-integer 0) ; expect error: n must be a positive exact integer
