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

(units 'm)
(ground -2.2 #:material grass)
(sun #:azimuth 205 #:altitude 36)
(camera (xyz 118 -168 20) (xyz 2 0 57) #:lens 33)
