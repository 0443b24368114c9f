; Assemblies: parts that are mated face to face, and joints that sliders and films move. Lengths are in model units, angles in radians.
(define-library (visualscheme assembly)
  (export mate joint place-frame)
  (import (visualscheme))
  (include "assembly/mates.scm"))
