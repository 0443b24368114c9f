; Two boxes with layers and materials of their own in a limb that bends and twists: the coarse boxes are subdivided.
(define cube (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define two (unite (layer "bark" (color "red" cube)) (layer "leaf" (color "blue" (do-move cube (vxyz 0 0 1))))))
(define-rule (limb [self turtle-scope?])
  [(=> (turtle-back) (turtle-forward 2) (turtle-yaw 0.5) (turtle-roll 0.6) (turtle-front two))])
(draw (limb (make-turtle-scope origin ux uz 3 2)))
