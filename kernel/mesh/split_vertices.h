/* Declares the splitting of vertices where the result touches itself. */
#ifndef VS_KERNEL_MESH_SPLIT_VERTICES_H
#define VS_KERNEL_MESH_SPLIT_VERTICES_H

#include "kernel/cluster.h"

/* A result whose triangles have been written to a mesh, and their origin in the cluster. All pointers belong to the
 * caller. */
typedef struct {
  const vs_cluster *c;
  vs_mesh *m;
  size_t first_vertex, first_triangle; /* indices in m where the result begins */
  const uint32_t *sides;   /* for each triangle of the result: 2 * plane, plus 1 if the triangle faces against the
                            * plane's normal */
  const uint32_t *points;  /* for each vertex of the result: its point in the cluster */
  const uint8_t *rim;      /* for each point: 1 if plain triangles, which are written later, end there; NULL: there are
                            * no plain triangles */
  size_t rim_edges;        /* number of edges between written triangles and plain triangles; at the call, such an edge
                            * has one triangle */
} vs_fresh_result;

/* Splits the vertices where the result touches itself. Cuts edges in the middle if that does not suffice. Returns false
 * and sets the error of k on failure. */
bool vs_split_touching(vs_kernel *k, const vs_fresh_result *of);

#endif
