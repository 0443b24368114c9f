/* Implements the matrices of a straight member (member_matrices.h). */
#include "geometry/structure/member_matrices.h"

#include <math.h>
#include <string.h>

#define UPRIGHT 1e-6 /* angle from the vertical, in radians, below which a member counts as vertical */

double vs_member_axes(vs_vec3 from, vs_vec3 to, double roll, vs_vec3 axes[3]) {
  vs_vec3 along = vs_v3_sub(to, from);
  double length = vs_v3_length(along), flat = hypot(along.x, along.y);
  VS_ASSERT(length > 0);
  vs_vec3 x = vs_v3_scale(along, 1 / length);
  vs_vec3 y = flat > UPRIGHT * length ? vs_v3(-along.y / flat, along.x / flat, 0) : vs_v3(0, 1, 0);
  vs_vec3 z = vs_v3_cross(x, y);
  z = vs_v3_scale(z, 1 / vs_v3_length(z));
  y = vs_v3_cross(z, x);
  axes[0] = x;
  axes[1] = vs_v3_add(vs_v3_scale(y, cos(roll)), vs_v3_scale(z, sin(roll)));
  axes[2] = vs_v3_sub(vs_v3_scale(z, cos(roll)), vs_v3_scale(y, sin(roll)));
  return length;
}

/* ---- stiffness ---- */

/* Adds `by` times `shape`, a matrix of bending in one plane, to the member's matrix a. across, turn: degrees of freedom
 * for displacement and rotation in this plane. Entries for rotations are also multiplied by the length l. */
static void add_shape(double by, double l, const double shape[4][4], int across, int turn, double sign,
                      vs_member_matrix a) {
  const int at[4] = { across, turn, across + VS_WAYS, turn + VS_WAYS };
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      int turns = i % 2 + j % 2;
      a[at[i]][at[j]] += by * shape[i][j] * (turns == 0 ? 1 : turns == 1 ? sign * l : l * l);
    }
}

/* Adds the stiffness of bending in one plane to k. across, turn: degrees of freedom for displacement and rotation in
 * this plane; sign: 1 if a positive rotation increases the slope, else -1. */
static void add_bending(double ei, double l, int across, int turn, double sign, vs_member_matrix k) {
  const double shape[4][4] = { { 12, 6, -12, 6 }, { 6, 4, -6, 2 }, { -12, -6, 12, -6 }, { 6, 2, -6, 4 } };
  add_shape(ei / (l * l * l), l, shape, across, turn, sign, k);
}

static void add_pair(double v, int a, vs_member_matrix k) {
  int b = a + VS_WAYS;
  k[a][a] += v, k[b][b] += v, k[a][b] -= v, k[b][a] -= v;
}

/* Eliminates degree of freedom r from the stiffness k and the forces f, so that the member exerts no force on it (a
 * hinge). If t is not NULL, multiplies t by the matrix that computes all movements, including that of r, from the
 * remaining ones. */
static void release(int r, vs_member_matrix k, double f[VS_MEMBER_WAYS], vs_member_matrix t) {
  for (int i = 0; t && i < VS_MEMBER_WAYS; i++) {
    double turned = t[i][r];
    for (int j = 0; j < VS_MEMBER_WAYS; j++)
      t[i][j] = j == r ? 0 : t[i][j] - (k[r][r] > 0 ? turned * k[r][j] / k[r][r] : 0);
  }
  double pivot = k[r][r];
  for (int i = 0; pivot > 0 && i < VS_MEMBER_WAYS; i++) {
    if (i == r) continue;
    double share = k[i][r] / pivot;
    for (int j = 0; j < VS_MEMBER_WAYS; j++) k[i][j] -= share * k[r][j];
    f[i] -= share * f[r];
  }
  for (int i = 0; i < VS_MEMBER_WAYS; i++) k[i][r] = k[r][i] = 0;
  f[r] = 0;
}

static bool bends_at_all(const vs_structure_member *m) { return m->bend_y > 0 && m->bend_z > 0; }

static void stiffness(const vs_structure_member *m, double l, vs_vec3 line, vs_member_matrix k,
                      double f[VS_MEMBER_WAYS], vs_member_matrix t) {
  VS_ASSERT(l > 0 && m->area > 0);
  memset(k, 0, sizeof(vs_member_matrix));
  memset(f, 0, VS_MEMBER_WAYS * sizeof *f);
  add_pair(m->modulus * m->area / l, 0, k);
  const double q[3] = { line.x, line.y, line.z };
  for (int end = 0; end < 2; end++)
    for (int i = 0; i < 3; i++) f[end * VS_WAYS + i] = q[i] * l / 2;
  if (!bends_at_all(m)) return;
  add_bending(m->modulus * m->bend_z, l, 1, 5, 1, k);
  add_bending(m->modulus * m->bend_y, l, 2, 4, -1, k);
  f[4] = -q[2] * l * l / 12, f[5] = q[1] * l * l / 12;
  f[10] = -f[4], f[11] = -f[5];
  if (!m->hinged[0] || !m->hinged[1]) add_pair(m->shear * m->twist / l, 3, k);
  for (int end = 0; end < 2; end++)
    for (int i = 4; m->hinged[end] && i < VS_WAYS; i++) release(end * VS_WAYS + i, k, f, t);
}

void vs_member_stiffness(const vs_structure_member *m, double l, vs_vec3 line, vs_member_matrix k,
                         double f[VS_MEMBER_WAYS]) {
  stiffness(m, l, line, k, f, NULL);
}

/* ---- axial forces and masses ---- */

/* Replaces a by t' a t, where t computes the movements of the member's ends at its hinges from the other movements.
 * Does nothing without hinges. */
static void consider_hinges(const vs_structure_member *m, double l, vs_member_matrix a) {
  vs_member_matrix k, t, half;
  double f[VS_MEMBER_WAYS];
  if (!bends_at_all(m) || (!m->hinged[0] && !m->hinged[1])) return;
  for (int i = 0; i < VS_MEMBER_WAYS; i++)
    for (int j = 0; j < VS_MEMBER_WAYS; j++) t[i][j] = i == j;
  stiffness(m, l, vs_v3(0, 0, 0), k, f, t);
  for (int i = 0; i < VS_MEMBER_WAYS; i++)
    for (int j = 0; j < VS_MEMBER_WAYS; j++) {
      half[i][j] = 0;
      for (int n = 0; n < VS_MEMBER_WAYS; n++) half[i][j] += a[i][n] * t[n][j];
    }
  for (int i = 0; i < VS_MEMBER_WAYS; i++)
    for (int j = 0; j < VS_MEMBER_WAYS; j++) {
      a[i][j] = 0;
      for (int n = 0; n < VS_MEMBER_WAYS; n++) a[i][j] += t[n][i] * half[n][j];
    }
}

void vs_member_geometric(const vs_structure_member *m, double l, double force, vs_member_matrix a) {
  const double bent[4][4] = { { 36, 3, -36, 3 }, { 3, 4, -3, -1 }, { -36, -3, 36, -3 }, { 3, -1, -3, 4 } };
  memset(a, 0, sizeof(vs_member_matrix));
  if (bends_at_all(m)) {
    add_shape(force / (30 * l), l, bent, 1, 5, 1, a);
    add_shape(force / (30 * l), l, bent, 2, 4, -1, a);
    consider_hinges(m, l, a);
  } else {
    add_pair(force / l, 1, a), add_pair(force / l, 2, a);
  }
}

void vs_member_arms_geometric(const vs_structure_member *m, const vs_vec3 axes[3], double force, vs_member_matrix a) {
  for (int end = 0; end < 2; end++) {
    vs_vec3 arm = m->offset[end], f = vs_v3_scale(axes[0], end ? force : -force);
    const double e[3] = { arm.x, arm.y, arm.z }, g[3] = { f.x, f.y, f.z };
    int turn = end * VS_WAYS + 3;
    /* a rotation r moves the end by r x (r x e) / 2 beyond the linear part; the force g does work on this */
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        a[turn + i][turn + j] += (g[i] * e[j] + e[i] * g[j]) / 2 - (i == j ? vs_v3_dot(arm, f) : 0);
  }
}

/* Adds to k the matrix of a quantity (mass) in degree of freedom a of both ends; the movement varies linearly between
 * the ends. whole: total quantity. */
static void add_linear(double whole, int a, vs_member_matrix k) {
  int b = a + VS_WAYS;
  k[a][a] += whole / 3, k[b][b] += whole / 3, k[a][b] += whole / 6, k[b][a] += whole / 6;
}

void vs_member_mass(const vs_structure_member *m, double l, double mass, vs_member_matrix a) {
  const double bent[4][4] = { { 156, 22, 54, -13 }, { 22, 4, 13, -3 }, { 54, 13, 156, -22 }, { -13, -3, -22, 4 } };
  memset(a, 0, sizeof(vs_member_matrix));
  add_linear(mass, 0, a);
  if (bends_at_all(m)) {
    add_shape(mass / 420, l, bent, 1, 5, 1, a);
    add_shape(mass / 420, l, bent, 2, 4, -1, a);
    add_linear(mass * (m->bend_y + m->bend_z) / m->area, 3, a);
    consider_hinges(m, l, a);
  } else {
    add_linear(mass, 1, a), add_linear(mass, 2, a);
  }
}

/* ---- axes ---- */

void vs_member_to_nodes(const vs_structure_member *m, const vs_vec3 axes[3], const double own[VS_MEMBER_WAYS],
                        double out[VS_MEMBER_WAYS]) {
  vs_vec3 force = vs_v3(0, 0, 0);
  for (int i = 0; i < VS_MEMBER_WAYS; i += 3) {
    vs_vec3 v = vs_v3_add(vs_v3_add(vs_v3_scale(axes[0], own[i]), vs_v3_scale(axes[1], own[i + 1])),
                          vs_v3_scale(axes[2], own[i + 2]));
    if (i % VS_WAYS == 0) force = v;
    else v = vs_v3_add(v, vs_v3_cross(m->offset[i / VS_WAYS], force));
    out[i] = v.x, out[i + 1] = v.y, out[i + 2] = v.z;
  }
}

vs_vec3 vs_member_end(const double node[VS_WAYS], vs_vec3 offset) {
  return vs_v3_add(vs_v3(node[0], node[1], node[2]), vs_v3_cross(vs_v3(node[3], node[4], node[5]), offset));
}

void vs_member_from_nodes(const vs_structure_member *m, const vs_vec3 axes[3], const double moved[VS_MEMBER_WAYS],
                          double out[VS_MEMBER_WAYS]) {
  for (int end = 0; end < 2; end++) {
    const double *node = moved + end * VS_WAYS;
    vs_vec3 path = vs_member_end(node, m->offset[end]), turn = vs_v3(node[3], node[4], node[5]);
    for (int i = 0; i < 3; i++) {
      out[end * VS_WAYS + i] = vs_v3_dot(axes[i], path);
      out[end * VS_WAYS + 3 + i] = vs_v3_dot(axes[i], turn);
    }
  }
}

void vs_member_matrix_to_nodes(const vs_structure_member *m, const vs_vec3 axes[3], vs_member_matrix k) {
  vs_member_matrix half;
  for (int i = 0; i < VS_MEMBER_WAYS; i++) vs_member_to_nodes(m, axes, k[i], half[i]);
  for (int j = 0; j < VS_MEMBER_WAYS; j++) {
    double column[VS_MEMBER_WAYS], turned[VS_MEMBER_WAYS];
    for (int i = 0; i < VS_MEMBER_WAYS; i++) column[i] = half[i][j];
    vs_member_to_nodes(m, axes, column, turned);
    for (int i = 0; i < VS_MEMBER_WAYS; i++) k[i][j] = turned[i];
  }
}
