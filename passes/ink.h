/* Owns the dark paint that thin objects without a material have in pictures. */
#ifndef VS_PASSES_INK_H
#define VS_PASSES_INK_H

#include "model/scene.h"

/* Gives a dark material to curves, flat regions and open surfaces without one. Rewrites the scene's drawn array, which
 * belongs to the store. A drawing of solids costs a look at each drawn thing. Returns false, with e set, when memory is
 * out or the run is interrupted. */
bool vs_scene_ink(vs_scene *scene, vs_error *e);

#endif
