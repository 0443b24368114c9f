/* Owns, for geometry/ alone, height fields: their triangles, and what lies between the heights and the floor. */
#ifndef VS_GEOMETRY_HEIGHTS_H
#define VS_GEOMETRY_HEIGHTS_H

#include "model/mesh.h"
#include "model/node.h"

/* Two triangles a cell, cut from its least corner to its greatest; walls and a floor at low. Samples on the floor touch it there: a triangle with three of
 * them is left out. False: out of memory. */
bool vs_height_field_mesh(vs_mesh *out, const struct vs_height_field *h);
/* Whether sample i has anything above or below it: it or a neighbour along a triangle's side is above the floor. */
bool vs_height_field_uses(const struct vs_height_field *h, uint32_t i);
bool vs_height_field_holds(const struct vs_height_field *h, vs_vec3 p);

#endif
