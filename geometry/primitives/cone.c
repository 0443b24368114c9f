/* Owns the cone. */
#include <math.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool cone_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_cone *x = VS_AS(cone, n);
  (void)e;
  vs_reach_disc(b, a, x->base, vs_v3_sub(x->apex, x->base), x->radius);
  vs_bounds_add(b, vs_affine_point(a, x->apex));
  return true;
}

static bool cone_triangles(const vs_node *n, const vs_facets *f, vs_mesh *out, vs_error *e) {
  const struct vs_cone *x = VS_AS(cone, n);
  int turn = vs_facets_turn(f, x->radius, x->segments);
  return vs_solid_frustum(out, x->base, x->radius, x->apex, 0, turn, true) || vs_error_memory(e, NULL);
}

static bool cone_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const struct vs_cone *x = VS_AS(cone, n);
  (void)area, (void)e;
  vs_frustum_measure(m, x->base, x->radius, x->apex, 0);
  return true;
}

static bool cone_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_cone *x = VS_AS(cone, n);
  (void)p;
  return vs_frustum_holds(q, height, x->radius, 0);
}

static vs_node *cone_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  double k = map->scale; /* of discs */
  VS_MOVED(cone, d.segments ? map->upright : map->even || vs_shape_map_keeps_discs(a, vs_v3_sub(d.apex, d.base), &k));
  d.base = vs_affine_point(a, d.base);
  d.apex = vs_affine_point(a, d.apex);
  d.radius *= k;
  return vs_node_new(s, VS_CONE, &d, NULL, 0);
}

static void cone_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  *base = VS_AS(cone, n)->base, *top = VS_AS(cone, n)->apex;
}

static vs_node *cone_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_cone d = *VS_AS(cone, n);
  vs_vec3 axis = vs_v3_sub(d.apex, d.base), along = vs_v3_scale(vs_v3_unit(axis), by);
  d.base = vs_v3_sub(d.base, along), d.radius += 2 * by;
  d.apex = vs_v3_add(d.apex, vs_v3_scale(along, fmin(1e3, 1 + vs_v3_length(axis) / d.radius)));
  return vs_node_new(s, VS_CONE, &d, NULL, 0);
}

VS_SHAPE(cone, cone_axis, cone_grown, NULL);
