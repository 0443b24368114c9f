% Grimaldo's manipulator: three arrows that move a column. One drag goes 4 along X and Y at most, and 2 along Z.
GrimaldoDemos.Tools begin
  usereg
  (2,0,0) (4,4,2) 2 create-manipulator !manip
  node-getroot :manip node-addchild
  /gmlcontext node-create dup !column node-begin
    deleteallmacros newmacro
    (0,0,0) (0,0,1) 1 12 circle
    5 poly2doubleface
    [ (0,0.4,3) (0.3,0.6,3) (0.3,3,3) (0,3.4,3) ] extrude pop
  node-end
  :manip /trans get :column node-addchild
end
% the ground that it stands on
[ (-6,-6,0) (6,-6,0) (6,6,0) (-6,6,0) ] reverse 3 poly2doubleface (0,0.3,3) extrude pop
