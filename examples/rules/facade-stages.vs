; A facade in five stages, side by side: its parts; floors and the segment of the door; cornices and tiles; and the same template filled
; twice. After figure 18 of Krecklau, Pavic and Kobbelt (2010); the rules are our own.
;
; What it teaches: from coarse to fine. The third, fourth and fifth front are one call of one rule with other rules among its arguments.
;
;   vs facade-stages.vs -o stages.png
(require "fillings.vs")

(define width 13) (define height 14.5)
(define top 3) (define middle 3) (define bottom 4)

; ---- (a) parts, (b) floors ----
(define coral (block "#c2604f")) (define sand (block "#cfa75c")) (define moss (block "#6f8f63")) (define sea (block "#5c86a3"))
(define (lined c) (define-rule (inset [self box-scope?]) [(=> (scope-move 0.06 0.06 0) (scope-size (- (scope-size-x self) 0.12) (- (scope-size-y self) 0.12) 0.3) (scope-place c))]) inset)
(define-rule (parts [self box-scope?])
  [(=> (scope-split 'y (absolute bottom (lined moss)) (rest (lined sand)) (absolute top (lined coral))))])
(define-rule (floors [self box-scope?])
  (define-rule (entrance [self box-scope?]) [(=> (scope-split 'x (rest (lined moss)) (absolute 2.4 (lined sea)) (rest (lined moss))))])
  (define-rule (storeys [self box-scope?]) [(=> (scope-repeat 'y middle (lined sand)))])
  [(=> (scope-split 'y (absolute bottom entrance) (rest storeys) (absolute top (lined coral))))])

; ---- (c) tiles and cornices as blocks, coloured by the flags that the template sets ----
(define-rule (tile-block [self box-scope?])
  [#:when (flag? self 'top-floor) (=> ((lined coral)))]
  [#:when (flag? self 'bottom-floor) (=> ((lined moss)))]
  [(=> ((lined sand)))])
(define-rule (door-block [self box-scope?]) [(=> ((lined sea)))])
(define ledges (block "#f2efe9"))
(define-rule (cornice-block [self box-scope?]) [(=> (deep 0 0.6) (scope-place ledges))])
(define-rule (corner-block [self box-scope?] [angle number?] [side symbol?]) [(=> (sharp-half angle side 0.6 ledges))])

; ---- all five ----
(define (front i rule . arguments)
  (apply rule (make-box-scope (xyz (* i (+ width 2)) 0 0) width height 0) arguments))
(define (template i tile door cornice corner)
  (front i abstract-facade top middle bottom 0.13 pi/2 pi/2 #t tile door cornice corner))

(draw (front 0 parts)
      (front 1 floors)
      (template 2 tile-block door-block cornice-block corner-block)
      (template 3 old-tile old-door old-cornice old-corner)
      (template 4 modern-tile modern-door modern-cornice modern-corner))
; a square of slabs before them
(define-rule (paving [self box-scope?]) [(=> (scope-repeat 'x 4 strip))])
(define-rule (strip [self box-scope?]) [(=> (scope-repeat 'z 4 slab-of-stone))])
(define-rule (slab-of-stone [self box-scope?])
  [(=> (scope-split 'x (rest (rule-with cut (block (list-ref '("#8f8a80" "#96918a" "#a09b92") (random 3))))) (absolute 0.04 #f)))])
(define-rule (cut [self box-scope?] [stone object?]) [(=> (scope-split 'z (rest stone) (absolute 0.04 #f)))])
(draw (paving (make-box-scope (xyz -16 0.6 -0.1) 112 0.1 52)))
(ground -0.1 #:material (make-material #:name "mortar" #:color "#7d776c" #:roughness 1))
(sun #:azimuth 238 #:altitude 40)
(camera (xyz 86 -29 1.7) (xyz 61 0 7.2) #:lens 28 #:upright #t)
