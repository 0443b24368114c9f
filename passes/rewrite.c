/* Rewrites a drawing: visits every distinct node once, children first, and remembers results. */
#include "passes/rewrite.h"

/* The new node for an old node, and its origin. If origin is NULL, each reference to it keeps its own origin. */
typedef struct { vs_node *node; const vs_origin *origin; } vs_rewritten;

bool vs_rewrite_lone(const vs_rewrite *w, const vs_node *old) { return vs_order_uses(&w->order, old) == 1; }

/* ---- rewriting ---- */

vs_node *vs_rewrite_keep(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  bool same = true;
  for (uint32_t i = 0; same && kids != n->children && i < n->child_count; i++)
    same = kids[i].node == n->children[i].node;
  return same ? vs_node_retain((vs_node *)(uintptr_t)n)
              : vs_node_new(w->store, (vs_kind)n->kind, vs_node_data(n), kids, n->child_count);
}

static vs_ref rewritten_ref(const vs_rewrite *w, const vs_rewritten *results, vs_ref old) {
  if (!vs_order_has(&w->order, old.node)) return old; /* a leaf with a single reference has no number in the order, and
                                                       * passes do not change it */
  const vs_rewritten *new = &results[vs_order_of(old.node)];
  return (vs_ref){ new->node, new->origin ? new->origin : old.origin };
}

static bool rewrite_node(vs_rewrite *w, vs_rewrite_fn *fn, size_t index, vs_rewritten *results, vs_ref *room) {
  vs_ref at = w->order.at[index];
  vs_error *e = w->error;
  const vs_ref *kids = at.node->children;
  if (w->order.note[index].inner) {
    for (uint32_t i = 0; i < at.node->child_count; i++) room[i] = rewritten_ref(w, results, at.node->children[i]);
    kids = room;
  }
  results[index].origin = NULL;
  w->at = at.origin;
  results[index].node = fn(w, at.node, kids, &results[index].origin);
  if (w->order.note[index].uses > 1) results[index].origin = NULL; /* the new node has several references, each of which
                                                                    * keeps its own origin */
  if (results[index].node) return true;
  if (e->kind == VS_ERROR_NONE) vs_error_memory(e, at.origin);
  if (!e->origin) e->origin = at.origin;
  return false;
}

bool vs_rewrite_run(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count) {
  size_t nodes = w->order.count, widest = 1, done = 0;
  for (size_t i = 0; i < nodes; i++)
    if (w->order.note[i].inner && w->order.at[i].node->child_count > widest) widest = w->order.at[i].node->child_count;
  vs_rewritten *results = vs_store_realloc(w->store, NULL, 0, (nodes + 1) * sizeof *results);
  vs_ref *kids = vs_store_realloc(w->store, NULL, 0, widest * sizeof *kids);
  bool ok = (results && kids) || vs_error_memory(w->error, NULL);
  while (ok && done < nodes &&
         (ok = vs_store_going(w->store, VS_NODE_WORK, w->error) && rewrite_node(w, fn, done, results, kids)))
    done++;
  for (size_t i = 0; ok && i < count && (ok = vs_store_going(w->store, VS_ORDER_WORK, w->error)); i++) {
    vs_ref new = rewritten_ref(w, results, refs[i]);
    kids[0] = refs[i];
    refs[i] = (vs_ref){ vs_node_retain(new.node), new.origin };
    vs_node_release(kids[0].node);
  }
  for (size_t i = 0; i < done; i++) {
    ok = ok && vs_store_going(w->store, VS_ORDER_WORK, w->error);
    vs_node_release(results[i].node);
  }
  if (results) vs_store_realloc(w->store, results, (nodes + 1) * sizeof *results, 0);
  if (kids) vs_store_realloc(w->store, kids, widest * sizeof *kids, 0);
  return ok;
}

bool vs_rewrite_alone(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count) {
  w->order = (vs_order){ .store = w->store };
  bool ok = vs_order_make(&w->order, refs, count, w->error) && vs_rewrite_run(w, fn, refs, count);
  vs_order_free(&w->order);
  return ok;
}
