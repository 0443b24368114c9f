/* Owns the cheap checks of a cluster: the grid has not changed its leaves, and the result's volume is between the
 * bounds that they allow. */
#ifndef VS_KERNEL_CHECK_H
#define VS_KERNEL_CHECK_H

#include "kernel/problem.h"
#include "kernel/cluster.h"

/* the least and the greatest volume of a leaf on the grid, in cubic steps */
typedef struct { double least, most; } vs_leaf_volume;
typedef struct { VS_LIST(vs_leaf_volume) leaves; } vs_check;

/* Measures the cluster's leaves on the grid. Counts in *counts those whose volume the grid has changed by more than a
 * hundredth, and describes the first. Returns false when memory is out or the caller interrupts. */
bool vs_check_leaves(vs_kernel *k, const vs_cluster *c, vs_check *check, vs_kernel_counts *counts);
/* Returns true if the volume of out's triangles from `first` on is between the bounds that the leaves' volumes give the
 * expression. Else the kernel has failed: sets the error and returns false. */
bool vs_check_result(vs_kernel *k, const vs_cluster *c, const vs_check *check, const vs_mesh *out, size_t first);
void vs_check_free(vs_kernel *k, vs_check *check);

/* For VS_ASSERT between the kernel's steps: each function returns true if the next step may start from the current
 * state. They check indices and counts, in linear time. */
bool vs_holds_grid(const vs_cluster *c);    /* triangles have three points, a plane, and a facet of their leaf */
bool vs_holds_patches(const vs_cluster *c); /* patches have three or more corners among the points, and a facet */
bool vs_holds_cuts(const vs_cluster *c);    /* cuts lie in facets and end at points */
bool vs_holds_faces(const vs_cluster *c);   /* faces have covers, and uses that belong to no other face and have two
                                             * different ends */
bool vs_holds_kept(const vs_cluster *c);    /* every face has a value of `kept` */
bool vs_holds_result(const vs_mesh *m, size_t first_triangle); /* triangles from first_triangle on have three different
                                                                * vertices */

#endif
