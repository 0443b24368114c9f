/* Declares the division of facets into patches, the units of the tests for intersection. */
#ifndef VS_KERNEL_ARRANGE_PATCHES_H
#define VS_KERNEL_ARRANGE_PATCHES_H

#include "kernel/cluster.h"

bool vs_patches_build(vs_kernel *k, vs_cluster *c);                    /* makes c->patches, their bounding boxes
                                                                        * c->boxes, and c->bvh, the tree of these boxes;
                                                                        * returns false on an error */

#endif
