; a solid, and one of each class of thing that is none
(draw (make-box origin (xyz 1 1 1))
      (make-3dface (xyz 2 0 0) (xyz 3 0 0) (xyz 3 1 0) (xyz 2 1 1))
      (make-surface (lambda (u v) (xyz (* 2 u) (* 2 v) (+ 2 (* u v)))) #:nu 2 #:nv 2)
      (make-mesh (list (list (xyz 0 4 0) (xyz 1 4 0)) (list (xyz 0 5 0) (xyz 1 5 1))))
      (make-line (xyz 0 0 0) (xyz 5 5 5))
      (make-region (make-rectangle (xy 4 0) (xy 5 1)))
      (make-xline (xyz 0 0 0) (xyz 1 1 0))
      (make-ray (xyz 0 0 0) uz))
