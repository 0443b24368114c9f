; Figure 5.4 of the VisualScheme thesis: the prototype tree of the Gare do Oriente with other angles.
;
; psi0 and psi1 are the zenith angles that the beams cover: psi0 where they carry the roof, psi1 at the ground. At pi/2 the four beams meet at one
; point of the ground. Past it they go on below their point of contact, and stand on four feet.

(require "gare.vs")

(define (tree x psi0 psi1)
  (draw (beams-and-roof (xyz x 0 0) 20 psi0 psi1 30 1 3 10)))

(tree 0 pi/8 pi/2)             ; as in figure 5.5
(tree 32 pi/8 (* 5/8 pi))      ; figure 5.4 (b): more of the arc
(tree 64 pi/4 (* 3/4 pi))      ; a lower arc: narrow above, wide below

(units 'm)
(ground 0)
(sun #:azimuth 215 #:altitude 40)
(camera (xyz 30 -88 15) (xyz 30 0 11) #:lens 30)
