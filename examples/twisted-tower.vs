; A tower whose floors turn as they rise.
;
; What it teaches: shapes from formulas. A profile is a list of points computed by a procedure; `extrude` gives it a height and may twist it
; on the way; a list of floors is made by counting. Three parameters describe the whole tower:
;
;   vs twisted-tower.vs -D floors=30 -D turn=90 -o tower.html

(define-parameter floors 34 #:min 3 #:max 120 #:label "number of floors")
(define-parameter turn 120.0 #:min -360 #:max 360 #:label "turn from foot to top, degrees")
(define-parameter side 32.0 #:min 10 #:max 60 #:label "width of a floor, metres")

(define storey 3.6)
(define height (* floors storey))
(define total-turn (degrees->radians turn))

; A square with soft corners: the curve |x|^4 + |y|^4 = r^4, point by point.
(define (soft-square radius)
  (define (power v) (* (if (< v 0) -1 1) (sqrt (abs v))))
  (make-region
   (make-polygon
    (map (lambda (a) (xy (* radius (power (cos a))) (* radius (power (sin a)))))
         (enumerate 0 2*pi 72)))))

; Floor i: a slab that stands out from the glass, turned by its share of the whole turn.
(define (slab i)
  (do-move (do-rotate (do-extrude (soft-square (/ side 2)) 0.5)
                      'z (* total-turn (/ i floors)))
           (vxyz 0 0 (* i storey))))

; The glass is one solid from foot to top; it twists through the same angle.
(define skin
  (do-extrude (soft-square (* side 0.46)) height #:twist total-turn))

; Round columns lean along with the turning corners: a circle swept along a curve through points.
(define (column corner)
  (do-sweep (make-circle (xy 0 0) 0.4)
            (make-spline
             (map (lambda (t) (cil (* side 0.572) (+ corner (* t total-turn)) (* t height)))
                  (division 0 1 24)))))

(draw (with-material concrete (unite (map slab (iota (+ floors 1))))))
(draw (with-material white (unite (map column (enumerate pi/4 (+ 2pi pi/4) 4)))))
(draw (with-material (make-material #:name "tinted glass" #:color "#7fa6b4" #:roughness 0.05 #:metallic 0.35) skin))

; An entrance hall, and a plaza around it.
(draw (with-material plaster (make-cylinder (xyz 0 0 0) (xyz 0 0 -1.2) (* side 1.3))))
(draw (with-material stone (make-cylinder (xyz 0 0 -1.2) (xyz 0 0 -2.2) (* side 1.6))))

; The town round it in white card, limes clipped to boxes along the street, and people to show its size.
(define (lime x y)
  (make-box (xyz (- x 2.2) (- y 2.2) 0.6) (xyz (+ x 2.2) (+ y 2.2) 3.8)))
(define (stem x y)
  (make-cut-cone (xyz x y -2.2) 0.2 (xyz x y 0.7) 0.14))
(define (at p aside ahead high) (+xyz p aside ahead (- high 2.2)))
(define (legs p)
  (list (make-cut-cone (at p -0.08 0.1 0) 0.05 (at p -0.075 0 0.82) 0.085) (make-cut-cone (at p 0.08 -0.1 0) 0.05 (at p 0.075 0 0.82) 0.085)))
(define (coat p)
  (list (make-cut-cone (at p 0 0 0.72) 0.17 (at p 0 0 1.04) 0.145) (make-cut-cone (at p 0 0 1.04) 0.145 (at p 0 0 1.36) 0.19) (make-cut-cone (at p 0 0 1.36) 0.19 (at p 0 0 1.48) 0.07)))
(define (head p)
  (list (make-cut-cone (at p 0 0 1.42) 0.06 (at p 0 0 1.56) 0.055) (make-sphere (at p 0 0.01 1.63) 0.092)))
(define (hair p)
  (make-sphere (at p 0 0.025 1.66) 0.093))
(draw (with-material white
        (map (lambda (x y wide deep high) (make-box (xyz x y -2.2) wide deep high))
             '(-110 -62 -8 44 86 -120) '(40 76 84 62 30 -30) '(36 40 38 32 40 44) '(30 28 30 40 50 40) '(22 34 18 40 27 16))))
(define leaves (make-material #:name "leaves" #:color "#56643f" #:roughness 1 #:pattern 'mottled #:pattern-size 0.35 #:pattern-color "#37442a"))
(define limes-x '(-74 -64 -54 -44 44 54 64 74))
(draw (with-material leaves (map (lambda (x) (lime x -40)) limes-x)) (color "#6b5443" (map (lambda (x) (stem x -40)) limes-x)))
(define in-slate (list (xyz 40 -52 0) (xyz 8 -50 0)))
(define in-rust (list (xyz 41 -52.6 0) (xyz 53.2 -92.5 0)))
(define in-sand (list (xyz 28 -64 0) (xyz 52 -92 0)))
(define people (append in-slate in-rust in-sand))
(draw (color "#3b3f4a" (map legs people)) (color "#c99d7c" (map head people)) (color "#2a2320" (map hair people))
      (color "#5a6470" (map coat in-slate)) (color "#7d4a3e" (map coat in-rust)) (color "#b3a484" (map coat in-sand)))

(units 'm)
(ground -2.2 #:material 'paving)
(sun #:azimuth 215 #:altitude 36)
(camera (xyz 64 -116 -0.6) (xyz 6 0 62) #:lens 22 #:upright #t)
