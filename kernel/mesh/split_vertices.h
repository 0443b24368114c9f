/* Declares the functions of split_vertices.c: the splitting of vertices where the result touches itself. */
#ifndef VS_KERNEL_MESH_SPLIT_VERTICES_H
#define VS_KERNEL_MESH_SPLIT_VERTICES_H

#include "kernel/cluster.h"

/* The triangles of a result that are written, and their origin; borrowed. */
typedef struct {
  const vs_cluster *c;
  vs_mesh *m;
  size_t first_vertex, first_triangle; /* the result's part of m: from these indices on */
  const uint32_t *sides;   /* for each triangle, from the first: 2 * plane, plus 1 if it faces against its normal */
  const uint32_t *points;  /* for each vertex, from the first: the cluster's point */
  const uint8_t *rim;      /* for each point: plain triangles, written later, continue from here; NULL: there are
                            * none */
  size_t rim_edges;        /* number of edges along the rim, which have one triangle so far */
} vs_fresh_result;

/* Splits the vertices where the result touches itself, and cuts edges in the middle if that is not enough. Returns
 * false with k's error on failure. */
bool vs_split_touching(vs_kernel *k, const vs_fresh_result *of);

#endif
