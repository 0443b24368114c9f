/* Owns keeping materials and layers of regions that sets, offsets and hulls make one region of. */
#ifndef VS_PASSES_LOOKS_H
#define VS_PASSES_LOOKS_H

#include "model/scene.h"

/* Moves materials and layers out of flat differences, intersections, offsets, hulls and filled curves, so that each
 * of these holds regions of one look. Rewrites what the scene draws (its array belongs to the store); a drawing of
 * solids costs one look at each thing drawn. False: out of memory or interrupted, as e says. */
bool vs_scene_looks(vs_scene *scene, vs_error *e);

#endif
