/* Owns, for primitives/ and the pass fold, what an affine map keeps of a shape, and points under a map. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H

#include "model/node.h"

/* All false for a map that flattens. */
typedef struct {
  bool even;    /* a similarity: every length times scale */
  bool upright; /* even, and no turn or mirror at all */
  bool axes;    /* a signed permutation of the axes, with any scales */
  bool plain;   /* axes kept each in its place and sense */
  bool level;   /* even, and Z stays vertical */
  bool about_z; /* level, right-handed, and Z up */
  double scale;
} vs_shape_map;

vs_shape_map vs_shape_map_of(const vs_affine *a);
/* Does a keep discs across the axis discs across its image? *k: by how much it makes them larger. */
bool vs_shape_map_keeps_discs(const vs_affine *a, vs_vec3 axis, double *k);
/* Returns new points, those of old under a. NULL: out of memory. */
vs_points *vs_shape_map_points(vs_store *s, const vs_affine *a, const vs_points *old);

/* The beginning of a `moved` function: d is a copy of n's payload; unless the condition holds, n's kind is not closed
 * under the map. */
#define VS_MOVED(lower, condition)        \
  struct vs_##lower d = *VS_AS(lower, n); \
  *fits = (condition);                    \
  if (!*fits) return NULL

#endif
