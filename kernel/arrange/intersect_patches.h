/* Declares the intersection of patches. */
#ifndef VS_KERNEL_ARRANGE_INTERSECT_PATCHES_H
#define VS_KERNEL_ARRANGE_INTERSECT_PATCHES_H

#include "kernel/cluster.h"

bool vs_meet_patches(vs_kernel *k, vs_cluster *c);                     /* makes c->cuts, and unites coplanar facets that
                                                                        * touch to groups; returns false on an error, or
                                                                        * if there are so many cuts that the solids must
                                                                        * be united two by two */

#endif
