/* Declares the quick proof that a mesh does not intersect itself: pairs of triangles, in doubles, with bounds on their
 * errors. A proof succeeds or leaves the question open. */
#ifndef VS_KERNEL_MESH_TRIANGLES_APART_H
#define VS_KERNEL_MESH_TRIANGLES_APART_H

#include "model/mesh.h"
#include "kernel/memory.h"

/* Returns true if the two triangles have only those corners, or that edge, in common whose positions are equal. Returns
 * false also if doubles cannot decide it: if they touch, are folded onto each other, or one has no area. */
bool vs_triangles_apart(const vs_vec3 a[3], const vs_vec3 b[3], int *shared); /* *shared: number of shared corners */

/* Returns true if they certainly have nothing in common. */
bool vs_triangles_parted(const vs_vec3 a[3], const vs_vec3 b[3]);

/* *apart: all pairs of the mesh's triangles are apart; then *edges is the number of pairs that share an edge. Returns
 * false if interrupted or out of memory. */
bool vs_mesh_is_apart(vs_kernel *k, const vs_mesh *m, bool *apart, size_t *edges);

#endif
