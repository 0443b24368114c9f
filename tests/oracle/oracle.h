/* Declares the slow oracle: the exact volume of a boolean of convex solids, in GMP's rationals, by a method that shares
 * nothing with the kernel.
 *
 * Space is a cube of six tetrahedra. The planes of a leaf cut tetrahedra in two until every piece is inside or outside
 * of the leaf; the next leaf cuts these pieces. The volume is the sum of the pieces for whose leaves the expression is
 * true. The method is exponential in principle, so it suits a handful of leaves. */
#ifndef VS_TESTS_ORACLE_H
#define VS_TESTS_ORACLE_H

#include "kernel/evaluate.h"

/* Returns the exact volume. Leaves must be convex, at most 31, with identity placement and integer vertices with |x| <
 * size. */
double oracle_volume(const vs_kernel_problem *problem, long size);

#endif
