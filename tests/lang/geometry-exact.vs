; Solids that the mesh kernel combined wrongly once: each volume is held to what its parts have.
(define (ok? name got want [tol any? 1e-9]) (if (not (<= (abs (- got want)) (* tol (max 1 (abs want))))) (printf "~a: ~s, not ~s\n" name got want)))
; A sliver of a prism folds over itself on the kernel's grid: what lay beside the fold was taken for its inside.
(define sliver (do-extrude (make-polygon (xy 0.4 0.3) (xy 0.3420393 0.3116772) (xy 0.3152423 0.3169824) (xy 0.3 0.32) (xy -1.0 0.3) (xy -0.9793096 0.2371345) (xy -0.9896432 0.2185881) (xy -1.0 0.2)) 0.5))
(define block (subtract (make-box (xyz 0 0.5 0.75) 0.75 0.5 1.66) (make-box (xyz 0 0 -0.5) (xyz 3 2 0.4))))
(define turned (do-rotate block (make-axis (xyz 2.15 0.75 0.1) (vxyz 1 1 0)) (degrees->radians 30)))
(ok? "folded sliver" (volume (unite sliver turned)) (+ (volume sliver) (volume turned)) 1e-6)
(ok? "folded sliver and a box" (volume (unite sliver turned (make-box (xyz 0 1 2) 0.1 0.1 0.1))) (+ (volume sliver) (volume turned) 0.001) 1e-6)
(define sliver-2 (do-extrude (make-polygon (xy 0 0.3) (xy -0.9793096 0.2371345) (xy -0.9896432 0.2185881) (xy -1 0.2)) 0.5))
(define turned-2 (do-rotate block (vxyz 1 1 0) 0.5))
(ok? "second sliver" (volume (unite sliver-2 turned-2)) (- (+ (volume sliver-2) (volume turned-2)) (volume (intersect sliver-2 turned-2))) 1e-6)
; Large thin plates, turned: half a step of the grid was a part of their thickness, and what was taken off made them larger.
(define plate (do-rotate (make-box origin 300 300 0.05) (vxyz 1 2 3) 0.5))
(define post (make-box (xyz 0 0 0) 1 1 10))
(ok? "plate" (volume plate) 4500)
(ok? "plate less a post" (volume (subtract plate post)) (- 4500 (volume (intersect plate post))) 1e-12)
(ok? "plate less a post, in numbers" (volume (subtract plate post)) 4499.947714032)
; Shells: their thickness is a few steps.
(define inner (- 1 2e-8))
(ok? "shell of a box" (/ (volume (subtract (make-box origin 1 1 1) (make-box origin inner inner inner))) 6e-8) 1 1e-6)
(display "all as large as they should be") ; expect: all as large as they should be
