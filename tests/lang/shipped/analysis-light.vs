; (visualscheme analysis): view factors, daylight factors and hours of sun, beside closed forms
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))

; ---- view factors (J. R. Howell, "A catalog of radiation heat transfer configuration factors", C-11 and C-14) ----
(define (plate w l z) (list (xyz 0 0 z) (xyz w 0 z) (xyz w l z) (xyz 0 l z)))
(define (facing w l z) (reverse (plate w l z)))
(define (parallel x y) ; sides over the distance
  (let ((a (+ 1 (* x x))) (b (+ 1 (* y y))))
    (* (/ 2 pi x y) (+ (/ (log (/ (* a b) (+ 1 (* x x) (* y y)))) 2) (* x (sqrt b) (atan (/ x (sqrt b)))) (* y (sqrt a) (atan (/ y (sqrt a)))) (- 0 (* x (atan x)) (* y (atan y)))))))
(say (near? (parallel 1 1) 0.199825 1e-6)
     (every (lambda (w l h) (near? (view-factor (plate w l 0) (facing w l h)) (parallel (/ w h) (/ l h)) 1e-7)) '(1 1 3 10 1) '(1 2 0.5 10 1) '(1 1 1 1 5)))
; expect: (#t #t)
(define (upright l z) (list origin (xyz 0 l 0) (xyz 0 l z) (xyz 0 0 z)))
(define (meeting h w) ; height and width over the common side
  (let ((a (+ 1 (* w w))) (b (+ 1 (* h h))) (c (+ 1 (* h h) (* w w))))
    (/ (+ (* w (atan (/ 1 w))) (* h (atan (/ 1 h))) (* -1 (sqrt (+ (* h h) (* w w))) (atan (/ 1 (sqrt (+ (* h h) (* w w))))))
          (* 1/4 (log (* (/ (* a b) c) (expt (/ (* w w c) a (+ (* w w) (* h h))) (* w w)) (expt (/ (* h h c) b (+ (* w w) (* h h))) (* h h))))))
       pi w)))
(say (near? (meeting 1 1) 0.200044 1e-6)
     (every (lambda (w l h) (near? (view-factor (plate w l 0) (upright l h)) (meeting (/ h l) (/ w l)) 1e-6)) '(1 2 1) '(1 1 3) '(1 0.5 1)))
; expect: (#t #t)
; reciprocity, and a closed box: all parts together are 1
(define box-sides (list (plate 3 2 0) (facing 3 2 1) (list origin (xyz 0 2 0) (xyz 0 2 1) (xyz 0 0 1)) (list (xyz 3 0 0) (xyz 3 0 1) (xyz 3 2 1) (xyz 3 2 0))
                        (list origin (xyz 0 0 1) (xyz 3 0 1) (xyz 3 0 0)) (list (xyz 0 2 0) (xyz 3 2 0) (xyz 3 2 1) (xyz 0 2 1))))
(say (every (lambda (a) (near? (apply + (map (lambda (b) (view-factor a b)) (remove (lambda (b) (eq? a b)) box-sides))) 1 1e-6)) box-sides)
     (same? (* 6 (view-factor (first box-sides) (third box-sides))) (* 2 (view-factor (third box-sides) (first box-sides))))
     (view-factor (plate 1 1 0) (plate 1 1 1)))
; expect: (#t #t 0)
(fails (view-factor (list origin origin) box-sides)) ; expect: view-factor: a must be a list of three points or more, got ((xyz 0 0 0) (xyz 0 0 0))

; ---- daylight: the overcast sky of the CIE ----
(define house (make-box origin (xyz 10 10 6)))
; nothing in the way: 1; a round eye in a dome, by the integral of the sky within an angle a of the zenith
(say (same? (daylight-factor origin) 1) (daylight-factor (list origin) #:among (make-box (xyz -9 -9 1) (xyz 9 9 2)) #:rays 64))
; expect: (#t (0.0))
(define (eye a) (subtract (make-cylinder (xyz 0 0 10) 0.01 2000) (make-cylinder (xyz 0 0 9) 3 (* 10 (tan a)))))
(say (every (lambda (a) (near? (daylight-factor origin #:among (eye a) #:rays 20000) (* 6/7 (+ (* 1/2 (square (sin a))) (* 2/3 (- 1 (expt (cos a) 3))))) 2e-3)) '(0.2 0.4 0.8 1.2 1.5)))
; expect: (#t)
; a window in a wall: the integral over its opening, by the rule of the middle
(define (window-part w z0 z1 d)
  (let ((n 200) (sum 0))
    (do ((i 0 (+ i 1))) ((= i n))
      (do ((k 0 (+ k 1))) ((= k n))
        (let* ((x (* w (- (/ (+ i 0.5) n) 0.5))) (z (+ z0 (* (- z1 z0) (/ (+ k 0.5) n)))) (r (sqrt (+ (* x x) (* d d) (* z z)))))
          (set! sum (+ sum (/ (* (+ 1 (* 2 (/ z r))) z d) (expt r 4)))))))
    (/ (* sum w (- z1 z0)) n n 3 (* 7/9 pi))))
(define wall (subtract (make-box (xyz -500 0 -1) (xyz 500 1e-4 500)) (make-box (xyz -0.75 -1 0.1) (xyz 0.75 1 1.6))))
(define behind (make-box (xyz -500 -100 400) (xyz 500 0 401)))
(define shades (list wall behind (make-box (xyz -500 -101 -1) (xyz 500 -100 500)) (make-box (xyz -500 -101 -1) (xyz -499 0 500)) (make-box (xyz 499 -101 -1) (xyz 500 0 500))))
(say (every (lambda (d) (near? (/ (daylight-factor (xyz 0 (- d) 0) #:among shades #:rays 40000) (window-part 1.5 0.1 1.6 d)) 1 0.02)) '(1 2 4)))
; expect: (#t)
; glass and the light from inner surfaces
(say (near? (daylight-factor origin #:among (eye 0.8) #:glass 0.7 #:inner 0.01) (+ 0.01 (* 0.7 (daylight-factor origin #:among (eye 0.8))))))
; expect: (#t)
(fails (daylight-factor origin #:glass 2)) ; expect: daylight-factor: glass must be a number from 0 to 1, got 2
(fails (daylight-factor origin #:rays 1))  ; expect: daylight-factor: rays must be an exact integer from 16 to 1000000, got 1

; reflections within a ball are even (Sumpner, 1892): a hole of half-angle a lets in the part sin2 a / 4 of the area, of which
; the ball reflects r, and of the rest all but the hole's part f of it, again and again
(define (ball a) (make-mesh (map (lambda (i) (map (lambda (k) (+sph (xyz 0 0 1) 1 (* k pi 1/36) (+ a (* (- pi a) (/ i 40.0))))) (iota 73))) (iota 41))))
(define (in-ball a r) (let ((f (/ (- 1 (cos a)) 2))) (/ (* r 1/4 (square (sin a))) (- 1 (* r (- 1 f))))))
(define (reflected-in a r) (let ((bottom (xyz 0 0 0.002))) (- (daylight-factor bottom #:among (ball a) #:reflectance r #:rays 20000) (daylight-factor bottom #:among (ball a) #:rays 20000))))
(say (map (lambda (a r) (near? (/ (reflected-in a r) (in-ball a r)) 1 0.03)) '(0.3 0.6 0.9) '(0.9 0.5 0.3)))
; expect: ((#t #t #t))
; a ceiling without walls sends down what the ground reflects, and each surface has its own reflectance
(define ceiling (make-box (xyz -1e5 -1e5 3) (xyz 1e5 1e5 4)))
(say (same? (daylight-factor origin #:among ceiling #:reflectance 0.5) 0.1) (daylight-factor origin #:among ceiling #:reflectance 0.5 #:albedo 0) (near? (daylight-factor (xyz 0 0 4.1) #:among ceiling #:reflectance 0.5) 1)
     (let ((low (daylight-factor (xyz 2 0 0.1) #:among (list (make-box (xyz -9 -9 -1) (xyz 9 9 0)) (make-box (xyz -1 -9 1) (xyz 9 9 2))) #:reflectance '(0.8 0.1)))
           (high (daylight-factor (xyz 2 0 0.1) #:among (list (make-box (xyz -9 -9 -1) (xyz 9 9 0)) (make-box (xyz -1 -9 1) (xyz 9 9 2))) #:reflectance '(0.8 0.8))))
       (> high (* 2 low))))
; expect: (#t 0.0 #t #t)
(say (same? (illuminance (xyz 0 0 0) #:among (eye 0.8) #:outdoor 5000 #:glass 0.7 #:inner 0.01) (* 5000 (daylight-factor origin #:among (eye 0.8) #:glass 0.7 #:inner 0.01))) (illuminance (list origin)))
; expect: (#t (10000.0))
(fails (daylight-factor origin #:among house #:reflectance 1)) ; expect: daylight-factor: reflectance must be a number from 0 to 0.95, or a list of them, got 1
(fails (daylight-factor origin #:among house #:reflectance '(0.1 0.2))) ; expect: daylight-factor: reflectance must be one, or a list of 1, one for each object of #:among, got 2
(fails (daylight-factor origin #:albedo -1)) ; expect: daylight-factor: albedo must be a number from 0 to 1, got -1
(fails (illuminance origin #:outdoor 0)) ; expect: illuminance: outdoor must be positive, got 0
(fails (daylight-factor origin #:among (make-line origin (xyz 1 0 0)) #:reflectance 0.5)) ; expect: daylight-factor: among must be solids and surfaces, got a line

; grids: middles of squares, level, within a region with a hole, at some distance from walls; a room narrower than a step
(define l-room (list origin (xy 4 0) (xy 4 2) (xy 2 2) (xy 2 4) (xy 0 4)))
(say (map (lambda (step margin) (length (grid-points l-room #:step step #:margin margin))) '(1 0.5 0.5 1) '(0 0 0.5 1)) (first (grid-points l-room #:step 1 #:height 0.85)))
; expect warning 85: do-offset: no part of the profile lies so far inside
; expect: ((12 48 20 0) (xyz 0.5 0.5 0.85))
(say (grid-points (make-region (make-rectangle origin (xy 0.3 0.2)) (make-circle (xy 0.15 0.1) 0.05)) #:step 1) (length (grid-points (make-region (make-rectangle origin (xy 0.3 2)))))
     (map area (map (lambda (f) (make-region (apply make-polygon f))) (grid-faces (list (xyz 1 2 3)) 0.5))))
; expect: (() 4 (0.25))
(fails (grid-points l-room #:step 0)) ; expect: grid-points: step must be positive, got 0
(fails (grid-points l-room #:step 1e-4)) ; expect: grid-points: step 0.0001 is too fine for a room of 4.0 by 4.0
(fails (grid-points l-room #:margin -1)) ; expect: grid-points: margin must not be negative, got -1
(fails (grid-faces '(1) 1)) ; expect: grid-faces: points must be a list of points, got (1)

; ---- faces ----
; all of a box's faces: none below, the roof has the whole day, and a wall that another building shades has less
(define faces (faces-in house))
(define (hours . among) (sun-hours-on faces #:latitude 40 #:date "2026-06-21" #:among among))
(define (facing-way v values) (filter-map (lambda (f h) (and (> (dot v (let ((p (car f))) (cross (p->q p (second f)) (p->q p (third f))))) 1e-9) h)) faces values))
(say (length faces) (facing-way (vxyz 0 0 -1) (hours house)) (every (lambda (h) (< 14.5 h 15.1)) (facing-way (vxyz 0 0 1) (hours house)))
     (< (apply + (hours house (make-box (xyz -20 -6 0) (xyz 30 -5 30)))) (apply + (hours house))))
; expect: (12 (0.0 0.0) #t #t)
(say (length (color-faces faces (hours house))))
; expect: (12)
(fails (color-faces faces '(1))) ; expect: color-faces: there must be a value for each face
(fails (faces-in (make-line origin (xyz 1 0 0)))) ; expect: faces-in: o must be surfaces or solids, got a line
; expect no other warnings
