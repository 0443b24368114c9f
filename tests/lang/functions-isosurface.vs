; Solids of functions: closed forms, sharp corners, caps, and what cannot be contoured.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (within? a b share) (<= (abs (- a b)) (* share (abs b))))
(define-function (ball x y z) (- (+ (square x) (square y) (square z)) 1))
(define corner (xyz 1.5 1.5 1.5))
(define other (xyz -1.5 -1.5 -1.5))
(define s (make-isosurface ball other corner #:cells 64))
(displayln (and (solid? s) (within? (volume s) (* 4/3 pi) 0.002)))     ; expect: #t
(displayln (within? (volume (make-isosurface ball other corner #:level 3 #:tolerance 0.01)) (* 4/3 pi 8) 0.3)) ; expect: #t
; expect warning 11: the box cuts the solid of f; its sides close it
(define c (make-isosurface ball other corner #:tolerance 0.0005))
(displayln (within? (volume c) (* 4/3 pi) 0.001))                      ; expect: #t
; corners
(define-function (block x y z) (max (- (abs x) 0.7) (- (abs y) 0.61) (- (abs z) 0.53)))
(define b (make-isosurface block (xyz -1 -1 -1) (xyz 1 1 1) #:cells 21))
(displayln (near? (bounding-box b) (list (xyz -0.7 -0.61 -0.53) (xyz 0.7 0.61 0.53)) 1e-3)) ; expect: #t
(displayln (near? (volume b) (* 8 0.7 0.61 0.53) 1e-3))                ; expect: #t
; flat sides are few triangles, and what bends more has more of them
(define (faces-of o) (length (second (object-arguments o))))
(displayln (< (faces-of (make-isosurface block (xyz -1 -1 -1) (xyz 1 1 1) #:cells 100)) 40)) ; expect: #t
(define-function (pin x y z) (min (- (sqrt (+ (square x) (square y) (square z))) 0.8) (max (- (sqrt (+ (square (- x 0.9)) (square y))) 0.02) (- (abs z) 0.5))))
(define pinned (make-isosurface pin other corner #:tolerance 0.003))
(displayln (and (solid? pinned) (< (faces-of pinned) 12000)))          ; expect: #t
; a lattice, capped at the box: half of it, whose cells have ambiguous faces
(define-function (gyroid x y z) (+ (* (sin x) (cos y)) (* (sin y) (cos z)) (* (sin z) (cos x))))
(define lattice (make-isosurface gyroid origin (xyz 2pi 2pi 2pi) #:cells 24)) ; expect warning: the box cuts the solid of f
(displayln (and (solid? lattice) (within? (volume lattice) (* 0.5 (expt 2pi 3)) 0.01))) ; expect: #t
; sheets that touch in a point of a cell's face: a checkerboard of cubes
(define-function (checks x y z) (* (sin x) (sin y) (sin z)))
(define board (make-isosurface checks (xyz 0.1 0.1 0.1) (xyz 6.2 6.3 6.4) #:cells 13)) ; expect warning: the box cuts the solid of f
(displayln (solid? board))                                             ; expect: #t
(displayln (near? (volume (subtract (make-box (xyz -1 -1 -1) (xyz 1 1 1)) b)) (- 8 (* 8 0.7 0.61 0.53)) 1e-3)) ; expect: #t
; refusals
(fails (make-isosurface ball (xyz 2 2 2) (xyz 3 3 3)))        ; expect: make-isosurface: f is nowhere below the level in the box, or only in parts smaller than a cell
(fails (make-isosurface ball corner other))                   ; expect: make-isosurface: q must be a corner beyond p along each axis, got (xyz -1.5 -1.5 -1.5)
(fails (make-isosurface ball other corner #:cells 1000000))   ; expect: make-isosurface: cells must be from 2 to 1024, got 1000000
(fails (make-isosurface (lambda (x y z) x) other corner))     ; expect: make-isosurface: f must be a function that keeps its expression, made by define-function, got #<procedure>
(define-function (flat x y) (+ x y))
(fails (make-isosurface flat other corner))                   ; expect: make-isosurface: f must be a function of 3 numbers, flat has 2
(define-function (rooted x y z) (+ x (sqrt y) z))
(fails (make-isosurface rooted other corner))                 ; expect: make-isosurface: f has no value at (xyz -1.476190476190476 -1.476190476190476 -1.476190476190476), which lies in the box
(define-function (pole x y z) (+ (/ 1 x) (* 0.01 y z)))
(guard (c ((error-object? c) (displayln (string-contains? (condition/report-string c) "f has a pole near (xyz "))))
  (make-isosurface pole other corner #:cells 11)) ; expect: #t
(fails (make-isosurface ball other corner #:level 'low))      ; expect: make-isosurface: level must be a number, got low
