/* Owns the slow oracle: the exact volume of a boolean of convex solids, in GMP's rationals, by a method that shares nothing with the kernel.
 *
 * Space is a cube of six tetrahedra; each leaf's planes cut tetrahedra in two until every piece is inside or outside of it, the next leaf cuts
 * what is left, and the pieces whose leaves make the expression true are summed. Exponential in principle: for a handful of leaves. */
#ifndef VS_TESTS_ORACLE_H
#define VS_TESTS_ORACLE_H

#include "kernel/evaluate.h"

/* Leaves convex, vertices integers with |x| < size after an identity placement; at most 31. */
double oracle_volume(const vs_kernel_problem *problem, long size);

#endif
