; A roof of one NURBS surface, glazed with diamonds, and the report that its builder asks for.
(define-parameter nu 10 #:min 4 #:max 30 #:label "panels along")
(define-parameter nv 6 #:min 4 #:max 20 #:label "panels across")

; control points: the middle is high, two corners come down to the ground
(define rows
  (list (list (xyz 0 0 0.4) (xyz 0 6 5) (xyz 0 12 7) (xyz 0 18 4))
        (list (xyz 10 0 7) (xyz 10 6 9) (xyz 10 12 9) (xyz 10 18 6))
        (list (xyz 20 0 6) (xyz 20 6 9) (xyz 20 12 8) (xyz 20 18 7))
        (list (xyz 30 0 4) (xyz 30 6 7) (xyz 30 12 5) (xyz 30 18 0.4))))
(define roof (nurbs-surface-function rows))
(define grid (diamond-grid nu nv))

(draw (with-material 'glass (panelise roof grid (lambda (corners) (panel-plate corners 0.05 #:gap 0.05)))))
(draw (with-material 'steel (panelise roof grid (lambda (corners) (do-thicken (make-polygon corners) 0.14)))))
(for-each
  (lambda (u v) (let ((foot (roof u v))) (draw (with-material 'steel (make-cylinder (xyz (cx foot) (cy foot) 0) foot 0.18)))))
  '(0.02 0.02 0.5 0.5 0.98 0.98) '(0.5 0.98 0.02 0.98 0.02 0.5))

(define report (panel-report roof grid #:tolerance 0.01))
(define (fact name) (cdr (assq name report)))
(printf "~a panels of ~a kinds; ~a leave their plane by more than 10 mm, at most ~a mm; the longest edge is ~a m\n"
  (fact 'panels) (fact 'kinds) (fact 'bent) (round (* 1000 (fact 'worst))) (/ (round (* 100 (fact 'longest))) 100))

; a paved place under it, and people
(draw (with-material 'concrete (make-box (xyz -2.4 -3.6 -0.12) (xyz 32.4 21.6 0))))
(define (stand what x y turn) (do-move (do-rotate what 'z (degrees->radians turn)) (vxyz x y 0)))
(define (walker coat height) (prefab "person" #:coat coat #:height height #:stride 0.18))
(draw (stand (walker "#5a6470" 1.76) 21 -2.4 70) (stand (walker "#8c4a3a" 1.64) 22 -2.1 75) (stand (walker "#c9b68f" 1.8) 13 5 -30)
      (stand (walker "#39708a" 1.7) 25 8 200) (stand (walker "#5b4a5e" 1.68) 9 2 20) (stand (walker "#4f5d4a" 1.74) 27.5 -2.5 -150))
(ground -0.12 #:material 'grass)
(sun #:azimuth 210 #:altitude 48)
(camera (xyz 45 -25 9.5) (xyz 15.5 8.6 2.6) #:lens 38)
