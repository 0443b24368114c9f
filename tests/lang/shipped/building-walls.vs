; (visualscheme building): walls, joints and openings by closed forms; each message for bad input
(import (visualscheme) (visualscheme building))
(define brickwork '((0.115 brick) (0.1 insulation) (0.175 block) (0.015 plaster)))
(define partition '((0.015 plaster) (0.1 block) (0.015 plaster)))
(define (line . coordinates) (let loop ((l coordinates)) (if (null? l) '() (cons (xy (car l) (cadr l)) (loop (cddr l))))))
(define (volumes w) (map volume (wall-layers w)))
(define (total walls) (apply + (append-map volumes walls)))
(define (same? a b) (near? (/ a b) 1 1e-9))
; Tests that the union of joined walls has the volume v, and that this is the sum of their layers.
(define (fits? v . walls) (let ((joined (join-walls walls))) (and (same? (volume (unite joined)) v) (same? (total joined) v))))

; straight, cornered, closed and curved walls; each alignment
(displayln (list (same? (volume (wall (line 0 0 5 0) #:height 3 #:layers brickwork)) (* 5 3 0.405)) (same? (volume (wall (line 0 0 5 0 5 4) #:height 3)) (* 9 3 0.2))
                 (same? (volume (wall (make-rectangle (xy 0 0) (xy 6 4)) #:height 1 #:layers brickwork)) (* 20 0.405))))
; expect: (#t #t #t)
(displayln (map (lambda (align) (volume (wall (make-rectangle (xy 0 0) (xy 6 4)) #:height 1 #:layers 0.5 #:align align))) '(left centre right)))
; expect: (11.0 10.0 9.0)
(define half-ring (wall (make-arc origin 5 0 pi) #:height 1 #:layers 0.4))
(displayln (list (near? (/ (volume half-ring) (* pi 5 0.4)) 1 1e-3) (bounding-box (wall (line 0 0 2 0) #:height 1 #:base 3 #:layers 1))))
; expect: (#t ((xyz 0 -0.5 3) (xyz 2 0.5 4)))
(displayln (same? (volume (wall (join-curves (make-line (xy 0 0) (xy 4 0)) (make-line (xy 4 3) (xy 4 0))) #:height 1)) (* 7 0.2))) ; expect: #t
; the first layer lies on the right
(displayln (map (lambda (l) (round (* 1e4 (cy (centroid l))))) (wall-layers (wall (line 0 0 5 0) #:layers brickwork)))) ; expect: (-1450.0 -375.0 1000.0 1950.0)

; corners of equal layers: each layer goes around the corner; the second wall in either direction
(define east (wall (line 0 0 5 0) #:height 1 #:layers brickwork))
(define north (wall (line 5 0 5 4) #:height 1 #:layers brickwork))
(displayln (map (lambda (w) (fits? (* 9 0.405) east w)) (list north (wall (line 5 4 5 0) #:height 1 #:layers (reverse brickwork))))) ; expect: (#t #t)
(displayln (every near? (volumes (first (join-walls east north))) (list (* 0.115 (+ 5 0.145)) (* 0.1 (+ 5 0.0375)) (* 0.175 4.9) (* 0.015 (- 5 0.195))))) ; expect: #t
; a corner at 60 degrees, and one of unequal layers
(displayln (list (fits? (* 9 0.3) (wall (line 0 0 5 0) #:height 1 #:layers 0.3) (wall (list (xy 5 0) (+pol (xy 5 0) 4 (* 2/3 pi))) #:height 1 #:layers 0.3))
                 (fits? (+ (* 0.405 5.065) (* 0.13 (- 4 0.2025))) east (wall (line 5 0 5 4) #:height 1 #:layers partition))))
; expect: (#t #t)
; a T, also where the second wall ends at the first one's face; a cross of four; the plaster goes around the inner corners
(define t-joint (join-walls east (wall (line 2 0 2 4) #:height 1 #:layers partition)))
(displayln (list (same? (total t-joint) (+ (* 5 0.405) (* 0.13 (- 4 0.2025)))) (same? (last (volumes (first t-joint))) (* 0.015 (- 5 0.1 0.015)))))
; expect: (#t #t)
(displayln (fits? (+ (* 5 0.405) (* 0.13 (- 4 0.2025))) east (wall (line 2 0.2 2 4) #:height 1 #:layers partition))) ; expect: #t
(define plus (join-walls (wall (line 0 0 6 0) #:height 1 #:layers partition) (wall (line 3 -3 3 3) #:height 1 #:layers partition)))
(displayln (list (same? (total plus) (- (* 12 0.13) (* 0.13 0.13))) (map (lambda (w) (same? (first (volumes w)) (* 0.015 (- 6 0.115)))) plus)))
; expect: (#t (#t #t))
; five walls in a star; unequal walls in one line; a wall that bends away from a circle
(displayln (let ((star (join-walls (map (lambda (i) (wall (list (xy 0 0) (pol 3 (* i 2/5 pi))) #:height 1 #:layers partition)) (iota 5)))))
             (list (same? (volume (unite star)) (total star)) (apply near? (map volume (take star 2))))))
; expect: (#t #t)
(displayln (fits? (+ (* 5 0.405) (* 3 0.13)) east (wall (line 5 0 8 0) #:height 1 #:layers partition))) ; expect: #t
(displayln (let ((joined (join-walls half-ring (wall (line 0 0 0 5) #:height 1 #:layers partition) (wall (line -8 0 8 0) #:height 1 #:layers brickwork))))
             (same? (volume (unite joined)) (total joined))))
; expect: #t
; heights: above the lower wall the higher ones join without it
(define low (wall (line 2 0 2 4) #:height 1 #:layers partition))
(define high (wall (line 0 0 5 0) #:height 3 #:layers brickwork))
(displayln (let ((joined (join-walls high low)))
             (list (same? (total joined) (+ (* 3 5 0.405) (* 0.13 (- 4 0.2025)))) (same? (last (volumes (first joined))) (* 0.015 (- 15 0.13 -0.015))))))
; expect: (#t #t)
(displayln (map (lambda (w) (same? (volume w) (* 9 1/2 0.405))) (list (unite (join-walls (wall (line 0 0 5 0) #:height 1/2 #:layers brickwork) (wall (line 5 0 5 4) #:height 1/2 #:layers brickwork)))))) ; expect: (#t)
(displayln (join-walls '())) ; expect: ()

; openings go through all layers, before and after joints, in straight and curved walls
(displayln (list (same? (volume (opening high 2 1 2)) (* 0.405 13)) (same? (volume (opening high (xy 2 0.1) 1 2 #:sill 1)) (* 0.405 13))
                 (same? (volume (opening (first (join-walls east north)) 2 1 1/2)) (- (volume (first (join-walls east north))) (* 0.405 1/2)))
                 (same? (volume (first (join-walls (opening east 2 1 1/2) north))) (- (volume (first (join-walls east north))) (* 0.405 1/2)))))
; expect: (#t #t #t #t)
(displayln (near? (- (volume half-ring) (volume (opening half-ring 7 2 1/2))) (* 2 0.4 1/2) 1e-3)) ; expect: #t
(displayln (let ((w (window high 2 1.2 1.3))) (list (wall? w) (wall-openings (door w 4)) (> (volume w) (- (volume high) (* 0.405 1.2 1.3))))))
; expect: (#t ((window 2 1.2 1.3 0.9) (door 4 0.9 2.1 0)) #t)
(define (block w h t) (make-box origin (xyz w t h)))
(displayln (list (same? (volume (window high 2 1 1 #:fill block)) (volume high)) (bounding-box (second (object-children (car (object-children (window (wall (line 0 0 0 4) #:base 1) 2 1 1 #:fill block))))))))
; expect: (#t ((xyz -0.1 1.5 1.9) (xyz 0.1 2.5 2.9)))
(displayln (list (wall-thickness high) (wall-height high) (wall-base high) (wall-name (wall (line 0 0 1 0) #:name "W1")) (wall-path (wall (line 0 0 1 0) #:base 2)) (wall? 3)))
; expect: (0.405 3 0.0 W1 ((xyz 0 0 2) (xyz 1 0 2)) #f)
(displayln (map object-material (wall-layers (wall (line 0 0 1 0) #:layers '((0.1 brick) (0.2 "red") 0.1))))) ; expect: (brick red #f)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (wall 3))                                  ; expect: wall: path must be a curve, or a list of two points or more, got 3
(fails (wall (line 0 0)))                         ; expect: wall: path must be a curve, or a list of two points or more, got ((xyz 0 0 0))
(fails (wall (list (xy 0 0) (xyz 1 0 1))))        ; expect: wall: the points of path must have one height, got ((xyz 0 0 0) (xyz 1 0 1))
(fails (wall (line 0 0 4 4 4 0 0 4)))             ; expect: wall: the path crosses itself at (xyz 2 2 0)
(fails (wall (line 0 0 5 0) #:height 0))          ; expect: wall: height must be a positive number, got 0
(fails (wall (line 0 0 5 0) #:base 'low))         ; expect: wall: base must be a number, got low
(fails (wall (line 0 0 5 0) #:layers '((brick)))) ; expect: wall: layers must be a thickness, or a list of layers such as (0.24 brick), got ((brick))
(fails (wall (line 0 0 5 0) #:layers -1))         ; expect: wall: layers must be a thickness, or a list of layers such as (0.24 brick), got -1
(fails (wall (line 0 0 5 0) #:align 'outside))    ; expect: wall: align must be 'centre, 'left or 'right, got outside
(fails (wall (make-arc origin 0.1 0 pi) #:layers 0.5)) ; expect: wall: the wall is thicker than the bend or the step of its path at (xyz 0.1 0 0)
(fails (wall (line 0 0 5 0 0 0.01)))              ; expect: wall: the path turns too sharply at (xyz 5 0 0)
(fails (join-walls east 3))                       ; expect: join-walls: wall must be a wall, as wall or join-walls return it, got 3
(fails (join-walls east (wall (line 0 0 5 0.2)))) ; expect: join-walls: two walls meet at 2 degrees at (xyz 0 0 0): 6 is the least
(fails (join-walls east (wall (line 5 0 5 0.1)))) ; expect: join-walls: the wall from (xyz 5 0 0) to (xyz 5 0.1 0) is too short for its joints
(fails (opening east 2 6 1/2))                    ; expect: opening: the opening is 6.0 wide, the wall only 5.0 long
(fails (window high 0.5 2 1))                     ; expect: window: the opening goes from -0.5 to 1.5 along a wall of 5.0
(fails (door east 2))                             ; expect: door: the opening goes from 0.0 to 2.1 above the foot of a wall of 1.0
(fails (opening high (xy 2 2) 1 1))               ; expect: opening: place must be near the wall's path, got (xyz 2 2 0), 2.0 away
(fails (opening high 'middle 1 1))                ; expect: opening: place must be a distance along the wall's path, or a point, got middle
(fails (opening high 2 0 1))                      ; expect: opening: width must be a positive number, got 0
(fails (opening (opening high 2 1 1) 2.5 1 1))    ; expect: opening: the opening overlaps another one, whose middle is at 2.0
(fails (window (wall (line 0 0 5 0 5 4)) 5 1 1))  ; expect: window: the opening goes around a corner of the wall
(fails (opening 3 2 1 1))                         ; expect: opening: wall must be a wall, as wall or join-walls return it, got 3
(fails (let ((w (wall (line 0 0 5 0)))) (join-walls w w))) ; expect: join-walls: the wall from (xyz 0 0 0) to (xyz 5 0 0) is given twice

; A curved wall that leaves a straight one tangentially: the thin wall ends on it.
(define tangent (list (wall (line 14 6 8 6) #:layers 0.4) (wall (make-arc (xy 8 9) 3 3pi/2 pi) #:layers 0.4) (wall (line 8 6 0 6) #:layers 0.14)))
(define around (apply join-walls tangent))
(displayln (near? (volume (unite around)) (apply + (map volume around)) 1e-7)) ; expect: #t
(displayln (every near? (map volume (take around 2)) (map volume (take tangent 2)))) ; expect: #t
(displayln (< (* 0.8 (volume (third tangent))) (volume (third around)) (* 0.9 (volume (third tangent))))) ; expect: #t
(fails (join-walls (wall (make-arc origin 9 0 1) #:layers 0.4) (wall (make-arc (xy 1 0) 8 0 0.2) #:layers 0.1)))
; expect: join-walls: the wall from (xyz 9 0 0) to (xyz 8.840532622729933 1.5893546463604897 0) lies within another one
