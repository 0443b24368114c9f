(draw (make-box origin (xyz 4 3 2)))
(view "street" #:from (xyz -6 -14 1.6) #:to (xyz 2 1 1))
(view "x-ray" 'front #:hidden #t)
