/* Owns what rounding to a format's numbers does to a mesh that was exact: edges that become too short for them go, the
 * rest is counted. */
#ifndef VS_KERNEL_ROUND_ROUNDING_H
#define VS_KERNEL_ROUND_ROUNDING_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"
#include "kernel/round/rounded.h"

/* Collapses edges of less than two units of the last place, where both the surface's kind and every triangle's side
 * allow it, and flips the longest edges of triangles that are lower than that, in at most three rounds.
 * m: closed and manifold by index; stays so, but for LOOSE, where a closed chain is all that counts. Its corners stay
 * doubles: rounding them is the writer's. options and error may be NULL. False: out of memory, or interrupted; m is not
 * to be used then. */
bool vs_mesh_round(vs_mesh *m, vs_numbers numbers, const vs_kernel_options *options, vs_rounded *out,
                    vs_kernel_error *error);

#endif
