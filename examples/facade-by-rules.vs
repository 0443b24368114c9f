; A facade by rules, in G2's five stages: its parts, floors and the door's segment, cornices and tiles, and what fills them.
; The template facade knows neither windows nor doors: they are rules among its parameters.

(define (block c) (color c (make-box (xyz 0 0 0) (xyz 1 1 1))))
(define render-coat (block "#d9c7a5"))
(define ashlar (block "#b9ad99"))
(define trim (block "#efe8da"))
(define timber (block "#5a3a22"))
(define pane (block "#7fa3b8"))

; ---- the template: heights of the top, middle and bottom floors, the cornice's part of a floor, and four rules ----
(define-rule (facade [self box-scope?] [top-height positive?] [floor-height positive?] [bottom-height positive?] [cornice-ratio positive?]
                     [tile procedure?] [door procedure?] [cornice procedure?] [shop procedure?])
  (define-rule (floors [self box-scope?])
    [(=> (scope-repeat 'y floor-height storey))])
  (define-rule (storey [self box-scope?])
    [(=> (scope-split 'y (rest tiles) (relative cornice-ratio cornice)))])
  (define-rule (tiles [self box-scope?])
    [(=> (scope-repeat 'x 2.4 tile))])
  (define-rule (bottom [self box-scope?])
    [(=> (scope-split 'y (rest entrance) (relative cornice-ratio cornice)))])
  (define-rule (entrance [self box-scope?])
    [(=> (scope-split 'x (rest shops) (absolute 2.6 door) (rest shops)))])
  (define-rule (shops [self box-scope?])
    [(=> (scope-repeat 'x 3.6 shop))])
  (define-rule (attic [self box-scope?])
    [(=> (scope-split 'y (rest tiles) (relative (* 1.4 cornice-ratio) cornice)))])
  [(=> (scope-split 'y (absolute bottom-height bottom) (rest floors)
         (absolute top-height (lambda (s) (with-flags s '(top) attic)))))])

; ---- what fills it ----
(define-rule (framed [self box-scope?] [stone object?] [width positive?] [sill number?] [head positive?] [filling procedure?])
  (define-rule (column [self box-scope?])
    [(=> (scope-split 'y (absolute sill stone) (rest filling) (absolute head stone)))])
  [(=> (scope-split 'x (rest stone) (absolute width column) (rest stone)))])

(define-rule (window [self box-scope?])
  (define-rule (surround [self box-scope?])
    [(=> (scope-split 'x (absolute 0.1 trim) (rest sash) (absolute 0.1 trim)))])
  (define-rule (sash [self box-scope?])
    [(=> (scope-split 'y (absolute 0.1 sill) (rest leaves) (absolute 0.12 trim)))])
  (define-rule (sill [self box-scope?])
    [(=> (scope-size #f #f 0.55) (scope-place trim))])
  (define-rule (leaves [self box-scope?])
    [(=> (scope-move 0 0 0.12) (scope-size #f #f 0.06) (scope-repeat 'x 0.55 leaf))])
  (define-rule (leaf [self box-scope?])
    [(=> (scope-split 'x (absolute 0.04 timber) (rest lights) (absolute 0.04 timber)))])
  (define-rule (lights [self box-scope?])
    [(=> (scope-repeat 'y 0.6 light))])
  (define-rule (light [self box-scope?])
    [(=> (scope-split 'y (absolute 0.03 timber) (rest pane) (absolute 0.03 timber)))])
  [(=> (surround))])

(define-rule (tile [self box-scope?])
  [#:when (flag? self 'top) (=> (framed render-coat 0.9 0.5 0.3 window))]
  [(=> #:chance 0.95 (framed render-coat 1.15 0.8 0.45 window)) (=> (scope-place render-coat))])

(define-rule (shop [self box-scope?])
  [(=> (framed ashlar 2.4 0.6 0.6 window))])

(define-rule (door [self box-scope?])
  (define-rule (wing [self box-scope?])
    [(=> (scope-move 0 0 0.1) (scope-size #f #f 0.08) (scope-repeat 'x 0.7 timber))])
  [(=> (framed ashlar 1.5 0.01 0.7 wing))])

(define-rule (cornice [self box-scope?])
  [(=> (scope-split 'y (relative 0.4 (lambda (s) (scope-place (scope-size s #f #f 0.5) trim)))
         (rest (lambda (s) (scope-place (scope-size s #f #f 0.65) trim)))))])

(draw (facade (make-box-scope (xyz 0 0 0) 17 13.6 0.4) 2.7 3.3 4.2 0.09 tile door cornice shop))
; the street before it
(draw (with-material 'paving (make-box (xyz -40 -3.2 -0.16) (xyz 40 0 -0.01)) (make-box (xyz -40 -20 -0.16) (xyz 40 -11 -0.01)))
      (with-material 'asphalt (make-box (xyz -40 -11 -0.3) (xyz 40 -3.2 -0.16))))
(define (stand o x y [turn any? 0] [z any? -0.01]) (do-move (do-rotate o 'z (degrees->radians turn)) (vxyz x y z)))
(draw (stand (prefab "person" #:stride 0.25) 5.2 -1.6 80) (stand (prefab "person" #:height 1.62 #:coat "#8c4a3a" #:stride 0.15) 11.6 -1.3 -80)
      (stand (prefab "car" #:colour "#2f5d7c") 14.5 -4.6 90 -0.16) (stand (prefab "tree" #:height 7.5 #:seed 4) -3 -2.2))
(ground -0.17 #:material 'grass)
(sun #:azimuth 222 #:altitude 42)
(camera (xyz 2.5 -17.5 1.6) (xyz 8.4 0 6.2) #:lens 22 #:upright #t)
