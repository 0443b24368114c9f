/* Contains an exact search for self-intersections of a mesh, independent of the program that made the mesh.
 *
 * Two triangles may share nothing, a corner, or an edge, identified by coordinates. Any other common point is a fault.
 * Triangles may cross. They may lie in one plane and overlap: beside a shared edge (folded), with all three corners in
 * common (doubled) or otherwise (coplanar). They may touch: a corner in a face, or an edge on an edge. A triangle
 * without area is a fault too (flat). Coordinates are exact doubles. A sign is computed in double if the error is known
 * to be smaller than the result, otherwise in integers with a common power of two as factor (GMP). */
#ifndef TESTS_TOOLS_CROSSINGS_H
#define TESTS_TOOLS_CROSSINGS_H

#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef double crossings_point[3];
typedef uint32_t crossings_triangle[3];

typedef enum { CROSSINGS_FLAT, CROSSINGS_DOUBLED, CROSSINGS_FOLDED, CROSSINGS_COPLANAR, CROSSINGS_CROSSING, CROSSINGS_TOUCHING, CROSSINGS_KINDS, CROSSINGS_NONE } crossings_kind;
static const char *const crossings_names[CROSSINGS_KINDS] = { "flat", "doubled", "folded", "coplanar", "crossing", "touching" };

typedef struct {
  size_t count[CROSSINGS_KINDS];
  uint32_t first[CROSSINGS_KINDS][2]; /* first[k]: the two triangles of the first fault of kind k */
} crossings_found;

typedef struct {
  const crossings_point *at;    /* coordinates of the mesh's corners; equal corners are stored once */
  crossings_triangle *triangles;
  uint8_t *axis;                /* axis[t]: axis along which triangle t is projected to an area greater than 0; 3 if the
                                 * triangle has no area */
  mpz_t x[12], t[8];
} crossings;

/* ---- exact signs ---- */

/* multiplies the `count` numbers by one power of two, so that all become integers */
static inline void crossings_exact(crossings *c, mpz_t *to, const double *from, int count) {
  int least = INT32_MAX, exponent;
  for (int i = 0; i < count; i++)
    if (from[i] != 0) {
      (void)frexp(from[i], &exponent);
      if (exponent - 53 < least) least = exponent - 53;
    }
  for (int i = 0; i < count; i++) {
    double part = frexp(from[i], &exponent);
    mpz_set_d(to[i], ldexp(part, 53));
    if (from[i] != 0) mpz_mul_2exp(to[i], to[i], (mp_bitcnt_t)(exponent - 53 - least));
  }
  (void)c;
}

/* Returns the side of d with respect to the plane a b c: 1 for the side from which a b c is counter-clockwise. */
static inline int crossings_side(crossings *c, uint32_t ia, uint32_t ib, uint32_t ic, uint32_t id) {
  const double *p[4] = { c->at[ia], c->at[ib], c->at[ic], c->at[id] };
  double e[3][3], det = 0, size = 0;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) e[i][k] = p[i + 1][k] - p[0][k];
  for (int k = 0; k < 3; k++) {
    int u = (k + 1) % 3, v = (k + 2) % 3;
    double m = e[0][u] * e[1][v], n = e[0][v] * e[1][u];
    det += (m - n) * e[2][k];
    size += (fabs(m) + fabs(n)) * fabs(e[2][k]);
  }
  if (fabs(det) > 1e-14 * size && size > 1e-250) return det > 0 ? 1 : -1; /* rounding changes the determinant by at most
                                                                           * 7.8e-16 * size (Shewchuk's bound), so its
                                                                           * sign is right */
  if (size == 0) { /* the determinant is exactly 0 if every product contains a factor 0; otherwise the products may be
                    * too small for a double */
    bool small = false;
    for (int i = 0; i < 9; i++) small = small || (e[i / 3][i % 3] != 0 && fabs(e[i / 3][i % 3]) < 1e-100);
    if (!small) return 0;
  }
  double all[12];
  for (int i = 0; i < 12; i++) all[i] = p[i / 3][i % 3];
  crossings_exact(c, c->x, all, 12);
  for (int i = 3; i < 12; i++) mpz_sub(c->x[i], c->x[i], c->x[i % 3]);
  mpz_set_ui(c->t[0], 0);
  for (int k = 0; k < 3; k++) {
    int u = (k + 1) % 3, v = (k + 2) % 3;
    mpz_mul(c->t[1], c->x[3 + u], c->x[6 + v]);
    mpz_submul(c->t[1], c->x[3 + v], c->x[6 + u]);
    mpz_addmul(c->t[0], c->t[1], c->x[9 + k]);
  }
  return mpz_sgn(c->t[0]);
}

/* Returns the orientation of the triangle a b c, seen along an axis: 1 for counter-clockwise, -1 for clockwise, 0 for
 * no area. */
static inline int crossings_turn(crossings *c, int axis, uint32_t ia, uint32_t ib, uint32_t ic) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double *p[3] = { c->at[ia], c->at[ib], c->at[ic] };
  double m = (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]), n = (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]), size = fabs(m) + fabs(n);
  if (fabs(m - n) > 1e-14 * size && size > 1e-250) return m > n ? 1 : -1;
  double all[6] = { p[0][u], p[0][v], p[1][u], p[1][v], p[2][u], p[2][v] };
  crossings_exact(c, c->x, all, 6);
  for (int i = 2; i < 6; i++) mpz_sub(c->x[i], c->x[i], c->x[i % 2]);
  mpz_mul(c->t[0], c->x[2], c->x[5]);
  mpz_submul(c->t[0], c->x[3], c->x[4]);
  return mpz_sgn(c->t[0]);
}

/* ---- a pair of triangles ---- */

static inline bool crossings_holds(crossings *c, uint32_t t, uint32_t p) { /* returns true if p, a point in the plane of
                                                                            * triangle t, lies in t */
  const uint32_t *v = c->triangles[t];
  int axis = c->axis[t], way = crossings_turn(c, axis, v[0], v[1], v[2]);
  for (int i = 0; i < 3; i++)
    if (crossings_turn(c, axis, v[i], v[(i + 1) % 3], p) == -way) return false;
  return true;
}

/* Returns how the segment from p to q intersects the triangle t in whose plane it lies. A single common point is a
 * touch; a longer common part is an overlap. */
static inline crossings_kind crossings_in_plane(crossings *c, uint32_t t, uint32_t p, uint32_t q) {
  const uint32_t *v = c->triangles[t];
  int axis = c->axis[t], way = crossings_turn(c, axis, v[0], v[1], v[2]), left = 0, right = 0;
  for (int end = 0; end < 2; end++) {
    uint32_t from = end ? q : p, to = end ? p : q;
    if (!crossings_holds(c, t, from)) continue;
    for (int i = 0; i < 3; i++) /* the segment begins on the outer side of an edge of the triangle, and does not
                                 * approach that edge */
      if (crossings_turn(c, axis, v[i], v[(i + 1) % 3], from) == 0 &&
          crossings_turn(c, axis, v[i], v[(i + 1) % 3], to) == -way)
        return CROSSINGS_TOUCHING;
    return CROSSINGS_COPLANAR;
  }
  for (int i = 0; i < 3; i++) {
    int turn = crossings_turn(c, axis, p, q, v[i]);
    left += turn > 0;
    right += turn < 0;
  }
  for (int i = 0; i < 3; i++) {
    uint32_t a = v[i], b = v[(i + 1) % 3];
    int ap = crossings_turn(c, axis, a, b, p), aq = crossings_turn(c, axis, a, b, q),
        pa = crossings_turn(c, axis, p, q, a), pb = crossings_turn(c, axis, p, q, b);
    if (ap * aq <= 0 && (ap || aq) && pa * pb <= 0)
      return left == 2 || right == 2 ? CROSSINGS_TOUCHING : CROSSINGS_COPLANAR;
  }
  return CROSSINGS_NONE;
}

/* Returns how the closed segment from p to q intersects the closed triangle t: not at all, in an inner point of both,
 * or by a touch (or in a longer part if they are coplanar). sp, sq: sides of the plane where p and q lie. */
static inline crossings_kind crossings_segment(crossings *c, uint32_t t, uint32_t p, uint32_t q, int sp, int sq) {
  const uint32_t *v = c->triangles[t];
  if (sp * sq > 0) return CROSSINGS_NONE;
  if (sp == 0 && sq == 0) return crossings_in_plane(c, t, p, q);
  if (sp == 0) return crossings_holds(c, t, p) ? CROSSINGS_TOUCHING : CROSSINGS_NONE;
  if (sq == 0) return crossings_holds(c, t, q) ? CROSSINGS_TOUCHING : CROSSINGS_NONE;
  bool left = false, right = false, edge = false;
  for (int i = 0; i < 3 && !(left && right); i++) {
    int side = crossings_side(c, p, q, v[i], v[(i + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
    edge = edge || side == 0;
  }
  return left && right ? CROSSINGS_NONE : edge ? CROSSINGS_TOUCHING : CROSSINGS_CROSSING;
}

static inline crossings_kind crossings_worse(crossings_kind a, crossings_kind b) {
  return a == CROSSINGS_NONE || (b == CROSSINGS_CROSSING) || (b == CROSSINGS_COPLANAR && a == CROSSINGS_TOUCHING) ? b == CROSSINGS_NONE ? a : b : a;
}

static inline crossings_kind crossings_pair(crossings *c, uint32_t a, uint32_t b) {
  const uint32_t *v = c->triangles[a], *w = c->triangles[b];
  if (c->axis[a] == 3 || c->axis[b] == 3) return CROSSINGS_NONE; /* triangles without area are counted as flat by
                                                                  * another function */
  int in_v[3], in_w[3], shared = 0; /* in_v, in_w: positions of the common corners in the triangles v and w */
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (v[i] == w[j]) in_v[shared] = i, in_w[shared++] = j;
  if (shared == 3) return CROSSINGS_DOUBLED;
  int above_v[3] = { 0 }, above_w[3] = { 0 }; /* above_v: sides of w's corners with respect to v. above_w: sides of v's
                                               * corners with respect to w */
  for (int j = 0; j < 3; j++)
    if ((shared < 1 || j != in_w[0]) && (shared < 2 || j != in_w[1])) above_v[j] = crossings_side(c, v[0], v[1], v[2], w[j]);
  if (shared == 2) {
    uint32_t p = v[in_v[0]], q = v[in_v[1]], x = v[3 - in_v[0] - in_v[1]], y = w[3 - in_w[0] - in_w[1]];
    if (above_v[3 - in_w[0] - in_w[1]] != 0) return CROSSINGS_NONE;
    return crossings_turn(c, c->axis[a], p, q, x) == crossings_turn(c, c->axis[a], p, q, y) ? CROSSINGS_FOLDED : CROSSINGS_NONE;
  }
  if (shared == 0 && above_v[0] && above_v[0] == above_v[1] && above_v[0] == above_v[2]) return CROSSINGS_NONE;
  for (int i = 0; i < 3; i++)
    if (shared < 1 || i != in_v[0]) above_w[i] = crossings_side(c, w[0], w[1], w[2], v[i]);
  if (shared == 1) { /* with one common corner, any other common point implies one on the opposite edge of v or of w */
    int i = (in_v[0] + 1) % 3, j = (in_v[0] + 2) % 3, k = (in_w[0] + 1) % 3, l = (in_w[0] + 2) % 3;
    return crossings_worse(crossings_segment(c, b, v[i], v[j], above_w[i], above_w[j]), crossings_segment(c, a, w[k], w[l], above_v[k], above_v[l]));
  }
  crossings_kind kind = CROSSINGS_NONE;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    kind = crossings_worse(kind, crossings_segment(c, b, v[i], v[j], above_w[i], above_w[j]));
    kind = crossings_worse(kind, crossings_segment(c, a, w[i], w[j], above_v[i], above_v[j]));
  }
  return kind;
}

/* ---- all pairs: a tree of boxes, halved at the median of the longest axis ---- */

typedef struct { double min[3], max[3]; uint32_t first, count, right; } crossings_node; /* a leaf has right 0; the left
                                                                                         * child of other nodes is the
                                                                                         * next node */

static inline double crossings_middle(const crossings *c, uint32_t t, int axis) {
  double least = INFINITY, most = -INFINITY;
  for (int i = 0; i < 3; i++) {
    double x = c->at[c->triangles[t][i]][axis];
    least = x < least ? x : least;
    most = x > most ? x : most;
  }
  return least + (most - least) / 2;
}

/* Partly sorts the triangles: moves the `half` triangles with the smallest centres to the front (quickselect). */
static inline void crossings_halve(const crossings *c, uint32_t *at, size_t count, size_t half, int axis) {
  size_t low = 0, high = count - 1;
  while (low < high) {
    double pivot = crossings_middle(c, at[low + (high - low) / 2], axis);
    size_t i = low, j = high;
    for (;;) {
      while (crossings_middle(c, at[i], axis) < pivot) i++;
      while (crossings_middle(c, at[j], axis) > pivot) j--;
      if (i >= j) break;
      uint32_t swap = at[i];
      at[i++] = at[j];
      at[j--] = swap;
    }
    if (half <= j) high = j;
    else low = j + 1;
  }
}

static inline uint32_t crossings_tree(const crossings *c, crossings_node *nodes, uint32_t *order, size_t count) {
  enum { SMALL = 4 };
  uint32_t used = 0;
  struct { uint32_t first, count, parent; } stack[64];
  int depth = 1;
  stack[0].first = 0, stack[0].count = (uint32_t)count, stack[0].parent = 0;
  while (depth) {
    uint32_t first = stack[--depth].first, n = stack[depth].count, parent = stack[depth].parent, me = used++;
    crossings_node *o = &nodes[me];
    if (me && me != parent + 1) nodes[parent].right = me;
    *o = (crossings_node){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY }, first, n, 0 };
    for (uint32_t i = first; i < first + n; i++)
      for (int j = 0; j < 9; j++) {
        double x = c->at[c->triangles[order[i]][j / 3]][j % 3];
        if (x < o->min[j % 3]) o->min[j % 3] = x;
        if (x > o->max[j % 3]) o->max[j % 3] = x;
      }
    if (n <= SMALL) continue;
    int axis = 0;
    for (int k = 1; k < 3; k++)
      if (o->max[k] - o->min[k] > o->max[axis] - o->min[axis]) axis = k;
    crossings_halve(c, order + first, n, n / 2, axis);
    /* Pushes the right half of the triangles on the stack, to be divided later. */
    stack[depth].first = first + n / 2, stack[depth].count = n - n / 2, stack[depth++].parent = me;
    stack[depth].first = first, stack[depth].count = n / 2, stack[depth++].parent = me;
  }
  return used;
}

static inline bool crossings_apart(const crossings_node *a, const crossings_node *b) {
  for (int k = 0; k < 3; k++)
    if (a->min[k] > b->max[k] || b->min[k] > a->max[k]) return true;
  return false;
}

static inline void crossings_count(crossings_found *f, crossings_kind kind, uint32_t a, uint32_t b) {
  if (kind == CROSSINGS_NONE) return;
  if (f->count[kind]++ == 0) f->first[kind][0] = a, f->first[kind][1] = b;
}

static inline void crossings_pairs(crossings *c, const crossings_node *nodes, const uint32_t *order, crossings_found *out) {
  struct { uint32_t a, b; } stack[512];
  int depth = 1;
  stack[0].a = stack[0].b = 0;
  while (depth) {
    uint32_t a = stack[--depth].a, b = stack[depth].b;
    const crossings_node *x = &nodes[a], *y = &nodes[b];
    if (a != b && crossings_apart(x, y)) continue;
    if (!x->right && !y->right) {
      for (uint32_t i = 0; i < x->count; i++)
        for (uint32_t j = a == b ? i + 1 : 0; j < y->count; j++) {
          uint32_t s = order[x->first + i], t = order[y->first + j];
          bool apart = false;
          for (int k = 0; k < 3 && !apart; k++) {
            const double *p[6];
            for (int m = 0; m < 6; m++) p[m] = c->at[(m < 3 ? c->triangles[s] : c->triangles[t])[m % 3]];
            apart = fmax(fmax(p[0][k], p[1][k]), p[2][k]) < fmin(fmin(p[3][k], p[4][k]), p[5][k]) ||
                    fmax(fmax(p[3][k], p[4][k]), p[5][k]) < fmin(fmin(p[0][k], p[1][k]), p[2][k]);
          }
          if (!apart) crossings_count(out, crossings_pair(c, s, t), s, t);
        }
      continue;
    }
    if (a == b) {
      stack[depth].a = a + 1, stack[depth++].b = a + 1;
      stack[depth].a = x->right, stack[depth++].b = x->right;
      stack[depth].a = a + 1, stack[depth++].b = x->right;
    } else if (!y->right || (x->right && x->count >= y->count)) {
      stack[depth].a = a + 1, stack[depth++].b = b;
      stack[depth].a = x->right, stack[depth++].b = b;
    } else {
      stack[depth].a = a, stack[depth++].b = b + 1;
      stack[depth].a = a, stack[depth++].b = y->right;
    }
  }
}

typedef struct { crossings_point at; uint32_t number; } crossings_corner;
static inline int crossings_order(const void *a, const void *b) {
  const crossings_corner *x = a, *y = b;
  for (int k = 0; k < 3; k++)
    if (x->at[k] != y->at[k]) return x->at[k] < y->at[k] ? -1 : 1;
  return x->number < y->number ? -1 : x->number > y->number;
}

/* Finds all faults of a mesh. Returns false if memory is exhausted. */
static inline bool crossings_find(const crossings_point *points, size_t point_count, const crossings_triangle *triangles, size_t count, crossings_found *out) {
  *out = (crossings_found){ .count = { 0 } };
  if (count == 0) return true;
  crossings c = { .at = points };
  crossings_corner *corners = malloc((point_count + 1) * sizeof *corners);
  uint32_t *one = malloc((point_count + 1) * sizeof *one), *order = malloc(count * sizeof *order);
  crossings_node *nodes = malloc(2 * count * sizeof *nodes);
  c.triangles = malloc(count * sizeof *c.triangles);
  c.axis = malloc(count);
  bool ok = corners && one && order && nodes && c.triangles && c.axis;
  for (int i = 0; i < 12; i++) mpz_init2(c.x[i], 2400);
  for (int i = 0; i < 8; i++) mpz_init2(c.t[i], 7200);
  if (ok) {
    for (uint32_t i = 0; i < point_count; i++) {
      for (int k = 0; k < 3; k++) corners[i].at[k] = points[i][k] + 0.0;
      corners[i].number = i;
    }
    qsort(corners, point_count, sizeof *corners, crossings_order);
    for (size_t i = 0; i < point_count; i++) {
      bool same = i > 0 && corners[i].at[0] == corners[i - 1].at[0] && corners[i].at[1] == corners[i - 1].at[1] && corners[i].at[2] == corners[i - 1].at[2];
      one[corners[i].number] = same ? one[corners[i - 1].number] : corners[i].number;
    }
    for (uint32_t t = 0; t < count; t++) {
      for (int j = 0; j < 3; j++) c.triangles[t][j] = one[triangles[t][j]];
      order[t] = t;
      const uint32_t *v = c.triangles[t];
      for (c.axis[t] = 0; c.axis[t] < 3 && crossings_turn(&c, c.axis[t], v[0], v[1], v[2]) == 0;) c.axis[t]++;
      if (c.axis[t] == 3) crossings_count(out, CROSSINGS_FLAT, t, t);
    }
    crossings_tree(&c, nodes, order, count);
    crossings_pairs(&c, nodes, order, out);
  }
  for (int i = 0; i < 12; i++) mpz_clear(c.x[i]);
  for (int i = 0; i < 8; i++) mpz_clear(c.t[i]);
  free(corners);
  free(one);
  free(order);
  free(nodes);
  free(c.triangles);
  free(c.axis);
  return ok;
}

static inline size_t crossings_sum(const crossings_found *f) {
  size_t sum = 0;
  for (int i = 0; i < CROSSINGS_KINDS; i++) sum += f->count[i];
  return sum;
}

#endif
