/* Declares the intersection of facets that are given by their border edges. */
#ifndef VS_KERNEL_ARRANGE_INTERSECT_FACETS_H
#define VS_KERNEL_ARRANGE_INTERSECT_FACETS_H

#include "kernel/cluster.h"

/* Makes c->cuts, the segments in which facets cut each other, and unites touching facets of one plane to groups. Facets
 * are given by their border edges; vs_meet_patches does this for facets that consist of triangles. Returns false on an
 * error. */
bool vs_meet_facets(vs_kernel *k, vs_cluster *c);

#endif
