/* Owns the edges between a mesh's triangles, for walks over it. */
#ifndef VS_GEOMETRY_NETS_MESH_EDGES_H
#define VS_GEOMETRY_NETS_MESH_EDGES_H

#include "model/mesh.h"

#define VS_MESH_NONE UINT32_MAX /* no edge or triangle */

typedef struct {
  uint32_t a, b;    /* corners, a < b */
  uint32_t side[2]; /* triangles; VS_MESH_NONE at a border */
} vs_mesh_edge;

/* A third triangle at an edge begins an edge of its own. */
typedef struct {
  const vs_mesh *m; /* borrowed */
  uint32_t *corner; /* by vertex: the first vertex at that place */
  vs_mesh_edge *edges;
  size_t edge_count;
  uint32_t (*of)[3]; /* by triangle: edge k is opposite corner k */
} vs_mesh_edges;

/* False: out of memory; vs_mesh_edges_free is due either way. */
bool vs_mesh_edges_make(vs_mesh_edges *s, const vs_mesh *m);
void vs_mesh_edges_free(vs_mesh_edges *s);
/* Corner k of a triangle, as the first vertex at its place. k is 0, 1 or 2. */
static inline uint32_t vs_mesh_edges_corner(const vs_mesh_edges *s, uint32_t triangle, int k) {
  VS_ASSERT(triangle < s->m->triangle_count && k >= 0 && k < 3);
  return s->corner[s->m->triangles[triangle][k]];
}
static inline vs_vec3 vs_mesh_edges_place(const vs_mesh_edges *s, uint32_t triangle, int k) {
  return s->m->vertices[vs_mesh_edges_corner(s, triangle, k)];
}
/* The triangle nearest to p, and in *place its point that is nearest. The mesh has triangles. */
uint32_t vs_mesh_edges_nearest(const vs_mesh_edges *s, vs_vec3 p, vs_vec3 *place);

#endif
