; A model that a test uses as a part: what it draws, and nothing that stages a drawing.
(define-parameter reach 2.0 #:min 1 #:max 5)
(define-parameter lit #f)
(define-parameter shade "round" #:choices '("round" "square"))
(draw (make-box origin (xyz 1 1 reach)))
(if lit (draw (make-box (xyz 5 0 0) (xyz 6 1 1))))
(camera (xyz 1 1 1) origin #:lens 20)
(ground -7)
(sun #:azimuth 10 #:altitude 20)
