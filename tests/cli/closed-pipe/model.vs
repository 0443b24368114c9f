(for-each (lambda (i) (draw (make-sphere (xyz (* 3 i) 0 0) 1))) (iota 40))
(draw (native 'openscad "cube(1);"))
