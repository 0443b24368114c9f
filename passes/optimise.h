/* Declares the run of all passes over a drawing before it is written. It supplies the passes with bounds of nodes,
 * which passes.c itself cannot compute. */
#ifndef VS_PASSES_OPTIMISE_H
#define VS_PASSES_OPTIMISE_H

#include "passes/passes.h"
#include "model/scene.h"

/* Runs the passes over the scene's drawn array. passes: set of passes as bits, see vs_pass_options. On failure the
 * scene is unchanged. stats and notes may be NULL. */
bool vs_scene_optimise(vs_scene *scene, unsigned passes, vs_pass_stats *stats, const vs_pass_notes *notes,
                       vs_error *e);
/* Converts the scene's large sets to trees of boxes (group.c), for a format whose program tests every part of a set for
 * every ray. Returns false, with e set, on failure. */
bool vs_scene_group(vs_scene *scene, vs_error *e);

#endif
