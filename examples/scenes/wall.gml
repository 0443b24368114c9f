% The gothic wall builder of Grimaldo, with a plain window: a ground plate, a trigger that makes a window, and a manipulator that moves each.
/gmlcontext node-create dup !scene begin
  /model :scene def
  /sliders [ ] def
  /create-window {
    usereg
    /gmlcontext node-create dup !node node-begin
      [ (-2,0,0) (2,0,0) (2,0,8) (-2,0,8) ] 3 poly2doubleface dup edgemate exch (0,1,3) extrude !front !back
      % a pointed hole through it
      [ (-1,0,1) (1,0,1) (1,0,5) (0,0,7) (-1,0,5) ] reverse 3 poly2doubleface dup edgemate exch -1 1 extrude-simple !inner !outer
      :outer :back killFmakeRH
      :inner :front killFmakeRH
    node-end
    :node
  } def
  /create-scene {
    GrimaldoDemos.Tools begin
      usereg
      (4,2,-2) (12,10,16) 10 create-manipulator !manip
      model :manip node-addchild
      create-window !window
      :manip /trans get :window node-addchild
      model node-begin
        deleteallmacros newmacro
        /std9hi setcurrentmaterial
        (0,0,0) (0,0,1) 90 4 circle
        1 poly2doubleface
        [ (0.2,1,0) (0.2,0.5,0) ] extrude
        pop pop
      node-end
    end
  } def
  /gizmos {
    model sliders 5
    { (0,-6,3) 0 } % above the ground, which would hide it
    { } { create-scene }
    GIZMOS.gizmo-trigger
    model node-begin
      sliders { begin gizmo-create gizmo-activate end } forall
    node-end
  } def
  create-scene gizmos
end
node-getroot :scene node-addchild
