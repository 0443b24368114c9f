; A pavilion grown from one formula: the gyroid, a surface without a straight line that parts space in two, kept within a
; flat dome and opened by a hall to walk through.
;
; What it teaches: functions of x, y and z are combined like solids, and rounded where they meet; `#:exact #t` gives POV-Ray the
; formula itself, so that a picture shows it without facets, while all other formats get the mesh.
(define-parameter cell 4.4 #:min 2 #:max 8 #:label "size of a cell, m")
(define-parameter thickness 0.42 #:min 0.2 #:max 0.8 #:label "thickness of the walls, m")
(define-parameter rim 0.5 #:min 0.05 #:max 1 #:label "how far rims are rounded, m")
(define-parameter fineness 110 #:min 40 #:max 220 #:step 10 #:label "cells along the longest side")

(define-function (dome x y z) (* 5 (- (sqrt (+ (square (/ x 8)) (square (/ y 6)) (square (/ z 5.5)))) 1)))
(define-function (hall x y z) (- (sqrt (+ (square y) (square z))) 2.4))
(define lattice (implicit-move (gyroid cell) (vxyz 0.5 0.3 0.4)))
(define-function (walls x y z) (- (abs (lattice x y z)) (/ thickness 2)))

(define form (implicit-smooth-difference rim (implicit-smooth-intersection rim walls dome) hall))
(define-function (ground-up x y z) (max (form x y z) (- z)))
(define pavilion (make-isosurface ground-up (xyz -8.2 -6.2 -0.2) (xyz 8.2 6.2 5.8) #:cells fineness #:exact #t))

(draw (with-material 'plaster pavilion))
(draw (with-material 'concrete (make-cylinder (xyz 0 0 -0.3) 0.3 10)))
(draw (do-move (prefab "person" #:turn 60 #:stride 0.2) (vxyz -7.6 -3.2 0)) (do-move (prefab "person" #:height 1.6 #:coat "#8c4a3a" #:turn -40) (vxyz 7.4 -4.4 0)))
(ground -0.3 #:material 'grass)
(sun #:azimuth 215 #:altitude 42)
(camera (xyz 13 -19 5) (xyz 0 0 2.1) #:lens 36)
