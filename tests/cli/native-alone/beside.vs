(draw (make-box origin (xyz 1 1 1)))
(draw (native 'povray "sphere { 0, 1 }"))
(draw (native 'povray "sphere { 2, 1 }" #:otherwise (make-sphere (xyz 2 2 2) 1)))
