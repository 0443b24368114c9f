; A pavilion grown from one formula: the gyroid, a surface without a straight line that parts space in two, kept within a
; flat dome and cut by a hall to walk through.
(define-parameter cell 3.2 #:min 2 #:max 6 #:label "size of a cell, m")
(define-parameter thickness 0.32 #:min 0.2 #:max 0.8 #:label "thickness of the walls, m")
(define-parameter fineness 110 #:min 40 #:max 220 #:step 10 #:label "cells along the longest side")

(define-function (dome x y z) (- (sqrt (+ (square (/ x 8)) (square (/ y 6)) (square (/ z 5.5)))) 1))
(define-function (whole x y z) (max (* 5 (dome x y z)) (- z)))
(define-function (hall x y z) (- (sqrt (+ (square y) (square z))) 2.3))

(define lattice (implicit-lattice whole (gyroid cell) thickness))
(define pavilion
  (make-isosurface (implicit-difference lattice hall) (xyz -8.2 -6.2 -0.2) (xyz 8.2 6.2 5.8) #:cells fineness))

(draw (with-material 'plaster pavilion))
(draw (with-material 'concrete (make-cylinder (xyz 0 0 -0.3) 0.3 10)))
(ground -0.3 #:material 'grass)
(sun #:azimuth 215 #:altitude 42)
(camera (xyz 19 -17 8) (xyz 0 0 1.6) #:lens 36)
