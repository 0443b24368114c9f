; The Generative Modeling Language: what the forms that vm/gml/gml_reader.c makes of a .gml file call.
(define-library (gml)
  (export gml:call gml:push gml:push-all gml:pop gml:path gml:member gml:register gml:value gml:unset gml:procedure gml:point
          gml:vector2 gml:finish gml:operands gml:operators
          ; what programs in Scheme and in JavaScript find
          from-script to-gml gml-ref gml-set! gml-call gml-object
          (rename gml-ref gml_ref) (rename gml-set! gml_set) (rename gml-call gml_call) (rename gml-object gml_object))
  (import (visualscheme) (scripts))
  (include "gml/machine.scm")
  (include "gml/arithmetic.scm")
  (include "gml/collections.scm")
  (include "gml/control.scm")
  (include "gml/boundary.scm")
  (include "gml/modelling.scm")
  (include "gml/nodes.scm")
  (include "gml/crossing.scm"))
