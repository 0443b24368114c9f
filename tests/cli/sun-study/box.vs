(draw (make-box (xyz 0 0 0) (xyz 10 8 6)))
