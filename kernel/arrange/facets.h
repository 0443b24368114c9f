/* Declares the functions of facets.c: the step from corners on the grid to triangles and facets. */
#ifndef VS_KERNEL_ARRANGE_FACETS_H
#define VS_KERNEL_ARRANGE_FACETS_H

#include "kernel/cluster.h"

bool vs_facets_build(vs_kernel *k, vs_cluster *c);                     /* makes triangles and facets */

#endif
