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
(define-stream (numbers n) (stream-cons n (numbers (+ n 1))))
(show (stream->list 3 (stream-filter even? (numbers 1)))) ; expect: (2 4 6)
(show (stream->list (stream-append (stream 1) stream-null (stream 2 3)))) ; expect: (1 2 3)
(show (stream->list (stream-concat (stream (stream 1 2) (stream 3))))) ; expect: (1 2 3)
(show (map (lambda (s) (stream->list 4 s)) (list (stream-constant 1 2) (stream-range 5 0 -2) (stream-scan + 0 (stream-from 1)) (stream-drop 2 (numbers 1)) (stream-drop-while odd? (stream 1 2 3))))) ; expect: ((1 2 1 2) (5 3 1) (0 1 3 6) (3 4 5 6) (2 3))
(show (list (stream->list (stream-reverse (stream 1 2))) (stream-length (stream 1 2)) (stream->list (stream-zip (stream 1 2) (stream 'a 'b))) (stream->list (port->stream (open-input-string "ab"))))) ; expect: ((2 1) 2 ((1 a) (2 b)) (#\a #\b))
(show (stream->list (stream-unfold (lambda (x) (* x x)) (lambda (x) (< x 4)) (lambda (x) (+ x 1)) 0))) ; expect: (0 1 4 9)
(show (call-with-values (lambda () (stream-unfolds (lambda (n) (if (= n 3) (values n '() '()) (values (+ n 1) (list n) (if (odd? n) (list n) #f)))) 0)) (lambda (all odd) (list (stream->list all) (stream->list odd))))) ; expect: ((0 1 2) (1))
(show (stream->list (stream-let loop ((n 3)) (if (= n 0) stream-null (stream-cons n (loop (- n 1))))))) ; expect: (3 2 1)
(show (map (lambda (s) (stream-match s (() 'none) ((a) (> a 5) 'large) ((a) 'one) (_ 'more))) (list stream-null (stream 9) (stream 1) (stream 1 2)))) ; expect: (none large one more)
(show (stream->list (stream-of (list a b) (a in (stream 1 2)) (b is (* a 10))))) ; expect: ((1 10) (2 20))
; an element is computed once, when it is asked for; a long stream needs no stack
(define computed 0)
(define s (stream-cons (begin (set! computed (+ computed 1)) 'x) (error "the rest is not asked for")))
(show (list computed (stream-car s) (stream-car s) computed (stream-pair? s))) ; expect: (0 x x 1 #t)
(show (stream-ref (stream-filter (lambda (n) (= n 100000)) (numbers 0)) 0)) ; expect: 100000
(stream-car stream-null) ; expect error: the stream is empty
