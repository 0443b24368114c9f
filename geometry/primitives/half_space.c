/* Implements the half-space. It is infinite, so triangles exist only for a part of it within a given box. */
#include "geometry/primitives/half_space.h"

#include <math.h>

#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

void vs_half_space_bounds(vs_bounds *b, const vs_affine *a, vs_vec3 at, vs_vec3 n) {
  *b = (vs_bounds){ { -INFINITY, -INFINITY, -INFINITY }, { INFINITY, INFINITY, INFINITY } };
  if (!vs_affine_plane(a, &at, &n) || (n.x != 0) + (n.y != 0) + (n.z != 0) != 1) return;
  if (n.x > 0) b->min.x = at.x;
  if (n.y > 0) b->min.y = at.y;
  if (n.z > 0) b->min.z = at.z;
  if (n.x < 0) b->max.x = at.x;
  if (n.y < 0) b->max.y = at.y;
  if (n.z < 0) b->max.z = at.z;
}

/* Makes a box if the plane is perpendicular to an axis. Otherwise makes a triangular prism, because three corners stay
 * in one plane when they are rounded. */
bool vs_half_space_triangles(vs_mesh *out, vs_vec3 point, vs_vec3 normal, const vs_bounds *reach) {
  vs_vec3 n = vs_v3_unit(normal);
  if (vs_bounds_is_empty(reach)) return true;
  double diagonal = vs_bounds_diagonal(reach), margin = (diagonal > 0 ? diagonal : 1) / 32, least = INFINITY,
         most = -INFINITY;
  vs_vec3 edge = vs_v3(margin, margin, margin), p = vs_v3_sub(reach->min, edge), q = vs_v3_add(reach->max, edge);
  for (int i = 0; i < 8; i++) {
    double side = vs_v3_dot(n, vs_v3_sub(vs_v3(i & 1 ? q.x : p.x, i & 2 ? q.y : p.y, i & 4 ? q.z : p.z), point));
    least = fmin(least, side);
    most = fmax(most, side);
  }
  if (most <= 0) return true;
  if (least >= 0) return vs_solid_box(out, p, q);
  if (fabs(n.x) == 1) *(n.x > 0 ? &p.x : &q.x) = point.x;
  else if (fabs(n.y) == 1) *(n.y > 0 ? &p.y : &q.y) = point.y;
  else if (fabs(n.z) == 1) *(n.z > 0 ? &p.z : &q.z) = point.z;
  else {
    vs_vec3 middle = vs_v3_scale(vs_v3_add(p, q), 0.5);
    double radius = vs_v3_length(vs_v3_sub(q, p)) / 2, height = vs_v3_dot(n, vs_v3_sub(middle, point));
    vs_vec3 base = vs_v3_sub(middle, vs_v3_scale(n, height));
    vs_vec3 top = vs_v3_add(base, vs_v3_scale(n, height + radius));
    return vs_solid_frustum(out, (vs_disc){ base, 2 * radius }, (vs_disc){ top, 2 * radius }, 3, false);
  }
  return vs_solid_box(out, p, q);
}

static bool half_space_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  (void)e;
  vs_half_space_bounds(b, a, VS_AS(half_space, n)->point, VS_AS(half_space, n)->normal);
  return true;
}

static bool half_space_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  (void)n, (void)f, (void)out;
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "a half-space is endless: it has no faces of its own");
}

static bool half_space_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  (void)n, (void)area, (void)e;
  m->known = false;
  return true;
}

static bool half_space_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  (void)q, (void)height;
  return vs_v3_dot(VS_AS(half_space, n)->normal, vs_v3_sub(p, VS_AS(half_space, n)->point)) >= 0;
}

static vs_node *half_space_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map,
                                 bool *fits) {
  (void)map;
  VS_MOVED(half_space, vs_affine_plane(a, &d.point, &d.normal));
  return vs_node_new(s, VS_HALF_SPACE, &d, NULL, 0);
}

static vs_node *half_space_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_half_space d = *VS_AS(half_space, n);
  d.point = vs_v3_sub(d.point, vs_v3_scale(vs_v3_unit(d.normal), by));
  return vs_node_new(s, VS_HALF_SPACE, &d, NULL, 0);
}

VS_SHAPE(half_space, NULL, half_space_grown, NULL);
