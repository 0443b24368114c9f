; Calls that are single instructions: records, vectors, lists, gvectors. Same values and messages as the procedures, also when redefined
(define (said thunk) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (if (error-object? e) (error-object-message e) e))) thunk))))
(define-syntax told (syntax-rules () ((_ e) (begin (write (said (lambda () e))) (newline)))))
(define-record-type spot (make-spot x y) spot? (x spot-x set-spot-x!) (y spot-y) (z spot-z set-spot-z!))
(define-record-type other (make-other x) other? (x other-x))
(define s (make-spot 1 2))
(told (list (spot-x s) (spot-y s) (spot-z s) (spot? s) (spot? 5) (spot? (make-other 1)) (other? s)))  ; expect: (1 2 #f #t #f #f #f)
(told (begin (set-spot-x! s 'new) (set-spot-z! s s) (list (spot-x s) (eq? s (spot-z s)))))            ; expect: (new #t)
(told (spot-x (make-other 1)))                     ; expect: "spot-x: expected a spot, got"
(told (set-spot-x! 'oak 1))                        ; expect: "set-spot-x!: expected a spot, got"
(told (if (set-spot-x! s 3) 'unspecific 'false))   ; expect: unspecific
(told (map spot-x (list s s)))                     ; expect: (3 3)
(define (in-a-body n) (define-record-type inner (make-inner v) inner? (v inner-v)) (list (inner-v (make-inner n)) (inner? s)))
(told (in-a-body 7))                               ; expect: (7 #f)
; gvectors: as by apply, which calls the procedure itself
(define a (vxyz 1 2.5 -3)) (define b (vxyz 0.5 1e10 2)) (define p (xyz 1 2 3)) (define q (xyz -4 0 9))
(define-syntax same (syntax-rules () ((_ f x y) (let ([v (f x y)] [w (apply f (list x y))]) (if (equal? v w) v (list 'differ v w))))))
(told (same v+v a b))                              ; expect: (vxyz 1.5 10000000002.5 -1)
(told (same v-v a b))                              ; expect: (vxyz 0.5 -9999999997.5 -5)
(told (same p+v p a))                              ; expect: (xyz 2 4.5 0)
(told (same p-v p a))                              ; expect: (xyz 0 -0.5 6)
(told (same p-p p q))                              ; expect: (vxyz 5 2 -6)
(told (same p->q p q))                             ; expect: (vxyz -5 -2 6)
(told (same v*r a 2))                              ; expect: (vxyz 2 5 -6)
(told (same v/r a 1/2))                            ; expect: (vxyz 2 5 -6)
(told (same dot a b))                              ; expect: 24999999994.5
(told (same cross (vxyz 1 0 0) (vxyz 0 1 0)))      ; expect: (vxyz 0 0 1)
(told (same distance p q))                         ; expect: 8.06225774829855
(told (list (vlength (vxyz 3 4 0)) (vlength (vxyz 1e200 0 1e200)) (vlength (vxyz 3e-200 4e-200 0)) (vlength (vxyz 0 0 0)) (vlength (vxyz 1 2 3))))
; expect: (5.0 1.414213562373095e200 5e-200 0.0 3.7416573867739413)
(told (v+v))                                       ; expect: (vxyz 0 0 0)
(told (v+v a b a))                                 ; expect: (vxyz 2.5 10000000005 -4)
(told (v/r a 0))                                   ; expect: "v/r: r must be other than 0, got"
(told (dot a p))                                   ; expect: "dot: b must be a gvector ((vxyz 1 2 3)?), got"
(told (p+v a a))                                   ; expect: "p+v: p must be a point ((xyz 1 2.5 -3)?), got"
(told (vlength 5))                                 ; expect: "vlength: v must be a gvector, got"
; many, through collections
(define (churn n)
  (let loop ([i 0] [sum 0])
    (if (= i n) sum
        (let* ([v (vector i (list i 1) (make-spot i 2))] [w (v+v (vxyz i 0 0) (vxyz 1 1 1))])
          (loop (+ i 1) (+ sum (vector-ref v 0) (cadr (vector-ref v 1)) (spot-y (vector-ref v 2)) (cz w)))))))
(told (churn 300000))                              ; expect: 45001050000.0
(told (let ([v (vector)]) (list (vector-length v) (list) (vector 1) (list 1) (vector 'a "b" 3)))) ; expect: (0 () #(1) (1) #(a "b" 3))
; map over short lists: order, ends, and a continuation that comes back
(told (let ([seen '()]) (list (map (lambda (x) (set! seen (cons x seen)) (* x x)) '(1 2 3)) seen))) ; expect: ((1 4 9) (3 2 1))
(told (map (lambda (l) (map - l)) '(() (1) (1 2) (1 2 3) (1 2 3 4) (1 2 3 4 5)))) ; expect: (() (-1) (-1 -2) (-1 -2 -3) (-1 -2 -3 -4) (-1 -2 -3 -4 -5))
(told (map - '(1 . 2)))                            ; expect: "map: expected a list, got"
(told (map - '(1 2 3 . 4)))                        ; expect: "map: expected a list, got"
(told (let ([l (list 1 2)]) (set-cdr! (cdr l) l) (map - l))) ; expect: "map: expected a list that ends, got"
(told (map 5 '()))                                 ; expect: "map: f must be a procedure, got 5"
(define k #f) (define turns 0)
(told (let ([r (map (lambda (x) (call/cc (lambda (c) (if (= x 2) (set! k c)) x))) '(1 2 3))])
  (set! turns (+ turns 1))
  (if (< turns 3) (k (* 10 turns)) (list turns r))))   ; expect: (3 (1 20 3))
; redefined: the program's own procedures, in code that was compiled before
(define (makes) (list (vector 1 2) (vlength a) (dot a a) (map (lambda (x) x) '(1))))
(told (makes))                                     ; expect: (#(1 2) 4.031128874149275 16.25 (1))
(define (vector . l) (cons 'vector l))
(define (vlength v) 'long)
(define (dot a b) 'dotted)
(told (makes))                                     ; expect: ((vector 1 2) long dotted (1))
(define (list . l) (length l))
(told (makes))                                     ; expect: 4
