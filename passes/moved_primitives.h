/* Declares primitives under an affine map, for the pass fold. */
#ifndef VS_PASSES_MOVED_PRIMITIVES_H
#define VS_PASSES_MOVED_PRIMITIVES_H

#include "passes/rewrite.h"

/* Returns the image of primitive n under a. Returns NULL and sets *fits to false if the image is not a primitive of the
 * same kind. Returns NULL with *fits true if memory is out. */
vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits);
/* Returns true if a consists of a translation and a uniform scale only. */
bool vs_fold_is_upright(const vs_affine *a);

#endif
