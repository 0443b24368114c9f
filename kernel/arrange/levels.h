/* Declares the functions of levels.c: the union of a crowded cluster's solids level by level. */
#ifndef VS_KERNEL_ARRANGE_LEVELS_H
#define VS_KERNEL_ARRANGE_LEVELS_H

#include "kernel/cluster.h"

/* for a crowded cluster: makes facets, sides, cuts and groups */
bool vs_unite_levels(vs_kernel *k, vs_cluster *c, vs_expression *e);

#endif
