/* Declares the functions of snap_to_grid.c: the step from placed leaves to corners on the grid. */
#ifndef VS_KERNEL_ARRANGE_SNAP_TO_GRID_H
#define VS_KERNEL_ARRANGE_SNAP_TO_GRID_H

#include "kernel/cluster.h"

bool vs_snap_to_grid(vs_kernel *k, vs_cluster *c);                       /* chooses frame and grid, welds and snaps */

#endif
