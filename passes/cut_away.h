/* Owns what a view's plane leaves of a drawing. */
#ifndef VS_PASSES_CUT_AWAY_H
#define VS_PASSES_CUT_AWAY_H

#include "model/scene.h"

/* Returns a new reference to what of the node lies on the normal's side of the plane, not resolved yet. The faces
 * that the cut makes have the material of what was cut. NULL: out of memory. */
vs_node *vs_node_cut(vs_ref ref, vs_vec3 point, vs_vec3 normal);
/* Puts that in place of each thing drawn. False: out of memory, and the scene is still whole. */
bool vs_scene_cut(vs_scene *scene, vs_vec3 point, vs_vec3 normal, vs_error *e);

#endif
