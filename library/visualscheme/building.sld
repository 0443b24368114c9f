; The words of a building: roofs, walls and their openings. All lengths are in model units, all angles in radians.
(define-library (visualscheme building)
  (export roof roof-faces
          wall wall? wall-layers wall-path wall-thickness wall-height wall-base wall-name wall-openings join-walls opening window door)
  (import (visualscheme))
  (include "building/roofs.scm" "building/paths.scm" "building/joints.scm" "building/walls.scm" "building/openings.scm"))
