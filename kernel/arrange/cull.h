/* Declares the functions of cull.c: the culling of triangles and cuts that lie well inside settled space. */
#ifndef VS_KERNEL_ARRANGE_CULL_H
#define VS_KERNEL_ARRANGE_CULL_H

#include "kernel/cluster.h"

bool vs_cull_prepare(vs_kernel *k, vs_cluster *c, const vs_affine *to_frame); /* finds the lids; called by
                                                                               * vs_snap_to_grid */
/* Computes the masks of the vertices [begin, end) of the leaf at that place in the cluster. */
bool vs_cull_vertices(vs_kernel *k, const vs_cluster *c, uint32_t place, size_t begin, size_t end, uint64_t *masks);
bool vs_cull_needed(const vs_cluster *c, uint32_t place); /* returns false if all masks would be 0 */
/* Shrinks the box of a patch of the leaf to the part outside of the balls in lids. */
void vs_cull_box(const vs_cluster *c, uint32_t place, const vs_patch_corner *corners, uint32_t count, vs_bvh_box *box);
/* Returns true if the point, in steps, is well inside a lid near the leaf at that place. */
bool vs_cull_point(const vs_cluster *c, uint32_t place, const double p[3]);
/* Returns true if the segment, in steps, is well inside a lid that is near the leaf at that place and is not the other
 * leaf. */
bool vs_cull_segment(const vs_cluster *c, uint32_t place, uint32_t other, const double p[3], const double q[3]);

#endif
