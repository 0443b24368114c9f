/* Declares the last method against intersections that rounding causes: it unites corners and removes low triangles. */
#ifndef VS_KERNEL_ROUND_CONTRACTION_H
#define VS_KERNEL_ROUND_CONTRACTION_H

#include "kernel/round/rounding_state.h"

/* Unites corners within `units` units of each other, and removes triangles lower than this, near contacts
 * (s->near_met). all: true for all triangles near contacts, false only for triangles that rounding bends. Removed
 * triangles are only marked. A closed mesh stays closed by position, but need not remain a manifold by its vertex
 * numbers. Therefore this is for formats without indices. *count: number of changes; also adds to out->collapsed and
 * out->lost. units > 0. Returns false when memory is out. */
bool vs_rounding_contract(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count);

#endif
