; The built-in functions.

(define (not-converted who) (warning "~a: a parameter has the wrong type" who))
(define (wrong-count who) (warning "~a: the number of parameters is wrong" who))

(define-syntax number-functions
  (syntax-rules ()
    ((_ (name who f) ...)
     (begin (define (name . l) (cond ((not (= (length l) 1)) (wrong-count who)) ((number? (car l)) (f (car l))) (else (not-converted who)))) ...))))

; ---- angles are in degrees; multiples of 30 and 45 give exact values ----

(define degree (/ (acos -1.0) 180.0))
(define (whole-turns x) (- x (* 360.0 (floor (/ x 360.0)))))
; x from 0 to 90
(define (sine-of-quarter x)
  (cond ((= x 0.0) 0.0) ((= x 30.0) 0.5) ((= x 45.0) (sqrt 0.5)) ((= x 60.0) (/ (sqrt 3.0) 2.0)) ((= x 90.0) 1.0)
        ((> x 45.0) (cos (* (- 90.0 x) degree)))
        (else (sin (* x degree)))))
(define (sine x)
  (if (not (finite? x)) +nan.0
      (let* ((x (if (and (>= x 0.0) (< x 360.0)) x (whole-turns x))) (down (>= x 180.0)) (x (if down (- x 180.0) x)) (y (sine-of-quarter (if (> x 90.0) (- 180.0 x) x))))
        (if down (- 0.0 y) y))))
(define (cosine x) (if (finite? x) (sine (+ (whole-turns (abs x)) 90.0)) +nan.0))
(define (tangent x)
  (if (not (finite? x)) +nan.0
      (let* ((s (sine x)) (c (cosine x)))
        (cond ((= (abs s) (abs c)) (if (eq? (> s 0.0) (> c 0.0)) 1.0 -1.0))
              ((= c 0.0) (if (> s 0.0) (if (< (remainder-of (abs x) 360.0) 180.0) +inf.0 -inf.0) -inf.0))
              (else (let ((x (remainder-of x 180.0))) (exact-third (abs x) (/ s c))))))))
(define (exact-third x t)
  (cond ((= x 30.0) (if (> t 0.0) (/ (sqrt 3.0) 3.0) (/ (sqrt 3.0) -3.0))) ((= x 60.0) (if (> t 0.0) (sqrt 3.0) (- (sqrt 3.0)))) (else t)))
(define (arcsine x)
  (let ((a (abs x)))
    (cond ((not (<= a 1.0)) +nan.0)
          (else (let ((d (cond ((= a 0.5) 30.0) ((= a (sqrt 0.5)) 45.0) ((= a (/ (sqrt 3.0) 2.0)) 60.0) (else (/ (asin a) degree))))) (if (< x 0.0) (- d) d))))))
(define (arccosine x)
  (cond ((not (<= (abs x) 1.0)) +nan.0) ((= x 0.5) 60.0) ((= x -0.5) 120.0) ((= x 0.0) 90.0) ((= x 1.0) 0.0) ((= x -1.0) 180.0)
        ((= x (sqrt 0.5)) 45.0) ((= x (- (sqrt 0.5))) 135.0) (else (/ (acos x) degree))))
(define (arctangent x)
  (let* ((a (abs x)) (d (cond ((= a 1.0) 45.0) ((= a (sqrt 3.0)) 60.0) ((= a (/ (sqrt 3.0) 3.0)) 30.0) ((not (finite? a)) (if (= a a) 90.0 +nan.0)) (else (/ (atan a) degree)))))
    (if (< x 0.0) (- d) d)))
(define (arctangent-2 y x)
  (cond ((not (and (= x x) (= y y))) +nan.0)
        ((= y 0.0) (if (< x 0.0) 180.0 0.0))
        ((= x 0.0) (if (> y 0.0) 90.0 -90.0))
        (else
         (let* ((a (abs y)) (b (abs x)) (t (if (= a b) 45.0 (arctangent (/ a b)))) (t (if (< x 0.0) (- 180.0 t) t))) (if (< y 0.0) (- t) t)))))

; Halves are rounded away from zero.
(define (round-away x) (if (or (not (finite? x)) (integer? x)) x (if (< x 0.0) (- (floor (+ (- x) 0.5))) (floor (+ x 0.5)))))
(define (square-root x) (if (< x 0.0) +nan.0 (sqrt x)))
(define (logarithm x) (cond ((< x 0.0) +nan.0) ((= x 0.0) -inf.0) (else (log x))))
(define (logarithm-10 x)
  (let ((y (/ (logarithm x) (log 10.0)))) (if (and (finite? y) (= x (exact->inexact (expt 10 (exact (round y)))))) (round y) y)))
(define (sign-of x) (cond ((> x 0.0) 1.0) ((< x 0.0) -1.0) (else 0.0)))

(number-functions
  (scad:f:abs "abs" abs) (scad:f:sign "sign" sign-of) (scad:f:sin "sin" sine) (scad:f:cos "cos" cosine) (scad:f:tan "tan" tangent)
  (scad:f:asin "asin" arcsine) (scad:f:acos "acos" arccosine) (scad:f:atan "atan" arctangent) (scad:f:floor "floor" floor) (scad:f:ceil "ceil" ceiling)
  (scad:f:round "round" round-away) (scad:f:sqrt "sqrt" square-root) (scad:f:exp "exp" exp) (scad:f:ln "ln" logarithm))
(define (two-numbers who f)
  (lambda l (cond ((not (= (length l) 2)) (wrong-count who)) ((and (number? (car l)) (number? (cadr l))) (f (car l) (cadr l))) (else (not-converted who)))))
(define scad:f:atan2 (two-numbers "atan2" arctangent-2))
(define scad:f:pow (two-numbers "pow" power))
(define (scad:f:log . l)
  (cond ((and (= (length l) 1) (number? (car l))) (logarithm-10 (car l)))
        ((and (= (length l) 2) (number? (car l)) (number? (cadr l))) (/ (logarithm (cadr l)) (logarithm (car l))))
        ((<= 1 (length l) 2) (not-converted "log")) (else (wrong-count "log"))))

(define (extreme who better)
  (lambda l
    (let ((l (if (and (pair? l) (null? (cdr l)) (vector? (car l))) (vector->list (car l)) l)))
      (cond ((null? l) (wrong-count who))
            ((every number? l) (fold (lambda (x best) (if (better x best) x best)) (car l) (cdr l)))
            (else (not-converted who))))))
(define scad:f:min (extreme "min" <))
(define scad:f:max (extreme "max" >))

; ---- types ----

(define-syntax type-questions
  (syntax-rules () ((_ (name who test) ...) (begin (define (name . l) (if (= (length l) 1) (test (car l)) (wrong-count who))) ...))))
(type-questions
  (scad:f:is_undef "is_undef" (lambda (v) (eq? v undef))) (scad:f:is_num "is_num" (lambda (v) (and (number? v) (= v v)))) (scad:f:is_bool "is_bool" boolean?)
  (scad:f:is_string "is_string" string?) (scad:f:is_list "is_list" vector?) (scad:f:is_function "is_function" scad:function?))

; ---- strings and lists ----

(define (scad:f:len . l)
  (cond ((not (= (length l) 1)) (wrong-count "len"))
        ((vector? (car l)) (exact->inexact (vector-length (car l))))
        ((string? (car l)) (exact->inexact (string-length (car l))))
        (else (not-converted "len"))))
(define (scad:f:str . l) (apply string-append (map text-of l)))
(define (character v)
  (if (and (number? v) (finite? v) (>= v 1.0) (<= v 1114111.0) (not (<= 55296.0 (floor v) 57343.0))) (string (integer->char (exact (floor v)))) ""))
(define (scad:f:chr . l)
  (apply string-append
    (append-map (lambda (v) (cond ((number? v) (list (character v))) ((or (vector? v) (range? v)) (map character (reverse (scad:fold cons '() v)))) (else '()))) l)))
(define (scad:f:ord . l)
  (cond ((not (= (length l) 1)) (wrong-count "ord"))
        ((not (string? (car l))) (not-converted "ord"))
        ((string=? (car l) "") undef)
        (else (exact->inexact (char->integer (string-ref (car l) 0))))))
(define (scad:f:concat . l) (apply vector-append (map (lambda (v) (if (vector? v) v (vector v))) l)))
(define (scad:f:norm . l)
  (cond ((not (= (length l) 1)) (wrong-count "norm"))
        ((and (vector? (car l)) (numbers? (car l))) (sqrt (dot-product (car l) (car l))))
        (else (not-converted "norm"))))
(define (scad:f:cross . l)
  (define (row? v n) (and (vector? v) (= (vector-length v) n) (numbers? v)))
  (cond ((not (= (length l) 2)) (wrong-count "cross"))
        (else
         (let ((a (car l)) (b (cadr l)))
           (define (minor i j) (- (* (vector-ref a i) (vector-ref b j)) (* (vector-ref a j) (vector-ref b i))))
           (cond ((and (row? a 2) (row? b 2)) (minor 0 1))
                 ((and (row? a 3) (row? b 3)) (vector (minor 1 2) (minor 2 0) (minor 0 1)))
                 (else (not-converted "cross")))))))

; lookup interpolates between the rows [key, value] around the key.
(define (scad:f:lookup . l)
  (cond ((not (= (length l) 2)) (wrong-count "lookup"))
        ((not (number? (car l))) (not-converted "lookup"))
        ((not (vector? (cadr l))) undef)
        (else
         (let* ((key (car l)) (rows (filter (lambda (r) (and (vector? r) (>= (vector-length r) 2) (number? (vector-ref r 0)) (number? (vector-ref r 1)))) (vector->list (cadr l))))
                (k (lambda (r) (vector-ref r 0)))
                (nearest (lambda (test better) (fold (lambda (r best) (if (and (test (k r) key) (or (not best) (better (k r) (k best)))) r best)) #f rows)))
                (below (nearest <= >)) (above (nearest >= <)))
           (cond ((null? rows) undef)
                 ((not below) (vector-ref above 1))
                 ((not above) (vector-ref below 1))
                 ((= (k below) (k above)) (vector-ref below 1))
                 (else (let ((t (/ (- key (k below)) (- (k above) (k below))))) (+ (* (vector-ref below 1) (- 1.0 t)) (* (vector-ref above 1) t)))))))))

; search: the places where a value is found. count 0: all of them, as a list.
(define (scad:f:search . l)
  (if (not (<= 2 (length l) 4)) (wrong-count "search")
      (let* ((what (car l)) (where (cadr l))
             (count (if (and (> (length l) 2) (number? (caddr l))) (caddr l) 1.0)) (column (if (and (> (length l) 3) (number? (cadddr l))) (cadddr l) 0.0)))
        (cond ((number? what) (list->vector (places-of what where count column)))
              ((string? what) (if (string? where) (found-in-string what where count) (found-rows (map string (string->list what)) where count column)))
              ((vector? what) (found-rows (vector->list what) where count column))
              (else undef)))))
(define (places-of v where count column)
  (let ((n (cond ((vector? where) (vector-length where)) ((string? where) (string-length where)) (else 0))))
    (let loop ((i 0) (found '()))
      (if (or (= i n) (and (> count 0.0) (>= (length found) count))) (reverse found)
          (let ((row (scad:index where (exact->inexact i))))
            (loop (+ i 1) (if (or (and (= column 0.0) (scad:equal? row v)) (and (vector? row) (scad:equal? (scad:index row column) v))) (cons (exact->inexact i) found) found)))))))
(define (one-or-all places count)
  (cond ((= count 1.0) (if (pair? places) (car places) #f)) (else (list->vector places))))
(define (found-in-string what where count)
  (list->vector (filter values (map (lambda (c) (one-or-all (places-of (string c) where count 0.0) count)) (string->list what)))))
(define (found-rows l where count column)
  (list->vector (map (lambda (v) (or (one-or-all (if (string? where) '() (places-of v where count column)) count) (vector))) l)))

(define (scad:f:version . l) (vector 2021.0 1.0 0.0))
(define (scad:f:version_num . l) 20210100.0)

; ---- active modules: a list of names, the innermost first ----

(define active '())
(define-syntax scad:in-module
  (syntax-rules ()
    ((_ name body)
     (let ((before active))
       (set! active (cons name before))
       (let ((result body)) (set! active before) result)))))
(define (scad:f:parent_module . l)
  (let ((i (if (pair? l) (car l) 1.0)))
    (cond ((not (number? i)) (not-converted "parent_module"))
          ((or (< i 0.0) (not (< i (length active)))) (warning "parent_module: ~a modules are active" (length active)))
          (else (list-ref active (exact (floor i)))))))
(define (scad:parent-modules) (exact->inexact (length active)))
