/* Owns the cut cone; one of its radii may be 0. */
#include <math.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool cut_cone_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_cut_cone *x = VS_AS(cut_cone, n);
  vs_vec3 axis = vs_v3_sub(x->top, x->base);
  (void)e;
  vs_reach_disc(b, a, x->base, axis, x->base_radius);
  vs_reach_disc(b, a, x->top, axis, x->top_radius);
  return true;
}

static bool cut_cone_triangles(const vs_node *n, const vs_facets *f, vs_mesh *out, vs_error *e) {
  const struct vs_cut_cone *x = VS_AS(cut_cone, n);
  int turn = vs_facets_turn(f, fmax(x->base_radius, x->top_radius), x->segments);
  return vs_solid_frustum(out, x->base, x->base_radius, x->top, x->top_radius, turn, true) || vs_error_memory(e, NULL);
}

static bool cut_cone_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const struct vs_cut_cone *x = VS_AS(cut_cone, n);
  (void)area, (void)e;
  vs_frustum_measure(m, x->base, x->base_radius, x->top, x->top_radius);
  return true;
}

static bool cut_cone_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_cut_cone *x = VS_AS(cut_cone, n);
  (void)p;
  return vs_frustum_holds(q, height, x->base_radius, x->top_radius);
}

static vs_node *cut_cone_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  double k = map->scale; /* of discs */
  VS_MOVED(cut_cone,
           d.segments ? map->upright : map->even || vs_shape_map_keeps_discs(a, vs_v3_sub(d.top, d.base), &k));
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.base_radius *= k;
  d.top_radius *= k;
  return vs_node_new(s, VS_CUT_CONE, &d, NULL, 0);
}

static void cut_cone_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  *base = VS_AS(cut_cone, n)->base, *top = VS_AS(cut_cone, n)->top;
}

static vs_node *cut_cone_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_cut_cone d = *VS_AS(cut_cone, n);
  vs_vec3 along = vs_v3_scale(vs_v3_unit(vs_v3_sub(d.top, d.base)), by);
  d.base = vs_v3_sub(d.base, along), d.top = vs_v3_add(d.top, along), d.base_radius += 2 * by, d.top_radius += 2 * by;
  return vs_node_new(s, VS_CUT_CONE, &d, NULL, 0);
}

VS_SHAPE(cut_cone, cut_cone_axis, cut_cone_grown, NULL);
