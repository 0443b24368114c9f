/* Declares the exchange of placements and face materials. It moves placements that rotate or stretch below such
 * materials, for POV-Ray. */
#ifndef VS_PASSES_LAY_H
#define VS_PASSES_LAY_H

#include "model/scene.h"

/* Rewrites the scene's drawn array, which belongs to the store. If the drawing has no material that is laid on faces,
 * the function only examines each node. Returns false, with e set, if memory is out or the run is interrupted. */
bool vs_scene_lay(vs_scene *scene, vs_error *e);

#endif
