/* Owns the materials and layers of regions that sets, offsets and hulls merge into one region. */
#ifndef VS_PASSES_LOOKS_H
#define VS_PASSES_LOOKS_H

#include "model/scene.h"

/* Moves materials and layers out of flat differences, intersections, offsets, hulls and filled curves, so that each of
 * these holds regions of one look. Rewrites the scene's drawn array, which belongs to the store. A drawing of solids
 * costs a look at each drawn thing. Returns false, with e set, when memory is out or the run is interrupted. */
bool vs_scene_looks(vs_scene *scene, vs_error *e);

#endif
