/* Declares, for primitives/ and the pass fold, the properties of a shape that an affine map keeps, and points under a
 * map. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H

#include "model/node.h"

/* All false for a singular map. */
typedef struct {
  bool even;    /* a similarity: multiplies every length by scale */
  bool upright; /* even, without rotation or reflection */
  bool axes;    /* a signed permutation of the axes, with any scales */
  bool plain;   /* every axis keeps its place and direction */
  bool level;   /* even, and Z stays vertical */
  bool about_z; /* level, right-handed, and Z up */
  double scale;
} vs_shape_map;

vs_shape_map vs_shape_map_of(const vs_affine *a);
/* Returns true if discs perpendicular to the axis become discs perpendicular to its image. *k: their scale. */
bool vs_shape_map_keeps_discs(const vs_affine *a, vs_vec3 axis, double *k);
/* Returns a new array with the old points under a. NULL: out of memory. */
vs_points *vs_shape_map_points(vs_store *s, const vs_affine *a, const vs_points *old);

/* Begins a `moved` function: d is a copy of n's payload. If the condition is false, n's kind is not closed under the
 * map. */
#define VS_MOVED(lower, condition)        \
  struct vs_##lower d = *VS_AS(lower, n); \
  *fits = (condition);                    \
  if (!*fits) return NULL

#endif
