/* Declares the edges of a mesh with the triangles beside them, for algorithms that walk over the mesh. */
#ifndef VS_GEOMETRY_NETS_MESH_EDGES_H
#define VS_GEOMETRY_NETS_MESH_EDGES_H

#include "model/mesh.h"

#define VS_MESH_NONE UINT32_MAX /* number that means no edge or no triangle */

typedef struct {
  uint32_t a, b;    /* corners (vertex numbers) at the ends of the edge, a < b */
  uint32_t side[2]; /* numbers of the two triangles beside the edge; VS_MESH_NONE instead of a missing triangle at a
                     * border of the mesh */
} vs_mesh_edge;

/* The edges of a mesh. If an edge has more than two triangles, it is stored several times, with at most two triangles
 * each. */
typedef struct {
  const vs_mesh *m; /* the mesh, which belongs to the caller */
  uint32_t *corner; /* corner[i]: index of the first vertex that has the position of vertex i */
  vs_mesh_edge *edges;
  size_t edge_count;
  uint32_t (*of)[3]; /* of[t][k]: the edge of triangle t that is opposite its corner k */
} vs_mesh_edges;

/* Finds the edges of m. Returns false when memory is out. The caller frees s with vs_mesh_edges_free in either case. */
bool vs_mesh_edges_make(vs_mesh_edges *s, const vs_mesh *m);
void vs_mesh_edges_free(vs_mesh_edges *s);
/* Returns corner k (0, 1 or 2) of the triangle, as the number of the first vertex at the corner's position. */
static inline uint32_t vs_mesh_edges_corner(const vs_mesh_edges *s, uint32_t triangle, int k) {
  VS_ASSERT(triangle < s->m->triangle_count && k >= 0 && k < 3);
  return s->corner[s->m->triangles[triangle][k]];
}
static inline vs_vec3 vs_mesh_edges_place(const vs_mesh_edges *s, uint32_t triangle, int k) {
  return s->m->vertices[vs_mesh_edges_corner(s, triangle, k)];
}
/* Returns the number of the triangle nearest to p. *place: point of this triangle nearest to p. The mesh has at least
 * one triangle. */
uint32_t vs_mesh_edges_nearest(const vs_mesh_edges *s, vs_vec3 p, vs_vec3 *place);

#endif
