/* Declares the repair of an exact mesh before its corners are rounded to a format's numbers. The repair removes edges
 * that would become too short, and counts the remaining effects of rounding. */
#ifndef VS_KERNEL_ROUND_ROUNDING_H
#define VS_KERNEL_ROUND_ROUNDING_H

#include "kernel/kernel_options.h"
#include "kernel/problem.h"
#include "kernel/round/rounded.h"

/* Removes edges that are shorter than two units of the last place, and triangles that are lower, if the surface stays a
 * manifold. The mesh m is closed and manifold by its vertex numbers; with VS_NUMBERS_LOOSE, closed by position. options
 * and error may be NULL. Returns false if memory is out or the caller interrupts; m is then unusable. */
bool vs_mesh_round(vs_mesh *m, vs_numbers numbers, const vs_kernel_options *options, vs_rounded *out,
                    vs_kernel_error *error);

#endif
