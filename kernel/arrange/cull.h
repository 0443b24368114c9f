/* Declares the early removal of triangles and cuts that cannot be visible in the result. */
#ifndef VS_KERNEL_ARRANGE_CULL_H
#define VS_KERNEL_ARRANGE_CULL_H

#include "kernel/cluster.h"

bool vs_cull_prepare(vs_kernel *k, vs_cluster *c, const vs_affine *to_frame); /* Finds, for each leaf of the cluster,
                                                                               * the nearby lids: convex leaves that
                                                                               * alone decide the result inside them.
                                                                               * to_frame: map of each leaf into the
                                                                               * cluster's frame. Returns false on an
                                                                               * error. */
/* Sets masks[v] to the set of lids that contain vertex v, for the vertices from `begin` to `end` - 1 of a leaf. A lid
 * is a convex leaf whose inside is decided. place: index of the leaf in the cluster. Returns false if interrupted. */
bool vs_cull_vertices(vs_kernel *k, const vs_cluster *c, uint32_t place, size_t begin, size_t end, uint64_t *masks);
bool vs_cull_needed(const vs_cluster *c, uint32_t place); /* returns false if no other leaf can hide vertices of the
                                                           * leaf with the index `place`; vs_cull_vertices would then
                                                           * set all masks to 0 */
/* Reduces the box of a patch to the part that may be visible: outside of the balls inscribed in lids, convex leaves
 * whose inside is decided. place: index of the patch's leaf in the cluster. */
void vs_cull_box(const vs_cluster *c, uint32_t place, const vs_patch_corner *corners, uint32_t count, vs_bvh_box *box);
/* Returns true if the point p, in grid steps, is at least two steps inside a lid (convex leaf inside which the
 * expression's value is decided) near the leaf with the index `place`. */
bool vs_cull_point(const vs_cluster *c, uint32_t place, const double p[3]);
/* Returns true if the segment from p to q, in steps, is at least two grid steps inside a lid (convex leaf whose inside
 * is decided) near the leaf with the index `place`. The lid with the index `other` does not count. */
bool vs_cull_segment(const vs_cluster *c, uint32_t place, uint32_t other, const double p[3], const double q[3]);

#endif
