/* Declares a quick proof that a mesh does not intersect itself. It tests pairs of triangles in doubles, with bounds on
 * the errors. A test either proves that two triangles are apart, or leaves this undecided. */
#ifndef VS_KERNEL_MESH_TRIANGLES_APART_H
#define VS_KERNEL_MESH_TRIANGLES_APART_H

#include "model/mesh.h"
#include "kernel/memory.h"

/* Returns true if triangles a and b have nothing in common except corners, or an edge, with equal positions. Returns
 * false otherwise, if doubles cannot decide this, or if a triangle has no area. */
bool vs_triangles_apart(const vs_vec3 a[3], const vs_vec3 b[3], int *shared); /* *shared: number of corners of a that
                                                                               * have equal positions in b */

/* Returns true if triangles a and b have no point in common and are separated by more than rounding errors. */
bool vs_triangles_parted(const vs_vec3 a[3], const vs_vec3 b[3]);

/* Sets *apart to true if doubles prove that no two triangles of the mesh have more in common than corners or an edge.
 * *edges is then the number of pairs with a common edge. Returns false if interrupted or memory is out. */
bool vs_mesh_is_apart(vs_kernel *k, const vs_mesh *m, bool *apart, size_t *edges);

#endif
