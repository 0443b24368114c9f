/* Owns the welding of meshes. */
#ifndef VS_SOLIDS_WELD_H
#define VS_SOLIDS_WELD_H

#include "model/mesh.h"

/* Frees m, a closed chain, of details smaller than `step`: unites corners that are nearer, and removes triangles lower
 * than that by leading their longest edge through their third corner. The mesh stays a closed chain, which may overlap
 * itself: the solid that it winds around moves by no more than some steps. Corners without a triangle are removed.
 * Returns false when memory is out; m is then unusable. */
bool vs_mesh_weld(vs_mesh *m, double step);

#endif
