/* Implements the wedge: half of a box, with full height at the least x and height 0 at the greatest x. */
#include <math.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool wedge_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_wedge *x = VS_AS(wedge, n);
  vs_vec3 at[6] = { { x->p.x, x->p.y, x->p.z }, { x->q.x, x->p.y, x->p.z }, { x->p.x, x->q.y, x->p.z },
                    { x->q.x, x->q.y, x->p.z }, { x->p.x, x->p.y, x->q.z }, { x->p.x, x->q.y, x->q.z } };
  (void)e;
  vs_reach_points(b, a, at, 6);
  return true;
}

static bool wedge_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  (void)f;
  return vs_solid_wedge(out, VS_AS(wedge, n)->p, VS_AS(wedge, n)->q) || vs_error_memory(e, NULL);
}

static bool wedge_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  vs_vec3 d = vs_v3_sub(VS_AS(wedge, n)->q, VS_AS(wedge, n)->p);
  (void)area, (void)e;
  m->volume = d.x * d.y * d.z / 2;
  m->area = d.x * d.y + d.y * d.z + d.z * d.x + d.y * hypot(d.x, d.z);
  m->centroid = vs_v3_add(VS_AS(wedge, n)->p, vs_v3(d.x / 3, d.y / 2, d.z / 3));
  return true;
}

static bool wedge_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_wedge *w = VS_AS(wedge, n);
  double x = w->q.x - w->p.x, z = w->q.z - w->p.z;
  (void)q, (void)height;
  return (p.x - w->p.x) * z + (p.z - w->p.z) * x <= x * z;
}

static vs_node *wedge_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  VS_MOVED(wedge, map->plain);
  d.p = vs_affine_point(a, d.p);
  d.q = vs_affine_point(a, d.q);
  return vs_node_new(s, VS_WEDGE, &d, NULL, 0);
}

VS_SHAPE(wedge, NULL, NULL, NULL);
