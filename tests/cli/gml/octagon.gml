(0,0,0) (0,0,1) 1 8 circle
3 poly2doubleface
[ (0.2,0.5,3) (0.4,1,3) ] extrude
