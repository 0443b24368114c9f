/* Owns, for geometry/ alone, the triangles of height fields. */
#ifndef VS_GEOMETRY_PRIMITIVES_HEIGHT_FIELD_H
#define VS_GEOMETRY_PRIMITIVES_HEIGHT_FIELD_H

#include "model/mesh.h"
#include "model/node.h"

/* Two triangles a cell, cut from its least corner to its greatest; walls and a floor at low. Samples on the floor touch
 * it there: a triangle with three of them is left out. False: out of memory. */
bool vs_height_field_mesh(vs_mesh *out, const struct vs_height_field *h);

#endif
