; A city: six hundred thousand windows, and streets with trees and cars, out of a few dozen parts.
;
; What it teaches: making things once. A window is placed along a storey, a storey up a building, a building into a block, and every
; part that was made before is taken from a table (remember, below). What the program holds is small, and so is what it writes: POV-Ray's
; scene has a few thousand lines for millions of triangles. A rule decides how high the city is where, and chance does the rest.
;
;   vs city.vs -o city.png --size 1280x720
;   vs city.vs -D blocks=6 -o city.html

(define-parameter blocks 19 #:min 2 #:max 40 #:step 1 #:label "blocks along a side")
(define-parameter tallest 44 #:min 4 #:max 80 #:step 1 #:label "storeys of the tallest")

(define lot 26)          ; metres along a lot; four lots make a block
(define street 16)
(define storey-height 3.4)
(define pitch (+ lot lot street))
(define pane (make-material #:name "pane" #:color "#27384a" #:roughness 0.08))
(define sandstone (make-material #:name "sandstone" #:color "#cdbfa5" #:roughness 0.8))
(define limewash (make-material #:name "limewash" #:color "#e9e3d5" #:roughness 0.8))
(define terracotta (make-material #:name "terracotta" #:color "#a8765c" #:roughness 0.8))
(define slate (make-material #:name "slate" #:color "#8a9097" #:roughness 0.6))
(define tiles (make-material #:name "tiles" #:color "#9c5a41" #:roughness 0.9))
(define paint (make-material #:name "paint" #:color "#e8e6dc" #:roughness 0.7))
(define leaves (vector (make-material #:name "lime" #:color "#6f8f3c" #:roughness 1) (make-material #:name "oak" #:color "#4f7332" #:roughness 1)
                       (make-material #:name "plane" #:color "#83994e" #:roughness 1)))
(define walls (vector limewash sandstone limewash terracotta concrete limewash slate sandstone))
(define (any-of v) (vector-ref v (random (vector-length v))))

; The value of (make) for this key: worked out the first time, the same object ever after.
(define made (make-hash))
(define (remember key make)
  (hash-ref made key (lambda () (let ([o (make)]) (hash-set! made key o) o))))

(define (repeat object n step)
  (unite (map (lambda (i) (do-move object (* i step))) (iota n))))

; A pane, a sill and a lintel on the plane y = 0, looking along -y; x from 0.
(define window
  (unite (with-material pane (make-box (xyz 0.5 -0.02 0.9) (xyz 1.9 0.1 2.7)))
         (make-box (xyz 0.4 -0.14 0.78) (xyz 2 0 0.9))))
(define bay 2.4)

; The windows of one side, of one storey, and of all storeys.
(define (side width)
  (remember (list 'side width)
    (lambda ()
      (let ([n (quotient (exact (floor width)) 2)])
        (do-move (repeat window (min n (exact (floor (/ width bay)))) (vxyz bay 0 0))
                 (vxyz (/ (- width (* bay (floor (/ width bay)))) 2) 0 0))))))

(define (storey width depth)
  (remember (list 'storey width depth)
    (lambda ()
      (unite (side width)
             (do-move (do-rotate (side depth) 'z pi/2) (vxyz width 0 0))
             (do-move (do-rotate (side width) 'z pi) (vxyz width depth 0))
             (do-move (do-rotate (side depth) 'z -pi/2) (vxyz 0 depth 0))
             (make-box (xyz -0.12 -0.12 -0.15) (xyz (+ width 0.12) (+ depth 0.12) 0.1))))))

(define (tower width depth storeys)
  (remember (list 'tower width depth storeys)
    (lambda ()
      (let ([top (* storeys storey-height)])
        (unite (make-box (xyz 0 0 0) (xyz width depth top))
               (repeat (storey width depth) storeys (vxyz 0 0 storey-height))
               (subtract (make-box (xyz -0.2 -0.2 top) (xyz (+ width 0.2) (+ depth 0.2) (+ top 1)))
                         (make-box (xyz 0.3 0.3 (+ top 0.2)) (xyz (- width 0.3) (- depth 0.3) (+ top 2))))
               (make-box (xyz (/ width 3) (/ depth 3) top) (xyz (/ width 2) (/ depth 2) (+ top 3))))))))

; A low house may have a hipped roof.
(define (roof width depth)
  (remember (list 'roof width depth)
    (lambda ()
      (with-material tiles
        (do-move (do-scale (do-rotate (make-pyramid origin (/ (sqrt 2) 2) 4 (xyz 0 0 1) 0.14) 'z pi/4) (vxyz (+ width 1) (+ depth 1) 5.2))
                 (vxyz (/ width 2) (/ depth 2) 0))))))

; High in the middle, low at the edge, never twice the same: a wide foot, and on it a slimmer shaft where it is tall.
(define (building x y)
  (let* ([centre (/ (* blocks pitch) 2)]
         [far (/ (distance (xy x y) (xy centre centre)) centre)]
         [storeys (max 3 (exact (round (* tallest (exp (* -4 far far)) (random-range 0.4 1.15)))))]
         [width (- lot (random 3) 1)]
         [depth (- lot (random 3) 1)]
         [wall (any-of walls)]
         [foot (min storeys (+ 3 (random 4)))])
    (with-material wall
      (if (> storeys 12)
          (let ([inset (+ 2 (random 3))])
            (unite (tower width depth foot)
                   (do-move (tower (- width (* 2 inset)) (- depth (* 2 inset)) (- storeys foot))
                            (vxyz inset inset (* foot storey-height)))))
          (unite (tower width depth storeys)
                 (if (and (< storeys 6) (< (random) 0.7))
                     (do-move (roof width depth) (vxyz 0 0 (+ (* storeys storey-height) 0.2)))
                     (empty-object)))))))

(define (tree leaf)
  (unite (with-material wood (make-cylinder (xyz 0 0 0) 2.4 0.18 #:segments 6))
         (with-material leaf
           (make-sphere (xyz 0 0 4) 2 #:segments 12)
           (make-sphere (xyz 0.9 0.3 3.2) 1.3 #:segments 10)
           (make-sphere (xyz -0.7 -0.6 3.4) 1.4 #:segments 10))))
(define species (list->vector (map tree (vector->list leaves))))
(define (planted x y z) ; a tree of some kind and size, turned somehow
  (do-move (do-scale (do-rotate (any-of species) 'z (random-range 0 2pi)) (random-range 0.8 1.25)) (vxyz x y z)))

; Rows and groves are planted a few times over and used again and again.
(define (some n make) (list->vector (for/list ([i (in-range n)]) (make))))
(define rows (some 6 (lambda () (unite (for/list ([i (in-range 9)]) (planted (* 6.5 i) 0 0))))))
(define groves
  (some 4 (lambda ()
            (unite (for*/list ([i (in-range 8)] [j (in-range 8)] #:when (< (random) 0.8))
                     (planted (+ (* 6.4 i) 2 (random-range 0 4)) (+ (* 6.4 j) 2 (random-range 0 4)) 0))))))

; Cars on one lane, as long as a block, with gaps between them.
(define (vehicle color)
  (unite (with-material (make-material #:name "lacquer" #:color color #:roughness 0.25)
           (make-box (xyz 0 0 0.3) (xyz 4.4 1.8 0.95)))
         (with-material pane (make-box (xyz 0.9 0.12 0.95) (xyz 3.5 1.68 1.45)))))
(define cars (list->vector (map vehicle '("#b3261e" "#e9e9e6" "#23272b" "#2f5d8a" "#c9c7c0" "#d9a520"))))
(define lanes
  (some 8 (lambda ()
            (unite (for/list ([i (in-range 7)] #:when (< (random) 0.55))
                     (do-move (any-of cars) (vxyz (+ (* 9.5 i) (random-range 0 4)) 0 0)))))))

; The paint of a street along a block: dashes in the middle, a crossing at its end.
(define marks
  (with-material paint
    (repeat (make-box (xyz 0 -0.08 0.02) (xyz 2 0.08 0.04)) 10 (vxyz 5 0 0))
    (do-move (repeat (make-box (xyz 0 0 0.02) (xyz 3 0.5 0.04)) 9 (vxyz 0 1 0)) (vxyz 53 -4.3 0))))
(define (road) ; along x, its middle on y = 0
  (unite marks (do-move (any-of lanes) (vxyz 0 -3.4 0)) (do-move (do-rotate (any-of lanes) 'z pi) (vxyz 60 3.4 0))))

(define pavement
  (with-material stone (make-box (xyz -3 -3 0) (xyz (+ lot lot 3) (+ lot lot 3) 0.18))))

(define (block x y)
  (let ([park? (< (random) 0.07)])
    (unite (do-move pavement (vxyz x y 0))
           (do-move (road) (vxyz x (- y (/ street 2)) 0))
           (do-move (do-rotate (road) 'z pi/2) (vxyz (- x (/ street 2)) y 0))
           (do-move (any-of rows) (vxyz x (- y 1.8) 0.18))
           (do-move (any-of rows) (vxyz x (+ y lot lot 1.8) 0.18))
           (if park?
               (unite (with-material grass (make-box (xyz x y 0.18) (xyz (+ x lot lot) (+ y lot lot) 0.24)))
                      (do-move (any-of groves) (vxyz x y 0.2)))
               (unite (for*/list ([i (in-range 2)] [j (in-range 2)])
                        (let ([px (+ x (* i lot))] [py (+ y (* j lot))])
                          (do-move (building px py) (vxyz (+ px 0.5) (+ py 0.5) 0.18)))))))))

(random-seed! 7)
(draw (unite (for*/list ([i (in-range blocks)] [j (in-range blocks)])
               (block (* i pitch) (* j pitch)))))

(let ([size (* blocks pitch)])
  (draw (with-material asphalt (make-box (xyz -20 -20 -0.3) (xyz size size 0.02)))))

(ground -0.2 #:material (make-material #:name "meadow" #:color "#a3b49b" #:roughness 1))
(sky #:color "#a9c4e4")
(sun #:azimuth 245 #:altitude 21)
(let ([size (* blocks pitch)]) ; from above a street towards the middle
  (camera (xyz (* 0.3 size) (* 0.035 size) (+ 40 (* 0.055 size))) (xyz (* 0.5 size) (* 0.52 size) (* 0.028 size)) #:lens 33))
