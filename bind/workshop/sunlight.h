/* Declares functions of sunlight.c: reading a moment (a place on the earth, a date and a time), and collecting the
 * triangles of objects that cast shadows. */
#ifndef VS_BIND_WORKSHOP_SUNLIGHT_H
#define VS_BIND_WORKSHOP_SUNLIGHT_H

#include "geometry/measure/ray_tree.h"
#include "geometry/sun_position.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;

/* Reads a moment from four arguments: latitude, longitude (default 0), date, and time (default noon). If it fails, sets
 * the error and returns false. */
bool vs_bind_moment(vs_args *f, const vs_arg *place, vs_sun_moment *out);

typedef struct {
  vs_mesh mesh;
  vs_ray_tree tree; /* of the mesh; empty if `any` is false */
  size_t *ends;     /* for each object: the number of triangles up to its last one */
  size_t count;     /* of `ends` in memory */
  bool any;         /* whether there are triangles */
  double size;      /* the diagonal of the mesh's bounding box, or 0 */
} vs_shades;

/* Sets *s to the triangles of the objects in an argument of the contract OBJECTS, named `among`. If it fails, sets the
 * error and returns false. The caller frees *s in both cases. */
bool vs_bind_shades(vs_args *f, size_t argument, vs_shades *s);
void vs_bind_shades_free(vs_args *f, vs_shades *s);

#endif
