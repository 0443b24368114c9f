/* Declares the functions of untouched_triangles.c: the search for plain (untouched) triangles, which nothing meets. */
#ifndef VS_KERNEL_ARRANGE_UNTOUCHED_TRIANGLES_H
#define VS_KERNEL_ARRANGE_UNTOUCHED_TRIANGLES_H

#include "kernel/cluster.h"

bool vs_plain_find(vs_kernel *k, vs_cluster *c);                       /* makes fate */
bool vs_plain_regions(vs_kernel *k, vs_cluster *c);                    /* makes regions, and their faces and uses */
/* vs_plain_kept returns the number of triangles in kept regions; the next function appends them. number: of each point,
 * its vertex in the result. */
size_t vs_plain_kept(const vs_cluster *c);
bool vs_plain_copy(vs_kernel *k, vs_cluster *c, vs_mesh *out, const uint32_t *number);

#endif
