/* Owns the passes: functions from drawing to drawing that keep the drawn shape and need fewer commands.
 *
 * A model is a DAG. Each pass visits every distinct node once, children first, and never recurses. A node with several
 * references is a template: passes may change the node itself, and never dissolve it into its users. */
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
  /* Gives safe bounds of a node in its own coordinates; it comes from geometry, which this layer cannot call. NULL:
   * prune removes only empty nodes. Nodes may be gone after the run, so context must forget them then. */
  bool (*bounds)(void *context, const vs_node *n, vs_bounds *out, vs_error *e);
  void *context;
} vs_pass_options;

typedef struct {
  double commands_before, commands_after;            /* for a target program: order_commands in rewrite.c */
  size_t changed[VS_PASS_COUNT];                     /* the number of nodes that each pass rewrote */
} vs_pass_stats;

#endif
