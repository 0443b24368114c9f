/* Owns the half-space where something finite needs it: its bounds and the triangles of a part. */
#ifndef VS_GEOMETRY_PRIMITIVES_HALF_SPACE_H
#define VS_GEOMETRY_PRIMITIVES_HALF_SPACE_H

#include "model/mesh.h"

/* Answers all of space, less what a plane across an axis keeps off; a is applied to the plane. */
void vs_half_space_bounds(vs_bounds *b, const vs_affine *a, vs_vec3 point, vs_vec3 normal);
/* Appends the triangles of the part of a half-space that lies in reach, and of some more round it; one face is in the
 * plane, exactly. Appends none where all of reach is outside. False: out of memory. */
bool vs_half_space_triangles(vs_mesh *out, vs_vec3 point, vs_vec3 normal, const vs_bounds *reach);

#endif
