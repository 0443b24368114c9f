/* Computes the extents of round shapes under an affine map.
 *
 * Row i of the map, a_i, determines coordinate i. A disc of radius r perpendicular to the unit vector n extends
 * r*sqrt(|a_i|^2 - (a_i.n)^2) to each side of its centre. A ball extends r*|a_i|. */
#include "geometry/measure/reach.h"

#include <math.h>

vs_vec3 vs_reach_row(const vs_affine *a, int i) { return vs_v3(a->m[i][0], a->m[i][1], a->m[i][2]); }

void vs_reach_sides(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 reach) {
  vs_vec3 c = vs_affine_point(a, center);
  vs_bounds_add(b, vs_v3_sub(c, reach));
  vs_bounds_add(b, vs_v3_add(c, reach));
}

void vs_reach_disc(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 normal, double r) {
  vs_vec3 n = vs_v3_unit(normal);
  double reach[3];
  for (int i = 0; i < 3; i++) reach[i] = r * vs_v3_length(vs_v3_cross(vs_reach_row(a, i), n));
  vs_reach_sides(b, a, center, vs_v3(reach[0], reach[1], reach[2]));
}

void vs_reach_oval(vs_bounds *b, const vs_affine *a, const vs_affine *frame, vs_vec3 center, double rx, double ry) {
  double reach[3];
  vs_vec3 x = vs_affine_vector(frame, vs_v3(rx, 0, 0)), y = vs_affine_vector(frame, vs_v3(0, ry, 0));
  for (int i = 0; i < 3; i++) reach[i] = hypot(vs_v3_dot(vs_reach_row(a, i), x), vs_v3_dot(vs_reach_row(a, i), y));
  vs_reach_sides(b, a, center, vs_v3(reach[0], reach[1], reach[2]));
}

void vs_reach_ball(vs_bounds *b, const vs_affine *a, vs_vec3 center, double ring, double r) {
  double reach[3];
  for (int i = 0; i < 3; i++) reach[i] = ring * hypot(a->m[i][0], a->m[i][1]) + r * vs_v3_length(vs_reach_row(a, i));
  vs_reach_sides(b, a, center, vs_v3(reach[0], reach[1], reach[2]));
}

void vs_reach_points(vs_bounds *b, const vs_affine *a, const vs_vec3 *at, size_t n) {
  for (size_t i = 0; i < n; i++) vs_bounds_add(b, vs_affine_point(a, at[i]));
}
