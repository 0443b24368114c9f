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

; The town round it in white card, poplars along the street, and people to show its size.
(define (poplar x y)
  (unite (make-cut-cone (xyz x y -2.2) 0.6 (xyz x y 2.5) 1.7) (make-cut-cone (xyz x y 2.5) 1.7 (xyz x y 11) 0.2)))
(define (figure x y)
  (unite (make-cut-cone (xyz x y -2.2) 0.28 (xyz x y -0.75) 0.15) (make-sphere (xyz x y -0.6) 0.13)))
(draw (with-material white
        (map (lambda (x y wide deep high) (make-box (xyz x y -2.2) wide deep high))
             '(-110 -62 -8 44 86 -120) '(40 76 84 62 30 -30) '(36 40 38 32 40 44) '(30 28 30 40 50 40) '(22 34 18 40 27 16))))
(define leaves (make-material #:name "leaves" #:color "#4c6136" #:roughness 1 #:pattern 'mottled #:pattern-size 0.5 #:pattern-color "#33441f"))
(draw (with-material leaves (map poplar '(-70 -60 -50 52 60 68 76 84) '(-26 -26 -26 -26 -26 -26 -26 -26))))
(draw (color "#3d4653" (map figure '(40 41 28 24 8 14 62) '(-52 -52.6 -64 -46 -50 -63 -50))))

(units 'm)
(ground -2.2 #:material 'paving)
(sun #:azimuth 215 #:altitude 36)
(camera (xyz 64 -116 -0.6) (xyz 6 0 62) #:lens 22 #:upright #t)
