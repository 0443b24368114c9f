; The translation of OpenSCAD's programs, which the macro scad:program of the library (openscad) calls.
(define-library (openscad compiler)
  (export scad-program scad-translate!)
  (import (visualscheme))
  (include "words.scm" "scopes.scm" "expressions.scm" "statements.scm" "customizer.scm" "translation.scm" "program.scm"))
