(draw (let loop ([i 0] [o (empty-object)])
        (if (= i 200000)
            o
            (loop (+ i 1) (unite o (make-box (xyz (* 2 (modulo i 500)) (* 2 (quotient i 500)) 0)
                                             (xyz (+ 1 (* 2 (modulo i 500))) (+ 1 (* 2 (quotient i 500))) 1)))))))
