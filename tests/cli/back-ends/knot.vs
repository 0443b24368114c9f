(define-primitive knot r)
(register-drawing-function 'povray knot? (lambda (k) (make-sphere origin (knot-r k))))
(draw (make-knot 2))
