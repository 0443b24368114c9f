/* Owns the interface of split_vertices.c: the splitting of vertices where the result touches itself, so that by
 * index every edge has two triangles and every vertex one fan of them. */
#ifndef VS_KERNEL_MESH_SPLIT_VERTICES_H
#define VS_KERNEL_MESH_SPLIT_VERTICES_H

#include "kernel/cluster.h"

/* The triangles of a result that were written, and where they come from; borrowed. */
typedef struct {
  const vs_cluster *c;
  vs_mesh *m;
  size_t first_vertex, first_triangle; /* in m: from there on */
  const uint32_t *sides;   /* of a triangle, from the first: 2 * plane + looks against its normal */
  const uint32_t *points;  /* of a vertex, from the first: the cluster's point */
  const uint8_t *rim;      /* of a point: plain triangles go on from here, which are written later; NULL: none do */
  size_t rim_edges;        /* edges along the rim, which have one triangle now */
} vs_fresh_result;

/* Splits the vertices where the result touches itself, and cuts edges in the middle where that is not enough. Fails as
 * k's error says. */
bool vs_split_touching(vs_kernel *k, const vs_fresh_result *of);

#endif
