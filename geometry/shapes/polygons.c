/* Passes the faces of polyface meshes, grid meshes and boxes to a function, one at a time.
 *
 * The caller gives a map, which is applied to the corners of each face, in an array that is reused. A reflection would
 * turn the faces inside out, so the order of their corners is then reversed. */
#include "geometry/shapes/polygons.h"

#include <stdlib.h>

#include "model/store/array.h"

typedef struct {
  const vs_affine *map;
  bool mirrored;
  vs_vec3 *mapped;
  size_t room;
  vs_polygon_taker *take;
  void *context;
} giver;

static vs_polygons_result give(giver *g, const vs_vec3 *points, const uint32_t *corner, uint32_t n) {
  if (!VS_GROW(g->mapped, g->room, n)) return VS_POLYGONS_MEMORY;
  for (uint32_t i = 0; i < n; i++) g->mapped[g->mirrored ? n - 1 - i : i] = vs_affine_point(g->map, points[corner[i]]);
  return g->take(g->context, g->mapped, n) ? VS_POLYGONS_GIVEN : VS_POLYGONS_STOPPED;
}

static vs_polygons_result give_polyface(giver *g, const struct vs_polyface_mesh *p) {
  const uint32_t *start = vs_faces_starts(p->faces), *corner = vs_faces_corners(p->faces);
  vs_polygons_result r = VS_POLYGONS_GIVEN;
  for (uint32_t i = 0; r == VS_POLYGONS_GIVEN && i < p->faces->count; i++)
    r = give(g, p->points->at, corner + start[i], start[i + 1] - start[i]);
  return r;
}

static vs_polygons_result give_grid(giver *g, const struct vs_grid_mesh *m) {
  uint32_t columns = (uint32_t)m->columns, rows = m->points->count / columns;
  vs_polygons_result r = VS_POLYGONS_GIVEN;
  for (uint32_t i = 0; i + !m->closed_u < rows; i++)
    for (uint32_t j = 0; r == VS_POLYGONS_GIVEN && j + !m->closed_v < columns; j++) {
      uint32_t below = (i + 1) % rows, right = (j + 1) % columns;
      const uint32_t quad[4] = { i * columns + j, below * columns + j, below * columns + right, i * columns + right };
      r = give(g, m->points->at, quad, 4);
    }
  return r;
}

static vs_polygons_result give_box(giver *g, const struct vs_box *b) {
  static const uint32_t face[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                       { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  vs_vec3 p = b->p, q = b->q, at[8];
  for (int c = 0; c < 8; c++) at[c] = vs_v3(c & 1 ? q.x : p.x, c & 2 ? q.y : p.y, c & 4 ? q.z : p.z);
  vs_polygons_result r = VS_POLYGONS_GIVEN;
  for (int i = 0; r == VS_POLYGONS_GIVEN && i < 6; i++) r = give(g, at, face[i], 4);
  return r;
}

vs_polygons_result vs_polygons_each(const vs_node *n, const vs_affine *map, vs_polygon_taker *take, void *context) {
  giver g = { map, vs_affine_determinant(map) < 0, NULL, 0, take, context };
  vs_polygons_result r = VS_POLYGONS_NONE;
  if (n->kind == VS_POLYFACE_MESH) r = give_polyface(&g, VS_AS(polyface_mesh, n));
  if (n->kind == VS_GRID_MESH) r = give_grid(&g, VS_AS(grid_mesh, n));
  if (n->kind == VS_BOX) r = give_box(&g, VS_AS(box, n));
  free(g.mapped);
  return r;
}
