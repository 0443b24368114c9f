; too much to be worked out for a line
(draw (subtract (make-box origin (xyz 100 10 10))
                (map (lambda (i) (make-box (xyz i -1 5) (xyz (+ i 1/2) 11 11))) (iota 1000))))
