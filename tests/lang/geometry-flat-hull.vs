; A flat hull that holds a surface is that of the surface's corners, wherever a profile is taken.
(define s (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 0 0) (xyz 1 1 0) (xyz 0 1 0)) '((1 2 3) (1 3 4))))
(define h (hull s (make-line (list (xyz 3 0 0) (xyz 3 1 0)))))
(displayln (list (contains? h (xyz 2 0.5 0)) (contains? h (xyz 2 3 0)))) ; expect: (#t #f)
(displayln (volume (do-extrude h 2))) ; expect: 6.0
