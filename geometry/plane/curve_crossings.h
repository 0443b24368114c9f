/* Declares the functions for the test whether curves that bound a region cross each other, or themselves. */
#ifndef VS_GEOMETRY_PLANE_CURVE_CROSSINGS_H
#define VS_GEOMETRY_PLANE_CURVE_CROSSINGS_H

#include "model/node.h"

typedef struct { size_t a, b; /* equal: it crosses itself */ vs_vec3 at; bool found; } vs_crossing;
/* Finds a crossing of closed curves of one plane with each other, or themselves. Round curves may touch: a crossing no
 * deeper than the accuracy of the samples does not count. Returns false with the reason in e. */
bool vs_curves_cross(const vs_ref *refs, size_t count, vs_crossing *out, vs_error *e);

#endif
