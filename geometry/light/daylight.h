/* Declares the daylight of an overcast sky (CIE) that reaches a place by reflections among surfaces. */
#ifndef VS_GEOMETRY_LIGHT_DAYLIGHT_H
#define VS_GEOMETRY_LIGHT_DAYLIGHT_H

#include "geometry/measure/ray_tree.h"

/* Surfaces among which light is reflected, equally in all directions. All arrays belong to the caller. */
typedef struct {
  const vs_ray_tree *tree;    /* NULL: there are no surfaces */
  const double *reflectances; /* of each triangle: the part of the light that its surface reflects, below 1 */
  double ground;              /* the part that the ground reflects; it lies beneath all, and no surface shades it */
  double step;                /* a small length: rays leave surfaces at this distance */
} vs_daylit;

/* The paths of a place: those from `first` up to `end`, of `all`. */
typedef struct { size_t first, end, all; } vs_light_paths;

/* Returns the illuminance that reaches a place by reflections along these paths, with 1 for a level place in the open.
 * All paths together give the place's illuminance. normal: unit vector of the surface at the place. Each call uses the
 * same directions. */
double vs_daylight_reflected(const vs_daylit *d, vs_vec3 at, vs_vec3 normal, vs_light_paths paths);

#endif
