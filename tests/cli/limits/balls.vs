;; Balls that overlap: some twenty thousand triangles before they are united.
(draw (unite (for/list ([i 40]) (make-sphere (xy (* 0.7 i) (* 0.3 (modulo i 3))) 1))))
