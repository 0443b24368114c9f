; A market hall's arcade, with its name on the wall.
;
; What it teaches: a primitive of your own. `bay` becomes a word of this program, with names and conditions for what it is given: (bay -3 5) is
; an error that says so. Its objects know what they were made with, so that other procedures can ask: the arcade puts a column under each
; spring of its bays, at the height that the bays tell it. Letters are regions like any other: they are extruded and stand on the wall.

(define thickness 0.8)

; A stretch of wall with a round arch in it; width from axis to axis, spring the height at which the arch begins.
(define-primitive (bay [width positive?] [spring positive?] [rise positive? 1.4])
  (let* ([radius (* 0.42 width)]
         [top (+ spring radius rise)]
         [wall (make-box (xyz (/ width -2) 0 spring) (xyz (/ width 2) thickness top))])
    (subtract wall
              (make-cylinder (xyz 0 -1 spring) (xyz 0 (+ thickness 1) spring) radius))))

(define (bay-top b)
  (cz (cadr (bounding-box b))))

(define (column foot height)
  (let ([r 0.26])
    (unite (make-box (+xyz foot -0.42 -0.42 0) (+xyz foot 0.42 0.42 0.25))
           (make-cut-cone (+z foot 0.25) r (+z foot (- height 0.55)) (* 0.86 r))
           (make-cut-cone (+z foot (- height 0.55)) (* 0.86 r) (+z foot (- height 0.2)) 0.42)
           (make-box (+xyz foot -0.42 -0.42 (- height 0.2)) (+xyz foot 0.42 0.42 height)))))

; n bays side by side, and what carries them. Whatever kind of bay it is: it is asked for its width and spring.
(define (arcade b n)
  (let ([width (bay-width b)])
    (unite (map (lambda (i) (do-move b (vxyz (* (+ i 0.5) width) 0 0))) (iota n))
           (map (lambda (i) (column (xyz (* i width) (/ thickness 2) 0) (bay-spring b))) (iota (+ n 1)))
           (make-box (xyz -0.7 -0.25 (bay-top b)) (xyz (+ (* n width) 0.7) (+ thickness 0.25) (+ (bay-top b) 0.35))))))

(define-parameter bays 5 #:min 2 #:max 12)
(define one (bay 3.6 3.2))
(define length-of-all (* bays (bay-width one)))

(draw (with-material plaster (arcade one bays)))
(draw (color "#7a2f23"
  (do-move (do-rotate (do-extrude (make-text origin 0.75 "MERCADO MUNICIPAL" #:align 'center) 0.06) 'x pi/2)
           (vxyz (/ length-of-all 2) 0 (- (bay-top one) 1.1)))))
(draw (with-material stone (make-box (xyz -2 -1.5 -0.2) (xyz (+ length-of-all 2) 2.5 0))))

; who comes to the market
(define (stand o x y [turn any? 0] [z any? 0]) (do-move (do-rotate o 'z (degrees->radians turn)) (vxyz x y z)))
(draw (stand (prefab "person" #:stride 0.22) 4.6 -0.9 70) (stand (prefab "person" #:height 1.62 #:coat "#8c4a3a" #:stride 0.1) 9.4 -0.7 20)
      (stand (prefab "person" #:height 1.8 #:coat "#c9b68f" #:stride 0.15) 10.5 -1.25 -60) (stand (prefab "person" #:height 1.15 #:coat "#39708a" #:stride 0.3) 13.6 1.6 160))
(draw (stand (prefab "tree" #:height 9 #:seed 4) 0.5 13 0 -0.2) (stand (prefab "tree" #:height 8 #:seed 2) 17.5 12 0 -0.2))

(ground -0.2 #:material 'paving)
(sun #:azimuth 232 #:altitude 36)
(camera (xyz 3.2 -14.6 1.6) (xyz (- (/ length-of-all 2) 0.6) 0 3.6) #:lens 22 #:upright #t)
