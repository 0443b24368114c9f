/* Owns the small numeric types of a model: vectors of three doubles and affine maps.
 *
 * Right-handed, Z up, lengths in model units, angles in radians. An affine map is the upper 3x4 of a 4x4 matrix that
 * acts on column vectors, row by row: the fourth column translates; the last row is 0 0 0 1 and is not stored. */
#ifndef VS_MODEL_VEC_H
#define VS_MODEL_VEC_H

#include "model/assert.h"

#include <math.h>
#include <stdbool.h>

typedef struct { double x, y, z; } vs_vec3;
typedef struct { double m[3][4]; } vs_affine;
typedef struct { vs_vec3 min, max; } vs_bounds; /* empty if min.x > max.x */

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
static inline vs_vec3 vs_affine_vector(const vs_affine *a, vs_vec3 v) { /* applies only the linear part */
  return vs_v3(a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z,
               a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z,
               a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z);
}

/* Returns column c, 0 to 3. */
static inline vs_vec3 vs_affine_column(const vs_affine *a, int c) {
  VS_ASSERT(c >= 0 && c < 4);
  return vs_v3(a->m[0][c], a->m[1][c], a->m[2][c]);
}
/* vec.c */
vs_affine vs_affine_columns(vs_vec3 x, vs_vec3 y, vs_vec3 z, vs_vec3 at); /* the images of the axes' unit vectors and of
                                                                           * the origin */
vs_affine vs_affine_multiply(const vs_affine *a, const vs_affine *b); /* a after b */
/* Returns that of the linear part; negative if it mirrors. */
double vs_affine_determinant(const vs_affine *a);
bool vs_affine_invert(const vs_affine *a, vs_affine *out);            /* returns false if singular */
/* Maps a plane; its normal then points to the image of the same side. Returns false if the map is singular; nothing is
 * then changed. */
bool vs_affine_plane(const vs_affine *a, vs_vec3 *point, vs_vec3 *normal);
bool vs_affine_is_translation(const vs_affine *a);                    /* the linear part is exactly the identity */
bool vs_affine_is_identity(const vs_affine *a);                       /* exactly */
bool vs_affine_even(const vs_affine *a, double *k);                   /* returns true if it multiplies every length by
                                                                       * the same k */
vs_affine vs_affine_translation(vs_vec3 v);
/* Returns the rotation by angle about the axis through point along direction (need not be unit; not zero).
 * Right-handed; multiples of a quarter turn about a world axis are exact (Rodrigues' formula otherwise). */
vs_affine vs_affine_rotation(vs_vec3 point, vs_vec3 direction, double angle);
vs_affine vs_affine_scaling(vs_vec3 center, vs_vec3 factors);
vs_affine vs_affine_mirror(vs_vec3 point, vs_vec3 normal);
/* Returns true if the linear part is a rotation (perhaps mirrored) after a scale along x, y and z: its columns are
 * perpendicular, to 1e-9. */
bool vs_affine_is_placement(const vs_affine *a);
/* Splits such a map into scale, applied first, rotation (a unit quaternion w x y z), and translation; if it mirrors,
 * scale x is negative. */
void vs_affine_split(const vs_affine *a, vs_vec3 *translation, double quaternion[4], vs_vec3 *scale);
/* Returns the unit quaternion w x y z of the rotation with these columns; it begins with the largest component, and
 * therefore is accurate at half turns. */
void vs_rotation_quaternion(const vs_vec3 columns[3], double quaternion[4]);
/* Returns a unit normal transformed by the inverse transpose, which is the linear part's cofactors (and its sign). */
vs_vec3 vs_affine_normal(const vs_affine *a, vs_vec3 n);
/* Returns sine and cosine, exact at multiples of pi/2 (the double nearest to k*pi/2 counts as that multiple). */
void vs_sincos(double angle, double *sine, double *cosine);
/* Returns sine and cosine of index/count of a turn: quarters exact, mirror images of each other to the last bit. count
 * is above 0. */
void vs_turn_sincos(int index, int count, double *sine, double *cosine);
double vs_single(double x); /* rounded to 32 bits; neither inline nor a cast, since GCC 12 omits the rounding of two
                             * adjacent ones */
vs_vec3 vs_v3_unit(vs_vec3 v); /* axes stay exact; the zero vector stays zero */

static inline bool vs_bounds_is_empty(const vs_bounds *b) { return b->min.x > b->max.x; }
static inline vs_bounds vs_bounds_empty(void) {
  return (vs_bounds){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}
/* Omits a not-a-number, as fmin does; fmin is a call. */
static inline void vs_bounds_add(vs_bounds *b, vs_vec3 p) {
  b->min = vs_v3(p.x < b->min.x ? p.x : b->min.x, p.y < b->min.y ? p.y : b->min.y, p.z < b->min.z ? p.z : b->min.z);
  b->max = vs_v3(p.x > b->max.x ? p.x : b->max.x, p.y > b->max.y ? p.y : b->max.y, p.z > b->max.z ? p.z : b->max.z);
}
static inline void vs_bounds_unite(vs_bounds *b, const vs_bounds *other) {
  if (vs_bounds_is_empty(other)) return;
  vs_bounds_add(b, other->min);
  vs_bounds_add(b, other->max);
}
void vs_bounds_meet(vs_bounds *b, const vs_bounds *other); /* the intersection of both */
/* Returns true if two boxes have a common point, or their distance on every axis is at most slack, 0 or more. */
static inline bool vs_bounds_overlap(const vs_bounds *a, const vs_bounds *b, double slack) {
  VS_ASSERT(slack >= 0);
  return a->min.x <= b->max.x + slack && b->min.x <= a->max.x + slack && a->min.y <= b->max.y + slack &&
         b->min.y <= a->max.y + slack && a->min.z <= b->max.z + slack && b->min.z <= a->max.z + slack;
}
double vs_bounds_diagonal(const vs_bounds *b);             /* 0 if empty */
vs_bounds vs_bounds_transform(const vs_bounds *b, const vs_affine *a);

#endif
