/* Declares the functions of intersect_patches.c: the intersection of patches. */
#ifndef VS_KERNEL_ARRANGE_INTERSECT_PATCHES_H
#define VS_KERNEL_ARRANGE_INTERSECT_PATCHES_H

#include "kernel/cluster.h"

bool vs_meet_patches(vs_kernel *k, vs_cluster *c);                     /* makes cuts and groups */

#endif
