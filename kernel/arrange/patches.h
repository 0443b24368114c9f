/* Declares the functions of patches.c: the patches. */
#ifndef VS_KERNEL_ARRANGE_PATCHES_H
#define VS_KERNEL_ARRANGE_PATCHES_H

#include "kernel/cluster.h"

bool vs_patches_build(vs_kernel *k, vs_cluster *c);                    /* makes patches, boxes and bvh */

#endif
