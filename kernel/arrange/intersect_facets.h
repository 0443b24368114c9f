/* Declares the intersection of facets that are given by their border edges. */
#ifndef VS_KERNEL_ARRANGE_INTERSECT_FACETS_H
#define VS_KERNEL_ARRANGE_INTERSECT_FACETS_H

#include "kernel/cluster.h"

/* Makes c->cuts and unites coplanar facets that touch to groups, as vs_meet_patches does, for facets that are given by
 * their border edges. Returns false on an error. */
bool vs_meet_facets(vs_kernel *k, vs_cluster *c);

#endif
