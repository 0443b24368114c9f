; The values of OpenSCAD. A number is a real number, a list is a vector, undef is the symbol undef.

(define undef 'undef)
(define scad:absent (list 'absent)) ; the mark for an argument that a call does not give
(define (given v) (if (or (eq? v scad:absent) (eq? v undef)) #f v))

; from, step, to: real numbers
(define-record-type range (make-range from step to) range? (from range-from) (step range-step) (to range-to))

; names: those of the parameters; procedure takes a value or scad:absent for each
(define-record-type function-value (make-function names text procedure) scad:function?
  (names function-names) (text function-text) (procedure function-procedure))
(define (scad:function names text procedure) (make-function names text procedure))

(define (warning text . l) (warn (apply format text l)) undef)

(define (scad:real v) (if (number? v) (exact->inexact v) v))

(define (kind-of v)
  (cond ((number? v) "number") ((boolean? v) "bool") ((string? v) "string") ((vector? v) "vector") ((range? v) "range") ((scad:function? v) "function") (else "undefined")))

; ---- truth and order ----

(define (scad:true? v)
  (cond ((boolean? v) v)
        ((number? v) (not (= v 0.0)))
        ((eq? v undef) #f)
        ((string? v) (> (string-length v) 0))
        ((vector? v) (> (vector-length v) 0))
        ((range? v) (> (range-count v) 0))
        (else #t)))

(define (scad:equal? a b)
  (cond ((number? a) (and (number? b) (= a b)))
        ((string? a) (and (string? b) (string=? a b)))
        ((vector? a)
         (and (vector? b) (= (vector-length a) (vector-length b))
              (let ((n (vector-length a))) (let loop ((i 0)) (or (= i n) (and (scad:equal? (vector-ref a i) (vector-ref b i)) (loop (+ i 1))))))))
        ((range? a)
         (and (range? b) (or (and (= 0 (range-count a)) (= 0 (range-count b)))
                             (and (= (range-from a) (range-from b)) (= (range-step a) (range-step b)) (= (range-count a) (range-count b))))))
        ((scad:function? a) #f)
        (else (eq? a b))))

; Returns -1, 0 or 1, or #f if the values have no order.
(define (order a b)
  (cond ((and (number? a) (number? b)) (cond ((< a b) -1) ((> a b) 1) ((= a b) 0) (else #f)))
        ((and (string? a) (string? b)) (cond ((string<? a b) -1) ((string=? a b) 0) (else 1)))
        ((and (boolean? a) (boolean? b)) (cond ((eq? a b) 0) (a 1) (else -1)))
        ((and (boolean? a) (number? b)) (order (if a 1.0 0.0) b))
        ((and (number? a) (boolean? b)) (order a (if b 1.0 0.0)))
        ((and (vector? a) (vector? b))
         (let ((n (min (vector-length a) (vector-length b))))
           (let loop ((i 0))
             (if (= i n) (order (exact->inexact (vector-length a)) (exact->inexact (vector-length b)))
                 (let ((o (order (vector-ref a i) (vector-ref b i)))) (if (eq? o 0) (loop (+ i 1)) o))))))
        (else #f)))
(define (comparable? a b)
  (or (and (vector? a) (vector? b)) (and (string? a) (string? b)) (and (or (number? a) (boolean? a)) (or (number? b) (boolean? b)))))
(define (undefined-operation a op b) (warning "undefined operation (~a ~a ~a)" (kind-of a) op (kind-of b)))
(define (ordering op test)
  (lambda (a b) (if (comparable? a b) (let ((o (order a b))) (and o (test o))) (undefined-operation a op b))))
(define scad:less (ordering "<" (lambda (o) (< o 0))))
(define scad:more (ordering ">" (lambda (o) (> o 0))))
(define scad:less-equal (ordering "<=" (lambda (o) (<= o 0))))
(define scad:more-equal (ordering ">=" (lambda (o) (>= o 0))))

; ---- arithmetic ----

(define (vector-zip f a b) (let* ((n (min (vector-length a) (vector-length b))) (v (make-vector n undef)))
    (let loop ((i 0)) (if (< i n) (begin (vector-set! v i (f (vector-ref a i) (vector-ref b i))) (loop (+ i 1))) v))))
(define (vector-each f a) (let* ((n (vector-length a)) (v (make-vector n undef)))
    (let loop ((i 0)) (if (< i n) (begin (vector-set! v i (f (vector-ref a i))) (loop (+ i 1))) v))))

(define (scad:add a b)
  (cond ((and (number? a) (number? b)) (+ a b))
        ((and (vector? a) (vector? b)) (vector-zip scad:add a b))
        (else (undefined-operation a "+" b))))
(define (scad:subtract a b)
  (cond ((and (number? a) (number? b)) (- a b))
        ((and (vector? a) (vector? b)) (vector-zip scad:subtract a b))
        (else (undefined-operation a "-" b))))
(define (scad:negate a)
  (cond ((number? a) (- a)) ((vector? a) (vector-each scad:negate a)) (else (warning "undefined operation (-~a)" (kind-of a)))))
(define (scad:multiply a b)
  (cond ((number? a) (cond ((number? b) (* a b)) ((vector? b) (vector-each (lambda (x) (scad:multiply a x)) b)) (else (undefined-operation a "*" b))))
        ((and (vector? a) (number? b)) (vector-each (lambda (x) (scad:multiply x b)) a))
        ((and (vector? a) (vector? b)) (product a b))
        (else (undefined-operation a "*" b))))
(define (scad:divide a b)
  (cond ((number? a) (cond ((number? b) (/ a b)) ((vector? b) (vector-each (lambda (x) (scad:divide a x)) b)) (else (undefined-operation a "/" b))))
        ((and (vector? a) (number? b)) (vector-each (lambda (x) (scad:divide x b)) a))
        (else (undefined-operation a "/" b))))
; Returns the remainder of a truncated division, with the sign of a.
(define (remainder-of a b)
  (cond ((or (not (finite? a)) (= b 0.0) (not (= b b))) +nan.0)
        ((not (finite? b)) a)
        ((< (abs (/ a b)) 1e15) (let ((r (- a (* b (truncate (/ a b)))))) (if (or (>= (abs r) (abs b)) (< (* r a) 0.0)) (exact-remainder a b) r)))
        (else (exact-remainder a b))))
(define (exact-remainder a b) (let ((x (exact a)) (y (exact b))) (exact->inexact (- x (* y (truncate (/ x y)))))))
(define (scad:modulo a b) (if (and (number? a) (number? b)) (remainder-of a b) (undefined-operation a "%" b)))
(define (power a b)
  (cond ((and (< a 0.0) (not (integer? b))) (if (finite? b) +nan.0 (expt (abs a) b)))
        (else (exact->inexact (expt a b)))))
(define (scad:power a b) (if (and (number? a) (number? b)) (power a b) (undefined-operation a "^" b)))

; ---- products of vectors and matrices ----

(define (numbers? v) (let ((n (vector-length v))) (let loop ((i 0)) (or (= i n) (and (number? (vector-ref v i)) (loop (+ i 1)))))))
(define (matrix? m n) (let ((k (vector-length m)))
    (let loop ((i 0)) (or (= i k) (let ((row (vector-ref m i))) (and (vector? row) (= (vector-length row) n) (numbers? row) (loop (+ i 1))))))))
(define (columns m) (if (and (> (vector-length m) 0) (vector? (vector-ref m 0))) (vector-length (vector-ref m 0)) 0))
(define (dot-product a b) (let ((n (vector-length a))) (let loop ((i 0) (sum 0.0)) (if (= i n) sum (loop (+ i 1) (+ sum (* (vector-ref a i) (vector-ref b i))))))))
(define (column m j) (vector-each (lambda (row) (vector-ref row j)) m))
(define (vector-by-matrix v m) (let* ((n (columns m)) (out (make-vector n 0.0)))
    (let loop ((j 0)) (if (< j n) (begin (vector-set! out j (dot-product v (column m j))) (loop (+ j 1))) out))))
(define (product a b)
  (let* ((n (vector-length a)) (k (vector-length b)) (a-row (and (> n 0) (numbers? a))) (b-row (and (> k 0) (numbers? b))))
    (cond ((or (= n 0) (= k 0)) (undefined-operation a "*" b))
          ((and a-row b-row) (if (= n k) (dot-product a b) (warning "undefined operation (vector*vector): the lengths ~a and ~a differ" n k)))
          ((and a-row (= n k) (matrix? b (columns b))) (vector-by-matrix a b))
          ((and b-row (matrix? a k)) (vector-each (lambda (row) (dot-product row b)) a))
          ((and (= (columns a) k) (matrix? a k) (matrix? b (columns b))) (vector-each (lambda (row) (vector-by-matrix row b)) a))
          (else (undefined-operation a "*" b)))))

; ---- parts of values ----

; Returns the index of a real number in a row of n, or #f.
(define (index-of v n) (and (number? v) (finite? v) (> v -1.0) (< v n) (let ((i (exact (truncate v)))) (and (>= i 0) i))))
(define (scad:index v i)
  (cond ((vector? v) (let ((k (index-of i (vector-length v)))) (if k (vector-ref v k) undef)))
        ((string? v) (let ((k (index-of i (string-length v)))) (if k (string (string-ref v k)) undef)))
        ((range? v) (case (index-of i 3) ((0) (range-from v)) ((1) (range-step v)) ((2) (range-to v)) (else undef)))
        (else undef)))
(define (scad:member v name)
  (let ((k (case name ((x) 0.0) ((y) 1.0) ((z) 2.0) (else #f))))
    (cond ((and (vector? v) k) (scad:index v k))
          ((range? v) (case name ((begin) (range-from v)) ((step) (range-step v)) ((end) (range-to v)) (else undef)))
          (else undef))))

; ---- ranges and loops ----

(define (range-of from step to) (if (and (number? from) (number? step) (number? to)) (make-range from step to) undef))
(define (scad:range from to)
  (if (and (number? from) (number? to) (> from to))
      (begin (warning "the range [~a : ~a] goes down: write [~a : -1 : ~a]" (text-of from) (text-of to) (text-of from) (text-of to)) (range-of to 1.0 from))
      (range-of from 1.0 to)))
(define (scad:range-by from step to) (range-of from step to))
; Returns the number of values, an exact integer, or infinity.
(define (range-count r)
  (let ((from (range-from r)) (step (range-step r)) (to (range-to r)))
    (cond ((not (and (= from from) (= step step) (= to to))) 0)
          ((= step 0.0) (if (= from to) 1 +inf.0))
          ((if (> step 0.0) (> from to) (< from to)) 0)
          ((or (not (finite? from)) (not (finite? to)) (not (finite? step))) (if (finite? step) +inf.0 1))
          (else (let ((n (/ (- to from) step))) (+ 1 (exact (floor (+ n (* n 2.3e-16))))))))))
(define longest-range 1000000)

; Calls (f value list) for each value that a loop over v gives, beginning with `all`. Returns the last result.
(define (scad:fold f all v)
  (cond ((vector? v) (let ((n (vector-length v))) (let loop ((i 0) (all all)) (if (= i n) all (loop (+ i 1) (f (vector-ref v i) all))))))
        ((range? v)
         (let ((n (range-count v)) (from (range-from v)) (step (range-step v)))
           (if (> n longest-range) (begin (warning "this loop has more than a million turns, and was skipped") all)
               (let loop ((i 0) (all all)) (if (= i n) all (loop (+ i 1) (f (+ from (* step i)) all)))))))
        ((string? v) (let ((n (string-length v))) (let loop ((i 0) (all all)) (if (= i n) all (loop (+ i 1) (f (string (string-ref v i)) all))))))
        ((eq? v undef) all)
        (else (f v all))))
(define (scad:each v all) (if (or (vector? v) (range? v) (string? v)) (scad:fold cons all v) (if (eq? v undef) all (cons v all))))
(define (scad:each-of l all) (fold scad:each all (reverse l)))
(define (scad:vector-of l) (list->vector (reverse l)))

; ---- names ----

(define (scad:unknown kind name) (warning "unknown ~a ~a was ignored" kind name))
(define (scad:unknown-argument name) (warning "~a is no parameter here" name))
(define (scad:too-many) (warning "there are more arguments than parameters"))

; ---- special variables: a cell holds the value at this time ----

(define-record-type cell (make-cell name value) cell? (name cell-name) (value cell-value set-cell-value!))
(define cells (make-hasheq))
(define (scad:special name)
  (or (hash-ref cells name #f) (let ((c (make-cell name scad:absent))) (hash-set! cells name c) c)))
(define (scad:special-value c)
  (let ((v (cell-value c)))
    (if (eq? v scad:absent) (begin (scad:unknown "variable" (symbol->string (cell-name c))) undef) v)))
(define (scad:set-special! c v) (set-cell-value! c v))
(define (special-default! name v) (set-cell-value! (scad:special name) v))
; Gives the special variables the values with which every program begins.
(define (scad:start)
  (for-each (lambda (c) (set-cell-value! c scad:absent)) (hash-values cells))
  (for-each special-default! '($fn $fa $fs $t $preview $vpr $vpt $vpd $vpf) (list 0.0 12.0 2.0 0.0 #f (vector 0.0 0.0 0.0) (vector 0.0 0.0 0.0) 140.0 22.5)))
(define-syntax scad:with-special
  (syntax-rules ()
    ((_ c v body)
     (let* ((new v) (old (cell-value c)))
       (if (eq? new scad:absent) body
           (begin
             (set-cell-value! c new)
             (let ((result body)) (set-cell-value! c old) result)))))))

; ---- calls of values ----

; arguments: a list of (name or #f . value)
(define (scad:call f arguments)
  (if (not (scad:function? f)) (warning "~a is no function" (kind-of f))
      (let* ((names (function-names f)) (values (make-vector (length names) scad:absent)))
        (define (place name) (let loop ((l names) (i 0)) (cond ((null? l) #f) ((eq? (car l) name) i) (else (loop (cdr l) (+ i 1))))))
        (let loop ((l arguments) (next 0))
          (if (null? l) (apply (function-procedure f) (vector->list values))
              (let ((i (if (caar l) (place (caar l)) next)))
                (if (and i (< i (vector-length values))) (vector-set! values i (cdar l))
                    (if (caar l) (scad:unknown-argument (symbol->string (caar l))) (scad:too-many)))
                (loop (cdr l) (if (caar l) next (+ next 1)))))))))
