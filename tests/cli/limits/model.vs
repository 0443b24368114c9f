(define (pile o) (pile (unite o (make-box (xyz 0 0 0) (xyz 1 1 1)))))
(pile (make-box (xyz 0 0 0) (xyz 1 1 1)))
