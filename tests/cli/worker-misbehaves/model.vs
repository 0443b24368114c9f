(draw (unite (make-box (xyz 0 0 0) (xyz 1 2 3))
             (make-cylinder (xyz 5 0 0) 3 1)))
