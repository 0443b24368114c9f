; A street by rules with at least as many instances and triangles as the scenes of Krecklau, Pavic and Kobbelt (2010), table 1. -D scene=1: 11,035
; instances of 276,226 triangles; 2: 58,653 of 1,346,280; 3: 281,607 of 6,914,247; 4: 556,629 of 3,114,704. A part is a box in a facade, or a ball (a
; bunch of leaves) in scenes 1 to 3, whose triangles an instance are what theirs are.
(define-parameter scene 1 #:choices '(1 2 3 4))
(define-parameter times 1 #:min 1) ; as many instances: what one more costs
(define wanted (* times (list-ref '(11035 58653 281607 556629) (- scene 1))))
(define stone (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define ball (make-sphere origin 0.5 #:segments 8))
(define-rule (street [self box-scope?]) [(=> (scope-repeat 'x 12 house))])
(define-rule (house [self box-scope?]) [(=> (scope-repeat 'y 3 storey))])
(define-rule (storey [self box-scope?]) [(=> (scope-repeat 'x 2 bay))])
(define-rule (bay [self box-scope?])
  [#:when (< scene 4) (=> (scope-split 'x (absolute 0.3 stone) (rest opening) (absolute 0.3 ball)))]
  [(=> (scope-split 'x (absolute 0.3 stone) (rest opening) (absolute 0.3 stone)))])
(define-rule (opening [self box-scope?])
  [(=> (scope-split 'y (absolute 0.8 stone) (rest #f) (absolute 0.4 ball)))])
; a house of 12 by 15 has five storeys of six bays of four instances
(draw (street (make-box-scope origin (* 12 (ceiling (/ wanted 120))) 15 0.4)))
