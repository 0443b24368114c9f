/* Implements the functions of exact.h that need wide integers: fixed-width two's complement integers, and the exact
 * cases of the predicates.
 *
 * A wide integer is an array of 64-bit limbs, least first. Each call knows its length. Products are computed modulo
 * 2^(64 length) from sign-extended operands. In two's complement this is right as long as the true result fits; exact.h
 * states the widths. */
#include "kernel/exact/exact.h"

#include <math.h>
#include <string.h>

static inline uint64_t limb(const uint64_t *a, int count, int i) {
  return i < count ? a[i] : (uint64_t)((int64_t)a[count - 1] >> 63);
}

static inline void wide_mul(uint64_t *r, int rn, const uint64_t *a, int an, const uint64_t *b, int bn) {
  for (int i = 0; i < rn; i++) r[i] = 0;
  for (int i = 0; i < rn; i++) {
    uint64_t x = limb(a, an, i), carry = 0;
    if (x == 0) continue;
    for (int j = 0; i + j < rn; j++) {
      vs_u128 t = (vs_u128)x * limb(b, bn, j) + r[i + j] + carry;
      r[i + j] = (uint64_t)t;
      carry = (uint64_t)(t >> 64);
    }
  }
}

static inline void wide_add(uint64_t *r, const uint64_t *b, int n) {
  uint64_t carry = 0;
  for (int i = 0; i < n; i++) {
    vs_u128 t = (vs_u128)r[i] + b[i] + carry;
    r[i] = (uint64_t)t;
    carry = (uint64_t)(t >> 64);
  }
}

static inline void wide_sub(uint64_t *r, const uint64_t *b, int n) {
  uint64_t borrow = 0;
  for (int i = 0; i < n; i++) {
    vs_u128 t = (vs_u128)r[i] - b[i] - borrow;
    r[i] = (uint64_t)t;
    borrow = (uint64_t)(t >> 64) & 1;
  }
}

static inline void wide_negate(uint64_t *r, int n) {
  uint64_t carry = 1;
  for (int i = 0; i < n; i++) {
    r[i] = ~r[i] + carry;
    carry = carry && r[i] == 0;
  }
}

static inline int wide_sign(const uint64_t *a, int n) {
  if (a[n - 1] >> 63) return -1;
  for (int i = 0; i < n; i++)
    if (a[i]) return 1;
  return 0;
}

static inline void wide_from(uint64_t *r, int n, vs_i128 x) {
  r[0] = (uint64_t)(vs_u128)x;
  if (n > 1) r[1] = (uint64_t)((vs_u128)x >> 64);
  for (int i = 2; i < n; i++) r[i] = x < 0 ? UINT64_MAX : 0;
}

static uint64_t gcd64(uint64_t a, uint64_t b) {
  if (!a || !b) return a | b;
  int shift = __builtin_ctzll(a | b);
  a >>= __builtin_ctzll(a);
  while (b) { /* The comparison in this loop causes no branch, because the processor could not predict it. */
    b >>= __builtin_ctzll(b);
    uint64_t less = a < b ? a : b, more = a < b ? b : a;
    a = less;
    b = more - less;
  }
  return a << shift;
}

void vs_plane_axes(vs_plane *p) {
  int64_t best = -1;
  for (int i = 0; i < 3; i++) {
    int64_t size = p->n[i] < 0 ? -p->n[i] : p->n[i];
    if (size > best) best = size, p->k = (uint8_t)i;
  }
  int u = (p->k + 1) % 3, v = (p->k + 2) % 3;
  bool up = p->n[p->k] > 0;
  p->u = (uint8_t)(up ? u : v);
  p->v = (uint8_t)(up ? v : u);
}

/* Computes p = b - a and q = c - a. Returns true if the components are small enough that products of three of them fit
 * into 127 bits. */
static inline bool differences(const int32_t a[3], const int32_t b[3], const int32_t c[3], int64_t p[3], int64_t q[3]) {
  uint64_t wide = 0;
  for (int i = 0; i < 3; i++) {
    p[i] = (int64_t)b[i] - a[i], q[i] = (int64_t)c[i] - a[i];
    wide |= (uint64_t)(p[i] + ((int64_t)1 << 30)) | (uint64_t)(q[i] + ((int64_t)1 << 30));
  }
  return !(wide >> 31);
}

bool vs_plane_through(const int32_t a[3], const int32_t b[3], const int32_t c[3], vs_plane *out, bool *flipped) {
  int64_t p[3], q[3];
  uint64_t g = 0;
  if (!differences(a, b, c, p, q)) {
    vs_u128 size[3];
    bool minus[3];
    for (int i = 0; i < 3; i++) {
      int u = (i + 1) % 3, v = (i + 2) % 3;
      vs_i128 n = (vs_i128)p[u] * q[v] - (vs_i128)p[v] * q[u];
      minus[i] = n < 0;
      size[i] = (vs_u128)(n < 0 ? -n : n); /* the component n is at most 2^64 - 2^33: twice the area of a triangle in a
                                            * square of less than 2^32 steps */
      g = gcd64(g, (uint64_t)size[i]);
    }
    for (int i = 0; i < 3; i++) {
      uint64_t n = g ? (uint64_t)size[i] / g : 0;
      if (n > INT64_MAX) return false;
      out->n[i] = minus[i] ? -(int64_t)n : (int64_t)n;
    }
    if (g) g = 1;
  } else
    for (int i = 0; i < 3; i++) {
      int u = (i + 1) % 3, v = (i + 2) % 3;
      out->n[i] = p[u] * q[v] - p[v] * q[u];
      uint64_t size = (uint64_t)(out->n[i] < 0 ? -out->n[i] : out->n[i]);
      if (g != 1) g = gcd64(g, g ? size % g : size); /* the greatest common divisor of the components so far is mostly
                                                      * small, so the next step is fast */
    }
  if (g == 0) return false;
  int64_t first = out->n[0] ? out->n[0] : out->n[1] ? out->n[1] : out->n[2];
  int64_t divisor = first < 0 ? -(int64_t)g : (int64_t)g;
  *flipped = first < 0;
  out->d = 0;
  for (int i = 0; i < 3; i++) {
    if (divisor != 1) out->n[i] /= divisor;
    out->d += (vs_i128)out->n[i] * a[i];
  }
  vs_plane_axes(out);
  return true;
}

void vs_plane_along(const int32_t a[3], const int32_t b[3], int k, vs_plane *out) {
  int u = (k + 1) % 3, v = (k + 2) % 3; /* computes the cross product of b - a and the unit vector along axis k */
  VS_ASSERT(k >= 0 && k < 3 && (a[u] != b[u] || a[v] != b[v]));
  out->n[k] = 0;
  out->n[u] = (int64_t)b[v] - a[v];
  out->n[v] = -((int64_t)b[u] - a[u]);
  out->d = (vs_i128)out->n[u] * a[u] + (vs_i128)out->n[v] * a[v];
  vs_plane_axes(out);
}

int vs_orient3d(const int32_t a[3], const int32_t b[3], const int32_t c[3], const int32_t d[3]) {
  int64_t p[3], q[3], r[3];
  bool small = differences(a, b, c, p, q);
  for (int i = 0; i < 3; i++) r[i] = (int64_t)d[i] - a[i];
  if (!small)
    return vs_sign128(((vs_i128)p[1] * q[2] - (vs_i128)p[2] * q[1]) * r[0] +
                      ((vs_i128)p[2] * q[0] - (vs_i128)p[0] * q[2]) * r[1] +
                      ((vs_i128)p[0] * q[1] - (vs_i128)p[1] * q[0]) * r[2]);
  return vs_sign128((vs_i128)(p[1] * q[2] - p[2] * q[1]) * r[0] + (vs_i128)(p[2] * q[0] - p[0] * q[2]) * r[1] +
                    (vs_i128)(p[0] * q[1] - p[1] * q[0]) * r[2]);
}

/* Computes r = r + a * b on wide integers. */
static inline void add_product(uint64_t r[4], vs_i128 a, vs_i128 b) {
  uint64_t a0 = (uint64_t)a, a1 = (uint64_t)(a >> 64), b0 = (uint64_t)b, b1 = (uint64_t)(b >> 64);
  vs_u128 low = (vs_u128)a0 * b0, one = (vs_u128)a0 * b1, two = (vs_u128)a1 * b0;
  vs_u128 middle = (low >> 64) + (uint64_t)one + (uint64_t)two;
  vs_u128 high = (vs_u128)a1 * b1 + (one >> 64) + (two >> 64) + (middle >> 64);
  if (b < 0) high -= (vs_u128)a;
  if (a < 0) high -= (vs_u128)b;
  wide_add(r, (const uint64_t[4]){ (uint64_t)low, (uint64_t)middle, (uint64_t)high, (uint64_t)(high >> 64) }, 4);
}

bool vs_meet_edge(const int32_t a[3], const int32_t b[3], const vs_plane *p, vs_homogeneous *out) {
  vs_i128 oa = -p->d, ob = -p->d;
  for (int i = 0; i < 3; i++) oa += (vs_i128)p->n[i] * a[i], ob += (vs_i128)p->n[i] * b[i];
  vs_i128 w = oa - ob;
  if (w == 0) return false;
  for (int i = 0; i < 3; i++) { /* Handles the intersection of an edge parallel to an axis with a plane perpendicular to
                                 * this axis, which is common in models. */
    int j = (i + 1) % 3, l = (i + 2) % 3;
    if (a[j] != b[j] || a[l] != b[l] || p->n[i] != 1 || p->n[j] || p->n[l]) continue;
    wide_from(out->x[i], VS_LIMBS, p->d);
    wide_from(out->x[j], VS_LIMBS, a[j]);
    wide_from(out->x[l], VS_LIMBS, a[l]);
    wide_from(out->w, VS_LIMBS, 1);
    return true;
  }
  int sign = w < 0 ? -1 : 1;
  wide_from(out->w, VS_LIMBS, w * sign);
  vs_u128 size = (vs_u128)(oa < 0 ? -oa : oa) | (vs_u128)(ob < 0 ? -ob : ob);
  for (int i = 0; i < 3; i++) {
    if (!(size >> 94)) {
      wide_from(out->x[i], VS_LIMBS, (b[i] * oa - a[i] * ob) * sign);
      continue;
    }
    memset(out->x[i], 0, sizeof out->x[i]);
    add_product(out->x[i], oa * sign, b[i]);
    add_product(out->x[i], -ob * sign, a[i]);
  }
  return true;
}

void vs_homogeneous_integer(const int32_t at[3], vs_homogeneous *out) {
  for (int i = 0; i < 3; i++) wide_from(out->x[i], VS_LIMBS, at[i]);
  wide_from(out->w, VS_LIMBS, 1);
}

void vs_homogeneous_fixed(const int64_t fixed[3], vs_homogeneous *out) {
  for (int i = 0; i < 3; i++) wide_from(out->x[i], VS_LIMBS, fixed[i]);
  wide_from(out->w, VS_LIMBS, (vs_i128)1 << VS_FIXED_BITS);
}

static bool across(const vs_plane *p) { return !p->n[(p->k + 1) % 3] && !p->n[(p->k + 2) % 3]; } /* returns true if the
                                                                                                  * plane is
                                                                                                  * perpendicular to the
                                                                                                  * axis p->k */

bool vs_meet_planes(const vs_plane *p, const vs_plane *q, const vs_plane *r, vs_homogeneous *out) {
  const vs_plane *s[3] = { p, q, r };
  memset(out, 0, sizeof *out);
  if (p->n[p->k] == 1 && q->n[q->k] == 1 && r->n[r->k] == 1 && (1 << p->k | 1 << q->k | 1 << r->k) == 7 && across(p) &&
      across(q) && across(r)) {
    for (int i = 0; i < 3; i++) wide_from(out->x[s[i]->k], VS_LIMBS, s[i]->d);
    out->w[0] = 1;
    return true;
  }
  for (int j = 0; j < 3; j++) {
    const vs_plane *x = s[(j + 1) % 3], *y = s[(j + 2) % 3];
    for (int i = 0; i < 3; i++) {
      int u = (i + 1) % 3, v = (i + 2) % 3;
      vs_i128 cross = (vs_i128)x->n[u] * y->n[v] - (vs_i128)x->n[v] * y->n[u];
      add_product(out->x[i], s[j]->d, cross);
      if (j == 0) add_product(out->w, p->n[i], cross); /* computes the denominator W = n_p . (n_q x n_r) of the point
                                                        * where three planes with these normals intersect */
    }
  }
  int sign = wide_sign(out->w, VS_LIMBS);
  if (sign < 0) {
    for (int i = 0; i < 3; i++) wide_negate(out->x[i], VS_LIMBS);
    wide_negate(out->w, VS_LIMBS);
  }
  return sign != 0;
}

/* Returns x, which is at least 0, as an approximate double. */
static inline double near128(vs_i128 x) { return (double)(int64_t)(x >> 64) * 0x1p64 + (double)(uint64_t)x; }

/* Computes the fixed-point numbers as vs_homogeneous_fix does. Returns false if a numerator does not fit into 128 bits
 * or the denominator not into 94 bits; most points fit. Computes whole steps first, and then the fraction. */
static bool fix_narrow(const vs_homogeneous *h, int64_t fixed[3], bool *exact) {
  vs_i128 w = (vs_i128)((vs_u128)h->w[1] << 64 | h->w[0]);
  for (int i = 0; i < 3; i++)
    if (h->x[i][2] != (uint64_t)((int64_t)h->x[i][1] >> 63) || h->x[i][3] != h->x[i][2]) return false;
  double per = 1 / near128(w);
  *exact = true;
  for (int i = 0; i < 3; i++) {
    vs_i128 x = (vs_i128)((vs_u128)h->x[i][1] << 64 | h->x[i][0]);
    double guess = x < 0 ? -near128(-x) * per : near128(x) * per;
    if (fabs(guess) > 0x1p32) return false;
    int64_t whole = (int64_t)floor(guess), rest;
    vs_i128 r = x - w * whole;
    for (; r < 0; whole--) r += w; /* the quotient was estimated in doubles, so it may differ by one from the right
                                    * integer */
    for (; r >= w; whole++) r -= w;
    rest = (int64_t)(near128(r) * per * (double)(1 << VS_FIXED_BITS));
    r = r * ((vs_i128)1 << VS_FIXED_BITS) - w * rest;
    for (; r < 0; rest--) r += w;
    for (; r >= w; rest++) r -= w;
    *exact = *exact && r == 0;
    fixed[i] = whole * ((int64_t)1 << VS_FIXED_BITS) + rest;
  }
  return true;
}

/* Returns x, which is at least 0, as an approximate double. */
static inline double near256(const uint64_t x[4]) {
  VS_ASSERT(x[3] >> 63 == 0);
  return (((double)x[3] * 0x1p64 + (double)x[2]) * 0x1p64 + (double)x[1]) * 0x1p64 + (double)x[0];
}

/* Computes r = r - w * q on wide integers. q >= 0. */
static inline void take_times(uint64_t r[4], const uint64_t w[4], uint64_t q) {
  vs_u128 t = (vs_u128)w[0] * q, u = (vs_u128)w[1] * q + (uint64_t)(t >> 64),
          v = (vs_u128)w[2] * q + (uint64_t)(u >> 64);
  uint64_t product[4] = { (uint64_t)t, (uint64_t)u, (uint64_t)v, w[3] * q + (uint64_t)(v >> 64) };
  wide_sub(r, product, 4);
}

/* Returns floor(r / w), and sets r to the remainder. q: an estimate of the quotient that is off by one at most. */
static inline int64_t divide(uint64_t r[4], const uint64_t w[4], int64_t q) {
  take_times(r, w, (uint64_t)q);
  for (; wide_sign(r, 4) < 0; q--) wide_add(r, w, 4);
  for (;; q++) {
    uint64_t less[4] = { r[0], r[1], r[2], r[3] };
    wide_sub(less, w, 4);
    if (wide_sign(less, 4) < 0) return q;
    memcpy(r, less, sizeof less);
  }
}

/* Computes to = x * 2^bits on wide integers. bits is 1 to 63. */
static inline void shift_up(uint64_t to[4], const uint64_t x[4], int bits) {
  VS_ASSERT(bits > 0 && bits < 64);
  for (int i = 3; i > 0; i--) to[i] = x[i] << bits | x[i - 1] >> (64 - bits);
  to[0] = x[0] << bits;
}

bool vs_homogeneous_fix(const vs_homogeneous *h, int64_t fixed[3]) {
  enum { UP = 32 }; /* an offset of 2^UP steps is added to coordinates so that they are not negative */
  bool exact = true;
  VS_ASSERT(wide_sign(h->w, VS_LIMBS) > 0);
  if (h->w[0] == 1 && !h->w[1] && !h->w[2] && !h->w[3]) { /* the denominator is 1, so the point is on the grid */
    for (int i = 0; i < 3; i++) fixed[i] = (int64_t)(h->x[i][0] << VS_FIXED_BITS);
    return true;
  }
  if (!h->w[3] && !h->w[2] && !(h->w[1] >> 30) && fix_narrow(h, fixed, &exact)) return exact;
  uint64_t up[4];
  shift_up(up, h->w, UP);
  double per = 1 / near256(h->w);
  exact = true;
  for (int i = 0; i < 3; i++) { /* computes the whole steps of each coordinate first, and then its fraction; all values
                                 * are below 2^226 */
    uint64_t r[4] = { h->x[i][0], h->x[i][1], h->x[i][2], h->x[i][3] };
    wide_add(r, up, 4);
    int64_t whole = divide(r, h->w, (int64_t)(near256(r) * per)) - ((int64_t)1 << UP);
    shift_up(r, r, VS_FIXED_BITS);
    int64_t rest = divide(r, h->w, (int64_t)(near256(r) * per));
    exact = exact && !(r[0] | r[1] | r[2] | r[3]);
    fixed[i] = whole * ((int64_t)1 << VS_FIXED_BITS) + rest;
  }
  return exact;
}

int vs_homogeneous_compare(const vs_homogeneous *a, const vs_homogeneous *b, int axis) {
  uint64_t s[7], t[7];
  VS_ASSERT(axis >= 0 && axis < 3 && wide_sign(a->w, VS_LIMBS) > 0 && wide_sign(b->w, VS_LIMBS) > 0);
  wide_mul(s, 7, a->x[axis], VS_LIMBS, b->w, VS_LIMBS);
  wide_mul(t, 7, b->x[axis], VS_LIMBS, a->w, VS_LIMBS);
  wide_sub(s, t, 7);
  return wide_sign(s, 7);
}

bool vs_homogeneous_equal(const vs_homogeneous *a, const vs_homogeneous *b) {
  return memcmp(a, b, sizeof *a) == 0 || (vs_homogeneous_compare(a, b, 0) == 0 &&
                                          vs_homogeneous_compare(a, b, 1) == 0 && vs_homogeneous_compare(a, b, 2) == 0);
}

int vs_homogeneous_side(const vs_plane *p, const vs_homogeneous *h) {
  uint64_t s[5], t[5], d[2];
  VS_ASSERT(wide_sign(h->w, VS_LIMBS) > 0);
  wide_from(d, 2, -p->d);
  wide_mul(s, 5, h->w, VS_LIMBS, d, 2);
  for (int i = 0; i < 3; i++) {
    uint64_t n[1] = { (uint64_t)p->n[i] };
    wide_mul(t, 5, h->x[i], VS_LIMBS, n, 1);
    wide_add(s, t, 5);
  }
  return wide_sign(s, 5);
}

void vs_plane_lift(const vs_plane *p, int k, int64_t u, int64_t v, vs_homogeneous *out) {
  int au = (k + 1) % 3, av = (k + 2) % 3;
  vs_i128 n = p->n[k], one = (vs_i128)1 << VS_FIXED_BITS;
  vs_i128 z = p->d * one - (vs_i128)p->n[au] * u - (vs_i128)p->n[av] * v;
  int sign = n < 0 ? -1 : 1;
  VS_ASSERT(p->n[k] != 0);
  wide_from(out->x[au], VS_LIMBS, n * u * sign);
  wide_from(out->x[av], VS_LIMBS, n * v * sign);
  wide_from(out->x[k], VS_LIMBS, z * sign);
  wide_from(out->w, VS_LIMBS, n * one * sign);
}

static void load(vs_points_view v, uint32_t x, vs_homogeneous *out) {
  const vs_point *p = &v.at[x];
  if (!vs_point_exact(p)) {
    *out = p->big & VS_POINT_MORE ? v.more[p->big & ~VS_POINT_MORE] : v.big[p->big];
    return;
  }
  for (int i = 0; i < 3; i++) wide_from(out->x[i], VS_LIMBS, p->fixed[i]);
  wide_from(out->w, VS_LIMBS, (vs_i128)1 << VS_FIXED_BITS);
}

int vs_side_slow(vs_points_view v, const vs_plane *p, uint32_t x) {
  vs_homogeneous h;
  load(v, x, &h);
  return vs_homogeneous_side(p, &h);
}

int vs_compare_slow(vs_points_view v, uint32_t a, uint32_t b, int axis) {
  vs_homogeneous g, h;
  load(v, a, &g);
  load(v, b, &h);
  return vs_homogeneous_compare(&g, &h, axis);
}

int vs_orient2d_slow(vs_points_view v, uint32_t a, uint32_t b, uint32_t c, int axis_u, int axis_v) {
  vs_homogeneous h[3];
  load(v, a, &h[0]);
  load(v, b, &h[1]);
  load(v, c, &h[2]);
  uint64_t sum[11] = { 0 }, s[8], t[8], r[11];
  for (int i = 0; i < 3; i++) { /* expands the determinant whose rows are (X_u, X_v, W) of three points, along its last
                                 * column; every W > 0 */
    const vs_homogeneous *p = &h[(i + 1) % 3], *q = &h[(i + 2) % 3];
    wide_mul(s, 8, p->x[axis_u], VS_LIMBS, q->x[axis_v], VS_LIMBS);
    wide_mul(t, 8, p->x[axis_v], VS_LIMBS, q->x[axis_u], VS_LIMBS);
    wide_sub(s, t, 8);
    wide_mul(r, 11, s, 8, h[i].w, VS_LIMBS);
    wide_add(sum, r, 11);
  }
  return wide_sign(sum, 11);
}
