; The roof of the Gare do Oriente in Lisbon (Santiago Calatrava, 1998), after chapter 5 of the VisualScheme thesis.
;
; What it teaches: a large model from small procedures. Rods and panes make a roof plate; plates, beams and props make a quarter of a tree; four
; quarters make a tree; trees side by side make the station. Every procedure gets the points it needs, so the parts meet whatever
; the parameters are:
;
;   vs gare-do-oriente.vs -D rows=2 -D columns=6 -D rho=16.0 -o gare.html

(define-parameter columns 5 #:min 1 #:max 20 #:label "trees along the platforms")
(define-parameter rows 3 #:min 1 #:max 20 #:label "platforms")
(define-parameter rho 20.0 #:min 5 #:max 60 #:label "radius of the beams' arcs, metres")
(define-parameter bars 10 #:min 3 #:max 30 #:label "bars in a roof plate")
(define-parameter trunk 11.0 #:min 1 #:max 40 #:label "height of the trunks, metres")

(define psi0 (/ pi 8))    ; the beams' arcs begin at this elevation ...
(define psi1 pi/2)        ; ... and end at this one, where they run level
(define h0 1)             ; the roof's edges stand this much above its middle,
(define h1 3)             ; its corners this much

(define white-steel (make-material #:name "white steel" #:color "#eeece6" #:roughness 0.35))

; ---- the basic shapes ----

(define (rod p q radius) (make-cylinder p q radius #:segments 12))
(define (support-rod-medium p q) (rod p q 0.4))
(define (support-rod-small p q) (rod p q 0.2))

; A thin pane of glass between three points.
(define (triangle p q s)
  (with-material glass
    (do-thicken (make-region (make-line (list p q s p))) 0.05)))

; Rods between the points of two lists, pair by pair.
(define (rods ps qs)
  (map (lambda (p q) (rod p q 0.12)) ps qs))

; ---- the roof ----

; A pane and the bars under it. The lists leave out their first point: there both sides meet and a bar would have no length.
(define (roof-plate p q s n)
  (unite (rods (rest (line-sequence p q n))
               (rest (line-sequence p s n)))
         (triangle p q s)))

; ---- the beams ----

; An I with its web upright once the beam points in the direction phi.
(define (beam-base phi)
  (do-rotate
   (make-region
    (make-polygon (xy -1.3 -0.55) (xy -1 -0.55) (xy -1 -0.2) (xy 1 -0.2) (xy 1 -0.55) (xy 1.3 -0.55)
                  (xy 1.3 0.55) (xy 1 0.55) (xy 1 0.2) (xy -1 0.2) (xy -1 0.55) (xy -1.3 0.55)))
   'z phi))

; Centre of the arc that rises from the contact point pc and curves outwards in the direction phi.
(define (arc-centre pc phi)
  (+cil pc (* rho (cos psi0)) phi (- (* rho (sin psi0)))))

; The beam follows the arc and tapers to half its size.
(define (arc-beam pc phi n)
  (do-sweep (beam-base phi)
            (make-spline (arc-sequence (arc-centre pc phi) rho (+ phi pi) psi0 psi1 n))
            0       ; no twist
            0.5))   ; scale at the end

; Props from the beam to the roof's two diagonals: equally spaced as seen from above, so that each stands below its bar.
(define (roof-support pc pr phi p1 p3 n)
  (map (lambda (b d1 d3)
         (list (rod b d1 0.12) (rod b d3 0.12)))
       (rest (linear-h-arc-sequence (arc-centre pc phi) rho (+ phi pi) psi0 psi1 n))
       (rest (line-sequence pr p1 n))
       (rest (line-sequence pr p3 n))))

; ---- a tree ----

(define reach (arc-width rho psi0 psi1))    ; how far a beam goes outwards
(define rise (arc-height rho psi0 psi1))    ; and upwards

(define (beams-and-roof pc n n-bars)
  (let ([pr (+z pc (- rise h0))])           ; middle of the roof
    (define (quarter phi)
      (let ([p0 (+cil pr reach phi h0)]     ; the roof's edge above the beam's end,
            [p1 (+cil pr (* (sqrt 2) reach) (+ phi pi/4) h1)]   ; the corners to both sides,
            [p2 (+cil pr reach (+ phi pi/2) h0)]                ; the next edge
            [p3 (+cil pr (* (sqrt 2) reach) (- phi pi/4) h1)])
        (unite (support-rod-medium pr p0)
               (support-rod-small pr p1)
               (roof-plate pr p0 p1 n-bars)
               (roof-plate pr p1 p2 n-bars)
               (arc-beam pc phi n)
               (roof-support pc pr phi p1 p3 n-bars))))
    (unite (map quarter (enumerate 0 2*pi 4))
           (rod pc pr 0.3))))

; The trunk carries the four beams at the contact point.
(define (tree p)
  (let ([pc (+z p trunk)])
    (unite (make-cut-cone p 1.9 (+z pc -1) 1.35)
           (make-cut-cone (+z pc -1) 1.35 (+z pc 1.6) 0.9)
           (beams-and-roof pc 30 bars))))

; ---- the station ----

(define width (* 2 reach))

(define roof
  (distribute-in-space tree (xyz 0 0 0) (xyz width width 0) columns rows 1))

; A platform under each row of trees, with a pale edge, and the tracks between them.
(define (platform row)
  (let ([y (* (+ row 0.5) width)] [length (* columns width)])
    (unite (with-material concrete (make-box (xyz -6 (- y 7) -1.1) (xyz (+ length 6) (+ y 7) 0)))
           (with-material white (make-box (xyz -6 (- y 6.6) 0) (xyz (+ length 6) (- y 6.2) 0.02)))
           (with-material white (make-box (xyz -6 (+ y 6.2) 0) (xyz (+ length 6) (+ y 6.6) 0.02))))))

(define (track y)
  (let ([length (* columns width)])
    (with-material steel
      (unite (make-box (xyz -40 (- y 0.8) -1.1) (xyz (+ length 40) (- y 0.68) -0.9))
             (make-box (xyz -40 (+ y 0.68) -1.1) (xyz (+ length 40) (+ y 0.8) -0.9))))))

(define (tracks row)
  (let ([y (* (+ row 0.5) width)])
    (unite (track (- y 9.5)) (track (+ y 9.5)))))

(draw (with-material white-steel roof))
(draw (unite (map platform (iota rows))))
(draw (unite (map tracks (iota rows))))

(units 'm)
(ground -1.1 #:material (make-material #:name "ballast" #:color "#8f8b84"))
(sun #:azimuth 222 #:altitude 38)
(camera (xyz -33 -30 6) (xyz 40 34 13) #:lens 26)
