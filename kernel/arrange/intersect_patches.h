/* Declares the function that intersects patches (whole facets or single triangles of them) with each other. */
#ifndef VS_KERNEL_ARRANGE_INTERSECT_PATCHES_H
#define VS_KERNEL_ARRANGE_INTERSECT_PATCHES_H

#include "kernel/cluster.h"

bool vs_meet_patches(vs_kernel *k, vs_cluster *c);                     /* Makes c->cuts, the segments in which patches
                                                                        * cut each other, and unites touching facets of
                                                                        * one plane to groups. Returns false on an
                                                                        * error, or if there are so many cuts that the
                                                                        * solids must be united two by two. */

#endif
