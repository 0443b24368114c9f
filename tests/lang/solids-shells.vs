; Shells, offsets and drafts: closed forms, random convex solids.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (near-all? l m slack) (every (lambda (a b) (near? a b slack)) l m))
(define top (faces-towards 'z))
(define brick (make-box origin (xyz 4 3 2)))

; ---- shells ----
(displayln (map volume (list (do-shell brick 1/4) (do-shell brick 1/4 #:open top) (do-shell brick -1/4) (do-shell brick -1/4 #:open top))))
; expect: (10.875 8.6875 15.375 11.4375)
(displayln (volume (do-shell brick 1/4 #:open (any-of top (faces-towards (vxyz 0 0 -1))))))      ; expect: 6.5
(define L (do-extrude (make-polygon (xy 0 0) (xy 3 0) (xy 3 1) (xy 1 1) (xy 1 2) (xy 0 2)) 1))
(displayln (= (volume (do-shell L 1/8 #:open top)) (- 4 (* 7/8 (+ 4 -10/8 4/64)))))              ; expect: #t
(displayln (near? (volume (do-shell (make-sphere origin 2) 1/2)) (* 4/3 pi (- 8 27/8)) 0.1))     ; expect: #t
(displayln (near? (volume (do-shell (make-cylinder origin 3 2) 1/4 #:open top)) (* pi (- 12 (* 49/16 11/4))) 0.03)) ; expect: #t
(define plate (subtract (make-box origin (xyz 4 4 1)) (make-cylinder (xyz 2 2 -1) 3 1)))
(displayln (near? (volume (do-shell plate 1/4)) (- 16 pi (* 1/2 (- 49/4 (* pi 25/16)))) 5e-3))   ; expect: #t
(displayln (contains? (do-shell brick 1/4) (xyz 2 1.5 1)))                                       ; expect: #f
(displayln (length (decompose (do-shell brick 1/4))))                                            ; expect: 1

; ---- offsets: sharp and round, outwards and inwards ----
(displayln (map (lambda (d) (volume (do-offset-solid brick d #:join 'sharp))) '(1/4 -1/4)))      ; expect: (39.375 13.125)
(define (steiner a b c r) (+ (* a b c) (* 2 r (+ (* a b) (* b c) (* c a))) (* pi r r (+ a b c)) (* 4/3 pi r r r)))
(displayln (near? (volume (do-offset-solid brick 1/4)) (steiner 4 3 2 1/4) 2e-3))                ; expect: #t
(displayln (map volume (list (do-offset-solid L -1/8 #:join 'sharp) (do-offset-solid L 1/8 #:join 'sharp)))) ; expect: (2.109375 6.640625)
(displayln (near? (volume (do-offset-solid L -1/8)) (+ 2.109375 (* 3/4 1/64 (- 1 (/ pi 4)))) 1e-4)) ; expect: #t
; a convex polyhedron and its inner ball: a sharp offset is the polyhedron scaled
(define tetrahedron (make-pyramid origin 2 3 (xyz 0 0 3)))
(define inradius (/ (* 3 (volume tetrahedron)) (area tetrahedron)))
(displayln (near-all? (map (lambda (d) (volume (do-offset-solid tetrahedron d #:join 'sharp))) '(-1/4 1/4 1))
                      (map (lambda (d) (* (volume tetrahedron) (expt (+ 1 (/ d inradius)) 3))) '(-1/4 1/4 1)) 1e-5)) ; expect: #t
; random tetrahedra: out and in again
(random-seed! 5)
(define (random-tetrahedron) (hull (map (lambda (i) (xyz (random 4.0) (random 4.0) (random 4.0))) (iota 4))))
(define (back? i)
  (let* ((o (random-tetrahedron)) (there (do-offset-solid o 0.05 #:join 'sharp)))
    (and (> (volume there) (volume o)) (near? (volume (do-offset-solid there -0.05 #:join 'sharp)) (volume o) 1e-4))))
(displayln (every back? (iota 15)))                                                              ; expect: #t

; ---- drafts: the frustum of a box and of a pyramid ----
(define (prismatoid a b h k) ; a box of base a x b that loses k on every side at the height h
  (* h 1/6 (+ (* a b) (* (- a k k) (- b k k)) (* 4 (- a k) (- b k)))))
(define (lean degrees) (* 2 (tan (degrees->radians degrees))))
(displayln (near? (volume (do-draft brick (degrees->radians 5) 'xy)) (prismatoid 4 3 2 (lean 5)) 1e-6))      ; expect: #t
(displayln (near? (volume (do-draft brick (degrees->radians -5) 'xy)) (prismatoid 4 3 2 (- (lean 5))) 1e-6)) ; expect: #t
(displayln (near? (volume (do-draft brick (degrees->radians 5) 'xy #:faces (faces-towards 'x))) (- 24 (* 3 (lean 5))) 1e-6)) ; expect: #t
(define frustum (make-pyramid origin (* 3 (sqrt 2)) 4 (xyz 0 0 2) (* 2 (sqrt 2)))) ; squares of 6 and 4
(define steeper (tan (+ (atan 1/2) (degrees->radians 5))))
(displayln (near? (volume (do-draft frustum (degrees->radians 5) 'xy)) (prismatoid 6 6 2 (* 2 steeper)) 1e-5)) ; expect: #t

; ---- the largest, and bad arguments ----
(fails (do-shell brick 1.25))              ; expect: do-shell: t 1.25 is too large at (xyz 0 0 1): the largest that fits there is 1.0
(fails (do-shell brick 0))                 ; expect: do-shell: t must not be 0
(fails (do-shell brick 'thick))            ; expect: do-shell: t must be a number and finite, got thick
(fails (do-shell brick 1/4 #:open 5))      ; expect: do-shell: open must be a selector, such as (edges-along 'z), or a list, got 5
(fails (do-shell brick 1/4 #:open (faces-towards (vxyz 1 1 0)))) ; expect: do-shell: open selects no face of o
(fails (do-offset-solid brick -2 #:join 'sharp)) ; expect: do-offset-solid: d -2 is too large at (xyz 0 1.5 0): the largest that fits there is 1.0
(fails (do-offset-solid brick 1 #:join 'mitre)) ; expect: do-offset-solid: join must be 'round or 'sharp, got mitre
(fails (do-offset-solid 5 1))              ; expect: do-offset-solid: o must be a solid, got 5
(fails (do-draft brick 2 'xy))             ; expect: do-draft: angle must be between -pi/2 and pi/2, got 2
(fails (do-draft brick 0.7 'xy))           ; expect: do-draft: angle 0.7 is too large at (xyz 0 1.5 2): the largest that fits there is 0.6435
(fails (do-draft brick 0.1 'xy #:faces top)) ; expect: do-draft: the face at (xyz 2 1.5 2) is curved, or parallel to the plane, and cannot be drafted
(fails (do-draft brick 0.1 5))             ; expect: do-draft: plane must be a plane ('xy, 'yz, 'xz, a gvector or (make-plane point normal)), got 5
(fails (do-draft (make-sphere origin 1) 0.1 'xy)) ; expect: do-draft: faces selects no face of o
(fails (do-shell (make-irregular-pyramid (list (xy 0 0) (xy 4 0) (xy 3 2) (xy 0 1)) (xyz 1 1 2)) 0.1))
; expect: do-shell: the faces that meet at (xyz 1 1 2) do not meet in one point when they are moved
; sizes far from that of the solid
(fails (do-shell brick 1e-300))            ; expect: do-shell: t 1e-300 is too small for o: the least is 5.3851e-9
(fails (do-shell brick 1e50))              ; expect: do-shell: t 1e50 is too large at (xyz 2 0 0): the largest that fits there is 1.0
(fails (do-shell brick -1e50))             ; expect: do-shell: t -1e50 is too large for o: the most is 5385100000.0
(fails (do-offset-solid brick 1e-300))     ; expect: do-offset-solid: d 1e-300 is too small for o: the least is 5.3851e-9
(fails (do-offset-solid brick 1e300))      ; expect: do-offset-solid: d is too large: lengths must stay below 1e60, got 1e300
; nothing remains inside: the empty object, with a warning
(displayln (empty-object? (do-offset-solid brick -1)))                                           ; expect: #t
; expect warning 75: do-offset-solid: nothing of o remains inside of the distance 1 (the empty object)
(displayln (empty-object? (do-offset-solid brick -1 #:join 'sharp)))                             ; expect: #t
; expect warning 77: do-offset-solid: nothing of o remains inside of the distance 1 (the empty object)
(displayln (empty-object? (do-offset-solid (unite (make-box origin 1 1 1) (make-box (xyz 5 0 0) (xyz 6 1 1))) -1/2))) ; expect: #t
; expect warning 79: do-offset-solid: nothing of o remains inside of the distance 1/2 (the empty object)
