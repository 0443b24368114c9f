/* Owns whether curves that are to bound a region cross each other, or themselves. */
#ifndef VS_GEOMETRY_PLANE_CURVE_CROSSINGS_H
#define VS_GEOMETRY_PLANE_CURVE_CROSSINGS_H

#include "model/node.h"

typedef struct { size_t a, b; /* which curves; the same one: it crosses itself */ vs_vec3 at; bool found; } vs_crossing;
/* Do closed curves of one plane cross each other, or themselves? Round ones may touch: what is no deeper than the
 * samples can tell is none. False: e says why. */
bool vs_curves_cross(const vs_ref *refs, size_t count, vs_crossing *out, vs_error *e);

#endif
