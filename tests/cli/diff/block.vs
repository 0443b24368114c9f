(draw (subtract (make-box (xyz 0 0 0) (xyz 4 4 4)) (make-sphere (xyz 4 4 4) 2)))
(draw (make-circle (xyz 8 0 0) 1))
