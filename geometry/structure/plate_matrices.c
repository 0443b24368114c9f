/* Implements the matrices of a triangle of a shell. In its plane: C. A. Felippa, "A study of optimal membrane triangles
 * with drilling freedoms", 2003. Across it: J.-L. Batoz, K.-J. Bathe, L.-W. Ho, "A study of three-node triangular plate
 * bending elements", 1980. */
#include "geometry/structure/plate_matrices.h"

#include <math.h>
#include <string.h>

enum { CORNERS = 3, OWN = 9 }; /* OWN: number of degrees of freedom for forces in the plane, and also for bending: three
                                * for each corner */

/* A triangle of a shell, in the coordinates of its own plane. */
typedef struct {
  double x[CORNERS], y[CORNERS], area;
  double elastic[3][3]; /* matrix that converts strains to stresses */
} flat;

double vs_plate_axes(const vs_vec3 at[3], vs_vec3 axes[3]) {
  vs_vec3 n = vs_v3_cross(vs_v3_sub(at[1], at[0]), vs_v3_sub(at[2], at[0]));
  double twice = vs_v3_length(n);
  if (!(twice > 0)) return 0;
  axes[2] = vs_v3_scale(n, 1 / twice);
  vs_vec3 along = fabs(axes[2].x) < 1 - 1e-6 ? vs_v3(1, 0, 0) : vs_v3(0, 1, 0);
  along = vs_v3_sub(along, vs_v3_scale(axes[2], vs_v3_dot(along, axes[2])));
  axes[0] = vs_v3_scale(along, 1 / vs_v3_length(along));
  axes[1] = vs_v3_cross(axes[2], axes[0]);
  return twice / 2;
}

static void make_flat(const vs_structure_plate *p, const vs_vec3 at[3], vs_vec3 axes[3], flat *t) {
  *t = (flat){ .area = vs_plate_axes(at, axes) };
  for (int i = 0; i < CORNERS; i++) {
    vs_vec3 d = vs_v3_sub(at[i], at[0]);
    t->x[i] = vs_v3_dot(d, axes[0]), t->y[i] = vs_v3_dot(d, axes[1]);
  }
  double e = p->modulus / (1 - p->poisson * p->poisson);
  t->elastic[0][0] = t->elastic[1][1] = e;
  t->elastic[0][1] = t->elastic[1][0] = e * p->poisson;
  t->elastic[2][2] = e * (1 - p->poisson) / 2;
}

/* Adds scale * b^T d b to k, for b with three rows. */
static void add_product(double k[OWN][OWN], double b[3][OWN], double d[3][3], double scale) {
  double db[3][OWN] = { { 0 } };
  for (int r = 0; r < 3; r++)
    for (int j = 0; j < OWN; j++)
      for (int s = 0; s < 3; s++) db[r][j] += d[r][s] * b[s][j];
  for (int i = 0; i < OWN; i++)
    for (int j = 0; j < OWN; j++)
      for (int r = 0; r < 3; r++) k[i][j] += scale * b[r][i] * db[r][j];
}

/* ---- forces in the plane: at each corner the movements along x and y, and the rotation about z ---- */

/* Sets b to the matrix that computes the mean strains of the triangle from its degrees of freedom in the plane. */
static void mean_strains(const flat *t, double b[3][OWN]) {
  const double share = 1.5; /* weight of the corners' rotations in the mean strains: Felippa's optimal alpha */
  memset(b, 0, sizeof(double[3][OWN]));
  for (int i = 0; i < CORNERS; i++) {
    int j = (i + 1) % CORNERS, k = (i + 2) % CORNERS;
    double y_jk = t->y[j] - t->y[k], x_kj = t->x[k] - t->x[j], x_ij = t->x[i] - t->x[j], y_ji = t->y[j] - t->y[i];
    double x_ki = t->x[k] - t->x[i], y_ik = t->y[i] - t->y[k], half = 1 / (2 * t->area);
    b[0][3 * i] = b[2][3 * i + 1] = y_jk * half;
    b[1][3 * i + 1] = b[2][3 * i] = x_kj * half;
    b[0][3 * i + 2] = share / 6 * y_jk * (y_ik - y_ji) * half;
    b[1][3 * i + 2] = share / 6 * x_kj * (x_ki - x_ij) * half;
    b[2][3 * i + 2] = share / 3 * (x_ki * y_ik - x_ij * y_ji) * half;
  }
}

/* Sets c to the matrix that computes, from the degrees of freedom in the plane, the corners' rotations relative to the
 * rotation of the triangle with straight sides. */
static void own_rotations(const flat *t, double c[3][OWN]) {
  memset(c, 0, sizeof(double[3][OWN]));
  for (int r = 0; r < 3; r++) {
    for (int i = 0; i < CORNERS; i++) {
      int j = (i + 1) % CORNERS, k = (i + 2) % CORNERS;
      c[r][3 * i] = (t->x[k] - t->x[j]) / (4 * t->area);
      c[r][3 * i + 1] = (t->y[k] - t->y[j]) / (4 * t->area);
    }
    c[r][3 * r + 2] = 1;
  }
}

/* Sets natural to the elasticity matrix for strains along the three sides of the triangle. */
static void natural_elasticity(const flat *t, double natural[3][3]) {
  double side[3], to[3][3], half[3][3];
  for (int k = 0; k < 3; k++) { /* column k belongs to the side from corner k to corner k + 1 */
    int i = k, j = (k + 1) % 3, l = (k + 2) % 3;
    side[k] = pow(t->x[j] - t->x[i], 2) + pow(t->y[j] - t->y[i], 2);
    double factor = side[k] / (4 * t->area * t->area), x_jl = t->x[j] - t->x[l], y_jl = t->y[j] - t->y[l];
    double x_il = t->x[i] - t->x[l], y_il = t->y[i] - t->y[l];
    to[0][k] = y_jl * y_il * factor;
    to[1][k] = x_jl * x_il * factor;
    to[2][k] = -(y_jl * x_il + x_jl * y_il) * factor;
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      half[i][j] = 0;
      for (int r = 0; r < 3; r++) half[i][j] += t->elastic[i][r] * to[r][j];
    }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      natural[i][j] = 0;
      for (int r = 0; r < 3; r++) natural[i][j] += to[r][i] * half[r][j];
    }
}

/* Adds to k the stiffness of higher order: of the strains along the sides that the corners' own rotations cause. */
static void add_higher(const flat *t, double thickness, double poisson, double k[OWN][OWN]) {
  static const double beta[3][3][3] = { /* beta[corner]: factors that convert the corners' rotations to the strains
                                         * along the three sides */
    { { 1, 2, 1 }, { 0, 1, -1 }, { -1, -1, -2 } },
    { { -2, -1, -1 }, { 1, 1, 2 }, { -1, 0, 1 } },
    { { 1, -1, 0 }, { -1, -2, -1 }, { 2, 1, 1 } },
  };
  double natural[3][3], c[3][OWN], spin[3][3] = { { 0 } }, weight = 0.75 * fmax((1 - 4 * poisson * poisson) / 2, 0.01);
  natural_elasticity(t, natural);
  own_rotations(t, c);
  for (int m = 0; m < 3; m++) { /* for the middle of each side */
    double q[3][3];
    for (int r = 0; r < 3; r++) {
      int j = (r + 1) % 3;
      double side = pow(t->x[j] - t->x[r], 2) + pow(t->y[j] - t->y[r], 2);
      for (int s = 0; s < 3; s++) q[r][s] = t->area / 3 * (beta[m][r][s] + beta[(m + 1) % 3][r][s]) / side;
    }
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        for (int r = 0; r < 3; r++)
          for (int s = 0; s < 3; s++) spin[i][j] += weight * t->area * thickness * q[r][i] * natural[r][s] * q[s][j];
  }
  add_product(k, c, spin, 1);
}

/* ---- bending: at each corner the movement along z, and the rotations about x and y ---- */

/* Sets h to the rotations of the triangle's normal: first at the corners, then at the middles of the opposite sides.
 * h[n][0] is about y, h[n][1] about -x. Along a side, the rotations follow from a cubic deflection; across it they are
 * linear. */
static void normal_rotations(const flat *t, double h[6][2][OWN]) {
  memset(h, 0, sizeof(double[6][2][OWN]));
  for (int i = 0; i < CORNERS; i++) h[i][0][3 * i + 2] = 1, h[i][1][3 * i + 1] = -1;
  for (int n = 0; n < CORNERS; n++) {
    int i = (n + 1) % CORNERS, j = (n + 2) % CORNERS;
    double x = t->x[j] - t->x[i], y = t->y[j] - t->y[i], long2 = x * x + y * y;
    double along[OWN] = { 0 }, across[OWN] = { 0 }; /* rotations at the middle of a side, along it and across it, each
                                                     * times the side's length */
    along[3 * i] = 1.5, along[3 * j] = -1.5;
    for (int end = 0; end < 2; end++) {
      int at = end ? j : i;
      along[3 * at + 1] = y / 4, along[3 * at + 2] = -x / 4;
      across[3 * at + 1] = -x / 2, across[3 * at + 2] = -y / 2;
    }
    for (int a = 0; a < OWN; a++) {
      h[3 + n][0][a] = (along[a] * x - across[a] * y) / long2;
      h[3 + n][1][a] = (along[a] * y + across[a] * x) / long2;
    }
  }
}

/* Sets b to the matrix of the curvatures at the place of the triangle with the barycentric coordinates `share`. */
static void curvatures(const flat *t, double h[6][2][OWN], const double share[CORNERS], double b[3][OWN]) {
  memset(b, 0, sizeof(double[3][OWN]));
  for (int n = 0; n < 6; n++) {
    double dx = 0, dy = 0; /* derivatives of the quadratic function that is 1 at place n and 0 at the other five */
    for (int c = 0; c < CORNERS; c++) {
      int j = (c + 1) % CORNERS, k = (c + 2) % CORNERS;
      double slope = n < 3 ? (c == n ? 4 * share[c] - 1 : 0) : c == n - 3 ? 0 : 4 * share[CORNERS - c - (n - 3)];
      dx += slope * (t->y[j] - t->y[k]) / (2 * t->area), dy += slope * (t->x[k] - t->x[j]) / (2 * t->area);
    }
    for (int a = 0; a < OWN; a++) {
      b[0][a] += dx * h[n][0][a], b[1][a] += dy * h[n][1][a];
      b[2][a] += dy * h[n][0][a] + dx * h[n][1][a];
    }
  }
}

/* ---- forces in the plane and bending together ---- */

static const int IN_PLANE[3] = { 0, 1, 5 }, ACROSS[3] = { 2, 3, 4 }; /* degrees of freedom of a corner: of the forces in
                                                                      * the plane, and of bending */

/* Converts the degrees of freedom v of the corners from own axes to global axes, or back if `back` is true. */
static void turn(const vs_vec3 axes[3], const double *v, bool back, double *out) {
  for (int n = 0; n < VS_PLATE_WAYS; n += 3) {
    vs_vec3 d = vs_v3(v[n], v[n + 1], v[n + 2]), g;
    if (back) g = vs_v3(vs_v3_dot(d, axes[0]), vs_v3_dot(d, axes[1]), vs_v3_dot(d, axes[2]));
    else g = vs_v3_add(vs_v3_add(vs_v3_scale(axes[0], d.x), vs_v3_scale(axes[1], d.y)), vs_v3_scale(axes[2], d.z));
    out[n] = g.x, out[n + 1] = g.y, out[n + 2] = g.z;
  }
}

static void to_global(const vs_vec3 axes[3], vs_plate_matrix k) {
  for (int pass = 0; pass < 2; pass++) { /* converts the rows to global axes and transposes the matrix, twice */
    for (int i = 0; i < VS_PLATE_WAYS; i++) {
      double row[VS_PLATE_WAYS];
      memcpy(row, k[i], sizeof row);
      turn(axes, row, false, k[i]);
    }
    for (int i = 0; i < VS_PLATE_WAYS; i++)
      for (int j = 0; j < i; j++) {
        double x = k[i][j];
        k[i][j] = k[j][i], k[j][i] = x;
      }
  }
}

void vs_plate_stiffness(const vs_structure_plate *p, const vs_vec3 at[3], vs_plate_matrix k) {
  flat t;
  vs_vec3 axes[3];
  double plane[OWN][OWN] = { { 0 } }, bend[OWN][OWN] = { { 0 } }, b[3][OWN], h[6][2][OWN];
  make_flat(p, at, axes, &t);
  mean_strains(&t, b);
  add_product(plane, b, t.elastic, t.area * p->thickness);
  add_higher(&t, p->thickness, p->poisson, plane);
  normal_rotations(&t, h);
  for (int m = 0; m < CORNERS; m++) {
    const double share[CORNERS] = { m == 0 ? 0 : 0.5, m == 1 ? 0 : 0.5, m == 2 ? 0 : 0.5 };
    curvatures(&t, h, share, b);
    add_product(bend, b, t.elastic, pow(p->thickness, 3) / 12 * t.area / 3);
  }
  memset(k, 0, sizeof(vs_plate_matrix));
  for (int i = 0; i < OWN; i++)
    for (int j = 0; j < OWN; j++) {
      k[i / 3 * VS_WAYS + IN_PLANE[i % 3]][j / 3 * VS_WAYS + IN_PLANE[j % 3]] = plane[i][j];
      k[i / 3 * VS_WAYS + ACROSS[i % 3]][j / 3 * VS_WAYS + ACROSS[j % 3]] = bend[i][j];
    }
  to_global(axes, k);
}

void vs_plate_forces(const vs_structure_plate *p, const vs_vec3 at[3], const double moved[VS_PLATE_WAYS],
                     double forces[VS_PLATE_FORCES]) {
  flat t;
  vs_vec3 axes[3];
  double own[VS_PLATE_WAYS], b[3][OWN], h[6][2][OWN], strain[2][3] = { { 0 } };
  const double middle[CORNERS] = { 1.0 / 3, 1.0 / 3, 1.0 / 3 };
  make_flat(p, at, axes, &t);
  turn(axes, moved, true, own);
  mean_strains(&t, b);
  for (int r = 0; r < 3; r++)
    for (int a = 0; a < OWN; a++) strain[0][r] += b[r][a] * own[a / 3 * VS_WAYS + IN_PLANE[a % 3]];
  normal_rotations(&t, h);
  curvatures(&t, h, middle, b);
  for (int r = 0; r < 3; r++)
    for (int a = 0; a < OWN; a++) strain[1][r] += b[r][a] * own[a / 3 * VS_WAYS + ACROSS[a % 3]];
  for (int r = 0; r < 3; r++) {
    forces[r] = forces[3 + r] = 0;
    for (int s = 0; s < 3; s++) {
      forces[r] += p->thickness * t.elastic[r][s] * strain[0][s];
      forces[3 + r] -= pow(p->thickness, 3) / 12 * t.elastic[r][s] * strain[1][s];
    }
  }
}
