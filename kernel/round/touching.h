/* Declares the marks of triangles at places where the exact surface touches itself. */
#ifndef VS_KERNEL_ROUND_TOUCHING_H
#define VS_KERNEL_ROUND_TOUCHING_H

#include "kernel/round/rounding_state.h"

/* Marks the triangles at places that two corners share, except those in a storey: they stay apart after any rounding.
 * Of these it marks the ones that overlap, face each other, and have a place in common. Returns false if memory is out
 * or the caller interrupts. */
bool vs_rounding_suspect_touching(vs_rounding *s);

#endif
