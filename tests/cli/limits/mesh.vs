(draw (subtract (make-sphere (xyz 0 0 0) 10 #:segments 1200) (make-torus (xyz 0 0 3) 8 3 #:segments 1200)))
