/* Declares the repair of an exact mesh before its corners are rounded to a format's numbers. The repair removes edges
 * that would become too short, and counts the remaining effects of rounding. */
#ifndef VS_KERNEL_ROUND_ROUNDING_H
#define VS_KERNEL_ROUND_ROUNDING_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"
#include "kernel/round/rounded.h"

/* Collapses edges of less than two units of the last place, if the surface stays a manifold and no triangle turns over.
 * Flips the longest edges of triangles lower than two units. The repair takes at most three rounds. The mesh m is
 * closed and manifold by its vertex numbers, and remains so. With VS_NUMBERS_LOOSE it only needs to be closed by
 * position. Its corners stay doubles: the writer of the format rounds them. options and error may be NULL. Returns
 * false if memory is out or the caller interrupts; m is then unusable. */
bool vs_mesh_round(vs_mesh *m, vs_numbers numbers, const vs_kernel_options *options, vs_rounded *out,
                    vs_kernel_error *error);

#endif
