/* Computes affine maps: products, inverses, rotations, scalings and mirrorings.
 *
 * Quarter turns are exact: a wall rotated by pi/2 must lie at x = 3, not at 3.0000000000000004. */
#include "model/vec.h"

static const double half_pi = 1.57079632679489661923;

void vs_sincos(double angle, double *sine, double *cosine) {
  double quarters = nearbyint(angle / half_pi);
  /* Multiples of pi/2 that are sums, such as 3*pi/4 + 3*pi/4, may be off by one or two units in the last place. They
   * still count as exact multiples. */
  if (fabs(quarters) < 1e9 && fabs(angle - quarters * half_pi) <= 4.5e-16 * fabs(angle)) {
    static const signed char sines[4] = { 0, 1, 0, -1 };
    int q = (int)fmod(quarters, 4);
    if (q < 0) q += 4;
    *sine = sines[q];
    *cosine = sines[(q + 1) & 3];
    return;
  }
  *sine = sin(angle);
  *cosine = cos(angle);
}

void vs_turn_sincos(int index, int count, double *sine, double *cosine) {
  VS_ASSERT(count > 0);
  /* Sines are computed in the first eighth of a turn and reflected into the other eighths. The corners of a polygon are
   * therefore exact mirror images of each other. */
  long long eighths, rest, n = count, i = index % n;
  if (i < 0) i += n;
  eighths = 8 * i / n;
  rest = 8 * i - eighths * n; /* rest: angle beyond whole eighths of a turn, in units of 1/(8 count) of a turn; 0 <=
                               * rest < n */
  bool odd = eighths & 1;
  double along = half_pi / 2 * ((double)(odd ? n - rest : rest) / (double)n); /* along: angle between the direction and
                                                                               * the nearest axis, 0 to pi/4 */
  double s = sin(along), c = cos(along), swap;
  if ((odd ? n - rest : rest) == n) s = c = 0.70710678118654752440;
  switch (((eighths + 1) / 2) & 3) { /* number of the axis nearest to the direction */
    case 0: if (odd) s = -s; break;
    case 1: swap = odd ? s : -s; s = c; c = swap; break;
    case 2: s = odd ? s : -s; c = -c; break;
    case 3: swap = odd ? -s : s; s = -c; c = swap; break;
  }
  *sine = s + 0.0;
  *cosine = c + 0.0;
}

double vs_single(double x) { return (double)(float)x; }

vs_vec3 vs_v3_unit(vs_vec3 v) {
  double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z), most = x > y ? x : y;
  if (z > most) most = z;
  if (!(most > 0)) return vs_v3(0, 0, 0);
  v = vs_v3(v.x / most, v.y / most, v.z / most); /* the vector is scaled first, so that no square overflows or
                                                  * underflows, and vectors along an axis remain exact */
  return vs_v3_scale(v, 1 / vs_v3_length(v));
}

vs_affine vs_affine_columns(vs_vec3 x, vs_vec3 y, vs_vec3 z, vs_vec3 at) {
  return (vs_affine){ { { x.x, y.x, z.x, at.x }, { x.y, y.y, z.y, at.y }, { x.z, y.z, z.z, at.z } } };
}

vs_affine vs_affine_multiply(const vs_affine *a, const vs_affine *b) {
  vs_affine r;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++)
      r.m[i][j] =
          a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0);
  return r;
}

double vs_affine_determinant(const vs_affine *a) {
  const double (*m)[4] = a->m;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool vs_affine_invert(const vs_affine *a, vs_affine *out) {
  const double (*m)[4] = a->m;
  double d = vs_affine_determinant(a);
  if (!(fabs(d) > 0) || !isfinite(d)) return false;
  vs_affine r;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      int p = (j + 1) % 3, q = (j + 2) % 3, s = (i + 1) % 3, t = (i + 2) % 3; /* The minors have the right sign, because
                                                                               * the indices are cyclic. */
      r.m[i][j] = (m[p][s] * m[q][t] - m[p][t] * m[q][s]) / d;
    }
  for (int i = 0; i < 3; i++) r.m[i][3] = -(r.m[i][0] * m[0][3] + r.m[i][1] * m[1][3] + r.m[i][2] * m[2][3]);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++) {
      if (!isfinite(r.m[i][j])) return false;
      r.m[i][j] += 0.0; /* adding 0.0 changes -0 to 0 in the product */
    }
  *out = r;
  return true;
}

bool vs_affine_plane(const vs_affine *a, vs_vec3 *point, vs_vec3 *normal) {
  vs_affine back;
  if (!vs_affine_invert(a, &back)) return false;
  vs_vec3 n = *normal; /* a normal is mapped by the transpose of the inverse */
  *normal = vs_v3(back.m[0][0] * n.x + back.m[1][0] * n.y + back.m[2][0] * n.z,
                  back.m[0][1] * n.x + back.m[1][1] * n.y + back.m[2][1] * n.z,
                  back.m[0][2] * n.x + back.m[1][2] * n.y + back.m[2][2] * n.z);
  *point = vs_affine_point(a, *point);
  return true;
}

bool vs_affine_is_translation(const vs_affine *a) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (a->m[i][j] != (i == j)) return false;
  return true;
}

bool vs_affine_is_identity(const vs_affine *a) {
  return vs_affine_is_translation(a) && a->m[0][3] == 0 && a->m[1][3] == 0 && a->m[2][3] == 0;
}

vs_affine vs_affine_translation(vs_vec3 v) {
  return (vs_affine){ { { 1, 0, 0, v.x }, { 0, 1, 0, v.y }, { 0, 0, 1, v.z } } };
}

/* Returns the map with linear part l and fixed point `fixed`: p -> fixed + l (p - fixed). */
static vs_affine affine_about(vs_affine l, vs_vec3 fixed) {
  vs_vec3 moved = vs_affine_vector(&l, fixed);
  l.m[0][3] = fixed.x - moved.x;
  l.m[1][3] = fixed.y - moved.y;
  l.m[2][3] = fixed.z - moved.z;
  return l;
}

vs_affine vs_affine_rotation(vs_vec3 point, vs_vec3 direction, double angle) {
  vs_vec3 u = vs_v3_unit(direction);
  double s, c;
  VS_ASSERT(direction.x != 0 || direction.y != 0 || direction.z != 0);
  vs_sincos(angle, &s, &c);
  double k = 1 - c;
  vs_affine r = { { { c + u.x * u.x * k, u.x * u.y * k - u.z * s, u.x * u.z * k + u.y * s, 0 },
                    { u.y * u.x * k + u.z * s, c + u.y * u.y * k, u.y * u.z * k - u.x * s, 0 },
                    { u.z * u.x * k - u.y * s, u.z * u.y * k + u.x * s, c + u.z * u.z * k, 0 } } };
  /* c + (1 - c) may differ from 1 by one unit in the last place. A rotation about a world axis needs exactly 1. */
  if (fabs(u.x) == 1) r.m[0][0] = 1;
  if (fabs(u.y) == 1) r.m[1][1] = 1;
  if (fabs(u.z) == 1) r.m[2][2] = 1;
  return affine_about(r, point);
}

vs_affine vs_affine_scaling(vs_vec3 center, vs_vec3 factors) {
  vs_affine r = { { { factors.x, 0, 0, 0 }, { 0, factors.y, 0, 0 }, { 0, 0, factors.z, 0 } } };
  return affine_about(r, center);
}

vs_affine vs_affine_mirror(vs_vec3 point, vs_vec3 normal) {
  vs_vec3 u = vs_v3_unit(normal);
  vs_affine r = { { { 1 - 2 * u.x * u.x, -2 * u.x * u.y, -2 * u.x * u.z, 0 },
                    { -2 * u.y * u.x, 1 - 2 * u.y * u.y, -2 * u.y * u.z, 0 },
                    { -2 * u.z * u.x, -2 * u.z * u.y, 1 - 2 * u.z * u.z, 0 } } };
  return affine_about(r, point);
}

bool vs_affine_even(const vs_affine *a, double *k) {
  vs_vec3 c[3];
  for (int j = 0; j < 3; j++) c[j] = vs_v3(a->m[0][j], a->m[1][j], a->m[2][j]);
  *k = vs_v3_length(c[0]);
  double slack = 1e-12 * *k * *k;
  for (int j = 0; j < 3; j++)
    if (fabs(vs_v3_dot(c[j], c[j]) - *k * *k) > slack || fabs(vs_v3_dot(c[j], c[(j + 1) % 3])) > slack) return false;
  return true;
}

void vs_bounds_meet(vs_bounds *b, const vs_bounds *o) {
  b->min = vs_v3(fmax(b->min.x, o->min.x), fmax(b->min.y, o->min.y), fmax(b->min.z, o->min.z));
  b->max = vs_v3(fmin(b->max.x, o->max.x), fmin(b->max.y, o->max.y), fmin(b->max.z, o->max.z));
  if (b->min.x > b->max.x || b->min.y > b->max.y || b->min.z > b->max.z) *b = vs_bounds_empty();
}

double vs_bounds_diagonal(const vs_bounds *b) {
  return vs_bounds_is_empty(b) ? 0 : vs_v3_length(vs_v3_sub(b->max, b->min));
}

vs_bounds vs_bounds_transform(const vs_bounds *b, const vs_affine *a) {
  if (vs_bounds_is_empty(b)) return *b;
  vs_bounds r;
  double lo[3] = { b->min.x, b->min.y, b->min.z }, hi[3] = { b->max.x, b->max.y, b->max.z }, low[3], high[3];
  for (int i = 0; i < 3; i++) {
    low[i] = high[i] = a->m[i][3];
    for (int j = 0; j < 3; j++) {
      if (a->m[i][j] == 0) continue; /* skips a zero element, because 0 times an infinite side of the box would be
                                      * NaN */
      double p = a->m[i][j] * lo[j], q = a->m[i][j] * hi[j];
      low[i] += fmin(p, q);
      high[i] += fmax(p, q);
    }
  }
  r.min = vs_v3(low[0], low[1], low[2]);
  r.max = vs_v3(high[0], high[1], high[2]);
  return r;
}

bool vs_affine_is_placement(const vs_affine *a) {
  vs_vec3 c[3];
  for (int i = 0; i < 3; i++) c[i] = vs_v3(a->m[0][i], a->m[1][i], a->m[2][i]);
  for (int i = 0; i < 3; i++) {
    vs_vec3 p = c[i], q = c[(i + 1) % 3];
    if (fabs(vs_v3_dot(p, q)) > 1e-9 * vs_v3_length(p) * vs_v3_length(q)) return false;
  }
  return true;
}

vs_vec3 vs_affine_normal(const vs_affine *a, vs_vec3 n) {
  vs_vec3 c0 = vs_v3(a->m[0][0], a->m[1][0], a->m[2][0]), c1 = vs_v3(a->m[0][1], a->m[1][1], a->m[2][1]),
          c2 = vs_v3(a->m[0][2], a->m[1][2], a->m[2][2]);
  vs_vec3 out = vs_v3_add(vs_v3_add(vs_v3_scale(vs_v3_cross(c1, c2), n.x), vs_v3_scale(vs_v3_cross(c2, c0), n.y)),
                          vs_v3_scale(vs_v3_cross(c0, c1), n.z));
  if (vs_affine_determinant(a) < 0) out = vs_v3_scale(out, -1);
  double length = vs_v3_length(out);
  return length > 0 ? vs_v3_scale(out, 1 / length) : n;
}

void vs_rotation_quaternion(const vs_vec3 c[3], double out[4]) {
  double m[3][3] = { { c[0].x, c[1].x, c[2].x }, { c[0].y, c[1].y, c[2].y }, { c[0].z, c[1].z, c[2].z } };
  double q[4] = { 1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                  1 - m[0][0] - m[1][1] + m[2][2] };
  int most = 0;
  for (int i = 1; i < 4; i++)
    if (q[i] > q[most]) most = i;
  double a[4]; /* quaternion w x y z before it is divided by its length */
  switch (most) {
  case 0: a[0] = q[0]; a[1] = m[2][1] - m[1][2]; a[2] = m[0][2] - m[2][0]; a[3] = m[1][0] - m[0][1]; break;
  case 1: a[0] = m[2][1] - m[1][2]; a[1] = q[1]; a[2] = m[0][1] + m[1][0]; a[3] = m[0][2] + m[2][0]; break;
  case 2: a[0] = m[0][2] - m[2][0]; a[1] = m[0][1] + m[1][0]; a[2] = q[2]; a[3] = m[1][2] + m[2][1]; break;
  default: a[0] = m[1][0] - m[0][1]; a[1] = m[0][2] + m[2][0]; a[2] = m[1][2] + m[2][1]; a[3] = q[3]; break;
  }
  double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3]);
  for (int i = 0; i < 4; i++) out[i] = a[i] / length;
}

void vs_affine_split(const vs_affine *a, vs_vec3 *translation, double quaternion[4], vs_vec3 *scale) {
  vs_vec3 c[3];
  double length[3];
  VS_ASSERT(vs_affine_is_placement(a));
  for (int i = 0; i < 3; i++) {
    c[i] = vs_v3(a->m[0][i], a->m[1][i], a->m[2][i]);
    length[i] = vs_v3_length(c[i]);
    c[i] = vs_v3_scale(c[i], 1 / length[i]);
  }
  if (vs_affine_determinant(a) < 0) {
    c[0] = vs_v3_scale(c[0], -1);
    length[0] = -length[0];
  }
  *translation = vs_v3(a->m[0][3], a->m[1][3], a->m[2][3]);
  *scale = vs_v3(length[0], length[1], length[2]);
  vs_rotation_quaternion(c, quaternion);
}
