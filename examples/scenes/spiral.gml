% The first example of Grimaldo: each click of the trigger hangs a new part below the last one.
/gmlcontext node-create dup !scene begin
  /model    :scene def
  /active   :scene def
  /phase    0 def
  /radius   3 def
  /segments 8 def
  /origin   (0,0,0) def
  /normal   (0,0,1) def
  /sliders  [ ] def
  /gizmos {
    model sliders 2
    { 2 0 0 vector3 0 }
    { } { add-object }
    GIZMOS.gizmo-trigger
    model node-begin
      sliders {
        begin gizmo-create gizmo-activate end
      } forall
    node-end
  } def
  /add-object {
    usereg
    /gmlcontext node-create dup !node node-begin
      deleteallmacros newmacro
      origin normal radius segments circle
      5 poly2doubleface
      [ (0.2,0.5,0) (0.4,1,0) ] extrude
    node-end
    phase sin phase cos 1 vector3 !trans
    :node :trans node-translate
    active :node node-addchild
    /active :node def
    /phase phase 25 add def
  } def
  gizmos
end
node-getroot :scene node-addchild
