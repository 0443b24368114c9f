/* Owns what a cluster is held to that costs next to nothing: that the grid has not changed its leaves, and that the
 * result is as large as they allow. */
#ifndef VS_KERNEL_CHECK_H
#define VS_KERNEL_CHECK_H

#include "kernel/problem.h"
#include "kernel/cluster.h"

/* what a leaf holds on the grid, in steps: at least and at most */
typedef struct { double least, most; } vs_leaf_volume;
typedef struct { VS_LIST(vs_leaf_volume) leaves; } vs_check;

/* Measures the cluster's leaves on the grid; those that it has changed by more than a hundredth are counted in *counts,
 * the first with its step. */
bool vs_check_leaves(vs_kernel *k, const vs_cluster *c, vs_check *check, vs_kernel_counts *counts);
/* Is the volume of out's triangles from first on between the bounds that the leaves' volumes give the expression? Else
 * the kernel has failed, and says so. */
bool vs_check_result(vs_kernel *k, const vs_cluster *c, const vs_check *check, const vs_mesh *out, size_t first);
void vs_check_free(vs_kernel *k, vs_check *check);

/* For VS_ASSERT between the kernel's steps: each tells whether the state that a step leaves is one that the next may
 * start from. They look at indices and counts, in linear time. */
bool vs_holds_grid(const vs_cluster *c);    /* triangles have three points, a plane, and a facet of their leaf */
bool vs_holds_patches(const vs_cluster *c); /* patches have three corners or more among the points, and a facet */
bool vs_holds_cuts(const vs_cluster *c);    /* cuts lie in facets and end in points */
bool vs_holds_faces(const vs_cluster *c);   /* faces have covers, and uses that are their own and have two ends */
bool vs_holds_kept(const vs_cluster *c);    /* every face is kept from one side, from the other, or not */
bool vs_holds_result(const vs_mesh *m, size_t first_triangle); /* triangles from there on have three vertices */

#endif
