; (visualscheme building): slabs, columns, beams, stairs, ramps and railings by closed forms; each message for bad input
(import (visualscheme) (visualscheme building))
(define (same? o v) (and (solid? o) (near? (/ (volume o) v) 1 1e-9)))
(define square (list (xyz 0 0 3) (xyz 4 0 3) (xyz 4 4 3) (xyz 0 4 3)))
(displayln (list (same? (slab square) (* 16 0.2)) (same? (slab square #:layers '((0.1 screed) (0.2 concrete)) #:holes (list (xyz 1 1 3) (xyz 2 1 3) (xyz 2 2 3))) (* 15.5 0.3))
                 (bounding-box (slab square #:layers '(0.1 0.2)))))
; expect: (#t #t ((xyz 0 0 2.6999999999999997) (xyz 4 4 3)))
(displayln (list (near? (volume (slab (make-circle origin 2) #:layers 1 #:holes (list (make-circle (xy 1 0) 1/2) (make-rectangle (xy -1 0) (xy 0 1))))) (- (* pi 3.75) 1) 0.02))) ; expect: (#t)
(displayln (list (same? (column (xy 1 1) #:size 0.4) (* 0.16 2.75)) (same? (column (xy 1 1) #:size '(0.2 0.5) #:height 3 #:turn 1 #:material 'concrete) 0.3)
                 (same? (column (xy 1 1) #:height 2 #:size (make-regular-polygon origin 1 4)) 4)))
; expect: (#t #t #t)
(displayln (list (same? (beam origin (xyz 3 4 0)) 0.4) (same? (beam origin (xyz 0 0 5) #:size 0.3) 0.45) (same? (beam origin (xyz 3 0 4) #:size '(0.1 0.2) #:material 'wood) 0.1)))
; expect: (#t #t #t)

; a flight on a floor, of n treads t of rises r: the steps' section over a slope that is the waist below their inner corners
(define (flight-area n r t waist) (- (+ (* 1/2 n r t) (* n t waist)) (* 1/2 waist (/ (* waist t) r))))
(define straight (stair (xy 1 2) (+xyz (xy 1 2) 0 4.2 2.8)))
(displayln (list (same? straight (flight-area 15 0.175 0.28 0.15)) (bounding-box straight)))
; expect: (#t ((xyz 0.5 2 0) (xyz 1.5 6.2 2.625)))
(displayln (same? (stair origin (xyz 4.2 0 2.8) #:width 2 #:waist 0.1) (* 2 (flight-area 15 0.175 0.28 0.1)))) ; expect: #t
; an L has a landing and two flights that fill the lengths between; turned right, it is the mirror image
(define (corner turn y) (stair origin (xyz 2.5 y 2.8) #:kind 'L #:turn turn))
(displayln (list (near? (volume (corner 'left 3.1)) (volume (corner 'right -3.1))) (bounding-box (corner 'left 3.1))))
; expect: (#t ((xyz 0 -0.5 0) (xyz 3 3.1 2.635294117647059)))
(define returning (stair origin (xyz 0 1.2 2.8) #:kind 'U))
(displayln (list (same? returning (+ (flight-area 7 0.175 0.28 0.15) (* 2.2 0.325) (* 7 0.28 (+ 0.15 0.0875)))) (bounding-box returning)))
; expect: (#t ((xyz 0 -0.5 0) (xyz 2.96 1.7 2.625)))
(define (top o) (cz (last (bounding-box o))))
(displayln (list (top (stair (xy 7 1) (xyz 8.6 1 2.8) #:kind 'spiral #:width 1.2)) (< 2.6 (top (stair (xy 0 0) (xyz 2.6 0 2.8) #:kind 'spiral)) 2.8)))
; expect: (3.8 #t)

(displayln (list (same? (ramp origin (xyz 10 0 0.6) #:width 2 #:thickness 0.1) 2) (same? (ramp (xyz 0 0 1) (xyz 0 20 0)) (* 20 1.2 0.2)))) ; expect: (#t #t)
(define posts (railing (list (xy 0 0) (xy 4 0) (xy 4 3)) #:rails 1 #:radius 0.05))
(displayln (list (solid? posts) (bounding-box posts) (solid? (railing (make-arc origin 4 0 pi) #:spacing 2))))
; expect: (#t ((xyz -0.05 -0.05 0) (xyz 4.05 3.05 1.05)) #t)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (slab 3))                                     ; expect: slab: outline must be points or a closed curve, or a list of these, got 3
(fails (slab (list (xyz 0 0 3) (xyz 4 4 3) (xyz 4 0 3) (xyz 0 4 3)))) ; expect: slab: the outline crosses itself at (xyz 2 2 3)
(fails (slab (make-rectangle origin (xy 6 4)) #:holes (make-rectangle (xy 5 1) (xy 7 2)))) ; expect: slab: two loops of the outline cross at (xyz 6 2 0)
(displayln (near? (volume (slab (make-rectangle origin (xy 6 4)) #:layers 1 #:holes (make-rectangle (xy 0 1) (xy 2 2)))) 22)) ; expect: #t
(fails (slab (make-line origin (xy 3 0))))           ; expect: slab: the outline must be closed, got (make-line (list (xyz 0 0 0) (xyz 3 0 0)))
(fails (slab (list (xy 0 0) (xyz 4 0 1) (xy 4 4))))  ; expect: slab: the points of outline must have one height, got (((xyz 0 0 0) (xyz 4 0 1) (xyz 4 4 0)))
(fails (column 3))                                   ; expect: column: place must be a point, got 3
(fails (column origin #:size '(1 0)))                ; expect: column: size must be a positive number or a list of two, got (1 0)
(fails (beam origin origin))                         ; expect: beam: the ends of the beam must differ, got (xyz 0 0 0)
(fails (stair origin (xy 4 0)))                      ; expect: stair: the foot of the stair must be below its head, got (xyz 0 0 0) and (xyz 4 0 0)
(fails (stair origin (xyz 0 0 3)))                   ; expect: stair: head and foot of a straight stair must not lie above each other
(fails (stair origin (xyz 9 0 2.8)))                 ; expect: stair: no number of steps makes twice the rise and the tread 0.63, give or take 0.06, for a rise of 2.8: move the head, or pass #:rule #f
(fails (stair origin (xyz 4.2 0 2.8) #:kind 'Z))     ; expect: stair: kind must be 'straight, 'L, 'U or 'spiral, got Z
(fails (stair origin (xyz 4.2 0 2.8) #:rule 'old))   ; expect: stair: rule must be '2r+t (0.63), a length or #f, got old
(fails (stair origin (xyz 4.2 0 2.8) #:turn 'up))    ; expect: stair: turn must be 'left or 'right, got up
(fails (stair origin (xyz 0.3 3 2.8) #:kind 'L))     ; expect: stair: the flights of the stair must be longer than half its width
(fails (stair origin (xyz 0.5 0 2.8) #:kind 'U))     ; expect: stair: the flights of a stair of 1 overlap: head and foot are 0.5 apart
(fails (stair origin (xyz 1 0 2.8) #:kind 'spiral))  ; expect: stair: a spiral stair of width 1 needs foot and head 1.1 apart, or more
(fails (ramp origin (xyz 3 0 1)))                    ; expect: ramp: the ramp rises 1.0 on a length of 3.0: a slope of 0.06 needs 16.6667
(fails (railing origin))                             ; expect: railing: path must be a curve, or a list of two points or more, got (xyz 0 0 0)
(fails (railing (list origin (xy 3 0)) #:rails 1/2)) ; expect: railing: rails must be a whole number of 0 or more, got 1/2
(fails (stair origin (xyz 3 0 1e9)))                 ; expect: stair: a rise of 1000000000.0 needs more than 10000 steps
(fails (railing (list origin (xy 3 0)) #:spacing 1e-9)) ; expect: railing: a spacing of 1e-9 makes more than 10000 posts
(fails (stair origin (xyz 4 3 0.1) #:kind 'L #:rule #f)) ; expect: stair: a rise of 0.1 is too low for the flights of this stair
(fails (ramp origin origin))                         ; expect: ramp: the ends of the ramp must not lie above each other, got (xyz 0 0 0) and (xyz 0 0 0)
(fails (railing (list origin origin)))               ; expect: railing: path must be a curve, or a list of two points or more, got ((xyz 0 0 0) (xyz 0 0 0))
(displayln (equal? (railing (list origin origin (xy 3 0))) (railing (list origin (xy 3 0))))) ; expect: #t
