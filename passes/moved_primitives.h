/* Owns the interface of moved_primitives.c: primitives under a map, for fold. */
#ifndef VS_PASSES_MOVED_PRIMITIVES_H
#define VS_PASSES_MOVED_PRIMITIVES_H

#include "passes/rewrite.h"

/* Returns the primitive n under a. NULL: with *fits false, the result is not a primitive of its kind; else memory is
 * out. */
vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits);
/* Returns true if a only shifts and scales evenly. */
bool vs_fold_is_upright(const vs_affine *a);

#endif
