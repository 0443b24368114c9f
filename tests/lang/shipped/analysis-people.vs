; (visualscheme analysis): crowds, rooms of a cut, wheelchairs, areas by use, carbon, glass, and two goals
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))

; ---- crowds by hand: speed 1.4 (1 - .266 D), at least at .54 persons a m2; greatest flow 1.4 / (4 x .266) = 1.3158 a metre and second ----
(say (near? (walking-speed 0) 1.19890 1e-5) (near? (walking-speed 2) 0.6552 1e-9) (near? (walking-speed 1 #:kind 'stair) 0.79272 1e-9)
     (same? (flow-time 100 1) (/ 100 (* 0.7 (/ 1.4 4 0.266)))) (same? (flow-time 100 1.2 #:kind 'corridor #:density 1) (/ 100 (* 0.8 1.4 0.734))))
; expect: (#t #t #t #t #t)
(walking-speed 4) ; expect warning: walking-speed: nobody moves among 4 persons a square metre
(fails (flow-time 10 0.3)) ; expect: flow-time: a door of 0.3 m is too narrow: 0.3 m at its sides are not used
(fails (flow-time 10 1 #:kind 'lift)) ; expect: flow-time: kind must be one of (door corridor ramp stair), got lift
; a hall of 20 m with 200 people in its middle: 10 m of way, then the flow; two doors share the crowd
(define hall (list origin (xy 20 0) (xy 20 10) (xy 0 10)))
(define one-door (egress hall (list (xy 0 5))))
(define two-doors (egress hall (list (xy 0 5) (xy 20 5))))
(define walk (/ 10 (walking-speed 1)))
(say (same? (egress-time one-door (list (list (xy 10 5) 200)) (list (list (xy 0 5) 1.2))) (+ walk (flow-time 200 1.2)))
     (same? (egress-time two-doors (list (list (xy 10 5) 0) (list (xy 4 5) 100) (list (xy 18 5) 60)) (list (list (xy 0 5) 1.2) (list (xy 20 5) 0.9)))
       (max (+ (/ 4 (walking-speed 1)) (flow-time 100 1.2)) (+ (/ 2 (walking-speed 1)) (flow-time 60 0.9))))
     (same? (egress-time one-door (list (list (xy 20 5) 1)) (list (list (xy 0 5) 2))) (+ (/ 20 (walking-speed 1)) (flow-time 1 2))))
; expect: (#t #t #t)
(fails (egress-time one-door '() '())) ; expect: egress-time: crowds must be lists of a point and a number of people, got ()
(fails (egress-time one-door (list (list (xy 30 5) 1)) (list (list (xy 0 5) 1)))) ; expect: egress-time: there is no way out from (xyz 30 5 0)

; ---- rooms of a cut: two rooms in walls of 0.2 m, a door between them and one outside ----
(define walls (subtract (make-box origin (xyz 10.4 5.4 3)) (make-box (xyz 0.2 0.2 -1) (xyz 5.2 5.2 4)) (make-box (xyz 5.4 0.2 -1) (xyz 10.2 5.2 4))
                        (make-box (xyz 5.1 2 -1) (xyz 5.5 3 2.1)) (make-box (xyz -1 2 -1) (xyz 0.3 3 2.1))))
(define (rect x0 y0 x1 y1) (make-region (make-rectangle (xy x0 y0) (xy x1 y1))))
(define plan (rooms-of-cut walls))
(say (map (lambda (d) (round (* 1000 (area d)))) (first plan)) (map (lambda (d) (round (* 1000 (area d)))) (second plan)) (same? (egress-distance (egress (apply append plan) (list (xyz 0 2.5 1))) (xyz 10 2.5 1)) 10))
; expect: ((25000.0 24000.0) (200.0 200.0) #t)
(define ring (subtract (make-box origin (xyz 9 9 3)) (make-box (xyz 1 1 -1) (xyz 8 8 4))))
(say (map area (first (rooms-of-cut (unite ring (make-box (xyz 4 4 0) (xyz 5 5 3)))))) (second (rooms-of-cut ring)))
; expect: ((48.0) ())
(fails (rooms-of-cut walls #:low 2 #:high 1)) ; expect: rooms-of-cut: low must be below high, got 2 and 1
(fails (rooms-of-cut walls #:high 5))         ; expect: rooms-of-cut: no wall is at the height 5

; ---- wheelchairs: a square of 2 m loses its corners, (4 - pi) r2; a passage of 1 m is no place for a circle of 1.5 m ----
(say (near? (area (turning-area (rect 0 0 2 2))) (- 4 (* (- 4 pi) 9/16)) 2e-3) (turning-area (rect 0 0 8 1)) (near? (area (turning-area (rect 0 0 8 1) #:diameter 0.9)) (- 8 (* (- 4 pi) 0.2025)) 2e-3))
; expect: (#t (empty-object) #t)

; ---- areas by use ----
(say (areas-by-use (list (list 'nuf2 (rect 0 0 4 5)) (list 'vf 12) (list 'nuf2 10) (list 'tf 3)) #:gross 60))
; expect: (((nuf2 30.0) (tf 3) (vf 12) (nuf 30.0) (nrf 45.0) (kgf 15.0) (bgf 60)))
(areas-by-use '((vf 12)) #:gross 10) ; expect warning: areas-by-use: the rooms have 12 m2, more than the gross area of 10 m2
(fails (areas-by-use '((office 12)))) ; expect: areas-by-use: a use must be one of (nuf1 nuf2 nuf3 nuf4 nuf5 nuf6 nuf7 tf vf), got office

; ---- carbon and glass ----
(define cube (make-box origin (xyz 1 1 2)))
(say (carbon (list (with-material concrete cube) (with-material concrete cube) (list (with-material steel cube)) (layer "rail" (make-line origin (xyz 3 0 0))))
       '((concrete volume 250 10) (steel (mass 7850) 1.5 -0.5) ("rail" length 2 0) ("wood" volume 1 1)) #:modules '("A1-A3" "D")))
; expect: (((name quantity A1-A3 D) (concrete 4.0 1000.0 40.0) (steel 15700.0 23550.0 -7850.0) (rail 3.0 6.0 0.0) (  24556.0 -7810.0)))
(carbon (with-material glass cube) '()) ; expect warning: carbon: the table has no row for an object of glass
(fails (carbon cube '((steel volume 1 2)))) ; expect: carbon: a row must be a name, 'volume, 'area, 'length, 'count or (list 'mass density), and 1 factors, got (steel volume 1 2)
(define (pane x0 x1) (make-3dface (xz x0 0) (xz x1 0) (xz x1 3) (xz x0 3)))
(say (glass-share (list (with-material glass (pane 0 1)) (with-material concrete (pane 1 4)))))
; expect: (0.25)

; ---- two goals: of x2 + y2 and (x - 1)2 + y2 the front is sqrt f + sqrt g = 1 ----
(define (f x y) (+ (square x) (square y)))
(define (g x y) (+ (square (- x 1)) (square y)))
(say (every (lambda (row) (near? (+ (sqrt (second row)) (sqrt (third row))) 1 1e-5)) (pareto-set f g '(0.3 0.7) #:points 6))
     (every (lambda (row) (near? (+ (sqrt (second row)) (sqrt (third row))) 1 1e-3)) (pareto-set f g '(0.3 0.7) #:points 4 #:method 'simplex))
     (pareto-front '((1 5) (2 2) (3 3) (4 1) (2 2) (5 1)) first second))
; expect: (#t #t ((1 5) (2 2) (4 1)))
(fails (pareto-set f g '(0 0) #:points 1)) ; expect: pareto-set: points must be an exact integer from 2 to 1000, got 1
; expect no other warnings
