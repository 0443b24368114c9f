;; Two layers of bars across each other: the crossings make the triangles, some 600,000.
(draw (unite (for/list ([i 150]) (make-box (xyz 0 (* 2 i) 0) 300 1 1)) (for/list ([i 150]) (make-box (xyz (* 2 i) 0 0.25) 1 300 1))))
