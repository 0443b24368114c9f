(display "talking\n") (make-box (xyz 0 0 0) (xyz 1 2 3))
