; SRFI 41, as it comes with the language
(import (scheme base) (scheme write) (srfi 41))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (stream->list 5 (stream-from 1))) ; expect: (1 2 3 4 5)
(show (stream->list (stream-map + (stream 1 2) (stream 10 20)))) ; expect: (11 22)
(show (stream-match (stream 1 2 3) ((a _ . r) (list a (stream->list r))))) ; expect: (1 (3))
(show (stream-ref (stream-iterate (lambda (x) (* 2 x)) 1) 10)) ; expect: 1024
(show (stream->list (stream-of (* x x) (x in (stream-range 0 10)) (even? x)))) ; expect: (0 4 16 36 64)
(show (stream-fold + 0 (stream-range 0 11))) ; expect: 55
(show (stream->list (stream-take-while (lambda (x) (< x 3)) (stream-from 0)))) ; expect: (0 1 2)
