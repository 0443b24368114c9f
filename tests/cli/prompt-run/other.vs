(define secret (random 1000000))
(draw (make-box (xyz 0 0 0) (xyz 1 2 3)))
