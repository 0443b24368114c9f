; (visualscheme analysis): members whose ends lie beside their nodes, by closed forms, to 1e-9
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (all-same? . pairs) (every (lambda (p) (same? (first p) (second p))) pairs))
(define (say . truths) (displayln (every values truths)))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define tube (tube-section 0.1 0.005))
(define e 210e9)
(define i (/ (* pi (- (expt 0.1 4) (expt 0.09 4))) 64))
(define ea (* e (section-area tube)))
(define ei (* e i))
(define gj (* 81e9 2 i))
(define l 3) (define p 1000) (define arm 0.2)
(define (solve nodes members supports . loads) (frame-solve (frame nodes members #:supports supports #:loads loads #:sections tube)))
(define two (list origin (xyz l 0 0)))

; an axial force beside the axis of a cantilever: the moment N e along the whole member; the reaction is in line with the force
(define eccentric (solve two (list (list 1 2 'offset (vxyz 0 0 arm))) '(1) (list 2 (vxyz p 0 0))))
(say (all-same? (list (cx (displacement eccentric 2)) (+ (/ (* p l) ea) (/ (* p arm arm l) ei))) (list (cz (displacement eccentric 2)) (/ (* p arm l l) 2 ei))
  (list (cy (rotation eccentric 2)) (/ (* p arm l) -1 ei)) (list (fifth (member-forces eccentric 1 0)) (* p arm)) (list (fifth (member-forces eccentric 1 1)) (* p arm))
  (list (member-force eccentric 1) p) (list (cx (member-displacement eccentric 1 1)) (/ (* p l) ea)) (list (cz (member-displacement eccentric 1 1/2)) (/ (* p arm l l) 8 ei))))
; expect: #t
(say (near? (reaction-moment eccentric 1) (vxyz 0 0 0) 1e-9) (near? (reaction eccentric 1) (vxyz (- p) 0 0) 1e-9))
; expect: #t
; the stress counts: the share of the strength is that of force and moment together
(say (same? (utilisation eccentric 1) (+ (/ p (section-area tube) 235e6) (/ (* p arm 0.05) i 235e6)))) ; expect: #t
; lines of moments and curves begin and end where the member does
(say (near? (bounding-box (first (moment-lines eccentric #:factor 1e-3))) (list (xyz 0 0 0) (xyz l 0 arm)) 1e-9)) ; expect: #t
(define bent (first (deformed eccentric #:factor 10)))
(say (near? (second (curve-division bent 1)) (p+v (xyz l 0 arm) (v*r (member-displacement eccentric 1 1) 10)) 1e-9)) ; expect: #t
(say (near? (first (bounding-box (first (frame-picture eccentric #:radius 0.01)))) (xyz 0 -0.01 (- arm 0.01)) 1e-3)) ; expect: #t

; an arm along the member, then one across it: bending, and torsion
(define ahead (solve (list origin (xyz (+ l arm) 0 0)) (list (list 1 2 'offset-end (vxyz (- arm) 0 0))) '(1) (list 2 (vxyz 0 0 (- p)))))
(define turn (+ (/ (* p l l) 2 ei) (/ (* p arm l) ei)))
(say (all-same? (list (cy (rotation ahead 2)) turn) (list (cz (displacement ahead 2)) (- (+ (/ (* p l l l) 3 ei) (/ (* p arm l l) 2 ei) (* turn arm))))
  (list (fifth (member-forces ahead 1 1)) (* -1 p arm)) (list (fifth (member-forces ahead 1 0)) (* -1 p (+ l arm))) (list (cy (reaction-moment ahead 1)) (* -1 p (+ l arm)))))
; expect: #t
(define aside (solve (list origin (xyz l (- arm) 0)) (list (list 1 2 'offset-end (vxyz 0 arm 0))) '(1) (list 2 (vxyz 0 0 (- p)))))
(say (all-same? (list (cx (rotation aside 2)) (/ (* p arm l) gj)) (list (fourth (member-forces aside 1 1/2)) (* p arm))
  (list (cz (displacement aside 2)) (- (+ (/ (* p l l l) 3 ei) (/ (* p arm arm l) gj))))))
; expect: #t

; rigid zones at both ends of a beam between walls, of which one moves; a load along the member acts on its clear length
(define zones (list (list 1 2 'offset-start (vxyz arm 0 0) 'offset-end (vxyz (- arm) 0 0))))
(define apart (list origin (xyz (+ l arm arm) 0 0)))
(define sinking (solve apart zones '(1 (2 x y rx ry rz)) (list 2 (vxyz 0 0 (- p)))))
(define loaded (solve apart zones '(1 2) (list 'members (vxyz 0 0 (- p)))))
(say (all-same? (list (cz (displacement sinking 2)) (/ (* -1 p l l l) 12 ei)) (list (cy (reaction-moment sinking 1)) (* -1 p (+ (/ l 2) arm)))
  (list (cz (reaction loaded 1)) (/ (* p l) 2)) (list (cy (reaction-moment loaded 1)) (* -1 (+ (/ (* p l l) 12) (/ (* p l arm) 2))))
  (list (cz (member-displacement loaded 1 1/2)) (/ (* -1 p (expt l 4)) 384 ei))))
; expect: #t

; a hinge at the end of an arm: the node carries the shear force by the arm
(define bracket (solve (list origin (xyz 2 0 0) (xyz 6 0 0)) (list '(1 2) (list 2 3 'hinged-start 'offset-start (vxyz arm 0 0))) '(1 (3 y z)) (list 'member 2 (vxyz 0 0 -1500))))
(define shear (* 750 (- 4 arm)))
(say (all-same? (list (cz (reaction bracket 3)) shear) (list (cy (reaction-moment bracket 1)) (* -1 shear (+ 2 arm)))
  (list (cz (member-displacement bracket 2 0)) (- (cz (displacement bracket 2)) (* (cy (rotation bracket 2)) arm)))))
; expect: #t

; forces and moments of a tower with arms in all directions are in equilibrium about the origin
(define corners (list (xyz 0 0 0) (xyz 3 0 0) (xyz 0 2 0) (xyz 0.3 0.2 4) (xyz 2 1 5)))
(define arms (map (lambda (m k) (append m (list 'offset-start (vxyz (* 0.1 k) -0.2 0.05) 'offset-end (vxyz 0.1 (* 0.07 k) -0.3) 'roll (* 0.3 k)))) '((1 4) (2 4) (3 5) (4 5) (2 5)) (iota 5)))
(define pushed (list (vxyz 300 -700 -2000) (vxyz 40 50 60)))
(define tower (solve corners arms '(1 2 3) (cons 5 pushed)))
(define feet (take corners 3))
(say (near? (fold v+v (first pushed) (map (lambda (n) (reaction tower n)) '(1 2 3))) (vxyz 0 0 0) 1e-6)
  (near? (fold v+v (v+v (second pushed) (cross (p->q origin (fifth corners)) (first pushed))) (map (lambda (q n) (v+v (reaction-moment tower n) (cross (p->q origin q) (reaction tower n)))) feet '(1 2 3))) (vxyz 0 0 0) 1e-6))
; expect: #t
; Maxwell and Betti: the movement by a force elsewhere does not depend on which of both is pushed
(say (same? (cx (displacement (solve corners arms '(1 2 3) (list 5 (vxyz 0 0 p))) 4)) (cz (displacement (solve corners arms '(1 2 3) (list 4 (vxyz p 0 0))) 5)))) ; expect: #t

; a column that carries its load on a rigid arm: tan(k l) = 1 / (k arm); the arm at the foot changes nothing
(define high 4) (define top 1)
(define column (solve (list (xyz 0 0 -0.5) (xyz 0 0 (+ high top))) (list (list 1 2 'offset-start (vxyz 0 0 0.5) 'offset-end (vxyz 0 0 (- top)))) '(1) (list 2 (vxyz 0 0 -1))))
(define k (let halve ((low 1e-3) (up (/ pi 2 high)) (n 60)) (let ((m (/ (+ low up) 2))) (if (= n 0) m (if (< (* m top (tan (* m high))) 1) (halve m up (- n 1)) (halve low m (- n 1)))))))
(define mode (first (buckling-modes column #:segments 16)))
(say (near? (/ (mode-value mode) (* ei k k)) 1 1e-5)) ; expect: #t
; its curve begins at the end of the arm, and moves there as the node and the arm do
(define curve (first (mode-curves mode #:size 0.1)))
(say (near? (cz (first (curve-division curve 1))) 0 1e-9) (near? (cz (second (curve-division curve 1))) high 1e-9)) ; expect: #t
; a mass on the arm: the frequency is that of the stiffness at the node, when the member has no mass
(define light (structural-material e #:shear 81e9 #:strength 235e6))
(define swing (frame (list origin (xyz (+ l arm) 0 0)) (list (list 1 2 'offset-end (vxyz (- arm) 0 0))) #:supports '(1 (2 x y)) #:sections tube #:materials light))
(say (near? (mode-value (first (vibration-modes swing #:masses '((2 100))))) (/ (sqrt (/ p 100 (abs (cz (displacement ahead 2))))) 2 pi) 1e-6)) ; expect: #t

; sections of other sizes keep their arms
(say (same? (fifth (member-forces (size-frame (frame two (list (list 1 2 'offset (vxyz 0 0 arm))) #:supports '(1) #:sections tube #:loads (list (list 2 (vxyz p 0 0)))) (list tube)) 1 0)) (* p arm))) ; expect: #t

; bad arms
(define (bad . options) (frame two (list (append '(1 2) options)) #:supports '(1) #:sections tube))
(fails (bad 'offset 0.2))        ; expect: frame: member 1: an offset must be a gvector from the node to the end, got 0.2
(fails (bad 'offset-end))        ; expect: frame: member 1 has the option offset-end; options are 'hinged, 'hinged-start, 'hinged-end, 'roll before an angle, and 'offset, 'offset-start, 'offset-end before a gvector
(fails (bad 'offset-end (vxyz -3 0 0))) ; expect: frame: member 1 has no length: its ends, of nodes 1 and 2, are both at (xyz 0 0 0)
; expect no other warnings
