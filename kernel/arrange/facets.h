/* Declares the function that makes a cluster's triangles and facets from the corners on the grid. */
#ifndef VS_KERNEL_ARRANGE_FACETS_H
#define VS_KERNEL_ARRANGE_FACETS_H

#include "kernel/cluster.h"

bool vs_facets_build(vs_kernel *k, vs_cluster *c);                     /* makes c->triangles, and from them c->facets:
                                                                        * each facet is a connected set of coplanar
                                                                        * triangles; returns false on an error */

#endif
