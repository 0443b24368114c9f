/* Declares the search for plain (untouched) triangles, which no other triangle touches. */
#ifndef VS_KERNEL_ARRANGE_UNTOUCHED_TRIANGLES_H
#define VS_KERNEL_ARRANGE_UNTOUCHED_TRIANGLES_H

#include "kernel/cluster.h"

bool vs_plain_find(vs_kernel *k, vs_cluster *c);                       /* makes c->fate; returns false on an error */
bool vs_plain_regions(vs_kernel *k, vs_cluster *c);                    /* makes the regions, and their faces and uses;
                                                                        * returns false on an error */
/* vs_plain_kept returns the number of triangles in the kept regions. vs_plain_copy appends these triangles to out.
 * number[p]: vertex of point p in the result. */
size_t vs_plain_kept(const vs_cluster *c);
bool vs_plain_copy(vs_kernel *k, vs_cluster *c, vs_mesh *out, const uint32_t *number);

#endif
