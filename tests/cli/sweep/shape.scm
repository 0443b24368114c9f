(define (shape n x) (make-box (xyz 0 0 0) n 1 (+ 1 x)))
