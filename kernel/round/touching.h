/* Owns the marks of triangles at places where the exact surface touches itself. */
#ifndef VS_KERNEL_ROUND_TOUCHING_H
#define VS_KERNEL_ROUND_TOUCHING_H

#include "kernel/round/rounding_state.h"

/* Marks the triangles at places that two corners share, but those that lie in a storey: they stay apart, however they
 * are rounded. Of these it marks the ones that overlap, look against each other, and have a place in common.
 * False: out of memory, or interrupted. */
bool vs_rounding_suspect_touching(vs_rounding *s);

#endif
