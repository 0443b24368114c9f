; A screen of Voronoi cells before a glass wall: many small openings at the bottom, few large ones above.
(define-parameter count 150 #:min 20 #:max 600 #:label "cells")
(define-parameter seed 7 #:min 1 #:max 99)

(random-seed! seed)
(define wide 24)
(define high 12)
(define wall (make-rectangle (xy 0 0) (xy wide high)))
; heights are drawn so that low ones come more often
(define points (map (lambda (i) (xy (random-range 0.0 wide) (* high (expt (random-range 0.0 1.0) 1.8)))) (iota count)))
(define cells (remove empty-object? (voronoi points wall)))

; what is left of a cell between its frames is open; the smallest ones stay shut
(define wide-cells (filter (lambda (c) (> (area c) 0.12)) cells))
(define openings (remove empty-object? (map (lambda (c) (do-offset c -0.08)) wide-cells)))
(define screen (do-extrude (subtract wall openings) 0.35))

(define (stand o) (do-rotate o 'x pi/2))
(draw (with-material 'white (stand screen)))
(draw (with-material 'glass (stand (do-extrude (do-move wall (vxyz 0 0 -1)) 0.1))))
(draw (with-material 'concrete (make-box (xyz 0 1.1 0) (xyz wide 9 0.3)) (make-box (xyz 0 0.3 high) (xyz wide 9 (+ high 0.4)))
        (make-box (xyz 0 1.1 5.8) (xyz wide 9 6.1)) (make-box (xyz 0 8.7 0) (xyz wide 9 high))))

; passers-by, and trees of the square behind
(define (placed o x y turn) (do-move (do-rotate o 'z (degrees->radians turn)) (vxyz x y 0)))
(draw (placed (prefab "person" #:stride 0.2) 1 -9.5 80) (placed (prefab "person" #:coat "#8c4a3a" #:height 1.64) 13 -2.6 150)
      (placed (prefab "person" #:coat "#c9b68f") 13.9 -2.9 210) (placed (prefab "person" #:coat "#39708a" #:stride 0.25) 7 -5 -50)
      (placed (prefab "tree" #:height 9 #:seed 4) 29 -1 0) (placed (prefab "tree" #:height 8) 38 5 0))
(ground 0 #:material 'paving)
(sun #:azimuth 218 #:altitude 36)
(camera (xyz -5 -16.5 1.6) (xyz 10.5 0 6.8) #:lens 22 #:upright #t)
