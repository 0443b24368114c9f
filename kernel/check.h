/* Checks a cluster at little cost. The grid must not change the volume of a leaf much. The result's volume must lie
 * between bounds that follow from the leaves' volumes. */
#ifndef VS_KERNEL_CHECK_H
#define VS_KERNEL_CHECK_H

#include "kernel/problem.h"
#include "kernel/cluster.h"

/* bounds on the volume of a leaf of the cluster after rounding to the grid, in cubic steps */
typedef struct { double least, most; } vs_leaf_volume;
typedef struct { VS_LIST(vs_leaf_volume) leaves; } vs_check;

/* Computes the volumes of the cluster's leaves after rounding to the grid. Counts in counts->coarse the leaves whose
 * volume the grid has changed by more than a hundredth. Returns false when memory is out or the caller interrupts. */
bool vs_check_leaves(vs_kernel *k, const vs_cluster *c, vs_check *check, vs_kernel_counts *counts);
/* Compares the volume of out's triangles, from index `first` on, with the bounds that follow from the leaves' volumes.
 * Returns true if it lies within them. Otherwise the kernel has failed: sets the error and returns false. */
bool vs_check_result(vs_kernel *k, const vs_cluster *c, const vs_check *check, const vs_mesh *out, size_t first);
void vs_check_free(vs_kernel *k, vs_check *check);

/* The vs_holds_ functions serve for VS_ASSERT between the kernel's steps. Each returns true if the indices and counts
 * in the cluster are valid for the next step. */
bool vs_holds_grid(const vs_cluster *c);    /* true if every triangle has three points, a plane, and a facet of its
                                             * leaf */
bool vs_holds_patches(const vs_cluster *c); /* true if every patch has a facet, and three or more corners among the
                                             * points */
bool vs_holds_cuts(const vs_cluster *c);    /* true if every cut lies in a facet and ends at points */
bool vs_holds_faces(const vs_cluster *c);   /* true if every face separates the winding numbers of a leaf, and its
                                             * boundary edges have two different ends and belong to no other face */
bool vs_holds_kept(const vs_cluster *c);    /* true if every face has a value 0, 1 or 2 in `kept` */
bool vs_holds_result(const vs_mesh *m, size_t first_triangle); /* true if every triangle of m from first_triangle on has
                                                                * three different vertices */

#endif
