; Distances, implicit solids, triangulations, cells, panels, and the mathematics of PM4VR's table.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (within? a b share) (<= (abs (- a b)) (* share (abs b))))
(define cube (make-box (xyz -1 -1 -1) (xyz 1 1 1)))
(displayln (map (lambda (p) (signed-distance cube p)) (list (xyz 0 0 0.5) (xyz 4 5 1) (xyz 0 0 -3) origin))) ; expect: (-0.5 5.0 2.0 -1.0)
(displayln (near? (signed-distance cube (xyz 2 2 2)) (sqrt 3) 1e-12))     ; expect: #t
(displayln (within? (signed-distance (make-sphere origin 1) (xyz 0.2 0.3 0.4)) (- (sqrt 0.29) 1) 1e-2)) ; expect: #t
(fails (signed-distance (make-circle origin 1) origin))  ; expect: signed-distance: o must be a solid, got (make-circle (xyz 0 0 0) 1)
(fails (signed-distance cube 3))                   ; expect: signed-distance: p must be a point of finite coordinates, got 3
(define d (distance-function cube))
(displayln (list (d 0 0 0) (function-expression d))) ; expect: (-1.0 (distance x y z))
(displayln (let ((b (function-bounds d (interval 2 3) 0 0))) (<= (interval-low b) 1 2 (interval-high b)))) ; expect: #t
(fails (function-text d 'povray))                  ; expect: function-text: the function holds the distance from a solid, which has no formula
; solids of them
(define p (xyz -1.5 -1.5 -1.5))
(define q (xyz 1.5 1.5 1.5))
(define (solid f) (make-isosurface f p q #:cells 40))
(displayln (within? (volume (solid (implicit-offset cube 0.25))) (+ 8 (* 24 0.25) (* 6 pi 0.0625) (* 4/3 pi 1/64)) 2e-3)) ; expect: #t
(define-function (ball x y z) (- (sqrt (+ (square x) (square y) (square z))) 1))
(displayln (within? (volume (solid (implicit-shell ball 0.2))) (* 4/3 pi (- 1 (expt 0.8 3))) 5e-3)) ; expect: #t
(displayln (within? (volume (solid (implicit-difference cube (implicit-offset ball -0.2)))) (- 8 (* 4/3 pi 0.512)) 5e-3)) ; expect: #t
(displayln (within? (volume (solid (implicit-intersection ball (implicit-move ball (vxyz 1 0 0))))) (* 5/12 pi) 0.02)) ; expect: #t
(displayln (within? (volume (solid (implicit-union ball (implicit-move ball (vxyz 0.5 0 0))))) (* pi 11/16 2.6666666) 0.2)) ; expect: #t
(define blob (implicit-smooth-union 0.4 ball (implicit-move ball (vxyz 1.5 0 0))))
(displayln (and (< (blob 0.75 0.7 0) 0) (> (ball 0.75 0.7 0) 0)))         ; expect: #t
(displayln (within? (volume (solid (implicit-twist (make-box (xyz -0.5 -0.5 -1) (xyz 0.5 0.5 1)) 0.6))) 2 0.01)) ; expect: #t
(displayln (within? (volume (solid (implicit-blend ball cube 0.5))) 5.8 0.1)) ; expect: #t
(define lattice (solid (implicit-lattice cube (gyroid 1) 0.12)))
(displayln (and (solid? lattice) (within? (volume lattice) (* 8 3.09 0.12) 0.1))) ; expect: #t
(displayln (solid? (solid (implicit-lattice ball (schwarz-p 0.8) 0.12)))) ; expect: #t
(fails (implicit-union ball sin))                  ; expect: implicit-union: an operand must be a function of x, y and z made by define-function, or a solid, got #<procedure sin>
(fails (implicit-shell ball 0))                    ; expect: implicit-shell: thickness must be a positive number, got 0
(fails (gyroid -1))                                ; expect: gyroid: cell must be a positive number, got -1
; triangles and cells
(displayln (length (delaunay (list origin (xyz 4 0 0) (xyz 4 4 1) (xyz 0 4 0) (xyz 2 2 3))))) ; expect: 4
(displayln (delaunay (list origin (xyz 1 0 0) (xyz 2 0 0))))              ; expect: ()
(displayln (first (delaunay (list (xyz 0 0 7) (xyz 1 0 8) (xyz 0 1 9)))))  ; expect: ((xyz 0 1 9) (xyz 0 0 7) (xyz 1 0 8))
(define points (map (lambda (i) (xy (random 10.0) (random 10.0))) (iota 1000)))
(define cells (voronoi points (make-rectangle origin (xy 10 10))))
(displayln (and (= (length cells) 1000) (< (abs (- (apply + (map area cells)) 100)) 1e-9))) ; expect: #t
(displayln (every contains? (take cells 50) (take points 50)))            ; expect: #t
(define yard (subtract (make-circle (xy 5 5) 4) (make-circle (xy 5 5) 1)))
(displayln (near? (apply + (map area (remove empty-object? (voronoi (take points 80) yard)))) (area yard) 2e-2)) ; expect: #t
(displayln (map area (voronoi (list (xy 1 5) (xy 5 5) (xy 1 5)) (make-rectangle origin (xy 10 10))))) ; expect: (30.0 70.0 0.0)
(displayln (map area (voronoi (list (xy 3 3)) (make-rectangle origin (xy 10 10))))) ; expect: (100.0)
(fails (voronoi '() (make-rectangle origin (xy 1 1))))  ; expect: voronoi: points must be one point or more, got ()
(fails (voronoi points (make-line origin (xyz 1 1 0)))) ; expect: voronoi: region must be a region or a closed curve, got (make-line (list (xyz 0 0 0) (xyz 1 1 0)))
; panels: every grid covers the square
(define (flat u v) (xyz u v 0))
(define grids (list (quad-grid 4 4) (triangle-grid 4 4) (diamond-grid 4 3) (hexagon-grid 5 4)))
(define (covered grid) (apply + (map (lambda (c) (area (make-polygon c))) (panel-corners flat grid))))
(displayln (every (lambda (g) (near? (covered g) 1 1e-9)) grids))         ; expect: #t
(displayln (map length grids))                                            ; expect: (16 32 31 33)
(define (saddle u v) (xyz (* 10 u) (* 10 v) (* 4 (- u 0.5) (- v 0.5))))
(define report (panel-report saddle (quad-grid 4 4)))
(displayln (list (cdr (assq 'panels report)) (cdr (assq 'bent report)) (near? (cdr (assq 'worst report)) 0.0625 0.005))) ; expect: (16 16 #t)
(displayln (cdr (assq 'bent (panel-report saddle (triangle-grid 4 4)))))  ; expect: 0
(displayln (solid? (panelise saddle (hexagon-grid 6 6) (lambda (c) (panel-plate c 0.1 #:gap 0.02))))) ; expect: #t
; cells at the pole of a dome lose the corners that are one there; cells without area are no panels
(define (dome u v) (sph 5 (* 2pi u) (* v pi/2)))
(define (needle u v) (xyz u 0 0)) ; no area at all
(displayln (map (lambda (g)
                  (let ((corners (panel-corners dome g)))
                    (list (solid? (panelise dome g (lambda (c) (panel-plate c 0.1 #:gap 0.01))))
                          (apply min (map length corners)) (= (length corners) (cdr (assq 'panels (panel-report dome g))))
                          (every (lambda (c) (> (area (make-polyface-mesh c (list (iota (length c) 1)))) 1e-3)) corners))))
                (list (quad-grid 8 4) (triangle-grid 8 4) (diamond-grid 8 4))))
; expect: ((#t 3 #t #t) (#t 3 #t #t) (#t 3 #t #t))
(displayln (panel-corners needle (quad-grid 2 2))) ; expect: ()
(displayln (volume (panel-plate (list origin (xyz 4 0 0) (xyz 4 2 0) (xyz 0 2 0)) 0.5)))  ; expect: 4.0
(fails (panelise saddle 3 list))                   ; expect: panelise: grid must be a grid, such as (quad-grid 8 4), or a list of regions with one border, got 3
(fails (panelise saddle (quad-grid 2 2) list))     ; expect: panelise: component must give an object, got (((xyz 0 0 1) (xyz 5 0 0) (xyz 5 5 0) (xyz 0 5 0)))
(fails (quad-grid 0 4))                            ; expect: quad-grid: nu must be an exact integer from 1 to 1000, got 0
; PM4VR's functions (figure 10 of its supplement), by its names: each at one place
(define table
  (list (list 'sin (sin 1) 0.8414709848) (list 'cos (cos 1) 0.5403023059) (list 'tan (tan 1) 1.5574077247)
        (list 'cot (cot 1) 0.6420926159) (list 'sec (sec 1) 1.8508157177) (list 'csc (csc 1) 1.1883951058)
        (list 'asin (asin 0.5) 0.5235987756) (list 'acos (acos 0.5) 1.0471975512) (list 'atan (atan 0.5) 0.4636476090)
        (list 'acot (acot 0.5) 1.1071487178) (list 'asec (asec 2) 1.0471975512) (list 'acsc (acsc 2) 0.5235987756)
        (list 'abs (abs -2) 2) (list 'pow (expt 2 10) 1024) (list 'exp (exp 1) 2.7182818285)
        (list 'log (log 8 2) 3) (list 'lg (log10 1000) 3) (list 'ln (log 2) 0.6931471806)
        (list 'sqrt (sqrt 2) 1.4142135624) (list 'rand (if (<= 0 (random 1.0) 1) 1 0) 1) (list 'fact (factorial 10) 3628800)
        (list 'perm (permutations 10 3) 720) (list 'comb (combinations 10 3) 120) (list 'squ (square 3) 9)
        (list 'saw (sawtooth 2.25) 0.25) (list 'sh (sinh 1) 1.1752011936) (list 'ch (cosh 1) 1.5430806348)
        (list 'th (tanh 1) 0.7615941560) (list 'arsh (asinh 1) 0.8813735870) (list 'arch (acosh 2) 1.3169578969)
        (list 'arth (atanh 0.5) 0.5493061443) (list 'gau (gauss 0) 0.3989422804) (list 'tay ((taylor exp 0 9) 1) 2.7182815256)))
(displayln (length table))                         ; expect: 33
(displayln (filter (lambda (row) (not (near? (second row) (third row) 1e-9))) table)) ; expect: ()
(displayln (list (root 32 5) (combinations 3 5) (range-control "s" 0 1)))  ; expect: (2 0 1/2)
; its vectors (figure 7): the angle between <1,2,3> and <4,5,6>, where the figure prints half of pi
(displayln (near? (angle-between (vxyz 1 2 3) (vxyz 4 5 6)) 0.225726 1e-6)) ; expect: #t
(displayln (list (dot (vxyz 1 2 3) (vxyz 4 5 6)) (v+v (vxyz 1 2 3) (vxyz 4 5 6)) (v-project (vxyz 4 5 6) ux))) ; expect: (32.0 (vxyz 5 7 9) (vxyz 4 0 0))
(fails (factorial -1))                             ; expect: factorial: n must be an exact integer from 0 to 100000, got -1
(fails (taylor sin 0 99))                          ; expect: taylor: n must be an exact integer from 0 to 12, got 99
(fails (range-control "s" 1 0))                    ; expect: range-control: low and high must be numbers, low below high, got 1 and 0
