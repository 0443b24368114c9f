/* Declares the culling of triangles and cuts that lie well inside settled space. */
#ifndef VS_KERNEL_ARRANGE_CULL_H
#define VS_KERNEL_ARRANGE_CULL_H

#include "kernel/cluster.h"

bool vs_cull_prepare(vs_kernel *k, vs_cluster *c, const vs_affine *to_frame); /* finds the lids of the cluster;
                                                                               * vs_snap_to_grid calls this function.
                                                                               * Returns false on an error */
/* Computes for the vertices v from `begin` to `end` - 1 of a leaf the sets of lids that contain them, masks[v]. place:
 * index of the leaf in the cluster. Returns false if interrupted. */
bool vs_cull_vertices(vs_kernel *k, const vs_cluster *c, uint32_t place, size_t begin, size_t end, uint64_t *masks);
bool vs_cull_needed(const vs_cluster *c, uint32_t place); /* returns false if all masks of the leaf would be 0 */
/* Reduces the box of a patch of a leaf to the part of the patch outside of the balls within lids. place: index of the
 * leaf in the cluster. */
void vs_cull_box(const vs_cluster *c, uint32_t place, const vs_patch_corner *corners, uint32_t count, vs_bvh_box *box);
/* Returns true if the point p, in steps, is well inside a lid near a leaf. place: index of the leaf in the cluster. */
bool vs_cull_point(const vs_cluster *c, uint32_t place, const double p[3]);
/* Returns true if the segment from p to q, in steps, is well inside a lid near the leaf with the index `place`. A lid
 * with the index `other` does not count. */
bool vs_cull_segment(const vs_cluster *c, uint32_t place, uint32_t other, const double p[3], const double q[3]);

#endif
