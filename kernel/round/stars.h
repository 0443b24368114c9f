/* Declares the shells that need no search for self-contacts: stars that are apart from all others. */
#ifndef VS_KERNEL_ROUND_STARS_H
#define VS_KERNEL_ROUND_STARS_H

#include "kernel/round/rounding_state.h"

/* Sets s->alone: of each vertex: 1: its shell, as rounded, does not meet itself, and no other shell is within the
 * margin. Returns false if memory is out or the caller interrupts. The margin is 0 or more. */
bool vs_rounding_find_alone(vs_rounding *s, double margin);

#endif
