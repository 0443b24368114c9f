/* Owns the interface of group.c: grouping. */
#ifndef VS_PASSES_GROUP_H
#define VS_PASSES_GROUP_H

#include "passes/passes.h"

/* Turns sets of very many cutters into trees of boxes (group.c), for a target that tries every part of a set for every
 * ray. This adds commands, and keeps the drawing. It rewrites as vs_passes_run does, and needs bounds; it is not one of
 * the passes. */
bool vs_sets_group(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_error *e);

#endif
