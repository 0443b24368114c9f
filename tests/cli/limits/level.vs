;; A surface of some hundred thousand triangles, made while the program runs.
(define-function (ball x y z) (- (+ (* x x) (* y y) (* z z)) 1))
(draw (make-isosurface ball (xyz -2 -2 -2) (xyz 2 2 2) #:cells 160))
