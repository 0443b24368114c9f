/* Declares the area around other areas, which drawings show as earth. */
#ifndef VS_GEOMETRY_PLANE_EARTH_AREAS_H
#define VS_GEOMETRY_PLANE_EARTH_AREAS_H

#include "geometry/plane/areas.h"

/* Makes the part of a box, from corner box[0] to corner box[1], that lies outside the area of the directed edges. Keeps
 * only pieces that reach the left, right or lower side of the box, or if `upper` is true, its upper side. out must be
 * empty. Returns false and sets e on failure. */
bool vs_earth_around(const vs_vec2 (*edges)[2], size_t count, const vs_vec2 box[2], bool upper, vs_area *out,
                     vs_error *e);

#endif
