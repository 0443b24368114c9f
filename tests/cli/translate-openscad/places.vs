; Placements: each kind once, on the same shape.
(define part (subtract (make-box (xyz 0 0 0) (xyz 30 20 10)) (make-cylinder (xyz 10 10 -1) (xyz 14 10 12) 4)))
(draw part)
(draw (do-rotate (do-move part (vxyz 60 0 0)) 'x pi/2))
(draw (do-rotate part (xyz 0 60 0) (vxyz 1 1 1) (degrees->radians 40)))
(draw (do-scale (do-mirror (do-move part (vxyz 50 50 40)) 'yz) 1.5))
(draw (do-move (hull part (make-sphere (xyz 15 10 40) 8)) (vxyz 0 -100 0)))
(draw (do-rotate (make-cut-cone (xyz 100 100 0) 20 (xyz 120 90 40) 10) (vxyz 0 1 1) 0.3))
