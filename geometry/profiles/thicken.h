/* Declares the thickening of surfaces given as triangles. */
#ifndef VS_GEOMETRY_PROFILES_THICKEN_H
#define VS_GEOMETRY_PROFILES_THICKEN_H

#include "model/mesh.h"

/* Appends the closed shell between two copies of the surface at these distances, on the side that its facets face
 * and on the other; a closed surface gives a shell with a cavity. *turns (may be NULL): a facet of a copy is
 * reversed, because the surface's radius is smaller than the distance; *turned: its position. Returns false when
 * memory is out. */
bool vs_thicken_surface(const vs_mesh *surface, double outwards, double inwards, vs_mesh *out, vs_vec3 *turned,
                        bool *turns);

#endif
