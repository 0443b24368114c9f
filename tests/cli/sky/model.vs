(draw (make-sphere origin 1))
(sky #:image "sky \"1\".png" #:color "navy")
