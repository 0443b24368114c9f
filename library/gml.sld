; The Generative Modeling Language: what the forms that vm/gml/gml_reader.c makes of a .gml file call.
(define-library (gml)
  (export gml:call gml:push gml:push-all gml:pop gml:path gml:member gml:register gml:value gml:unset gml:procedure gml:point
          gml:vector2 gml:finish gml:operands gml:operators)
  (import (visualscheme))
  (include "gml/machine.scm")
  (include "gml/arithmetic.scm")
  (include "gml/collections.scm")
  (include "gml/control.scm")
  (include "gml/boundary.scm")
  (include "gml/modelling.scm")
  (include "gml/nodes.scm"))
