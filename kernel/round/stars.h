/* Declares the search for shells that need no test for self-contacts: stars that are apart from all other shells. */
#ifndef VS_KERNEL_ROUND_STARS_H
#define VS_KERNEL_ROUND_STARS_H

#include "kernel/round/rounding_state.h"

/* Sets s->alone[v] to 1 if the shell of vertex v, with rounded corners, does not intersect itself, and no other shell
 * is within the margin. The margin is at least 0. Returns false if memory is out or the caller interrupts. */
bool vs_rounding_find_alone(vs_rounding *s, double margin);

#endif
