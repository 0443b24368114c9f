; (visualscheme analysis): members from drawn objects, loads on faces, snow and wind, combinations, timber, sizing
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))

; ---- members ----
; a net comes back from its bars and balls; its balls join bars that end before their nodes
(define net (list (list origin (xyz 3 0 0) (xyz 0 4 0) (xyz 1 1 3)) '((1 2) (2 3) (3 1) (1 4) (2 4) (3 4))))
(define (as-net parts) (list (first parts) (second parts)))
(define back (members-of (frame-members net 0.05)))
(define (place-in nodes p) (nearest-node nodes p))
(say (every (lambda (m k) (equal? (sort m <) (sort (map (lambda (p) (place-in (first back) p)) (map (lambda (n) (list-ref (first net) (- n 1))) k)) <))) (second back) (second net))
     (every (lambda (p) (near? p (list-ref (first back) (- (place-in (first back) p) 1)))) (first net))
     (every (lambda (s) (same? (section-area s) (* pi 0.0025))) (third back))
     (equal? (as-net (members-of (frame-members net 0.05 #:nodes 'none))) (as-net (members-of (map (lambda (m) (make-line (list-ref (first net) (- (first m) 1)) (list-ref (first net) (- (second m) 1)))) (second net)) #:section 0.01))))
; expect: (#t #t #t #t)
; a beam on a column's top is cut there; scaled, moved and turned objects in unions, layers and materials keep their places
(define t-frame (members-of (list (make-line (xyz -2 0 3) (xyz 2 0 3)) (make-line origin (xyz 0 0 3))) #:section (round-section 0.1)))
(say (as-net t-frame) (length (third t-frame)))
; expect: ((((xyz -2 0 3) (xyz 2 0 3) (xyz 0 0 0) (xyz 0 0 3)) ((1 4) (4 2) (3 4))) 3)
(define (turned o) (layer "beams" (color "red" (unite (do-move (do-rotate (do-scale o 2) (make-axis origin (vxyz 1 2 3)) 0.7) (vxyz 1 1 1))))))
(define (lengths parts) (map (lambda (m) (distance (list-ref (first parts) (- (first m) 1)) (list-ref (first parts) (- (second m) 1)))) (second parts)))
(define (area-of o) (let ((parts (members-of (turned o)))) (list (round (* 1e9 (car (lengths parts)))) (round (* 1e9 (section-area (car (third parts))))))))
(displayln (map area-of (list (make-cylinder origin 3 0.1) (make-box origin (xyz 3 0.1 0.2)) (make-pipe (make-line origin (xyz 3 0 0)) 0.1)
                        (do-extrude (make-rectangle origin (xy 0.1 0.2)) 3) (do-extrude (make-circle origin 0.1) 3)
                        (subtract (make-cylinder origin 3 0.1) (make-cylinder origin 3 0.08)) (do-extrude (make-region (make-circle origin 0.1) (make-circle origin 0.08)) 3))))
; expect: ((6000000000.0 125663706.0) (6000000000.0 80000000.0) (6000000000.0 125663706.0) (6000000000.0 80000000.0) (6000000000.0 125663706.0) (6000000000.0 45238934.0) (6000000000.0 45238934.0))
; a box bends as a beam of its own height, however it is turned about its length: w = P l^3 / 3 E I
(define (sag box turn)
  (let* ((parts (members-of (do-rotate box 'x turn))) (nodes (first parts))
         (r (frame-solve (frame nodes (second parts) #:sections (third parts) #:supports (nodes-where nodes (lambda (p) (< (cx p) 1)))
                           #:loads (list (list (nearest-node nodes (xyz 3 0 0)) (vxyz 0 0 -1000)))))))
    (- (cz (displacement r (nearest-node nodes (xyz 3 0 0)))))))
(define beam (make-box (xyz 0 -0.05 -0.1) (xyz 3 0.05 0.1)))
(define (sag-of i) (/ 27000 3 210e9 i))
(define (slanted turn) (+ (* (square (cos turn)) (sag-of (/ (* 0.1 0.008) 12))) (* (square (sin turn)) (sag-of (/ (* 0.2 0.001) 12)))))
(say (every (lambda (turn) (same? (sag beam turn) (slanted turn))) '(0 0.3 0.7 1.2 1.5707963 2 3 -1)))
; expect: (#t)
; a catenary that is turned over carries its own weight without tension
(define chain (map (lambda (i) (xyz (/ i 2) 0 0)) (iota 21)))
(define links (map (lambda (i) (list i (+ i 1))) (iota 20 1)))
(define arch (form-find chain links #:fixed '(1 21) #:weight (vxyz 0 0 1) #:lengths 0.6))
(define standing (frame-solve (frame arch links #:sections (tube-section 0.1 0.01) #:supports '((1 pinned) (21 pinned)) #:plane 'xz #:loads '(weight))))
(say (every (lambda (i) (and (< (member-force standing i) 0) (< (abs (fifth (member-forces standing i 1))) (* 1/8 0.36 7850 9.81 (section-area (tube-section 0.1 0.01)))))) (iota 20 1)))
; expect: (#t)
(fails (members-of (make-sphere origin 1)))                         ; expect: members-of: the objects have no members
(fails (members-of (make-line origin (xyz 1 0 0))))                 ; expect: members-of: a curve has no section: give #:section
(fails (members-of (make-torus origin 2 1)))                        ; expect: members-of: a torus is no member: members are cylinders, boxes, tubes, pipes, straight extrusions of circles, rings and rectangles, and curves
(fails (members-of (do-scale (make-cylinder origin 3 0.1) '(1 2 1)))) ; expect: members-of: a cylinder is stretched in one direction: its section is no cylinder
(fails (nearest-node '() origin))                                   ; expect: nearest-node: there are no nodes
(fails (nodes-where '(1) odd?))                                     ; expect: nodes-where: nodes must be a list of points, got (1)

; ---- loads on faces ----
; the reactions hold force and moment of a load on a face, whatever the face: here a quadrangle on four legs
(define corners (list (xyz 0 0 3) (xyz 5 0 3) (xyz 4 4 3) (xyz 1 3 3)))
(define feet (map (lambda (p) (xyz (cx p) (cy p) 0)) corners))
(define legs '((5 1) (6 2) (7 3) (8 4) (1 2) (2 3) (3 4) (4 1)))
(define (table loads) (frame-solve (frame (append corners feet) legs #:sections (tube-section 0.1 0.01) #:supports '(5 6 7 8) #:loads loads)))
(define (whole r) (fold v+v (vxyz 0 0 0) (map (lambda (n) (reaction r n)) '(5 6 7 8))))
(define (turning r) (fold v+v (vxyz 0 0 0) (map (lambda (n) (v+v (reaction-moment r n) (cross (p->q origin (list-ref feet (- n 5))) (reaction r n)))) '(5 6 7 8))))
(define top (make-region (apply make-polygon corners)))
(define pressed (table (list (list 'faces '((1 2 3 4)) 700))))
(say (near? (whole pressed) (vxyz 0 0 (* 700 (area top))) 1e-6)
     (let ((c (fold v+v (vxyz 0 0 0) (map (lambda (t) (v*r (p->q origin (centroid (make-region (apply make-polygon t)))) (area (make-region (apply make-polygon t)))))
                                        (let ((m (p+v origin (v/r (fold (lambda (p s) (v+v s (p->q origin p))) (vxyz 0 0 0) corners) 4))))
                                          (map (lambda (p q) (list m p q)) corners (append (cdr corners) (list (car corners)))))))))
       (near? (turning pressed) (cross c (vxyz 0 0 700)) 1e-6)))
; expect: (#t #t)
; snow counts plan, dead load the face: a plane of 3 in 4, the face 5/4 of its plan
(define slope (list origin (xyz 4 0 3) (xyz 4 2 3) (xyz 0 2 0)))
(define (roof kind load) (let ((r (frame-solve (frame slope '((1 2) (2 3) (3 4) (4 1)) #:sections (tube-section 0.1 0.01) #:supports '(1 2 3 4) #:loads (list (list kind '((1 2 3 4)) load))))))
                          (fold v+v (vxyz 0 0 0) (map (lambda (n) (reaction r n)) '(1 2 3 4)))))
(say (near? (roof 'plan (vxyz 0 0 -1000)) (vxyz 0 0 8000) 1e-6) (near? (roof 'faces (vxyz 0 0 -1000)) (vxyz 0 0 10000) 1e-6)
     (near? (roof 'faces 100) (v*r (vxyz -3/5 0 4/5) 1000) 1e-6))
; expect: (#t #t #t)
(define plate (make-mesh (list (list (xyz 0 0 3) (xyz 2 0 3)) (list (xyz 0 2 3) (xyz 2 2 3)))))
(say (faces-on (list (xyz 0 0 3) (xyz 2 0 3) (xyz 0 2 3) (xyz 2 2 3)) plate))
; expect: (((1 3 4) (1 4 2)))
(fails (faces-on (list origin) plate))                              ; expect: faces-on: no node is at the corner (xyz 0 0 3)
(fails (table (list (list 'plan '((1 2 3)) 5))))                    ; expect: frame: loads: (plan ((1 2 3)) 5) is no load; loads are (list node force), (list node force moment), (list 'member number force-per-metre), (list 'members force-per-metre), (list 'faces faces force-per-m2), (list 'plan faces force-per-m2) and 'weight
(fails (table (list (list 'faces '((1 2 9)) 5))))                   ; expect: frame: loads: a face: a node must be a number from 1 to 8, got 9

; ---- snow and wind ----
; by hand: 0.8 sk below 30 degrees, half of it at 45, none from 60 on; 25 m/s at 10 m: ln 200 = 5.2983, v = 25.167 m/s, q = 918.9 Pa
(say (map (lambda (a) (round (snow-load 1000 #:slope (degrees->radians a)))) '(0 30 45 60 80)) (near? (wind-pressure 25 10) 918.863 1e-3)
     (= (wind-pressure 25 1) (wind-pressure 25 2)) (> (wind-pressure 25 10 #:terrain 'I) (wind-pressure 25 10) (wind-pressure 25 10 #:terrain 'IV)))
; expect: ((800.0 800.0 400.0 0 0) #t #t #t)
(snow-load 0.8)            ; expect warning: snow-load: 0.8 N/m2 of snow is less than a handful: newtons are expected, 1 kN is 1000 N
(wind-pressure 100 10)     ; expect warning: wind-pressure: a wind of 100 m/s is a tornado's: m/s are expected, 1 km/h is 0.278 m/s
(fails (wind-pressure 25 10 #:terrain 'V)) ; expect: wind-pressure: terrain must be one of (0 I II III IV), got V

; ---- combinations ----
(define cases (list (list "dead" (list 2 (vxyz 0 0 -1000))) (list "snow" (list 2 (vxyz 0 0 -2000))) (list "wind" (list 2 (vxyz 0 0 3000)))))
(define post (frame-solve (frame (list origin (xyz 0 0 3)) '((1 2)) #:supports '(1) #:sections (tube-section 0.1 0.01) #:loads cases)))
(define (designed limit) (design-cases post #:permanent "dead" #:variable '(("snow" snow) ("wind" wind)) #:limit limit))
(for-each (lambda (limit) (let ((r (designed limit))) (displayln (map (lambda (c) (list c (round (member-force r 1 #:case c)))) (case-names r))))) '(uls characteristic frequent quasi-permanent))
; expect: ((1.35 dead -1350.0) (dead -1000.0) (1.35 dead + 1.5 snow + 0.9 wind -1650.0) (1.35 dead + 1.5 snow -4350.0) (1.35 dead + 1.5 wind + 0.75 snow 1650.0) (1.35 dead + 1.5 wind 3150.0) (dead + 1.5 snow + 0.9 wind -1300.0) (dead + 1.5 snow -4000.0) (dead + 1.5 wind + 0.75 snow 2000.0) (dead + 1.5 wind 3500.0))
; expect: ((dead + snow + 0.6 wind -1200.0) (dead + snow -3000.0) (dead + wind + 0.5 snow 1000.0) (dead + wind 2000.0))
; expect: ((dead + 0.2 snow -1400.0) (dead + 0.2 wind -400.0))
; expect: ((dead -1000.0))
(fails (design-cases post #:permanent "dead" #:variable '(("snow" rain)))) ; expect: design-cases: an action must be one of (a b c d e f g h snow high-snow wind temperature), or a list of psi 0, 1 and 2, got rain
(fails (design-cases post #:permanent "live"))                      ; expect: combine-cases: case must be one of ("dead" "snow" "wind"), got "live"
(fails (design-cases post))                                         ; expect: design-cases: give #:permanent, #:variable, or both

; ---- timber by EN 1995 ----
; a column of 140 x 140 mm in c24, 3 m long: slenderness 3 / 0.04041 = 74.2, relative 1.2588, k 1.3882, kc 0.5064
(define (timber-column n h) (frame-solve (frame (list origin (xyz 0 0 3)) '((1 2)) #:materials 'c24 #:sections (rectangle-section 0.14 0.14) #:supports '((1 pinned rz) (2 x y))
                                     #:loads (list (list 2 (vxyz h 0 (- n)))))))
(define column-k (let* ((l (* (/ 3 (/ 0.14 (sqrt 12)) pi) (sqrt (/ 21 7400.)))) (k (* 1/2 (+ 1 (* 0.2 (- l 0.3)) (* l l))))) (/ 1 (+ k (sqrt (- (* k k) (* l l)))))))
(say (near? column-k 0.5064 1e-3) (same? (utilisation (timber-column 80e3 0) 1) (/ 80e3 0.0196 (* column-k 0.8 (/ 21e6 1.3)))))
; expect: (#t #t)
; a beam of 80 x 240 mm, 4 m long, 3 kN/m, short: bending 6000 / W, k-crit of a slender beam, shear 6000 N over 0.67 of the width
(define (timber-beam b h grade) (frame-solve (frame (list origin (xyz 4 0 0)) '((1 2)) #:materials grade #:sections (rectangle-section b h) #:supports '((1 pinned rx) (2 y z))
                                             #:loads (list (list 'members (vxyz 0 0 -3000))))))
(define (bending b h f) (/ 6000 (/ (* b h h) 6) f))
(define (kcrit b h f e) (let ((l (sqrt (/ f (/ (* 0.78 b b e) (* h 4)))))) (cond ((<= l 0.75) 1) ((<= l 1.4) (- 1.56 (* 0.75 l))) (else (/ 1 l l)))))
(say (same? (utilisation (timber-beam 0.08 0.24 'c24) 1 #:duration 'short) (/ (bending 0.08 0.24 (* 0.9 (/ 24e6 1.3))) (kcrit 0.08 0.24 24e6 7.4e9)))
     (same? (utilisation (timber-beam 0.04 0.36 'gl28h) 1 #:duration 'long #:service-class 3) (/ (bending 0.04 0.36 (* 0.55 (/ 28e6 1.25))) (kcrit 0.04 0.36 28e6 10.5e9)))
     (same? (utilisation (timber-beam 0.24 0.08 'c24) 1 #:partial-factor 1) (bending 0.24 0.08 (* 0.8 24e6)))
     (< (kcrit 0.04 0.36 28e6 10.5e9) 0.6))
; expect: (#t #t #t #t)
; tension and bending about both axes: (6.17) and (6.18)
(define pulled (frame-solve (frame (list origin (xyz 2 0 0)) '((1 2)) #:materials 'c30 #:sections (rectangle-section 0.1 0.2) #:supports '(1) #:loads (list (list 2 (vxyz 50e3 500 1500))))))
(define (part x f) (/ x (* 0.8 (/ f 1.3))))
(say (same? (utilisation pulled 1) (let ((n (part (/ 50e3 0.02) 19e6)) (y (part (/ 3000 (/ (* 0.1 0.04) 6)) 30e6)) (z (part (/ 1000 (/ (* 0.2 0.01) 6)) 30e6))) (max (+ n y (* 0.7 z)) (+ n (* 0.7 y) z)))))
; expect: (#t)
(define short-beam (frame-solve (frame (list origin (xyz 0.5 0 0)) '((1 2)) #:materials 'c24 #:sections (rectangle-section 0.1 0.2) #:supports '((1 pinned rx) (2 y z)) #:loads (list (list 'members (vxyz 0 0 -100e3))))))
(say (same? (utilisation short-beam 1) (part (/ (* 1.5 25e3) (* 0.67 0.02)) 4e6)))
; expect: (#t)
(fails (utilisation (frame-solve (frame (list origin (xyz 4 0 0)) '((1 2)) #:materials 'c24 #:sections (tube-section 0.1 0.01) #:supports '(1))) 1)) ; expect: utilisation: member 1 is of timber, and its section is a tube: the check is that of rectangles and circles
(fails (utilisation pulled 1 #:duration 'year))                     ; expect: utilisation: duration must be one of (permanent long medium short instantaneous), got year
(fails (utilisation pulled 1 #:service-class 4))                    ; expect: utilisation: service-class must be 1, 2 or 3, got 4

; ---- sizing ----
; a cantilever of 2 m with 5 kN at its end needs a section modulus of 10000 / 235e6 = 42.6 cm3
(define list-of-tubes (map (lambda (d) (tube-section d 0.005)) '(0.06 0.08 0.1 0.12 0.14 0.16)))
(define bracket (frame (list origin (xyz 2 0 0)) '((1 2)) #:sections (first list-of-tubes) #:supports '(1) #:loads (list (list 2 (vxyz 0 0 -5000)))))
(define sized (size-frame bracket list-of-tubes))
(say (eq? (member-section sized 1) (fourth list-of-tubes)) (<= (utilisation sized 1) 1))
; expect: (#t #t)
(say (eq? (member-section (size-frame bracket list-of-tubes #:limit 0.5) 1) (sixth list-of-tubes)))
; expect: (#t)
; members of a group have one section: that which the most loaded of them needs
(define two (frame (list origin (xyz 2 0 0) (xyz 0 5 0) (xyz 2 5 0)) '((1 2) (3 4)) #:sections (first list-of-tubes) #:supports '(1 3)
              #:loads (list (list 2 (vxyz 0 0 -5000)) (list 4 (vxyz 0 0 -500)))))
(define (areas r) (map (lambda (i) (section-area (member-section r i))) '(1 2)))
(say (apply > (areas (size-frame two list-of-tubes))) (apply = (areas (size-frame two list-of-tubes #:groups '((1 2))))))
; expect: (#t #t)
(fails (size-frame two '()))                                        ; expect: size-frame: sections must be a list of sections from the lightest, got ()
(fails (size-frame two list-of-tubes #:groups '((1 1))))            ; expect: size-frame: groups: a member is in two groups in ((1 1))
(size-frame bracket (list (tube-section 0.03 0.003)))               ; expect warning: size-frame: member 1 uses 27.19 of its strength with the last section of the list
; ---- ends that touch other members beside their axes ----
(define (post x high) (make-cylinder (xyz x 0 0) (xyz x 0 high) 0.1))
(define (parts-of-list l) (list (first l) (second l)))
(define (rounded x) ; to a millionth
  (define (r x) (/ (round (* 1e6 x)) 1e6))
  (cond ((pair? x) (map rounded x)) ((point? x) (xyz (r (cx x)) (r (cy x)) (r (cz x)))) ((gvector? x) (vxyz (r (cx x)) (r (cy x)) (r (cz x)))) (else x)))
; a beam between two posts that go on above it, from face to face: arms of a radius; the posts are cut
(define between-posts (members-of (list (post 0 4) (post 6 4) (make-box (xyz 0.1 -0.05 2.9) (xyz 5.9 0.05 3.1))) #:offsets #t))
(say (rounded (parts-of-list between-posts)))
; expect: ((((xyz 0 0 0) (xyz 0 0 4) (xyz 6 0 0) (xyz 6 0 4) (xyz 0 0 3) (xyz 6 0 3)) ((1 5) (5 2) (3 6) (6 4) (5 6 offset-start (vxyz 0.1 0 0) offset-end (vxyz -0.1 0 0)))))
(say (length (first (members-of (list (post 0 4) (post 6 4) (make-box (xyz 0.1 -0.05 2.9) (xyz 5.9 0.05 3.1)))))))
; expect: (6)
; a beam that lies on two posts: their heads are half of its height below its axis; a joist lies on the beam
(define on-posts (members-of (list (post 0 4) (post 6 4) (make-box (xyz 0 -0.05 4) (xyz 6 0.05 4.2)) (make-box (xyz 2.95 0 4.2) (xyz 3.05 3 4.4)) (make-cylinder (xyz 3 3 0) (xyz 3 3 4.2) 0.1)) #:offsets #t))
(say (rounded (map (lambda (m) (filter-map (lambda (name) (and (memq name m) (cadr (memq name m)))) '(offset-start offset-end))) (second on-posts))) (length (first on-posts)))
; expect: ((((vxyz 0 0 -0.1)) ((vxyz 0 0 -0.1)) () () ((vxyz 0 0 0.2) (vxyz 0 0 0.1)) ()) 7)
; forces balance, and a post under the beam's end carries half of the load; the frame is no mechanism
(define (on-ground nodes) (map (lambda (n) (list n 'fixed)) (nodes-where nodes (lambda (p) (< (cz p) 1e-9)))))
(define (answer l) (frame-solve (frame (first l) (second l) #:sections (third l) #:supports (on-ground (first l)) #:loads '(weight))))
(define (lifted l) (apply + (map (lambda (s) (cz (reaction (answer l) (car s)))) (on-ground (first l)))))
(define (heavy l) ; the weight of the true lengths
  (let ((at (list->vector (cons #f (first l)))) (arm (lambda (m name) (if (memq name m) (cadr (memq name m)) (vxyz 0 0 0)))))
    (apply + (map (lambda (m s) (* 9.81 7850 (section-area s) (distance (p+v (vector-ref at (first m)) (arm m 'offset-start)) (p+v (vector-ref at (second m)) (arm m 'offset-end))))) (second l) (third l)))))
(say (map (lambda (l) (same? (lifted l) (heavy l))) (list between-posts on-posts)))
; expect: ((#t #t))
; the arms act: a load on a bracket that a post carries by its face bends the post by force times arm and length
(define bracket (members-of (list (post 0 3) (make-cylinder (xyz 0.1 0 3) (xyz 1 0 3) 0.05)) #:offsets #t))
(define bent (let ((nodes (first bracket))) (frame-solve (frame nodes (second bracket) #:sections (third bracket) #:supports (on-ground nodes) #:loads (list (list (nearest-node nodes (xyz 1 0 3)) (vxyz 0 0 -1000)))))))
(say (rounded (second bracket)) (same? (cy (reaction-moment bent (first (first (on-ground (first bracket)))))) -1000))
; expect: (((1 2 offset-end (vxyz -0.1 0 0)) (2 3)) #t)
; ends that are far from all, or already joined, stay; without members all is as before
(define hall-of-lines (list (make-line origin (xyz 0 0 3) (xyz 4 0 3) (xyz 4 0 0)) (make-line (xyz 9 9 9) (xyz 9 9 12))))
(say (equal? (parts-of-list (members-of hall-of-lines #:section 0.01 #:offsets #t)) (parts-of-list (members-of hall-of-lines #:section 0.01))))
; expect: (#t)
(fails (members-of (post 0 3) #:offsets 1)) ; expect: members-of: offsets must be #t or #f, got 1
; expect no other warnings
