/* Implements the cylinder. */
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape_map.h"

static vs_node *cylinder_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  double k = map->scale; /* k: factor by which the map scales the radius */
  VS_MOVED(cylinder,
           d.segments ? map->upright : map->even || vs_shape_map_keeps_discs(a, vs_v3_sub(d.top, d.base), &k));
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.radius *= k;
  return vs_node_new(s, VS_CYLINDER, &d, NULL, 0);
}

static vs_node *cylinder_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_cylinder d = *VS_AS(cylinder, n);
  vs_vec3 along = vs_v3_scale(vs_v3_unit(vs_v3_sub(d.top, d.base)), by);
  d.base = vs_v3_sub(d.base, along), d.top = vs_v3_add(d.top, along), d.radius += by;
  return vs_node_new(s, VS_CYLINDER, &d, NULL, 0);
}

VS_ROUND_SHAPE(cylinder);
