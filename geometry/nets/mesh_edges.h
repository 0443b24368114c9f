/* Declares the edges between a mesh's triangles, for traversals. */
#ifndef VS_GEOMETRY_NETS_MESH_EDGES_H
#define VS_GEOMETRY_NETS_MESH_EDGES_H

#include "model/mesh.h"

#define VS_MESH_NONE UINT32_MAX /* no edge or triangle */

typedef struct {
  uint32_t a, b;    /* corners, a < b */
  uint32_t side[2]; /* triangles; VS_MESH_NONE at a border */
} vs_mesh_edge;

/* The edges of a mesh. A third triangle at an edge begins a separate edge. */
typedef struct {
  const vs_mesh *m; /* borrowed */
  uint32_t *corner; /* corner[i]: the first vertex at vertex i's position */
  vs_mesh_edge *edges;
  size_t edge_count;
  uint32_t (*of)[3]; /* of[t][k]: triangle t's edge opposite corner k */
} vs_mesh_edges;

/* Makes the edges. Returns false when memory is out; the caller frees s by vs_mesh_edges_free in either case. */
bool vs_mesh_edges_make(vs_mesh_edges *s, const vs_mesh *m);
void vs_mesh_edges_free(vs_mesh_edges *s);
/* Returns corner k (0, 1 or 2) of a triangle, as the first vertex at its position. */
static inline uint32_t vs_mesh_edges_corner(const vs_mesh_edges *s, uint32_t triangle, int k) {
  VS_ASSERT(triangle < s->m->triangle_count && k >= 0 && k < 3);
  return s->corner[s->m->triangles[triangle][k]];
}
static inline vs_vec3 vs_mesh_edges_place(const vs_mesh_edges *s, uint32_t triangle, int k) {
  return s->m->vertices[vs_mesh_edges_corner(s, triangle, k)];
}
/* Returns the triangle nearest to p; *place: its point nearest to p. The mesh has triangles. */
uint32_t vs_mesh_edges_nearest(const vs_mesh_edges *s, vs_vec3 p, vs_vec3 *place);

#endif
