/* Declares a test whether curves that bound a region cross each other or themselves. */
#ifndef VS_GEOMETRY_PLANE_CURVE_CROSSINGS_H
#define VS_GEOMETRY_PLANE_CURVE_CROSSINGS_H

#include "model/node.h"

typedef struct {
  size_t a, b; /* indices of the two curves that cross; equal if a curve crosses itself */
  vs_vec3 at;
  bool found;
} vs_crossing;
/* Finds a crossing of closed curves in one plane with each other or with themselves. Curves may touch: a crossing no
 * deeper than the accuracy of the samples is ignored. out->found: true if there is a crossing. Returns false and sets e
 * on failure. */
bool vs_curves_cross(const vs_ref *refs, size_t count, vs_crossing *out, vs_error *e);

#endif
