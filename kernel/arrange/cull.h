/* Owns the interface of cull.c: the leaving out, before anything is cut, of triangles and cuts that lie well inside
 * settled space. */
#ifndef VS_KERNEL_ARRANGE_CULL_H
#define VS_KERNEL_ARRANGE_CULL_H

#include "kernel/cluster.h"

bool vs_cull_prepare(vs_kernel *k, vs_cluster *c, const vs_affine *to_frame); /* lids; within vs_snap_to_grid */
/* The masks of the vertices [begin, end) of the leaf at that place in the cluster. */
bool vs_cull_vertices(vs_kernel *k, const vs_cluster *c, uint32_t place, size_t begin, size_t end, uint64_t *masks);
bool vs_cull_needed(const vs_cluster *c, uint32_t place); /* false: all masks would be 0 */
/* Shrinks the box of a patch of the leaf to what the balls within lids leave of it. */
void vs_cull_box(const vs_cluster *c, uint32_t place, const vs_patch_corner *corners, uint32_t count, vs_bvh_box *box);
/* Is the point, in steps, well inside a lid that is near the leaf at that place? */
bool vs_cull_point(const vs_cluster *c, uint32_t place, const double p[3]);
/* Is the segment, in steps, well inside a lid that is near the leaf at that place, but not the other leaf? */
bool vs_cull_segment(const vs_cluster *c, uint32_t place, uint32_t other, const double p[3], const double q[3]);

#endif
