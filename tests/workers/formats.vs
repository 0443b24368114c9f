; One of everything that the mesh and scene formats must carry, all apart, so that volumes add up: colours, layers, copies, a mirror, a shear,
; a boolean in two materials, a letter-like region and a curve (which solids' formats leave out).
(units 'mm)
(define (post p) (unite (make-cylinder p 3 .25) (color "#d04020" (make-sphere (+z p 3.5) .4))))
(draw (layer "posts" (map (lambda (x) (post (xy (* 2 x) 0))) (iota 4))))
(draw (layer "blocks \"A & B\"" (do-rotate (make-box (xyz 0 4 0) 1 2 3) 'z .3)))
(draw (do-mirror (make-wedge (xyz 2 6 0) (xyz 4 7 2)) 'yz))
(draw (do-transform (make-box (xyz 0 0 0) (xyz 1 1 1)) (make-matrix 1 .5 0 6  0 1 0 4  0 0 1 0  0 0 0 1)))
(draw (subtract (with-material copper (make-box (xyz 10 0 0) (xyz 12 2 2))) (with-material glass (make-sphere (xyz 11 1 2) .8))))
(draw (do-scale (make-cone (xyz 14 0 0) (xyz 15 1 2) .5) (xyz 14 0 0) '(2 1 1)))
