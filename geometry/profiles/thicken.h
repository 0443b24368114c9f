/* Declares the thickening of surfaces that consist of triangles. */
#ifndef VS_GEOMETRY_PROFILES_THICKEN_H
#define VS_GEOMETRY_PROFILES_THICKEN_H

#include "model/mesh.h"

/* Appends the closed shell between two copies of the surface: one at the distance `outwards`, on the side that its
 * facets face, and one at `inwards` on the other side. *turns: true if a facet of a copy is reversed; *turned: position
 * of this facet. turns may be NULL. Returns false when memory is out. */
bool vs_thicken_surface(const vs_mesh *surface, double outwards, double inwards, vs_mesh *out, vs_vec3 *turned,
                        bool *turns);

#endif
