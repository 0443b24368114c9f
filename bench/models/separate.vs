; count * count cylinders, each made where it stands: nothing is said to be a copy.
(define-parameter count 50)
(draw (unite (for*/list ([j (in-range count)] [i (in-range count)])
               (make-cylinder (xyz (* 3 i) (* 3 j) 0) 2 1))))
