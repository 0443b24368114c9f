/* Declares the exchange of placements and materials with a pattern on faces, such as bricks. Placements that rotate or
 * stretch move below such materials, for POV-Ray. */
#ifndef VS_PASSES_LAY_H
#define VS_PASSES_LAY_H

#include "model/scene.h"

/* Moves placements that rotate or stretch below materials that are laid on faces. Rewrites the scene's drawn array,
 * which belongs to the store. Returns false, with e set, if memory is out or the run is interrupted. */
bool vs_scene_lay(vs_scene *scene, vs_error *e);

#endif
