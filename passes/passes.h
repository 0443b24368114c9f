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

#endif
