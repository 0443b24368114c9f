(draw (make-sphere origin 1))
(sky #:turbidity 3)
(sun #:azimuth 250 #:altitude 12.5)
