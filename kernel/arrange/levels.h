/* Declares the union of a crowded cluster's solids level by level. */
#ifndef VS_KERNEL_ARRANGE_LEVELS_H
#define VS_KERNEL_ARRANGE_LEVELS_H

#include "kernel/cluster.h"

/* Makes facets, sides, cuts and groups of a crowded cluster. Returns false on an error. */
bool vs_unite_levels(vs_kernel *k, vs_cluster *c, vs_expression *e);

#endif
