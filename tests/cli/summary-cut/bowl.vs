; a bowl that is cut at z = 0
(draw (subtract (make-sphere origin 2.2) (make-sphere origin 2) (make-box (xyz -3 -3 0) (xyz 3 3 3))))
