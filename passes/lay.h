/* Declares, for POV-Ray, the exchange of placements with materials inside them that have a pattern on faces, such as
 * bricks: placements that rotate or stretch move below such materials. */
#ifndef VS_PASSES_LAY_H
#define VS_PASSES_LAY_H

#include "model/scene.h"

/* Moves placements that rotate or stretch below materials that have a pattern on faces. Rewrites the scene's drawn
 * array, which belongs to the store. Returns false, with e set, if memory is out or the run is interrupted. */
bool vs_scene_lay(vs_scene *scene, vs_error *e);

#endif
