/* Declares, for use in geometry/ alone, the triangles of height fields. */
#ifndef VS_GEOMETRY_PRIMITIVES_HEIGHT_FIELD_H
#define VS_GEOMETRY_PRIMITIVES_HEIGHT_FIELD_H

#include "model/mesh.h"
#include "model/node.h"

/* Makes two triangles for each cell, along the diagonal from its least corner to its greatest, walls, and a floor at
 * low. A triangle of three samples on the floor is omitted. Returns false when memory is out. */
bool vs_height_field_mesh(vs_mesh *out, const struct vs_height_field *h);

#endif
