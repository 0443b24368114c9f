(define-parameter n 4 #:min 1 #:max 100)
(define-parameter r 1.2 #:label "radius of the hole, metres")
(define (part i) (subtract (make-box (xyz (* 10 i) 0 0) (xyz (+ (* 10 i) 5 (* i 0.01)) 5 5)) (make-sphere (xyz (* 10 i) 0 0) (if (= i 2) r 2))))
(for ([i (in-range n)]) (draw (part i)))
