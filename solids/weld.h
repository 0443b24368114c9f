/* Owns the welding of meshes. */
#ifndef VS_SOLIDS_WELD_H
#define VS_SOLIDS_WELD_H

#include "model/mesh.h"

/* Frees m, a closed chain, of details smaller than `step`: corners that are nearer become one, and a triangle lower
 * than that vanishes, its longest edge being led through its third corner. m stays a closed chain, which may overlap
 * itself: what it winds around is no further than some steps from what it was. Corners that no triangle has are gone.
 * False: out of memory, and m is not to be used. */
bool vs_mesh_weld(vs_mesh *m, double step);

#endif
