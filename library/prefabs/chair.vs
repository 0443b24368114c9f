; A wooden chair that looks along -Y, its four legs on the ground about the origin.
(define-parameter seat-height 0.45 #:min 0.2 #:max 0.9 #:label "height of the seat, m")
(define-parameter height 0.86 #:min 0.5 #:max 1.6 #:label "height of the back, m")
(define-parameter width 0.42 #:min 0.25 #:max 1 #:label "width, m")
(define-parameter depth 0.42 #:min 0.25 #:max 1 #:label "depth, m")
(define-parameter splay 0.03 #:min 0 #:max 0.15 #:label "how far the legs lean out, m")
(define-parameter slats 4 #:min 0 #:max 9 #:label "slats in the back")
(define-parameter material "wood" #:label "material")

(define thick 0.035)
(define x (- (/ width 2) thick))
(define y (- (/ depth 2) thick))
(define lean (* 0.14 (- height seat-height))) ; how far the back leans at its top
(define top (max height (+ seat-height 0.1)))

(define (leg sx sy)
  (make-cut-cone (xyz (* sx (+ x splay)) (* sy (+ y splay)) 0) 0.013 (xyz (* sx x) (* sy y) (- seat-height (* 0.5 thick))) 0.019))
(define legs (unite (leg -1 -1) (leg 1 -1) (leg -1 1) (leg 1 1)))

; The seat: a rounded plate, hollowed a little where one sits.
(define plate
  (do-move (do-extrude (do-offset (make-rectangle (xy (- 0.03 (/ width 2)) (- 0.03 (/ depth 2))) (xy (- (/ width 2) 0.03) (- (/ depth 2) 0.03))) 0.03 #:corners 'round) thick)
           (vxyz 0 0 (- seat-height thick))))
(define bowl (do-scale (make-sphere origin 1) origin (list (* 0.42 width) (* 0.4 depth) 0.012)))
(define seat (subtract plate (do-move bowl (vxyz 0 -0.01 seat-height))))

(define (rail z1 z2)
  (let ((shift (lambda (z) (* lean (/ (- z seat-height) (- top seat-height))))))
    (hull (map (lambda (z) (make-box (xyz (- (- x) 0.012) (+ y (shift z) -0.011) z) (xyz (+ x 0.012) (+ y (shift z) 0.011) (+ z 0.0001)))) (list z1 z2)))))
(define (post sx) (make-cut-cone (xyz (* sx x) y (- seat-height 0.02)) 0.018 (xyz (* sx x) (+ y lean) top) 0.014))
(define low (+ seat-height (* 0.14 (- top seat-height))))
(define high (- top 0.075))
(define (slat i)
  (let* ((sx (* x (- (* 2 (/ (+ i 1) (+ slats 1))) 1))) (at (lambda (z) (* lean (/ (- z seat-height) (- top seat-height))))))
    (make-cut-cone (xyz sx (+ y (at low)) low) 0.008 (xyz sx (+ y (at (+ high 0.02))) (+ high 0.02)) 0.008)))
(define back
  (unite (post -1) (post 1) (rail high (- top 0.01)) (rail low (+ low 0.03)) (map slat (iota slats))))
; Rungs between the legs.
(define (rung p q) (make-cylinder p q 0.009))
(define z 0.17)
(define (out s) (+ s (* splay (- 1 (/ z seat-height)))))
(define rungs
  (unite (rung (xyz (- (out x)) (- (out y)) z) (xyz (- (out x)) (out y) z)) (rung (xyz (out x) (- (out y)) z) (xyz (out x) (out y) z))
         (rung (xyz (- (out x)) 0 z) (xyz (out x) 0 z))))
(draw (with-material material legs seat back rungs))
