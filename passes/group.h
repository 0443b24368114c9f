/* Owns the interface of group.c: grouping. */
#ifndef VS_PASSES_GROUP_H
#define VS_PASSES_GROUP_H

#include "passes/passes.h"

/* Not a pass of its own: for a target that tries every part of a set for every ray, what is taken off something in very
 * many parts becomes a tree of boxes (group.c). More commands, the same drawing. Rewrites as vs_passes_run does; bounds
 * are needed. */
bool vs_sets_group(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_error *e);

#endif
