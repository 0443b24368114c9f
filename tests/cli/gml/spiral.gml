% Each part hangs below the one before it: the places of the parts' nodes in the world are (0,1,1), (.4226,1.9063,2), (1.1887,2.5491,3).
/gmlcontext node-create dup !scene begin
  /model    :scene def
  /active   :scene def
  /phase    0 def
  /radius   3 def
  /segments 8 def
  /origin   (0,0,0) def
  /normal   (0,0,1) def
  /add-object {
    usereg
    /gmlcontext node-create dup !node node-begin
      deleteallmacros newmacro
      origin normal radius segments circle
      5 poly2doubleface
      [ (0.2,0.5,0) (0.4,1,0) ] extrude
      pop pop
    node-end
    phase sin phase cos 1 vector3 !trans
    :node :trans node-translate
    active :node node-addchild
    /active :node def
    /phase phase 25 add def
  } def
  add-object add-object add-object
end
node-getroot :scene node-addchild
(0,0,0) !at
:scene { dup node-getchildren length 0 eq { pop exit } if
         0 node-getchild dup node-gettranslate :at add dup !at
         10000 mul dup getX round exch dup getY round exch getZ round vector3 10000 div print
} loop
count print
