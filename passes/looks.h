/* Declares the treatment of materials and layers of regions that sets, offsets and hulls merge into a single region. */
#ifndef VS_PASSES_LOOKS_H
#define VS_PASSES_LOOKS_H

#include "model/scene.h"

/* Moves materials and layers out of flat differences, intersections, offsets, hulls and filled curves, so that each of
 * these has a single material and layer. Rewrites the scene's drawn array, which belongs to the store. For a drawing of
 * solids it only examines each drawn object. Returns false, with e set, if memory is out or the run is interrupted. */
bool vs_scene_looks(vs_scene *scene, vs_error *e);

#endif
