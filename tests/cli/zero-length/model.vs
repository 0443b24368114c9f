; a zero length in a sweep of parameters is empty, warns once, and the rest goes on
(define (rod p q) (make-cylinder p q 0.2))
(draw (unite (map rod
                  (line-sequence (xyz 0 0 0) (xyz 5 0 0) 6)
                  (line-sequence (xyz 0 0 0) (xyz 0 5 0) 6))))
