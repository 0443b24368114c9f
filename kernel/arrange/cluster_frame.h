/* Declares the choice of the coordinate frame in which a cluster of leaves gets its grid. */
#ifndef VS_KERNEL_ARRANGE_CLUSTER_FRAME_H
#define VS_KERNEL_ARRANGE_CLUSTER_FRAME_H

#include "kernel/cluster.h"

/* Chooses the frame of cluster c. Writes the map from each leaf's coordinates to the frame to local_to_frame. Returns
 * false on an error. */
bool vs_frame_choose(vs_kernel *k, vs_cluster *c, vs_affine *local_to_frame /* an array that receives the map from each
                                                                             * leaf (placed mesh) of the cluster to the
                                                                             * frame */);
vs_vec3 vs_grid_world(const vs_grid *g, const vs_point *p);

#endif
