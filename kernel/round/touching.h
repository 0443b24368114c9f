/* Declares the search for places where the exact surface touches itself. */
#ifndef VS_KERNEL_ROUND_TOUCHING_H
#define VS_KERNEL_ROUND_TOUCHING_H

#include "kernel/round/rounding_state.h"

/* Marks the triangles at positions that two corners share. Triangles in a storey stay apart after any rounding, so they
 * are not marked. The exceptions are triangles that overlap, face each other and share a position. Returns false if
 * memory is out or the caller interrupts. */
bool vs_rounding_suspect_touching(vs_rounding *s);

#endif
