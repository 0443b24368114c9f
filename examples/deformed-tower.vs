; A tower drawn straight, with every storey and mullion, and then bent as one by maps of space: twisted, and made slimmer.
(define-parameter storeys 24 #:min 6 #:max 40)
(define-parameter turn 90 #:min 0 #:max 270 #:label "twist, degrees")
(define-parameter slimmer 0.55 #:min 0.3 #:max 1)

(define height (* storeys 3.4))
(define side 16)
(define half (/ side 2))

(define (storey i)
  (let ((z (* i 3.4)))
    (list (with-material 'concrete (make-box (xyz (- half) (- half) z) (xyz half half (+ z 0.35))))
          (with-material 'glass (make-box (xyz (- 0.7 half) (- 0.7 half) (+ z 0.35)) (xyz (- half 0.7) (- half 0.7) (+ z 3.4)))))))

; one mullion from the ground to the top, at a place on the perimeter
(define (mullion x y) (with-material 'steel (make-box (xyz (- x 0.12) (- y 0.12) 0) (xyz (+ x 0.12) (+ y 0.12) height))))
(define along (map (lambda (x) (* 1.0 x)) (division (- half) half 8)))
(define mullions
  (append-map (lambda (x) (list (mullion x (- half)) (mullion x half) (mullion (- half) x) (mullion half x))) along))

(define top (xyz 0 0 height))
(define twist (twist-map origin top (degrees->radians turn)))
(define taper (taper-map origin top slimmer))
(define (bent p) (twist (taper p)))

(draw (do-deform (list (map storey (iota storeys)) mullions) bent))

; trees and people on the square before it, to see how high it is
(define lime (prefab "tree" #:height 9.0))
(define walker (prefab "person"))
(draw (map (lambda (x y k) (do-move (do-rotate (do-scale lime k) 'z k) (vxyz x y 0)))
           '(-46 -31 -20 22 31 44 58 -38 -26 38) '(4 14 24 16 6 20 8 34 -14 34) '(1 1.1 0.9 1 1.2 0.9 1.1 1 0.8 1))
      (map (lambda (x y) (do-move walker (vxyz x y 0))) '(20 21 30 6 -2 19 34) '(-24 -24.5 -47 -17 -19 -36 -30)))
; the town round it, in white card
(draw (with-material 'white
        (map (lambda (x y wide deep high) (make-box (xyz x y 0) wide deep high))
             '(-92 -60 -8 36 72 -90) '(30 64 78 52 22 -24) '(30 40 36 30 34 30) '(26 26 30 30 40 36) '(16 26 14 30 20 12))))
(ground 0 #:material 'paving)
(sun #:azimuth 225 #:altitude 35)
(camera (xyz 44 -66 1.6) (xyz 4 0 (* 0.5 height)) #:lens 22 #:upright #t)
