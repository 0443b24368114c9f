; Where curves, rays and points meet objects, trimmed surfaces, geodesics: closed forms and refusals.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (all-near? l m) (and (= (length l) (length m)) (every (lambda (p q) (near? p q 1e-6)) l m)))
(define ring (make-circle origin 2))
; curves with curves
(displayln (all-near? (curve-intersections ring (make-line (xyz -3 1 0) (xyz 3 1 0))) (list (xyz (sqrt 3) 1 0) (xyz (- (sqrt 3)) 1 0)))) ; expect: #t
(displayln (all-near? (curve-intersections ring (make-circle (xyz 3 0 0) 2)) (list (xyz 1.5 (sqrt 1.75) 0) (xyz 1.5 (- (sqrt 1.75)) 0)))) ; expect: #t
(displayln (all-near? (curve-intersections ring (make-circle (xyz 4 0 0) 2)) (list (xyz 2 0 0)))) ; expect: #t
(displayln (curve-intersections (make-line origin (xyz 4 0 0)) (make-line (xyz 1 0 1) (xyz 1 2 1)))) ; expect: ()
(displayln (length (curve-intersections (make-spline (map (lambda (i) (xyz i (sin i) 0)) (iota 30))) (make-line origin (xyz 30 0 0))))) ; expect: 10
(displayln (length (curve-intersections ring (do-rotate ring 'x pi/2)))) ; expect: 2
(displayln (all-near? (curve-intersections (make-line origin (xyz 4 0 0)) (make-line (xyz 4 0 0) (xyz 4 2 0))) (list (xyz 4 0 0)))) ; expect: #t
(displayln (substring (condition/report-string (guard (c (#t c)) (curve-intersections ring ring))) 0 48)) ; expect: curve-intersections: the curves lie on each othe
(displayln (substring (condition/report-string (guard (c (#t c)) (curve-intersections (make-line origin (xyz 4 0 0)) (make-line (xyz 1 0 0) (xyz 2 0 0))))) 0 48)) ; expect: curve-intersections: the curves lie on each othe
(fails (curve-intersections ring origin)) ; expect: curve-intersections: b must be a curve, got (xyz 0 0 0)
; curves with objects
(define cube (make-box origin (xyz 1 1 1)))
(displayln (all-near? (surface-intersections cube (make-line (xyz -1 0.5 0.5) (xyz 3 0.5 0.5))) (list (xyz 0 0.5 0.5) (xyz 1 0.5 0.5)))) ; expect: #t
(displayln (length (surface-intersections cube (make-circle (xyz 0.5 0.5 0.5) 0.6)))) ; expect: 8
(displayln (every (lambda (p) (near? (distance p origin) 1 1e-3)) (surface-intersections (make-sphere origin 1) (make-circle (xyz 1 0 0.2) 1)))) ; expect: #t
(displayln (length (surface-intersections (make-surface (lambda (u v) (xyz u v 0))) (make-line (xyz 0.5 0.4 -1) (xyz 0.5 0.4 1))))) ; expect: 1
(displayln (surface-intersections cube (make-line (xyz 5 0 0) (xyz 5 1 1)))) ; expect: ()
(fails (surface-intersections ring ring)) ; expect: surface-intersections: o must be a solid or a surface, got (make-circle (xyz 0 0 0) 2)
; points and curves onto objects
(displayln (near? (closest-point (make-sphere origin 2) (xyz 0 0 5)) (xyz 0 0 2) 1e-3)) ; expect: #t
(displayln (closest-point cube (xyz 0.5 0.25 5)))            ; expect: (xyz 0.5 0.25 1)
(displayln (near? (closest-point ring (xyz 5 5 3)) (xyz (sqrt 2) (sqrt 2) 0) 1e-9)) ; expect: #t
(displayln (project-point cube (xyz 0.5 0.25 5) (vxyz 0 0 -1))) ; expect: (xyz 0.5 0.25 1)
(displayln (project-point cube (xyz 3 0.25 5) (vxyz 0 0 -1)))   ; expect: #f
(displayln (near? (curve-length (project-curve cube (make-circle (xyz 0.5 0.5 3) 0.3) (vxyz 0 0 -1))) (* 0.6 pi) 1e-3)) ; expect: #t
(displayln (object-count (project-curve (unite cube (make-box (xyz 2 0 0) (xyz 3 1 1))) (make-line (xyz -1 0.5 3) (xyz 4 0.5 3)) (vxyz 0 0 -1)))) ; expect: 2
(fails (project-point cube origin (vxyz 0 0 0))) ; expect: project-point: v must be a gvector longer than 0, got (vxyz 0 0 0)
(fails (closest-point 3 origin))                 ; expect: closest-point: o must be a curve, a solid or a surface, got 3
; trimmed surfaces
(define trim (make-region (make-rectangle (xy 0 0) (xy 2 1)) (make-circle (xyz 1 0.5 0) 0.25)))
(displayln (near? (area (make-trimmed-surface (lambda (u v) (cyl 1 u v)) trim)) (- 2 (/ pi 16)) 3e-3)) ; expect: #t
(displayln (near? (area (make-trimmed-surface (lambda (u v) (xyz u v 0)) (make-circle (xyz 0.5 0.5 0) 0.4))) (* pi 0.16) 1e-3)) ; expect: #t
(fails (make-trimmed-surface (lambda (u v) (xyz u v 0)) (make-circle (xyz 0.5 0.5 1) 0.4))) ; expect: make-trimmed-surface: region must lie in the XY plane, whose x and y are u and v
; geodesics: flat faces are laid flat, round ones are near their closed forms
(displayln (near? (curve-length (geodesic cube origin (xyz 1 1 1))) (sqrt 5) 1e-9)) ; expect: #t
(displayln (near? (curve-length (geodesic (make-cylinder origin 4 1 #:segments 64) (xyz 1 0 0.5) (cyl 1 2 3.5))) (sqrt 13) 0.01)) ; expect: #t
(displayln (near? (curve-length (geodesic (make-sphere origin 1 #:segments 32) (xyz 1 0.2 0) (sph 1 2.5 2))) (angle-between (vxyz 1 0.2 0) (vsph 1 2.5 2)) 0.02)) ; expect: #t
(fails (geodesic (unite cube (make-box (xyz 2 0 0) (xyz 3 1 1))) origin (xyz 3 1 1))) ; expect: geodesic: no way leads from (xyz 0 0 0) to (xyz 3 1 1) over the object: they lie on separate parts of it
; offsets over an object: on a plane they are the plane's, with loops cut off; on a ball a parallel is nearer the pole
(define plate (make-surface (lambda (u v) (xyz (* 20 (- u 0.5)) (* 20 (- v 0.5)) 0))))
(displayln (offset-curve plate (make-line (xyz -3 0 0) (xyz 3 0 0)) 1 #:n 2)) ; expect: (make-line (list (xyz -3 1 0) (xyz 0 1 0) (xyz 3 1 0)))
(displayln (offset-curve plate (make-line (xyz -3 0 0) (xyz 3 0 0)) -1 #:n 1)) ; expect: (make-line (list (xyz -3 -1 0) (xyz 3 -1 0)))
(displayln (near? (curve-length (offset-curve plate (make-circle origin 3) 1)) (* 2 pi 2) 1e-3)) ; expect: #t
; the ellipse's inner parallel, from its closed form, cut at the axis
(displayln (near? (curve-length (offset-curve plate (make-ellipse origin 6 1) 0.8 #:n 2000)) 14.2300817 1e-4)) ; expect: #t
(displayln (near? (curve-length (offset-curve plate (make-line (xyz -3 0 0) (xyz 0 3 0) (xyz 3 0 0)) -1 #:n 1000)) (- (* 6 (sqrt 2)) 2) 0.02)) ; expect: #t
(define globe (make-sphere origin 2 #:segments 256))
(displayln (near? (curve-length (offset-curve globe (make-circle origin 2) 1)) (* 4 pi (cos 1/2)) 0.01)) ; expect: #t
(displayln (near? (curve-length (offset-curve globe (make-circle origin 2) -1)) (* 4 pi (cos 1/2)) 0.01)) ; expect: #t
(define drum (make-cylinder origin 6 2 #:segments 128))
(displayln (near? (first (bounding-box (offset-curve drum (make-line (xyz 2 0 1) (xyz 2 0 5)) pi))) (xyz 0 -2 1) 1e-3)) ; expect: #t
; ways that leave the surface are left out: half of a circle's
(displayln (near? (curve-length (offset-curve plate (make-circle (xyz 10 0 0) 3) 1)) 2pi 0.1)) ; expect: #t
(fails (offset-curve plate (make-circle origin 3) 4)) ; expect: offset-curve: no curve lies at distance 4 from c: the object ends before, or c bends more than that
(fails (offset-curve plate (make-circle origin 3) 0)) ; expect: offset-curve: d must be a number, finite and not 0, got 0
(fails (offset-curve (make-circle origin 3) (make-circle origin 3) 1)) ; expect: offset-curve: o must be a solid or a surface, got (make-circle (xyz 0 0 0) 3)
(fails (offset-curve plate globe 1)) ; expect: offset-curve: c must be a curve, got (make-sphere (xyz 0 0 0) 2 #:segments 256)
