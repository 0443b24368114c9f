/* Owns, for model/passes/ alone, the one loop that all passes are run by. */
#ifndef VS_MODEL_PASSES_REWRITE_H
#define VS_MODEL_PASSES_REWRITE_H

#include "model/nodemap.h"
#include "model/passes/passes.h"

typedef struct vs_rewrite vs_rewrite;
/* What becomes of n, whose children have become kids (to be read only). Returns a new reference, NULL when out of memory. *origin: set it
 * where the result is one of the kids, whose call site then goes with it. A pass that has nothing to say returns vs_rewrite_keep. */
typedef vs_node *vs_rewrite_fn(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin);

struct vs_rewrite {
  vs_store *store;
  const vs_pass_options *options;
  void *state;      /* the pass's own */
  vs_error *error;  /* a pass that returns NULL has set it, or memory ran out */
  vs_nodemap uses;  /* old node -> how many references in the drawing name it */
  size_t changed;
};

bool vs_rewrite_run(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count);
vs_node *vs_rewrite_keep(vs_rewrite *w, const vs_node *n, const vs_ref *kids); /* n itself if its kids are its own, else a copy with kids */
bool vs_rewrite_lone(const vs_rewrite *w, const vs_node *old); /* named once: no template */
bool vs_rewrite_count_uses(vs_nodemap *uses, vs_store *s, const vs_ref *refs, size_t count, vs_error *e);

vs_rewrite_fn vs_pass_flatten, vs_pass_fold, vs_pass_prune, vs_pass_share;
/* Calls visit for every distinct node, children before parents, in the order in which vs_rewrite_run comes to them. */
typedef bool vs_visit_fn(void *context, vs_ref at, vs_error *e);
bool vs_rewrite_visit(vs_store *s, const vs_ref *refs, size_t count, vs_visit_fn *visit, void *context, vs_error *e);
bool vs_flatten_begin(vs_rewrite *w, const vs_ref *refs, size_t count); /* makes w->state */
void vs_flatten_end(vs_rewrite *w);
bool vs_share_begin(vs_rewrite *w, const vs_ref *refs, size_t count); /* makes w->state */
void vs_share_end(vs_rewrite *w);

#endif
