/* Owns painting dark, for pictures, what is thin and has no material. */
#ifndef VS_PASSES_INK_H
#define VS_PASSES_INK_H

#include "model/scene.h"

/* Gives curves, flat regions and open surfaces that stand in no material a dark one. Rewrites what the scene draws
 * (its array belongs to the store);
 * a drawing of solids costs one look at each thing drawn. False: out of memory or interrupted, as e says. */
bool vs_scene_ink(vs_scene *scene, vs_error *e);

#endif
