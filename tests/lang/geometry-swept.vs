; What is made from profiles and grids: measures against closed forms, matching, and what is refused.
(define (ok? name got want [tolerance any? 1e-9])
  (if (not (<= (abs (- got want)) (* tolerance (max 1 (abs want)))))
      (printf "~a: ~a, not ~a\n" name got want)))
(define (square z r) (make-rectangle (xyz (- r) (- r) z) (xyz r r z)))
(define (ring z r) (make-circle (xyz 0 0 z) r))

; revolutions: Pappus
(define band (make-rectangle (xz 2 0) (xz 3 1)))
(ok? "ring" (volume (do-revolve band 'z)) (* 5 pi))
(ok? "ring's surface" (area (do-revolve band 'z)) (* 20 pi))
(ok? "half" (volume (do-revolve band 'z 0 pi)) (* 5/2 pi))
(ok? "half's surface" (area (do-revolve band 'z 0 pi)) (+ (* 10 pi) 2))
(ok? "backwards" (volume (do-revolve band 'z 1 -1)) 5.0)
(ok? "from an angle on" (volume (do-revolve band 'z pi)) (* 5/2 pi))
(ok? "two turns are one" (volume (do-revolve band 'z 0 (* 2 2pi))) (* 5 pi))
(ok? "torus" (volume (do-revolve (make-circle (xyz 5 0 0) 2) 'y)) (* 40 pi pi))
(ok? "torus' surface" (area (do-revolve (make-circle (xyz 5 0 0) 2) 'y)) (* 40 pi pi))
(ok? "cone" (volume (do-revolve (make-polygon (xz 0 0) (xz 3 0) (xz 0 4)) 'z)) (* 12 pi))
(ok? "cone's surface" (area (do-revolve (make-polygon (xz 0 0) (xz 3 0) (xz 0 4)) 'z)) (* 24 pi))
(ok? "ball of half a disc" (volume (do-revolve (make-region (make-arc origin 2 -pi/2 pi/2) (make-line (xy 0 2) (xy 0 -2))) 'y)) (* 32/3 pi) 1e-6)
(ok? "a hole" (volume (do-revolve (make-region (make-rectangle (xy 1 0) (xy 5 4)) (make-circle (xy 3 2) 1)) 'y)) (* 2pi 3 (- 16 pi)) 1e-6)
(define far (do-revolve (make-rectangle (xz 12 0) (xz 13 1)) (make-axis (xyz 10 0 0) uz) 0 pi/2))
(displayln (bounding-box far)) ; expect: ((xyz 10 0 0) (xyz 13 3 1))
(displayln (contains? far (xyz 11.8 1.8 0.5))) ; expect: #t
(displayln (contains? far (xyz 11.8 -1.8 0.5))) ; expect: #f
(displayln (contains? far (xyz 11 1 0.5))) ; expect: #f
(displayln (near? (centroid (do-revolve band 'z 0 pi)) (xyz 0 (/ (* 2 19) (* 3 5/2 pi)) 0.5))) ; expect: #t
(displayln (object-kind far)) ; expect: revolve
(displayln (surface? (do-revolve (make-line (xz 1 0) (xz 2 3)) 'z))) ; expect: #t
(ok? "a cone's wall" (area (do-revolve (make-line (xz 3 0) (xz 0 4)) 'z)) (* 15 pi) 1e-4)

; lofts
(ok? "frustum" (volume (do-ruled-loft (list (square 0 2) (square 3 1)))) 28)
(ok? "pyramid" (volume (do-loft (list (square 0 3) (xyz 0 0 5)))) 60)
(ok? "double pyramid" (volume (do-ruled-loft (list (xyz 0 0 -5) (square 0 3) (xyz 0 0 5)))) 120)
(ok? "equal sections never bulge" (volume (do-loft (list (square 0 1) (square 1 1) (square 7 1) (square 8 1)))) 32)
(ok? "whichever way they were drawn" (volume (do-loft (list (square 0 1) (make-polygon (xyz 1 1 2) (xyz 1 -1 2) (xyz -1 -1 2) (xyz -1 1 2))))) 8)
(ok? "and wherever they start" (volume (do-loft (list (square 0 1) (make-polygon (xyz -1 1 2) (xyz -1 -1 2) (xyz 1 -1 2) (xyz 1 1 2))))) 8)
(ok? "a prism of sections with more corners"
     (volume (do-ruled-loft (list (make-rectangle (xy 0 0) (xy 2 2))
                                  (make-polygon (xyz 0 0 3) (xyz 1 0 3) (xyz 2 0 3) (xyz 2 2 3) (xyz 0 2 3))))) 12)
(ok? "cut cone" (volume (do-loft (list (ring 0 2) (ring 3 1)))) (* 7 pi) 3e-3)
(ok? "a pipe" (volume (do-loft (list (make-donut origin 2 1) (make-donut (xyz 0 0 4) 2 1)))) (* 12 pi) 3e-3)
(ok? "prismatoid: side times side over 2, by turns" (volume (do-ruled-loft (list (make-rectangle (xyz -2 -1 0) (xyz 2 1 0)) (make-rectangle (xyz -1 -2 3) (xyz 1 2 3))))) (* 3/6 (+ 8 8 (* 4 9))))
(define (spoke i) (do-rotate (do-move (do-rotate (make-circle origin 0.5) 'x pi/2) (vxyz 3 0 0)) 'z (* i pi/4)))
(ok? "a closed ring" (volume (do-loft (append (map spoke (iota 8)) (list (spoke 0))))) (* 2 pi pi 3 1/4) 8e-3)
(displayln (object-kind (do-ruled-loft (list (square 0 2) (square 3 1))))) ; expect: ruled-loft
(displayln (do-loft (list (ring 0 1) (xyz 0 0 2)) 0.5 1)) ; expect: (do-loft (list (make-circle (xyz 0 0 0) 1) (xyz 0 0 2)) 0.5 1 0 0)
(displayln (surface? (do-loft (list (make-line origin (xy 1 0)) (make-spline (xyz 0 0 1) (xyz 1 0 2) (xyz 2 0 1)))))) ; expect: #t
(define barrel (do-loft (list (ring 0 1) (ring 3 1)) pi/4 1 pi/4 1))
(displayln (> (volume barrel) (* 3 pi 1.5))) ; expect: #t
(displayln (contains? barrel (xyz 1.4 0 1.5))) ; expect: #t
(displayln (contains? barrel (xyz 1.6 0 1.5))) ; expect: #f
; along a straight path nothing changes; guided by straight lines neither
(ok? "path" (volume (do-guided-loft (list (square 0 1) (square 4 1)) (make-line origin (xyz 0 0 4)))) 16)
(ok? "guides" (volume (do-guided-loft (list (square 0 1) (square 4 1)) (list (make-line (xyz 1 0 0) (xyz 1 0 4))))) 16)
(ok? "along a quarter of a circle" (volume (do-guided-loft (list (do-move (do-rotate (square 0 1) 'x pi/2) (vxyz 5 0 0)) (do-move (do-rotate (square 0 1) 'y pi/2) (vxyz 0 5 0))) (make-arc origin 5 0 pi/2)))
     (* pi/2 5 4) 1e-3)
; a taper along a bent curve: sections are those of the straight one at the same heights, moved to where the curve is; a Monte Carlo estimate agrees
(define lean 1/10)
(define bend (do-rotate (make-arc (xyz 8 0 0) 8 pi 2.2) 'x pi/2)) ; rises from the origin
(define rise (cz (second (bounding-box bend))))
(define leaning (do-extrude (make-rectangle (xy -2 -1) (xy 2 1)) bend lean))
(define (inset h) (* h (tan lean)))
(ok? "a leaning wall along an arc" (volume leaning)
     (let ([t (tan lean)]) (- (* 8 rise) (* 6 t rise rise) (* -4/3 t t rise rise rise))) 1e-6)
(define (arc-x z) (- 8 (sqrt (- 64 (* z z)))))
(define (inside? p)
  (and (<= 0 (cz p) rise)
       (<= (abs (- (cx p) (arc-x (cz p)))) (- 2 (inset (cz p))))
       (<= (abs (cy p)) (- 1 (inset (cz p))))))
(define (one-of-box b) (let ([p (first b)] [q (second b)]) (xyz (random-range (cx p) (cx q)) (random-range (cy p) (cy q)) (random-range (cz p) (cz q)))))
(define disagreeing
  (let loop ([i 0] [n 0])
    (if (= i 600) n
        (let ([p (one-of-box (bounding-box leaning))]) (loop (+ i 1) (if (eq? (inside? p) (contains? leaning p)) n (+ n 1)))))))
(displayln (< disagreeing 3)) ; expect: #t
(displayln (list (object-kind leaning) (solid? leaning))) ; expect: (extrude #t)
; sections turn with the path, so that nothing necks: halfway between equal circles is a circle of their size, along a path and along guides
(define (bow x) (make-spline (map-division (lambda (t) (xyz (+ x (sin (* pi t))) 0 (* 4 t))) 0 1 20)))
(define (waist l) (area (do-section l (make-plane (xyz 0 0 2) uz))))
(ok? "halfway along a bow" (waist (do-guided-loft (list (ring 0 1) (ring 4 1)) (bow 0))) pi 1e-3)
(ok? "halfway along a guide" (waist (do-guided-loft (list (ring 0 1) (ring 4 1)) (list (bow 1)))) pi 1e-3)
(ok? "halfway between two" (waist (do-guided-loft (list (ring 0 1) (ring 4 1)) (list (bow 1) (bow -1)))) pi 1e-3)
; several guides: round about the axis they make a solid of revolution, side by side they carry the circle as it is; sections are met on the way
(define (along guides) (do-guided-loft (list (ring 0 1) (ring 4 1)) guides))
(define (barrel-guide a) (do-rotate (make-spline (map-division (lambda (t) (xyz (+ 1 (* 1/2 (sin (* pi t)))) 0 (* 4 t))) 0 1 20)) 'z a))
(for ([n '(2 3 5)])
  (define l (along (map barrel-guide (enumerate 0 2pi n))))
  (ok? "guides about an axis" (waist l) (* 9/4 pi) 2e-3)
  (ok? "their volume" (volume l) (* 4 pi (+ 1 (/ 2 pi) 1/8)) 2e-3)
  (ok? "guides side by side" (waist (along (map (lambda (a) (do-move (bow 0) (p->q origin (pol 1 a)))) (enumerate 0 2pi n)))) pi 1e-3))
(ok? "a section on the way" (waist (do-guided-loft (list (ring 0 1) (do-move (ring 2 2) ux) (ring 4 1)) (bow 0))) (* 4 pi) 1e-3)
(displayln (do-guided-loft (list (ring 0 1) (ring 4 1)) (list (make-line (xyz 1 0 0) (xyz 1 0 4)))))
; expect: (do-guided-loft (list (make-circle (xyz 0 0 0) 1) (make-circle (xyz 0 0 4) 1)) (list (make-line (list (xyz 1 0 0) (xyz 1 0 4)))))

; grids
(define (loop z r) (map-division (lambda (a) (cyl r a z)) 0 2pi 4))
(ok? "a prism of rows" (volume (make-mesh (list (loop 0 0) (loop 0 1) (loop 2 1) (loop 2 0)))) 4)
(ok? "inside out is turned" (volume (make-mesh (list (loop 2 0) (loop 2 1) (loop 0 1) (loop 0 0)))) 4)
(ok? "closed both ways" (volume (make-mesh (list (loop 0 1) (loop 0 2) (loop 1 2) (loop 1 1)) #:closed-u #t)) 6)
(displayln (surface? (make-mesh (list (loop 0 1) (loop 2 1))))) ; expect: #t
(ok? "its area" (area (make-mesh (list (loop 0 1) (loop 2 1)))) (* 8 (sqrt 2)))
(ok? "ball" (volume (make-surface (lambda (u v) (sph 2 u v)) 0 2pi 0 pi)) (* 32/3 pi) 5e-3)
(ok? "torus" (volume (make-surface (lambda (u v) (+z (pol (+ 3 (cos v)) u) (sin v))) 0 2pi 0 2pi #:nu 128 #:nv 128)) (* 6 pi pi) 2e-3)
(displayln (object-kind (make-surface (lambda (u v) u) (lambda (u v) v) (lambda (u v) 0)))) ; expect: surface
(displayln (surface? (make-surface (list (loop 0 1) (loop 2 1))))) ; expect: #t
(ok? "a sheet made thick" (volume (do-thicken (make-surface (lambda (u v) (xyz u v 0)) #:nu 2 #:nv 2) 0.5)) 0.5)


; extrusions: leaning walls end in an apex, a ridge or a roof
(define steep (atan 1/2))
(ok? "cut pyramid" (volume (do-extrude (square 0 2) 2 steep)) 56/3)
(ok? "pyramid" (volume (do-extrude (square 0 2) 9 steep)) 64/3)
(ok? "upside down" (volume (do-extrude (square 0 2) -9 steep)) 64/3)
(ok? "outwards" (volume (do-extrude (square 0 2) 2 (- steep))) 152/3)
(ok? "a ridge" (volume (do-extrude (make-rectangle (xy 0 0) (xy 6 2)) 9 steep)) 32/3)
(ok? "a roof over an L" (volume (do-extrude (make-polygon (xy 0 0) (xy 6 0) (xy 6 2) (xy 2 2) (xy 2 5) (xy 0 5)) 9 steep)) 50/3)
(define H (make-polygon (xy 0 0) (xy 2 0) (xy 2 2) (xy 4 2) (xy 4 0) (xy 6 0) (xy 6 5) (xy 4 5) (xy 4 3) (xy 2 3) (xy 2 5) (xy 0 5)))
(ok? "a roof over an H that falls into two" (volume (do-extrude H 9 steep)) 18.5)
(ok? "a frame" (volume (do-extrude (make-region (square 0 3) (square 0 1)) 1 steep)) 24)
(ok? "a cut cone" (volume (do-extrude (make-circle origin 2) 2 steep)) (* 2/3 7 pi))
(ok? "a cone" (volume (do-extrude (make-circle origin 2) 9 steep)) (* 16/3 pi))
(ok? "oblique" (volume (do-extrude (square 0 2) (vxyz 3 1 2) steep)) 56/3)
(displayln (bounding-box (do-extrude (square 0 2) 9 steep #:centre #f))) ; expect: ((xyz -2 -2 0) (xyz 2 2 4.000000000000001))
(displayln (contains? (do-extrude H 9 steep) (xyz 3 2.5 0.9))) ; expect: #t
(displayln (contains? (do-extrude H 9 steep) (xyz 3 2.5 1.1))) ; expect: #f
(ok? "twisted" (volume (do-extrude (square 0 2) 3 #:twist pi)) 48)
(ok? "narrowing" (volume (do-extrude (square 0 2) 3 #:scale 1/2)) 28)
(ok? "a prism's surface" (area (do-extrude (square 0 2) 3)) 80)
(ok? "a cylinder's" (area (do-extrude (make-circle origin 1) 3)) (* 8 pi))
; what overlaps itself counts once
(ok? "a path across itself" (volume (do-sweep (square 0 1/2) (make-line origin (xy 4 0) (xy 4 4) (xy 2 4) (xy 2 -2)))) 15)
(displayln (< 4.15 (volume (do-sweep (square 0 1/2) (make-line origin (xy 4 0) (xyz 0 1/10 0)))) 4.25)) ; expect: #t
(ok? "out and back along a curve" (volume (do-extrude (make-rectangle (xz -1 -1) (xz 1 1)) (make-line origin (xyz 0 5 0) (xyz 4 5 0) (xyz 4 0 0)))) 40)

; bends tighter than the profile: the union of all that it passes through
; a square of side 2 whose middle is 1/2 from the line that it turns about: its parts beyond the line and on this side of it
(define beyond 9/4)
(define before 1/4)
(define bent (make-arc origin 1/2 pi))
(define two (make-rectangle (xy -1 -1) (xy 1 1)))
(ok? "half a turn about a line through the profile" (volume (do-sweep two bent)) (* pi (+ beyond before)) 6e-3)
(ok? "a whole turn hides the inner part" (volume (do-sweep two (make-circle origin 1/2))) (* 2pi beyond) 6e-3)
(ok? "a bar bent so" (volume (do-thicken (make-arc origin 1/2 pi/2 #:segments 24) 2 #:segments 24)) 2.86299 0.03)
(ok? "a frame" (volume (do-sweep (make-region (make-rectangle (xy -2 -1) (xy 2 1)) (make-rectangle (xy -1 -1/2) (xy 1 1/2))) (make-arc origin 1/2 pi/2)))
     (* pi/4 (- (* 2 (+ 9/4 25/4)) (+ 1/4 9/4))) 3e-3)

; corners with a twist: arms go from mitre to mitre and no further, so that the solid does not depend on how finely it is cut
(define zigzag (make-line origin (xyz 8 0 0) (xyz 8 9 0) (xyz 4 9 7)))
(define way (+ 17 (sqrt 65)))
(define plate (make-rectangle (xy 0 0) (xy 1 2)))
(ok? "a twist round corners" (volume (do-sweep plate zigzag 6)) (* 2 way))
(ok? "a scale round corners" (volume (do-sweep plate zigzag 1 1/2)) (* 7/6 way))
(for ([t '(0.05 0.01 0.002)]) ; measured on their meshes: those with a base have no formula
  (parameterize ([current-tolerance t])
    (define (close? name o want) (ok? name (volume o) want t))
    (close? "twisted, its mesh" (do-sweep plate zigzag 6 #:base (xy 1/2 1)) (* 2 way))
    (close? "and scaled" (do-sweep plate zigzag 1 1/2 #:base (xy 1/2 1)) (* 7/6 way))
    (close? "scaled, its mesh" (do-sweep plate zigzag 0 1/2 #:base (xy 1/2 1)) (* 7/6 way))))
; here the profile is further inside of sharp corners than the arms are long: all of it goes backwards
(define inward (do-sweep (make-circle (xy 0 0) 0.25) (do-offset (make-polygon (xy 1 0) (xy 3 0) (xy 2 1.5)) 1.5) -0.31898241117596626 #:base (xyz 0 3 -0.75)))
(define (by-chance o n)
  (let* ([box (bounding-box o)] [p (first box)] [q (second box)])
    (let loop ([i 0] [in 0])
      (if (= i n) (/ (* in (- (cx q) (cx p)) (- (cy q) (cy p)) (- (cz q) (cz p))) n)
          (loop (+ i 1) (if (contains? o (one-of-box box)) (+ in 1) in))))))
(ok? "backwards round corners" (volume inward) 1.6324 1e-3)
(ok? "its points" (by-chance inward 40000) 1.6324 0.05)
(for ([t '(0.01 0.001)]) (parameterize ([current-tolerance t]) (ok? "its mesh" (volume inward) 1.6324 (* 10 t))))

; closed paths with a twist after which the profile is itself again
(define ring-path (make-circle origin 6))
(ok? "a square after a quarter turn" (area (do-sweep (make-rectangle (xy -1 -1) (xy 1 1)) ring-path pi/2)) (* 8 12 pi) 6e-3)
(ok? "a band with one side" (volume (do-sweep (make-rectangle (xy -1 -1/5) (xy 1 1/5)) ring-path pi)) (* 0.8 12 pi) 2e-3)
(ok? "no twist of a circle is to be seen" (area (do-sweep (make-circle origin 1) ring-path 1)) (area (do-sweep (make-circle origin 1) ring-path)) 1e-3)

; upright along the path: every section's own upper side keeps to #:up, to which the path's direction is the only limit
(define helix (make-spline (map (lambda (t) (cyl 2 t (* 0.6 t))) (division 0 2pi 48))))
(define plank (make-rectangle (xy -0.03 -0.3) (xy 0.03 0.3)))
(define (tops o) (map cz (bounding-box o)))
(define along-z (do-sweep plank helix #:up 'z))
(ok? "a rail's volume" (volume along-z) (* 0.06 0.6 (curve-length helix)) 1e-9)
; at both ends the plank stands across the path: its top is .3 cos(slope) above it
(define slope (atan 0.6 2))
(ok? "a rail's top" (second (tops along-z)) (+ (* 0.6 2pi) (* 0.3 (cos slope))) 2e-3)
(ok? "a rail's foot" (first (tops along-z)) (* -0.3 (cos slope)) 2e-3)
(displayln (< (second (tops (do-sweep plank helix))) (- (second (tops along-z)) 0.01))) ; expect: #t
; a profile that stands is upright already; one drawn with its upper side to the back is turned
(define frieze (make-rectangle (xyz -0.1 0 0) (xyz 0.1 0 0.8)))
(define wall-top (make-line (xyz 0 0 3) (xyz 4 0 3) (xyz 4 4 3) (xyz 0 4 3) (xyz 0 0 3)))
(displayln (near? (tops (do-sweep frieze wall-top #:base origin #:up 'z)) '(3 3.8) 1e-9)) ; expect: #t
(displayln (near? (tops (do-sweep frieze (make-line (xyz 0 0 3) (xyz 0 -4 3)) #:base origin #:up (vxyz 0 0 7))) '(3 3.8) 1e-9)) ; expect: #t
(displayln (near? (tops (do-sweep frieze (make-line (xyz 0 0 3) (xyz 0 -4 3)) #:base origin #:up (vxyz 0 0 -1))) '(3 3.8) 1e-9)) ; expect: #t
; a path that climbs out of a bend turns the profile within one arm, evenly about the way: its mesh follows, and `contains?` with it
(define wedge (make-polygon (xy 2 0) (xy 2 1) (xy 0 1)))
(define climb (make-line (xyz 0 0 0) (xyz 0 0 2) (xyz 2 1 3)))
(define upwards (vxyz 1 0 1))
(define climbing (do-sweep wedge climb #:up upwards))
(ok? "a climb" (volume climbing) (+ 2 (sqrt 6)))
(ok? "its points" (by-chance climbing 40000) (+ 2 (sqrt 6)) 0.05)
(for ([t '(0.05 0.01 0.002)])
  (parameterize ([current-tolerance t])
    (ok? "its mesh" (volume (do-sweep wedge climb #:base (xy 4/3 2/3) #:up upwards)) (+ 2 (sqrt 6)) t)
    (ok? "a climb with a twist" (volume (do-sweep wedge climb 2 #:base (xy 4/3 2/3) #:up upwards)) (+ 2 (sqrt 6)) (* 2 t))))
; half of the turn is done in the middle of the arm, where the profile is as large as everywhere
(define plank-up (do-sweep plank (make-line (xyz 0 0 0) (xyz 4 0 0) (xyz 6 2 3)) #:up 'z))
(ok? "no waist" (area (do-section plank-up (make-plane (xyz 2 0 0) ux))) (* 0.06 0.6) 1e-3)
; printed and read again it is the same
(displayln (equal? along-z (do-sweep plank helix #:up (vxyz 0 0 1))))  ; expect: #t
(displayln (do-sweep plank (make-line origin (xyz 5 0 0)) #:up 'z))    ; expect: (do-sweep (make-polygon (list (xyz -0.03 -0.3 0) (xyz 0.03 -0.3 0) (xyz 0.03 0.3 0) (xyz -0.03 0.3 0))) (make-line (list (xyz 0 0 0) (xyz 5 0 0))) #:up (vxyz 0 0 1))
; a polyline's corners, and a closed path
(define steps (do-sweep plank (make-line (xyz 0 0 0) (xyz 2 0 1) (xyz 3 0 1) (xyz 3 3 1)) #:up 'z))
(displayln (and (solid? steps) (> (volume steps) 0.2)))                ; expect: #t
(ok? "a ring" (volume (do-sweep plank (make-circle origin 2) #:up 'z)) (* 0.036 4 pi) 1e-9)
; a spline that runs back on itself has cusps, where it has no direction: the solid is the same at every fineness
(define (back-and-forth) (do-sweep (make-polygon (xy 0 0) (xy 2 1) (xy 0 1)) (make-spline (list (xy 1 0) (xy 3 0) (xyz 2 0 0) (xy 1 0))) 0.8))
(displayln (near? (bounding-box (back-and-forth)) (parameterize ((current-segments 24)) (bounding-box (back-and-forth))) 0.05)) ; expect: #t
(displayln (near? (volume (back-and-forth)) (volume (parameterize ((current-segments 24)) (back-and-forth))) 0.01))             ; expect: #t
