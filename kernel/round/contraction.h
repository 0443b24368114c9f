/* Declares the last means against triangles that rounding makes meet: it unites corners and removes low triangles. */
#ifndef VS_KERNEL_ROUND_CONTRACTION_H
#define VS_KERNEL_ROUND_CONTRACTION_H

#include "kernel/round/rounding_state.h"

/* Near contacts (s->near_met), unites corners that are within so many units of each other, and removes triangles lower
 * than that: where rounding bends them, or everywhere (all). Removed triangles are marked only. A closed chain stays
 * closed, but need not remain a manifold by index: for formats without indices. *count: number of changes; the function
 * adds to out->collapsed and out->lost. Returns false when memory is out. units is above 0. */
bool vs_rounding_contract(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count);

#endif
