; (visualscheme analysis): movements within members by closed forms, to 1e-9; utilisation by EN 1993-1-1; pictures
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define e 210e9)
(define fy 235e6)
(define tube (tube-section 0.1 0.005))
(define i (/ (* pi (- (expt 0.1 4) (expt 0.09 4))) 64))
(define a (section-area tube))
(define w (/ i 0.05))
(define beam (list origin (xyz 4 0 0)))
(define (solve members supports loads) (frame-solve (frame beam members #:supports supports #:loads loads #:sections tube)))

; one member each: simple, fixed and hinged beams under 2000 N/m, a column that hangs in its weight, a cantilever's curve
(define line (list (list 'members (vxyz 0 300 -2000))))
(define simple (solve '((1 2)) '((1 pinned rx) (2 y z)) line))
(define fixed (solve '((1 2)) '(1 2) line))
(define hinged (solve '((1 2 hinged)) '(1 2) line))
(define q 2000)
(define tip (solve '((1 2)) '(1) (list (list 2 (vxyz 0 0 -1000)))))
(define hanging (frame-solve (frame (list origin (xyz 0 0 -6)) '((1 2)) #:supports '(1) #:sections tube #:loads '(weight))))
(say (same? (cz (member-displacement simple 1 1/2)) (/ (* -5 q 256) 384 e i)) (same? (cy (member-displacement simple 1 1/2)) (/ (* 5 300 256) 384 e i))
     (same? (cz (member-displacement fixed 1 1/2)) (/ (* -1 q 256) 384 e i)) (same? (cz (member-displacement hinged 1 1/2)) (/ (* -5 q 256) 384 e i))
     (same? (cz (member-displacement tip 1 1/2)) (/ (* -1000 4 (- 12 2)) 6 e i)) (same? (cz (member-displacement hanging 1 1/2)) (/ (* -9.81 7850 3/4 36) 2 e)))
; expect: (#t #t #t #t #t #t)
(say (map (lambda (t) (near? (member-displacement tip 1 t) (displacement tip (if (= t 0) 1 2)))) '(0 1)))
; expect: ((#t #t))

; utilisation: bending alone, both ways in a tube and in a box, shear of a stocky cantilever, tension
(define box (box-section 0.1 0.2 0.008))
(define (bent section force long)
  (utilisation (frame-solve (frame (list origin (xyz long 0 0)) '((1 2)) #:supports '(1) #:sections section #:loads (list (list 2 force)))) 1))
(define (box-i b h) (/ (- (* b (expt h 3)) (* (- b 0.016) (expt (- h 0.016) 3))) 12))
(say (same? (utilisation (solve '((1 2)) '((1 pinned rx) (2 y z)) (list (list 'members (vxyz 0 0 -2000)))) 1) (/ 4000 w fy))
     (same? (bent tube (vxyz 0 -300 400) 2) (/ 1000 w fy))
     (same? (bent box (vxyz 0 300 -4000) 2) (+ (/ 8000 (/ (box-i 0.1 0.2) 0.1) fy) (/ 600 (/ (box-i 0.2 0.1) 0.05) fy)))
     (same? (bent box (vxyz 0 0 -90000) 0.01) (/ (* 90000 (sqrt 3)) fy (/ (* (section-area box) 0.2) 0.3)))
     (same? (bent tube (vxyz 0 0 -90000) 0.001) (/ (* 90000 (sqrt 3)) fy (/ (* 2 a) pi)))
     (same? (bent tube (vxyz 90000 0 0) 2) (/ 90000 a fy)))
; expect: (#t #t #t #t #t #t)

; buckling: a bar whose slenderness is 1 has the reduction 0.5399 (curve c) or 0.6656 (curve a), each by 6.3.1.2
(define (length-for section inertia lambda-bar) (* lambda-bar pi (sqrt (/ (* e inertia) (* (section-area section) fy)))))
(define (pressed section long n . options)
  (let ((r (frame-solve (frame (list origin (xyz 0 0 long)) '((1 2)) #:supports '((1 pinned rz) (2 x y)) #:sections section #:loads (list (list 2 (vxyz 0 0 (- n))))))))
    (utilisation r 1 #:forming (if (pair? options) (car options) 'cold))))
(define (reduction alpha l) (let ((phi (* 0.5 (+ 1 (* alpha (- l 0.2)) (* l l))))) (if (< l 0.2) 1 (/ 1 (+ phi (sqrt (- (* phi phi) (* l l))))))))
(say (near? (reduction 0.49 1) 0.5399 1e-4) (near? (reduction 0.21 1) 0.6656 1e-4))
; expect: (#t #t)
(define npl (* a fy))
(say (map (lambda (l) (same? (pressed tube (length-for tube i l) (* 0.5 npl)) (/ 0.5 (reduction 0.49 l)))) '(0.1 0.5 1 2 3))
     (map (lambda (l) (same? (pressed tube (length-for tube i l) (* 0.5 npl) 'hot) (/ 0.5 (reduction 0.21 l)))) '(0.1 0.5 1 2 3))
     (let* ((s (rectangle-section 0.04 0.08)) (weak (/ (* 0.08 (expt 0.04 3)) 12))) ; a full section buckles about its weak axis, by curve c
       (map (lambda (l) (same? (pressed s (length-for s weak l) (* 0.2 (section-area s) fy) 'hot) (/ 0.2 (reduction 0.49 l)))) '(0.5 1 2))))
; expect: ((#t #t #t #t #t) (#t #t #t #t #t) (#t #t #t))
; compression and bending, 6.61 and 6.62 with the factors of table B.1
(define long (length-for tube i 1))
(define both (frame-solve (frame (list origin (xyz long 0 0)) '((1 2)) #:supports '((1 pinned rx) (2 y z)) #:sections tube
                            #:loads (list (list 2 (vxyz (* -0.2 npl) 0 0)) (list 'members (vxyz 0 0 -500))))))
(let* ((n (/ 0.2 (reduction 0.49 1))) (m (/ (* 500 long long) 8 w fy)) (k (+ 1 (* 0.6 n))))
  (say (same? (utilisation both 1) (+ n (* k m))) (same? (utilisation both 1 #:partial-factor 1.1) (+ (* 1.1 n) (* 1.1 m (+ 1 (* 0.66 n)))))
       (same? (utilisation both 1 #:buckling-length 1/2) (let ((h (/ 0.2 (reduction 0.49 0.5)))) (+ h (* m (+ 1 (* 0.3 h))))))))
; expect: (#t #t #t)
; of several cases the worst counts
(define cases (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads (list (list "a" (list 2 (vxyz 0 0 -100))) (list "b" (list 2 (vxyz 0 900 0)))))))
(say (same? (utilisation cases 1) (utilisation cases 1 #:case "b")) (same? (utilisation cases 1 #:case "a") (/ 400 w fy)))
; expect: (#t #t)
(fails (utilisation (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections tube #:materials 'c24)) 1)) ; expect: utilisation: member 1 is of timber, and its section is a tube: the check is that of rectangles and circles
(fails (utilisation (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections tube #:materials 200e9)) 1)) ; expect: utilisation: member 1 is of a material without a #:strength
(fails (utilisation (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections (any-section 1e-3 #:iy 1e-6 #:iz 1e-6))) 1)) ; expect: utilisation: the section of member 1 has no #:wy and #:wz
(fails (utilisation simple 1 #:forming 'warm)) ; expect: utilisation: forming must be 'cold or 'hot, got warm
(fails (utilisation simple 2))                 ; expect: utilisation: i must be a member from 1 to 1, got 2
(define bars (frame-solve (frame (list (xz -3 0) (xz 0 4) (xz 3 0)) '((1 2) (2 3)) #:supports '((1 pinned) (3 pinned)) #:plane 'xz #:sections 1e-3 #:loads (list (list 2 (vxyz 0 0 -8000))))))
(say (same? (utilisation bars 1) (/ 5000 1e-3 fy))) ; expect: (#t)
; expect warning 75: utilisation: a bar is pressed, and its section is an area alone: buckling is not checked
(define thin (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections (tube-section 0.5 0.002))))
(utilisation thin 1) ; expect warning: utilisation: the wall of a tube 0.5 x 0.002 may buckle: d/t is above 90.0 (class 4)

; pictures
(say (length (deformed simple #:factor 10)) (same? (curve-length (car (deformed hanging))) (+ 6 (/ (* 9.81 7850 36) 2 e)))
     (length (frame-picture bars #:show 'force #:radius 0.1)) (near? (volume (frame-picture tip)) (* pi 0.0025 4) 1e-3)
     (same? (caddr (last (map (lambda (p) (list (cx p) (cy p) (cz p))) (bounding-box (frame-picture tip #:factor 0))))) 0.05)
     (length (color-legend 0 1 #:fields 6)))
; expect: (1 #t 2 #t #t 12)
(fails (frame-picture tip #:show 'stress)) ; expect: frame-picture: show must be 'utilisation, 'force or 'displacement, got stress
(fails (color-legend 0 1 #:fields 1))      ; expect: color-legend: fields must be a number from 2 to 50, got 1
(fails (member-displacement tip 1 2))      ; expect: member-displacement: t must be a part of the length from 0 to 1, got 2
; expect no other warnings
