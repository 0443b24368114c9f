/* Declares the slow oracle: it computes the exact volume of a boolean of convex solids in GMP's rationals, by a method
 * that shares nothing with the kernel.
 *
 * Space is a cube of six tetrahedra. The planes of a leaf cut tetrahedra in two, until every piece is inside or outside
 * of the leaf; the planes of the next leaf then cut these pieces. The volume is the sum of the pieces inside those
 * leaves for which the expression is true. The time may grow exponentially with the number of leaves, so there should
 * be few. */
#ifndef VS_TESTS_ORACLE_H
#define VS_TESTS_ORACLE_H

#include "kernel/evaluate.h"

/* Returns the exact volume. Leaves must be convex, at most 31, with identity placement and integer vertices with |x| <
 * size. */
double oracle_volume(const vs_kernel_problem *problem, long size);

#endif
