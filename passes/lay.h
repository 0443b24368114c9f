/* Owns moving materials that lie on faces out of placements that turn or stretch, for POV-Ray. */
#ifndef VS_PASSES_LAY_H
#define VS_PASSES_LAY_H

#include "model/scene.h"

/* Rewrites what the scene draws (its array belongs to the store); a drawing without such materials costs one look at
 * each node. False: out of memory or interrupted, as e says. */
bool vs_scene_lay(vs_scene *scene, vs_error *e);

#endif
