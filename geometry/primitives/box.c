/* Implements the box. */
#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool box_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_box *x = VS_AS(box, n);
  (void)e;
  for (int i = 0; i < 8; i++) {
    vs_vec3 corner = vs_v3(i & 1 ? x->q.x : x->p.x, i & 2 ? x->q.y : x->p.y, i & 4 ? x->q.z : x->p.z);
    vs_bounds_add(b, vs_affine_point(a, corner));
  }
  return true;
}

static bool box_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  (void)f;
  return vs_solid_box(out, VS_AS(box, n)->p, VS_AS(box, n)->q) || vs_error_memory(e, NULL);
}

static bool box_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  vs_vec3 d = vs_v3_sub(VS_AS(box, n)->q, VS_AS(box, n)->p);
  (void)area, (void)e;
  m->volume = d.x * d.y * d.z;
  m->area = 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
  m->centroid = vs_v3_add(VS_AS(box, n)->p, vs_v3_scale(d, 0.5));
  return true;
}

static bool box_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  (void)n, (void)p, (void)q, (void)height;
  return true; /* The bounds of a box are the box itself. The caller has found p within the bounds, so p is inside. */
}

static vs_node *box_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  VS_MOVED(box, map->axes);
  vs_bounds b = vs_bounds_empty();
  vs_bounds_add(&b, vs_affine_point(a, d.p));
  vs_bounds_add(&b, vs_affine_point(a, d.q));
  d.p = b.min;
  d.q = b.max;
  return vs_node_new(s, VS_BOX, &d, NULL, 0);
}

static vs_node *box_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_box d = *VS_AS(box, n);
  vs_vec3 all = vs_v3(by, by, by);
  d.p = vs_v3_sub(d.p, all), d.q = vs_v3_add(d.q, all);
  return vs_node_new(s, VS_BOX, &d, NULL, 0);
}

VS_SHAPE(box, NULL, box_grown, NULL);
