/* Declares the bounds of a half-space, and the triangles of a finite part of it. */
#ifndef VS_GEOMETRY_PRIMITIVES_HALF_SPACE_H
#define VS_GEOMETRY_PRIMITIVES_HALF_SPACE_H

#include "model/mesh.h"

/* Sets the bounds to all of space, less the side that a plane perpendicular to an axis excludes; a is applied to the
 * plane. */
void vs_half_space_bounds(vs_bounds *b, const vs_affine *a, vs_vec3 point, vs_vec3 normal);
/* Appends the triangles of a part of a half-space that includes its intersection with reach; a face is exactly in the
 * plane. Appends none if all of reach is outside. Returns false when memory is out. */
bool vs_half_space_triangles(vs_mesh *out, vs_vec3 point, vs_vec3 normal, const vs_bounds *reach);

#endif
