; Maps of space, subdivision: closed forms and refusals.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (within? a b share) (<= (abs (- a b)) (* share (abs b))))
(define bar (make-box (xyz -1 -1 0) (xyz 1 1 8)))
(define top (xyz 0 0 8))
(define (deformed o f) (parameterize ((current-tolerance 0.005)) (do-deform o f)))
; twist, taper, bend, flow
(define turned (deformed bar (twist-map origin top pi)))
(displayln (and (solid? turned) (within? (volume turned) 32 1e-3)))      ; expect: #t
(displayln (within? (volume (deformed bar (twist-map origin top (* 8 pi)))) 32 0.01)) ; expect: #t
(displayln (within? (volume (deformed bar (taper-map origin top 0.5))) (* 32 7/12) 1e-3)) ; expect: #t
(displayln (within? (volume (deformed bar (bend-map origin top pi/2 ux))) 32 1e-3)) ; expect: #t
(displayln (within? (volume (deformed bar (flow-map origin top (make-arc origin 10 0 pi)))) (* 40 pi) 1e-3)) ; expect: #t
(displayln (volume (deformed bar (bend-map origin top 0 ux))))          ; expect: 32.0
; a function that keeps its expression is the same map
(define-function (twist x y z)
  (let ((c (cos (* z pi/8))) (s (sin (* z pi/8)))) (xyz (- (* x c) (* y s)) (+ (* x s) (* y c)) z)))
(displayln (near? (volume (deformed bar twist)) (volume turned) 1e-6))  ; expect: #t
; a mirrored map gives no solid inside out; looks and layers stay; curves and regions too
(displayln (volume (deformed bar (lambda (p) (xyz (- (cx p)) (cy p) (cz p))))))   ; expect: 32.0
(displayln (object-kind (deformed (with-material 'copper bar) (lambda (p) (+z p 1))))) ; expect: with-material
(define bow (deformed (make-line origin top) (bend-map origin top pi ux)))
(displayln (and (curve? bow) (within? (curve-length bow) 8 1e-3)))       ; expect: #t
(displayln (surface? (deformed (make-region (make-circle origin 1)) (lambda (p) (+z p (square (cx p))))))) ; expect: #t
(define (arched u v) (xyz (* 4 u) (* 4 v) (sin (* 3 u))))
(displayln (solid? (deformed (make-box origin (xyz 4 4 0.2)) (surface-map arched origin (xyz 4 4 0))))) ; expect: #t
(displayln ((surface-map (lambda (u v) (xyz u v 0)) origin (xyz 2 2 0)) (xyz 1 1 3))) ; expect: (xyz 0.5 0.5 3)
(fails (do-deform bar (lambda (p) (/ 1 0.0))))     ; expect: do-deform: f must give points of finite coordinates; at (xyz -1 -1 0) it gave +inf.0
(fails (do-deform bar 1))                          ; expect: do-deform: f must be a procedure, got 1
(fails (do-deform 1 sin))                          ; expect: do-deform: o must be an object or a list of objects, got 1
(displayln (volume (do-deform (list bar (list bar)) (lambda (p) (+z p 1))))) ; expect: 32.0
(define-function (rooted x y z) (xyz (sqrt x) y z))
(fails (do-deform bar rooted))                     ; expect: do-deform: f has no value at (xyz -1 -1 0)
(fails (twist-map origin origin 1))                ; expect: twist-map: q must be another point than p, got (xyz 0 0 0)
(fails (bend-map origin top 1 uz))                 ; expect: bend-map: the direction must not lie along the spine, got (vxyz 0 0 1)
(fails (flow-map origin top 3))                    ; expect: flow-map: curve must be a curve, got 3
(fails (surface-map arched origin (xyz 0 1 0)))    ; expect: surface-map: p and q must be the corners of a rectangle, got (xyz 0 0 0) and (xyz 0 1 0)
; Catmull and Clark's surface of a cube: corners come to a half of themselves, faces' middles to 0.8395...
(define cube (make-box (xyz -1 -1 -1) (xyz 1 1 1)))
(define smooth (make-subdivision cube 3))
(define points (first (object-arguments smooth)))
(displayln (and (solid? smooth) (any (lambda (p) (near? p (xyz 1/2 1/2 1/2) 1e-12)) points) #t)) ; expect: #t
(define middle (/ (+ 16 12 20/9) 36))
(displayln (near? (bounding-box smooth) (list (xyz (- middle) (- middle) (- middle)) (xyz middle middle middle)) 1e-12)) ; expect: #t
(displayln (length points))                        ; expect: 386
(displayln (near? (cz (second (bounding-box (make-subdivision cube 1 #:limit #f)))) 1 1e-12)) ; expect: #t
(displayln (solid? (make-subdivision cube 3 #:scheme 'loop))) ; expect: #t
(define rim (list (xyz -1 -1 1) (xyz 1 -1 1) (xyz 1 1 1) (xyz -1 1 1)))
(define edges (map list rim (append (cdr rim) (list (car rim)))))
(displayln (cz (second (bounding-box (make-subdivision cube 3 #:creases edges)))))  ; expect: 1.0
(define half-sharp (make-subdivision cube 3 #:creases (map (lambda (e) (append e '(1))) edges)))
(displayln (< (volume smooth) (volume half-sharp) (volume (make-subdivision cube 3 #:creases edges)))) ; expect: #t
(define sheet (make-mesh (map-division (lambda (u v) (xyz u v (* u v))) 0 4 4 0 4 4)))
(displayln (surface? (make-subdivision sheet 2)))  ; expect: #t
(fails (make-subdivision cube 12))                 ; expect: make-subdivision: 100663296 faces would be made, but at most 4000000 are
(fails (make-subdivision cube 2 #:creases '((1 99)))) ; expect: make-subdivision: creases must be of points of the mesh, got 99
(fails (make-subdivision cube 2 #:creases (list (list (xyz -1 -1 -1) (xyz 1 1 1))))) ; expect: make-subdivision: creases must be edges of the mesh, got ((xyz -1 -1 -1) (xyz 1 1 1))
(fails (make-subdivision cube 0))                  ; expect: make-subdivision: n must be an exact integer from 1 to 12, got 0
(fails (make-subdivision (make-circle origin 1) 1)) ; expect: make-subdivision: o must be a mesh, a solid or a surface, got (make-circle (xyz 0 0 0) 1)
; flow-map that keeps upright: what was drawn towards Y stands towards up, x goes to the left
(define upright (flow-map origin (xyz 0 0 8) (make-line origin (xyz 8 0 0)) #:up uz))
(displayln (map upright (list (xyz 0 0 4) (xyz 0 1 4) (xyz 1 0 4)))) ; expect: ((xyz 4 0 0) (xyz 4 0 1) (xyz 4 1 0))
(define ramp (make-bezier-curve origin (xyz 9 0 0) (xyz 9 9 3) (xyz 0 9 3)))
(define kerb (do-deform (do-extrude (make-rectangle (xy -0.1 0) (xy 0.1 0.5)) 8) (flow-map origin (xyz 0 0 8) ramp #:up uz)))
(displayln (near? (volume kerb) (* 0.1 (curve-length ramp)) 1e-3)) ; expect: #t
(fails ((flow-map origin (xyz 0 0 8) (make-line origin (xyz 0 0 8)) #:up uz) origin)) ; expect: flow-map: the curve runs along up at (xyz 0 0 0); choose another #:up
(fails (flow-map origin (xyz 0 0 8) ramp #:up 3)) ; expect: flow-map: up must be a gvector longer than 0, got 3
; a map that folds: the part that overlaps itself counts once, as in a union of it
(define coil (do-deform (make-box (xyz -.5 -.5 0) 1 1 8) (bend-map origin (xyz 0 0 8) (* 3 pi) ux)))
(displayln (near? (volume coil) (volume (unite coil (make-box (xyz 50 0 0) 1 1 1))) 1.001))       ; expect: #t
(displayln (do-deform cube (lambda (p) (xyz (cx p) (cy p) 0)))) ; expect: (empty-object)
