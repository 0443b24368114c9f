/* Owns the order of placements and face materials: it moves placements that turn or stretch below such materials, for
 * POV-Ray. */
#ifndef VS_PASSES_LAY_H
#define VS_PASSES_LAY_H

#include "model/scene.h"

/* Rewrites the scene's drawn array, which belongs to the store. A drawing without such materials costs a look at each
 * node. Returns false, with e set, when memory is out or the run is interrupted. */
bool vs_scene_lay(vs_scene *scene, vs_error *e);

#endif
