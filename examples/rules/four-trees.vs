; Four trees of one template: with leaves, with apples, with pears, in blossom. After figures 23 and 24 of Krecklau, Pavic and Kobbelt
; (2010); the rules are our own.
;
; What it teaches: a template with two rules among its parameters (trees.vs); four calls make four kinds of tree.
;
;   vs four-trees.vs -o trees.png --size 1280x480
(require "trees.vs")
(draw (planted 0 0 4 lime-leaf no-fruit)
      (planted 7 0 4 oak-leaf apples)
      (planted 14 0 4 pear-leaf pears)
      (planted 21 0 4 young-leaf petals))
(ground 0 #:material grass)
(sun #:azimuth 205 #:altitude 40)
(camera (xyz 10.5 -27 3.4) (xyz 10.5 0 3.3) #:lens 34)
