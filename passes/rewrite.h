/* Declares the run of one pass over a drawing; passes/flush.c also uses it. */
#ifndef VS_PASSES_REWRITE_H
#define VS_PASSES_REWRITE_H

#include "model/order.h"
#include "passes/passes.h"

typedef struct vs_rewrite vs_rewrite;
enum { VS_NODE_WORK = 1 << 14 }; /* estimate of the longest work of a pass for one node, in the units of vs_store_going;
                                  * a node may have thousands of points */
/* Rewrites n, whose children are now kids (read-only). Returns a new reference, or NULL if memory is out. If the result
 * is one of the kids, the function must set *origin to the kid's origin. If the pass changes nothing, it returns
 * vs_rewrite_keep. */
typedef vs_node *vs_rewrite_fn(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin);

struct vs_rewrite {
  vs_store *store;
  const vs_pass_options *options;
  void *state;      /* the pass's own data */
  vs_error *error;  /* error that is set by a pass that returns NULL, or if memory is out */
  vs_order order;   /* order of the nodes before the pass */
  const vs_origin *at; /* origin of the node: the call in the source that made it */
  size_t changed;
  bool nests;       /* set by fold: a placement around a set was removed, so the set may now be nested directly in a set
                     * of its own kind */
  bool idle;        /* set by the begin function of the pass if nothing would change */
};

bool vs_rewrite_run(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count); /* rewrites refs; w->order must be
                                                                                    * the order of these references */
/* rewrites refs as vs_rewrite_run does, but makes and frees the order itself */
bool vs_rewrite_alone(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count);
/* returns n itself if its children are kids, otherwise a copy of n with kids */
vs_node *vs_rewrite_keep(vs_rewrite *w, const vs_node *n, const vs_ref *kids);
bool vs_rewrite_lone(const vs_rewrite *w, const vs_node *old); /* returns true if the node has a single reference, so
                                                                * that it is not a template */
/* A pass does not receive lone leaves, which have a single reference (order.h). If a node has no children other than
 * lone leaves, kids are the node's own array. */

#define VS_PASS(upper, lower, begin, end, doc) vs_rewrite_fn vs_pass_##lower;
#include "passes/passes.def"

#endif
