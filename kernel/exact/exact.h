/* Declares the exact numbers: fixed-width integers, planes and points, and the predicates on them that make all
 * decisions.
 *
 * Notation. Coordinates are in steps of the cluster's grid; vertices of the input are integers, |x| < 2^31.
 *   plane   n.x = d, n primitive: |n| < 2^63, |d| < 2^96. (A normal of two edges of 2^32 steps could
 *           have 64 bits: snap_to_grid.c then takes a coarser grid.)
 *   point   X/W, W > 0. For a vertex of the input W = 1; for edge x plane |X| < 2^130, W < 2^97; for three planes
 *           |X| < 2^226, W < 2^192.
 *   fixed   floor(X/W * 2^30) for each coordinate: a number of 62 bits that every point has. Equal points have equal
 *           numbers, however they were computed.
 *
 * The fixed-point numbers serve as a key, and as a filter. A predicate computed from them in __int128 has a known error
 * of a few units. Therefore wide integers are needed only if points lie within 2^-30 steps of each other, of a line or
 * of a plane. These predicates fit into 127 bits: n.x - d has |n| |x| 3 < 2^126 and |d| 2^30 < 2^126; a turn in a plane
 * is two products of differences below 2^62. A point whose three fractions are zero is `exact`: only its fixed-point
 * numbers are stored. The widest results have 292 bits for a point against a plane, 420 for one coordinate of two
 * points, and 648 for the orientation of three points in a plane. If triangles are small compared to the cluster,
 * numbers are small, and the functions with wide integers use a faster method. */
#ifndef VS_KERNEL_EXACT_EXACT_H
#define VS_KERNEL_EXACT_EXACT_H

#include "model/assert.h"

#include <stdbool.h>
#include <stdint.h>

__extension__ typedef __int128 vs_i128;
__extension__ typedef unsigned __int128 vs_u128;

enum { VS_FIXED_BITS = 30, VS_GRID_BITS = 31, VS_LIMBS = 4 };
#define VS_POINT_EXACT UINT32_MAX
#define VS_POINT_MORE (UINT32_C(1) << 31)

typedef struct {
  int64_t n[3];
  vs_i128 d;
  uint8_t k, u, v; /* k: axis along which the normal has its largest component; u, v: the other two axes, in such an
                    * order that a counter-clockwise turn in (u, v) is counter-clockwise as seen from the normal's
                    * tip */
} vs_plane;

typedef struct {
  uint64_t x[3][VS_LIMBS], w[VS_LIMBS]; /* the point is x / w in grid steps; x and w are two's complement integers,
                                         * least limb first; w > 0 */
} vs_homogeneous;

typedef struct {
  int64_t fixed[3];
  uint32_t big; /* VS_POINT_EXACT if the fixed-point numbers are exact; otherwise the index of the point's exact
                 * coordinates in the lists of vs_points_view: in `more` if the bit VS_POINT_MORE is set, else in
                 * `big` */
  uint32_t next; /* next point with the same hash, only in the tables that arrange_planes.c makes for each plane */
} vs_point;

/* Read access to the fixed-point and exact coordinates of all points of a table, for the predicates. */
typedef struct {
  const vs_point *at;
  const vs_homogeneous *big, *more;
} vs_points_view;

static inline int vs_sign128(vs_i128 x) { return (x > 0) - (x < 0); }

/* Computes the plane through three integer points. *flipped: true if the plane's normal is opposite to the normal of
 * the triangle a, b, c. Returns false if the points are collinear, or a component of the normal does not fit into 63
 * bits. */
bool vs_plane_through(const int32_t a[3], const int32_t b[3], const int32_t c[3], vs_plane *out, bool *flipped);
void vs_plane_axes(vs_plane *p);
/* Computes the plane that contains the integer points a and b and is parallel to axis k. The components of its normal
 * may have a common divisor. a and b differ along another axis than k. */
void vs_plane_along(const int32_t a[3], const int32_t b[3], int k, vs_plane *out);
/* returns the sign of the determinant of b - a, c - a and d - a: on which side of triangle a b c the point d lies */
int vs_orient3d(const int32_t a[3], const int32_t b[3], const int32_t c[3], const int32_t d[3]);

/* vs_meet_edge computes the intersection of the line through a and b with plane p, where a and b are on different sides
 * of p. vs_meet_planes computes the intersection of three planes. The functions return false if the intersection is not
 * a single point. */
bool vs_meet_edge(const int32_t a[3], const int32_t b[3], const vs_plane *p, vs_homogeneous *out);
bool vs_meet_planes(const vs_plane *p, const vs_plane *q, const vs_plane *r, vs_homogeneous *out);
/* Computes the coordinates of point h rounded down to fixed-point numbers. Returns true if these are exact. h->w >
 * 0. */
bool vs_homogeneous_fix(const vs_homogeneous *h, int64_t fixed[3]);
void vs_homogeneous_integer(const int32_t at[3], vs_homogeneous *out);
void vs_homogeneous_fixed(const int64_t fixed[3], vs_homogeneous *out); /* converts the fixed-point coordinates of a
                                                                         * point, which are exact, to a homogeneous
                                                                         * point */
/* Compares the positions of points a and b along an axis, 0, 1 or 2. w > 0 for both points. */
int vs_homogeneous_compare(const vs_homogeneous *a, const vs_homogeneous *b, int axis); /* returns 1 if a is greater
                                                                                         * than b along the axis, -1 if
                                                                                         * less, 0 if equal */
bool vs_homogeneous_equal(const vs_homogeneous *a, const vs_homogeneous *b);
/* Returns the side of the plane on which the point lies: 1 on the side of the normal, -1 on the opposite side, 0 in the
 * plane. h->w > 0. */
int vs_homogeneous_side(const vs_plane *p, const vs_homogeneous *h);
/* Computes the point of the plane p whose other two coordinates, as seen along axis k, are the fixed-point numbers u
 * and v. n[k] is not 0. */
void vs_plane_lift(const vs_plane *p, int k, int64_t u, int64_t v, vs_homogeneous *out);

static inline bool vs_point_exact(const vs_point *p) { return p->big == VS_POINT_EXACT; }
static inline int32_t vs_point_grid(const vs_point *p, int axis) { return (int32_t)(p->fixed[axis] >> VS_FIXED_BITS); }

int vs_side_slow(vs_points_view v, const vs_plane *p, uint32_t x);
/* Sets *sign to the side of plane p on which point x lies: the sign of n.x - d. Returns false if the fixed-point
 * numbers of the point do not decide it. */
static inline bool vs_side_quick(vs_points_view v, const vs_plane *p, uint32_t x, int *sign) {
  const vs_point *q = &v.at[x];
  vs_i128 s = (vs_i128)p->n[0] * q->fixed[0] + (vs_i128)p->n[1] * q->fixed[1] + (vs_i128)p->n[2] * q->fixed[2] -
              p->d * ((vs_i128)1 << VS_FIXED_BITS);
  *sign = vs_sign128(s);
  if (vs_point_exact(q)) return true;
  vs_i128 low = s, high = s; /* a fixed-point coordinate is the exact coordinate rounded down, so it is less than 1
                              * below it */
  for (int i = 0; i < 3; i++) {
    if (p->n[i] < 0) low += p->n[i];
    else high += p->n[i];
  }
  return low > 0 || high < 0;
}
/* Returns the side of plane p on which point x lies: the sign of n.x - d. */
static inline int vs_side(vs_points_view v, const vs_plane *p, uint32_t x) {
  int sign;
  return vs_side_quick(v, p, x, &sign) ? sign : vs_side_slow(v, p, x);
}

int vs_compare_slow(vs_points_view v, uint32_t a, uint32_t b, int axis);
static inline int vs_compare(vs_points_view v, uint32_t a, uint32_t b, int axis) {
  int64_t x = v.at[a].fixed[axis], y = v.at[b].fixed[axis];
  if (x != y) return x < y ? -1 : 1;
  if (a == b || (vs_point_exact(&v.at[a]) && vs_point_exact(&v.at[b]))) return 0;
  return vs_compare_slow(v, a, b, axis);
}

int vs_orient2d_slow(vs_points_view v, uint32_t a, uint32_t b, uint32_t c, int axis_u, int axis_v);
enum { VS_UNSURE = 2 }; /* result of a quick test that cannot decide the sign, because rounding errors are too large */
/* Returns the orientation of points a, b, c as vs_orient2d does, if their fixed-point numbers decide it, else
 * VS_UNSURE. */
static inline int vs_orient2d_quick(vs_points_view v, uint32_t a, uint32_t b, uint32_t c, int axis_u, int axis_v) {
  const vs_point *p = &v.at[a], *q = &v.at[b], *r = &v.at[c];
  int64_t ax = q->fixed[axis_u] - p->fixed[axis_u], ay = q->fixed[axis_v] - p->fixed[axis_v];
  int64_t bx = r->fixed[axis_u] - p->fixed[axis_u], by = r->fixed[axis_v] - p->fixed[axis_v];
  vs_i128 det = (vs_i128)ax * by - (vs_i128)ay * bx;
  if (vs_point_exact(p) && vs_point_exact(q) && vs_point_exact(r)) return vs_sign128(det);
  vs_i128 error = (vs_i128)(ax < 0 ? -ax : ax) + (by < 0 ? -by : by) + (ay < 0 ? -ay : ay) + (bx < 0 ? -bx : bx) + 2;
  return det > error || det < -error ? vs_sign128(det) : VS_UNSURE;
}
/* Returns the sign of the area of the triangle a, b, c as seen in the axes (u, v): 1 if c is to the left of a->b. */
static inline int vs_orient2d(vs_points_view v, uint32_t a, uint32_t b, uint32_t c, int axis_u, int axis_v) {
  int sign = vs_orient2d_quick(v, a, b, c, axis_u, axis_v);
  return sign != VS_UNSURE ? sign : vs_orient2d_slow(v, a, b, c, axis_u, axis_v);
}

#endif
