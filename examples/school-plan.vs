; A school of one storey: rooms and doors are cut from its walls, the plan is checked, and the longest way out is drawn.
;
; What it teaches: rooms-of-cut reads rooms and doors from solids, egress finds the ways out, egress-time the time of all pupils,
; turning-area where a wheelchair turns, areas-by-use the sums of DIN 277.
(import (visualscheme) (visualscheme analysis))

(define-parameter classes 5 #:min 2 #:max 10)       ; on each side of the corridor
(define-parameter class-width 8.5 #:min 6 #:max 12)
(define-parameter class-depth 7.5 #:min 6 #:max 10)
(define-parameter corridor 3 #:min 2 #:max 5)
(define-parameter pupils 26 #:min 10 #:max 34)      ; in each class
(define-parameter door 1.0 #:min 0.8 #:max 2)
(define-parameter exit-width 1.8 #:min 0.9 #:max 3)

(define wall 0.3)
(define height 3.2)
(define step (+ class-width wall))
(define long (+ (* classes step) wall))
(define deep (+ (* 2 class-depth) corridor (* 4 wall)))
(define middle (/ deep 2))
(define (hole x0 y0 x1 y1 top) (make-box (xyz x0 y0 -1) (xyz x1 y1 top)))
(define (class-hole k y) (hole (+ wall (* k step)) y (+ (* k step) step) (+ y class-depth) 9))
(define south wall)
(define north (+ (* 3 wall) class-depth corridor))
(define corridor-south (+ (* 2 wall) class-depth))
(define (class-door k y) (let ((x (+ wall (* k step) 0.8))) (hole x (- y 0.1) (+ x door) (+ y wall 0.1) 2.1)))
(define ks (iota classes))
(define walls
  (subtract (make-box origin (xyz long deep height))
    (map (lambda (k) (list (class-hole k south) (class-hole k north) (class-door k (+ wall class-depth)) (class-door k (+ corridor-south corridor)))) ks)
    (hole wall corridor-south (- long wall) (+ corridor-south corridor) 9)
    (hole -1 (- middle (/ exit-width 2)) (+ wall 0.1) (+ middle (/ exit-width 2)) 2.3001)
    (hole (- long wall 0.1) (- middle (/ exit-width 2)) (+ long 1) (+ middle (/ exit-width 2)) 2.2)
    ; windows, above the height of the cut
    (map (lambda (k) (let ((x (+ wall (* k step) 1))) (list (make-box (xyz x -1 1.1) (xyz (+ x (- class-width 2)) (+ wall 0.1) 2.29)) (make-box (xyz x (- deep wall 0.1) 1.1) (xyz (+ x (- class-width 2)) (+ deep 1) 2.29))))) ks)))

(define plan (rooms-of-cut walls #:low 1 #:high 2.31))
(define rooms (first plan))
(define exits (list (xyz 0 middle 1) (xyz long middle 1)))
(define out (egress (append rooms (second plan)) exits))
(define classrooms (filter (lambda (r) (< (area r) (* 1.01 class-width class-depth))) rooms))
(define crowds (map (lambda (r) (list (centroid r) pupils)) classrooms))
(define farthest (longest-egress out #:step 1))
(define (tenths x) (/ (round (* 10. x)) 10))
(define narrow (filter (lambda (r) (empty-object? (turning-area r))) rooms))
(printf "~a rooms, ~a doors; the longest way out is ~a m, all ~a pupils are out after ~a s~%" (length rooms) (length (second plan)) (tenths (second farthest))
  (* pupils (length classrooms)) (tenths (egress-time out crowds (map (lambda (e) (list e exit-width)) exits))))
(printf "rooms where no wheelchair turns: ~a; areas in m2: ~a~%" (length narrow)
  (map (lambda (row) (list (first row) (tenths (second row)))) (areas-by-use (map (lambda (r) (list (if (memq r classrooms) 'nuf5 'vf) r)) rooms) #:gross (* long deep))))

; The floor shows how far each square metre is from an exit; a pipe above the walls shows the longest way.
(define tile 0.85)
(define (tiles r)
  (let ((box (bounding-box r)))
    (append-map (lambda (x) (filter-map (lambda (y) (let ((far (egress-distance out (xyz (+ x (/ tile 2)) (+ y (/ tile 2)) 1)))) (and far (list x y far))))
                              (range (cy (first box)) (- (cy (second box)) (* 0.9 tile)) tile)))
      (range (cx (first box)) (- (cx (second box)) (* 0.9 tile)) tile))))
(define squares (append-map tiles rooms))
(define most (second farthest))
(define floor-colours (color-faces (map (lambda (s) (let ((x (first s)) (y (second s)) (b tile)) (list (xyz x y 0.02) (xyz (+ x b) y 0.02) (xyz (+ x b) (+ y b) 0.02) (xyz x (+ y b) 0.02)))) squares) (map third squares) #:from 0 #:to most))
(camera (xyz (* 0.53 long) (* -0.6 deep) 50) (xyz (* 0.545 long) (* 0.46 deep) 0) #:lens 34)
(draw
  (color '(0.95 0.94 0.91) (do-slice walls (make-plane (xyz 0 0 1.6) (vxyz 0 0 -1))))
  floor-colours
  (color '(0.1 0.1 0.12) (do-move (make-pipe (egress-path out (first farthest)) 0.1) (vxyz 0 0 0.7)) (make-sphere (+z (first farthest) 0.7) 0.3))
  (color '(0.86 0.85 0.82) (make-box (xyz -60 -60 -0.3) (xyz (+ long 60) (+ deep 60) 0)))
  (do-move (do-rotate (color-legend 0 most #:size 1.5 #:format (lambda (v) (format "~a m" (exact (round v))))) 'x -pi/2) (vxyz (+ long 1.5) 1 0.2)))
