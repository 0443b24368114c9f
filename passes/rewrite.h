/* Owns the one loop that runs all passes; passes/flush.c runs in it, too. */
#ifndef VS_PASSES_REWRITE_H
#define VS_PASSES_REWRITE_H

#include "model/order.h"
#include "passes/passes.h"

typedef struct vs_rewrite vs_rewrite;
enum { VS_NODE_WORK = 1 << 14 }; /* what a pass does for a node, told to vs_store_going: it may have thousands of
                                  * points */
/* Rewrites n, whose children have become kids (to be read only). Returns a new reference, NULL when out of memory.
 * *origin: set it where the result is one of the kids, whose call site then goes with it. A pass that has nothing to
 * say returns vs_rewrite_keep. */
typedef vs_node *vs_rewrite_fn(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin);

struct vs_rewrite {
  vs_store *store;
  const vs_pass_options *options;
  void *state;      /* the pass's own */
  vs_error *error;  /* a pass that returns NULL has set it, or memory ran out */
  vs_order order;   /* of the drawing before the pass */
  size_t changed;
  bool nests;       /* fold: a placement has gone from round a set, which may be a member of its kind of set now */
  bool idle;        /* its begin has seen that it would change nothing */
};

bool vs_rewrite_run(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count); /* w->order is of these references */
/* makes and frees the order itself */
bool vs_rewrite_alone(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count);
/* n itself if its kids are its own, else a copy with kids */
vs_node *vs_rewrite_keep(vs_rewrite *w, const vs_node *n, const vs_ref *kids);
bool vs_rewrite_lone(const vs_rewrite *w, const vs_node *old); /* named once: no template */
/* Lone leaves (order.h) are not shown to a pass. Where a node has no other children, kids are the node's own array. */

#define VS_PASS(upper, lower, begin, end, doc) vs_rewrite_fn vs_pass_##lower;
#include "passes/passes.def"

/* Rewrites the references in place (new nodes retained, old ones released); on failure they are what they were. stats
 * may be NULL. */
bool vs_passes_run(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_pass_stats *stats,
                   vs_error *e);
/* Counts the commands that a target program has to be told: a primitive 1, a placement or material 1, a k-ary set k -
 * 1, a template 1 and each use of it 1. */
bool vs_commands_count(vs_store *s, const vs_ref *refs, size_t count, double *commands, vs_error *e);

#endif
