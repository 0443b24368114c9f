; The abstract facade: how a house front is divided, and nothing of what fills it. A template after G2 (Krecklau, Pavic and Kobbelt, 2010,
; figures 17 to 19); their figure's text is not at hand, so these rules are our own, of the same structure.
;
; What it teaches: rules as parameters. The template knows heights and angles; what a window, a door or a cornice looks like is said by
; four rules that are given to it. Flags tell those rules which floor they work on. Loaded by the other programs of this folder.

; Heights of the top, middle and bottom floors, a cornice's part of a floor's height, the outer angles at both ends, whether there is a
; door; and the rules for a tile, for the door, for a cornice along the wall, and for the half of it that goes round a corner.
(define-rule (abstract-facade [self box-scope?]
                              [top-height positive?] [middle-height positive?] [bottom-height positive?] [cornice-ratio positive?]
                              [left-angle number?] [right-angle number?] [door? boolean?]
                              [tile procedure?] [door procedure?] [cornice procedure?] [corner procedure?])
  (define-rule (top-part [self box-scope?])
    [(=> (with-flags '(top-floor) storey))])
  (define-rule (middle-part [self box-scope?])
    [(=> (scope-repeat 'y middle-height middle-storey))])
  (define-rule (middle-storey [self box-scope?])
    [(=> (with-flags '(middle-floor) storey))])
  (define-rule (bottom-part [self box-scope?])
    [(=> (with-flags '(bottom-floor) storey))])
  (define-rule (storey [self box-scope?])
    [(=> (scope-split 'y (rest tiles) (relative cornice-ratio flagged-ledge)))])
  (define-rule (tiles [self box-scope?])
    [#:when (and door? (flag? self 'bottom-floor) (> (scope-size-x self) 5))
     (=> (scope-split 'x (rest row) (absolute 2.4 door) (rest row)))]
    [(=> (row))])
  (define-rule (row [self box-scope?])
    [(=> (scope-repeat 'x 2.2 tile))])
  (define-rule (flagged-ledge [self box-scope?])
    [(=> (with-flags '((top-cornice (flag? self 'top-floor)) (bottom-cornice (flag? self 'bottom-floor))) ledge))])
  ; a cornice along the wall, and at each end a plane without depth whose x looks out and whose z leads on round the corner
  (define-rule (ledge [self box-scope?])
    [(=> (cornice) (left-end) (right-end))])
  (define-rule (left-end [self box-scope?])
    [(=> (scope-turn 'y -pi/2) (corner left-angle 'left))])
  (define-rule (right-end [self box-scope?])
    [(=> (scope-move (scope-size-x self) (scope-size-y self) 0) (scope-turn 'y -pi/2) (scope-turn 'x pi) (corner right-angle 'right))])
  [(=> (scope-split 'y (absolute bottom-height bottom-part) (rest middle-part) (absolute top-height top-part)))])

; Half of a corner as a hexahedron that lies as the cornice beside it does: x along the wall, y up, z out. The rule gets that.
(define-rule (sharp-half [self box-scope?] [angle number?] [side symbol?] [depth positive?] [rule any?])
  [(=> (scope-size depth #f #f) (scope-prism angle (along-wall side rule)))])
(define-rule (round-half [self box-scope?] [angle number?] [side symbol?] [depth positive?] [rule any?])
  [#:when (> angle 0) (=> (scope-size depth #f #f) (scope-round-corner (/ angle 2) pi/12 (along-wall side rule)))]
  [(=>)])
(define (along-wall side rule)
  (define-rule (laid [self ffd-scope?])
    [#:when (eq? side 'right) (=> (scope-turn 'x pi) (scope-turn 'y pi/2) (filled))]
    [(=> (scope-turn 'y pi/2) (filled))])
  (define-rule (filled [self ffd-scope?])
    [#:when (object? rule) (=> (scope-place rule))]
    [(=> (rule))])
  laid)
