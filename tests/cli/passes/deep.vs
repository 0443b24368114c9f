(draw (let loop ((i 0) (o (make-sphere (xyz 0 0 0) 1))) (if (= i 50000) o (loop (+ i 1) (unite o (make-sphere (xyz i 0 0) 1))))))
