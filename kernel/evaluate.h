/* Owns the interface of the mesh kernel: exact booleans of closed triangle meshes. The kernel knows nothing of nodes;
 * solids/solid_meshes.h does.
 *
 * The expression is a list of terms, operands before users, the last term the root: a DAG of any width and depth.
 * Everything is evaluated in one exact arrangement per cluster of leaves that touch, not pair by pair; see
 * manual/internals/kernel.md. */
#ifndef VS_KERNEL_EVALUATE_H
#define VS_KERNEL_EVALUATE_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"

/* out need not be initialised; it is empty after a failure. Copies do not meet each other. */
bool vs_kernel_evaluate_copies(const vs_kernel_problem *problem, const vs_kernel_options *options,
                               vs_kernel_copies *out, vs_kernel_error *error);
void vs_kernel_copies_free(vs_kernel_copies *c);

/* Appends to out (tags filled; a closed chain by index, oriented, free of T-junctions). options may be NULL. On false,
 * out is as before. */
bool vs_kernel_evaluate(const vs_kernel_problem *problem, const vs_kernel_options *options, vs_mesh *out,
                        vs_kernel_error *error);

#endif
