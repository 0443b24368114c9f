/* Determines which properties of a shape, such as circles or right angles, survive an affine map, and maps arrays of
 * points. */
#include "geometry/primitives/shape_map.h"

#include <math.h>

vs_shape_map vs_shape_map_of(const vs_affine *a) {
  vs_shape_map f = { .even = true, .axes = true, .plain = true };
  vs_vec3 c[3];
  for (int j = 0; j < 3; j++) c[j] = vs_v3(a->m[0][j], a->m[1][j], a->m[2][j]);
  f.scale = vs_v3_length(c[0]);
  if (fabs(f.scale - 1) < 1e-14) f.scale = 1;
  double slack = 1e-13 * f.scale * f.scale;
  for (int j = 0; j < 3; j++) {
    bool other_length = fabs(vs_v3_dot(c[j], c[j]) - f.scale * f.scale) > slack;
    if (other_length || fabs(vs_v3_dot(c[j], c[(j + 1) % 3])) > slack) f.even = false;
    int used = (c[j].x != 0) + (c[j].y != 0) + (c[j].z != 0);
    if (used != 1) f.axes = false;
    if (used != 1 || !(a->m[j][j] > 0)) f.plain = false;
  }
  f.upright = f.even && f.plain;
  f.level = f.even && a->m[0][2] == 0 && a->m[1][2] == 0;
  f.about_z = f.level && a->m[2][2] > 0 && vs_affine_determinant(a) > 0;
  if (!(fabs(vs_affine_determinant(a)) > 0)) f = (vs_shape_map){ 0 };
  return f;
}

vs_points *vs_shape_map_points(vs_store *s, const vs_affine *a, const vs_points *old) {
  vs_points *new = vs_points_new(s, old->at, old->count);
  for (uint32_t i = 0; new && i < old->count; i++) {
    vs_vec3 p = vs_affine_point(a, old->at[i]);
    new->at[i] = vs_v3(p.x + 0.0, p.y + 0.0, p.z + 0.0);
  }
  return new;
}

bool vs_shape_map_keeps_discs(const vs_affine *a, vs_vec3 axis, double *k) {
  vs_vec3 u = vs_v3_unit(axis), p = vs_v3_unit(vs_v3_cross(u, fabs(u.x) < 0.7 ? vs_v3(1, 0, 0) : vs_v3(0, 1, 0))),
          q = vs_v3_cross(u, p);
  vs_vec3 au = vs_affine_vector(a, u), ap = vs_affine_vector(a, p), aq = vs_affine_vector(a, q);
  double square = vs_v3_dot(ap, ap), slack = 1e-13 * square, along = 1e-13 * sqrt(square) * vs_v3_length(au);
  *k = sqrt(square);
  if (fabs(*k - 1) < 1e-14) *k = 1;
  bool round = fabs(vs_v3_dot(aq, aq) - square) <= slack && fabs(vs_v3_dot(ap, aq)) <= slack;
  bool across = fabs(vs_v3_dot(ap, au)) <= along && fabs(vs_v3_dot(aq, au)) <= along;
  return square > 0 && vs_v3_dot(au, au) > 0 && round && across;
}
