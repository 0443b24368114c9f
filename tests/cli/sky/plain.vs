(draw (with-material 'glass (make-box origin (xyz 1 1 1))))
(draw (with-material 'frosted-glass (make-box (xyz 2 0 0) (xyz 3 1 1))))
(ground 0)
