/* Owns the cylinder. */
#include "geometry/measure/reach.h"
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool cylinder_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_cylinder *x = VS_AS(cylinder, n);
  vs_vec3 axis = vs_v3_sub(x->top, x->base);
  (void)e;
  vs_reach_disc(b, a, x->base, axis, x->radius);
  vs_reach_disc(b, a, x->top, axis, x->radius);
  return true;
}

static bool cylinder_triangles(const vs_node *n, const vs_facets *f, vs_mesh *out, vs_error *e) {
  const struct vs_cylinder *x = VS_AS(cylinder, n);
  int turn = vs_facets_turn(f, x->radius, x->segments);
  return vs_solid_frustum(out, x->base, x->radius, x->top, x->radius, turn, true) || vs_error_memory(e, NULL);
}

static bool cylinder_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const struct vs_cylinder *x = VS_AS(cylinder, n);
  (void)area, (void)e;
  vs_frustum_measure(m, x->base, x->radius, x->top, x->radius);
  return true;
}

static bool cylinder_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_cylinder *x = VS_AS(cylinder, n);
  (void)p;
  return vs_frustum_holds(q, height, x->radius, x->radius);
}

static vs_node *cylinder_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  double k = map->scale; /* of discs */
  VS_MOVED(cylinder,
           d.segments ? map->upright : map->even || vs_shape_map_keeps_discs(a, vs_v3_sub(d.top, d.base), &k));
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.radius *= k;
  return vs_node_new(s, VS_CYLINDER, &d, NULL, 0);
}

static void cylinder_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  *base = VS_AS(cylinder, n)->base, *top = VS_AS(cylinder, n)->top;
}

static vs_node *cylinder_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_cylinder d = *VS_AS(cylinder, n);
  vs_vec3 along = vs_v3_scale(vs_v3_unit(vs_v3_sub(d.top, d.base)), by);
  d.base = vs_v3_sub(d.base, along), d.top = vs_v3_add(d.top, along), d.radius += by;
  return vs_node_new(s, VS_CYLINDER, &d, NULL, 0);
}

VS_SHAPE(cylinder, cylinder_axis, cylinder_grown, NULL);
