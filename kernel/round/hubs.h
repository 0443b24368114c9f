/* Owns the corners in which very many triangles end: which of these need not be tried against each other. */
#ifndef VS_KERNEL_ROUND_HUBS_H
#define VS_KERNEL_ROUND_HUBS_H

#include "kernel/round/rounding_state.h"

/* Of each triangle: a corner of it around which all triangles meet in their edges alone, as rounded, or UINT32_MAX.
 * *hub_of, NULL before, stays NULL where no corner has many triangles. False: out of memory, or interrupted. */
bool vs_settling_find_hubs(const vs_settling *s, uint32_t **hub_of, size_t *room);

#endif
