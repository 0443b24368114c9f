/* Computes contour lines: the lines in which a plane cuts an open mesh. */
#include "geometry/nets/contour_lines.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/nets/mesh_edges.h"
#include "model/store/array.h"

typedef struct {
  const vs_mesh *m;
  vs_mesh_edges edges;
  double *height; /* height[i]: height of vertex i above the plane */
  bool *used;     /* used[t]: true if a contour line has already crossed triangle t */
} contours;

static bool is_up(const contours *c, uint32_t vertex) { return c->height[c->edges.corner[vertex]] > 0; }

static bool is_crossed(const contours *c, uint32_t edge) {
  return is_up(c, c->edges.edges[edge].a) != is_up(c, c->edges.edges[edge].b);
}

/* Returns the point where the plane cuts an edge. If an end of the edge lies in the plane, the point is this end. */
static vs_vec3 place(const contours *c, uint32_t edge) {
  uint32_t a = c->edges.edges[edge].a, b = c->edges.edges[edge].b;
  double p = c->height[a], q = c->height[b];
  vs_vec3 from = c->m->vertices[a], to = c->m->vertices[b];
  if (p == 0) return from;
  if (q == 0) return to;
  return vs_v3_add(from, vs_v3_scale(vs_v3_sub(to, from), p / (p - q)));
}

static bool add_place(vs_polyline *p, vs_vec3 at) {
  if (p->count && vs_v3_equal(p->at[p->count - 1], at)) return true;
  if (!VS_GROW(p->at, p->room, p->count + 1)) return false;
  p->at[p->count++] = at;
  return true;
}

/* Follows a contour line from the edge `edge` into triangle t, to a border of the mesh or back to its beginning. Passes
 * its points to `put`. Returns false if `put` has returned false, or memory is out. */
static bool follow(contours *c, uint32_t edge, uint32_t t, const vs_line_put *put) {
  vs_polyline line = { 0 };
  bool ok = add_place(&line, place(c, edge));
  while (ok && t != VS_MESH_NONE && !c->used[t]) {
    uint32_t next = edge;
    c->used[t] = true;
    for (int k = 0; k < 3; k++) {
      uint32_t other = c->edges.of[t][k];
      if (other != edge && other != VS_MESH_NONE && is_crossed(c, other)) next = other;
    }
    if (next == edge) break; /* triangle t has no area, because two of its corners are equal, so the line ends here */
    ok = add_place(&line, place(c, next));
    edge = next;
    t = c->edges.edges[edge].side[c->edges.edges[edge].side[0] == t];
  }
  line.closed = ok && t != VS_MESH_NONE && line.count > 3 && vs_v3_equal(line.at[0], line.at[line.count - 1]);
  if (line.closed) line.count--;
  if (ok && line.count > 1) ok = put->put(put->context, &line);
  vs_polyline_free(&line);
  return ok;
}

bool vs_mesh_contour(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, const vs_line_put *put) {
  contours c = { .m = m, .height = vs_fresh(m->vertex_count + 1, sizeof *c.height),
                 .used = vs_zeros(m->triangle_count + 1, sizeof *c.used) };
  vs_bounds b = vs_mesh_bounds(m);
  double slack = 1e-12 * vs_bounds_diagonal(&b);
  vs_vec3 up = vs_v3_unit(normal);
  bool ok = c.height && c.used && vs_mesh_edges_make(&c.edges, m);
  for (size_t i = 0; ok && i < m->vertex_count; i++) {
    c.height[i] = vs_v3_dot(up, vs_v3_sub(m->vertices[i], point));
    if (fabs(c.height[i]) <= slack) c.height[i] = 0;
  }
  for (int border = 1; border >= 0; border--) /* the first pass follows contour lines that begin at a border of the
                                               * mesh; the second follows closed lines */
    for (size_t i = 0; ok && i < c.edges.edge_count; i++) {
      const vs_mesh_edge *edge = &c.edges.edges[i];
      if (border && edge->side[1] != VS_MESH_NONE) continue;
      if (!is_crossed(&c, (uint32_t)i) || c.used[edge->side[0]]) continue;
      ok = follow(&c, (uint32_t)i, edge->side[0], put);
    }
  vs_mesh_edges_free(&c.edges);
  free(c.height), free(c.used);
  return ok;
}
