(define (shape h) (make-box (xyz 0 0 0) (xyz 1 1 h)))
