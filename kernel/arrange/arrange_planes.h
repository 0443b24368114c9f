/* Declares the function that cuts the facets in each plane into faces. */
#ifndef VS_KERNEL_ARRANGE_ARRANGE_PLANES_H
#define VS_KERNEL_ARRANGE_ARRANGE_PLANES_H

#include "kernel/cluster.h"

bool vs_arrange_planes(vs_kernel *k, vs_cluster *c);                   /* makes the faces and their boundary edges
                                                                        * (`uses`) of cluster c; returns false on
                                                                        * failure, or if so many crossings are hidden
                                                                        * that the solids must be united in levels */

#endif
