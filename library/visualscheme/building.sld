; The words of a building: roofs, walls and their openings, slabs, columns, beams, stairs, ramps, railings, rooms. All lengths are in model units, all angles in radians.
(define-library (visualscheme building)
  (export roof roof-faces dormer roof-rafters roof-tiles
          wall wall? wall-layers wall-path wall-thickness wall-height wall-base wall-name wall-openings join-walls walls-under opening window door curtain-wall
          slab column beam stair ramp railing
          rooms room? room-name room-area room-perimeter room-height room-volume room-region room-solid room-doors room-graph gross-area outer-outline
          label-rooms plan-symbols dimension-walls
          require-that room-named room-width rooms-connected? daylight-ratio exit-distance
          clashes clash? clash-kind clash-parts clash-names clash-place clash-volume clash-area clash-gap
          check-print thinnest-wall print-fault? print-fault-kind print-fault-place print-fault-value print-fault-area)
  (import (visualscheme) (building core))
  (include "building/roofs.scm" "building/paths.scm" "building/joints.scm" "building/acute_joints.scm" "building/walls.scm" "building/openings.scm" "building/curtain_walls.scm"
           "building/storeys.scm" "building/rooms.scm" "building/room_checks.scm" "building/plan_symbols.scm" "building/clashes.scm" "building/printing.scm" "building/dormers.scm" "building/roof_grids.scm" "building/ifc_classes.scm" "building/design_rules.scm"))
