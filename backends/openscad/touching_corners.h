/* Owns polyhedra that do not touch themselves, for OpenSCAD's booleans: these merge all corners at one point, and
 * refuse a result that is no manifold. */
#ifndef VS_BACKENDS_OPENSCAD_TOUCHING_CORNERS_H
#define VS_BACKENDS_OPENSCAD_TOUCHING_CORNERS_H

#include "model/node.h"

typedef struct {
  vs_vec3 *points;   /* NULL: the mesh does not touch itself, or cannot be separated; it stays unchanged */
  size_t count;
  uint32_t *corners; /* as many as the mesh has, for its faces' starts */
} vs_apart;

/* Returns points and corners of a closed mesh in which corners that only touch are some 1e-5 apart. Returns false when
 * memory is out. */
bool vs_apart_make(const struct vs_polyface_mesh *mesh, vs_apart *out);
void vs_apart_free(vs_apart *a);

#endif
