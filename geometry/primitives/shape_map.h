/* Declares, for primitives/ and the pass fold, the properties of a shape that an affine map preserves, and the mapping
 * of points. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H

#include "model/node.h"

/* The properties of shapes that an affine map preserves. All are false if the map is singular. */
typedef struct {
  bool even;    /* true if the map multiplies every length by `scale` */
  bool upright; /* true if the map multiplies every length by `scale`, and contains no rotation and reflection */
  bool axes;    /* true if the map maps each axis to an axis, with any signs and scales */
  bool plain;   /* true if the map only scales along the axes, each with a positive factor */
  bool level;   /* true if the map multiplies every length by `scale`, and keeps vertical directions vertical */
  bool about_z; /* true if `level` is true and the map is right-handed and keeps +Z upwards */
  double scale;
} vs_shape_map;

vs_shape_map vs_shape_map_of(const vs_affine *a);
/* Returns true if the map a changes discs perpendicular to the axis to discs perpendicular to the mapped axis. *k:
 * factor by which the discs' radii change. */
bool vs_shape_map_keeps_discs(const vs_affine *a, vs_vec3 axis, double *k);
/* Returns a new array with the points `old` mapped by a, or NULL when memory is out. */
vs_points *vs_shape_map_points(vs_store *s, const vs_affine *a, const vs_points *old);

/* Begins the function NAME_moved of a kind, which maps a node. Copies the fields of n to d. If the condition is false,
 * the mapped node is not of this kind, so the function returns NULL with *fits false. */
#define VS_MOVED(lower, condition)        \
  struct vs_##lower d = *VS_AS(lower, n); \
  *fits = (condition);                    \
  if (!*fits) return NULL

#endif
