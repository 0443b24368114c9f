/* Declares the functions of arrange_planes.c: the arrangement in one plane. */
#ifndef VS_KERNEL_ARRANGE_ARRANGE_PLANES_H
#define VS_KERNEL_ARRANGE_ARRANGE_PLANES_H

#include "kernel/cluster.h"

bool vs_arrange_planes(vs_kernel *k, vs_cluster *c);                   /* makes faces and uses */

#endif
