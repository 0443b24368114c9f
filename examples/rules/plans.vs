; A street of houses on floor plans: a rectangle, an L, a U, a hexagon, each with facades of one template in one of two styles, and trees
; between. After figure 20 of Krecklau, Pavic and Kobbelt (2010); the rules are our own.
;
; What it teaches: from a plan to a house. A plan's edges become the walls, which know their outer angles, so cornices meet at every corner.
;
;   vs plans.vs -o street.png --size 1280x720
(require "buildings.vs")
(require "trees.vs")

(define (plan x y . corners)
  (make-polygon-scope (apply make-polygon (map (lambda (c) (xy (+ x (car c)) (+ y (cadr c)))) corners))))
(define bar '((0 0) (14 0) (14 10) (0 10)))
(define ell '((0 0) (18 0) (18 9) (9 9) (9 20) (0 20)))
(define court '((0 0) (22 0) (22 16) (15 16) (15 7) (7 7) (7 16) (0 16)))
(define hexagon (map (lambda (i) (list (+ 9 (* 9 (cos (* i pi/3)))) (+ 8 (* 9 (sin (* i pi/3)))))) (range 0 6)))

(draw (building (apply plan 0 0 ell) old-style 16.5)
      (building (apply plan 24 0 bar) modern-style 13.5)
      (building (apply plan 44 2 hexagon) modern-style 19.5)
      (building (apply plan 68 0 court) old-style 13.5)
      (map (lambda (x) (planted x -5 3 lime-leaf no-fruit)) (range 2 90 11)))
; pavements and lots at 0, the road a kerb lower, with a line of dashes
(define (slab x0 x1 y0 y1 z) (make-box (xyz x0 y0 -0.5) (xyz x1 y1 z)))
(draw (with-material concrete (slab -60 160 -8 26 0) (slab -60 160 -26 -18 0))
      (color "#77776f" (slab -60 160 -18 -8 -0.15))
      (color "#f2f2ee" (map (lambda (i) (slab (* 8 i) (+ 3 (* 8 i)) -13.1 -12.9 -0.14)) (range -7 20))))
(draw (map (lambda (x) (planted x -21 3 oak-leaf no-fruit)) (range 30 110 12)))
(ground -0.5 #:material meadow)
(sun #:azimuth 232 #:altitude 40)
(camera (xyz -14 -34 13) (xyz 38 0 7) #:lens 25)
