; A cornice that goes round a corner, twice: sharp, by one prism from each side, and round, by wedges. After figure 15 of Krecklau, Pavic
; and Kobbelt (2010); the rules are our own.
;
; What it teaches: deforming instead of modelling. The moulding is made once; in the corner the same moulding fills a hexahedron.
;
;   vs cornice-corners.vs -o corners.png
(require "fillings.vs")
(define walling (block "#a9694f"))

; Two walls that meet at a right angle: each is a face with a cornice on top and a half of the corner at its end.
(define-rule (wall [self box-scope?] [corner procedure?] [left number?] [right number?])
  (define-rule (top [self box-scope?]) [(=> (cornice) (right-end) (left-end))])
  (define-rule (cornice [self box-scope?]) [(=> (face) (deep 0 0.5) (scope-place mould))])
  (define-rule (face [self box-scope?]) [(=> (deep 0.3 0) (scope-place walling))])
  (define-rule (left-end [self box-scope?]) [(=> (scope-turn 'y -pi/2) (corner left 'left 0.5 mould))])
  (define-rule (right-end [self box-scope?])
    [(=> (scope-move (scope-size-x self) (scope-size-y self) 0) (scope-turn 'y -pi/2) (scope-turn 'x pi) (corner right 'right 0.5 mould))])
  [(=> (scope-split 'y (rest face) (absolute 0.7 top)))])

(define-rule (pier [self polygon-scope?] [corner procedure?])
  (define-rule (side [self box-scope?])
    [(=> (wall corner (scope-left-angle self) (scope-right-angle self)))])
  (define-rule (lid [self polygon-scope?]) [(=> (covered))])
  (define (covered s) (color "#8d8f8c" (do-extrude (scope-region s) (vxyz 0 0 0.03))))
  [(=> (scope-extrude 3 #:side side #:top lid))])

(define (plan x) (make-polygon-scope (make-rectangle (xy x 0) (xy (+ x 3) 3))))
(draw (pier (plan 0) sharp-half) (pier (plan 5.5) round-half))
(ground 0 #:material stone)
(sun #:azimuth 232 #:altitude 27)
(camera (xyz 0 -9.5 1.6) (xyz 4 0.5 1.9) #:lens 36 #:upright #t)
