/* Declares the making of patches. */
#ifndef VS_KERNEL_ARRANGE_PATCHES_H
#define VS_KERNEL_ARRANGE_PATCHES_H

#include "kernel/cluster.h"

bool vs_patches_build(vs_kernel *k, vs_cluster *c);                    /* makes c->patches, c->boxes and c->bvh; returns
                                                                        * false on an error */

#endif
