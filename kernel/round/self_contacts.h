/* Declares the search for triangles that intersect because of rounding. */
#ifndef VS_KERNEL_ROUND_SELF_CONTACTS_H
#define VS_KERNEL_ROUND_SELF_CONTACTS_H

#include "kernel/round/rounding_state.h"

/* Counts the triangles that intersect another triangle after rounding, each once, in out->met. Returns false when
 * memory is out or the caller interrupts. */
bool vs_rounding_count_met(vs_rounding *s, vs_rounded *out);

#endif
