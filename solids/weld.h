/* Declares the welding of meshes: the removal of details smaller than a step. */
#ifndef VS_SOLIDS_WELD_H
#define VS_SOLIDS_WELD_H

#include "model/mesh.h"

/* Removes details smaller than `step` from m: unites corners closer than the step, and removes triangles lower than the
 * step by leading their longest edge through their third corner. Each edge of m has as many triangles in one direction
 * as in the other, before and afterwards. The surface moves by a few steps at most, and may then overlap itself.
 * Returns false if memory is out; m is then unusable. */
bool vs_mesh_weld(vs_mesh *m, double step);

/* Removes the vertices of m that belong to no triangle. Returns false when memory is out; m is then unchanged. */
bool vs_mesh_drop_lonely(vs_mesh *m);

#endif
