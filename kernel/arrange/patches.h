/* Declares the division of facets into patches, the units of the tests for intersection. */
#ifndef VS_KERNEL_ARRANGE_PATCHES_H
#define VS_KERNEL_ARRANGE_PATCHES_H

#include "kernel/cluster.h"

bool vs_patches_build(vs_kernel *k, vs_cluster *c);                    /* makes c->patches, their boxes c->boxes, and
                                                                        * the tree of boxes c->bvh; returns false on an
                                                                        * error */

#endif
