(define storey 3)
; A wall of the house at p.
(define (wall p unused)
  (make-bx p 4   0.3 storey))
(draw (wall (xyz 0 0 0) 1))
