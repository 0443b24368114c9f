/* Declares the search for triangles that intersect because of rounding. */
#ifndef VS_KERNEL_ROUND_SELF_CONTACTS_H
#define VS_KERNEL_ROUND_SELF_CONTACTS_H

#include "kernel/round/rounding_state.h"

/* Sets out->met to the number of triangles that intersect another triangle after rounding. Returns false when memory is
 * out or the caller interrupts. */
bool vs_rounding_count_met(vs_rounding *s, vs_rounded *out);

#endif
