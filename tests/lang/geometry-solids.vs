; elliptical cones, superellipsoids, half-spaces and slices: formulas against meshes, and against each other
(define (about x y [tolerance any? 1e-9]) (displayln (near? x y (* tolerance (abs y)))))
(define (mesh-volume o) (volume (unite o o)))
(define (mesh-area o) (area (unite o o)))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (display (error-object-message c)) (display " ") (displayln (error-object-irritants c)))) e (displayln "no error")))))

(define cone (make-e-cone (xyz 1 2 3) 2 1 (xyz 3 1 6) 1))
(displayln cone)                                   ; expect: (make-e-cone (xyz 1 2 3) 2 1 (xyz 3 1 6) 1)
(displayln (object-kind cone))                     ; expect: e-cone
(about (mesh-volume cone) (volume cone) 2e-3)      ; expect: #t
(about (mesh-area cone) (area cone) 2e-3)          ; expect: #t
(about (volume (make-e-cone origin 2 1 (xyz 0 0 3) 2)) (* 6 pi)) ; expect: #t
(about (area (make-e-cone origin 3 3 (xyz 0 0 4) 0)) (* 24 pi))  ; expect: #t
(displayln (bounding-box (make-e-cone origin 2 1 (xyz 0 0 3) 1))) ; expect: ((xyz -2 -1 0) (xyz 2 1 3))
(displayln (map (lambda (x y) (contains? (make-e-cone origin 2 1 (xyz 0 0 3) 1) (xyz x y 1.5))) '(1.49 1.51 0 0) '(0 0 0.74 0.76))) ; expect: (#t #f #t #f)
(displayln (scale (make-e-cone origin 2 1 (xyz 0 0 3) 1) 2)) ; expect: (do-transform (make-e-cone (xyz 0 0 0) 2 1 (xyz 0 0 3) 1) (make-matrix 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1))
(displayln (make-e-cone origin 0 1 (xyz 0 0 3) 1)) ; expect: (empty-object)
(displayln (make-e-cone origin 1 1 origin 1))      ; expect: (empty-object)

; sphere, octahedron, and what lies between
(about (volume (make-superellipsoid 1 1 2)) (* 32/3 pi)) ; expect: #t
(about (area (make-superellipsoid 1 1 2)) (* 16 pi))     ; expect: #t
(about (area (make-superellipsoid 0.001 0.001 1)) 24 1e-2) ; expect: #t
(define worst 0)
(for* ([e '(0.05 0.3 1 1.5 2 2.5)] [n '(0.05 0.3 1 1.5 2 2.5)])
  (define s (make-superellipsoid e n 3))
  (set! worst (max worst (abs (- 1 (/ (mesh-volume s) (volume s)))) (abs (- 1 (/ (mesh-area s) (area s)))))))
(displayln (< worst 4e-3))                         ; expect: #t
(define (corner-of s) (cx (cadr (bounding-box s))))
(about (corner-of (rotate (make-superellipsoid 2 2 1) 'z pi/4)) (/ (sqrt 2) 2)) ; expect: #t
(about (corner-of (rotate (make-superellipsoid 3 3 1) 'z pi/4)) (/ (sqrt 2) 2)) ; expect: #t
(about (corner-of (rotate (make-superellipsoid 0.5 1 1) 'z pi/4)) (expt 2 0.25)) ; expect: #t
(displayln (map (lambda (d) (contains? (make-superellipsoid 0.5 0.5 1) (xyz d d d))) '(0.75 0.77))) ; expect: (#t #f)
(fails (make-superellipsoid 0 1 1))                ; expect: make-superellipsoid: e must be positive, got (0)
(fails (make-superellipsoid 1 21 1))               ; expect: make-superellipsoid: n must be from 0.001 to 20, got (21)
(fails (make-superellipsoid 1 1 (/ 0. 0.)))        ; expect: make-superellipsoid: s must be finite, got (+nan.0)
(displayln (make-superellipsoid 1 1 0))            ; expect: (empty-object)

; half-spaces: as exact as the grid is for what they are cut with, alone or in sets, placed, nested
(define cube (make-box origin (xyz 2 2 2)))
(define askew (make-half-space (make-plane (xyz 1 1 1) (vxyz 1 1 1))))
(displayln (< (abs (- (volume (subtract cube askew)) 4)) 1e-8)) ; expect: #t
(displayln (< (abs (- (volume (intersect askew cube)) 4)) 1e-8)) ; expect: #t
(define slab (subtract (make-half-space 'xy) (translate (make-half-space 'xy) (vxyz 0 0 0.25))))
(displayln (volume (intersect cube slab)))         ; expect: 1.0
(displayln (volume (intersect slab (unite cube (translate cube (vxyz 10 0 0)))))) ; expect: 2.0
(displayln (volume (subtract cube (make-half-space (make-plane (xyz 0 0 5) uz))))) ; expect: 8.0
(displayln (volume (subtract cube (make-half-space (make-plane (xyz 0 0 -5) uz))))) ; expect: 0.0
(displayln (volume (intersect cube (make-half-space (make-plane (xyz 0 0 2) (- uz)))))) ; expect: 8.0
(displayln (volume (scale (subtract cube (make-half-space (make-plane (xyz 0.5 0 0) (vxyz 3 0 0)))) '(1 2 3)))) ; expect: 12.0
(displayln (bounding-box (do-slice cube (make-plane (xyz 0 0 0.3) (- uz))))) ; expect: ((xyz 0 0 0) (xyz 2 2 0.3))
(displayln (map (lambda (z) (contains? (do-slice cube (make-plane (xyz 0 0 0.3) (- uz))) (xyz 1 1 z))) '(0.2 0.4))) ; expect: (#t #f)
(about (volume (do-slice (make-sphere origin 1) (vxyz 1 2 3))) (* 2/3 pi) 5e-3) ; expect: #t
(displayln (object-arguments (make-half-space (make-plane (xyz 1 2 3) (vxyz 0 0 9))))) ; expect: ((xyz 1 2 3) (vxyz 0 0 1))
(displayln (equal? (make-half-space 'xy) (make-half-space uz))) ; expect: #t
(fails (bounding-box askew))                       ; expect: bounding-box: o must be finite (a half-space has to be intersected with something that is, or subtracted from it), got ((make-half-space (make-plane (xyz 1 1 1) (vxyz 0.5773502691896258 0.5773502691896258 0.5773502691896258))))
(fails (area (unite cube slab)))                   ; expect: area: o must be finite (a half-space has to be intersected with something that is, or subtracted from it), got ((unite (make-box (xyz 0 0 0) (xyz 2 2 2)) (subtract (make-half-space (make-plane (xyz 0 0 0) (vxyz 0 0 1))) (do-move (make-half-space (make-plane (xyz 0 0 0) (vxyz 0 0 1))) (vxyz 0 0 0.25)))))
(fails (draw (unite cube askew)))                  ; expect: draw: the object is endless: intersect it with something finite, or subtract it from that ()
(fails (make-half-space 'x))                       ; expect: make-half-space: plane must be a plane ('xy, 'yz, 'xz, a gvector or (make-plane point normal)), got (x)
(fails (make-half-space (vxyz 0 0 0)))             ; expect: make-half-space: plane must be of a normal longer than 0, got ((vxyz 0 0 0))

; slices of what is thin: pieces of curves and surfaces, regions, and unions of several
(define right (make-plane (xyz 0.5 0 0) ux))
(define bow (do-slice (make-circle origin 1) right))
(displayln (list (object-kind bow) (curve? bow) (near? (curve-length bow) (* 2/3 pi) 1e-3))) ; expect: (slice #t #t)
(displayln (curve-length (do-slice (make-line (xyz 0 0 0) (xyz 1 1 0) (xyz 2 0 0) (xyz 3 1 0)) (make-plane (xyz 0 0.5 0) uy)))) ; expect: 2.121320343559643
(displayln (bounding-box (do-slice (make-rectangle (xy -1 -1) (xy 1 1)) right))) ; expect: ((xyz 0.5 -1 0) (xyz 1 1 0))
(displayln (curve-length (do-slice (make-rectangle (xy -1 -1) (xy 1 1)) 'yz))) ; expect: 4.0
(displayln (curve-length (do-slice (make-rectangle (xy -1 -1) (xy 1 1)) 'xy))) ; expect: 8.0
(displayln (area (do-slice (make-region (make-rectangle (xy -1 -1) (xy 1 1)) (make-circle origin 0.5)) right))) ; expect: 1.0
(displayln (do-slice (make-region (make-circle origin 1)) (make-plane (xyz 0 0 1) uz))) ; expect: (empty-object)
(displayln (do-slice (make-region (make-circle origin 1)) (make-plane (xyz -5 0 0) ux))) ; expect: (make-region (make-circle (xyz 0 0 0) 1))
(displayln (bounding-box (do-slice (make-circle origin 1) (make-plane (xyz 5 0 0) ux)))) ; expect: #f
(define sail (do-slice (make-3dface (xyz -1 -1 0) (xyz 1 -1 0) (xyz 1 1 1) (xyz -1 1 1)) right))
(displayln (list (surface? sail) (near? (area sail) (* 1/2 (sqrt 5))) (bounding-box sail))) ; expect: (#t #t ((xyz 0.5 -1 0) (xyz 1 1 1)))
(displayln (bounding-box (do-slice (list (make-box origin (xyz 1 1 1)) (make-line (xyz -1 0 0) (xyz 2 0 0)) (make-region (make-circle (xyz 0 0 3) 1))) right))) ; expect: ((xyz 0.5 -1 0) (xyz 2 1 3))
(displayln (volume (do-extrude (do-slice (make-region (make-rectangle (xy -1 -1) (xy 1 1))) right) 3))) ; expect: 3.0
(make-half-space (quote xy)) ; expect warning: the object is endless: intersect it with something finite, or subtract it from that

; hulls: of points, curves, regions, solids and hulls; of what is flat or thin
(displayln (volume (hull (map (lambda (i) (xyz (modulo i 11) (modulo (quotient i 11) 11) (quotient i 121))) (iota 1331))))) ; expect: 1000.0
(define capsule (hull (make-sphere origin 1) (make-sphere (xyz 4 0 0) 1)))
(displayln (list (object-kind capsule) (solid? capsule) (bounding-box capsule))) ; expect: (hull #t ((xyz -1 -1 -1) (xyz 5 1 1)))
(about (volume capsule) (* pi (+ 4/3 4)) 5e-3)     ; expect: #t
(displayln (map (lambda (y) (contains? capsule (xyz 2 y 0))) '(0.99 1.01))) ; expect: (#t #f)
(displayln (volume (hull (hull (make-box origin (xyz 1 1 1))) (translate (make-box origin (xyz 1 1 1)) (vxyz 2 0 0))))) ; expect: 3.0
(displayln (volume (hull (make-rectangle origin (xy 3 3)) (translate (make-region (make-rectangle origin (xy 3 3))) (vxyz 0 0 2))))) ; expect: 18.0
(displayln (volume (subtract (hull (make-box origin (xyz 4 4 4)) (xyz 2 2 9)) (make-box origin (xyz 4 4 4))))) ; expect: 26.666666666666668
(define slot (hull (make-circle origin 1) (make-circle (xyz 4 0 0) 1)))
(displayln (list (region? slot) (bounding-box slot))) ; expect: (#t ((xyz -1 -1 0) (xyz 5 1 0)))
(about (area slot) (+ pi 8) 1e-5)                  ; expect: #t
(about (volume (do-extrude (rotate slot 'x 1) (vxyz 0 (- (* 2 (sin 1))) (* 2 (cos 1))))) (* 2 (+ pi 8)) 5e-3) ; expect: #t
(displayln (hull (make-line origin (xyz 1 1 1)) (xyz 2 2 2) (xyz 3 3 3))) ; expect: (make-line (list (xyz 0 0 0) (xyz 3 3 3)))
(displayln (list (hull) (hull '()) (hull origin (list origin)) (hull (empty-object)))) ; expect: ((empty-object) (empty-object) (empty-object) (empty-object))
(displayln (object-children (hull slot origin)))   ; expect: ((hull (make-circle (xyz 0 0 0) 1) (make-circle (xyz 4 0 0) 1)))
(fails (hull (make-half-space 'xy) origin))        ; expect: hull: objects must be finite: one of them is, or contains, an endless half-space ()
(fails (hull origin (vxyz 1 0 0)))                 ; expect: hull: things must be a point, an object or a list of them, got ((vxyz 1 0 0))
(define carved (subtract (make-box origin (xyz 2 2 2)) (make-box (xyz 1 1 1) (xyz 3 3 3))))
(displayln (list (volume (hull carved)) (contains? (hull carved) (xyz 1.9 1.9 1.9)))) ; expect: (7.833333333333333 #f)
(displayln (volume (hull (translate (unite carved (make-sphere origin 1)) (vxyz 5 0 0)) (make-box (xyz 4 -1 -1) (xyz 7 2 2))))) ; expect: 27.0
(displayln (volume (hull (intersect (hull carved) (make-box origin (xyz 1 1 1))) (xyz 0 0 2)))) ; expect: 1.3333333333333333
(displayln (volume (subtract (hull carved origin) (make-box origin (xyz 1 1 1))))) ; expect: 6.833333333333333

; placements: exact quarter turns, factors and sizes that flatten are refused
(define brick (make-box (xyz 1 0 0) (xyz 4 2 1)))
(displayln (bounding-box (rotate brick 'z pi/2)))    ; expect: ((xyz -2 1 0) (xyz 0 4 1))
(displayln (bounding-box (rotate (rotate brick 'x (/ pi 2)) 'y (* 3 pi/2)))) ; expect: ((xyz -2 -1 1) (xyz 0 0 4))
(displayln (bounding-box (do-rotate brick (xyz 1 0 0) (vxyz 0 0 1) pi))) ; expect: ((xyz -2 -2 0) (xyz 1 0 1))
(displayln (bounding-box (do-mirror brick 'yz)))     ; expect: ((xyz -4 0 0) (xyz -1 2 1))
(displayln (bounding-box (do-scale brick (xyz 1 0 0) '(2 1 3)))) ; expect: ((xyz 1 0 0) (xyz 7 2 3))
(displayln (bounding-box (do-scale brick (vxyz 2 2 2)))) ; expect: ((xyz 2 0 0) (xyz 8 4 2))
(displayln (bounding-box (do-resize brick 6 #f #f))) ; expect: ((xyz 1 0 0) (xyz 7 4 2))
(displayln (bounding-box (do-resize brick 6 2 #f)))  ; expect: ((xyz 1 0 0) (xyz 7 2 1.4142135623730951))
(displayln (bounding-box (do-resize (rotate (make-sphere origin 1) 'z 1) 1 2 3))) ; expect: ((xyz -1 -1 -1) (xyz 0 1 2))
(displayln (volume (do-transform brick (make-matrix 1 1 0 0 0 1 0 0 0 0 -2 0 0 0 0 1)))) ; expect: 12.0
(fails (do-scale brick '(1 0 1)))                    ; expect: do-scale: factor must be positive, got ((1 0 1))
(fails (do-scale brick -1))                          ; expect: do-scale: factor must be positive, got (-1)
(fails (do-scale brick '(1 2)))                      ; expect: do-scale: factor must be a number, a list of three numbers or a gvector, got ((1 2))
(fails (do-resize brick 0 #f #f))                    ; expect: do-resize: dx must be positive, or #f, got (0)
(fails (do-resize brick #f -2 #f))                   ; expect: do-resize: dy must be positive, or #f, got (-2)
(fails (do-resize brick #f #f #f))                   ; expect: do-resize: one of dx, dy, dz must be a number ()
(fails (do-resize (make-circle origin 1) #f #f 2))   ; expect: do-resize: dz must be #f: the object is flat in that direction, got (2)
(fails (do-transform brick (make-matrix 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1))) ; expect: do-transform: matrix must be a matrix that does not flatten space, got ((make-matrix 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1))
(fails (do-move brick (xyz 1 0 0)))                  ; expect: do-move: v must be a gvector ((vxyz 1 0 0)?), got ((xyz 1 0 0))
(fails (do-mirror brick 'up))                        ; expect: do-mirror: plane must be a plane ('xy, 'yz, 'xz, a gvector or (make-plane point normal)), got (up)
; a half-space joins nothing but what it cuts: elsewhere a turned part keeps its frame, and its flush cut leaves nothing
(define beside-a-slice
  (unite (do-slice (make-box (xyz -12 -2 -2) (xyz -8 2 2)) (make-plane (xyz -10 0 0) (vxyz 1 1 1)))
         (do-rotate (subtract (make-box (xyz -2 -2 -2) (xyz 2 2 2)) (make-box (xyz -1 -2 -2) (xyz 1 2 1))) (vxyz 1 2 3) 0.4)))
(displayln (list (near? (volume beside-a-slice) 72 1e-6) (near? (area beside-a-slice) (+ 108 (/ 96 2) (* 12 (sqrt 3))) 1e-5))) ; expect: (#t #t)
; what is cut is resized by its own bounds, not by those of what it was cut from
(define short (subtract (make-box (xyz 0 0 0) (xyz 4 1 1)) (make-box (xyz 3 -1 -1) (xyz 5 2 2))))
(displayln (bounding-box (do-resize short 6 #f #f))) ; expect: ((xyz 0 0 0) (xyz 6 2 2))
(displayln (empty-object? (do-resize (empty-object) 6 #f #f))) ; expect: #t
(displayln (bounding-box (do-resize (intersect (make-box origin 1 1 1) (make-box (xyz 5 5 5) 1 1 1)) 6 #f #f))) ; expect: #f
; a hull of points alone, placed before anything has asked for its bounds
(displayln (bounding-box (do-move (hull origin (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) (vxyz 1 0 0)))) ; expect: ((xyz 1 0 0) (xyz 2 1 1))
; a scope's object that a plane cuts
(define cut-sheet (do-thicken (do-slice (make-3dface (xyz -2 -2 0) (xyz 2 -2 0) (xyz 2 2 3) (xyz -2 2 3)) 'yz) 1/8))
(displayln (solid? (scope-place (make-box-scope origin 1 1 1) cut-sheet))) ; expect: #t
