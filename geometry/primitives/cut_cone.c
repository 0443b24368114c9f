/* Implements the cut cone, a truncated cone; the radius of its base or top may be 0. */
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape_map.h"

static vs_node *cut_cone_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  double k = map->scale; /* k: factor by which the map scales the radii */
  VS_MOVED(cut_cone,
           d.segments ? map->upright : map->even || vs_shape_map_keeps_discs(a, vs_v3_sub(d.top, d.base), &k));
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.base_radius *= k;
  d.top_radius *= k;
  return vs_node_new(s, VS_CUT_CONE, &d, NULL, 0);
}

static vs_node *cut_cone_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_cut_cone d = *VS_AS(cut_cone, n);
  vs_vec3 along = vs_v3_scale(vs_v3_unit(vs_v3_sub(d.top, d.base)), by);
  d.base = vs_v3_sub(d.base, along), d.top = vs_v3_add(d.top, along), d.base_radius += 2 * by, d.top_radius += 2 * by;
  return vs_node_new(s, VS_CUT_CONE, &d, NULL, 0);
}

VS_ROUND_SHAPE(cut_cone);
