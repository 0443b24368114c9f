; Four trees of one template: with leaves, with apples, with pears, in blossom. After figures 23 and 24 of Krecklau, Pavic and Kobbelt
; (2010); the rules are our own.
;
; What it teaches: a template with two rules among its parameters (trees.vs); four calls make four kinds of tree.
;
;   vs four-trees.vs -o trees.png
(require "trees.vs")
(draw (planted 0 0 4 lime-leaf no-fruit)
      (planted 5 2 4 oak-leaf apples)
      (planted 10 -1 4 pear-leaf pears)
      (planted 15 1.5 4 young-leaf petals)
      (lawn (make-box-scope (xyz -14 28 0) 44 1 42) 0.4))
(ground 0 #:material meadow)
(sun #:azimuth 225 #:altitude 36)
(camera (xyz 6 -16.5 2.2) (xyz 7 0 3.1) #:lens 27)
