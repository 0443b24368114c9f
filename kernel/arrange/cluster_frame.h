/* Declares the choice of the cluster's frame. */
#ifndef VS_KERNEL_ARRANGE_CLUSTER_FRAME_H
#define VS_KERNEL_ARRANGE_CLUSTER_FRAME_H

#include "kernel/cluster.h"

/* Chooses the frame and computes the maps from the leaves to it. Returns false on an error. */
bool vs_frame_choose(vs_kernel *k, vs_cluster *c, vs_affine *local_to_frame /* an output array, with a map for each leaf
                                                                             * of the cluster */);
vs_vec3 vs_grid_world(const vs_grid *g, const vs_point *p);

#endif
