; A street that does not end in sight: houses on plans of their own along both sides, old and modern by chance, trees before them. After
; figure 24 of Krecklau, Pavic and Kobbelt (2010); the rules are our own.
;
; What it teaches: large scenes. A lot is a scope like any other, and what stands on it is decided by chance and by how large it is in the
; picture: what is far away is made with fewer parts, and nobody sees it. All that is alike is stored and written once.
;
;   vs massive-street.vs -o street.png --size 1280x720                 -D lots=400 for ten times as many
(define-parameter lots 40 #:min 2 #:max 1000 #:label "lots on each side")
(define-parameter seed 7 #:min 1 #:max 100)
(require "buildings.vs")
(require "trees.vs")
(random-seed! seed)
(define lot-width 22)
(define half 11) ; of the street with its pavements
(sun #:azimuth 243 #:altitude 42)
(camera (xyz -30 -3 16) (xyz 60 1 7) #:lens 26)

(ground -0.5 #:material meadow)

; ---- a house on its lot ----
(define bar '((0 0) (1 0) (1 0.6) (0 0.6)))
(define ell '((0 0) (1 0) (1 0.55) (0.45 0.55) (0.45 1) (0 1)))
(define court '((0 0) (1 0) (1 1) (0.7 1) (0.7 0.5) (0.3 0.5) (0.3 1) (0 1)))
(define octagon '((0.2 0) (0.8 0) (1 0.2) (1 0.8) (0.8 1) (0.2 1) (0 0.8) (0 0.2)))
; The plan stands on the lot's floor: x along the street, and into the lot, which is against the scope's z.
(define (on-lot s plan)
  (define (corner p)
    (scope-corner (scope-move s (* (car p) (scope-size-x s)) 0 (* (- 1 (cadr p)) (scope-size-z s))) 0 0 0))
  (make-polygon-scope (apply make-polygon (map corner plan))))

(define-rule (lot [self box-scope?])
  [(=> (house (list-ref (list bar bar ell court octagon) (random 5)) (if (< (random 1.0) 0.6) old-style modern-style) (+ 10.5 (* 3 (random 5)))))])
(define-rule (house [self box-scope?] [plan list?] [style list?] [height positive?])
  ; all of it where it is longer than 120 pixels in a picture 1280 wide, else a block with a roof
  [#:when (> (scope-detail self #:width 1280) 120) (=> (standing plan style height))]
  [(=> (distant plan style height))])
(define (standing s plan style height) (building (on-lot s plan) style height))
(define (distant s plan style height)
  (let ((region (scope-region (on-lot s plan))))
    (list (color (if (eq? style old-style) "#cdb894" "#9fb4bd") (do-extrude region (vxyz 0 0 height)))
          (do-move (color (fifth style) (do-extrude region (vxyz 0 0 0.3))) (vxyz 0 0 height)))))

(define-rule (side [self box-scope?])
  [(=> (scope-repeat 'x lot-width plot))])
(define-rule (plot [self box-scope?])
  [(=> (scope-split 'x (absolute 1 #f) (rest lot) (absolute 1 #f)))])

; ---- trees: four grown ones are placed over and over ----
(define leaves (list lime-leaf oak-leaf))
(define saplings
  (map (lambda (i) (do-move (planted (* 100 i) 0 3 (list-ref leaves (modulo i 2)) no-fruit) (vxyz (* -100 i) 0 0))) '(0 1 2 3)))
(define-rule (avenue [self box-scope?])
  [(=> (scope-repeat 'x 11 shaded))])
(define-rule (shaded [self box-scope?])
  [(=> #:chance 0.85 (planted-here (list-ref saplings (random 4)) (random-range 0.9 1.3) (random 2pi))) (=>)])
(define (planted-here s tree k angle)
  (do-move (do-rotate (do-scale tree k) 'z angle) (p->q origin (scope-corner s 0 0 0))))

; ---- the street ----
(define long (* lots lot-width))
(define deep-lot 18)
(define near-side (make-box-scope (xyz 0 (+ half deep-lot) 0) long 20 deep-lot))
(define far-side (scope-turn (make-box-scope (xyz long (- (+ half deep-lot)) 0) long 20 deep-lot) 'y pi))
(draw (side near-side) (side far-side)
      (avenue (make-box-scope (xyz 4 (- half 3) 0) long 1 1)) (avenue (make-box-scope (xyz 4 (- 3 half) 0) long 1 1)))
; pavements and lots at 0, the road a kerb lower
(define kerb (- half 6))
(define (slab y0 y1 z) (make-box (xyz -80 y0 -0.5) (xyz (+ long 80) y1 z)))
(draw (with-material concrete (slab kerb (+ half deep-lot 6) 0) (slab (- (+ half deep-lot 6)) (- kerb) 0))
      (color "#77776f" (slab (- kerb) kerb -0.15))
      (color "#f2f2ee" (map (lambda (i) (make-box (xyz (* 8 i) -0.1 -0.15) (xyz (+ 3 (* 8 i)) 0.1 -0.1))) (iota (quotient long 8)))))
