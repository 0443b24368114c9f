/* Declares the splitting of vertices where the result touches itself. */
#ifndef VS_KERNEL_MESH_SPLIT_VERTICES_H
#define VS_KERNEL_MESH_SPLIT_VERTICES_H

#include "kernel/cluster.h"

/* The part of a mesh that is the kernel's result, and its origin in the cluster. All pointers belong to the caller. */
typedef struct {
  const vs_cluster *c;
  vs_mesh *m;
  size_t first_vertex, first_triangle; /* indices in mesh m of the result's first vertex and first triangle */
  const uint32_t *sides;   /* sides[t]: for triangle t of the result: 2 * number of its plane, plus 1 if the triangle
                            * faces against the plane's normal */
  const uint32_t *points;  /* points[v]: number in the cluster of the point at vertex v of the result */
  const uint8_t *rim;      /* rim[p]: 1 if untouched triangles, which are written later, end at point p; NULL: there are
                            * no such triangles */
  size_t rim_edges;        /* number of edges between the triangles of the result and untouched triangles, which are
                            * copied later; until then, such an edge has one triangle */
} vs_fresh_result;

/* Splits the vertices where the result touches itself. If the parts remain connected along an edge, also cuts this edge
 * in the middle. Returns false and sets the error of k on failure. */
bool vs_split_touching(vs_kernel *k, const vs_fresh_result *of);

#endif
