/* Computes ambient occlusion with rays whose directions are distributed by the cosine to the normal: points evenly
 * distributed on a unit disc are lifted onto the hemisphere (Malley's method). They come from the 8 by 8 cells of a
 * square, by a map that keeps neighbours close (Shirley and Chiu, A Low Distortion Map Between Disk and Square, Journal
 * of Graphics Tools 2(3), 1997). The points are shifted within the square, modulo its size (Cranley and Patterson,
 * 1976). */
#include "geometry/measure/openness.h"

#include <math.h>

#include "geometry/measure/scatter.h"

enum { SIDE = 8 };

/* Maps the point (u, v) of the unit square to the point (*x, *y) of the unit disc. */
static void to_disc(double u, double v, double *x, double *y) {
  const double quarter = 0.78539816339744831;
  double a = 2 * u - 1, b = 2 * v - 1;
  bool wide = fabs(a) > fabs(b);
  double radius = wide ? a : b;
  double angle = wide ? quarter * (b / a) : b != 0 ? 2 * quarter - quarter * (a / b) : 0;
  *x = radius * cos(angle), *y = radius * sin(angle);
}

double vs_openness(const vs_surrounding *s, vs_vec3 from, vs_vec3 normal, uint32_t seed) {
  vs_vec3 other = fabs(normal.z) < 0.9 ? vs_v3(0, 0, 1) : vs_v3(1, 0, 0);
  vs_vec3 right = vs_v3_unit(vs_v3_cross(other, normal)), up = vs_v3_cross(normal, right);
  double shift_u = vs_scattered(2 * seed), shift_v = vs_scattered(2 * seed + 1);
  int open = 0;
  VS_ASSERT(fabs(vs_v3_dot(normal, normal) - 1) < 1e-6);
  for (int i = 0; i < SIDE; i++)
    for (int k = 0; k < SIDE; k++) {
      double u = (i + shift_u) / SIDE, v = (k + shift_v) / SIDE, x, y, at;
      to_disc(u, v, &x, &y);
      double z = sqrt(fmax(1 - x * x - y * y, 0));
      vs_vec3 d = vs_v3_add(vs_v3_scale(normal, z), vs_v3_add(vs_v3_scale(right, x), vs_v3_scale(up, y)));
      if (d.z < 0 && from.z + s->far * d.z < s->ground) continue;
      size_t hit = vs_ray_tree_meet(s->tree, from, d, s->far, true, &at);
      open += hit == s->tree->mesh->triangle_count;
    }
  return (double)open / (SIDE * SIDE);
}
