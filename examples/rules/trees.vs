; Trees: one template, and what grows on it is said by two rules, one for leaves and one for fruit. Four trees of it stand side by side:
; bare of fruit, with apples, with pears, and in blossom. Loaded by street.vs. The template is our own; that trees are grown by turtles
; whose cross-sections make hexahedra is G2's (Krecklau, Pavic and Kobbelt, 2010).
;
; What it teaches: growth. A branch is a row of hexahedra, each the back of the next, so that bends are smooth; a rule that calls itself
; with smaller numbers forks; light pulls every branch upwards.
;
;   vs trees.vs -o trees.png --size 1280x480

; ---- the template ----
(define bark (color "#6d5543" (make-cylinder (xyz 0 0 0) (xyz 0 1 0) 0.5 #:segments 8)))

(define-rule (tree [self turtle-scope?] [levels integer?] [length positive?] [leaf procedure?] [fruit procedure?])
  ; five pieces of a branch, each thinner and bent by chance and by light; then its forks
  (define-rule (branch [self turtle-scope?] [level integer?] [length positive?] [piece integer? 0])
    [#:when (< piece 5)
     (=> (turtle-back)
         (turtle-forward (/ length 5))
         (turtle-yaw (random-range -0.14 0.14)) (turtle-pitch (random-range -0.14 0.14)) (turtle-toward uz 0.06)
         (thinner 0.91)
         (turtle-front bark)
         (grown level piece)
         (branch level length (+ piece 1)))]
    [#:when (> level 0)
     (=> (fork level length 0.5 0) (fork level length 0.75 2.2) (fork level length 0.6 4.3))]
    [(=> (leaf) (turtle-roll 2) (leaf))])
  (define-rule (fork [self turtle-scope?] [level integer?] [length positive?] [angle number?] [roll number?])
    [(=> (turtle-roll (+ roll (random-range -0.4 0.4))) (turtle-pitch (* angle (random-range 0.8 1.3)))
         (thinner 0.66)
         (branch (- level 1) (* length (random-range 0.64 0.84))))])
  ; twigs carry leaves and fruit
  (define-rule (grown [self turtle-scope?] [level integer?] [piece integer?])
    [#:when (= level 0)
     (=> (turtle-roll (* 2.4 piece)) (turtle-pitch 0.9) (leaf) (turtle-roll 2.5) (leaf) (fruit))]
    [(=>)])
  [(=> (branch levels length))])
(define (thinner s k) (turtle-height (turtle-width s (* k (scope-size-x s))) (* k (scope-size-y s))))

; ---- what grows on it ----
; A leaf lies ahead of the turtle: a hexahedron that is wide in the middle and flat.
(define (blade paint) (color paint (make-mesh (map-division (lambda (u v) (xyz (* 0.5 (sin u) (- (* 2 v) 1)) u (* 0.1 (cos u) (abs (- (* 2 v) 1))))) 0 pi 6 0 1 2))))
(define-rule (leaf-of [self turtle-scope?] [shape object?] [size positive?])
  [(=> (turtle-width (* size 0.55)) (turtle-height (* size 0.08)) (turtle-back)
       (turtle-forward (* size 0.5)) (turtle-pitch -0.35) (turtle-front shape))])
(define lime-leaf (rule-with leaf-of (blade "#6d9a3c") 0.55))
(define oak-leaf (rule-with leaf-of (blade "#4e7d34") 0.5))
(define pear-leaf (rule-with leaf-of (blade "#7f9b45") 0.45))
(define young-leaf (rule-with leaf-of (blade "#a3bb62") 0.3))

; Fruit hangs down, whichever way the twig points.
(define-rule (no-fruit [self turtle-scope?]) [(=>)])
(define (hang s object) (do-move object (p->q origin (scope-corner (turtle-height (turtle-width s 0) 0) 0 0 1))))
(define-rule (fruit-of [self turtle-scope?] [shape object?] [chance number?])
  [#:when (< (random) chance) (=> (hang shape))]
  [(=>)])
(define (lathe paint . profile)
  (color paint (do-revolve (make-spline (map (lambda (p) (xz (car p) (cadr p))) profile)) 'z)))
(define apple (unite (lathe "#c8332b" '(0 -0.05) '(0.07 -0.03) '(0.115 -0.12) '(0.06 -0.21) '(0 -0.2)) (color "#5a4030" (make-cylinder (xyz 0 0 -0.07) (xyz 0.01 0 0) 0.008))))
(define pear (unite (lathe "#c9b444" '(0 -0.03) '(0.035 -0.05) '(0.05 -0.12) '(0.1 -0.2) '(0.06 -0.28) '(0 -0.28)) (color "#5a4030" (make-cylinder (xyz 0 0 -0.05) (xyz -0.01 0 0.02) 0.008))))
(define apples (rule-with fruit-of apple 0.22))
(define pears (rule-with fruit-of pear 0.22))

; A blossom: five petals round the heading.
(define petal-shape (blade "#f3c9d3"))
(define-rule (petals [self turtle-scope?])
  (define-rule (petal [self turtle-scope?] [i integer?])
    [#:when (< i 5) (=> (one) (turtle-roll (/ 2pi 5)) (petal (+ i 1)))]
    [(=>)])
  (define-rule (one [self turtle-scope?])
    [(=> (turtle-pitch 1) (leaf-of petal-shape 0.26))])
  [#:when (< (random) 0.75) (=> (petal 0))]
  [(=>)])

; ---- what it stands on ----
(define meadow (make-material #:name "meadow" #:color "#6f7d45" #:roughness 1))
; Tufts of grass, six kinds, are placed over and over: on about every k by k of the scope's floor one, turned by chance. A tuft is one mesh of
; pyramids, which lean outwards and stand by the golden angle, so that none meets another.
(define straw '("#7f9350" "#8b9c57" "#6c8244"))
(define (tuft i)
  (define (spike k) ; its tip and three corners at its foot
    (let* ((way (* 2.4 k)) (foot (+pol origin (* 0.05 (sqrt k)) way)))
      (cons (+z (+pol foot (random-range 0.01 0.1) way) (random-range 0.05 0.1))
            (map-division (lambda (a) (+pol foot 0.012 (+ way a))) 0 2pi 3 #f))))
  (define (faces k) (map (lambda (face) (map (lambda (corner) (+ (* 4 k) corner)) face)) '((1 2 3) (1 3 4) (1 4 2) (4 3 2))))
  (color (list-ref straw (modulo i 3)) (make-polyface-mesh (append-map spike (iota 14)) (append-map faces (iota 14)))))
(define tufts (map tuft (iota 6)))
(define-rule (lawn [self box-scope?] [k positive?])
  (define-rule (row [self box-scope?]) [(=> (scope-repeat 'z k plot))])
  (define-rule (plot [self box-scope?])
    [(=> #:chance 0.8 (tuft-here (list-ref tufts (random 6)) (random-range 0.7 1.6) (random 2pi))) (=>)])
  (define (tuft-here s tuft size angle)
    (do-move (do-rotate (do-scale tuft size) 'z angle)
             (p->q origin (+xy (scope-corner s 0 0 0) (random (scope-size-x s)) (random (scope-size-z s))))))
  [(=> (scope-repeat 'x k row))])

(define (planted x y levels leaf fruit)
  (tree (make-turtle-scope (xyz x y 0) uz ux 0.34 0.34) levels 1.9 leaf fruit))
