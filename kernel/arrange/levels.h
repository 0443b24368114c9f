/* Declares the function that unites the solids of a cluster two by two if too many of them overlap. */
#ifndef VS_KERNEL_ARRANGE_LEVELS_H
#define VS_KERNEL_ARRANGE_LEVELS_H

#include "kernel/cluster.h"

/* Makes the facets of cluster c, their border edges and the cuts between them if there are too many cuts to make at
 * once. Unites the solids two by two for this. Returns false on an error. */
bool vs_unite_levels(vs_kernel *k, vs_cluster *c, vs_expression *e);

#endif
