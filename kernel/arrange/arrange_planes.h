/* Declares the function that cuts the facets in each plane into faces that no other facet crosses. */
#ifndef VS_KERNEL_ARRANGE_ARRANGE_PLANES_H
#define VS_KERNEL_ARRANGE_ARRANGE_PLANES_H

#include "kernel/cluster.h"

bool vs_arrange_planes(vs_kernel *k, vs_cluster *c);                   /* Makes the faces of cluster c and their
                                                                        * boundary edges (c->uses). Returns false on
                                                                        * failure, or with c->crowded set if the solids
                                                                        * must first be united two by two. */

#endif
