(draw (subtract (make-box origin 3.25 2.5 1) (make-cylinder (xyz 0 0 -2) 4 1/3))
      (color "#8040c0" (do-move (make-sphere origin 1.125) (vxyz 0 0 2.75)))
      (do-extrude (make-text (xyz 3 0 0) 1.5 "1,5 Ä") 0.5))
(displayln (list 1/3 0.5 1e21 (sqrt 2) (string->number "1.5") (string->number "1,5")))
