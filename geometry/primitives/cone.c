/* Implements the cone. */
#include <math.h>

#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape_map.h"

static vs_node *cone_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  double k = map->scale; /* k: factor by which the map scales the radius */
  VS_MOVED(cone, d.segments ? map->upright : map->even || vs_shape_map_keeps_discs(a, vs_v3_sub(d.apex, d.base), &k));
  d.base = vs_affine_point(a, d.base);
  d.apex = vs_affine_point(a, d.apex);
  d.radius *= k;
  return vs_node_new(s, VS_CONE, &d, NULL, 0);
}

static vs_node *cone_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_cone d = *VS_AS(cone, n);
  vs_vec3 axis = vs_v3_sub(d.apex, d.base), along = vs_v3_scale(vs_v3_unit(axis), by);
  d.base = vs_v3_sub(d.base, along), d.radius += 2 * by;
  d.apex = vs_v3_add(d.apex, vs_v3_scale(along, fmin(1e3, 1 + vs_v3_length(axis) / d.radius)));
  return vs_node_new(s, VS_CONE, &d, NULL, 0);
}

VS_ROUND_SHAPE(cone);
