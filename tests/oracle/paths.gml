% an octagon that draws in, and a block
(0,0,0) (0,0,1) 1 8 circle 3 poly2doubleface (0.2,0.5,0) extrude pop
[ (2,0,0) (4,0,0) (4,1,0) (2,1,0) ] 3 poly2doubleface (0,2,0) extrude pop
