/* Computes the number of facets of a curve from its radius and tolerance. */
#include "geometry/tolerance.h"

enum { LEAST_TURN = 32, MOST_TURN = 4096 };

double vs_fineness_tolerance(const vs_bounds *drawing) {
  double diagonal = vs_bounds_diagonal(drawing);
  if (!(diagonal > 0) || !isfinite(diagonal)) return ldexp(1, -12);
  return ldexp(1, (int)nearbyint(log2(diagonal / 4000)));
}

int vs_fineness_turn_least(const vs_fineness *f, double r, int least) {
  VS_ASSERT(f->tolerance > 0 && least > 0);
  if (!(r > f->tolerance)) return least;
  /* n, the number of facets, is the smallest number with r (1 - cos(pi/n)) <= tolerance. */
  double half_angle = acos(1 - f->tolerance / r);
  double n = ceil(3.14159265358979323846 / half_angle - 1e-9);
  if (!(n < MOST_TURN)) return MOST_TURN;
  int whole = ((int)n + 3) / 4 * 4;
  return whole < least ? least : whole;
}

int vs_fineness_least(const vs_fineness *f) { return f->segments < 0 ? (-f->segments + 3) / 4 * 4 : LEAST_TURN; }

int vs_fineness_turn(const vs_fineness *f, double r, int segments) {
  if (!segments) segments = f->segments;
  if (segments > 0) return segments < 3 ? 3 : segments > MOST_TURN ? MOST_TURN : segments;
  return vs_fineness_turn_least(f, r, vs_fineness_least(f));
}

vs_fineness vs_fineness_placed(const vs_fineness *f, const vs_affine *a) {
  double most = 0;
  for (int j = 0; j < 3; j++) {
    double length = vs_v3_length(vs_v3(a->m[0][j], a->m[1][j], a->m[2][j]));
    if (length > most) most = length;
  }
  vs_fineness placed = *f;
  if (most > 0 && isfinite(most)) placed.tolerance = ldexp(f->tolerance, -(int)ceil(log2(most) - 1e-6));
  return placed;
}
