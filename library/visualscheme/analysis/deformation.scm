; Deformed frames, and frames whose colours show forces, utilisation or movements.

; Returns the movement of a member at the part t of its length, in m on global axes. Bending follows from the moments: it is
; exact, also beside hinges.
(define (movement-at r i t c)
  (let* ((f (result-frame r)) (b (vector-ref (bars-at f) (- i 1))) (nodes (nodes-at f)) (l (bar-length b)) (x (* t l)) (s (bar-section b)) (e (modulus-of (bar-material b)))
         (end (lambda (n offset) ; the arm from the node to the end turns with the node
                (let ((k (* 6 (+ (* c (node-count f)) (- n 1))))) (v+v (three (result-moved r) k) (cross (three (result-moved r) (+ k 3)) offset)))))
         (u (end (bar-from b) (bar-offset-from b))) (w (end (bar-to b) (bar-offset-to b)))
         (at (* 12 (+ (* c (member-count f)) (- i 1)))) (force (lambda (k) (vector-ref (result-ends r) (+ at k))))
         (load (lambda (k) (/ (+ (force k) (force (+ k 6))) (- l))))
         (along (lambda (k) (let ((q (load k))) (/ (* q x (- l x)) 2 e (section-area s)))))
         (sag (lambda (moment shear q inertia) ; the second integral of the moments, without movement at the ends
                (if (> inertia 0)
                    (/ (+ (* moment 1/2 x (- x l)) (* shear 1/6 x (- (* x x) (* l l))) (* q 1/24 x (- (expt x 3) (expt l 3)))) (* e inertia))
                    0)))
         (ends (bar-ends b nodes)) (axes (member-axes (first ends) (second ends) (bar-roll b))))
    (v+v (v*r u (- 1 t)) (v*r w t) (v*r (first axes) (along 0))
         (v*r (second axes) (sag (- 0 (force 5)) (force 1) (load 1) (section-iz s)))
         (v*r (third axes) (sag (force 4) (force 2) (load 2) (section-iy s))))))

(define upright 1e-6) ; as in the core: a member that leans less from the vertical, in radians, is vertical
(define (member-axes p q roll)
  (let* ((x (unitize (p->q p q))) (flat (sqrt (+ (square (cx x)) (square (cy x)))))
         (y0 (if (> flat upright) (vxyz (/ (- (cy x)) flat) (/ (cx x) flat) 0) (vxyz 0 1 0)))
         (z (unitize (cross x y0))) (y (cross z x)))
    (list x (v+v (v*r y (cos roll)) (v*r z (sin roll))) (v-v (v*r z (cos roll)) (v*r y (sin roll))))))

(define (need-part who t) (if (not (and (real? t) (<= 0 t 1))) (error who "t must be a part of the length from 0 to 1, got ~s" t)))

(define (member-displacement r i t #:case [case any? #f])
  (member-index 'member-displacement r i case 12)
  (need-part 'member-displacement t)
  (movement-at r i t (case-index 'member-displacement r case)))

; Returns the points of member i moved by `factor` times its movement.
(define (moved-points r i factor c)
  (let* ((f (result-frame r)) (b (vector-ref (bars-at f) (- i 1))) (ends (bar-ends b (nodes-at f))) (p (first ends)) (q (second ends)))
    (map (lambda (k) (let ((t (/ k 8))) (p+v (intermediate-point p q t) (v*r (movement-at r i t c) factor))))
      (if (or (= factor 0) (= 0 (section-iy (bar-section b)))) '(0 8) (iota 9)))))

(define (curve-of points) (if (null? (cddr points)) (make-line points) (make-spline points)))

(define (deformed r #:factor [factor any? 1] #:case [case any? #f])
  (need-result 'deformed r)
  (need-number 'deformed 'factor factor)
  (let ((c (case-index 'deformed r case)))
    (map (lambda (i) (curve-of (moved-points r i factor c))) (iota (member-count (result-frame r)) 1))))

; ---- colours ----

; Returns the colour of a value between low and high: blue, green, yellow, red.
(define (scale-color value low high)
  (let* ((t (if (= low high) 0 (max 0 (min 1 (/ (- value low) (- high low)))))) (stops '((0.16 0.32 0.75) (0.25 0.66 0.72) (0.45 0.75 0.35) (0.97 0.8 0.25) (0.85 0.2 0.15)))
         (at (* t 4)) (k (min 3 (exact (floor at)))) (part (- at k)))
    (map (lambda (a b) (+ a (* part (- b a)))) (list-ref stops k) (list-ref stops (+ k 1)))))

(define (member-values r show c name)
  (map (lambda (i)
         (case show
           ((utilisation) (utilisation r i #:case name))
           ((force) (member-force r i #:case name))
           (else (apply max (map (lambda (k) (vlength (movement-at r i (/ k 8) c))) (iota 9))))))
    (iota (member-count (result-frame r)) 1)))

; Returns the radius of the pipe that shows a section.
(define (shown-radius s) (if (section-width s) (/ (max (section-width s) (section-height s)) 2) (sqrt (/ (section-area s) pi))))

(define (frame-picture r #:show [show any? 'utilisation] #:factor [factor any? 0] #:case [case any? #f] #:radius [radius any? #f] #:from [from any? #f] #:to [to any? #f])
  (need-result 'frame-picture r)
  (need-number 'frame-picture 'factor factor)
  (if (not (memq show '(utilisation force displacement))) (error 'frame-picture "show must be 'utilisation, 'force or 'displacement, got ~s" show))
  (for-each (lambda (name x) (if x (need-number 'frame-picture name x))) '(from to) (list from to))
  (if radius (need-positive 'frame-picture 'radius radius))
  (let* ((c (case-index 'frame-picture r case)) (values (member-values r show c (list-ref (result-cases r) c)))
         (low (or from (if (eq? show 'force) (apply min values) 0))) (high (or to (if (eq? show 'utilisation) 1 (apply max values)))))
    (map (lambda (b v i)
           (let ((points (moved-points r i factor c)) (wide (or radius (shown-radius (bar-section b)))))
             (color (scale-color v low high)
               (if (null? (cddr points)) (make-cylinder (first points) (second points) wide) (make-pipe (make-spline points) wide)))))
      (bars-in (result-frame r)) values (iota (member-count (result-frame r)) 1))))

; Returns the triangles of shells, coloured.
(define (shell-picture r #:show [show any? 'stress] #:factor [factor any? 0] #:case [case any? #f] #:from [from any? 0] #:to [to any? #f])
  (need-result 'shell-picture r)
  (need-number 'shell-picture 'factor factor)
  (need-number 'shell-picture 'from from)
  (if to (need-number 'shell-picture 'to to))
  (if (not (memq show '(stress displacement))) (error 'shell-picture "show must be 'stress or 'displacement, got ~s" show))
  (let* ((f (result-frame r)) (c (case-index 'shell-picture r case)) (name (list-ref (result-cases r) c)) (at (nodes-at f)) (n (shell-count r))
         (move (lambda (k) (three (result-moved r) (* 6 (+ (* c (node-count f)) (- k 1))))))
         (corners (map (lambda (p) (take p 3)) (plates-in f)))
         (values (map (lambda (t i) (if (eq? show 'stress) (shell-stress r i #:case name) (apply max (map (lambda (k) (vlength (move k))) t)))) corners (iota n 1)))
         (high (or to (apply max from values))))
    (map (lambda (t v)
           (let ((p (map (lambda (k) (p+v (vector-ref at k) (v*r (move k) factor))) t)))
             (color (scale-color v from high) (make-3dface (first p) (second p) (third p) (third p)))))
      corners values)))

; Returns an object that casts no shadow in pictures, as paper beside the model.
(define (shadowless o) (native 'povray "no_shadow" #:otherwise o))

; Returns a legend of the colours from low to high, upright in the plane of x and z: n fields above p, each with its value.
(define (color-legend low high #:at [p any? origin] #:size [size any? 1] #:fields [n any? 5] #:format [text any? #f])
  (need-number 'color-legend 'low low)
  (need-number 'color-legend 'high high)
  (need-positive 'color-legend 'size size)
  (if (not (point? p)) (error 'color-legend "at must be a point, got ~s" p))
  (if (not (and (exact-integer? n) (<= 2 n 50))) (error 'color-legend "fields must be a number from 2 to 50, got ~s" n))
  (append-map
    (lambda (k)
      (let* ((v (+ low (* (/ k (- n 1)) (- high low)))) (z (* k size)) (written (if text (text v) (number->string (/ (round (* 100 (inexact v))) 100)))))
        (list (shadowless (color (scale-color v low high) (make-box (+xz p 0 z) (+xyz p size (* 0.1 size) (+ z (* 0.92 size))))))
              (shadowless (color '(0.1 0.1 0.1)
                (do-move (do-extrude (do-rotate (make-text origin (* 0.45 size) written) 'x pi/2) (vxyz 0 (* -0.05 size) 0)) (p->q origin (+xz p (* 1.3 size) (+ z (* 0.22 size))))))))))
    (iota n)))
