/* Owns the interface of snap_to_grid.c: the way from placed leaves to corners on the grid. */
#ifndef VS_KERNEL_ARRANGE_SNAP_TO_GRID_H
#define VS_KERNEL_ARRANGE_SNAP_TO_GRID_H

#include "kernel/cluster.h"

bool vs_snap_to_grid(vs_kernel *k, vs_cluster *c);                       /* frame, weld, grid; and the next two */

#endif
