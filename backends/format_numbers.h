/* Owns the rounding of meshes to a format's numbers, and what is said of it. */
#ifndef VS_BACKENDS_FORMAT_NUMBERS_H
#define VS_BACKENDS_FORMAT_NUMBERS_H

#include "backends/backend.h"

/* Makes one what such numbers cannot hold apart; what they fold all the same, or what is left out, is added to the sum,
 * with the first place. False: interrupted, or out of memory, as e's error says. */
bool vs_emit_round(vs_emitter *e, vs_mesh *m, vs_numbers numbers, vs_rounded *sum);
/* Warns of the sum. */
bool vs_emit_rounded(vs_emitter *e, const vs_rounded *sum);

#endif
