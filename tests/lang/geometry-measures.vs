; measures: by formula where there is one, else of the mesh
(define (about x y) (displayln (near? x y (* 1e-9 (abs y)))))
(displayln (volume (make-box origin (xyz 1 2 3))))          ; expect: 6.0
(displayln (area (make-box origin (xyz 1 2 3))))            ; expect: 22.0
(displayln (centroid (make-box origin (xyz 1 2 3))))        ; expect: (xyz 0.5 1 1.5)
(about (volume (make-sphere origin 2)) (* 32/3 pi))         ; expect: #t
(about (volume (scale (make-sphere origin 1) '(1 2 3))) (* 8 pi)) ; expect: #t
(about (curve-length (make-circle origin 2)) (* 4 pi))      ; expect: #t
(displayln (curve-length (make-line origin (xyz 3 0 0) (xyz 3 4 0)))) ; expect: 7.0
(about (area (make-region (make-circle origin 2))) (* 4 pi)) ; expect: #t
(define u (unite (make-box origin (xyz 2 2 2)) (make-box (xyz 1 1 1) (xyz 3 3 3))))
(displayln (list (volume u) (area u)))                      ; expect: (15.0 42.0)
(displayln (volume (subtract (make-box origin (xyz 2 2 2)) (make-box (xyz 1 1 1) (xyz 3 3 3))))) ; expect: 7.0
(displayln (volume (do-extrude (make-rectangle origin (xyz 2 3 0)) 4))) ; expect: 24.0
(displayln (volume (empty-object)))                         ; expect: 0.0
(displayln (list (bounding-box (rotate (make-box origin (xyz 1 2 3)) 'z pi/2)))) ; expect: (((xyz -2 0 0) (xyz 0 1 3)))
(volume (make-circle origin 1)) ; expect error: volume: o must be a solid, got (make-circle (xyz 0 0 0) 1)
