/* Declares which properties of a shape survive an affine map, and the mapping of points; for primitives/ and the pass
 * fold. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_MAP_H

#include "model/node.h"

/* The properties of a shape that survive an affine map. All are false if the map is singular. */
typedef struct {
  bool even;    /* true if the map multiplies every length by `scale` */
  bool upright; /* true if the map multiplies every length by `scale`, without any rotation or reflection */
  bool axes;    /* true if the map maps each axis to an axis, with any signs and scales */
  bool plain;   /* true if the map only scales along the axes, by a positive factor for each axis */
  bool level;   /* true if the map multiplies every length by `scale`, and maps vertical directions to vertical
                 * directions */
  bool about_z; /* true if `level` is true, and the map also keeps +Z upwards and contains no reflection */
  double scale;
} vs_shape_map;

vs_shape_map vs_shape_map_of(const vs_affine *a);
/* Returns true if the map a maps discs perpendicular to the given axis to discs perpendicular to the mapped axis. *k:
 * factor by which the radii of the discs change. */
bool vs_shape_map_keeps_discs(const vs_affine *a, vs_vec3 axis, double *k);
/* Returns a new array with the points `old` mapped by a, or NULL when memory is out. */
vs_points *vs_shape_map_points(vs_store *s, const vs_affine *a, const vs_points *old);

/* Begins the function NAME_moved of a kind, which returns a mapped node: copies the fields of n to d. If `condition` is
 * false, the mapped shape is not of this kind; the function then returns NULL with *fits false. */
#define VS_MOVED(lower, condition)        \
  struct vs_##lower d = *VS_AS(lower, n); \
  *fits = (condition);                    \
  if (!*fits) return NULL

#endif
