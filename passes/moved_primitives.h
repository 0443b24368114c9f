/* Owns the interface of moved_primitives.c: Owns, for fold (fold.c), the primitives. */
#ifndef VS_PASSES_MOVED_PRIMITIVES_H
#define VS_PASSES_MOVED_PRIMITIVES_H

#include "passes/rewrite.h"

/* The primitive n under a; NULL: with *fits false where that is no primitive of its kind, else out of memory. */
vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits);
/* Does a only shift, and make all alike larger or smaller? */
bool vs_fold_is_upright(const vs_affine *a);

#endif
