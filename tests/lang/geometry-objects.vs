; objects: how they print, what they are, equality by value, what collapses
(define (show x) (displayln x) (empty-object))
(define a (make-box (xyz 1 2 3) origin))
(show a)                                               ; expect: (make-box (xyz 0 0 0) (xyz 1 2 3))
(show (make-box origin 2 4 6))                         ; expect: (make-box (xyz -1 -2 -3) (xyz 1 2 3))
(show (make-sphere origin 1 #:segments 16))            ; expect: (make-sphere (xyz 0 0 0) 1 #:segments 16)
(show (make-cylinder origin 3 1))                      ; expect: (make-cylinder (xyz 0 0 0) (xyz 0 0 3) 1)
(show (cylinder-from-to origin (xyz 1 0 0) 1/2))       ; expect: (make-cylinder (xyz 0 0 0) (xyz 1 0 0) 0.5)
(show (make-cone origin (xyz 0 0 2) 1))                ; expect: (make-cone (xyz 0 0 0) (xyz 0 0 2) 1)
(show (make-cut-cone origin 2 (xyz 0 0 1) 1))          ; expect: (make-cut-cone (xyz 0 0 0) 2 (xyz 0 0 1) 1)
(show (make-pyramid origin 1 4 (xyz 0 0 1)))           ; expect: (make-pyramid (xyz 0 0 0) 1 4 (xyz 0 0 1) 0)
(show (make-torus origin 3 1))                         ; expect: (make-torus (xyz 0 0 0) 3 1)
(show (make-wedge origin (xyz 1 1 1)))                 ; expect: (make-wedge (xyz 0 0 0) (xyz 1 1 1))
(show (make-line (list origin (xyz 1 0 0)) (xyz 1 1 0))) ; expect: (make-line (list (xyz 0 0 0) (xyz 1 0 0) (xyz 1 1 0)))
(show (make-line origin (xyz 1 0 0) (xyz 1 1 0) origin)) ; expect: (make-polygon (list (xyz 0 0 0) (xyz 1 0 0) (xyz 1 1 0)))
(show (make-rectangle origin (xyz 2 1 0)))             ; expect: (make-polygon (list (xyz 0 0 0) (xyz 2 0 0) (xyz 2 1 0) (xyz 0 1 0)))
(show (make-arc origin 1 0 pi))                        ; expect: (make-arc (xyz 0 0 0) 1 0 3.141592653589793)
(show (make-arc origin 1 2pi))                         ; expect: (make-circle (xyz 0 0 0) 1)
(show (make-spline origin (xyz 1 0 0) (xyz 1 1 1)))    ; expect: (make-spline (list (xyz 0 0 0) (xyz 1 0 0) (xyz 1 1 1)))
(show (make-spline (list origin (xyz 1 0 0)) uz -pi/2)) ; expect: (make-spline (list (xyz 0 0 0) (xyz 1 0 0)) (vxyz 0 0 1) (vxyz 0 -1 0))
(show (make-region (make-circle origin 2) (make-circle origin 1))) ; expect: (make-region (make-circle (xyz 0 0 0) 2) (make-circle (xyz 0 0 0) 1))
(show (make-donut origin 1 2))                         ; expect: (make-region (make-circle (xyz 0 0 0) 2) (make-circle (xyz 0 0 0) 1))
(show (make-polyface-mesh (list origin (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) '((1 3 2) (1 2 4) (2 3 4) (3 1 4)))) ; expect: (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) '((1 3 2) (1 2 4) (2 3 4) (3 1 4)))
; operations
(define s (make-sphere origin 1))
(show (unite a s))                                     ; expect: (unite (make-box (xyz 0 0 0) (xyz 1 2 3)) (make-sphere (xyz 0 0 0) 1))
(show (unite (list a (list s)) '()))                   ; expect: (unite (make-box (xyz 0 0 0) (xyz 1 2 3)) (make-sphere (xyz 0 0 0) 1))
(show (unite a))                                       ; expect: (make-box (xyz 0 0 0) (xyz 1 2 3))
(show (unite))                                         ; expect: (empty-object)
(show (subtract a s))                                  ; expect: (subtract (make-box (xyz 0 0 0) (xyz 1 2 3)) (make-sphere (xyz 0 0 0) 1))
(show ((subtract a) s))                                ; expect: (subtract (make-box (xyz 0 0 0) (xyz 1 2 3)) (make-sphere (xyz 0 0 0) 1))
(show (subtract a '()))                                ; expect: (make-box (xyz 0 0 0) (xyz 1 2 3))
(show (procedure? (subtract a)))                       ; expect: #t
(show (intersect a s))                                 ; expect: (intersect (make-box (xyz 0 0 0) (xyz 1 2 3)) (make-sphere (xyz 0 0 0) 1))
(show (do-move s (vxyz 1 2 3)))                        ; expect: (do-move (make-sphere (xyz 0 0 0) 1) (vxyz 1 2 3))
(show (equal? (translate s ux) (do-move s (vxyz 1 0 0)))) ; expect: #t
(show (rotate s 'z pi/2))                              ; expect: (do-transform (make-sphere (xyz 0 0 0) 1) (make-matrix 0 -1 0 0 1 0 0 0 0 0 1 0 0 0 0 1))
(show (equal? (rotate s 'z pi) (do-rotate s origin uz pi))) ; expect: #t
(show (scale s 2))                                     ; expect: (do-transform (make-sphere (xyz 0 0 0) 1) (make-matrix 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1))
(show (equal? (scale s origin '(1 2 3)) (scale s (vxyz 1 2 3)))) ; expect: #t
(show (do-mirror s 'yz))                                  ; expect: (do-transform (make-sphere (xyz 0 0 0) 1) (make-matrix -1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1))
(show (do-extrude (make-circle origin 1) 4))           ; expect: (do-extrude (make-circle (xyz 0 0 0) 1) 4)
(show (do-extrude (make-circle origin 1) (vxyz 1 0 4) #:twist 1)) ; expect: (do-extrude (make-circle (xyz 0 0 0) 1) (vxyz 1 0 4) #:twist 1)
(show (do-sweep (make-circle origin 1) (make-line origin (xyz 0 0 5)) 0 1/2)) ; expect: (do-sweep (make-circle (xyz 0 0 0) 1) (make-line (list (xyz 0 0 0) (xyz 0 0 5))) 0 0.5)
(show (do-thicken (make-line origin (xyz 0 0 5)) 1/4)) ; expect: (do-thicken (make-line (list (xyz 0 0 0) (xyz 0 0 5))) 0.25)
; what things are
(define (kinds . objects)
  (map (lambda (o) (list (object-kind o) (curve? o) (region? o) (surface? o) (solid? o) (primitive? o) (csg? o) (operation? o))) objects))
(for-each displayln (kinds a (make-circle origin 1) (unite a s) (do-extrude (make-circle origin 1) 1)))
; expect: (box #f #f #f #t #t #f #f)
; expect: (circle #t #f #f #f #t #f #f)
; expect: (unite #f #f #f #t #f #t #t)
; expect: (extrude #f #f #f #t #f #f #t)
(show (list (object? a) (object? 5) (empty-object? (empty-object)) (empty-object? a))) ; expect: (#t #f #t #f)
(show (object-arguments a))                            ; expect: ((xyz 0 0 0) (xyz 1 2 3))
(show (object-children (unite a s)))                   ; expect: ((make-box (xyz 0 0 0) (xyz 1 2 3)) (make-sphere (xyz 0 0 0) 1))
(show (object-count (unite a (unite s s) (subtract a s)))) ; expect: 4
(show (bounding-box a))                                ; expect: ((xyz 0 0 0) (xyz 1 2 3))
(show (bounding-box (empty-object)))                   ; expect: #f
(show (list (contains? s origin) (contains? s (xyz 2 0 0)) (contains? (subtract a s) (xyz 0.1 0.1 0.1)))) ; expect: (#t #f #f)
(show (equal? (unite a (make-sphere origin 1)) (unite (make-box origin (xyz 1 2 3)) s))) ; expect: #t
(define table (make-hash))
(hash-set! table a 'found)
(show (hash-ref table (make-box origin (xyz 1 2 3)) #f)) ; expect: found
; a lattice: the first cell has these corners
(show (bounding-box (distribute-in-space (lambda (c) (make-box c 1 1 1)) origin (xyz 2 2 2) 3 2 1))) ; expect: ((xyz 0.5 0.5 0.5) (xyz 5.5 3.5 1.5))
; collapse: empty, and said
(show (make-cylinder origin origin 1))                 ; expect warning: make-cylinder: c1 and c2 are the same point
; expect: (empty-object)
(show (make-box origin (xyz 1 1 0)))                   ; expect warning: make-box: a box without width, depth or height
; expect: (empty-object)
(show (unite (do-extrude (make-circle origin 1) 0) s)) ; expect warning: do-extrude: the amount is 0
; expect: (unite (empty-object) (make-sphere (xyz 0 0 0) 1))
(for-each (lambda (r) (make-sphere origin r)) '(0 0 0)) ; expect warning: make-sphere: r is 0
