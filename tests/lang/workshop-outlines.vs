; outlines: of regions, sections, flat surfaces and closed curves; lengths and areas against formulas; what is refused
(define (close? a b) (< (abs (- a b)) 1e-6))

; every kind of region: the outline encloses its area
(define square (make-region (make-rectangle origin (xy 4 3))))
(define dot (make-region (make-circle (xy 2 1.5) 1)))
(define turned (rotation-matrix (make-axis (xyz 1 2 3) (vxyz 1 1 0)) 1))
(define regions
  (list square dot (make-donut origin 2 1) (subtract square dot) (unite square (do-move dot (vxyz 2 0 0)))
        (intersect square dot) (do-offset square 1) (do-offset square 1 #:corners 'round) (hull (xy 0 0) (xy 4 0) (xy 1 3))
        (make-text origin 3 "AoB8")
        (do-section (make-box origin (xyz 2 3 4)) (make-plane (xyz 0 0 1) uz))
        (do-section (subtract (make-box origin (xyz 4 4 4)) (make-cylinder (xyz 2 2 -1) 9 1)) (make-plane (xyz 0 0 1) (vxyz 1 0 2)))
        (do-project (make-sphere origin 2) 'xy)
        (layer "cut" (with-material 'oak square)) (do-transform (subtract square dot) turned)
        (make-region (make-rectangle origin (xy 9 9)) (make-rectangle (xy 1 1) (xy 8 8)) (make-rectangle (xy 2 2) (xy 7 7)))))
(define (same-area? region)
  (let ((curves (outline region)))
    (and (every curve? curves) (near? (/ (area (apply make-region curves)) (area region)) 1 1e-3))))
(displayln (map same-area? regions))
; expect: (#t #t #t #t #t #t #t #t #t #t #t #t #t #t #t #t)

; outer ones before holes, although each hole follows its own outer curve within the region
(define two (unite (make-donut origin 2 1) (make-donut (xy 10 0) 3 2)))
(displayln (map (lambda (c) (round (/ (curve-length c) pi))) (outline two)))
; expect: (4.0 6.0 2.0 4.0)
(displayln (map (lambda (c) (round (/ (curve-length c) pi))) (outline (make-region (make-circle origin 1) (make-circle origin 2)))))
; expect: (4.0 2.0)

; the curves themselves, in place and in their layer
(displayln (outline (do-move (make-region (make-circle (xy 5 3) 1)) (vxyz 0 0 3))))
; expect: ((do-move (make-circle (xyz 5 3 0) 1) (vxyz 0 0 3)))
(displayln (outline (layer "cut" (make-region (make-circle (xy 5 3) 1)))))
; expect: ((layer "cut" (make-circle (xyz 5 3 0) 1)))

; flat surfaces, wherever they lie, of one part or several
(define (flat o) (list (length (outline o)) (close? (apply + (map area (outline o))) (area o))))
(displayln (list (flat (make-3dface (xy 0 0) (xy 1 0) (xy 1 1) (xy 0 1)))
                 (flat (make-surface (lambda (u v) (xyz u (* 2 v) (+ u v))) #:nu 5 #:nv 3))
                 (flat (do-transform (make-3dface (xy 0 0) (xy 4 0) (xy 4 1) (xy 0 1)) turned))
                 (flat (unite (make-3dface (xy 0 0) (xy 1 0) (xy 1 1) (xy 0 1)) (make-3dface (xy 1 0) (xy 1 1) (xy 2 1) (xy 2 0))))
                 (flat (unite (make-3dface (xy 0 0) (xy 1 0) (xy 1 1) (xy 0 1)) (make-3dface (xy 3 0) (xy 4 0) (xy 4 1) (xy 3 1))))))
; expect: ((1 #t) (1 #t) (1 #t) (1 #t) (2 #t))

; a closed curve counts as filled; nothing has no outline
(displayln (list (outline (make-circle origin 2)) (outline (empty-object)) (length (outline (list (make-circle origin 1) (make-circle (xy 5 0) 1))))))
; expect: (((make-circle (xyz 0 0 0) 2)) () 2)

; do-edges of a region is its outline
(displayln (list (curve-length (do-edges square)) (close? (curve-length (do-edges (make-donut origin 2 1))) (* 6 pi))
                 (object? (do-edges (make-donut origin 2 1)))))
; expect: (14.0 #t #t)

(define (message thunk) (displayln (guard (e (#t (error-object-message e))) (thunk) "accepted")))
(message (lambda () (outline (make-box origin (xyz 1 1 1)))))
; expect: outline: o must be a region, a flat surface or closed curves (outline (do-section o plane)?), got
(message (lambda () (outline (make-line origin (xy 1 1)))))
; expect: outline: o must be a region, a flat surface or closed curves, got
(message (lambda () (outline (make-surface (lambda (u v) (xyz u v (* u v)))))))
; expect: outline: the surface is not flat: it leaves a plane by 0.57735
(message (lambda () (outline (make-polygon origin (xy 1 1) (xy 1 0) (xy 0 1)))))
; expect: outline: a closed curve that is taken as filled must not cross itself; it does at (xyz 0.5 0.5 0)
(outline (make-ray origin ux)) ; expect error: outline: o must be a region, a flat surface or closed curves, got
