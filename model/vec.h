/* Declares the numeric types of a model: vectors of three doubles, boxes and affine maps.
 *
 * Coordinates are right-handed with Z up, lengths in model units, angles in radians. An affine map is the upper 3x4
 * part of a 4x4 matrix that acts on column vectors, stored row by row. Its fourth column is the translation. The last
 * row 0 0 0 1 is not stored. */
#ifndef VS_MODEL_VEC_H
#define VS_MODEL_VEC_H

#include "model/assert.h"

#include <math.h>
#include <stdbool.h>

typedef struct { double x, y, z; } vs_vec3;
typedef struct { double m[3][4]; } vs_affine;
typedef struct { vs_vec3 min, max; } vs_bounds; /* a box; it is empty if min.x > max.x */

static inline vs_vec3 vs_v3(double x, double y, double z) { return (vs_vec3){ x, y, z }; }
static inline vs_vec3 vs_v3_add(vs_vec3 a, vs_vec3 b) { return vs_v3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vs_vec3 vs_v3_sub(vs_vec3 a, vs_vec3 b) { return vs_v3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vs_vec3 vs_v3_scale(vs_vec3 a, double k) { return vs_v3(a.x * k, a.y * k, a.z * k); }
static inline double vs_v3_dot(vs_vec3 a, vs_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vs_vec3 vs_v3_cross(vs_vec3 a, vs_vec3 b) {
  return vs_v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vs_v3_length(vs_vec3 a) { return sqrt(vs_v3_dot(a, a)); }
static inline bool vs_v3_equal(vs_vec3 a, vs_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static inline vs_affine vs_affine_identity(void) {
  return (vs_affine){ { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };
}
static inline vs_vec3 vs_affine_point(const vs_affine *a, vs_vec3 p) {
  return vs_v3(a->m[0][0] * p.x + a->m[0][1] * p.y + a->m[0][2] * p.z + a->m[0][3],
               a->m[1][0] * p.x + a->m[1][1] * p.y + a->m[1][2] * p.z + a->m[1][3],
               a->m[2][0] * p.x + a->m[2][1] * p.y + a->m[2][2] * p.z + a->m[2][3]);
}
static inline vs_vec3 vs_affine_vector(const vs_affine *a, vs_vec3 v) { /* Returns the vector v mapped by the linear
                                                                         * part of a, without the translation. */
  return vs_v3(a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z,
               a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z,
               a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z);
}

/* Returns column c of the matrix of a, from 0 to 3. */
static inline vs_vec3 vs_affine_column(const vs_affine *a, int c) {
  VS_ASSERT(c >= 0 && c < 4);
  return vs_v3(a->m[0][c], a->m[1][c], a->m[2][c]);
}
/* The functions below are defined in vec.c. */
vs_affine vs_affine_columns(vs_vec3 x, vs_vec3 y, vs_vec3 z, vs_vec3 at); /* Returns the map that maps the three unit
                                                                           * vectors to x, y and z, and the origin to
                                                                           * `at`. */
vs_affine vs_affine_multiply(const vs_affine *a, const vs_affine *b); /* Returns the map that applies the map b first,
                                                                       * and then the map a. */
/* Returns the determinant of the linear part of a; it is negative if the map mirrors. */
double vs_affine_determinant(const vs_affine *a);
bool vs_affine_invert(const vs_affine *a, vs_affine *out);            /* Sets *out to the inverse map; returns false if
                                                                       * a is singular. */
/* Maps a plane, which is given by a point and a normal. The new normal points to the image of the same side of the
 * plane. Returns false if the map is singular; the plane is then unchanged. */
bool vs_affine_plane(const vs_affine *a, vs_vec3 *point, vs_vec3 *normal);
bool vs_affine_is_translation(const vs_affine *a);                    /* Returns true if the linear part of a is exactly
                                                                       * the identity. */
bool vs_affine_is_identity(const vs_affine *a);                       /* Returns true if the map a is exactly the
                                                                       * identity. */
bool vs_affine_even(const vs_affine *a, double *k);                   /* Returns true if the map a multiplies every
                                                                       * length by one factor, and sets *k to this
                                                                       * factor. */
vs_affine vs_affine_translation(vs_vec3 v);
/* Returns the right-handed rotation by angle about the axis through point along direction (not zero). Multiples of a
 * quarter turn about a world axis are exact. Otherwise it uses Rodrigues' formula. */
vs_affine vs_affine_rotation(vs_vec3 point, vs_vec3 direction, double angle);
vs_affine vs_affine_scaling(vs_vec3 center, vs_vec3 factors);
vs_affine vs_affine_mirror(vs_vec3 point, vs_vec3 normal);
/* Returns true if the columns of a's linear part are perpendicular to each other, within 1e-9. The map then consists of
 * a scaling along x, y and z, a rotation (perhaps with a mirroring) and a translation. */
bool vs_affine_is_placement(const vs_affine *a);
/* Splits a map for which vs_affine_is_placement is true into a scaling, a rotation (unit quaternion w x y z) and a
 * translation, which are applied in this order. If the map mirrors, scale->x is negative. */
void vs_affine_split(const vs_affine *a, vs_vec3 *translation, double quaternion[4], vs_vec3 *scale);
/* Sets the unit quaternion w x y z of the rotation with the given columns. Computes the largest component first, so
 * that it is accurate even at half turns. */
void vs_rotation_quaternion(const vs_vec3 columns[3], double quaternion[4]);
/* Returns the unit normal of a plane after the map a. n: normal of the plane. It is mapped by the matrix of cofactors,
 * which is the transpose of the inverse times a factor. */
vs_vec3 vs_affine_normal(const vs_affine *a, vs_vec3 n);
/* Sets *sine and *cosine of an angle in radians, exact at multiples of pi/2: the double nearest to k*pi/2 counts as
 * this multiple. */
void vs_sincos(double angle, double *sine, double *cosine);
/* Sets sine and cosine of the angle index/count of a full turn; count is above 0. Quarter turns are exact, and mirrored
 * angles have exactly mirrored values. */
void vs_turn_sincos(int index, int count, double *sine, double *cosine);
double vs_single(double x); /* Returns x rounded to a 32-bit floating-point number. It is a function in another file,
                             * because GCC 12 omits the rounding of two adjacent values in inline code and casts. */
vs_vec3 vs_v3_unit(vs_vec3 v); /* Returns the direction of v as a vector of length 1. Vectors along an axis stay exact;
                                * the zero vector stays zero. */

static inline bool vs_bounds_is_empty(const vs_bounds *b) { return b->min.x > b->max.x; }
static inline vs_bounds vs_bounds_empty(void) {
  return (vs_bounds){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}
/* Extends the box so that it contains p. A NaN coordinate is ignored, as by fmin, which would be a slower function
 * call. */
static inline void vs_bounds_add(vs_bounds *b, vs_vec3 p) {
  b->min = vs_v3(p.x < b->min.x ? p.x : b->min.x, p.y < b->min.y ? p.y : b->min.y, p.z < b->min.z ? p.z : b->min.z);
  b->max = vs_v3(p.x > b->max.x ? p.x : b->max.x, p.y > b->max.y ? p.y : b->max.y, p.z > b->max.z ? p.z : b->max.z);
}
static inline void vs_bounds_unite(vs_bounds *b, const vs_bounds *other) {
  if (vs_bounds_is_empty(other)) return;
  vs_bounds_add(b, other->min);
  vs_bounds_add(b, other->max);
}
void vs_bounds_meet(vs_bounds *b, const vs_bounds *other); /* Replaces *b by the intersection of the boxes *b and
                                                            * *other. */
/* Returns true if the boxes overlap or touch, or if their distance along each axis is at most slack (at least 0). */
static inline bool vs_bounds_overlap(const vs_bounds *a, const vs_bounds *b, double slack) {
  VS_ASSERT(slack >= 0);
  return a->min.x <= b->max.x + slack && b->min.x <= a->max.x + slack && a->min.y <= b->max.y + slack &&
         b->min.y <= a->max.y + slack && a->min.z <= b->max.z + slack && b->min.z <= a->max.z + slack;
}
double vs_bounds_diagonal(const vs_bounds *b);             /* Returns the length of the box's diagonal; 0 if it is
                                                            * empty. */
vs_bounds vs_bounds_transform(const vs_bounds *b, const vs_affine *a);

#endif
