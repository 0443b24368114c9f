(draw (make-sphere origin 9))
(draw (do-move (color "red" (unite (make-box origin (xyz 1 1 1)) (only (make-sphere (xyz 3 0 0) 1)))) (vxyz 0 0 5)))
