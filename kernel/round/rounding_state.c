/* Computes the units of the formats' numbers, and the effect of rounding on a single triangle (rounding_state.h). */
#include "kernel/round/rounding_state.h"

#include <math.h>

#include "kernel/exact/digits.h"

bool vs_rounding_find_shells(vs_rounding *s) {
  return s->shells.of || (vs_shells_find(s->m, &s->shells) && vs_kernel_report(s->k, 1));
}

double vs_rounding_unit(double x, vs_numbers numbers) {
  int exponent;
  if (x == 0) return 0;
  if (numbers == VS_NUMBERS_DIGITS) return pow(10, floor(log10(fabs(x))) - 11);
  frexp(x, &exponent);
  enum { SINGLE = 24, DOUBLE = 51 /* number of significant bits of the numbers; a double has 53, of which two may be
                                   * lost when coordinates are mapped from the cluster's frame */ };
  return ldexp(1, exponent - (numbers == VS_NUMBERS_SINGLE ? SINGLE : DOUBLE));
}

static double larger(double a, double b) { return a > b ? a : b; }
double vs_rounding_reach(vs_vec3 p) { return larger(larger(fabs(p.x), fabs(p.y)), fabs(p.z)); }

double vs_rounding_unit_at(const vs_rounding *s, uint32_t v) {
  VS_ASSERT(v < s->m->vertex_count);
  return vs_rounding_unit(vs_rounding_reach(s->m->vertices[v]), s->numbers);
}

static double rounded(double x, vs_numbers numbers) {
  switch (numbers) {
  case VS_NUMBERS_SINGLE: case VS_NUMBERS_LOOSE: return vs_single(x);
  case VS_NUMBERS_DIGITS: return vs_digits_rounded(x);
  case VS_NUMBERS_DOUBLE: break;
  }
  return x;
}
vs_vec3 vs_rounding_corner(const vs_rounding *s, uint32_t v) {
  vs_vec3 p = s->m->vertices[v];
  return vs_v3(rounded(p.x, s->numbers), rounded(p.y, s->numbers), rounded(p.z, s->numbers));
}

int vs_rounding_longest(const vs_rounding *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  const vs_vec3 *x = s->m->vertices;
  double length[3];
  VS_ASSERT(t < s->m->triangle_count);
  for (int j = 0; j < 3; j++) length[j] = vs_v3_length(vs_v3_sub(x[v[(j + 1) % 3]], x[v[j]]));
  return length[0] >= length[1] && length[0] >= length[2] ? 0 : length[1] >= length[2] ? 1 : 2;
}

double vs_rounding_height(vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  double longest =
      fmax(vs_v3_length(vs_v3_sub(b, a)), fmax(vs_v3_length(vs_v3_sub(c, b)), vs_v3_length(vs_v3_sub(a, c))));
  return longest > 0 ? vs_v3_length(vs_rounding_normal(a, b, c)) / longest : 0;
}

bool vs_rounding_bends(const vs_rounding *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  const vs_vec3 *x = s->m->vertices;
  vs_vec3 n = vs_rounding_normal(x[v[0]], x[v[1]], x[v[2]]),
          r = vs_rounding_normal(vs_rounding_corner(s, v[0]), vs_rounding_corner(s, v[1]), vs_rounding_corner(s, v[2]));
  return !(vs_v3_dot(n, r) > 0.999 * vs_v3_length(n) * vs_v3_length(r));
}

/* Returns true if the triangle is lower than the distance by which rounding to these numbers may move its corners. */
static bool too_thin(const vs_rounding *s, uint32_t t, vs_numbers numbers) {
  const uint32_t *v = s->m->triangles[t];
  vs_vec3 a = s->m->vertices[v[0]], b = s->m->vertices[v[1]], c = s->m->vertices[v[2]], ab = vs_v3_sub(b, a),
          bc = vs_v3_sub(c, b), ca = vs_v3_sub(a, c), n = vs_v3_cross(ab, bc);
  double longest = larger(vs_v3_dot(ab, ab), larger(vs_v3_dot(bc, bc), vs_v3_dot(ca, ca))), square = vs_v3_dot(n, n);
  if (square >= s->coarsest * s->coarsest * longest) return false; /* a triangle higher than this bound is high enough
                                                                    * in any format; nearly all triangles are */
  double most = larger(larger(vs_rounding_reach(a), vs_rounding_reach(b)), vs_rounding_reach(c)),
         least = 2 * vs_rounding_unit(most, numbers);
  return square < least * least * longest;
}

bool vs_rounding_is_noise(const vs_rounding *s, uint32_t t) {
  return too_thin(s, t, s->numbers) && (vs_rounding_bends(s, t) || too_thin(s, t, VS_NUMBERS_DOUBLE));
}
