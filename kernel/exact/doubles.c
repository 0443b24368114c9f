/* Computes exact signs of determinants of doubles.
 *
 * Each sign is first computed in doubles, where the error is below 8e-16 of the sum of the products' sizes
 * (Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997). If this does not decide the sign, the determinant
 * is computed as an expansion. An expansion is a sum of doubles whose bits do not overlap, the smallest first.
 * Therefore its last term has the sign of the sum. A difference of two doubles is an expansion of two terms. The
 * product of two expansions has at most twice as many terms as the product of their numbers of terms. Coordinates
 * must have sizes of about one, so they are multiplied by a power of two. Only coordinates that are smaller than
 * 2^-300 times the others then underflow. */
#include "kernel/exact/doubles.h"

#include <math.h>

#define SURE 1e-14

typedef struct {
  double high, low;
} pair; /* two doubles whose exact sum is the difference of two coordinates */

static inline pair two_sum(double a, double b) {
  double sum = a + b, virtual_b = sum - a, virtual_a = sum - virtual_b;
  return (pair){ sum, (a - virtual_a) + (b - virtual_b) };
}

static inline pair two_product(double a, double b) {
  const double split = 0x1p27 + 1;
  double product = a * b, big_a = split * a, big_b = split * b;
  double high_a = big_a - (big_a - a), low_a = a - high_a, high_b = big_b - (big_b - b), low_b = b - high_b;
  return (pair){ product, low_a * low_b - (((product - high_a * high_b) - low_a * high_b) - high_a * low_b) };
}

/* Computes the expansion to = e + f. Returns its number of terms. Zero terms are dropped, but a zero sum has one
 * term. */
static int add(const double *e, int e_count, const double *f, int f_count, double *to) {
  int i = 0, j = 0, count = 0;
  double sum = 0;
  bool first = true;
  while (i < e_count || j < f_count) {
    double next = j == f_count || (i < e_count && fabs(e[i]) < fabs(f[j])) ? e[i++] : f[j++];
    if (first) {
      sum = next;
      first = false;
      continue;
    }
    pair p = two_sum(sum, next);
    if (p.low != 0) to[count++] = p.low;
    sum = p.high;
  }
  if (sum != 0 || count == 0) to[count++] = sum;
  return count;
}

/* Computes the expansion to = e * b and returns its number of terms. e has at least one term. */
static int scale(const double *e, int e_count, double b, double *to) {
  int count = 0;
  pair p = two_product(e[0], b);
  double sum = p.high;
  VS_ASSERT(e_count > 0);
  if (p.low != 0) to[count++] = p.low;
  for (int i = 1; i < e_count; i++) {
    pair product = two_product(e[i], b), low = two_sum(sum, product.low), high = two_sum(product.high, low.high);
    if (low.low != 0) to[count++] = low.low;
    if (high.low != 0) to[count++] = high.low;
    sum = high.high;
  }
  if (sum != 0 || count == 0) to[count++] = sum;
  return count;
}

/* Computes the expansion to = e * d, where d is the sum of two doubles, and returns its number of terms. e has 1 to 16
 * terms. */
static int multiply(const double *e, int e_count, pair d, double *to) {
  enum { MOST = 16 };
  double low[2 * MOST], high[2 * MOST];
  int low_count = scale(e, e_count, d.low, low), high_count = scale(e, e_count, d.high, high);
  VS_ASSERT(e_count > 0 && e_count <= MOST);
  return add(low, low_count, high, high_count, to);
}

/* Computes the expansion to = a * d - b * c and returns its number of terms, at most 16. */
static int minor(pair a, pair b, pair c, pair d, double to[16]) {
  double ad[8], bc[8];
  int n = multiply((const double[]){ a.low, a.high }, 2, d, ad),
      m = multiply((const double[]){ -b.low, -b.high }, 2, c, bc);
  return add(ad, n, bc, m, to);
}

static double coordinate(vs_vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

static int sign(double x) { return (x > 0) - (x < 0); }

/* Returns the power of two that scales the largest of `count` sizes to about one. Returns 1 if all sizes are zero, or
 * the largest is already of about that size. */
static double to_one(const double *size, int count) {
  double most = 0;
  int exponent;
  for (int i = 0; i < count; i++) most = fmax(most, fabs(size[i]));
  if (most == 0 || (most > 0x1p-200 && most < 0x1p200)) return 1;
  frexp(most, &exponent);
  return exponent > 1000 ? 0x1p-1000 : exponent < -1000 ? 0x1p1000 : ldexp(1, -exponent);
}

static int side_slow(const vs_vec3 p[4]) {
  double at[12], scaled, xy[16], products[3][64], half[128], all[192];
  int counts[3];
  pair d[3][3];
  for (int i = 0; i < 12; i++) at[i] = coordinate(p[i / 3], i % 3);
  scaled = to_one(at, 12);
  for (int i = 0; i < 9; i++) d[i / 3][i % 3] = two_sum(at[3 + i] * scaled, -at[i % 3] * scaled);
  for (int k = 0; k < 3; k++) {
    int u = (k + 1) % 3, v = (k + 2) % 3, n = minor(d[0][u], d[0][v], d[1][u], d[1][v], xy);
    counts[k] = multiply(xy, n, d[2][k], products[k]);
  }
  int n = add(products[0], counts[0], products[1], counts[1], half);
  n = add(half, n, products[2], counts[2], all);
  return sign(all[n - 1]);
}

int vs_doubles_side(vs_vec3 a, vs_vec3 b, vs_vec3 c, vs_vec3 d) {
  vs_vec3 p = vs_v3_sub(b, a), q = vs_v3_sub(c, a), r = vs_v3_sub(d, a);
  double x = p.y * q.z, y = p.z * q.y, z = p.z * q.x, u = p.x * q.z, v = p.x * q.y, w = p.y * q.x;
  double det = r.x * (x - y) + r.y * (z - u) + r.z * (v - w);
  double size = fabs(r.x) * (fabs(x) + fabs(y)) + fabs(r.y) * (fabs(z) + fabs(u)) + fabs(r.z) * (fabs(v) + fabs(w));
  if (fabs(det) > SURE * size && size > 1e-250) return sign(det);
  return side_slow((const vs_vec3[]){ a, b, c, d });
}

static int turn_slow(const double at[6]) {
  double to[16], scaled = to_one(at, 6);
  pair d[4];
  for (int i = 0; i < 4; i++) d[i] = two_sum(at[2 + i] * scaled, -at[i % 2] * scaled);
  int n = minor(d[0], d[1], d[2], d[3], to);
  return sign(to[n - 1]);
}

int vs_doubles_turn(int axis, vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  double at[6] = { coordinate(a, u), coordinate(a, v), coordinate(b, u),
                   coordinate(b, v), coordinate(c, u), coordinate(c, v) };
  double left = (at[2] - at[0]) * (at[5] - at[1]), right = (at[3] - at[1]) * (at[4] - at[0]),
         size = fabs(left) + fabs(right);
  VS_ASSERT(axis >= 0 && axis < 3);
  if (fabs(left - right) > SURE * size && size > 1e-250) return left > right ? 1 : -1;
  return turn_slow(at);
}
