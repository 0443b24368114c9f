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
(ground 0 #:material concrete)
(sun #:azimuth 225 #:altitude 35)
(camera (xyz 84 -92 16) (xyz 7 0 (* 0.46 height)) #:lens 29)
