; Implicit solids: functions of x, y and z that are below 0 inside, and operations on them. After maps.scm. All of them
; keep their expressions; therefore make-isosurface, bounds and slopes work on combinations. Names that begin with % are
; hidden from programs. Compiled into the binary when it is built.

; ---- the distance from a solid ----

(define %field-last (cons #f #f)) ; the last solid that was asked about, and its field
(define (%field-of o)
  (if (not (eq? o (car %field-last))) (set! %field-last (cons o (%distance-field o))))
  (cdr %field-last))

(define (%need-solid who o)
  (if (not (and (object? o) (solid? o))) (error who "o must be a solid, got ~s" o)))

; The distance is negative inside.
(define (signed-distance o p)
  (%need-solid 'signed-distance o)
  (%need-point 'signed-distance 'p p)
  (%field-value (%field-of o) (cx p) (cy p) (cz p)))

; The same as a function of x, y and z that keeps its expression.
(define (distance-function o)
  (%need-solid 'distance-function o)
  (let ((field (%field-of o)))
    (%function
      (lambda (x y z) (%field-value field x y z))
      (vector 'distance '(x y z) '(field 0 (input 0) (input 1) (input 2)) (lambda () (list field)) '() '(distance x y z)))))

; ---- operations ----

; Returns a function of three numbers; a solid gives the distance from it.
(define (%implicit who f)
  (cond
    ((and (object? f) (solid? f)) (distance-function f))
    ((and (procedure? f) (%function-note f))
     (if (not (= (length (function-parameters f)) 3))
         (error who "an operand must be a function of x, y and z, ~a has ~a parameters" (vector-ref (%function-note f) 0) (length (function-parameters f))))
     f)
    (else (error who "an operand must be a function of x, y and z made by define-function, or a solid, got ~s" f))))

(define (%implicit-fold who combine f more)
  (fold (lambda (g so-far) (combine so-far (%implicit who g))) (%implicit who f) more))

(define (implicit-union f . more)
  (%implicit-fold 'implicit-union (lambda (f g) (define-function (union x y z) (min (f x y z) (g x y z))) union) f more))
(define (implicit-intersection f . more)
  (%implicit-fold 'implicit-intersection
    (lambda (f g) (define-function (intersection x y z) (max (f x y z) (g x y z))) intersection) f more))
(define (implicit-difference f . more)
  (%implicit-fold 'implicit-difference
    (lambda (f g) (define-function (difference x y z) (max (f x y z) (- (g x y z)))) difference) f more))

(define (%need-positive who name x)
  (if (not (and (real? x) (finite? x) (positive? x))) (error who "~a must be a positive number, got ~s" name x)))

; A union with inner corners that are rounded over the width k.
(define (implicit-smooth-union k f . more)
  (%need-positive 'implicit-smooth-union 'k k)
  (%implicit-fold 'implicit-smooth-union
    (lambda (f g)
      (define-function (smooth-union x y z)
        (let ((a (f x y z)) (b (g x y z)))
          (- (min a b) (/ (square (max (- k (abs (- a b))) 0)) (* 4 k)))))
      smooth-union)
    f more))

; An intersection and a difference with outer corners that are rounded over the width k.
(define (%smooth-intersection k f g)
  (define-function (smooth-intersection x y z)
    (let ((a (f x y z)) (b (g x y z)))
      (+ (max a b) (/ (square (max (- k (abs (- a b))) 0)) (* 4 k)))))
  smooth-intersection)
(define (implicit-smooth-intersection k f . more)
  (%need-positive 'implicit-smooth-intersection 'k k)
  (%implicit-fold 'implicit-smooth-intersection (lambda (f g) (%smooth-intersection k f g)) f more))
(define (implicit-smooth-difference k f . more)
  (%need-positive 'implicit-smooth-difference 'k k)
  (%implicit-fold 'implicit-smooth-difference
    (lambda (f g)
      (define-function (outside x y z) (- (g x y z)))
      (%smooth-intersection k f outside))
    f more))

(define (implicit-offset f d)
  (%need-number 'implicit-offset 'd d)
  (let ((f (%implicit 'implicit-offset f)))
    (define-function (offset x y z) (- (f x y z) d))
    offset))

; The shell of this thickness below the surface.
(define (implicit-shell f thickness)
  (%need-positive 'implicit-shell 'thickness thickness)
  (let ((f (%implicit 'implicit-shell f)))
    (define-function (shell x y z) (let ((a (f x y z))) (max a (- (+ a thickness)))))
    shell))

; Turns f about Z by this many radians for each unit of height.
(define (implicit-twist f rate)
  (%need-number 'implicit-twist 'rate rate)
  (let ((f (%implicit 'implicit-twist f)))
    (define-function (twist x y z)
      (let ((c (cos (* rate z))) (s (sin (* rate z))))
        (f (+ (* c x) (* s y)) (- (* c y) (* s x)) z)))
    twist))

(define (implicit-move f v)
  (if (not (gvector? v)) (error 'implicit-move "v must be a gvector, got ~s" v))
  (let ((f (%implicit 'implicit-move f)) (a (cx v)) (b (cy v)) (c (cz v)))
    (define-function (move x y z) (f (- x a) (- y b) (- z c)))
    move))

; Blends from f, at t = 0, to g, at t = 1.
(define (implicit-blend f g t)
  (%need-number 'implicit-blend 't t)
  (let ((f (%implicit 'implicit-blend f)) (g (%implicit 'implicit-blend g)))
    (define-function (blend x y z) (+ (* (- 1 t) (f x y z)) (* t (g x y z))))
    blend))

; ---- lattices ----

; Minimal surfaces, accurate to some per cent, with one period in each cell. Near them the value is approximately the
; distance.
(define (gyroid cell)
  (%need-positive 'gyroid 'cell cell)
  (let ((k (/ 2pi cell)))
    (define-function (gyroid x y z)
      (/ (+ (* (sin (* k x)) (cos (* k y))) (* (sin (* k y)) (cos (* k z))) (* (sin (* k z)) (cos (* k x)))) (* 1.5 k)))
    gyroid))
(define (schwarz-p cell)
  (%need-positive 'schwarz-p 'cell cell)
  (let ((k (/ 2pi cell)))
    (define-function (schwarz-p x y z) (/ (+ (cos (* k x)) (cos (* k y)) (cos (* k z))) (* 1.5 k)))
    schwarz-p))

; Walls of this thickness along the lattice's surface, within f.
(define (implicit-lattice f lattice thickness)
  (%need-positive 'implicit-lattice 'thickness thickness)
  (let ((f (%implicit 'implicit-lattice f)) (g (%implicit 'implicit-lattice lattice)) (half (/ thickness 2)))
    (define-function (lattice x y z) (max (f x y z) (- (abs (g x y z)) half)))
    lattice))
