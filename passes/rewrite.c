/* Runs the passes: visits every distinct node once, children first, and remembers results. Also counts commands. */
#include "passes/rewrite.h"
#include "passes/flatten.h"
#include "passes/fold.h"
#include "passes/share.h"

/* The new node that replaces an old one, and its origin. origin NULL: each reference keeps its own origin. */
typedef struct { vs_node *node; const vs_origin *origin; } vs_rewritten;

const vs_pass_info *vs_pass_get(vs_pass_kind pass) {
  static const vs_pass_info passes[] = {
#define VS_PASS(upper, lower, begin, end, doc) { #lower, doc },
#include "passes/passes.def"
  };
  return &passes[pass];
}

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
  if (!vs_order_has(&w->order, old.node)) return old; /* a lone leaf */
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
  if (w->order.note[index].uses > 1) results[index].origin = NULL; /* several calls refer to the node, and each
                                                                    * reference keeps its own origin */
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
  for (size_t i = 0; ok && i < count; i++) {
    vs_ref new = rewritten_ref(w, results, refs[i]);
    kids[0] = refs[i];
    refs[i] = (vs_ref){ vs_node_retain(new.node), new.origin };
    vs_node_release(kids[0].node);
  }
  for (size_t i = 0; i < done; i++) vs_node_release(results[i].node);
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

/* ---- counting ---- */

static double order_commands(const vs_order *o, size_t drawn) {
  /* the drawing is the union of the drawn objects */
  double commands = (drawn > 1 ? (double)(drawn - 1) : 0) + (double)o->lone;
  for (size_t i = 0; i < o->count; i++) {
    const vs_node *n = o->at[i].node;
    switch (vs_kind_get((vs_kind)n->kind)->level) {
    case VS_LEVEL_MESH:
    case VS_LEVEL_FLAT:
    case VS_LEVEL_CURVED:
    case VS_LEVEL_SWEPT:
    case VS_LEVEL_SUGAR: commands += n->kind == VS_EMPTY ? 0 : 1; break;
    case VS_LEVEL_OPERATION:
      if (n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER)
        commands += 1;
      else if (n->child_count > 1)
        commands += n->child_count - 1;
      break;
    }
    if (o->note[i].uses > 1) commands += 1 + (double)o->note[i].uses;
  }
  return commands;
}

/* ---- all passes ---- */

/* Runs a single pass over the drawing: its begin; then every node, unless its begin found that nothing would change;
 * then its end. */
static bool pass_once(vs_pass_kind k, vs_rewrite *w, vs_ref *refs, size_t count) {
  static const struct { vs_rewrite_fn *node; bool (*begin)(vs_rewrite *w); void (*end)(vs_rewrite *w); } passes[] = {
#define VS_PASS(upper, lower, begin, end, doc) { vs_pass_##lower, begin, end },
#include "passes/passes.def"
  };
  bool ok = !passes[k].begin || passes[k].begin(w);
  ok = ok && (w->idle || vs_rewrite_run(w, passes[k].node, refs, count));
  if (passes[k].end) passes[k].end(w);
  return ok;
}

bool vs_passes_run(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_pass_stats *stats,
                   vs_error *e) {
  vs_error local;
  if (!e) e = &local;
  e->kind = VS_ERROR_NONE;
  if (stats) *stats = (vs_pass_stats){ 0 };
  vs_ref *work = vs_store_realloc(s, NULL, 0, (count ? count : 1) * sizeof *work);
  if (!work) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < count; i++) {
    work[i] = refs[i];
    vs_node_retain(work[i].node);
  }
  vs_order order = { .store = s };
  bool ok = vs_order_make(&order, work, count, e);
  if (ok && stats) stats->commands_before = order_commands(&order, count);
  bool nests = false;
  for (int k = 0; ok && k < VS_PASS_COUNT; k++) {
    if (!(options->passes >> k & 1)) continue;
    vs_rewrite w = { .store = s, .options = options, .error = e, .order = order };
    ok = pass_once((vs_pass_kind)k, &w, work, count);
    if (stats) stats->changed[k] += w.changed;
    /* if no pass changed the drawing, the order of its nodes is still valid */
    if (ok && w.changed) ok = vs_order_make(&order, work, count, e);
    if (k == VS_PASS_FOLD && w.nests && !nests && options->passes >> VS_PASS_FLATTEN & 1) {
      nests = true;
      k = VS_PASS_FLATTEN - 1; /* runs again from there, because a wrapper between two sets was removed */
    }
  }
  if (ok && stats) stats->commands_after = order_commands(&order, count);
  vs_order_free(&order);
  for (size_t i = 0; i < count; i++) {
    vs_ref drop = ok ? refs[i] : work[i];
    if (ok) refs[i] = work[i];
    vs_node_release(drop.node);
  }
  vs_store_realloc(s, work, (count ? count : 1) * sizeof *work, 0);
  return ok;
}
