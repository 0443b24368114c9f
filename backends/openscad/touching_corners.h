/* Declares polyhedra that do not touch themselves, for OpenSCAD's booleans. OpenSCAD merges all corners at a point, and
 * refuses a result that is not a manifold. */
#ifndef VS_BACKENDS_OPENSCAD_TOUCHING_CORNERS_H
#define VS_BACKENDS_OPENSCAD_TOUCHING_CORNERS_H

#include "model/node.h"

typedef struct {
  vs_vec3 *points;   /* the points after the separation; NULL: the mesh does not touch itself or cannot be separated,
                      * and is not changed */
  size_t count;
  uint32_t *corners; /* corners[i]: index of the point at corner i, in the order of the mesh's faces */
} vs_apart;

/* Computes points and corners of a closed mesh. Corners at which the mesh only touched itself are then about 1e-5
 * apart. Returns false if memory is out. */
bool vs_apart_make(const struct vs_polyface_mesh *mesh, vs_apart *out);
void vs_apart_free(vs_apart *a);

#endif
