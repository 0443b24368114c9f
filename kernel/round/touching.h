/* Declares the search for places where the exact surface touches itself. */
#ifndef VS_KERNEL_ROUND_TOUCHING_H
#define VS_KERNEL_ROUND_TOUCHING_H

#include "kernel/round/rounding_state.h"

/* Marks the triangles at positions that two corners share as suspect. Triangles in a storey (plane across an axis) stay
 * apart after any rounding. Therefore they are marked only if they overlap, face each other and share a position.
 * Returns false if memory is out or the caller interrupts. */
bool vs_rounding_suspect_touching(vs_rounding *s);

#endif
