; Pipes, Coons patches, Bezier and NURBS curves and surfaces, wires, crusts, places along curves: closed forms and refusals.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (within? a b share) (<= (abs (- a b)) (* share (abs b))))
; places along curves
(define arch (make-arc (xyz 1 0 0) 4 0 pi))
(displayln (near? (curve-point arch (* 2 pi)) (xyz 1 4 0) 1e-9))         ; expect: #t
(displayln (near? (curve-tangent arch (* 2 pi)) (vxyz -1 0 0) 1e-9))     ; expect: #t
(displayln (near? (curve-curvature arch 3) 1/4 1e-9))                    ; expect: #t
(displayln (curve-point (make-line origin (xyz 3 0 0) (xyz 3 4 0)) 5))   ; expect: (xyz 3 2 0)
(displayln (curve-division (make-line origin (xyz 3 0 0) (xyz 3 4 0)) 2)) ; expect: ((xyz 0 0 0) (xyz 3 0.5 0) (xyz 3 4 0))
(displayln (near? (curve-point (make-circle origin 1) (* 5 pi)) (xyz -1 0 0) 1e-9)) ; expect: #t
(displayln (curve-frame (make-line origin (xyz 0 0 4)) 1))               ; expect: (make-matrix 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1)
(fails (curve-point arch 13))            ; expect: curve-point: s must be from 0 to 12.566370614359172, the curve's length, got 13
(fails (curve-point (make-box origin (xyz 1 1 1)) 0)) ; expect: curve-point: c must be a curve, got (make-box (xyz 0 0 0) (xyz 1 1 1))
(fails (curve-division arch 0))          ; expect: curve-division: n must be 1 or more, got 0
; pipes
(define ring (make-circle origin 5))
(displayln (within? (volume (make-pipe ring 1)) (* 2 pi pi 5) 1e-3))     ; expect: #t
(define torus (make-pipe ring (lambda (t) 1)))
(displayln (and (solid? torus) (within? (volume torus) (* 2 pi pi 5) 1e-3))) ; expect: #t
(define spike (make-pipe (make-line origin (xyz 0 0 3)) (lambda (t) (- 1 t))))
(displayln (and (solid? spike) (within? (volume spike) pi 1e-3)))        ; expect: #t
(define frame (make-pipe (make-line origin (xyz 4 0 0) (xyz 4 3 0) origin) (lambda (t) 0.2)))
(displayln (within? (volume frame) (* pi 0.04 12) 1e-3))                 ; expect: #t
(fails (make-pipe ring -1))              ; expect: make-pipe: r must be a number of 0 or more, or a procedure, got -1
(fails (make-pipe ring (lambda (t) (- t 0.5)))) ; expect: make-pipe: r must give numbers of 0 or more; at 0.0 it gave -0.5
(fails (make-pipe ring (lambda (t) 0)))  ; expect: make-pipe: r may be 0 at an open curve's ends alone; it is 0 at 0.0
(fails (make-pipe (make-line origin (xyz 1 0 0) (xyz 0.5 0 0)) (lambda (t) 0.1))) ; expect: make-pipe: the curve turns back on itself at (xyz 1 0 0)
(fails (make-pipe origin 1))             ; expect: make-pipe: c must be a curve, got (xyz 0 0 0)
; Coons patches: four lines make the bilinear patch, whatever way they run
(define p00 origin)
(define p10 (xyz 4 0 1))
(define p01 (xyz 0 3 2))
(define p11 (xyz 4 3 -1))
(define patch (make-coons (make-line p00 p10) (make-line p11 p01) (make-line p00 p01) (make-line p11 p10) #:nu 8 #:nv 4))
(define (bilinear u v)
  (define (mix f) (+ (* (- 1 u) (- 1 v) (f p00)) (* u (- 1 v) (f p10)) (* (- 1 u) v (f p01)) (* u v (f p11))))
  (xyz (mix cx) (mix cy) (mix cz)))
(displayln (near? (first (object-arguments patch)) (apply append (map-division bilinear 0 1 8 0 1 4)) 1e-6)) ; expect: #t
(fails (make-coons (make-line p00 p10) (make-line p01 p11) (make-line (xyz 0 0 1) p01) (make-line p10 p11))) ; expect: make-coons: c0 and d0 do not meet: c0 starts at (xyz 0 0 0), d0 starts at (xyz 0 0 1)
(displayln (surface? (make-coons (lambda (t) (xyz t 0 (* t (- 1 t)))) (lambda (t) (xyz t 1 0)) (make-line origin (xyz 0 1 0)) (make-line (xyz 1 0 0) (xyz 1 1 0))))) ; expect: #t
(fails (make-coons 1 2 3 4))             ; expect: make-coons: c0 must be a curve, got 1
; Bezier and NURBS curves
(define bow (make-bezier-curve origin (xyz 1 2 0) (xyz 3 2 0) (xyz 4 0 0)))
(displayln (near? (curve-point bow (/ (curve-length bow) 2)) (xyz 2 1.5 0) 1e-6)) ; expect: #t
(define w (sqrt 1/2))
(define corners (list (xyz 2 0 0) (xyz 2 2 0) (xyz 0 2 0) (xyz -2 2 0) (xyz -2 0 0) (xyz -2 -2 0) (xyz 0 -2 0) (xyz 2 -2 0) (xyz 2 0 0)))
(define weights (list 1 w 1 w 1 w 1 w 1))
(define knots '(0 0 0 1/4 1/4 1/2 1/2 3/4 3/4 1 1 1))
(define circle (make-nurbs-curve corners #:degree 2 #:weights weights #:knots knots))
(define (off p) (abs (- (distance p origin) 2)))
(displayln (< (apply max (map off (first (object-arguments circle)))) 1e-12)) ; expect: #t
(define round (nurbs-curve-function corners #:degree 2 #:weights weights #:knots knots))
(displayln (< (apply max (map (lambda (t) (off (round t))) (division 0 1 999))) 1e-12)) ; expect: #t
(displayln (within? (curve-length circle) (* 4 pi) 1e-6))                ; expect: #t
(displayln (within? (volume (do-extrude circle 1)) (* 4 pi) 1e-6))       ; expect: #t
(displayln (object-kind (make-nurbs-curve (list origin (xyz 1 1 0) (xyz 2 0 0) (xyz 3 1 0) (xyz 4 0 0)) #:degree 2 #:knots '(0 0 0 1 1 2 2 2)))) ; expect: join-curves
(displayln (object-kind (make-nurbs-curve (list origin (xyz 1 1 0) (xyz 2 0 0)) #:degree 1))) ; expect: line
(displayln (solid? (do-extrude (make-nurbs-curve (list origin (xyz 4 0 0) (xyz 4 4 0) (xyz 0 4 0)) #:closed #t) 1))) ; expect: #t
(fails (make-nurbs-curve corners #:degree 9))                            ; expect: make-nurbs-curve: degree must be less than the number of points, 9, got 9
(fails (make-nurbs-curve corners #:degree 2 #:knots '(0 1 2)))           ; expect: make-nurbs-curve: knots must be 12 numbers, points and degree and one (9 + 2 + 1), got 3
(fails (make-nurbs-curve corners #:degree 2 #:knots '(0 0 0 3 1 2 2 3 3 4 4 4))) ; expect: make-nurbs-curve: knots must not fall: number 5 is 1 after 3
(fails (make-nurbs-curve corners #:degree 2 #:knots '(0 0 0 1 1 1 2 3 3 4 4 4))) ; expect: make-nurbs-curve: knots holds 1 more often than the degree: the curve would come apart there
(fails (make-nurbs-curve corners #:weights '(1 2)))                      ; expect: make-nurbs-curve: weights must be 9 numbers, one for each point, got 2
(fails (make-nurbs-curve corners #:weights '(1 2 0 1 1 1 1 1 1)))        ; expect: make-nurbs-curve: weights must be a list of positive numbers, got (1 2 0 1 1 1 1 1 1)
(fails (make-bezier-curve origin))                                       ; expect: make-bezier-curve: points must hold 2 points or more, got 1
(fails (make-bezier-curve origin 'left))                                 ; expect: make-bezier-curve: points must be a list of points of finite coordinates, got ((xyz 0 0 0) left)
(displayln (empty-object? (make-bezier-curve origin origin origin)))     ; expect warning: all points are the same
; expect: #t
; Bezier and NURBS surfaces: an eighth of a sphere by rational patches lies on its radius
(define eighth
  (nurbs-surface-function
    (list (list (xyz 1 0 0) (xyz 1 1 0) (xyz 0 1 0)) (list (xyz 1 0 1) (xyz 1 1 1) (xyz 0 1 1)) (list (xyz 0 0 1) (xyz 0 0 1) (xyz 0 0 1)))
    #:degree-u 2 #:degree-v 2 #:weights (list (list 1 w 1) (list w 1/2 w) (list 1 w 1))))
(displayln (< (apply max (map (lambda (p) (abs (- (distance p origin) 1))) (apply append (map-division eighth 0 1 20 0 1 20)))) 1e-12)) ; expect: #t
(define roof (make-bezier-patch (list (list origin (xyz 0 1 1) (xyz 0 2 0)) (list (xyz 1 0 1) (xyz 1 1 3) (xyz 1 2 1)) (list (xyz 2 0 0) (xyz 2 1 1) (xyz 2 2 0)))))
(displayln (surface? roof))                                              ; expect: #t
(displayln (near? (second (bounding-box roof)) (xyz 2 2 1.25) 1e-3))     ; expect: #t
(fails (make-nurbs-surface (list (list origin (xyz 1 0 0)) (list (xyz 0 1 0))))) ; expect: make-nurbs-surface: rows must hold 2 points or more, got 1
(fails (make-nurbs-surface '(1 2)))                                      ; expect: make-nurbs-surface: rows must be a list of lists of points, got (1 2)
; wires
(define (ring-at u v) (xyz (* (+ 3 (cos v)) (cos u)) (* (+ 3 (cos v)) (sin u)) (sin v)))
(displayln (object-count (make-wire ring-at 0 2pi 0 2pi #:nu 24 #:nv 12))) ; expect: 36
(displayln (solid? (make-wire ring-at 0 2pi 0 2pi #:nu 6 #:nv 3 #:radius 0.1))) ; expect: #t
(fails (make-wire (lambda (u v) u)))                                     ; expect: make-wire: f must give points of finite coordinates; at (u, v) = (0, 0) it gave 0
; crusts
(define shell (make-crust (make-sphere origin 2) 0.3))
(displayln (and (solid? shell) (within? (volume shell) (* 4/3 pi (- 8 (expt 1.7 3))) 0.002))) ; expect: #t
(displayln (volume (make-crust (make-box origin (xyz 2 3 4)) 0.5)))      ; expect: 18.0
(displayln (near? (volume (make-crust (make-box origin (xyz 2 3 4)) 0.5 #:side 'out)) (- 60 24) 1e-9)) ; expect: #t
(displayln (solid? (make-crust roof 0.1 #:side 'both)))                  ; expect: #t
(guard (c (#t (displayln (string-contains? (condition/report-string c) "the surface bends more tightly than the thickness near (xyz "))))
  (make-crust (make-sphere origin 1) 1.5))                               ; expect: #t
(fails (make-crust roof 0.1 #:side 'left))                               ; expect: make-crust: side must be 'in, 'out or 'both, got left
(fails (make-crust (make-circle origin 1) 0.1))                          ; expect: make-crust: o must be a solid or a surface, got (make-circle (xyz 0 0 0) 1)
