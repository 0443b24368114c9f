/* Owns the passes: functions from drawing to drawing that keep what is drawn and make it less to say.
 *
 * A model is a DAG; each pass looks at every distinct node once, children first, and never recurses. A node that
 * several places name is a template: passes change it in itself but never dissolve it into its users. */
#ifndef VS_PASSES_PASSES_H
#define VS_PASSES_PASSES_H

#include "model/node.h"

typedef enum {
#define VS_PASS(upper, lower, begin, end, doc) VS_PASS_##upper,
#include "passes/passes.def"
  VS_PASS_COUNT
} vs_pass_kind;
typedef struct { const char *name, *doc; } vs_pass_info;
const vs_pass_info *vs_pass_get(vs_pass_kind pass);

typedef struct {
  unsigned passes; /* bit k: run vs_pass_kind k */
  /* Safe bounds of a node in its own coordinates (geometry's, which this layer may not call); NULL: prune only what is
   * empty. The nodes asked about may be gone after the run: what context remembers of them must go with it. */
  bool (*bounds)(void *context, const vs_node *n, vs_bounds *out, vs_error *e);
  void *context;
} vs_pass_options;

typedef struct {
  double commands_before, commands_after;            /* by vs_commands_count */
  size_t changed[VS_PASS_COUNT];                     /* nodes that each pass rewrote */
} vs_pass_stats;

/* Rewrites the references in place (new nodes retained, old ones released); on failure they are what they were. stats
 * may be NULL. */
bool vs_passes_run(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_pass_stats *stats,
                   vs_error *e);
/* Counts the commands that a target program has to be told: a primitive 1, a placement or material 1, a k-ary set k -
 * 1, a template 1 and each use of it 1. */
bool vs_commands_count(vs_store *s, const vs_ref *refs, size_t count, double *commands, vs_error *e);
/* Not a pass of its own: for a target that tries every part of a set for every ray, what is taken off something in very
 * many parts becomes a tree of boxes (group.c). More commands, the same drawing. Rewrites as vs_passes_run does; bounds
 * are needed. */
bool vs_sets_group(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_error *e);

#endif
