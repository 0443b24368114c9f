(draw (unite (map (lambda (i) (make-sphere (xyz (* i 0.8131) 0 (* i i 0.013)) (+ 0.5 (* i 0.001)))) (iota 300))))
