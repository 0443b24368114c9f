; A facade whose panels are the rows of a table, as a spreadsheet saves it: data/panels.csv. Each row says which column and storey a panel fills, of which
; kind it is, how much of it is open, how far it leans (in degrees) and its colour. Change the table, and run this again.

(define width 1.5)
(define height 3.2)
(define thickness 0.12)

(define panels (load-csv "data/panels.csv"))

; the middle of a panel's place in the wall
(define (place panel)
  (xyz (* width (+ (data-ref panel 'column) 1/2)) 0 (* height (+ (data-ref panel 'storey) 1/2))))

; A box about the point p, which is its centre
(define (slab p dx dy dz) (make-box p dx dy dz))

; a frame around a hole: the share of the panel that is open
(define (pierced p open)
  (let ([side (sqrt open)] [w (- width 0.1)] [h (- height 0.1)])
    (subtract (slab p w thickness h) (slab p (* side w 0.9) 1 (* side h 0.9)))))

(define (louvre p)
  (unite (for/list ([i 9])
    (do-rotate (slab (+z p (* 0.34 (- i 4))) (- width 0.1) 0.3 0.04) p ux (degrees->radians 0)))))

(define (panel-object panel)
  (let ([p (place panel)] [open (data-ref panel 'opening)] [kind (data-ref panel 'kind)])
    (do-rotate
      (cond [(equal? kind "glass") (with-material glass (slab p (- width 0.08) 0.04 (- height 0.08)))]
            [(equal? kind "louvre") (with-material wood (louvre p))]
            [(equal? kind "door") (with-material wood (pierced p 0.35))]
            [else (color (data-ref panel 'colour) (pierced p (* 0.6 open)))])
      p uz (degrees->radians (data-ref panel 'tilt)))))

; what stands behind: floors and posts, as many as the table needs
(define columns (+ 1 (apply max (map (lambda (panel) (data-ref panel 'column)) panels))))
(define storeys (+ 1 (apply max (map (lambda (panel) (data-ref panel 'storey)) panels))))

(define (floor-slab level)
  (make-box (xyz 0 0.5 (- (* level height) 0.15)) (xyz (* columns width) 6 (+ (* level height) 0.15))))
(define (post i)
  (make-cylinder (xyz (* i 3 width) 1.2 0) (* storeys height) 0.18))

(draw (map panel-object panels))
(draw (with-material concrete
  (map floor-slab (iota (+ storeys 1)))
  (map post (iota (+ 1 (quotient columns 3))))))

(printf "~a panels, ~,1f m2 of them open~%" (length panels)
  (apply + (map (lambda (panel) (* 0.6 (data-ref panel 'opening) width height)) panels)))

; the back wall and the core, the ground floor's people and a tree
(draw (with-material 'white-concrete (make-box (xyz 0 5.8 0) (xyz (* columns width) 6 (* storeys height)))
        (make-box (xyz 6 3.4 0) (xyz 10 5.8 (+ 2.4 (* storeys height))))))
(define (stand o x y [turn any? 0]) (do-move (do-rotate o 'z (degrees->radians turn)) (vxyz x y -0.15)))
(draw (stand (prefab "person" #:stride 0.25) 2 -4 80) (stand (prefab "person" #:height 1.62 #:coat "#8c4a3a" #:stride 0.15) 9.5 -3 -60)
      (stand (prefab "tree" #:height 9 #:seed 4) -5 -1) (stand (prefab "tree" #:height 8 #:seed 2) 20.5 -2))
(ground -0.15 #:material 'paving)
(sun #:azimuth 228 #:altitude 40)
(camera (xyz -2 -27 1.6) (xyz 8 2 10.4) #:lens 23 #:upright #t)
