; The words of a building: roofs, walls and their openings, slabs, columns, beams, stairs, ramps, railings. All lengths are in model units, all angles in radians.
(define-library (visualscheme building)
  (export roof roof-faces
          wall wall? wall-layers wall-path wall-thickness wall-height wall-base wall-name wall-openings join-walls opening window door
          slab column beam stair ramp railing)
  (import (visualscheme))
  (include "building/roofs.scm" "building/paths.scm" "building/joints.scm" "building/walls.scm" "building/openings.scm"
           "building/storeys.scm"))
