/* Owns giving OpenSCAD's booleans polyhedra that do not touch themselves: they take each place for one corner, and
 * refuse what is no manifold then. */
#ifndef VS_BACKENDS_OPENSCAD_TOUCHING_CORNERS_H
#define VS_BACKENDS_OPENSCAD_TOUCHING_CORNERS_H

#include "model/node.h"

typedef struct {
  vs_vec3 *points;   /* NULL: the mesh touches itself nowhere, or cannot be told apart; it stays as it is */
  size_t count;
  uint32_t *corners; /* as many as the mesh has, for its faces' starts */
} vs_apart;

/* Points and corners of a closed mesh in which corners that meet only there lie some 1e-5 apart. False: out of
 * memory. */
bool vs_apart_make(const struct vs_polyface_mesh *mesh, vs_apart *out);
void vs_apart_free(vs_apart *a);

#endif
