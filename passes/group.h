/* Declares grouping: the conversion of sets of very many parts to trees of boxes. */
#ifndef VS_PASSES_GROUP_H
#define VS_PASSES_GROUP_H

#include "passes/passes.h"

/* Converts sets of very many cutters to trees of boxes (group.c), for a target program that tests every part of a set
 * for every ray. The option `bounds` must be set. Returns false, with e set, on failure. */
bool vs_sets_group(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_error *e);

#endif
