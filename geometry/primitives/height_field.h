/* Declares the triangles of height fields, for use in geometry/ alone. */
#ifndef VS_GEOMETRY_PRIMITIVES_HEIGHT_FIELD_H
#define VS_GEOMETRY_PRIMITIVES_HEIGHT_FIELD_H

#include "model/mesh.h"
#include "model/node.h"

/* Appends the mesh of height field h: two triangles for each cell of the grid, walls, and a floor at the height h->low.
 * Omits triangles whose three samples are on the floor. Returns false when memory is out. */
bool vs_height_field_mesh(vs_mesh *out, const struct vs_height_field *h);

#endif
