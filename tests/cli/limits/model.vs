(define (pile o box) (pile (unite o box) box))
(pile (make-box (xyz 0 0 0) (xyz 1 1 1)) (make-box (xyz 0 0 0) (xyz 1 1 1)))
