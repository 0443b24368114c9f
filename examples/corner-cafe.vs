; A corner cafe furnished with prefabs: models that are parts of others, each with parameters of its own.
;
; What it teaches: (prefab "chair" #:height 0.9) is an object like any other. The files lie in library/prefabs/, and a file of
; your own is called in the same way, by its name with .vs.
(define-parameter guests 3 #:min 0 #:max 4 #:label "guests")
(define-parameter door-opened 70 #:min 0 #:max 110 #:label "door opened by, degrees")

(define wall 0.3)
(define (at o x y [turn any? 0] [z any? 0]) (do-move (do-rotate o 'z (degrees->radians turn)) (vxyz x y z)))

; The house: a wall along X with openings, filled by a door and windows of the same sizes, and a gallery that a stair reaches.
(define (opening x z w h) (make-box (xyz x -1 z) (xyz (+ x w) 1 (+ z h))))
(define windows '(0.6 4.6 6.7))
(define house
  (subtract (make-box (xyz 0 0 0) (xyz 9 wall 3.4)) (opening 3 0 1 2.3) (map (lambda (x) (opening x 0.9 1.6 1.5)) windows)))
(define fillings
  (unite (at (prefab "door" #:width 1 #:height 2.3 #:wall wall #:opening door-opened #:panels 4) 3 0)
         (map (lambda (x) (at (prefab "window" #:width 1.6 #:height 1.5 #:wall wall #:bars 2) x 0 0 0.9)) windows)))
(define floor (make-box (xyz 0 0 -0.2) (xyz 9 6 0)))
(define room (unite (make-box (xyz 0 5.7 0) (xyz 9 6 3.4)) (make-box (xyz 0 wall 0) (xyz 0.3 5.7 3.4)) (make-box (xyz 8.7 wall 0) (xyz 9 5.7 3.4)) (make-box (xyz -0.2 -0.3 3.4) (xyz 9.2 6.2 3.62))))
(define steps (at (prefab "stair" #:height 3.62 #:width 1.1 #:rails "both") 9.15 0.6))

; A table with chairs that look at it, and a guest beside each of the first.
(define (table x y)
  (at (unite (make-cylinder (xyz 0 0 0.71) 0.03 0.42) (make-cylinder origin 0.71 0.03) (make-cut-cone origin 0.22 (xyz 0 0 0.04) 0.05)
             (at (prefab "vase" #:height 0.24 #:width 0.12 #:colour "#e8e4da") 0.05 0.1 0 0.74))
      x y))
(define (seats x y n)
  (map (lambda (i) (let ((phi (+ 0.5 (* i (/ 2pi n))))) (at (prefab "chair") (+ x (* 0.72 (cos phi))) (+ y (* 0.72 (sin phi))) (- (radians->degrees phi) 90)))) (iota n)))
(define terrace
  (map (lambda (p) (list (table (car p) (cdr p)) (seats (car p) (cdr p) 3))) '((1.4 . -2.2) (5.4 . -2) (7.9 . -2.9))))
(define people
  (take (list (at (prefab "person" #:stride 0.22) 3.4 -1.5 25) (at (prefab "person" #:height 1.64 #:coat "#8c4a3a" #:stride 0.05) 3.95 -2.6 130)
              (at (prefab "person" #:height 1.8 #:coat "#c9b68f") -0.6 -3.4 80) (at (prefab "person" #:height 1.1 #:coat "#39708a" #:stride 0.3) -1.1 -3.2 80))
        guests))

(draw (with-material 'plaster house room)
      (with-material 'stone (make-box (xyz -14 -4.4 -0.2) (xyz 24 0 0)) floor)
      (with-material 'asphalt (make-box (xyz -14 -11 -0.3) (xyz 24 -4.4 -0.12)))
      fillings steps terrace people
      (at (prefab "tree" #:height 7 #:seed 4) -2.4 -2.2) (at (prefab "tree" #:height 6 #:seed 2) 12.6 -2.4)
      (at (prefab "car" #:colour "#2f5d7c" #:steering 12) 9.4 -6.1 -90 -0.12))
(ground -0.3 #:material 'grass)
(sun #:azimuth 200 #:altitude 40)
(camera (xyz -2.4 -14.2 2.1) (xyz 5 -1 2.1) #:lens 29)
