; (visualscheme analysis): frames and trusses by closed forms, to 1e-9
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define e 210e9)
(define g 81e9)
(define tube (tube-section 0.1 0.005))
(define i (/ (* pi (- (expt 0.1 4) (expt 0.09 4))) 64))
(define a (/ (* pi (- (square 0.1) (square 0.09))) 4))
(define beam (list origin (xyz 3 0 0)))
(define (solve nodes members supports loads)
  (frame-solve (frame nodes members #:supports supports #:loads loads #:sections tube)))

; a cantilever of 3 m, with its end moved by a force across, along, by a moment about its axis and across
(define (end-of force moment) (solve beam '((1 2)) '(1) (list (list 2 force moment))))
(define zero (vxyz 0 0 0))
(say (same? (cz (displacement (end-of (vxyz 0 0 -1000) zero) 2)) (/ (* -1000 27) 3 e i))
     (same? (cy (displacement (end-of (vxyz 0 1000 0) zero) 2)) (/ (* 1000 27) 3 e i))
     (same? (cx (displacement (end-of (vxyz 5000 0 0) zero) 2)) (/ (* 5000 3) e a))
     (same? (cy (rotation (end-of (vxyz 0 0 -1000) zero) 2)) (/ (* 1000 9) 2 e i))
     (same? (cx (rotation (end-of zero (vxyz 700 0 0)) 2)) (/ (* 700 3) g 2 i))
     (same? (cz (displacement (end-of zero (vxyz 0 700 0)) 2)) (/ (* -700 9) 2 e i)))
; expect: (#t #t #t #t #t #t)
(define r (end-of (vxyz 2000 0 -1000) zero))
(say (near? (reaction r 1) (vxyz -2000 0 1000)) (same? (cy (reaction-moment r 1)) -3000) (same? (member-force r 1) 2000) (map round (member-forces r 1 1/3)))
; expect: (#t #t #t (2000.0 0.0 1000.0 0.0 -2000.0 0.0))

; a propped cantilever, a beam fixed at both ends, and a simple beam in two members, all under 2000 N/m on 4 m
(define line (list (list 'members (vxyz 0 0 -2000))))
(define long (list origin (xyz 4 0 0)))
(define propped (solve long '((1 2)) '(1 (2 z)) line))
(define hinged (solve long '((1 2 hinged-end)) '(1 2) line))
(define fixed (solve long '((1 2)) '(1 2) line))
(define simple (solve (list origin (xyz 2 0 0) (xyz 4 0 0)) '((1 2) (2 3)) '((1 pinned rx) (3 y z)) line))
(say (same? (cz (reaction propped 2)) 3000) (same? (cy (reaction-moment propped 1)) -4000)
     (same? (cz (reaction hinged 2)) 3000) (same? (cy (reaction-moment hinged 1)) -4000)
     (same? (cy (reaction-moment fixed 1)) (/ (* -2000 16) 12)) (same? (fifth (member-forces fixed 1 1/2)) (/ (* 2000 16) 24))
     (same? (cz (displacement simple 2)) (/ (* -5 2000 256) 384 e i)) (same? (fifth (member-forces simple 1 1)) 4000)
     (same? (fifth (member-forces simple 2 1/2)) 3000) (same? (third (member-forces simple 1 0)) 4000))
; expect: (#t #t #t #t #t #t #t #t #t #t)

; a portal with fixed feet, pushed at both upper corners: column h, beam l; the columns' axial forces are considered
(define h 4) (define l 6) (define push 1000)
(define portal (solve (list (xz 0 0) (xz 0 h) (xz l h) (xz l 0)) '((1 2) (2 3) (3 4)) '(1 4) (list (list '(2 3) (vxyz push 0 0)))))
(define up (/ (* 12 (/ i l l)) (+ (/ a h) (/ (* 24 i) l l l))))
(define corner (- (/ (* 6 e i) l) (* 12 (/ (* e i) l l) up)))
(define sway (/ push (- (/ (* 12 e i) h h h) (/ (square (/ (* 6 e i) h h)) (+ (/ (* 4 e i) h) corner)))))
(say (same? (cx (displacement portal 2)) sway) (same? (cx (displacement portal 3)) sway)
     (same? (cx (reaction portal 1)) (- push)) (same? (cz (reaction portal 1)) (- (cz (reaction portal 4)))))
; expect: (#t #t #t #t)

; a beam with a hinge within: the left part is a cantilever, the right part hangs on it
(define gerber (solve (list origin (xyz 2 0 0) (xyz 6 0 0)) '((1 2) (2 3 hinged-start)) '(1 (3 y z)) (list (list 'member 2 (vxyz 0 0 -1500)))))
(say (same? (cz (reaction gerber 3)) 3000) (same? (cy (reaction-moment gerber 1)) -6000) (near? (fifth (member-forces gerber 2 0)) 0)
     (same? (cz (displacement gerber 2)) (/ (* -3000 8) 3 e i)))
; expect: (#t #t #t #t)

; trusses: two bars; three bars, where the middle one has the force p / (1 + 2 cos^3); a tripod; a truss of ten panels, by sections
(define (truss nodes members supports loads) (frame-solve (frame nodes members #:supports supports #:loads loads #:sections 1e-3 #:joints 'pinned)))
(define two (truss (list (xz -3 0) (xz 0 4) (xz 3 0)) '((1 2) (2 3)) '((1 pinned) (2 y) (3 pinned)) (list (list 2 (vxyz 0 0 -8000)))))
(define three (truss (list (xz -3 4) (xz 0 4) (xz 3 4) origin) '((1 4) (2 4) (3 4)) '((1 pinned) (2 pinned) (3 pinned) (4 y)) (list (list 4 (vxyz 0 0 -8000)))))
(define foot (lambda (k) (pol 3 (* k 2/3 pi))))
(define tripod (truss (list (foot 0) (foot 1) (foot 2) (xyz 0 0 4)) '((1 4) (4 2) (3 4)) '((1 pinned) (2 pinned) (3 pinned)) (list (list 4 (vxyz 0 0 -12000)))))
(say (same? (member-force two 1) -5000) (same? (cz (displacement two 2)) (/ (* -8000 125) 2 e 1e-3 16))
     (same? (member-force three 2) (/ 8000 (+ 1 (* 2 (expt 4/5 3))))) (same? (member-force three 1) (/ (* 8000 (square 4/5)) (+ 1 (* 2 (expt 4/5 3)))))
     (every (lambda (k) (same? (member-force tripod k) -5000)) '(1 2 3)) (same? (cz (reaction tripod 2)) 4000))
; expect: (#t #t #t #t #t #t)
(define panels 10)
(define lower (map (lambda (k) (xz k 0)) (iota (+ panels 1))))
(define upper (map (lambda (k) (xz k 1)) (iota (+ panels 1))))
(define n (+ panels 1))
(define pratt
  (frame-solve
    (frame (append lower upper)
      (append (map (lambda (k) (list k (+ k 1))) (iota panels 1)) (map (lambda (k) (list (+ n k) (+ n k 1))) (iota panels 1))
              (map (lambda (k) (list k (+ n k))) (iota n 1)) (map (lambda (k) (list k (+ n k 1))) (iota panels 1)))
      #:supports (list '(1 pinned) (list n 'y 'z)) #:plane 'xz #:joints 'pinned #:sections 1e-3
      #:loads (list (list (iota (- panels 1) 2) (vxyz 0 0 -1000))))))
; in panel k the shear is 4500 - 1000 (k - 1); the lower chord's moment is about the node above
(define (moment k) (- (* 4500 k) (* 500 k (- k 1))))
(say (every (lambda (k) (same? (+ 1 (member-force pratt k)) (+ 1 (moment k)))) (iota panels 1))
     (every (lambda (k) (same? (+ 1 (member-force pratt (+ panels k))) (+ 1 (- (moment (- k 1)))))) (iota panels 1)))
; expect: (#t #t)

; a vertical column carries its weight, and the force at its foot is the greatest
(define column (frame-solve (frame (list origin (xyz 0 0 5)) '((1 2)) #:supports '(1) #:sections (rectangle-section 0.3 0.2) #:materials 'c25/30 #:loads '(weight))))
(say (same? (member-force column 1) (* -9.81 2500 0.06 5)) (same? (cz (displacement column 2)) (/ (* -9.81 2500 25) 2 31e9)))
; expect: (#t #t)
; the depth of a rectangle is upright, and a roll turns it
(define (sag . options)
  (cz (displacement (frame-solve (frame beam (list (append '(1 2) options)) #:supports '(1) #:sections (rectangle-section 0.1 0.2) #:materials 10e9 #:loads (list (list 2 (vxyz 0 0 -1000))))) 2)))
(say (same? (sag) (/ (* -1000 27) 3 10e9 0.1 (/ (expt 0.2 3) 12))) (same? (sag 'roll (/ pi 2)) (/ (* -1000 27) 3 10e9 0.2 (/ (expt 0.1 3) 12)))
     (same? (sag 'roll pi) (sag)))
; expect: (#t #t #t)

; cases and combinations
(define cases (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads (list (list "dead" 'weight) (list "wind" (list 2 (vxyz 0 300 0)))))))
(define uls (combine-cases cases (list "uls" '(1.35 "dead") '(1.5 "wind")) (list "sls" '(1 "dead") '(1 "wind"))))
(say (case-names cases) (case-names uls) (same? (cy (displacement uls 2 #:case "uls")) (* 1.5 (cy (displacement cases 2 #:case "wind"))))
     (same? (cz (reaction uls 1 #:case "uls")) (* 1.35 9.81 7850 a 3)))
; expect: ((dead wind) (uls sls) #t #t)

; torsion of rectangles: the square has 0.140577 of b^4 (Saint-Venant), a thin strip a third of b t^3
(define (torsion s) (/ 1 (cx (rotation (frame-solve (frame (list origin (xyz 1 0 0)) '((1 2)) #:supports '(1) #:sections s #:materials (structural-material 1e9 #:shear 1e9)
                                                     #:loads (list (list 2 zero (vxyz 1e9 0 0))))) 2))))
(say (near? (torsion (rectangle-section 1 1)) 0.140577 1e-6) (near? (/ (torsion (rectangle-section 4 0.004)) (* 1/3 4 (expt 0.004 3))) 1 1e-3)
     (near? (torsion (round-section 1)) (/ pi 32)))
; expect: (#t #t #t)
