/* Declares the interface of the mesh kernel: exact booleans of closed triangle meshes. The kernel knows nothing of
 * nodes; solids/solid_meshes.h calls it for solids.
 *
 * The expression is a list of terms, in which operands come before the terms that use them. The last term is the root.
 * The terms form a directed acyclic graph of any width and depth. A cluster consists of leaves that touch. The kernel
 * evaluates each cluster in one exact arrangement, not operand by operand; see manual/internals/kernel.md. */
#ifndef VS_KERNEL_EVALUATE_H
#define VS_KERNEL_EVALUATE_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"

/* Evaluates the problem. Stores in out each distinct mesh of the result once, and the placements of its copies. Copies
 * do not intersect each other. out need not be initialised. Returns false and sets the error on failure; out is then
 * empty. */
bool vs_kernel_evaluate_copies(const vs_kernel_problem *problem, const vs_kernel_options *options,
                               vs_kernel_copies *out, vs_kernel_error *error);
void vs_kernel_copies_free(vs_kernel_copies *c);

/* Evaluates the problem, and appends the result with its tags to out. The result is a closed and oriented mesh without
 * T-junctions, in which neighbouring triangles share vertices. options may be NULL. Returns false and sets the error on
 * failure; out is then unchanged. */
bool vs_kernel_evaluate(const vs_kernel_problem *problem, const vs_kernel_options *options, vs_mesh *out,
                        vs_kernel_error *error);

#endif
