/* Owns the passes as a drawing is given them before it is written: with bounds, which the passes themselves may not ask
 * for. */
#ifndef VS_PASSES_OPTIMISE_H
#define VS_PASSES_OPTIMISE_H

#include "passes/passes.h"
#include "model/scene.h"

/* Rewrites what the scene draws; a scene that fails stays as it was. stats may be NULL. */
bool vs_scene_optimise(vs_scene *scene, unsigned passes, vs_pass_stats *stats, vs_error *e);
/* Makes trees of boxes of the scene's large sets (group.c), for a format whose program tries every part of a set for
 * every ray. */
bool vs_scene_group(vs_scene *scene, vs_error *e);

#endif
