/* Owns formulas that several round shapes share. */
#include "geometry/primitives/round_formulas.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

void vs_frustum_measure(vs_measure *m, vs_vec3 base, double r, vs_vec3 top, double s) {
  vs_vec3 axis = vs_v3_sub(top, base);
  double h = vs_v3_length(axis), weight = r * r + r * s + s * s;
  m->volume = pi * h * weight / 3;
  m->area = pi * (r * r + s * s + (r + s) * hypot(h, r - s));
  m->centroid = vs_v3_add(base, vs_v3_scale(axis, weight > 0 ? (r * r + 2 * r * s + 3 * s * s) / (4 * weight) : 0.5));
}

bool vs_frustum_holds(vs_vec3 q, double height, double base_radius, double top_radius) {
  if (q.z < 0 || q.z > height) return false;
  double r = base_radius + (top_radius - base_radius) * q.z / height;
  return q.x * q.x + q.y * q.y <= r * r;
}

/* By the arithmetic-geometric mean: 2 pi (a^2 - sum of 2^(k-1) c_k^2) / agm(a, b). */
double vs_ellipse_length(double a, double b) {
  double x = fmax(a, b), y = fmin(a, b), sum = 0, weight = 0.5;
  if (!(y > 1e-300)) return 4 * x;
  for (double c = sqrt((x - y) * (x + y)), square = x * x;; weight *= 2) {
    sum += weight * c * c;
    if (fabs(c) <= 1e-15 * x) return 2 * pi * (square - sum) / x;
    double mean = (x + y) / 2;
    c = (x - y) / 2;
    y = sqrt(x * y);
    x = mean;
  }
}
