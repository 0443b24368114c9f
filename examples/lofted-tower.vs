; A tower that turns and narrows as it rises, by the loft of the VisualScheme thesis.
;
; What it teaches: the language extended by its users. The thesis adds to its system a loft given by procedures: f makes the section at x, step goes
; to the next x, stop? says when there is none. Here that is a primitive of this program: `define-primitive` gives its objects fields, which
; may be procedures, and `register-drawing-function` says what such an object becomes when the drawing is handed on. Until then it is
; an object as any other: it is moved, united, subtracted from. (The language has this one built in by now, as make-loft.)

(define-primitive tower f start step stop?)

(define (sections-of t)
  (unfold (tower-stop? t) (tower-f t) (tower-step t) (tower-start t)))

(register-drawing-function tower?
  (lambda (t) (do-ruled-loft (sections-of t))))

(define-parameter height 60 #:min 20 #:max 120)
(define-parameter turn 110.0 #:min 0 #:max 360 #:label "turn, degrees")

; The section at height z: a square with cut corners, the smaller and the more turned the higher it lies.
(define (storey size)
  (lambda (z)
    (let* ([t (/ z height)]
           [h (* size (- 1 (* 0.45 t t)))]
           [c (* 0.55 h)])
      (do-rotate (make-polygon (map (lambda (x y) (xyz x y z))
                                    (list h h c (- c) (- h) (- h) (- c) c)
                                    (list (- c) c h h c (- c) (- h) (- h))))
                 'z (* t (degrees->radians turn))))))

(define (rising size)
  (make-tower (storey size) 0 (lambda (z) (+ z 3)) (lambda (z) (> z height))))

; Glass within, and a slab at each floor.
(define (floors)
  (map (lambda (z) (do-extrude ((storey 10.4) z) 0.35)) (range 0 (+ height 1) 3)))

(draw (with-material glass (rising 9.6)))
(draw (with-material concrete (floors)))
(draw (with-material concrete (make-cylinder origin (+ height 1) 3)))

; The street it stands in: neighbours of white card, trees, passers-by, a car.
(define (stand o x y turn) (do-move (do-rotate o 'z (degrees->radians turn)) (vxyz x y 0)))
(define (neighbour x y wide deep high) (make-box (xyz x y 0) wide deep high))
(draw (with-material 'white
        (neighbour -58 22 30 24 24) (neighbour -22 40 26 22 15) (neighbour 20 34 24 26 21) (neighbour 50 20 30 30 30) (neighbour -64 -22 20 30 18)))
(define lime (prefab "tree" #:height 9.0 #:spread 0.35 #:forks 3 #:green "#5d6b47"))
(draw (map (lambda (x k turn) (do-move (do-rotate (do-scale lime k) 'z turn) (vxyz x -13 0))) '(-34 -26 -18 18 26 34 42) '(1 0.9 1.1 1 1.15 0.95 1.05) '(0 2 4 1 3 5 2.5))
      (map (lambda (x y turn) (stand (prefab "person" #:stride 0.2) x y turn)) '(9 10 24 -6 18) '(-22 -21.6 -34 -16 -17) '(80 100 -30 170 60)))
(ground 0 #:material 'paving)
(sun #:azimuth 230 #:altitude 35)
(camera (xyz 28 -60 1.6) (xyz 4 0 (* 0.5 height)) #:lens 22 #:upright #t)
