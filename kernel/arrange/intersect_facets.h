/* Declares the functions of intersect_facets.c: the intersection of facets that are given by their sides. */
#ifndef VS_KERNEL_ARRANGE_INTERSECT_FACETS_H
#define VS_KERNEL_ARRANGE_INTERSECT_FACETS_H

#include "kernel/cluster.h"

/* makes cuts and groups like vs_meet_patches, for facets that are given by their sides */
bool vs_meet_facets(vs_kernel *k, vs_cluster *c);

#endif
