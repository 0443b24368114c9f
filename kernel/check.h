/* Owns what a cluster is held to that costs next to nothing: that the grid has not changed its leaves, and that the result is as large as they allow. */
#ifndef VS_KERNEL_CHECK_H
#define VS_KERNEL_CHECK_H

#include "kernel/cluster.h"

typedef struct { double least, most; } vs_leaf_volume; /* what a leaf holds on the grid, in steps: at least and at most */
typedef struct { VS_LIST(vs_leaf_volume) leaves; } vs_check;

/* Measures the cluster's leaves on the grid; those that it has changed by more than a hundredth are counted in *counts, the first with its step. */
bool vs_check_leaves(vs_kernel *k, const vs_cluster *c, vs_check *check, vs_kernel_counts *counts);
/* Is the volume of out's triangles from first on between the bounds that the leaves' volumes give the expression? Else the kernel has failed, and says so. */
bool vs_check_result(vs_kernel *k, const vs_cluster *c, const vs_check *check, const vs_mesh *out, size_t first);
void vs_check_free(vs_kernel *k, vs_check *check);

#endif
