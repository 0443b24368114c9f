/* Declares the function that unites the solids of a crowded cluster two by two. */
#ifndef VS_KERNEL_ARRANGE_LEVELS_H
#define VS_KERNEL_ARRANGE_LEVELS_H

#include "kernel/cluster.h"

/* Makes the facets, border edges and cuts of a cluster with too many cuts, by uniting its solids two by two. Returns
 * false on an error. */
bool vs_unite_levels(vs_kernel *k, vs_cluster *c, vs_expression *e);

#endif
