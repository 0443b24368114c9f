/* Owns the interface of the mesh kernel: exact booleans of closed triangle meshes. The kernel knows nothing of nodes;
 * solids/solid_meshes.h does.
 *
 * The expression is a list of terms, operands before users; the last term is the root. It is a DAG of any width and
 * depth. The kernel evaluates each cluster of leaves that touch in one exact arrangement, not pair by pair; see
 * manual/internals/kernel.md. */
#ifndef VS_KERNEL_EVALUATE_H
#define VS_KERNEL_EVALUATE_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"

/* Evaluates the problem as copies of meshes. out need not be initialised; it is empty after a failure. Copies do not
 * intersect each other. */
bool vs_kernel_evaluate_copies(const vs_kernel_problem *problem, const vs_kernel_options *options,
                               vs_kernel_copies *out, vs_kernel_error *error);
void vs_kernel_copies_free(vs_kernel_copies *c);

/* Appends the result to out, with tags: a closed chain by index, oriented, without T-junctions. options may be NULL.
 * Returns false on failure; out is then unchanged. */
bool vs_kernel_evaluate(const vs_kernel_problem *problem, const vs_kernel_options *options, vs_mesh *out,
                        vs_kernel_error *error);

#endif
