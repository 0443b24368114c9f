/* Owns the interface of levels.c: the way through a crowded cluster. */
#ifndef VS_KERNEL_ARRANGE_LEVELS_H
#define VS_KERNEL_ARRANGE_LEVELS_H

#include "kernel/cluster.h"

/* of a crowded cluster: facets, sides, cuts, groups */
bool vs_unite_levels(vs_kernel *k, vs_cluster *c, vs_expression *e);

#endif
