; The forms and procedures from PLT Scheme that the thesis' programs use
#lang scheme
(load "../r7rs/lib/check.vs")

(check (let ([x 1] [y 2]) (+ x y)) => 3)
(check [list 1 2] => (1 2))
(check (list 1 #;(not this) 2) => (1 2))
(check (list 1 #| nor #| this |# |# 2) => (1 2))

(check (for/list ([i (in-range 5)]) (* i i)) => (0 1 4 9 16))
(check (for/list ([i (in-range 1 4)]) i) => (1 2 3))
(check (for/list ([i (in-range 10 0 -3)]) i) => (10 7 4 1))
(check (for/list ([x '(a b c)] [i (in-range 10)]) (list x i)) => ((a 0) (b 1) (c 2)))
(check (for/list ([x #(1 2 3)]) (* 10 x)) => (10 20 30))
(check (for/list ([i 3]) i) => (0 1 2))
(check (for/list ([i (in-range 10)] #:when (even? i)) i) => (0 2 4 6 8))
(check (for*/list ([i (in-range 3)] [j (in-range i)]) (list i j)) => ((1 0) (2 0) (2 1)))
(check (for*/list ([i (in-range 4)] #:when (odd? i) [j '(a b)]) (list i j)) => ((1 a) (1 b) (3 a) (3 b)))
(check (let ((sum 0)) (for ([i (in-range 5)]) (set! sum (+ sum i))) sum) => 10)
(check (let ((sum 0)) (for* ([i (in-range 3)] [j (in-range 3)]) (set! sum (+ sum (* i j)))) sum) => 9)
(check (map (lambda (f) (f)) (for/list ([i (in-range 3)]) (lambda () i))) => (0 1 2))

(check (case* 5 [string? => (lambda (s) 'string)] [number? => (lambda (n) (* 2 n))] [else 'other]) => 10)
(check (case* "s" [string? => string-length] [else 'other]) => 1)
(check (case* 'x [string? => string-length] [else 'other]) => other)
(check (case* 'x [string? => string-length] [else => (lambda (v) (list v))]) => (x))

(define-values (q r) (truncate/ 17 5))
(check (list q r) => (3 2))
(check (let-values ([(a b) (values 1 2)] [(c) (values 3)]) (list a b c)) => (1 2 3))
(check (first '(1 2)) => 1)

(check (string? (format "~a" 1)) => #t)
(check (with-output-to-string (lambda () (printf "~a-~s~n" "x" "y"))) => "x-\"y\"\n")
(check (with-output-to-string (lambda () (displayln '(1 2)))) => "(1 2)\n")

(check (exact-integer? (random 10)) => #t)
(check-true (let loop ((i 0)) (or (= i 1000) (and (<= 0 (random 7) 6) (loop (+ i 1))))))
(check-true (let ((x (random))) (and (<= 0 x) (< x 1))))
(check-true (let ((x (random 2.5))) (and (<= 0 x) (< x 2.5))))
(check-true (let ((x (random-range 3 5))) (and (<= 3 x) (<= x 5))))
(check (begin (random-seed! 7) (let ((a (list (random 1000) (random 1000)))) (random-seed! 7) (equal? a (list (random 1000) (random 1000))))) => #t)
(check-error (random 0))
(check-true (>= (current-milliseconds) 0))
(check-error (assert #f))
(check (begin (assert #t) 'ok) => ok)

; identifiers
(define 2pi-ish 6.28)
(check 2pi-ish => 6.28)
(define 1+ (lambda (x) (+ x 1)))
(check (1+ 5) => 6)
(check (let ((+x 3)) +x) => 3)
(define ângulo 5)
(check ângulo => 5)
(check (eq? 'Abc 'abc) => #f)

(checked)
; expect: all hold: 41
