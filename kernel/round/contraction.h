/* Declares the last method against intersections that rounding causes: it unites corners and removes low triangles. */
#ifndef VS_KERNEL_ROUND_CONTRACTION_H
#define VS_KERNEL_ROUND_CONTRACTION_H

#include "kernel/round/rounding_state.h"

/* Near intersecting triangles, unites corners within `units` units of the last place of each other, and removes
 * triangles lower than this. all: false: only triangles whose direction rounding changes. *count: number of changes.
 * Returns false when memory is out. */
bool vs_rounding_contract(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count);

#endif
