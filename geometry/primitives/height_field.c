/* Implements height fields: a grid of heights over a rectangle, solid down to a floor.
 *
 * Sample (i, j), in column i of row j, is point j * columns + i. No height is below the floor. If all heights are above
 * the floor, the floor is a fan of triangles around its middle. Otherwise the floor has as many triangles as the top,
 * and a sample on the floor has one vertex, which faces of top and floor share, so that the mesh closes. */
#include "geometry/primitives/height_field.h"

#include <stdlib.h>

#include "geometry/primitives/shape.h"
#include "geometry/measure/measure.h"
#include "model/store/array.h"

/* Returns true if the top has a triangle with sample i. It has one if the sample, or a neighbour along a side of a
 * triangle, is above the floor. i: index of the sample. */
static bool heights_used(const struct vs_height_field *h, uint32_t i) {
  static const int to[][2] = {
    { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 0 }, { -1, -1 }, { 0, -1 }
  }; /* offsets in columns and rows from a sample to itself and to its neighbours */
  int64_t columns = h->columns, rows = columns > 0 ? h->points->count / columns : 0, x = i % columns, y = i / columns;
  VS_ASSERT(i < h->points->count);
  for (size_t k = 0; k < sizeof to / sizeof *to; k++) {
    int64_t u = x + to[k][0], v = y + to[k][1];
    if (u >= 0 && u < columns && v >= 0 && v < rows && h->points->at[v * columns + u].z > h->low) return true;
  }
  return false;
}

typedef struct {
  const struct vs_height_field *h;
  vs_mesh *out;
  uint32_t columns, rows;
  uint32_t *top, *foot; /* top[i]: vertex at sample i; foot[i]: vertex on the floor below sample i; UINT32_MAX if the
                         * vertex is not made yet */
} vs_heights;

static bool heights_on_floor(const vs_heights *g, uint32_t i) { return !(g->h->points->at[i].z > g->h->low); }

static bool heights_foot(vs_heights *g, uint32_t i) {
  vs_vec3 p = g->h->points->at[i];
  if (g->foot[i] != UINT32_MAX) return true;
  if (!heights_on_floor(g, i)) return vs_mesh_add_vertex(g->out, vs_v3(p.x, p.y, g->h->low), &g->foot[i]);
  g->foot[i] = g->top[i];
  return true;
}

/* Adds the wall below the grid's border between sample a and its neighbour b. The outside is on the right, on the way
 * from a to b. */
static bool heights_wall(vs_heights *g, uint32_t a, uint32_t b) {
  bool ok = heights_foot(g, a) && heights_foot(g, b);
  if (ok && !heights_on_floor(g, b)) ok = vs_mesh_add_triangle(g->out, g->foot[a], g->foot[b], g->top[b]);
  if (ok && !heights_on_floor(g, a)) ok = vs_mesh_add_triangle(g->out, g->foot[a], g->top[b], g->top[a]);
  return ok;
}

static bool heights_face(vs_heights *g, uint32_t a, uint32_t b, uint32_t c, bool floor) {
  if (heights_on_floor(g, a) && heights_on_floor(g, b) && heights_on_floor(g, c)) return true;
  if (!vs_mesh_add_triangle(g->out, g->top[a], g->top[b], g->top[c])) return false;
  return !floor || (heights_foot(g, a) && heights_foot(g, b) && heights_foot(g, c) &&
                    vs_mesh_add_triangle(g->out, g->foot[a], g->foot[c], g->foot[b]));
}

bool vs_height_field_mesh(vs_mesh *out, const struct vs_height_field *h) {
  uint32_t columns = (uint32_t)h->columns, count = h->points->count, rows = columns ? count / columns : 0;
  if (columns < 2 || rows < 2) return true;
  uint32_t *numbers = vs_fresh(2 * (size_t)count, sizeof *numbers);
  vs_heights g = { h, out, columns, rows, numbers, numbers ? numbers + count : NULL };
  size_t border = 2 * ((size_t)columns + rows) - 4, cells = (size_t)(columns - 1) * (rows - 1);
  bool ok = numbers &&
            vs_mesh_reserve(out, out->vertex_count + count + border + 1, out->triangle_count + 2 * cells + 3 * border),
       touches = false;
  for (uint32_t i = 0; ok && !touches && i < count; i++) touches = heights_on_floor(&g, i);
  for (uint32_t i = 0; ok && i < count; i++) {
    g.top[i] = g.foot[i] = UINT32_MAX;
    if (!touches || heights_used(h, i)) ok = vs_mesh_add_vertex(out, h->points->at[i], &g.top[i]);
  }
  for (uint32_t j = 0; ok && j + 1 < rows; j++)
    for (uint32_t i = 0; ok && i + 1 < columns; i++) {
      uint32_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      ok = heights_face(&g, a, b, c, touches) && heights_face(&g, a, c, d, touches);
    }
  uint32_t last = count - columns, middle = 0;
  if (ok && !touches)
    ok = vs_mesh_add_vertex(out,
                            vs_v3((h->points->at[0].x + h->points->at[count - 1].x) / 2,
                                  (h->points->at[0].y + h->points->at[count - 1].y) / 2, h->low),
                            &middle);
  for (size_t k = 0; ok && k < border; k++) { /* goes around the grid's border, counter-clockwise as seen from above,
                                               * and adds the walls */
    uint32_t at[2];
    for (size_t e = 0; e < 2; e++) {
      size_t s = (k + e) % border, across = columns - 1, up = rows - 1;
      at[e] = (uint32_t)(s < across            ? s
                         : s < across + up     ? (s - across) * columns + across
                         : s < 2 * across + up ? last + 2 * across + up - s
                                               : (border - s) * columns);
    }
    ok = heights_wall(&g, at[0], at[1]) && (touches || vs_mesh_add_triangle(out, g.foot[at[1]], g.foot[at[0]], middle));
  }
  free(numbers);
  return ok;
}

static bool heights_hold(const struct vs_height_field *h, vs_vec3 p) {
  const vs_vec3 *at = h->points->at;
  uint32_t columns = (uint32_t)h->columns, rows = columns ? h->points->count / columns : 0;
  if (columns < 2 || rows < 2 || p.z < h->low) return false;
  vs_vec3 first = at[0], last = at[h->points->count - 1];
  double x = (p.x - first.x) / (last.x - first.x) * (columns - 1),
         y = (p.y - first.y) / (last.y - first.y) * (rows - 1);
  if (!(x >= 0 && x <= columns - 1 && y >= 0 && y <= rows - 1)) return false;
  uint32_t i = (uint32_t)fmin(x, columns - 2), j = (uint32_t)fmin(y, rows - 2);
  double a = at[j * columns + i].z, b = at[j * columns + i + 1].z, c = at[(j + 1) * columns + i + 1].z,
         d = at[(j + 1) * columns + i].z;
  x -= i, y -= j;
  return p.z <= (x >= y ? a + (b - a) * x + (c - b) * y : a + (d - a) * y + (c - d) * x);
}

/* ---- the functions of the shape ---- */

static bool height_field_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_height_field *h = VS_AS(height_field, n);
  (void)e;
  for (uint32_t i = 0; i < h->points->count; i++) {
    if (!heights_used(h, i)) continue;
    vs_bounds_add(b, vs_affine_point(a, h->points->at[i]));
    vs_bounds_add(b, vs_affine_point(a, vs_v3(h->points->at[i].x, h->points->at[i].y, h->low)));
  }
  return true;
}

static bool height_field_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  (void)f;
  return vs_height_field_mesh(out, VS_AS(height_field, n)) || vs_error_memory(e, NULL);
}

static bool height_field_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  vs_mesh mesh = { 0 };
  (void)area;
  bool ok = vs_height_field_mesh(&mesh, VS_AS(height_field, n)) || vs_error_memory(e, NULL);
  if (ok) vs_mesh_measure(&mesh, m); /* measures the mesh of the height field, which has exactly the same shape */
  vs_mesh_free(&mesh);
  return ok;
}

static bool height_field_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  (void)q, (void)height;
  return heights_hold(VS_AS(height_field, n), p);
}

static vs_node *height_field_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map,
                                   bool *fits) {
  VS_MOVED(height_field, map->plain);
  vs_points *points = vs_shape_map_points(s, a, d.points);
  d.points = points;
  d.low = a->m[2][2] * d.low + a->m[2][3];
  vs_node *field = points ? vs_node_new(s, VS_HEIGHT_FIELD, &d, NULL, 0) : NULL;
  vs_points_release(s, points);
  return field;
}

VS_SHAPE(height_field, NULL, NULL, NULL);
