(draw (subtract (make-box (xyz 0 0 0) (xyz 4 4 4)) (make-sphere (xyz 4 4 4) 2.5) (make-cylinder (xyz 1 1 -1) 6 .5)))
(draw (make-circle (xyz 8 0 0) 2))
(draw (color "red" (do-move (make-sphere (xyz 0 0 4) 1) (vxyz 2 1 0))))
