/* Owns the interface of split_vertices.c: the splitting of vertices where the result touches itself, so that by
 * index every edge has two triangles and every vertex one fan of them. */
#ifndef VS_KERNEL_MESH_SPLIT_VERTICES_H
#define VS_KERNEL_MESH_SPLIT_VERTICES_H

#include "kernel/cluster.h"

/* Of the result's triangles from first_triangle on: sides: 2 * plane + looks against its normal, of each; points: of
 * the vertices from first_vertex on. rim: of a point: plain triangles go on from here, which have not been written yet;
 * so many edges are still without their second triangle. Or NULL. */
bool vs_split_touching(vs_kernel *k, const vs_cluster *c, vs_mesh *m, size_t first_vertex, size_t first_triangle,
                       const uint32_t *sides, const uint32_t *points, const uint8_t *rim, size_t rim_edges);

#endif
