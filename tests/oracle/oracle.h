/* Declares the slow oracle: it computes the exact volume of a boolean of convex solids in GMP's rationals, by a method
 * that shares nothing with the kernel.
 *
 * Space is a cube of six tetrahedra. The planes of the first leaf cut tetrahedra in two, until every piece is inside or
 * outside of the leaf; the planes of the next leaf then cut these pieces. The volume is the sum of the pieces whose
 * leaves make the boolean expression true. The time may grow exponentially with the number of leaves. */
#ifndef VS_TESTS_ORACLE_H
#define VS_TESTS_ORACLE_H

#include "kernel/evaluate.h"

/* Returns the exact volume of the problem's solid. It may have at most 31 leaves. They must be convex, with identity
 * placement and integer vertices whose coordinates are less than `size`. */
double oracle_volume(const vs_kernel_problem *problem, long size);

#endif
