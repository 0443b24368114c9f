; The roof of the Gare do Oriente in Lisbon (Santiago Calatrava, 1998), built as chapter 5 of the VisualScheme thesis builds it.
;
; What it teaches: a large model from small procedures. Rods and panes make a roof plate; plates, beams and props make a quarter of a tree; four
; quarters make a tree; trees side by side make the station. Every procedure gets the points it needs, so the parts meet whatever
; the parameters are. The procedures are listings 5.1 to 5.5; thesis/gare.vs has them as printed.
;
;   vs gare-do-oriente.vs -D rows=2 -D columns=6 -D rho=16.0 -o gare.html
;   vs gare-do-oriente.vs -D psi1=1.9635 -o feet.png

(define-parameter columns 6 #:min 1 #:max 20 #:label "trees along the platforms")
(define-parameter rows 4 #:min 1 #:max 20 #:label "platforms")
(define-parameter rho 20.0 #:min 5 #:max 60 #:label "radius of the beams' arcs, metres")
(define-parameter psi0 (/ pi 8) #:min 0.1 #:max 1.2 #:label "zenith angle where the beams carry the roof")
(define-parameter psi1 (/ pi 2) #:min 1.3 #:max 2.4 #:label "zenith angle where the beams end: past pi/2 they stand on feet")
(define-parameter n-bars 10 #:min 3 #:max 30 #:label "bars in a roof plate")

(define n 30)             ; points of a beam's arc
(define h0 1)             ; the roof's edges stand this much above its middle,
(define h1 3)             ; its corners this much

(define white-steel (make-material #:name "white steel" #:color "#eeece6" #:roughness 0.35))

; ---- the basic shapes (listing 5.1) ----

(define (rod p q radius)
  (if (near? p q) (empty-object) (make-cylinder p q radius #:segments 12)))

(define (support-rod-medium p0 p1) (rod p0 p1 0.4))
(define (support-rod-small p0 p1) (rod p0 p1 0.2))

; A thin pane of glass between three points.
(define (triangle p0 p1 p2)
  (with-material glass
    (do-thicken (make-region (make-line (list p0 p1 p2 p0))) 0.05)))

; Rods between the points of two lists, pair by pair.
(define (rods ps qs)
  (map (lambda (p q) (rod p q 0.12)) ps qs))

; ---- the roof (listing 5.2) ----

(define (roof-plate p0 p1 p2 n)
  (unite
    (rods (line-sequence p0 p1 n)
          (line-sequence p0 p2 n))
    (triangle p0 p1 p2)))

; ---- the beams (listing 5.3) ----

; An I whose web is upright where the beam goes in the direction phi.
(define (beam-base rho phi)
  (let ([s (/ rho 20)])
    (do-rotate
      (do-scale
        (make-region
          (make-polygon (xy -0.9 -0.4) (xy -0.7 -0.4) (xy -0.7 -0.12) (xy 0.7 -0.12) (xy 0.7 -0.4) (xy 0.9 -0.4)
                        (xy 0.9 0.4) (xy 0.7 0.4) (xy 0.7 0.12) (xy -0.7 0.12) (xy -0.7 0.4) (xy -0.9 0.4)))
        s)
      'z phi)))

; A beam follows the arc about the point rho away from p, from the roof down to p, and tapers to half its size.
(define (arc-beam p rho phi psi0 psi1 n)
  (do-sweep
    (beam-base rho phi)
    (make-spline
      (arc-sequence (+pol p rho phi) rho (+ phi pi) psi0 psi1 n))
    0       ; no twist
    0.5))   ; scale at the end

; ---- the props (listing 5.4 a) ----

; Equally spaced as seen from above, as the bars of the roof are: seen across the beam every prop is vertical.
(define (roof-support p pr rho phi psi0 psi1 p0 p1 n-bars)
  (map (lambda (p0 p1 p2)
         (unite (rod p0 p1 0.12)
                (rod p0 p2 0.12)))
       (reverse (linear-h-arc-sequence (+pol p rho phi) rho (+ phi pi) psi0 psi1 n-bars))
       (line-sequence pr p0 n-bars)
       (line-sequence pr p1 n-bars)))

; ---- a tree (listing 5.4 b) ----

(define (beams-and-roof p rho psi0 psi1 n h0 h1 n-bars)
  (let* ([pc (+z p (arc-height rho pi/2 psi1))]           ; point of contact among the beams
         [pr (+z pc (- (arc-height rho psi0 pi/2) h0))]   ; centre of the roof
         [r (arc-width rho psi0 pi/2)])
    (define (helper phi)
      (let ([p0 (+cil pr r phi h0)]                            ; the roof's edge above the beam's end,
            [p1 (+cil pr (* (sqrt 2) r) (+ phi pi/4) h1)]      ; the corners to both sides,
            [p2 (+cil pr r (+ phi pi/2) h0)]                   ; the next edge
            [p3 (+cil pr (* (sqrt 2) r) (- phi pi/4) h1)])
        (unite (support-rod-medium pr p0)
               (support-rod-small pr p1)
               (roof-plate pr p0 p1 n-bars)
               (roof-plate pr p1 p2 n-bars)
               (arc-beam pc rho phi psi0 psi1 n)
               (roof-support pc pr rho phi psi0 (min psi1 pi/2) p1 p3 n-bars))))
    (unite (map helper (enumerate 0 2*pi 4)))))

; ---- the station (listing 5.5) ----

(define width (* 2 (arc-width rho psi0 pi/2)))

(define (gare x y)
  (distribute-in-space
    (lambda (p) (beams-and-roof p rho psi0 psi1 n h0 h1 n-bars))
    (xyz 0 0 0)
    (xyz width width 0)
    x y 1))

; ---- what the trees stand on ----

; A platform under each row of trees, with a pale edge, and the tracks between them.
(define (platform row)
  (let ([y (* (+ row 0.5) width)] [length (* columns width)])
    (unite (with-material concrete (make-box (xyz -6 (- y 6) -1.1) (xyz (+ length 6) (+ y 6) 0)))
           (with-material white (make-box (xyz -6 (- y 5.6) 0) (xyz (+ length 6) (- y 5.2) 0.02)))
           (with-material white (make-box (xyz -6 (+ y 5.2) 0) (xyz (+ length 6) (+ y 5.6) 0.02))))))

(define (track y)
  (let ([length (* columns width)])
    (with-material steel
      (unite (make-box (xyz -40 (- y 0.8) -1.1) (xyz (+ length 40) (- y 0.68) -0.9))
             (make-box (xyz -40 (+ y 0.68) -1.1) (xyz (+ length 40) (+ y 0.8) -0.9))))))

(define (tracks row)
  (let ([y (* (+ row 0.5) width)])
    (unite (track (- y 9)) (track (+ y 9)))))

(draw (with-material white-steel (gare columns rows)))
(draw (unite (map platform (iota rows))))
(draw (unite (map tracks (iota rows))))

; Travellers on the platforms and on the square, simple enough to show how high it is.
(define (person x y z coat)
  (let ([at (lambda (aside high) (xyz (+ x aside) (- y aside) (+ z high)))])
    (unite (color "#3b3f4a" (make-cut-cone (at -0.09 0) 0.06 (at -0.06 0.86) 0.09) (make-cut-cone (at 0.09 0) 0.06 (at 0.06 0.86) 0.09))
           (color coat (make-cut-cone (at 0 0.76) 0.2 (at 0 1.42) 0.17) (make-sphere (at 0 1.4) 0.175))
           (color "#c99d7c" (make-sphere (at 0 1.66) 0.115)))))
(draw (person -4 9 0 "#5a6470") (person -3.6 10.2 0 "#8c4a3a") (person 3 8.4 0 "#c9b68f") (person 16 15 0 "#39708a"))
(draw (person -3 -5 -1.1 "#c9b68f") (person 5 -3 -1.1 "#8c4a3a") (person 6 -3.4 -1.1 "#39708a") (person 24 -1 -1.1 "#5a6470"))

(units 'm)
; A square of slabs of four metres in the afternoon's sun, seen by somebody who walks towards the station.
(define slabs
  (make-material #:name "slabs" #:color "#a3a3a1" #:pattern 'tiles #:pattern-size 4 #:pattern-color "#868684"))
(ground -1.1 #:material slabs)
(sun #:azimuth 222 #:altitude 38)
(camera (xyz -22 -15 0.5) (xyz 30 28 16) #:lens 22 #:upright #t)
