; A rotunda after the Pantheon in Rome, cut open so that one can look in.
;
; What it teaches: building by taking away. The outside is a few solids united. The inside is a solid too: the sphere and the drum of air
; that fill the room, the opening at the top, five rings of coffers, seven niches and the door. Subtracting the air from the mass gives the building;
; subtracting a wedge of space from that gives the section.
;
;   vs rotunda.vs -D open=0 -o rotunda.stl      the building whole, for printing

(define-parameter open 130.0 #:min 0 #:max 180 #:label "degrees of the circle cut away")
(define-parameter coffers 28 #:min 6 #:max 40 #:label "coffers in a ring")

(define r 21.65)          ; the room: a sphere of this radius touches the floor
(define wall 6)           ; thickness of the drum's wall
(define centre (xyz 0 0 r))

; ---- the mass ----

; The stepped rings around the foot of the dome hold it together.
(define (ring i)
  (let ([bottom (+ (* 1.36 r) (* i 1.05))])
    (make-cylinder (xyz 0 0 bottom) (xyz 0 0 (+ bottom 1.05)) (- (+ r 4.6) (* i 1.35)))))

(define mass
  (unite (make-cylinder (xyz 0 0 0) (* 1.36 r) (+ r wall))
         (make-cylinder (xyz 0 0 (* 0.62 r)) 0.7 (+ r wall 0.55))   ; two cornices
         (make-cylinder (xyz 0 0 (* 1.32 r)) 0.9 (+ r wall 0.6))
         (map ring (iota 6))
         (intersect (make-sphere (xyz 0 0 (* 0.55 r)) (* 1.535 r))        ; the dome's shallow outside
                    (make-cylinder (xyz 0 0 (* 1.3 r)) r (+ r 1)))))

; ---- the air ----

; A box of air that points from the middle of the sphere through its wall: elevation says how high, azimuth where.
(define (coffer elevation azimuth width height deep)
  (do-move (do-rotate (do-rotate (make-box (xyz (+ r deep -2) 0 0) 4 width height)
                                 'y (- elevation))
                      'z azimuth)
           (p->q origin centre)))

; Each ring of coffers is smaller than the one below; each coffer has a step inside it.
(define (coffer-ring i)
  (let* ([elevation (degrees->radians (+ 9 (* i 12.2)))]
         [width (* 0.74 (/ (* 2*pi r (cos elevation)) coffers))]
         [height (- 3.5 (* i 0.32))])
    (map (lambda (azimuth)
           (list (coffer elevation azimuth width height 1.2)
                 (coffer elevation azimuth (* 0.72 width) (* 0.72 height) 1.9)))
         (enumerate 0 2*pi coffers))))

; Niches in the drum, round and square by turns; the door is the one that goes through.
(define (niche i)
  (let ([azimuth (* i pi/4)])
    (if (even? i)
        (let ([p (pol (+ r 0.4) azimuth)])
          (unite (make-cylinder (+z p -0.01) 9.2 4)
                 (make-sphere (+z p 9.19) 4)))
        (do-rotate (make-box (xyz (+ r 0.2) 0 5) 8 7.6 10.02) 'z azimuth))))

(define door
  (make-box (xyz (- -2 r wall) -3.3 -0.01) (xyz (- 2 r) 3.3 11.5)))

(define air
  (list (make-sphere centre r)
        (make-cylinder (xyz 0 0 -0.01) (+ r 0.01) r)
        (make-cylinder (xyz 0 0 r) (* 2 r) 4.4)                            ; the eye
        (map coffer-ring (iota 5))
        (map niche '(0 1 2 3 5 6 7))
        door))

; ---- the porch ----

(define (column p)
  (unite (make-cylinder p 0.7 1.05)
         (make-cut-cone (+z p 0.7) 0.9 (+z p 12) 0.76)
         (make-cut-cone (+z p 12) 0.76 (+z p 13.2) 1.15)
         (make-box (+z p 13.5) 2.3 2.3 0.6)))

(define porch-x (- 0 r wall 13))

(define porch
  (unite (map (lambda (y) (column (xy (+ porch-x 1.3) y))) (division -15 15 7))
         (map (lambda (y) (column (xy (+ porch-x 7.3) y))) '(-15 -6.43 6.43 15))
         (make-box (xyz porch-x -16.4 13.8) (xyz (- 2 r) 16.4 16))
         ; the gable: a triangle drawn flat, raised upright, drawn out
         (do-extrude (make-region (make-polygon (xyz porch-x -17 16) (xyz porch-x 17 16) (xyz porch-x 0 23.2)))
                     (vxyz 17.6 0 0))))

; ---- the section ----

; What is cut away: a wedge of space around the vertical axis, seen from the camera.
(define wedge
  (if (= open 0)
      (empty-object)
      (let* ([half (degrees->radians (/ open 2))]
             [far 90]
             [spoke (lambda (a) (xyz (* far (cos a)) (* far (sin a)) -5))])
        (do-rotate (do-extrude (make-region
                                (make-polygon (cons (xyz 0 0 -5)
                                                    (map spoke (division (- half) half 8)))))
                               80)
                   'z (degrees->radians -72)))))

; Visitors, simple enough to show how high it is.
(define (at p aside ahead high) (+xyz p aside ahead high))
(define (legs p)
  (list (make-cut-cone (at p -0.08 0.1 0) 0.05 (at p -0.075 0 0.82) 0.085) (make-cut-cone (at p 0.08 -0.1 0) 0.05 (at p 0.075 0 0.82) 0.085)))
(define (coat p)
  (list (make-cut-cone (at p 0 0 0.72) 0.17 (at p 0 0 1.04) 0.145) (make-cut-cone (at p 0 0 1.04) 0.145 (at p 0 0 1.36) 0.19) (make-cut-cone (at p 0 0 1.36) 0.19 (at p 0 0 1.48) 0.07)
        (make-cut-cone (at p -0.24 0.05 0.84) 0.035 (at p -0.18 0 1.38) 0.06) (make-cut-cone (at p 0.24 -0.05 0.84) 0.035 (at p 0.18 0 1.38) 0.06)))
(define (head p)
  (list (make-cut-cone (at p 0 0 1.42) 0.06 (at p 0 0 1.56) 0.055) (make-sphere (at p 0 0.01 1.63) 0.092)))
(define (hair p)
  (make-sphere (at p 0 0.025 1.66) 0.093))

(draw (with-material plaster (subtract (unite mass (subtract porch (make-cylinder (xyz 0 0 -1) 60 (+ r 1))))
                                       air wedge)))
(draw (with-material stone (make-cylinder (xyz 0 0 -0.6) (xyz 0 0 0) (+ r wall 22))))
(define in-slate (list (xyz 4 2 0) (xyz -3 9 0) (xyz -1.2 -19.2 0) (xyz 7 -37 0)))
(define in-rust (list (xyz 5 2.6 0) (xyz 12 -9 0) (xyz 8 -17 0)))
(define in-sand (list (xyz -7 -6 0) (xyz -14.5 3 0) (xyz 2.6 -29 0)))
(define in-blue (list (xyz -8.2 -5 0) (xyz 13.2 -8.4 0) (xyz 1 -20 0)))
(define people (append in-slate in-rust in-sand in-blue))
(draw (color "#3b3f4a" (map legs people)) (color "#c99d7c" (map head people)) (color "#2a2320" (map hair people))
      (color "#5a6470" (map coat in-slate)) (color "#7d4a3e" (map coat in-rust)) (color "#b3a484" (map coat in-sand)) (color "#476b7c" (map coat in-blue)))

(units 'm)
(ground -0.6 #:material grass)
(sun #:azimuth 147 #:altitude 40)
(camera (xyz 13 -47 1.6) (xyz -2 0 19.5) #:lens 19 #:upright #t)
