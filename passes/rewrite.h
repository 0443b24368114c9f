/* Declares the run of one pass over a drawing; passes/flush.c also uses it. */
#ifndef VS_PASSES_REWRITE_H
#define VS_PASSES_REWRITE_H

#include "model/order.h"
#include "passes/passes.h"

typedef struct vs_rewrite vs_rewrite;
enum { VS_NODE_WORK = 1 << 14 }; /* estimate of the longest work of a pass for one node, in the units of vs_store_going;
                                  * a node may have thousands of points */
/* A function that rewrites node n, whose children have been replaced by kids (read-only). Returns a new reference, or
 * NULL on failure. To change nothing, it returns vs_rewrite_keep. If it returns one of the kids, it must set *origin to
 * the origin of that kid. */
typedef vs_node *vs_rewrite_fn(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin);

struct vs_rewrite {
  vs_store *store;
  const vs_pass_options *options;
  void *state;      /* data of the pass that is running, made by its begin function */
  vs_error *error;  /* error that a pass sets before it returns NULL; also set if memory is out */
  vs_order order;   /* order of the drawing's nodes as they were before the pass */
  const vs_origin *at; /* origin of the node that is being rewritten: the call in the source that made it */
  size_t changed;
  bool nests;       /* set by the pass fold if it has removed a wrapper around a set, so that the set may now be
                     * directly inside a set of its kind */
  bool idle;        /* set by the begin function of a pass if the pass would change nothing */
};

bool vs_rewrite_run(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count); /* rewrites the nodes to which refs
                                                                                    * leads with fn, and replaces refs;
                                                                                    * w->order is the order of these
                                                                                    * nodes; returns false on failure */
/* rewrites nodes as vs_rewrite_run does, but makes their order itself, and frees it */
bool vs_rewrite_alone(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count);
/* returns a new reference to n itself if kids are its children; otherwise to a copy of n with the children kids */
vs_node *vs_rewrite_keep(vs_rewrite *w, const vs_node *n, const vs_ref *kids);
bool vs_rewrite_lone(const vs_rewrite *w, const vs_node *old); /* returns true if the node `old` has a single reference,
                                                                * so that it is not a template */
/* Declares the function vs_pass_NAME of each pass. It does not receive leaves with a single reference (order.h); if all
 * children of a node are such leaves, kids is the node's own array. */

#define VS_PASS(upper, lower, begin, end, doc) vs_rewrite_fn vs_pass_##lower;
#include "passes/passes.def"

#endif
