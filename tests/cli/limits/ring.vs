(draw (make-torus (xyz 0 0 0) 2 1))
