/* Declares the arrangement of the facets in each plane. */
#ifndef VS_KERNEL_ARRANGE_ARRANGE_PLANES_H
#define VS_KERNEL_ARRANGE_ARRANGE_PLANES_H

#include "kernel/cluster.h"

bool vs_arrange_planes(vs_kernel *k, vs_cluster *c);                   /* makes c->faces and c->uses; returns false on
                                                                        * failure, or if the cluster is too crowded */

#endif
