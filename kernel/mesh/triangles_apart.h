/* Owns the quick proof that a mesh does not meet itself: pairs of triangles, in doubles, with the errors that doubles
 * have. It says yes or does not know. */
#ifndef VS_KERNEL_MESH_TRIANGLES_APART_H
#define VS_KERNEL_MESH_TRIANGLES_APART_H

#include "model/mesh.h"
#include "kernel/memory.h"

/* Have the two nothing in common but the corners, or the edge, that they share by place? False also where that cannot
 * be told in doubles: where they touch, are folded onto each other, or one has no area. */
bool vs_triangles_apart(const vs_vec3 a[3], const vs_vec3 b[3], int *shared); /* *shared: how many corners */

/* Have they nothing in common at all? */
bool vs_triangles_parted(const vs_vec3 a[3], const vs_vec3 b[3]);

/* *apart: are all pairs of the mesh's triangles? *edges: how many pairs share an edge then. False where that was
 * stopped, or for want of memory. */
bool vs_mesh_is_apart(vs_kernel *k, const vs_mesh *m, bool *apart, size_t *edges);

#endif
