/* Declares the bounds of a half-space, and the triangles of a finite part of it. */
#ifndef VS_GEOMETRY_PRIMITIVES_HALF_SPACE_H
#define VS_GEOMETRY_PRIMITIVES_HALF_SPACE_H

#include "model/mesh.h"

/* Sets *b to the bounds of a half-space mapped by a. The half-space is given by a point and the normal of its plane.
 * The bounds are infinite; only if the mapped plane is perpendicular to an axis, they end at this plane. */
void vs_half_space_bounds(vs_bounds *b, const vs_affine *a, vs_vec3 point, vs_vec3 normal);
/* Appends the triangles of a finite part of the half-space. The part contains the intersection of the half-space with
 * the box `reach`, and one of its faces lies exactly in the plane. Appends nothing if `reach` is entirely outside.
 * Returns false when memory is out. */
bool vs_half_space_triangles(vs_mesh *out, vs_vec3 point, vs_vec3 normal, const vs_bounds *reach);

#endif
