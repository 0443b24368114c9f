% An octagon of radius 1 that goes up in two steps: inset by .2 at the height .5, and by .4 at the height 1. Its edges are sharp.
(0,0,0) (0,0,1) 1 8 circle
3 poly2doubleface
[ (0.2,0.5,3) (0.4,1,3) ] extrude
