/* Owns which shells need no search for self-contacts: stars that stand alone. */
#ifndef VS_KERNEL_ROUND_STARS_H
#define VS_KERNEL_ROUND_STARS_H

#include "kernel/round/rounding_state.h"

/* Sets s->alone: of a vertex: 1: of a shell that, as rounded, does not meet itself, and comes nowhere near another.
 * margin: how near. False: out of memory, or interrupted. The margin is 0 or more. */
bool vs_rounding_find_alone(vs_rounding *s, double margin);

#endif
