; A city: six hundred thousand windows out of a few dozen parts.
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
(define walls (vector limewash sandstone limewash terracotta concrete limewash slate sandstone))

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

; High in the middle, low at the edge, never twice the same: a wide foot, and on it a slimmer shaft where it is tall.
(define (building x y)
  (let* ([centre (/ (* blocks pitch) 2)]
         [far (/ (distance (xy x y) (xy centre centre)) centre)]
         [storeys (max 3 (exact (round (* tallest (exp (* -4 far far)) (random-range 0.4 1.15)))))]
         [width (- lot (random 3) 1)]
         [depth (- lot (random 3) 1)]
         [wall (vector-ref walls (random (vector-length walls)))]
         [foot (min storeys (+ 3 (random 4)))])
    (with-material wall
      (if (> storeys 12)
          (let ([inset (+ 2 (random 3))])
            (unite (tower width depth foot)
                   (do-move (tower (- width (* 2 inset)) (- depth (* 2 inset)) (- storeys foot))
                            (vxyz inset inset (* foot storey-height)))))
          (tower width depth storeys)))))

(define tree
  (unite (with-material wood (make-cylinder (xyz 0 0 0) 2.4 0.18 #:segments 6))
         (with-material grass
           (make-sphere (xyz 0 0 4) 2 #:segments 12)
           (make-sphere (xyz 0.9 0.3 3.2) 1.3 #:segments 10)
           (make-sphere (xyz -0.7 -0.6 3.4) 1.4 #:segments 10))))
(define trees (repeat tree 9 (vxyz 6.5 0 0)))

(define pavement
  (with-material stone (make-box (xyz -3 -3 0) (xyz (+ lot lot 3) (+ lot lot 3) 0.18))))

(define (block x y)
  (let ([park? (< (random) 0.07)])
    (unite (do-move pavement (vxyz x y 0))
           (do-move trees (vxyz x (- y 1.8) 0.18))
           (do-move trees (vxyz x (+ y lot lot 1.8) 0.18))
           (if park?
               (unite (with-material grass (make-box (xyz x y 0.18) (xyz (+ x lot lot) (+ y lot lot) 0.24)))
                      (unite (for/list ([i (in-range 7)])
                               (do-move trees (vxyz x (+ y 4 (* 7 i)) 0.2)))))
               (unite (for*/list ([i (in-range 2)] [j (in-range 2)])
                        (let ([px (+ x (* i lot))] [py (+ y (* j lot))])
                          (do-move (building px py) (vxyz (+ px 0.5) (+ py 0.5) 0.18)))))))))

(random-seed! 7)
(draw (unite (for*/list ([i (in-range blocks)] [j (in-range blocks)])
               (block (* i pitch) (* j pitch)))))

(let ([size (* blocks pitch)])
  (draw (with-material asphalt (make-box (xyz -20 -20 -0.3) (xyz size size 0.02)))))

(ground -0.2 #:material (make-material #:name "meadow" #:color "#9aa386" #:roughness 1))
(sun #:azimuth 250 #:altitude 27)
(let ([size (* blocks pitch)])
  (camera (xyz (* 0.12 size) (* -0.05 size) (* 0.1 size)) (xyz (* 0.5 size) (* 0.55 size) (* 0.015 size)) #:lens 30))
