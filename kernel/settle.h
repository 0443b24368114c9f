/* Owns what rounding to a format's numbers does to a mesh that was exact: edges that become too short for them go, the rest is counted. */
#ifndef VS_KERNEL_SETTLE_H
#define VS_KERNEL_SETTLE_H

#include "kernel/kernel.h"

typedef enum { VS_NUMBERS_DOUBLE, VS_NUMBERS_DIGITS /* 12 significant */, VS_NUMBERS_SINGLE } vs_numbers;

typedef struct {
  size_t collapsed;       /* edges */
  size_t folded;          /* triangles that rounding turns over by more than it moves corners */
  vs_vec3 at;             /* of the first of them */
} vs_settled;

/* Collapses edges of less than two units of the last place, where both the surface's kind and every triangle's side allow it, in at most three rounds.
 * m: closed and manifold by index; stays so. Its corners stay doubles: rounding them is the writer's. False: out of memory. */
bool vs_mesh_settle(vs_mesh *m, vs_numbers numbers, vs_settled *out);

#endif
