; Two fillings of the abstract facade, an old one and a modern one: each is four rules. Loaded by the other programs of this folder.
(require "abstract-facade.vs")

; A unit block, and one of a material.
(define (block c) (color c (make-box (xyz 0 0 0) (xyz 1 1 1))))
; A profile of outward distances and heights, both from 0 to 1, drawn along X; its front looks to -Y, as rules place it.
(define (moulding c . profile)
  (color c (do-extrude (apply make-polygon (map (lambda (p) (yz (- 1 (car p)) (cadr p))) profile)) (vxyz 1 0 0))))
; The scope with a depth, from `back` behind the wall's face to `front` before it.
(define (deep s back front) (scope-size (scope-move s 0 0 (- back)) #f #f (+ back front)))

; ---- old: plaster, stone frames with a ledge above, mouldings ----
(define plastered (block "#d8c3a0"))
(define rustic (block "#b9ab95"))
(define dressed (block "#efe7d8"))
(define sash (block "#f4f1ea"))
(define dark-glass (block "#4a6274"))
(define oak (block "#6b4427"))
(define mould (moulding "#efe7d8" '(0 0) '(0.25 0) '(0.3 0.15) '(0.55 0.35) '(0.6 0.55) '(0.9 0.75) '(1 0.78) '(1 1) '(0 1)))

(define-rule (old-tile [self box-scope?])
  (define stone (if (flag? self 'bottom-floor) rustic plastered))
  (define-rule (wall [self box-scope?]) [(=> (deep 0.4 0) (scope-place stone))])
  (define-rule (middle [self box-scope?])
    [(=> (scope-split 'y (absolute 0.75 wall) (rest opening) (absolute 0.3 wall)))])
  (define-rule (opening [self box-scope?])
    [(=> (scope-split 'x (absolute 0.14 frame) (rest between) (absolute 0.14 frame)))])
  (define-rule (between [self box-scope?])
    [(=> (scope-split 'y (absolute 0.12 sill) (rest window) (absolute 0.16 lintel)))])
  (define-rule (frame [self box-scope?]) [(=> (deep 0.4 0.06) (scope-place dressed))])
  (define-rule (sill [self box-scope?]) [(=> (deep 0.4 0.14) (scope-place dressed))])
  (define-rule (lintel [self box-scope?])
    [#:when (flag? self 'middle-floor) (=> (deep 0.4 0.2) (scope-place mould))]
    [(=> (deep 0.4 0.06) (scope-place dressed))])
  (define-rule (window [self box-scope?]) [(=> (deep 0.25 -0.17) (scope-split 'x (relative 0.5 wing) (relative 0.5 wing)))])
  (define-rule (wing [self box-scope?])
    [(=> (scope-split 'x (absolute 0.05 sash) (rest lights) (absolute 0.05 sash)))])
  (define-rule (lights [self box-scope?]) [(=> (scope-repeat 'y 0.55 light))])
  (define-rule (light [self box-scope?])
    [(=> (scope-split 'y (absolute 0.035 sash) (rest glazed) (absolute 0.035 sash)))])
  (define-rule (glazed [self box-scope?]) [(=> (scope-size #f #f 0.03) (scope-place dark-glass))])
  [#:when (< (scope-size-x self) 1.4) (=> (wall))]
  [(=> (scope-split 'x (rest wall) (absolute 1.2 middle) (rest wall)))])

(define-rule (old-door [self box-scope?])
  (define-rule (jamb [self box-scope?]) [(=> (deep 0.4 0.1) (scope-place dressed))])
  (define-rule (portal [self box-scope?])
    [(=> (scope-split 'y (absolute 0.1 jamb) (rest wings) (absolute 0.4 head)))])
  (define-rule (head [self box-scope?]) [(=> (deep 0.4 0.25) (scope-place mould))])
  (define-rule (wings [self box-scope?]) [(=> (deep 0.3 -0.2) (scope-split 'x (relative 0.5 wing) (relative 0.5 wing)))])
  (define-rule (wing [self box-scope?]) [(=> (scope-repeat 'y 0.7 panel))])
  (define-rule (panel [self box-scope?])
    [(=> (scope-place oak) (scope-move 0.1 0.1 0) (scope-size (- (scope-size-x self) 0.2) (- (scope-size-y self) 0.2) 0.14) (scope-place oak))])
  [(=> (scope-split 'x (absolute 0.35 jamb) (rest portal) (absolute 0.35 jamb)))])

; how far a cornice comes out: the top one most
(define (old-depth s) (cond ((flag? s 'top-cornice) 0.6) ((flag? s 'bottom-cornice) 0.3) (else 0.18)))
(define-rule (old-cornice [self box-scope?])
  (define-rule (wall [self box-scope?]) [(=> (deep 0.4 0) (scope-place plastered))])
  [(=> (wall) (deep 0 (old-depth self)) (scope-place mould))])
(define-rule (old-corner [self box-scope?] [angle number?] [side symbol?])
  [(=> (sharp-half angle side (old-depth self) mould))])

; ---- modern: bands of glass between slabs ----
(define slab (block "#e9ebec"))
(define mullion (block "#33383d"))
(define tinted (block "#7fa9bd"))
(define timber (block "#b07a45"))

(define-rule (modern-tile [self box-scope?])
  (define-rule (post [self box-scope?]) [(=> (deep 0.2 0.05) (scope-place mullion))])
  (define-rule (bay [self box-scope?])
    [#:when (flag? self 'bottom-floor) (=> (glazing))]
    [(=> #:chance 0.25 (boards)) (=> (scope-split 'y (absolute 0.5 boards) (rest glazing)))])
  (define-rule (boards [self box-scope?]) [(=> (deep 0.2 -0.05) (scope-repeat 'x 0.18 board))])
  (define-rule (board [self box-scope?]) [(=> (scope-split 'x (rest timber) (absolute 0.02 #f)))])
  (define-rule (glazing [self box-scope?]) [(=> (deep 0.15 -0.11) (scope-place tinted))])
  [(=> (scope-split 'x (absolute 0.06 post) (rest bay)))])
(define-rule (modern-door [self box-scope?])
  (define-rule (leaf [self box-scope?]) [(=> (deep 0.2 -0.14) (scope-place timber))])
  [(=> (scope-split 'x (relative 0.5 (rule-with framed leaf)) (relative 0.5 (rule-with framed leaf))))])
(define-rule (framed [self box-scope?] [leaf procedure?])
  (define-rule (post [self box-scope?]) [(=> (deep 0.2 0) (scope-place mullion))])
  [(=> (scope-split 'x (absolute 0.06 post) (rest leaf) (absolute 0.06 post)))])
(define (modern-depth s) (if (flag? s 'top-cornice) 0.9 0.35))
(define-rule (modern-cornice [self box-scope?])
  [(=> (deep 0.4 (modern-depth self)) (scope-place slab))])
(define-rule (modern-corner [self box-scope?] [angle number?] [side symbol?])
  [(=> (round-half angle side (modern-depth self) slab))])
