; Maps of space: do-deform and the predefined maps, subdivision. After shapes.scm. Names that begin with % are hidden
; from programs. Compiled into the binary when it is built.

; f is a procedure of a point; a function that keeps its expression is one of x, y and z.
(define (do-deform o f)
  (if (not (or (object? o) (and (pair? o) (list? o))))
      (error 'do-deform "o must be an object or a list of objects, got ~s" o))
  (%need-procedure 'do-deform 'f f)
  (let ((d (%deform o)))
    (if (%function-note f)
        (let ((bad (%deform-by-tape d (%tape-for 'do-deform f 3 3))))
          (if (point? bad) (error 'do-deform "f has no value at ~s" bad)))
        (let loop ((wanted (%deform-wanted d)))
          (if (pair? wanted)
              (begin
                (%deform-give d
                  (map (lambda (p)
                         (let ((q (f p)))
                           (if (%finite-point? q)
                               q
                               (error 'do-deform "f must give points of finite coordinates; at ~s it gave ~s" p q))))
                       wanted))
                (loop (%deform-wanted d))))))
    (%deformed d)))

; Returns a map that calls f with the coordinates of a point about the spine from p to q: the share along it, from 0 at
; p to 1 at q, and the distances across it, along two directions perpendicular to it and to each other.
(define (%along-spine who p q side f)
  (%need-point who 'p p)
  (%need-point who 'q q)
  (if (near? p q) (error who "q must be another point than p, got ~s" q))
  (let* ((way (p->q p q)) (long (vlength way)) (z (unitize way))
         (across (if side (v-v side (v*r z (dot side z))) (vxyz 0 0 0))))
    (if (and side (< (vlength across) (* 1e-9 (vlength side))))
        (error who "the direction must not lie along the spine, got ~s" side))
    (let* ((x (if side
                  (unitize across)
                  (let ((least (if (< (abs (cx z)) 0.9) ux uy))) (unitize (v-v least (v*r z (dot least z)))))))
           (y (cross z x)))
      (lambda (r)
        (let ((d (p->q p r)))
          (f (/ (dot d z) long) (dot d x) (dot d y) long x y z))))))

(define (%from p . parts) (fold (lambda (v at) (p+v at v)) p parts))

; Turns about the line from p to q, by 0 at p and by the angle at q.
(define (twist-map p q angle)
  (%need-number 'twist-map 'angle angle)
  (%along-spine 'twist-map p q #f
    (lambda (t a b long x y z)
      (let ((c (cos (* t angle))) (s (sin (* t angle))))
        (%from p (v*r z (* t long)) (v*r x (- (* a c) (* b s))) (v*r y (+ (* a s) (* b c))))))))

; Scales across the line from p to q, by 1 at p and by k at q.
(define (taper-map p q k)
  (%need-number 'taper-map 'k k)
  (%along-spine 'taper-map p q #f
    (lambda (t a b long x y z)
      (let ((scale (+ 1 (* t (- k 1)))))
        (%from p (v*r z (* t long)) (v*r x (* a scale)) (v*r y (* b scale)))))))

; Bends the line from p to q to an arc of this angle and the same length, towards the side.
(define (bend-map p q angle side)
  (%need-number 'bend-map 'angle angle)
  (if (not (gvector? side)) (error 'bend-map "side must be a gvector, got ~s" side))
  (let ((straight (< (abs angle) 1e-12)))
    (%along-spine 'bend-map p q side
      (lambda (t a b long x y z)
        (if straight
            (%from p (v*r z (* t long)) (v*r x a) (v*r y b))
            (let ((radius (/ long angle)) (turn (* t angle)))
              (%from p (v*r x (- radius (* (- radius a) (cos turn)))) (v*r z (* (- radius a) (sin turn))) (v*r y b))))))))

; Moves the line from p to q to the curve. Frames that do not spin, or that stay upright, carry the points across it.
(define (flow-map p q curve #:up [up any? #f])
  (%need-curve 'flow-map 'curve curve)
  (if (not (or (not up) (and (gvector? up) (> (vlength up) 0)))) (error 'flow-map "up must be a gvector longer than 0, got ~s" up))
  (let ((walk (%curve-walk curve)))
    (if up
        ; along a spine whose upright direction is Y, as in profiles, or Z if the spine is parallel to Y
        (%along-spine 'flow-map p q (let ((way (p->q p q))) (if (> (vlength (cross way uy)) (* 1e-6 (vlength way))) uy uz))
          (lambda (t a b long x y z)
            ; %along-spine's first direction is the upright one; its second is to the left of it
            (or (%walk-upright walk t (- b) a up)
                (error 'flow-map "the curve runs along up at ~s; choose another #:up" (%walk-place walk t 0 0)))))
        (%along-spine 'flow-map p q #f (lambda (t a b long x y z) (%walk-place walk t a b))))))

; Moves the rectangle from p to q to the surface f of u and v from 0 to 1; heights go along its normals.
(define (surface-map f p q)
  (%need-procedure 'surface-map 'f f)
  (%need-point 'surface-map 'p p)
  (%need-point 'surface-map 'q q)
  (if (or (= (cx p) (cx q)) (= (cy p) (cy q)))
      (error 'surface-map "p and q must be the corners of a rectangle, got ~s and ~s" p q))
  (let ((dx (- (cx q) (cx p))) (dy (- (cy q) (cy p))) (h 1e-5))
    (define (at u v)
      (let ((r (f u v)))
        (if (%finite-point? r)
            r
            (error 'surface-map "f must give points of finite coordinates; at (u, v) = (~a, ~a) it gave ~s" u v r))))
    ; the difference over a small step within 0 and 1
    (define (clip t) (max 0 (min 1 t)))
    (define (slope along? u v)
      (if along?
          (p->q (at (clip (- u h)) v) (at (clip (+ u h)) v))
          (p->q (at u (clip (- v h))) (at u (clip (+ v h))))))
    (lambda (r)
      (let* ((u (/ (- (cx r) (cx p)) dx)) (v (/ (- (cy r) (cy p)) dy)) (height (- (cz r) (cz p)))
             (n (cross (slope #t u v) (slope #f u v))))
        (if (or (= height 0) (= (vlength n) 0))
            (at u v)
            (p+v (at u v) (v*r (unitize n) height)))))))

; ---- subdivision ----

(define (make-subdivision o n #:creases [creases any? '()] #:scheme [scheme any? 'catmull-clark] #:limit [limit any? #t])
  (if (not (object? o)) (error 'make-subdivision "o must be a mesh, a solid or a surface, got ~s" o))
  (if (not (and (exact-integer? n) (<= 1 n 12)))
      (error 'make-subdivision "n must be an exact integer from 1 to 12, got ~s" n))
  (if (not (list? creases)) (error 'make-subdivision "creases must be a list of edges, each a list of two points, got ~s" creases))
  (if (not (memq scheme '(catmull-clark loop)))
      (error 'make-subdivision "scheme must be 'catmull-clark or 'loop, got ~s" scheme))
  (%make-subdivision o n creases #:scheme scheme #:limit (and limit #t)))
