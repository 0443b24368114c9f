; Buildings of the abstract facade on any floor plan. Loaded by the other programs of this folder.
(require "fillings.vs")

; A style: the four rules of a facade, and the colour of its roof.
(define old-style (list old-tile old-door old-cornice old-corner "#8d5a48"))
(define modern-style (list modern-tile modern-door modern-cornice modern-corner "#c9ccce"))

; A plan, a polygon, is raised: its sides become facades, whose cornices meet at the angles that the extrusion gives. A door on the first.
(define-rule (building [self polygon-scope?] [style list?] [height positive?] [top positive? 3] [middle positive? 3] [bottom positive? 4])
  (define-rule (side [self box-scope?])
    [(=> (abstract-facade top middle bottom 0.13 (scope-left-angle self) (scope-right-angle self) (scope-first? self)
           (first style) (second style) (third style) (fourth style)))])
  (define-rule (roof [self polygon-scope?])
    [(=> (scope-extrude 0.4 #:side parapet) (covered))])
  (define-rule (covered [self polygon-scope?])
    [(=> (roofing (fifth style)))])
  (define-rule (parapet [self box-scope?])
    [(=> (deep 0.4 0) (scope-place (block (fifth style))))])
  [(=> (scope-extrude height #:side side #:top roof))])

; The polygon of a scope as a slab of a colour.
(define (roofing s paint) (color paint (do-extrude (scope-region s) (vxyz 0 0 0.15))))
