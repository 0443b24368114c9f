/* Owns, for geometry/ alone, the steps of a sweep that bends more tightly than its profile is wide. */
#ifndef VS_GEOMETRY_PROFILES_OVERTURN_H
#define VS_GEOMETRY_PROFILES_OVERTURN_H

#include "geometry/profiles/swept.h"

/* at: the points of all sections, section by section, and once more those of the first where the last goes on to it;
 * size: of the whole sweep. The sections' x and y turn right-handed about the way. Does part of the profile go
 * backwards from section `step` to the one that follows it? */
bool vs_overturns(const vs_swept *s, const vs_vec3 *at, size_t step, double size);
/* Appends the solids of the steps between the sections from and to; they overlap each other and what comes before and
 * after. False: out of memory. */
bool vs_overturn_mesh(const vs_swept *s, const vs_vec3 *at, size_t from, size_t to, double size, vs_mesh *out);

#endif
