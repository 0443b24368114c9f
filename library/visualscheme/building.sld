; The words of a building: roofs. All lengths are in model units, all pitches in radians.
(define-library (visualscheme building)
  (export roof roof-faces)
  (import (visualscheme))
  (include "building/roofs.scm"))
