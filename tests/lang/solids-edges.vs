; Faces and edges of solids as values, and selectors: counts and measures by formula, random solids by Euler's formula.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (sum l) (apply + l))

(define brick (make-box origin (xyz 4 3 2)))
(displayln (list (length (solid-faces brick)) (length (solid-edges brick))))                     ; expect: (6 12)
(displayln (map (lambda (d) (length (solid-edges brick (edges-along d)))) (list 'x (vxyz 0 -2 0) (make-axis (xyz 1 1 1) uz) (vxyz 1 1 0)))) ; expect: (4 4 4 0)
(displayln (map face-area (solid-faces brick (faces-towards 'z))))                               ; expect: (12.0)
(displayln (map face-normal (solid-faces brick (faces-towards (vxyz 0 -1 0)))))                  ; expect: ((vxyz 0 -1 0))
(displayln (map (lambda (f) (cdr (face-origin f))) (solid-faces brick (faces-where (lambda (f) (= (face-area f) 12.0)))))) ; expect: ((7 15) (7 15))
(displayln (map (lambda (s) (length (solid-edges brick s)))
                (list (edges-of (faces-towards 'z)) (edges-between (faces-towards 'z) (faces-towards 'x)) (all-of (edges-of (faces-towards 'z)) (edges-along 'x))
                      (any-of (edges-along 'x) (edges-along 'y)) (none-of (edges-along 'x)) (edges-where (lambda (e) (> (curve-length e) 2.5))) (all-of) (any-of))))
; expect: (4 1 2 8 8 8 12 0)
(define e (first (solid-edges brick (edges-along 'x))))
(displayln (list (curve? e) (curve-length e) (edge-angle e) (length (edge-faces e)) (object-kind e)))   ; expect: (#t 4.0 1.5707963267948966 2 edge)
(define f (first (solid-faces brick)))
(displayln (list (surface? f) (= (area f) (face-area f)) (object-kind f)))                       ; expect: (#t #t face)
(displayln (length (solid-edges brick (list e e))))                                              ; expect: 1

; ---- curved faces: walls are one face, rims one edge, of their true length ----
(define plate (subtract (make-box origin (xyz 4 4 1)) (make-cylinder (xyz 2 2 -1) 3 1)))
(define wall (faces-where (lambda (f) (near? (face-area f) (* 2 pi) 0.01))))
(displayln (list (length (solid-faces plate)) (length (solid-edges plate)) (length (solid-edges plate (edges-of wall)))))          ; expect: (7 14 2)
(displayln (near? (curve-length (first (solid-edges plate (edges-of wall)))) (* 2 pi) 1e-5))     ; expect: #t
(displayln (map (lambda (f) (cadr (face-origin f))) (solid-faces plate wall)))                   ; expect: (24)
(fails (face-normal (first (solid-faces plate wall))))                                           ; expect: face-normal: f must be a plane face; this one is curved
(define (count-of o) (list (length (solid-faces o)) (length (solid-edges o))))
(displayln (map count-of (list (make-cylinder origin 3 1) (make-sphere origin 1) (make-torus origin 3 1) (make-cut-cone origin 2 (xyz 0 0 1) 1) (make-prism origin 1 16 (xyz 0 0 2)))))
; expect: ((3 2) (1 0) (1 0) (3 2) (18 48))
(define L (do-extrude (make-polygon (xy 0 0) (xy 3 0) (xy 3 1) (xy 1 1) (xy 1 2) (xy 0 2)) 1))
(displayln (map edge-angle (solid-edges L (edges-where (lambda (e) (> (edge-angle e) pi))))))    ; expect: (4.71238898038469)
; a rounded slab: four planes and four cylinders around, chains of eight edges above and below
(define slab (do-extrude (do-offset (make-region (make-rectangle origin (xy 4 3))) 1 #:corners 'round) 1))
(displayln (count-of slab))                                                                      ; expect: (10 16)
(displayln (near? (sum (map curve-length (solid-edges slab (edges-of (faces-towards 'z))))) (+ 14 (* 2 pi)) 1e-5))                  ; expect: #t

; ---- random convex polyhedra: Euler's formula, areas ----
(random-seed! 3)
(define (random-hull n) (hull (map (lambda (i) (xyz (random 4.0) (random 3.0) (random 2.0))) (iota n))))
(define (corners edges) (length (delete-duplicates (append-map (lambda (e) (map (lambda (p) (list (round (* 1e5 (cx p))) (round (* 1e5 (cy p))) (round (* 1e5 (cz p))))) (curve-division e 1))) edges))))
(define (euler? i)
  (let* ((o (random-hull (+ 5 (modulo i 9)))) (edges (solid-edges o)) (faces (solid-faces o)))
    (and (= (+ (corners edges) (length faces)) (+ (length edges) 2)) (near? (sum (map face-area faces)) (area o) 1e-6) (every (lambda (e) (< 0 (edge-angle e) pi)) edges))))
(displayln (every euler? (iota 30)))                                                             ; expect: #t

; ---- bad arguments ----
(fails (edges-along 'w))          ; expect: edges-along: axis must be an axis ('x, 'y, 'z, a gvector or (make-axis point gvector)), got w
(fails (edges-of 5))              ; expect: edges-of: sel must be a selector, such as (edges-along 'z), or a list, got 5
(fails (edges-between car 5))     ; expect: edges-between: b must be a selector, such as (edges-along 'z), or a list, got 5
(fails (edges-where 5))           ; expect: edges-where: pred must be a procedure of an edge, got 5
(fails (faces-where 5))           ; expect: faces-where: pred must be a procedure of a face, got 5
(fails (all-of car 5))            ; expect: all-of: s must be a selector, such as (edges-along 'z), or a list, got 5
(fails (edge-angle brick))        ; expect: edge-angle: e must be an edge of a solid, got (make-box (xyz 0 0 0) (xyz 4 3 2))
(fails (face-area 5))             ; expect: face-area: f must be a face of a solid, got 5
(fails (solid-edges 5))           ; expect: solid-edges: o must be a solid, got 5
