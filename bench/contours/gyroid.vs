; A gyroid in a box, closed at its sides: `sh bench/contours/run.sh build/vs build/measure` measures it beside other programs.
(define-parameter cells 128 #:min 2 #:max 1024)
(define-function (gyroid-value x y z) (+ (* (sin x) (cos y)) (* (sin y) (cos z)) (* (sin z) (cos x))))
(define solid (make-isosurface gyroid-value origin (xyz 2pi 2pi 2pi) #:cells cells))
(printf "~a ~a\n" (length (second (object-arguments solid))) (volume solid))
