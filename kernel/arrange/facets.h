/* Declares the making of triangles and facets from the corners on the grid. */
#ifndef VS_KERNEL_ARRANGE_FACETS_H
#define VS_KERNEL_ARRANGE_FACETS_H

#include "kernel/cluster.h"

bool vs_facets_build(vs_kernel *k, vs_cluster *c);                     /* makes c->triangles, and c->facets of
                                                                        * connected coplanar triangles; returns false
                                                                        * on an error */

#endif
