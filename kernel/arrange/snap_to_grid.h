/* Declares the function that rounds the vertices of placed leaves to the integer grid of their cluster. */
#ifndef VS_KERNEL_ARRANGE_SNAP_TO_GRID_H
#define VS_KERNEL_ARRANGE_SNAP_TO_GRID_H

#include "kernel/cluster.h"

bool vs_snap_to_grid(vs_kernel *k, vs_cluster *c);                       /* chooses the cluster's frame and grid, and
                                                                          * rounds all vertices to the grid; returns
                                                                          * false on an error */

#endif
