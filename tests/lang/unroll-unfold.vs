; Surfaces unrolled against formulas, and nets of solids: area kept, so that no two faces overlap.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (same-area? s) (near? (area (unroll s)) (area s) 1e-9))

; cylinders and cones by formula, as surfaces and as the walls of solids, also placed
(displayln (near? (area (unroll (do-extrude (make-arc origin 2 0 pi) 3))) (* 6 pi) 1e-9))                        ; expect: #t
(displayln (near? (area (unroll (do-revolve (make-line (xyz 1 0 0) (xyz 2 0 3)) 'z 0 pi))) (* 1.5 pi (sqrt 10)) 1e-9)) ; expect: #t
(displayln (near? (area (unroll (do-rotate (make-cone origin (xyz 0 0 4) 3) 'x 1))) (* 15 pi) 1e-9))              ; expect: #t
(displayln (near? (area (unroll (do-scale (make-cylinder origin 4 3) 2))) (* 96 pi) 1e-9))                        ; expect: #t
(define wall (bounding-box (unroll (do-extrude (make-arc origin 2 0 pi) 3))))
(displayln (near? (cx (second wall)) (* 2 pi) 1e-9))                                                              ; expect: #t

; by face: oblique cylinders, cones from grids, folded faces, tangent surfaces
(displayln (same-area? (do-extrude (make-arc origin 2 0 pi) (vxyz 0 1 3))))                                       ; expect: #t
(displayln (same-area? (make-surface (lambda (u v) (xyz (* (+ 1 v) (cos u)) (* (+ 1 v) (sin u)) (* 2 v))) 0 pi 0 1 #:nu 24 #:nv 3))) ; expect: #t
(displayln (same-area? (make-3dface origin (xy 1 0) (xyz 1 1 1) (xy 0 1))))                                       ; expect: #t

; ruled, not developable: a warning with the figure
(displayln (region? (unroll (make-surface (lambda (u v) (xyz u v (* u v))) #:nu 10 #:nv 10))))
; expect: #t
(fails (unroll (make-surface (lambda (u v) (xyz u v (- 1 (* u u) (* v v)))) #:nu 4 #:nv 4)))
; expect: unroll: surface is doubly curved and cannot be laid flat: its curvature is 28.0 degrees in all, and its parts would miss each other by up to 0.251
(fails (unroll (make-box origin (xyz 1 2 3))))  ; expect: unroll: surface must be a surface, a cylinder or a cone; unfold lays other solids flat
(fails (unroll 3))                              ; expect: unroll: surface must be a surface, got 3

; nets of 50 random convex solids: each in one piece
(define state 1)
(define (random-number) (set! state (modulo (+ (* state 1103515245) 12345) 2147483648)) (/ state 2147483648.))
(define (random-hull n) (hull (map (lambda (i) (xyz (* 4 (random-number)) (* 3 (random-number)) (* 2 (random-number)))) (iota n))))
(define (flat-area parts) (apply + (map area parts)))
; the area that the net covers: less than the sum of its faces if two of them overlap
(define everything (make-region (make-rectangle (xy -1000 -1000) (xy 1000 1000))))
(define (covered parts) (apply + (map (lambda (p) (area (intersect (part-region p) everything))) parts)))
(define (kept? solid parts)
  (and (near? (flat-area parts) (area solid) (* 1e-9 (area solid))) (near? (covered parts) (area solid) (* 1e-7 (area solid)))))
(define hulls (map (lambda (i) (random-hull (+ 5 i))) (iota 50)))
(define nets (map (lambda (h) (unfold h #:numbers #f)) hulls))
(displayln (every (lambda (net) (= (length net) 1)) nets))                   ; expect: #t
(displayln (every kept? hulls nets))                                         ; expect: #t

; other polyhedra: area kept
(define (star n) (do-extrude (make-polygon (map (lambda (i) (pol (if (odd? i) 2 1) (* i (/ pi n)))) (iota (* 2 n)))) 1))
(define (stairs n) (unite (map (lambda (i) (make-box (xyz i 0 0) (xyz (+ i 1) 2 (+ i 1)))) (iota n))))
(define (window n) (subtract (make-box origin (xyz (+ 1 (* 2 n)) 4 1)) (map (lambda (i) (make-box (xyz (+ 1 (* 2 i)) 1 -1) (xyz (+ 2 (* 2 i)) 3 5))) (iota n))))
(define (corner n) (subtract (make-box origin (xyz 4 4 4)) (make-box (xyz n n n) (xyz 5 5 5))))
(define (bent n) (do-extrude (make-polygon (xy 0 0) (xy 5 0) (xy 5 n) (xy 1 n) (xy 1 5) (xy 0 5)) n))
(define few (append (map star (iota 5 3)) (map stairs (iota 6 2)) (map corner (iota 3 1)) (map bent (iota 4 1))))
(define solids (append few (map window '(1 4))))
(displayln (length solids))                                                  ; expect: 20
(displayln (every (lambda (s) (kept? s (unfold s #:numbers #f))) solids))    ; expect: #t
(displayln (every (lambda (s) (= (length (unfold s #:numbers #f)) 1)) few))  ; expect: #t

; glue tabs add area; folds and numbers are layers
(define cube (first (unfold (make-box origin (xyz 1 1 1)) #:tabs 0.2)))
(displayln (near? (area cube) (+ 6 (* 7 0.2 0.8)) 1e-9))                     ; expect: #t
; five folds between faces, and one at each of seven tabs
(displayln (length (object-children (first (object-children (second (object-children cube)))))))              ; expect: 12
(displayln (map object-arguments (object-children cube)))                    ; expect: ((cut) (mountain) (numbers))
(fails (unfold 3))                                                           ; expect: unfold: solid must be a solid, got 3
(fails (unfold (make-box origin (xyz 1 1 1)) #:tabs -1))                     ; expect: unfold: tabs must be a number of 0 or more, got -1
(displayln (unfold (lambda (x) (> x 3)) square 1+ 1))                        ; expect: (1 4 9)

; letters of single lines
(displayln (map cx (bounding-box (engrave "I" 8 #:at (xy 3 0)))))            ; expect: (3.0 3.0)
(fails (engrave "é" 8))
; expect: engrave: text has the character #\é, for which the stroke font has no letter; make-text has all letters of a font
