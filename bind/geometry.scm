; The geometry's library in Scheme: what takes procedures, what has forms that C natives cannot take, constants, forms.
; Names that begin with % are not visible to programs. Compiled into the binary when it is built, after prelude.scm.

; ---- numbers ----

(define pi 3.141592653589793)
(define 2pi (* 2 pi))
(define 2*pi 2pi)
(define 3pi/2 (* 3/2 pi))
(define pi/2 (/ pi 2))
(define pi/3 (/ pi 3))
(define pi/4 (/ pi 4))
(define pi/5 (/ pi 5))
(define pi/6 (/ pi 6))
(define pi/8 (/ pi 8))
(define pi/12 (/ pi 12))
(define -pi (- pi))
(define -2pi (- 2pi))
(define -2*pi -2pi)
(define -3pi/2 (- 3pi/2))
(define -pi/2 (- pi/2))
(define -pi/3 (- pi/3))
(define -pi/4 (- pi/4))
(define -pi/5 (- pi/5))
(define -pi/6 (- pi/6))
(define -pi/8 (- pi/8))
(define -pi/12 (- pi/12))

; ---- points and vectors ----

(define origin (xyz 0 0 0))
(define u0 origin)
(define ux (vxyz 1 0 0))
(define uy (vxyz 0 1 0))
(define uz (vxyz 0 0 1))

; ---- sequences ----

(define map-division
  (case-lambda
    ((f a b n) (map f (division a b n)))
    ((f a b n last?) (map f (division a b n last?)))
    ((f u0 u1 nu v0 v1 nv)
     (let ((vs (division v0 v1 nv)))
       (map (lambda (u) (map (lambda (v) (f u v)) vs)) (division u0 u1 nu))))))

; The cell with corners p and q is the first of nx by ny by nz; f makes the object about each centre.
(define (distribute-in-space f p q nx ny nz)
  (let* ((size (p->q p q)) (centre (mid p q)))
    (define (at i j k)
      (f (+xyz centre (* i (cx size)) (* j (cy size)) (* k (cz size)))))
    (%check-count 'distribute-in-space 'nx nx)
    (%check-count 'distribute-in-space 'ny ny)
    (%check-count 'distribute-in-space 'nz nz)
    (let loop ((i 0) (j 0) (k 0) (made '()))
      (cond
        ((= k nz) (apply unite (reverse made)))
        ((= j ny) (loop 0 0 (+ k 1) made))
        ((= i nx) (loop 0 (+ j 1) k made))
        (else (loop (+ i 1) j k (cons (at i j k) made)))))))

(define (%check-count who name n)
  (if (not (and (exact-integer? n) (>= n 0)))
      (error who "~a must be an exact integer from 0 on, got ~s" name n)))

; ---- curves ----

(define (make-spline #:segments [segments any? #f] . arguments)
  (cond
    ((and (pair? arguments) (or (pair? (car arguments)) (null? (car arguments))))
     (case (length arguments)
       ((1) (%make-spline (car arguments) #f #f segments))
       ((3) (%make-spline (car arguments) (cadr arguments) (caddr arguments) segments))
       (else (error 'make-spline "takes a list of points, alone or with a start and an end tangent"))))
    (else (%make-spline arguments #f #f segments))))

; ---- operations ----

; Without cutters: a procedure that takes them. An empty list of cutters cuts nothing.
(define (subtract a . cutters)
  (if (null? cutters)
      (lambda later (apply %subtract a later))
      (apply %subtract a cutters)))

; ---- drawing ----

(define current-segments
  (make-parameter #f
    (lambda (n)
      (if (or (not n) (and (exact-integer? n) (<= 3 n 100000)))
          n
          (error 'current-segments "n must be an exact integer from 3 to 100000, or #f, got ~s" n)))))
(define current-tolerance
  (make-parameter #f
    (lambda (d)
      (if (or (not d) (and (real? d) (positive? d)))
          d
          (error 'current-tolerance "d must be a positive number, or #f, got ~s" d)))))
(%host-set! 0 current-segments)
(%host-set! 1 current-tolerance)

; the ready materials: their names stand for them everywhere
(define white 'white)
(define black 'black)
(define concrete 'concrete)
(define plaster 'plaster)
(define steel 'steel)
(define copper 'copper)
(define gold 'gold)
(define glass 'glass)
(define wood 'wood)
(define brick 'brick)
(define stone 'stone)
(define water 'water)
(define grass 'grass)
(define asphalt 'asphalt)

(define-syntax define-parameter
  (syntax-rules ()
    ((_ name default . options) (define name (%parameter 'name default . options)))))

(define-syntax define-primitive
  (syntax-rules ()
    ((_ . anything) (%reserved "define-primitive" "write a procedure that unites what there is"))))
