(define-parameter n 100)
(for ([i n]) (draw (make-cylinder (xyz (* 3 (modulo i 200)) (* 3 (quotient i 200)) 0) 2 (+ 1 (* 0.00001 i)))))
(draw (make-cylinder (xyz 0 0 900) 100 200))
