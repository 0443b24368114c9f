/* Declares the search for shells (connected parts of a mesh) that cannot intersect after rounding: stars that are apart
 * from all other shells. */
#ifndef VS_KERNEL_ROUND_STARS_H
#define VS_KERNEL_ROUND_STARS_H

#include "kernel/round/rounding_state.h"

/* Sets s->alone[v] to 1 if the shell of vertex v does not intersect itself after rounding, and no other shell is within
 * the margin, which is at least 0. Returns false if memory is out or the caller interrupts. */
bool vs_rounding_find_alone(vs_rounding *s, double margin);

#endif
