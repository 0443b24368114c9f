; A cornice .4 deep and .5 high along two walls of 5 m that meet at a right corner: each end of a wall fills half of the corner.
(define deep 0.4)
(define stone (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define-rule (half-corner [self box-scope?]) [(=> (scope-size deep #f #f) (scope-prism pi/2 stone))])
(define-rule (left-end [self box-scope?]) [(=> (scope-turn 'y -pi/2) (half-corner))])
(define-rule (right-end [self box-scope?])
  [(=> (scope-move (scope-size-x self) (scope-size-y self) 0) (scope-turn 'y -pi/2) (scope-turn 'x pi) (half-corner))])
(define-rule (cornice [self box-scope?]) [(=> (scope-size #f #f deep) (scope-place stone))])
(define-rule (side [self box-scope?])
  [#:when (= (scope-index self) 0) (=> (cornice) (right-end))]
  [#:when (= (scope-index self) 1) (=> (cornice) (left-end))]
  [(=>)])
(draw (scope-extrude (make-polygon-scope (make-rectangle (xy 0 0) (xy 5 5))) 0.5 #:side side))
