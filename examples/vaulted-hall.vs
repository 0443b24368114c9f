; A hall under groin vaults, cut open along its first bay.
;
; What it teaches: space is a solid, too. A bay is what is empty: two barrels that cross, upon a box. All bays are taken out of one block, and
; the groins, the edges where two barrels meet, come by themselves. Bays meet face to face, and no wall stays between them. The ribs are half
; circles made longer across, as a groin is, by the square root of two.

(define-parameter bays-long 4 #:min 1 #:max 8)
(define-parameter bays-deep 3 #:min 1 #:max 6)
(define side 6)                 ; of a bay, from pier to pier
(define spring 4)               ; where the vaults begin
(define radius (/ side 2))
(define top (+ spring radius 0.6))
(define width (* bays-long side))
(define depth (* bays-deep side))

(define (over-bays f)           ; f of the middle of each bay, on the floor
  (for*/list ([i bays-long] [j bays-deep]) (f (xy (* side (+ i 1/2)) (* side (+ j 1/2))))))

(define (space c)
  (let ([crown (+z c spring)])
    (unite (make-cylinder (+x crown (- radius)) (+x crown radius) radius)
           (make-cylinder (+y crown (- radius)) (+y crown radius) radius)
           (make-box (+xy c (- radius) (- radius)) (+xyz c radius radius spring)))))

(define (ribs c)
  (for/list ([turn (list pi/4 (* 3 pi/4))])
    (let ([arch (do-rotate (do-thicken (make-arc origin radius 0 pi) 0.22) 'x pi/2)])
      (do-move (do-rotate (do-scale arch (list (sqrt 2) 1 1)) 'z turn) (p->q origin (+z c spring))))))

(define (pier p)
  (unite (make-prism p 0.46 8 (+z p spring))
         (make-prism p 0.62 8 (+z p 0.5))
         (make-pyramid (+z p (- spring 0.45)) 0.46 8 (+z p spring) 0.62)))

(define block (make-box (xyz -0.5 -0.5 -0.4) (xyz (+ width 0.5) (+ depth 0.5) top)))
(define (window c)              ; a round arch through a wall along X
  (unite (make-cylinder (+yz c -1 spring) (+yz c 1 spring) 1.1)
         (make-box (+xyz c -1.1 -1 1.2) (+xyz c 1.1 1 spring))))
(define windows
  (append (for/list ([i bays-long]) (window (xy (* side (+ i 1/2)) depth)))
          (for/list ([j bays-deep]) (do-rotate (window (xy (* side (+ j 1/2)) 0)) 'z pi/2))))
(define piers
  (for*/list ([i (+ bays-long 1)] [j (+ bays-deep 1)]) (pier (xy (* i side) (* j side)))))

(define hall
  (unite (subtract block (over-bays space) windows)
         (color "#d9c7a8" piers)
         (color "#c9b08a" (over-bays ribs))))

(draw (with-material plaster (do-slice hall (make-plane (xyz 0 (* 0.48 side) 0) uy))))

; a floor of stone, and visitors who show how high the vaults are
(draw (with-material 'limestone (make-box (xyz 0 (* 0.48 side) 0) (xyz width depth 0.01))))
(define (visitor x y turn height coat)
  (do-move (do-rotate (prefab "person" #:height height #:coat coat #:stride 0.15) 'z (degrees->radians turn)) (vxyz (* x width) (* y depth) 0.01)))
(draw (visitor 0.44 0.55 30 1.76 "#5a6470") (visitor 0.49 0.52 -60 1.64 "#8c4a3a") (visitor 0.69 0.7 170 1.7 "#c9b68f"))

(ground -0.4 #:material 'grass)
(sun #:azimuth 216 #:altitude 26)
(camera (xyz (* 0.64 width) (* 0.2 side) 1.6) (xyz (* 0.52 width) depth 3.6) #:lens 19 #:upright #t)
