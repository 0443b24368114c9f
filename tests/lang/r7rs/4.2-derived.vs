; R7RS 4.2: derived expressions
(load "lib/check.vs")

; -- cond --
(check (cond ((> 3 2) 'greater) ((< 3 2) 'less)) => greater)
(check (cond ((> 3 3) 'greater) ((< 3 3) 'less) (else 'equal)) => equal)
(check (cond ((assv 'b '((a 1) (b 2))) => cadr) (else #f)) => 2)
(check (cond (#f 1) (2)) => 2)
(check (cond ((memv 2 '(1 2 3))) (else 'no)) => (2 3))
(check (cond (#t 1 2 3)) => 3)

; -- case --
(check (case (* 2 3) ((2 3 5 7) 'prime) ((1 4 6 8 9) 'composite)) => composite)
(check (case (car '(c d)) ((a e i o u) 'vowel) ((w y) 'semivowel) (else => (lambda (x) x))) => c)
(check (case 'a ((a) => (lambda (x) (list x 'found))) (else 'no)) => (a found))
(check (case "a" (("a") 'same) (else 'other)) => other)
(check (case 2.0 ((2) 'exact) ((2.0) 'inexact) (else 'none)) => inexact)
(check (case #\x ((#\x #\y) 1) (else 2)) => 1)
(check (case 100000000000000000000 ((100000000000000000000) 'big) (else 'no)) => big)
(check (case 1 (else 'only)) => only)

; -- and or when unless --
(check (and (= 2 2) (> 2 1)) => #t)
(check (and (= 2 2) (< 2 1)) => #f)
(check (and 1 2 'c '(f g)) => (f g))
(check (and) => #t)
(check (or (= 2 2) (> 2 1)) => #t)
(check (or (= 2 2) (< 2 1)) => #t)
(check (or #f #f #f) => #f)
(check (or (memq 'b '(a b c)) (/ 3 0)) => (b c))
(check (or) => #f)
(check (when (> 1 0) 1 2 3) => 3)
(check (unless (< 1 0) 1 2 3) => 3)

; -- cond-expand --
(check (cond-expand (no-such-feature 1) (else 2)) => 2)
(check (cond-expand (r7rs 1) (else 2)) => 1)
(check (cond-expand ((and r7rs (not no-such)) 'yes) (else 'no)) => yes)
(check (cond-expand ((or no-such r7rs) 'yes) (else 'no)) => yes)
(check (cond-expand ((library (scheme base)) 'yes) (else 'no)) => yes)
(check (cond-expand ((library (no such library)) 'yes) (else 'no)) => no)

; -- let and its kin --
(check (let ((x 2) (y 3)) (* x y)) => 6)
(check (let ((x 2) (y 3)) (let ((x 7) (z (+ x y))) (* z x))) => 35)
(check (let ((x 2) (y 3)) (let* ((x 7) (z (+ x y))) (* z x))) => 70)
(check (let* () 5) => 5)
(check (let* ((x 1) (x (+ x 1))) x) => 2)
(check (letrec ((even? (lambda (n) (if (zero? n) #t (odd? (- n 1)))))
                (odd? (lambda (n) (if (zero? n) #f (even? (- n 1))))))
         (even? 88)) => #t)
(check (letrec* ((p (lambda (x) (+ 1 (q (- x 1)))))
                 (q (lambda (y) (if (zero? y) 0 (+ 1 (p (- y 1))))))
                 (x (p 5))
                 (y x))
         y) => 5)
(check-error (letrec ((a b) (b 1)) a))
(check (let-values (((root rem) (exact-integer-sqrt 32))) (* root rem)) => 35)
(check (let ((a 'a) (b 'b) (x 'x) (y 'y))
         (let*-values (((a b) (values x y)) ((x y) (values a b))) (list a b x y))) => (x y x y))
(check (let ((a 'a) (b 'b) (x 'x) (y 'y))
         (let-values (((a b) (values x y)) ((x y) (values a b))) (list a b x y))) => (x y a b))
(check (let-values (((a . rest) (values 1 2 3)) (all (values 4 5))) (list a rest all)) => (1 (2 3) (4 5)))
(check-error (let-values (((a b) (values 1 2 3))) a))

; -- begin --
(define x 0)
(check (and (= x 0) (begin (set! x 5) (+ x 1))) => 6)
(check x => 5)

; -- iteration --
(check (do ((vec (make-vector 5)) (i 0 (+ i 1))) ((= i 5) vec) (vector-set! vec i i)) => #(0 1 2 3 4))
(check (let ((x '(1 3 5 7 9))) (do ((x x (cdr x)) (sum 0 (+ sum (car x)))) ((null? x) sum))) => 25)
(check (let loop ((numbers '(3 -2 1 6 -5)) (nonneg '()) (neg '()))
         (cond ((null? numbers) (list nonneg neg))
               ((>= (car numbers) 0) (loop (cdr numbers) (cons (car numbers) nonneg) neg))
               ((< (car numbers) 0) (loop (cdr numbers) nonneg (cons (car numbers) neg))))) => ((6 1 3) (-5 -2)))
; a loop variable that a closure captures is fresh each turn
(check (map (lambda (f) (f)) (do ((i 0 (+ i 1)) (fs '() (cons (lambda () i) fs))) ((= i 3) fs))) => (2 1 0))
(check (map (lambda (f) (f)) (let loop ((i 0) (fs '())) (if (= i 3) fs (loop (+ i 1) (cons (lambda () i) fs))))) => (2 1 0))
; a named let's procedure as a value
(check (let loop ((i 3)) (if (= i 0) '() (cons i (map loop '(0))))) => (3 ()))
(check (let f ((n 5)) (if (= n 0) 1 (* n (f (- n 1))))) => 120)

; -- delayed evaluation --
(check (force (delay (+ 1 2))) => 3)
(check (let ((p (delay (+ 1 2)))) (list (force p) (force p))) => (3 3))
(define integers (letrec ((next (lambda (n) (delay (cons n (next (+ n 1))))))) (next 0)))
(define (head stream) (car (force stream)))
(define (tail stream) (cdr (force stream)))
(check (head (tail (tail integers))) => 2)
(define (stream-filter p? s)
  (delay-force
   (if (null? (force s))
       (delay '())
       (let ((h (car (force s))) (t (cdr (force s))))
         (if (p? h) (delay (cons h (stream-filter p? t))) (stream-filter p? t))))))
(check (head (tail (tail (stream-filter odd? integers)))) => 5)
(define count 0)
(define p (delay (begin (set! count (+ count 1)) (if (> count x) count (force p)))))
(define x 5)
(check-true (promise? p))
(check (force p) => 6)
(check (begin (set! x 10) (force p)) => 6)
(check (force 7) => 7)
(check (force (make-promise 7)) => 7)
(check (promise? (make-promise (make-promise 1))) => #t)
(check (force (make-promise (make-promise 1))) => 1)
(check (let loop ((n 100000) (s (delay-force (let f ((n 100000)) (if (= n 0) (delay 'done) (delay-force (f (- n 1)))))))) (force s)) => done)

; -- parameters --
(define radix (make-parameter 10 (lambda (x) (if (and (exact-integer? x) (<= 2 x 16)) x (error "invalid radix")))))
(define (f n) (number->string n (radix)))
(check (f 12) => "12")
(check (parameterize ((radix 2)) (f 12)) => "1100")
(check (f 12) => "12")
(check-error (parameterize ((radix 0)) (f 12)))
(define plain (make-parameter 1))
(check (parameterize ((plain 2)) (list (plain) (parameterize ((plain 3)) (plain)) (plain))) => (2 3 2))
(check (let ((k #f)) (parameterize ((plain 5)) (call/cc (lambda (out) (out 0)))) (plain)) => 1)
(check (parameterize () 7) => 7)

; -- guard: see 6.11 --

; -- quasiquotation --
(check `(list ,(+ 1 2) 4) => (list 3 4))
(check (let ((name 'a)) `(list ,name ',name)) => (list a (quote a)))
(check `(a ,(+ 1 2) ,@(map abs '(4 -5 6)) b) => (a 3 4 5 6 b))
(check `((foo ,(- 10 3)) ,@(cdr '(c)) . ,(car '(cons))) => ((foo 7) . cons))
(check `#(10 5 ,(sqrt 4) ,@(map sqrt '(16 9)) 8) => #(10 5 2 4 3 8))
(check (let ((foo '(foo bar)) (@baz 'baz)) `(list ,@foo , @baz)) => (list foo bar baz))
(check `(a `(b ,(c ,(+ 1 2)))) => (a `(b ,(c 3))))
(check `(a `(b ,(foo ,(+ 1 3) d) e) f) => (a `(b ,(foo 4 d) e) f))
(check (let ((name1 'x) (name2 'y)) `(a `(b ,,name1 ,',name2 d) e)) => (a `(b ,x ,'y d) e))
(check (quasiquote (list (unquote (+ 1 2)) 4)) => (list 3 4))
(check '(quasiquote (list (unquote (+ 1 2)) 4)) => `(list ,(+ 1 2) 4))
(check `(1 . ,(+ 1 1)) => (1 . 2))
(check `(1 ,@'() . 2) => (1 . 2))

; -- case-lambda --
(define range*
  (case-lambda ((e) (range* 0 e)) ((b e) (do ((r '() (cons e r)) (e (- e 1) (- e 1))) ((< e b) r)))))
(check (range* 3) => (0 1 2))
(check (range* 3 5) => (3 4))
(check-error (range* 1 2 3))
(define plus (case-lambda (() 0) ((x) x) ((x y) (+ x y)) ((x y . z) (apply + x y z))))
(check (list (plus) (plus 1) (plus 1 2) (plus 1 2 3 4)) => (0 1 3 10))

; letrec: the names get their values when all are there, in one place each, whatever continuation of a value is entered again
(check (let ((cont #f))
         (letrec ((x (call/cc (lambda (c) (set! cont c) 0))) (y (call/cc (lambda (c) (set! cont c) 0))))
           (if cont (let ((c cont)) (set! cont #f) (set! x 1) (set! y 1) (c 0)) (+ x y)))) => 0)
(check (letrec ((x (call/cc list)) (y (call/cc list)))
         (cond ((procedure? x) (x (pair? y))) ((procedure? y) (y (pair? x))))
         (let ((x (car x)) (y (car y))) (and (call/cc x) (call/cc y) (call/cc x)))) => #t)
(check (letrec ((x (call/cc (lambda (c) (list #t c))))) (if (car x) ((cadr x) (list #f (lambda () x))) (eq? x ((cadr x))))) => #t)
(check (letrec ((z (even-one? 10)) (even-one? (lambda (n) (or (= n 0) (odd-one? (- n 1))))) (odd-one? (lambda (n) (and (> n 0) (even-one? (- n 1)))))) z) => #t)
(check (letrec ((y 2) (x (+ y 1)) (w (list 'w)) (f (lambda () (list w x y)))) (f)) => ((w) 3 2))
(check-error (letrec ((a (list 1)) (b (car a))) b))
(check (letrec* ((a (list 1)) (b (car a))) b) => 1)

(checked)
; expect: all hold: 96
