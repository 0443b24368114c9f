; Figure 5.5 of the VisualScheme thesis: the prototype side by side, as listing 5.5 distributes it in space.
;
; examples/gare-do-oriente.vs is the same station with materials, platforms and everything a parameter.

(require "gare.vs")

(define-parameter x 3 #:min 1 #:max 20 #:label "trees along X")
(define-parameter y 2 #:min 1 #:max 20 #:label "trees along Y")

(draw (gare x y))
(units 'm)
