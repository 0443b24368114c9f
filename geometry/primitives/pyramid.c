/* Implements the pyramid, which may be truncated. Base and top are regular n-gons with a corner in the direction +X of
 * the axis's frame. */
#include <math.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static const double pi = 3.14159265358979323846;

static bool pyramid_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  const struct vs_pyramid *x = VS_AS(pyramid, n);
  (void)f;
  vs_disc base = { x->base, x->base_radius }, top = { x->top, x->top_radius };
  return vs_solid_frustum(out, base, top, x->sides, false) || vs_error_memory(e, NULL);
}

static bool pyramid_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  static const vs_fineness any = { 1, 0 };
  vs_mesh m = { 0 };
  bool ok = pyramid_triangles(n, &any, &m, e);
  if (ok) vs_reach_points(b, a, m.vertices, m.vertex_count);
  vs_mesh_free(&m);
  return ok;
}

static bool pyramid_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const struct vs_pyramid *x = VS_AS(pyramid, n);
  (void)area, (void)e;
  vs_vec3 axis = vs_v3_sub(x->top, x->base);
  double h = vs_v3_length(axis), sides = x->sides, r = x->base_radius, s = x->top_radius, step = pi / sides;
  double polygon = sides / 2 * sin(2 * step), weight = r * r + r * s + s * s; /* polygon: area of the regular polygon
                                                                               * with this number of sides and
                                                                               * circumradius 1 */
  m->volume = polygon * h * weight / 3;
  m->area = polygon * (r * r + s * s) + sides * sin(step) * (r + s) * hypot(h, (r - s) * cos(step));
  m->centroid =
      vs_v3_add(x->base, vs_v3_scale(axis, weight > 0 ? (r * r + 2 * r * s + 3 * s * s) / (4 * weight) : 0.5));
  return true;
}

static bool pyramid_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_pyramid *x = VS_AS(pyramid, n);
  (void)p;
  if (q.z < 0 || q.z > height) return false;
  double r = x->base_radius + (x->top_radius - x->base_radius) * q.z / height, step = pi / x->sides;
  double sector = 2 * step * floor(atan2(q.y, q.x) / (2 * step)) + step;
  return q.x * cos(sector) + q.y * sin(sector) <= r * cos(step);
}

static vs_node *pyramid_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  VS_MOVED(pyramid, map->upright);
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.base_radius *= map->scale;
  d.top_radius *= map->scale;
  return vs_node_new(s, VS_PYRAMID, &d, NULL, 0);
}

static void pyramid_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  *base = VS_AS(pyramid, n)->base, *top = VS_AS(pyramid, n)->top;
}

VS_SHAPE(pyramid, pyramid_axis, NULL, NULL);
