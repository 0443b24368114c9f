; A small car that drives along -Y, its wheels on the ground about the origin.
(define-parameter length 4.1 #:min 2 #:max 8 #:label "length, m")
(define-parameter colour "#a33b2e" #:label "colour of the body")
(define-parameter steering 0.0 #:min -35 #:max 35 #:label "front wheels turned by, degrees")

; Drawn 4.1 m long and 1.72 m wide, then scaled.
(define radius 0.31)
(define axles '(-1.26 1.24))
(define (yz-points l) (map (lambda (p) (yz (first p) (second p))) l))
; A profile in the plane of symmetry, made thick across the car and narrower towards its top.
(define (across profile half)
  (do-extrude (do-move profile (vxyz (- half) 0 0)) (vxyz (* 2 half) 0 0)))
(define side
  (make-region
    (make-spline (yz-points '((-2.03 0.3) (-2.05 0.48) (-1.98 0.64) (-1.6 0.76) (-1.0 0.84) (0 0.9) (1 0.93) (1.7 0.92) (1.96 0.84) (2.04 0.6) (2.02 0.3))))
    (make-line (yz-points '((2.02 0.3) (1.9 0.19) (-1.9 0.19) (-2.03 0.3))))))
(define roof
  (make-region
    (make-spline (yz-points '((-1.02 0.8) (-0.62 1.14) (-0.18 1.39) (0.5 1.45) (1.15 1.37) (1.6 1.12) (1.86 0.86))))
    (make-line (yz-points '((1.86 0.86) (1.8 0.7) (-1 0.7) (-1.02 0.8))))))
; The plan: rounded corners and sides that bulge, and walls of the cabin that lean in.
(define plan
  (do-extrude (make-spline (append (map (lambda (p) (xy (first p) (second p))) '((0 -2.07) (0.6 -2.0) (0.82 -1.6) (0.86 0) (0.83 1.6) (0.66 1.99) (0 2.06) (-0.66 1.99) (-0.83 1.6) (-0.86 0) (-0.82 -1.6) (-0.6 -2.0) (0 -2.07)))) ) 2))
(define hull-of-cabin
  (do-loft (list (make-rectangle (xyz -0.8 -2 0.7) (xyz 0.8 2 0.7)) (make-rectangle (xyz -0.56 -2 1.5) (xyz 0.56 2 1.5)))))
(define arches (unite (map (lambda (y) (make-cylinder (xyz -1 y radius) (xyz 1 y radius) 0.37)) axles)))
(define body (subtract (intersect (across side 0.9) plan) arches))
(define cabin (intersect (across roof 0.9) hull-of-cabin))
; Glass shows through a skin of the cabin, between posts.
(define (pane points) (across (make-polygon (yz-points points)) 0.9))
(define side-panes
  (intersect (do-scale cabin (yz 0.3 1) (list 1.004 0.94 0.93))
             (unite (pane '((-0.72 0.93) (-0.2 1.32) (0.28 1.37) (0.28 0.93))) (pane '((0.36 0.95) (0.36 1.37) (1.05 1.3) (1.4 1.08) (1.5 0.97))))))
(define ends
  (intersect (do-scale cabin (yz 0.3 0.9) (list 0.93 1.006 1.002))
             (unite (make-box (xyz -0.66 -1.2 0.9) (xyz 0.66 -0.2 1.34)) (make-box (xyz -0.6 1.25 0.98) (xyz 0.6 2 1.3)))
             ))
(define (wheel x y turn)
  (let* ((out (if (< x 0) -1 1)) (a (* 0.09 out)))
    (do-rotate
      (unite (color "#20201f" (subtract (make-cylinder (xyz (- x a) y radius) (xyz (+ x a) y radius) radius) (make-cylinder (xyz (+ x (* 0.7 a)) y radius) (xyz (+ x (* 2 a)) y radius) 0.2)))
             (color "#c9cccf" (make-cylinder (xyz (+ x (* 0.5 a)) y radius) (xyz (+ x (* 0.78 a)) y radius) 0.2)
                    (make-sphere (xyz (+ x (* 0.78 a)) y radius) 0.05)))
      (xyz x y radius) uz (degrees->radians turn))))
(define wheels
  (unite (map (lambda (x) (list (wheel x (first axles) steering) (wheel x (second axles) 0))) '(-0.72 0.72))))
(define (both o) (unite o (do-mirror o (make-plane origin ux))))
; Lamps are discs set into a skin of the body.
(define (lamp x y z r) (intersect (do-scale (intersect (across side 0.9) plan) (xyz 0 0 0.55) 1.006) (do-scale (make-sphere (xyz x y z) r) (xyz x y z) '(1.5 3 1))))
(define lamps
  (unite (color "#f4f1e4" (both (lamp 0.6 -2 0.6 0.085)))
         (color "#8f1f1c" (both (lamp 0.64 2 0.72 0.09)))
         (color "#2a2b2d" (make-box (xyz -0.36 -2.06 0.34) (xyz 0.36 -1.9 0.46)) (make-box (xyz -0.7 -1.85 0.15) (xyz 0.7 1.85 0.3)))))
(define model (unite (color "#1d2328" side-panes ends) (color colour body cabin) lamps wheels))
(draw (do-scale model origin (/ length 4.1)))
