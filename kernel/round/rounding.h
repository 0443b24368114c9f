/* Declares the effect of rounding an exact mesh to a format's numbers: edges that become too short are removed, and the
 * rest is counted. */
#ifndef VS_KERNEL_ROUND_ROUNDING_H
#define VS_KERNEL_ROUND_ROUNDING_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"
#include "kernel/round/rounded.h"

/* Collapses edges of less than two units of the last place, if both the surface's kind and every triangle's orientation
 * allow it. Flips the longest edges of triangles lower than that. Both take at most three rounds. The mesh m is closed
 * and manifold by index, and remains both, except for LOOSE, which only needs a closed chain. Its corners stay doubles:
 * the writer rounds them. options and error may be NULL. Returns false if memory is out or the caller interrupts; m is
 * then unusable. */
bool vs_mesh_round(vs_mesh *m, vs_numbers numbers, const vs_kernel_options *options, vs_rounded *out,
                    vs_kernel_error *error);

#endif
