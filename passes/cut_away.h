/* Declares the cutting of a drawing by a view's plane. */
#ifndef VS_PASSES_CUT_AWAY_H
#define VS_PASSES_CUT_AWAY_H

#include "model/scene.h"

/* Returns a new reference to the part of ref's node on the side of the plane to which the normal points. It is not
 * resolved yet (solids/resolve.h). Faces in the plane of the cut have the material of the solid there. Returns NULL if
 * memory is out. */
vs_node *vs_node_cut(vs_ref ref, vs_vec3 point, vs_vec3 normal);
/* Replaces each drawn object by its part on the side of the plane to which the normal points, as vs_node_cut does.
 * Returns false if memory is out; the scene is then unchanged. */
bool vs_scene_cut(vs_scene *scene, vs_vec3 point, vs_vec3 normal, vs_error *e);

#endif
