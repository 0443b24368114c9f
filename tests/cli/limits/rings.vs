;; Ten thousand rings, no two of one size: some ten million triangles.
(for ([i 10000]) (draw (make-torus (xy (* 3 (modulo i 100)) (* 3 (quotient i 100))) (+ 0.9 (* 0.00001 i)) 0.2)))
