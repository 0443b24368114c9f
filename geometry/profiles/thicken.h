/* Owns the thickening of surfaces given as triangles. */
#ifndef VS_GEOMETRY_PROFILES_THICKEN_H
#define VS_GEOMETRY_PROFILES_THICKEN_H

#include "model/mesh.h"

/* Appends the closed shell between two copies of the surface, which lie these distances from it, on the side that its
 * facets face and on the other; a closed surface gets a shell with a hollow. *turns, where it is asked for: a facet of
 * a copy came out turned round, since the surface bends more tightly than the distance; *turned: where. False: out of
 * memory. */
bool vs_thicken_surface(const vs_mesh *surface, double outwards, double inwards, vs_mesh *out, vs_vec3 *turned,
                        bool *turns);

#endif
