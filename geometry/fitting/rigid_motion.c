/* Computes rigid motions, and eigenvectors of small symmetric matrices (rigid_motion.h). */
#include "geometry/fitting/rigid_motion.h"

#include <string.h>

/* Sets out to the product of the 3 by 3 matrices a and b, stored row by row. out is neither a nor b. */
static void multiply(const double *a, const double *b, double *out) {
  VS_ASSERT(out != a && out != b);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) out[3 * i + k] = a[3 * i] * b[k] + a[3 * i + 1] * b[3 + k] + a[3 * i + 2] * b[6 + k];
}

/* Sets out to the matrix I + a W + b W W, where W x = w cross x. */
static void series(const double w[3], double a, double b, double out[3][3]) {
  const double cross[3][3] = { { 0, -w[2], w[1] }, { w[2], 0, -w[0] }, { -w[1], w[0], 0 } };
  double square[3][3];
  multiply(cross[0], cross[0], square[0]);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) out[i][k] = (i == k) + a * cross[i][k] + b * square[i][k];
}

static double angle_of(const double w[3]) { return sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]); }

vs_rigid_motion vs_rigid_moved(const vs_rigid_motion *m, const double unknowns[VS_RIGID_UNKNOWNS]) {
  vs_rigid_motion moved = *m;
  double w[3] = { unknowns[0] / m->size, unknowns[1] / m->size, unknowns[2] / m->size }, turn[3][3];
  double angle = angle_of(w), half = sin(angle / 2);
  VS_ASSERT(m->size > 0);
  if (angle > 1e-9)
    series(w, sin(angle) / angle, 2 * half * half / (angle * angle), turn);
  else
    series(w, 1, .5, turn);
  multiply(turn[0], m->turn[0], moved.turn[0]);
  moved.to = vs_v3_add(m->to, vs_v3(unknowns[3], unknowns[4], unknowns[5]));
  return moved;
}

void vs_rigid_jacobian(const double unknowns[VS_RIGID_UNKNOWNS], double size, double out[3][3]) {
  double w[3] = { unknowns[0] / size, unknowns[1] / size, unknowns[2] / size }, angle = angle_of(w);
  double half = sin(angle / 2);
  VS_ASSERT(size > 0);
  if (angle > 1e-4)
    series(w, 2 * half * half / (angle * angle), (angle - sin(angle)) / (angle * angle * angle), out);
  else
    series(w, .5, 1. / 6, out);
}

vs_affine vs_rigid_map(const vs_rigid_motion *m) {
  vs_affine a;
  vs_vec3 shift = vs_rigid_point(m, vs_v3(0, 0, 0));
  for (int i = 0; i < 3; i++) memcpy(a.m[i], m->turn[i], sizeof m->turn[i]);
  a.m[0][3] = shift.x, a.m[1][3] = shift.y, a.m[2][3] = shift.z;
  return a;
}

vs_affine vs_rigid_inverse(const vs_rigid_motion *m) {
  vs_affine a;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) a.m[i][k] = m->turn[k][i];
  a.m[0][3] = a.m[1][3] = a.m[2][3] = 0;
  vs_vec3 back = vs_v3_sub(m->centre, vs_affine_point(&a, m->to));
  a.m[0][3] = back.x, a.m[1][3] = back.y, a.m[2][3] = back.z;
  return a;
}

/* ---- eigenvectors of symmetric matrices ---- */

/* Rotates the axes i and k of the symmetric matrix m, which differ, so that m[i][k] becomes 0. Rotates the columns of v
 * alike. */
static void rotate_pair(double *m, double *v, size_t n, size_t i, size_t k) {
  double off = m[i * n + k];
  VS_ASSERT(i != k);
  if (off == 0) return;
  double theta = (m[k * n + k] - m[i * n + i]) / (2 * off);
  double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1)), c = 1 / sqrt(t * t + 1), s = t * c;
  for (size_t r = 0; r < n; r++) {
    double a = m[r * n + i], b = m[r * n + k];
    m[r * n + i] = c * a - s * b, m[r * n + k] = s * a + c * b;
  }
  for (size_t r = 0; r < n; r++) {
    double a = m[i * n + r], b = m[k * n + r], x = v[r * n + i], y = v[r * n + k];
    m[i * n + r] = c * a - s * b, m[k * n + r] = s * a + c * b;
    v[r * n + i] = c * x - s * y, v[r * n + k] = s * x + c * y;
  }
}

void vs_symmetric_eigen(double *m, double *v, double *values, size_t n) {
  enum { SWEEPS = 60 };
  memset(v, 0, n * n * sizeof *v);
  for (size_t i = 0; i < n; i++) v[i * n + i] = 1;
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    double off = 0, all = 0;
    for (size_t i = 0; i < n; i++)
      for (size_t k = 0; k < n; k++)
        all += m[i * n + k] * m[i * n + k], off += i != k ? m[i * n + k] * m[i * n + k] : 0;
    if (!(off > 1e-30 * all)) break;
    for (size_t i = 0; i + 1 < n; i++)
      for (size_t k = i + 1; k < n; k++) rotate_pair(m, v, n, i, k);
  }
  for (size_t i = 0; i < n; i++) values[i] = m[i * n + i];
  for (size_t i = 0; i < n; i++) { /* sorts the eigenvalues in descending order, with their eigenvectors */
    size_t best = i;
    for (size_t k = i + 1; k < n; k++)
      if (values[k] > values[best]) best = k;
    if (best == i) continue;
    double held = values[i];
    values[i] = values[best], values[best] = held;
    for (size_t r = 0; r < n; r++) held = v[r * n + i], v[r * n + i] = v[r * n + best], v[r * n + best] = held;
  }
}

void vs_point_moments_add(vs_point_moments *s, vs_vec3 p, double weight) {
  const double at[3] = { p.x, p.y, p.z };
  s->weight += weight;
  s->sum = vs_v3_add(s->sum, vs_v3_scale(p, weight));
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) s->square[i][k] += weight * at[i] * at[k];
}

void vs_point_moments_axes(const vs_point_moments *s, vs_vec3 *centre, double axes[3][3], double *spread) {
  double m[9], v[9], values[3];
  VS_ASSERT(s->weight > 0);
  *centre = vs_v3_scale(s->sum, 1 / s->weight);
  const double c[3] = { centre->x, centre->y, centre->z };
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) m[3 * i + k] = s->square[i][k] / s->weight - c[i] * c[k];
  *spread = sqrt(fmax(0, m[0] + m[4] + m[8]));
  vs_symmetric_eigen(m, v, values, 3);
  vs_vec3 a = vs_v3(v[0], v[3], v[6]), b = vs_v3(v[1], v[4], v[7]), third = vs_v3_cross(a, b);
  memcpy(axes[0], &(double[]){ a.x, a.y, a.z }, sizeof axes[0]);
  memcpy(axes[1], &(double[]){ b.x, b.y, b.z }, sizeof axes[1]);
  memcpy(axes[2], &(double[]){ third.x, third.y, third.z }, sizeof axes[2]);
}
