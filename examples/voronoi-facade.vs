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
(ground 0 #:material 'stone)
(sun #:azimuth 205 #:altitude 38)
(camera (xyz 32 -25 1.7) (xyz 12.5 0 5.4) #:lens 28)
