/* Declares the rounding of meshes to the numbers of a format, and the warnings about it. */
#ifndef VS_BACKENDS_FORMAT_NUMBERS_H
#define VS_BACKENDS_FORMAT_NUMBERS_H

#include "backends/backend.h"

/* Merges vertices of m that the format's numbers cannot distinguish. Adds to `sum` the number of faces that this folds
 * and of parts that it removes, with the place of the first. Returns false on an interrupt or if memory is out, with
 * e's error set. */
bool vs_emit_round(vs_emitter *e, vs_mesh *m, vs_numbers numbers, vs_rounded *sum);
/* Warns about the folded faces and the omitted parts in `sum`. */
bool vs_emit_rounded(vs_emitter *e, const vs_rounded *sum);

#endif
