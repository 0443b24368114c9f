/* Implements the matrices of a straight member (member_matrices.h). */
#include "geometry/structure/member_matrices.h"

#include <math.h>
#include <string.h>

#define UPRIGHT 1e-6 /* a member that leans less from the vertical, in radians, is vertical */

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

/* Adds the stiffness of bending in the plane of the ways `across` and `turn`; sign is that of the slope's turn. */
static void add_bending(double ei, double l, int across, int turn, double sign, vs_member_matrix k) {
  const int at[4] = { across, turn, across + VS_WAYS, turn + VS_WAYS };
  const double shape[4][4] = { { 12, 6, -12, 6 }, { 6, 4, -6, 2 }, { -12, -6, 12, -6 }, { 6, 2, -6, 4 } };
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      int turns = i % 2 + j % 2;
      k[at[i]][at[j]] += ei / (l * l * l) * shape[i][j] * (turns == 0 ? 1 : turns == 1 ? sign * l : l * l);
    }
}

static void add_pair(double v, int a, vs_member_matrix k) {
  int b = a + VS_WAYS;
  k[a][a] += v, k[b][b] += v, k[a][b] -= v, k[b][a] -= v;
}

/* Frees way r of the ends: the member then gives it no force. */
static void release(int r, vs_member_matrix k, double f[VS_MEMBER_WAYS]) {
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

void vs_member_stiffness(const vs_structure_member *m, double l, vs_vec3 line, vs_member_matrix k,
                         double f[VS_MEMBER_WAYS]) {
  bool bends = m->bend_y > 0 && m->bend_z > 0;
  VS_ASSERT(l > 0 && m->area > 0);
  memset(k, 0, sizeof(vs_member_matrix));
  memset(f, 0, VS_MEMBER_WAYS * sizeof *f);
  add_pair(m->modulus * m->area / l, 0, k);
  const double q[3] = { line.x, line.y, line.z };
  for (int end = 0; end < 2; end++)
    for (int i = 0; i < 3; i++) f[end * VS_WAYS + i] = q[i] * l / 2;
  if (!bends) return;
  add_bending(m->modulus * m->bend_z, l, 1, 5, 1, k);
  add_bending(m->modulus * m->bend_y, l, 2, 4, -1, k);
  f[4] = -q[2] * l * l / 12, f[5] = q[1] * l * l / 12;
  f[10] = -f[4], f[11] = -f[5];
  if (!m->hinged[0] || !m->hinged[1]) add_pair(m->shear * m->twist / l, 3, k);
  for (int end = 0; end < 2; end++)
    for (int i = 4; m->hinged[end] && i < VS_WAYS; i++) release(end * VS_WAYS + i, k, f);
}

/* ---- axes ---- */

void vs_member_to_global(const vs_vec3 axes[3], const double own[VS_MEMBER_WAYS], double out[VS_MEMBER_WAYS]) {
  for (int i = 0; i < VS_MEMBER_WAYS; i += 3) {
    vs_vec3 v = vs_v3_add(vs_v3_add(vs_v3_scale(axes[0], own[i]), vs_v3_scale(axes[1], own[i + 1])),
                          vs_v3_scale(axes[2], own[i + 2]));
    out[i] = v.x, out[i + 1] = v.y, out[i + 2] = v.z;
  }
}

void vs_member_to_own(const vs_vec3 axes[3], const double global[VS_MEMBER_WAYS], double out[VS_MEMBER_WAYS]) {
  for (int i = 0; i < VS_MEMBER_WAYS; i++)
    out[i] = vs_v3_dot(axes[i % 3], vs_v3(global[i / 3 * 3], global[i / 3 * 3 + 1], global[i / 3 * 3 + 2]));
}

void vs_member_matrix_to_global(const vs_vec3 axes[3], vs_member_matrix k) {
  vs_member_matrix half;
  for (int i = 0; i < VS_MEMBER_WAYS; i++) vs_member_to_global(axes, k[i], half[i]);
  for (int j = 0; j < VS_MEMBER_WAYS; j++) {
    double column[VS_MEMBER_WAYS], turned[VS_MEMBER_WAYS];
    for (int i = 0; i < VS_MEMBER_WAYS; i++) column[i] = half[i][j];
    vs_member_to_global(axes, column, turned);
    for (int i = 0; i < VS_MEMBER_WAYS; i++) k[i][j] = turned[i];
  }
}
