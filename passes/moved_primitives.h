/* Declares the mapping of primitives by affine maps, for the pass fold. */
#ifndef VS_PASSES_MOVED_PRIMITIVES_H
#define VS_PASSES_MOVED_PRIMITIVES_H

#include "passes/rewrite.h"

/* Returns primitive n mapped by a. If the result is not a primitive of the same kind, returns NULL and sets *fits to
 * false. If memory is out, returns NULL, and *fits is true. */
vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits);
/* Returns true if a consists of a translation and a uniform scale only. */
bool vs_fold_is_upright(const vs_affine *a);

#endif
