% An engine, whose parameters and whose procedure model-update the host finds at the controller, as in Grimaldo's listing 5.13.
usereg

dict dup !parameters begin
  /cylinder 8 def
  /angle 45.0 def
end

/Engine dict def
Engine begin
  /parameters :parameters def
  /compute {
    usereg
    deleteallmacros newmacro
    0 1 Engine.parameters.cylinder {
      !i
      % even ones to the left, odd ones to the right, a pair in each row
      Engine.parameters.angle :i 2 mod 0 eq { neg } if !a
      :a sin 0 :a cos vector3 !up
      0 :i 2 idiv 1.5 mul 0 vector3 :up add :up 0.5 16 circle
      3 poly2doubleface (0,2,3) extrude pop
    } forx
  } def
end

dict dup !model begin
  /parameters :parameters def
  /model-update { Engine.compute } def

  model-update
end

node-controller /parameters :parameters put
node-controller /model-update :model /model-update get put
