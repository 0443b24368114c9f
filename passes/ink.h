/* Declares the dark paint that thin objects without a material have in pictures. */
#ifndef VS_PASSES_INK_H
#define VS_PASSES_INK_H

#include "model/scene.h"

/* Gives a dark material to curves, flat regions and open surfaces without a material, in the scene's drawn array.
 * Returns false, with e set, if memory is out or the run is interrupted. */
bool vs_scene_ink(vs_scene *scene, vs_error *e);

#endif
