; Rounded and bevelled edges: closed forms, and random solids with random selectors.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (volume-within? o v slack) (near? (volume o) v slack))

; ---- closed forms ----
; the area between a right angle and its arc of radius r, and the distance of its centroid from each side
(define (spandrel r) (* r r (- 1 (/ pi 4))))
(define (off r) (* r (/ (- 10 (* 3 pi)) (- 12 (* 3 pi)))))
(define (ring r R side) (* 2 pi (spandrel r) (+ R (* side (off r)))))   ; around an axis; side -1 inside, 1 outside of R
(define (rounded-box a b c r)
  (let ((a (- a r r)) (b (- b r r)) (c (- c r r)))
    (+ (* a b c) (* 2 r (+ (* a b) (* b c) (* c a))) (* pi r r (+ a b c)) (* 4/3 pi r r r))))
(define brick (make-box origin (xyz 4 3 2)))
(displayln (map (lambda (r) (volume-within? (do-fillet brick r) (rounded-box 4 3 2 r) 4e-3)) '(1/10 1/2 1)))                       ; expect: (#t #t #t)
; the same solid as the sum of a smaller box and a ball
(define core (make-box (xyz 1/2 1/2 1/2) (xyz 7/2 5/2 3/2)))
(displayln (< (volume (subtract (do-fillet brick 1/2) (minkowski core (make-sphere origin 1/2)))) 5e-3))                           ; expect: #t
(displayln (near? (area (do-fillet brick 1/2)) (area (minkowski core (make-sphere origin 1/2))) 5e-2))                             ; expect: #t
(displayln (volume-within? (do-fillet brick 1/2 #:edges (edges-along 'z)) (- 24 (* 8 (spandrel 1/2))) 1e-3))                       ; expect: #t
(displayln (volume (do-chamfer brick 1/2 #:edges (edges-along 'z))))                             ; expect: 23.0
(displayln (volume (do-chamfer brick 1/2 #:edges (edges-between (faces-towards 'z) (faces-towards 'x))))) ; expect: 23.625
; cylinders and holes: inner and outer rims
(define rod (make-cylinder origin 3 2))
(displayln (volume-within? (do-fillet rod 1/4) (- (* 12 pi) (* 2 (ring 1/4 2 -1))) 1e-2))        ; expect: #t
(displayln (volume-within? (do-chamfer rod 1/4 #:edges (edges-of (faces-towards 'z))) (- (* 12 pi) (* 2 pi 1/32 (- 2 1/12))) 1e-2)) ; expect: #t
(define plate (subtract (make-box origin (xyz 4 4 1)) (make-cylinder (xyz 2 2 -1) 3 1)))
(define hole (faces-where (lambda (f) (near? (face-area f) (* 2 pi) 0.01))))
(displayln (volume-within? (do-fillet plate 1/4 #:edges (edges-of hole)) (- 16 pi (* 2 (ring 1/4 1 1))) 2e-3))                     ; expect: #t
(define boss (unite (make-box origin (xyz 6 6 1)) (make-cylinder (xyz 3 3 1) 2 1)))
(define (concave e) (> (edge-angle e) pi))
(define (convex e) (< (edge-angle e) pi))
(displayln (volume-within? (do-fillet boss 1/4 #:edges concave) (+ 36 (* 2 pi) (ring 1/4 1 1)) 3e-3))                              ; expect: #t
(displayln (volume-within? (do-chamfer boss 1/4 #:edges concave) (+ 36 (* 2 pi) (* 2 pi 1/32 (+ 1 1/12))) 3e-3))                   ; expect: #t
; chains of lines and arcs
(define slab (do-extrude (do-offset (make-region (make-rectangle origin (xy 4 3))) 1 #:corners 'round) 1))
(define slab-volume (+ 12 14 pi))
(displayln (volume-within? (do-fillet slab 1/4) (- slab-volume (* 2 (+ (* 14 (spandrel 1/4)) (ring 1/4 1 -1)))) 3e-3))              ; expect: #t
; chamfered and rounded prisms; a tetrahedron is a sum, too
(define (prism-cut n R h d) ; the volume that an edge's chamfers take around both ends of a prism
  (let* ((phi (/ pi n)) (apothem (* R (cos phi))) (small (- apothem d)) (area-of (lambda (a) (* n a a (tan phi)))))
    (* 2 (- (* d (area-of apothem)) (* d 1/3 (+ (area-of apothem) (area-of small) (sqrt (* (area-of apothem) (area-of small)))))))))
(define hex (make-prism origin 2 6 (xyz 0 0 3)))
(displayln (volume-within? (do-chamfer hex 1/4 #:edges (none-of (edges-along 'z))) (- (volume hex) (prism-cut 6 2 3 1/4)) 1e-6))   ; expect: #t
(define tetrahedron (make-pyramid origin 2 3 (xyz 0 0 3)))
(define inradius (/ (* 3 (volume tetrahedron)) (area tetrahedron)))
(define (rounded-tetrahedron r) ; smaller by the factor k about the centre of the inner ball
  (minkowski (do-scale tetrahedron (xyz 0 0 inradius) (- 1 (/ r inradius))) (make-sphere origin r)))
(displayln (volume-within? (do-fillet tetrahedron 1/4) (volume (rounded-tetrahedron 1/4)) 4e-3))  ; expect: #t
(displayln (volume-within? (do-fillet tetrahedron 7/10) (volume (rounded-tetrahedron 7/10)) 2e-2)) ; expect: #t
; inner corners: three concave edges and a ball; a mitre where two walls meet
(define nook (subtract (make-box origin (xyz 4 4 4)) (make-box (xyz 2 2 2) (xyz 5 5 5))))
(displayln (volume-within? (do-fillet nook 1/4 #:edges concave) (+ 56 (* 3 7/4 (spandrel 1/4)) (* 1/64 (- 1 (/ pi 6)))) 1e-3))      ; expect: #t
(define L (do-extrude (make-polygon (xy 0 0) (xy 3 0) (xy 3 1) (xy 1 1) (xy 1 2) (xy 0 2)) 1))
(displayln (volume-within? (do-fillet L 1/4 #:edges concave) (+ 4 (spandrel 1/4)) 1e-4))         ; expect: #t
(displayln (volume (do-chamfer L 1/4 #:edges (edges-of (faces-towards 'z)))))                    ; expect: 3.7083333333333335
(displayln (solid? (do-fillet L 1/8 #:edges (lambda (e) #t))))                                   ; expect: #t

; ---- the largest size: it is stated, it fits, and more does not ----
(fails (do-fillet brick 1.01))    ; expect: do-fillet: r 1.01 is too large at (xyz 2 0 0): the largest that fits there is 1.0
(fails (do-chamfer brick 2))      ; expect: do-chamfer: d 2 is too large at (xyz 2 0 0): the largest that fits there is 1.0
(fails (do-fillet rod 2.5))       ; expect: do-fillet: r 2.5 is too large at (xyz -2 0 0): the largest that fits there is 1.5
(fails (do-fillet plate 1 #:edges (edges-of hole))) ; expect: do-fillet: r 1 is too large at (xyz 3 2 0): the largest that fits there is 0.5
(displayln (map (lambda (o) (solid? o)) (list (do-fillet rod 1.5) (do-fillet plate 1/2 #:edges (edges-of hole)) (do-chamfer brick 1))))  ; expect: (#t #t #t)

; ---- random solids and selectors: a volume between bounds, or a message that names the edge ----
(random-seed! 11)
(define (pick l) (list-ref l (random (length l))))
(define (a-box) (let ((p (xyz (random 4) (random 4) (random 4)))) (make-box p (+xyz p (+ 1 (random 3)) (+ 1 (random 3)) (+ 1 (random 3))))))
(define (random-solid i)
  (case (modulo i 5)
    ((0) (unite (a-box) (a-box)))
    ((1) (subtract (make-box origin (xyz 4 4 4)) (a-box) (a-box)))
    ((2) (hull (map (lambda (i) (xyz (random 4.0) (random 4.0) (random 4.0))) (iota 7))))
    ((3) (make-prism (xyz (random 3) (random 3) 0) 1.5 (+ 3 (random 5)) (xyz (random 3) (random 3) 6)))
    (else (pick (list plate boss rod slab)))))
(define (loss e d) ; an upper bound of the volume that an edge takes
  (let ((a (min (edge-angle e) (- (* 2 pi) (edge-angle e))))) (* (+ (curve-length e) (* 8 d)) d d (+ 2 (/ 2 (tan (/ a 2)))))))
(define (outcome i)
  (let* ((o (random-solid i)) (work (pick (list do-fillet do-chamfer))) (d (* 0.02 (+ 1 (random 8)))) (select (pick (list convex concave (edges-along 'z) (edges-of (faces-towards 'z))))))
    (guard (c ((error-object? c) (let ((text (condition/report-string c))) (cond ((string-contains? text "(xyz") 'said) ((string-contains? text "no edge") 'none) (else text)))))
      (let ((v (volume o)) (w (volume (work o d #:edges select))) (most (apply + (map (lambda (e) (loss e d)) (solid-edges o select)))))
        (if (<= (- v most) w (+ v most)) 'done (list i v w most))))))
(define outcomes (map outcome (iota 60)))
(displayln (remove (lambda (x) (memq x '(done said none))) outcomes))                                 ; expect: ()
(define (count-of name) (length (filter (lambda (x) (eq? x name)) outcomes)))
(displayln (>= (count-of 'done) (* 9 (count-of 'said))))                                         ; expect: #t

; ---- bad arguments ----
(fails (do-fillet brick 0))       ; expect: do-fillet: r must be a positive number, got 0
(fails (do-chamfer brick -1))     ; expect: do-chamfer: d must be a positive number, got -1
(fails (do-fillet 1 1))           ; expect: do-fillet: o must be a solid, got 1
(fails (do-fillet brick 1 #:edges 5)) ; expect: do-fillet: edges must be a selector, such as (edges-along 'z), or a list, got 5
(fails (do-fillet brick 1 #:edges (edges-along (vxyz 1 1 0)))) ; expect: do-fillet: edges selects no edge of o
(fails (do-fillet brick 1/4 #:edges (solid-edges plate (edges-of hole)))) ; expect: do-fillet: edges selects no edge of o
(fails (do-fillet (make-sphere origin 1) 1/4)) ; expect: do-fillet: edges selects no edge of o
(fails (do-fillet (make-cut-cone origin 2 (xyz 0 0 1) 1) 1/8))
; expect: do-fillet: the edge at (xyz -2 0 0) lies between curved faces; edges between planes, and circles around cylinders, can be worked
; sizes that coordinates cannot show
(fails (do-fillet brick 1e-300))  ; expect: do-fillet: r 1e-300 is too small for o: the least is 5.3851e-9
(fails (do-chamfer brick 1e-300)) ; expect: do-chamfer: d 1e-300 is too small for o: the least is 5.3851e-9
(fails (do-fillet brick 1e50))    ; expect: do-fillet: r 1e50 is too large at (xyz 2 0 0): the largest that fits there is 1.0
(fails (do-fillet brick 1e300))   ; expect: do-fillet: r is too large: lengths must stay below 1e60, got 1e300
; five digits of the largest size, of solids of any size
(fails (do-fillet (do-scale brick 1e-6) 1)) ; expect: do-fillet: r 1 is too large at (xyz 0.000002 0 0): the largest that fits there is 0.000001
