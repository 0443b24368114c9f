; R7RS 6.10: map and for-each, whose calls have no frame of their own: left and entered again at every element, in any order
(load "lib/check.vs")

(define (same x) x)
(define numbers (iota 40))

; map gives a new list each time it returns, and changes none that it gave before
(define (again-at l at times)
  (let ((k #f) (count 0) (seen '()))
    (let ((r (map (lambda (x) (call/cc (lambda (here) (if (= x at) (set! k here)) x))) l)))
      (set! seen (cons r seen))
      (set! count (+ count 1))
      (if (<= count times) (k (* 100 count)) (reverse seen)))))
(check (again-at '(1 2 3) 1 2) => ((1 2 3) (100 2 3) (200 2 3)))
(check (again-at '(1 2 3) 2 2) => ((1 2 3) (1 100 3) (1 200 3)))
(check (again-at '(1 2 3) 3 2) => ((1 2 3) (1 2 100) (1 2 200)))
(check (again-at '(1) 1 1) => ((1) (100)))
(check (list-tail (cadr (again-at numbers 35 1)) 34) => (34 100 36 37 38 39))
(check (list-tail (car (again-at numbers 35 1)) 34) => (34 35 36 37 38 39))

; a continuation made at one element only, and entered when the others are done
(check (let* ((k #f) (first #t)
              (r (map (lambda (x) (if (= x 2) (call/cc (lambda (here) (set! k here) x)) (* 10 x))) '(1 2 3 4))))
         (if first (begin (set! first #f) (k r)) r)) => (10 (10 2 30 40) 30 40))

; one made before map began is none of map's
(check (let* ((n 0) (k (call/cc (lambda (k) k))) (r (map same '(1 2 3))))
         (set! n (+ n 1))
         (if (< n 3) (k k) (list n r))) => (3 (1 2 3)))

; out of it, and several maps inside each other
(check (call/cc (lambda (out) (map (lambda (x) (if (> x 3) (out (list 'out x)) x)) numbers))) => (out 4))
(check (map (lambda (x) (map (lambda (y) (map (lambda (z) (list x y z)) '(5 6))) '(3 4))) '(1 2)) =>
  ((((1 3 5) (1 3 6)) ((1 4 5) (1 4 6))) (((2 3 5) (2 3 6)) ((2 4 5) (2 4 6)))))
(define (tree-map f t) (map (lambda (e) (if (list? e) (tree-map f e) (f e))) t))
(check (tree-map (lambda (x) (* x x)) '(1 (2 (3 () 4)) 5)) => (1 (4 (9 () 16)) 25))

; a generator: the two sides enter each other's loops by turns
(define (generator l)
  (define return #f)
  (define (next) (for-each (lambda (x) (call/cc (lambda (go-on) (set! next (lambda () (go-on #f))) (return x)))) l) (return 'end))
  (lambda () (call/cc (lambda (r) (set! return r) (next)))))
(check (let ((g (generator '(a b c)))) (map (lambda (i) (g)) '(1 2 3 4))) => (a b c end))

; what ends with a call of another procedure, with a native or with a continuation, gives that one's value
(check (map (lambda (x) (same (+ x 1))) '(1 2 3)) => (2 3 4))
(check (map (lambda (x) (if (odd? x) (abs x) (apply - (list x)))) '(-1 2 -3 4)) => (1 -2 3 -4))
(check (map (lambda (x) (call/cc (lambda (k) (k x)))) '(1 2 3)) => (1 2 3))
(define (down n) (if (= n 0) 'down (down (- n 1))))
(check (map down '(3 2 1)) => (down down down))
(define (recur f) (lambda (x) (if (> x 9) x ((recur f) (* 2 x)))))
(check (map (recur same) '(1 2 3)) => (16 16 12))

; procedures of every kind
(define-record-type spot (make-spot at) spot? (at spot-at set-spot-at!))
(define three (map make-spot '(1 2 3)))
(check (map spot-at three) => (1 2 3))
(check (map spot? three) => (#t #t #t))
(for-each (lambda (s) (set-spot-at! s (* 2 (spot-at s)))) three)
(check (map spot-at three) => (2 4 6))
(check (map car '((1 2) (3 4))) => (1 3))
(check (map (case-lambda ((a b) 'two) ((a) (list a))) '(1 2)) => ((1) (2)))
(define (with-default a [b number? 5]) (+ a b))
(check (map with-default '(1 2)) => (6 7))
(check (map (lambda all all) '(1 2)) => ((1) (2)))
(check (map (lambda (x) x) '()) => ())
(check (map same (list #f '())) => (#f ()))
(check-error (map spot-at '(1)))
(check-error (map same 5))
(check-error (map same '(1 . 2)))
(check-error (let ((l (list 1 2))) (set-cdr! (cdr l) l) (map same l)))
(check-error (map 5 '()))
(check-error (map same))
(check-error (map (lambda (a b) a) '(1)))
(check-error (for-each 'display '(1)))

; the list may be changed meanwhile: what comes next was looked at before the call
(check (let ((l (list 1 2 3))) (map (lambda (x) (set-cdr! l '()) x) l)) => (1 2 3))

; long lists, and more memory than one collection leaves alone
(define (sum l) (fold + 0 l))
(check (sum (map (lambda (x) (length (map list (list x x x)))) (iota 20000))) => 60000)
(check (sum (map (lambda (x) (vector-length (make-vector 100 x))) (iota 20000))) => 2000000)
(check (let ((n 0)) (for-each (lambda (x) (set! n (+ n (length (iota 50))))) (iota 20000)) n) => 1000000)
(check (let ((k #f) (n 0))
         (let ((r (map (lambda (x) (call/cc (lambda (here) (if (= x 700) (set! k here)) x))) (iota 1000))))
           (set! n (+ n 1))
           (if (< n 3) (k 1) (sum r)))) => 498801)
; so deep that the frames below lie in the heap
(define (deep n) (if (= n 0) (map same '(1 2 3)) (map (lambda (x) (car (deep (- n 1)))) '(1))))
(check (deep 30000) => (1))

; raised in one element and handled outside, or handled where it was raised
(check (guard (e (#t (list 'caught e))) (map (lambda (x) (if (= x 2) (raise 'two) x)) '(1 2 3))) => (caught two))
(check (with-exception-handler (lambda (e) 7) (lambda () (map (lambda (x) (if (= x 2) (raise-continuable 'two) x)) '(1 2 3)))) => (1 7 3))
(check (let ((path '()))
         (map (lambda (x) (dynamic-wind (lambda () (set! path (cons 'in path))) (lambda () x) (lambda () (set! path (cons x path))))) '(1 2))
         path) => (2 in 1 in))

(check (list (list? '(1 2)) (list? '(1 . 2)) (list? 5) (list? '()) (list? numbers) (list? (cons 1 numbers)) (list? (append numbers 5))) =>
  (#t #f #f #t #t #t #f))
(check (let ((l (list 1 2 3))) (set-cdr! (cddr l) l) (list? l)) => #f)

(checked)
; expect: all hold: 45
