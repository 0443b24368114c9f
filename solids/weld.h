/* Declares the welding of meshes. */
#ifndef VS_SOLIDS_WELD_H
#define VS_SOLIDS_WELD_H

#include "model/mesh.h"

/* Removes details smaller than `step` from m, a closed chain. It unites corners closer than the step. It removes
 * triangles lower than the step by leading their longest edge through their third corner. The mesh stays a closed
 * chain, which may overlap itself: the surface of the solid that it winds around moves by a few steps at most. Corners
 * without a triangle are removed. Returns false if memory is out; m is then unusable. */
bool vs_mesh_weld(vs_mesh *m, double step);

/* Removes the corners that belong to no triangle. Returns false when memory is out; m is then unchanged. */
bool vs_mesh_drop_lonely(vs_mesh *m);

#endif
