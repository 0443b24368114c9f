; (visualscheme analysis): shells of triangles, beside patch tests, plates by formula, and two benchmarks of the literature
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define (grid f n) (list (net-points f n n) (net-faces n n)))
(define (along nodes f x) (nodes-where nodes (lambda (p) (near? (f p) x 1e-9))))

; ---- patch tests: any mesh carries constant strains and curvatures exactly ----
(define patch (list origin (xyz 2.4 0 0) (xyz 2.4 1.2 0) (xyz 0 1.2 0) (xyz 0.4 0.2 0) (xyz 1.8 0.3 0) (xyz 1.6 0.8 0) (xyz 0.8 0.8 0)))
(define faces '((1 2 6 5) (2 3 7 6) (3 4 8 7) (4 1 5 8) (5 6 7 8)))
(define steel (structural-material 210e9 #:shear (/ 210e9 2.6)))
(define flexure (/ (* 210e9 1e-6) 12 (- 1 0.09))) ; of 10 mm
(define (of supports loads)
  (frame-solve (frame patch '() #:shells faces #:thickness 0.01 #:shell-materials steel #:supports supports #:loads loads)))
(define slant (lambda (p) (let ((c (cos 0.7)) (s (sin 0.7))) (xyz (cx p) (- (* c (cy p)) (* s (cz p))) (+ (* s (cy p)) (* c (cz p)))))))
(define (turned v) (if (= 0 (vlength v)) v (p->q origin (slant (p+v origin v)))))
; tension of 1000 N/m along x: the side of 1.2 m carries it as a force and a moment at each corner, which the element's own
; sides share: 3/2 / 12 q l^2
(define pull (list (list 2 (vxyz 600 0 0) (vxyz 0 0 -180)) (list 3 (vxyz 600 0 0) (vxyz 0 0 180)) (list 1 (vxyz -600 0 0) (vxyz 0 0 180)) (list 4 (vxyz -600 0 0) (vxyz 0 0 -180))))
(define pulled (of '((1 x y z rx ry) (2 y z) (4 z)) pull))
(say (every (lambda (n p) (near? (displacement pulled n) (vxyz (/ (* 1000 (cx p)) 210e9 0.01) (/ (* -300 (cy p)) 210e9 0.01) 0) 1e-16)) (iota 8 1) patch)
     (every (lambda (i) (let ((f (shell-forces pulled i))) (and (same? (first f) 1000) (every (lambda (x) (< (abs x) 1e-7)) (cdr f)) (same? (shell-stress pulled i) 1e5)))) (iota (shell-count pulled) 1)))
; expect: (#t #t)
; bending of 100 Nm/m about y, and twisting by a force at a corner; in a plane that is turned, too
(define bend (list (list '(2 3) (vxyz 0 0 0) (vxyz 0 -60 0)) (list '(1 4) (vxyz 0 0 0) (vxyz 0 60 0))))
(define bent (of '((1 x y z rz) (2 y z) (4 x z)) bend))
(say (every (lambda (i) (let ((f (shell-forces bent i))) (and (same? (fourth f) 100) (every (lambda (x) (< (abs x) 1e-7)) (append (take f 3) (drop f 4)))))) (iota (shell-count bent) 1)))
; expect: (#t)
(define twist (of '((1 pinned rz) (2 y z) (4 z)) (list (list 3 (vxyz 0 0 -100)))))
(define leaning (frame-solve (frame (map slant patch) '() #:shells faces #:thickness 0.01 #:shell-materials steel #:supports '((1 pinned) (2 pinned) (4 pinned)) #:loads (list (list 3 (turned (vxyz 0 0 -100)))))))
(say (same? (cz (displacement twist 3)) (/ (* -100 2.4 1.2) 2 flexure 0.7)) (every (lambda (i) (same? (abs (sixth (shell-forces twist i))) 50)) (iota (shell-count twist) 1))
     (same? (vlength (displacement leaning 3)) (/ (* 100 2.4 1.2) 2 flexure 0.7)))
; expect: (#t #t #t)

; ---- plates ----
; a square plate of 2 m on four edges, 1000 N/m2: w = .00406 q a^4 / D and m = .0479 q a^2 in its middle (Timoshenko, Theory
; of Plates and Shells, table 8)
(define square-mesh (grid (lambda (u v) (xyz (* 2 u) (* 2 v) 0)) 16))
(define edges (nodes-where (first square-mesh) (lambda (p) (or (= 0 (cx p)) (= 0 (cy p)) (= 2 (cx p)) (= 2 (cy p))))))
(define slab (frame-solve (frame (first square-mesh) '() #:shells (second square-mesh) #:thickness 0.01 #:shell-materials steel
                            #:supports (list (list edges 'z) '(1 x y rz) '(17 y)) #:loads (list (list 'plan (second square-mesh) (vxyz 0 0 -1000))))))
(define middle (nearest-node (first square-mesh) (xyz 1 1 0)))
(say (near? (/ (cz (displacement slab middle)) (/ (* -0.00406 16000) flexure)) 1 0.01)
     (near? (/ (fourth (shell-forces slab 239)) (* 0.0479 4000)) 1 0.03)
     (near? (fold + 0 (map (lambda (n) (cz (reaction slab n))) edges)) 4000 1e-6))
; expect: (#t #t #t)

; ---- shells and members in one model: a slab on four columns gives each a quarter of its weight ----
(define on-columns
  (let* ((g (grid (lambda (u v) (xyz (* 4 u) (* 4 v) 3)) 6)) (nodes (first g)) (n (length nodes)) (tops (map (lambda (p) (nearest-node nodes p)) (list (xyz 0 0 3) (xyz 4 0 3) (xyz 0 4 3) (xyz 4 4 3)))))
    (frame-solve (frame (append nodes (list origin (xyz 4 0 0) (xyz 0 4 0) (xyz 4 4 0))) (map (lambda (t k) (list (+ n k) t)) tops '(1 2 3 4)) #:sections (tube-section 0.2 0.01)
                   #:materials (structural-material 210e9) #:shells (second g) #:thickness 0.2 #:supports (map (lambda (k) (list (+ n k) 'fixed)) '(1 2 3 4)) #:loads '(weight)))))
(say (every (lambda (i) (near? (/ (member-force on-columns i) (* -2500 9.81 16 0.2 1/4)) 1 0.02)) '(1 2 3 4))
     (same? (apply + (map (lambda (i) (member-force on-columns i)) '(1 2 3 4))) (* -2500 9.81 16 0.2))
     (length (shell-picture on-columns)) (length (shell-picture on-columns #:show 'displacement #:factor 100)))
; expect: (#t #t 72 72)

; ---- benchmarks: R. H. MacNeal, R. L. Harder, "A proposed standard set of problems to test finite element accuracy", 1985 ----
; the Scordelis-Lo roof: a quarter with 8 x 8 faces; .3024 at the middle of the free edge
(define soft (structural-material 4.32e8 #:shear 2.16e8 #:density 36))
(define (scordelis-lo n)
  (let* ((a (degrees->radians 40)) (g (grid (lambda (u v) (xyz (* 25 (sin (* a u))) (* 25 v) (* 25 (cos (* a u))))) n)) (nodes (first g))
         (r (frame-solve (frame nodes '() #:shells (second g) #:thickness 0.25 #:shell-materials soft #:loads (list (list 'weight (vxyz 0 0 -10)))
                           #:supports (list (list (along nodes cx 0) 'x 'ry 'rz) (list (along nodes cy 0) 'y 'rx 'rz) (list (along nodes cy 25) 'x 'z))))))
    (- (cz (displacement r (nearest-node nodes (xyz (* 25 (sin a)) 0 (* 25 (cos a)))))))))
(define roof (map (lambda (n) (/ (scordelis-lo n) 0.3024)) '(4 8 16)))
(say (every (lambda (x) (< 0.97 x 1.03)) roof))
; expect: (#t)
; the pinched cylinder with end diaphragms: an eighth with 16 x 16 faces; 1.8248e-5 under the force
(define cloth (structural-material 3e6 #:shear (/ 3e6 2.6)))
(define (pinched n)
  (let* ((g (grid (lambda (u v) (xyz (* 300 (sin (* pi/2 u))) (* 300 v) (* 300 (cos (* pi/2 u))))) n)) (nodes (first g)) (top (nearest-node nodes (xyz 0 0 300)))
         (r (frame-solve (frame nodes '() #:shells (second g) #:thickness 3 #:shell-materials cloth #:loads (list (list top (vxyz 0 0 -0.25))) ; expect warning: frame: a modulus of 3000000.0 Pa is softer than rubber
                           #:supports (list (list (along nodes cx 0) 'x 'ry 'rz) (list (along nodes cz 0) 'z 'rx 'ry) (list (along nodes cy 0) 'y 'rx 'rz) (list (along nodes cy 300) 'x 'z))))))
    (- (cz (displacement r top)))))
(say (< 0.97 (/ (pinched 16) 1.8248e-5) 1.03))
; expect: (#t)

; ---- bad input ----
(fails (frame patch '() #:supports '(1) #:shells faces))                       ; expect: frame: thickness must be given for shells: a number in m, or a list with one for each face
(fails (frame patch '() #:supports '(1) #:shells faces #:thickness 0))         ; expect: frame: thickness must be positive, got 0
(fails (frame patch '() #:supports '(1) #:shells '((1 2)) #:thickness 0.1))    ; expect: frame: shell 1 must be a list of three or four nodes, got (1 2)
(fails (frame patch '() #:supports '(1) #:shells '((1 2 9)) #:thickness 0.1))  ; expect: frame: shell 1: a node must be a number from 1 to 8, got 9
(fails (frame patch '() #:supports '(1) #:shells '((1 2 2)) #:thickness 0.1))  ; expect: frame: shell 1 has no area: its nodes are (1 2 2)
(fails (frame patch '() #:supports '(1) #:shells faces #:thickness 0.1 #:shell-materials 'c24)) ; expect: frame: shell 1 is of c24, whose shear modulus is not that of a material equal in all directions
(fails (frame-solve (frame patch '() #:supports '((1 pinned)) #:shells faces #:thickness 0.1 #:loads (list (list 3 (vxyz 0 0 -1)))))) ; expect: frame-solve: the frame is a mechanism: node 2 moves along (vxyz 0 0 1), and nothing resists; add a support, a member or a rigid joint
(fails (vibration-modes (frame patch '() #:supports '(1) #:shells faces #:thickness 0.1))) ; expect: vibration-modes: the frame has shells: modes are those of members
(fails (shell-forces slab 1000))                                               ; expect: shell-forces: i must be a shell from 1 to 512, got 1000
(frame patch '() #:supports '(1) #:shells faces #:thickness 10)                ; expect warning: frame: a shell is 10 m thick: metres are expected, 1 mm is 0.001 m
; expect no other warnings
