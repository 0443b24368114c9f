/* Runs the passes in the order of passes.def, and counts commands. */
#include "passes/passes.h"

#include "model/kinds.h"
#include "passes/flatten.h"
#include "passes/fold.h"
#include "passes/rewrite.h"
#include "passes/share.h"

const vs_pass_info *vs_pass_get(vs_pass_kind pass) {
  static const vs_pass_info passes[] = {
#define VS_PASS(upper, lower, begin, end, doc) { #lower, doc },
#include "passes/passes.def"
  };
  return &passes[pass];
}

/* ---- counting ---- */

static double order_commands(const vs_order *o, size_t drawn) {
  /* n objects drawn count as their union, a chain of n - 1 commands with two operands each */
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

/* Runs pass k over the drawing: calls its begin function, then rewrites every node, and calls its end function. Omits
 * the rewriting if the begin function has found that nothing would change. */
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
  bool ok = vs_store_going(s, UINT32_MAX, e) && vs_order_make(&order, work, count, e);
  if (ok && stats) stats->commands_before = order_commands(&order, count);
  bool nests = false;
  for (int k = 0; ok && k < VS_PASS_COUNT; k++) {
    if (!(options->passes >> k & 1)) continue;
    vs_rewrite w = { .store = s, .options = options, .error = e, .order = order };
    ok = pass_once((vs_pass_kind)k, &w, work, count);
    if (stats) stats->changed[k] += w.changed;
    /* computes the order of the nodes again only if a pass has changed the drawing */
    if (ok && w.changed) ok = vs_order_make(&order, work, count, e);
    if (k == VS_PASS_FOLD && w.nests && !nests && options->passes >> VS_PASS_FLATTEN & 1) {
      nests = true;
      k = VS_PASS_FLATTEN - 1; /* the pass fold has removed a wrapper between two sets; continues with flatten, which
                                * can merge these sets now */
    }
  }
  if (ok && stats) stats->commands_after = order_commands(&order, count);
  vs_order_free(&order);
  for (size_t i = 0; i < count; i++) {
    ok = ok && vs_store_going(s, VS_ORDER_WORK, e); /* an interrupt leaves some refs as they were */
    vs_ref drop = ok ? refs[i] : work[i];
    if (ok) refs[i] = work[i];
    vs_node_release(drop.node);
  }
  vs_store_realloc(s, work, (count ? count : 1) * sizeof *work, 0);
  return ok;
}
