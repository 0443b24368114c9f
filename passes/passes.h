/* Declares the passes: functions that rewrite a drawing to need fewer commands, without changing the drawn shape.
 *
 * A model is a DAG. Each pass visits every distinct node once, children first, and is not recursive. A node with
 * several references is a template. Passes may change the node itself, but never copy it into its users. */
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

/* A receiver of the warnings that the passes issue: a function and its context. */
typedef struct {
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  void *context;
} vs_pass_notes;

typedef struct {
  unsigned passes; /* set of passes to run: bit k is set if pass number k (vs_pass_kind) is to run */
  /* Computes bounds that contain a node, in the node's own coordinates. NULL: the pass prune removes only empty nodes.
   * Nodes may be freed at the end of the run, so `context` must then forget their addresses. */
  bool (*bounds)(void *context, const vs_node *n, vs_bounds *out, vs_error *e);
  void *context;
  const vs_pass_notes *notes; /* receiver of warnings; NULL: the passes give no warnings */
} vs_pass_options;

typedef struct {
  double commands_before, commands_after;            /* number of commands (units of a target's text) before and after
                                                      * the passes; see order_commands in passes.c */
  size_t changed[VS_PASS_COUNT];                     /* changed[k]: number of nodes that pass k rewrote */
} vs_pass_stats;

/* Runs the passes over refs, and replaces their nodes: adds references to new nodes and releases old ones. On failure,
 * returns false, and refs is unchanged. stats may be NULL. */
bool vs_passes_run(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_pass_stats *stats,
                   vs_error *e);

#endif
