% The volumes of these shapes are known: cmd asks for them.
usereg
% a plate with a square hole: a face becomes a ring of another, on either side
[ (-1,-1,0) (1,-1,0) (1,1,0) (-1,1,0) ] !outline
:outline 3 poly2doubleface dup edgemate exch (0,1,3) extrude !top !bottom
:outline { 0.5 mul } map reverse 3 poly2doubleface dup edgemate exch -1 1 extrude-simple !hole-top !hole-bottom
:hole-bottom :bottom killFmakeRH
:hole-top :top killFmakeRH
% a cube made by Euler's operators alone
(10,0,0) (11,0,0) makeVEFS (11,1,0) makeEVone (10,1,0) makeEVone !last
:last faceCCW faceCCW faceCCW !first
:first :last makeEF edgemate 1 1 extrude-simple pop
% a tower: the top of one block bridged to the bottom of another
(20,0,0) (0,0,1) 2 4 circle 3 poly2doubleface (0,1,3) extrude !up
(20,0,5) (0,0,1) 2 4 circle 3 poly2doubleface dup edgemate faceCCW !low (0,1,3) extrude pop
:up :low 1 bridgerings-simple pop
