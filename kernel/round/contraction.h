/* Owns the last means against triangles that rounding makes meet: corners become one, and low triangles go. */
#ifndef VS_KERNEL_ROUND_CONTRACTION_H
#define VS_KERNEL_ROUND_CONTRACTION_H

#include "kernel/round/rounding_state.h"

/* Near what meets (s->near_met), makes corners one that are within so many units of each other, and triangles lower
 * than that nothing; where rounding bends them, or (all) everywhere. Triangles that are gone are marked, not left out.
 * A closed chain stays one, but need not be a manifold by index any more: for formats without indices.
 * *count: how often it did something; out->collapsed and out->lost grow. False: out of memory. units is above 0. */
bool vs_rounding_contract(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count);

#endif
