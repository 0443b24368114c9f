(draw (make-box origin (xyz 1 2 3)) (make-box (xyz 5 0 0) (xyz 6 2 3)) (color "red" (make-sphere (xyz 9 9 9) 1)))
