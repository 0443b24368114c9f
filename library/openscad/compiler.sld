; The translation of OpenSCAD's programs, which the macro scad:program of the library (openscad) calls.
(define-library (openscad compiler)
  (export scad-program)
  (import (visualscheme))
  (include "words.scm" "scopes.scm" "expressions.scm" "statements.scm" "program.scm"))
