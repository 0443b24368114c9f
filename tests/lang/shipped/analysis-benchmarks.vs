; (visualscheme analysis): the trusses of 25 and 72 bars with the areas that K. S. Lee and Z. W. Geem publish (Computers and
; Structures 82, 2004, 781-798), weights 544.38 and 379.27 lb. At such an optimum, limits are reached: displacements of 0.35
; and 0.25 in, and for 72 bars stresses of 25,000 psi. The published areas are rounded.
(import (visualscheme) (visualscheme analysis))
(define inch 0.0254)
(define lbf (* 0.45359237 9.80665))
(define psi (/ lbf (square inch)))
(define (at x y z) (xyz (* x inch) (* y inch) (* z inch)))
(define (force x y z) (vxyz (* x 1e3 lbf) (* y 1e3 lbf) (* z 1e3 lbf)))
(define (within? a b part) (<= (abs (- a b)) (* part b)))
; the weight in lb, at 0.1 lb/in3, of bars with these areas in in2
(define (weight nodes groups areas)
  (* 0.1 (apply + (map (lambda (g a) (* a (apply + (map (lambda (m) (/ (distance (list-ref nodes (- (first m) 1)) (list-ref nodes (- (second m) 1))) inch)) g)))) groups areas))))
(define (each groups areas) (append-map (lambda (g a) (map (lambda (m) (* a inch inch)) g)) groups areas))
(define (solved nodes groups areas supports loads)
  (frame-solve (frame nodes (append-map values groups) #:supports supports #:joints 'pinned #:sections (each groups areas) #:materials (* 1e7 psi) #:loads loads)))
(define (greatest r nodes part cases) (/ (apply max (append-map (lambda (c) (append-map (lambda (n) (map (lambda (f) (abs (f (displacement r n #:case c)))) part)) nodes)) cases)) inch))

(define nodes-25
  (list (at -37.5 0 200) (at 37.5 0 200) (at -37.5 37.5 100) (at 37.5 37.5 100) (at 37.5 -37.5 100) (at -37.5 -37.5 100)
        (at -100 100 0) (at 100 100 0) (at 100 -100 0) (at -100 -100 0)))
(define groups-25
  '(((1 2)) ((1 4) (2 3) (1 5) (2 6)) ((2 5) (2 4) (1 3) (1 6)) ((3 6) (4 5)) ((3 4) (5 6)) ((3 10) (6 7) (4 9) (5 8)) ((3 8) (4 7) (6 9) (5 10)) ((3 7) (4 8) (5 9) (6 10))))
(define areas-25 '(0.047 2.022 2.950 0.010 0.014 0.688 1.657 2.663))
(define r-25
  (solved nodes-25 groups-25 areas-25 '((7 pinned) (8 pinned) (9 pinned) (10 pinned))
    (list (list "1" (list 1 (force 0 20 -5)) (list 2 (force 0 -20 -5)))
          (list "2" (list 1 (force 1 10 -5)) (list 2 (force 0 10 -5)) (list '(3 6) (force 0.5 0 0))))))
(displayln (list (within? (weight nodes-25 groups-25 areas-25) 544.38 1e-4)
                 (within? (greatest r-25 '(1 2) (list cx cy) '("1")) 0.35 0.003) (within? (greatest r-25 '(1 2) (list cx cy) '("2")) 0.35 0.003)))
; expect: (#t #t #t)

(define corners '((0 0) (120 0) (120 120) (0 120)))
(define nodes-72 (append-map (lambda (k) (map (lambda (c) (at (first c) (second c) (* 60 k))) corners)) (iota 5)))
(define (n k c) (+ 1 (* 4 k) (modulo c 4)))
(define groups-72 ; of each storey: columns, diagonals of the sides, beams above, diagonals of the floor above
  (append-map
    (lambda (k)
      (list (map (lambda (c) (list (n k c) (n (+ k 1) c))) (iota 4))
            (append-map (lambda (c) (list (list (n k c) (n (+ k 1) (+ c 1))) (list (n k (+ c 1)) (n (+ k 1) c)))) (iota 4))
            (map (lambda (c) (list (n (+ k 1) c) (n (+ k 1) (+ c 1)))) (iota 4))
            (list (list (n (+ k 1) 0) (n (+ k 1) 2)) (list (n (+ k 1) 1) (n (+ k 1) 3)))))
    (iota 4)))
(define areas-72 '(1.790 0.521 0.100 0.100 1.229 0.522 0.100 0.100 0.517 0.504 0.100 0.101 0.156 0.547 0.442 0.590))
(define r-72
  (solved nodes-72 groups-72 areas-72 '((1 pinned) (2 pinned) (3 pinned) (4 pinned))
    (list (list "1" (list 17 (force 5 5 -5))) (list "2" (list '(17 18 19 20) (force 0 0 -5))))))
(define stress (apply max (map (lambda (k a) (/ (abs (member-force r-72 k #:case "2")) a psi)) (iota 72 1) (each groups-72 areas-72))))
(displayln (list (within? (weight nodes-72 groups-72 areas-72) 379.27 2e-4) (within? (greatest r-72 '(17 18 19 20) (list cx cy) '("1")) 0.25 0.003) (within? stress 25000 0.003)))
; expect: (#t #t #t)
