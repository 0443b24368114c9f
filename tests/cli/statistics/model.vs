(define-parameter floors 4)
(define (storey z) (subtract (make-box (xyz 0 0 z) (xyz 4 3 (+ z 2))) (make-cylinder (xyz 2 1.5 (- z 0.25)) 2.5 1)))
(for ([i (in-range floors)]) (draw (storey (* 3 i))))
