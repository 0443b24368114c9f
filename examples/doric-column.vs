; A Doric column with parameters, to be drawn or to be fitted to a scan.
;
; What it teaches: define-parameter gives a model numbers that others may set: -D on the command line, the sliders of the live
; view, and vs fit, which finds the ones of a column that was scanned. Defaults with a point (5.0) are real numbers, which
; a fit may change.

(define-parameter height 5.0 #:min 1 #:max 20 #:label "height of the shaft")
(define-parameter foot-radius 0.5 #:min 0.1 #:max 2 #:label "radius of the shaft at its foot")
(define-parameter neck-radius 0.4 #:min 0.1 #:max 2 #:label "radius of the shaft at its neck")
(define-parameter echinus-height 0.3 #:min 0.05 #:max 2 #:label "height of the echinus")
(define-parameter abacus-side 1.3 #:min 0.2 #:max 5 #:label "side of the abacus")
(define-parameter abacus-height 0.25 #:min 0.05 #:max 2 #:label "height of the abacus")

; The shaft swells a little on its way up: its outline is an arc of a parabola.
(define entasis 0.02)
(define (shaft-radius t)
  (+ foot-radius (* t (- neck-radius foot-radius)) (* 4 entasis foot-radius t (- 1 t))))
(define shaft-steps 12)
(define (shaft n)
  (let ([t (/ n shaft-steps)] [u (/ (+ n 1) shaft-steps)])
    (make-cut-cone (xyz 0 0 (* t height)) (shaft-radius t) (xyz 0 0 (* u height)) (shaft-radius u))))

; The step that it stands on belongs to the foot.
(define (step)
  (let ([half (* 1.4 foot-radius)])
    (make-box (xyz (- half) (- half) (* -0.5 foot-radius)) (xyz half half 0))))

(define (echinus)
  (make-cut-cone (xyz 0 0 height) neck-radius (xyz 0 0 (+ height echinus-height)) (* 0.48 abacus-side)))

(define (abacus)
  (let ([half (/ abacus-side 2)] [bottom (+ height echinus-height)])
    (make-box (xyz (- half) (- half) bottom) (xyz half half (+ bottom abacus-height)))))

(draw (with-material plaster
        (unite (step) (unite (map shaft (iota shaft-steps))) (echinus) (abacus))))

(ground (* -0.5 foot-radius) #:material grass)
(sun #:azimuth 222 #:altitude 36)
(camera (xyz 3.6 -8.4 1.6) (xyz 0 0 2.85) #:lens 36 #:upright #t)
