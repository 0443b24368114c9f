; The interface of scripts to the language: the conversion of values, and the libraries GEO, GUI, IO, MATH and UTL.
; Points and vectors of a script are arrays of two or three numbers.

(define (not-defined name) (reference-error name " is not defined"))

; ---- values for the language ----

(define (coordinates who v)
  (let ((l (if (numerous? v) (argument-list v) '())))
    (if (not (and (memv (length l) '(2 3)) (every-number? l)))
        (type-error who ": a point or vector is an array of two or three numbers, not " (to-string v)))
    l))
(define (every-number? l) (or (null? l) (and (flonum? (car l)) (every-number? (cdr l)))))
(define (numerous? v) (or (array? v) (sequence? v)))
(define (to-point who v)
  (if (and (numerous? v) (not (point? v))) (let ((l (coordinates who v))) (xyz (car l) (cadr l) (if (pair? (cddr l)) (caddr l) 0))) v))
(define (to-vector who v)
  (if (and (numerous? v) (not (gvector? v))) (let ((l (coordinates who v))) (vxyz (car l) (cadr l) (if (pair? (cddr l)) (caddr l) 0))) v))
(define (points who v)
  (if (or (not (numerous? v)) (place? v)) (type-error who ": an array of points is wanted, not " (to-string v)))
  (map (lambda (p) (to-point who p)) (argument-list v)))
(define (from-point p) (array (inexact (cx p)) (inexact (cy p)) (inexact (cz p))))

(define (flat values)   ; objects, and arrays of them
  (cond ((null? values) '())
        ((numerous? (car values)) (append (flat (argument-list (car values))) (flat (cdr values))))
        (else (cons (car values) (flat (cdr values))))))

; ---- GEO ----

(define geo_box (fn this (p q) (make-box (to-point "geo_box" p) (to-point "geo_box" q))))
(define geo_sphere (fn this (c r) (make-sphere (to-point "geo_sphere" c) r)))
(define geo_cylinder (fn this (a b r) (make-cylinder (to-point "geo_cylinder" a) (to-point "geo_cylinder" b) r)))
(define geo_cone
  (fn this (a b r s)
    (let ((a (to-point "geo_cone" a)) (b (to-point "geo_cone" b)))
      (if (or (eq? s undefined) (same s 0.)) (make-cone a b r) (make-cut-cone a r b s)))))
(define geo_torus (fn this (c r t) (make-torus (to-point "geo_torus" c) r t)))
(define geo_hull (fn this (all) (hull (points "geo_hull" all))))
(define geo_tetrahedron (fn this (a b c d) (hull (map (lambda (p) (to-point "geo_tetrahedron" p)) (list a b c d)))))
(define geo_mesh
  (fn this (all faces)
    (if (not (numerous? faces)) (type-error "geo_mesh: the faces are an array of arrays of places among the points"))
    (make-polyface-mesh (points "geo_mesh" all)
      (map (lambda (f) (map (lambda (i) (+ 1 (exact (to-integer i)))) (argument-list f))) (argument-list faces)))))
(define geo_polygon (fn this (all) (make-polygon (points "geo_polygon" all))))
(define geo_extrude
  (fn this (profile amount)
    (do-extrude (if (numerous? profile) (make-polygon (points "geo_extrude" profile)) profile) (to-vector "geo_extrude" amount))))
(define geo_union (fn-rest this () values (apply unite (flat values))))
(define geo_intersection (fn-rest this () values (apply intersect (flat values))))
(define geo_difference (fn-rest this () values (apply subtract (flat values))))
(define geo_move (fn this (o v) (do-move o (to-vector "geo_move" v))))
(define geo_rotate
  (fn this (o p axis angle) (do-rotate o (to-point "geo_rotate" p) (to-vector "geo_rotate" axis) angle)))
(define geo_scale
  (fn this (o factor p)
    (let ((factor (if (numerous? factor) (coordinates "geo_scale" factor) factor)))
      (if (eq? p undefined) (do-scale o factor) (do-scale o (to-point "geo_scale" p) factor)))))
(define geo_color (fn this (o r g b) (color (if (eq? g undefined) r (list r g b)) o)))
(define geo_layer (fn this (o name) (layer name o)))
(define geo_volume (fn this (o) (inexact (volume o))))
(define geo_area (fn this (o) (inexact (area o))))
(define geo_centroid (fn this (o) (from-point (centroid o))))
(define geo_draw (fn-rest this () values (for-each draw (flat values)) undefined))

; ---- GUI: var x = gui_number(...) at top level is a parameter of the model ----

(define (whole x) (if (and (flonum? x) (= x (floor x)) (< (abs x) 1e15)) (exact x) x))

(define gui_number (fn this () (type-error "a parameter of the model is a variable of its own at top level: var x = gui_number(...)")))
(define gui_choice gui_number)
(define gui_text gui_number)

(define-syntax gui-number
  (syntax-rules ()
    ((_ name default) (begin (define-parameter name (whole default)) (set! name (to-number name))))
    ((_ name default least most)
     (begin (define-parameter name (whole default) #:min (whole least) #:max (whole most)) (set! name (to-number name))))
    ((_ name default least most step)
     (begin
       (define-parameter name (whole default) #:min (whole least) #:max (whole most) #:step (whole step))
       (set! name (to-number name))))
    ((_ name default least most step label)
     (begin
       (define-parameter name (whole default) #:min (whole least) #:max (whole most) #:step (whole step) #:label label)
       (set! name (to-number name))))))
(define-syntax gui-choice
  (syntax-rules ()
    ((_ name default choices)
     (begin
       (define-parameter name (whole default) #:choices (map whole (argument-list choices)))
       (set! name (from-native name))))
    ((_ name default choices label)
     (begin
       (define-parameter name (whole default) #:choices (map whole (argument-list choices)) #:label label)
       (set! name (from-native name))))))
(define-syntax gui-text
  (syntax-rules ()
    ((_ name default) (define-parameter name default))
    ((_ name default label) (define-parameter name default #:label label))))

; ---- IO ----

(define io_stdout_write (fn this (msg) (display (to-string msg)) undefined))
(define io_stdout_writeln (fn this (msg) (display (to-string msg)) (newline) undefined))
(define io_stderr_write (fn this (msg) (display (to-string msg) (current-error-port)) undefined))

; ---- MATH: vectors ----

(define (each-coordinate f . vectors) (list->array (apply map f (map (lambda (v) (coordinates "math" v)) vectors))))
(define (dot a b) (apply + 0. (map * (coordinates "math_dot" a) (coordinates "math_dot" b))))
(define math_add (fn this (a b) (each-coordinate + a b)))
(define math_subtract (fn this (a b) (each-coordinate - a b)))
(define math_scale (fn this (a s) (let ((s (to-number s))) (each-coordinate (lambda (x) (* x s)) a))))
(define math_mix (fn this (a b t) (let ((t (to-number t))) (each-coordinate (lambda (x y) (+ x (* t (- y x)))) a b))))
(define math_dot (fn this (a b) (dot a b)))
(define math_length (fn this (a) (sqrt (dot a a))))
(define math_normalize (fn this (a) (let ((l (sqrt (dot a a)))) (each-coordinate (lambda (x) (/ x l)) a))))
(define math_cross
  (fn this (a b)
    (let ((a (coordinates "math_cross" a)) (b (coordinates "math_cross" b)))
      (define (part i j) (- (* (list-ref a i) (list-ref b j)) (* (list-ref a j) (list-ref b i))))
      (if (not (= 3 (length a) (length b))) (type-error "math_cross: both vectors have three numbers"))
      (array (part 1 2) (part 2 0) (part 0 1)))))
(define math_radians (fn this (x) (/ (* (to-number x) 3.141592653589793) 180.)))
(define math_degrees (fn this (x) (/ (* (to-number x) 180.) 3.141592653589793)))

; ---- UTL ----

(define utl_range
  (fn this (from to step)
    (let ((from (to-number from)) (to (to-number to)) (step (if (eq? step undefined) 1. (to-number step))))
      (if (not (> step 0.)) (range-error "utl_range: the step must be positive"))
      (let ((a (make-array no-names 0. #f)))
        (let loop ((x from)) (if (< x to) (begin (push! a x) (loop (+ x step))) a))))))
(define utl_fill (fn this (n value) (let ((n (exact (max 0. (to-integer n))))) (make-array (make-vector n value) (inexact n) #f))))
(define utl_is_array (fn this (v) (numerous? v)))
(define utl_copy
  (fn this (v)
    (cond ((array? v) (make-array (vector-copy (array-items v)) (array-length v) #f))
          ((native? v) (to-javascript v))
          ((object? v) (let ((o (object))) (for-each (lambda (k) (own-put! o k (get v k))) (own-keys v)) o))
          (else v))))
(define utl_assert (fn this (test text) (if (true? test) undefined (throw (make-error error-prototype (if (eq? text undefined) "an assertion failed" (to-string text)))))))
