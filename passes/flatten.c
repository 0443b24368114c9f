/* Implements the pass flatten. It merges nested unions and nested intersections, changes (a - b) - c to a - (b c), and
 * replaces a set of a single member by the member.
 *
 * Only sets with a single reference are dissolved: a shared union is a template and stays. The order of members stays,
 * because the material of an earlier solid has priority where solids overlap.
 *
 * A set that will be dissolved into its parent is passed on unchanged and recorded. The topmost set gathers all members
 * below it at once. Therefore a chain of n binary unions takes n steps, not n^2. */
#include "passes/flatten.h"

#include <string.h>

#include "model/store/nodemap.h"
#include "passes/rewrite.h"

typedef struct {
  vs_store *store;
  uint64_t *above;      /* above[i]: kinds of set that can be merged into the set around node i of the old tree; bit 1
                         * << kind is set for each such kind */
  size_t count;
  vs_nodemap dissolves; /* new sets that are merged into their parent set when the parent is rewritten */
} vs_flatten;


bool vs_flatten_begin(vs_rewrite *w) {
  const vs_order *o = &w->order;
  vs_flatten *f = vs_store_realloc(w->store, NULL, 0, sizeof *f);
  if (!f) return vs_error_memory(w->error, NULL);
  *f = (vs_flatten){ .store = w->store, .count = o->count, .dissolves = { .store = w->store } };
  w->state = f;
  f->above = vs_store_realloc(w->store, NULL, 0, (o->count + 1) * sizeof *f->above);
  if (!f->above) return vs_error_memory(w->error, NULL);
  memset(f->above, 0, (o->count + 1) * sizeof *f->above);
  for (size_t k = 0; k < o->count; k++) {
    const vs_node *n = o->at[k].node;
    for (uint32_t i = 0; o->note[k].inner && vs_node_is_set(n) && i < n->child_count; i++)
      if (vs_order_has(o, n->children[i].node))
        f->above[vs_order_of(n->children[i].node)] = UINT64_C(1)
                                                     << (n->kind == VS_DIFFERENCE && i ? VS_UNION : n->kind);
  }
  return true;
}

void vs_flatten_end(vs_rewrite *w) {
  vs_flatten *f = w->state;
  if (!f) return;
  if (f->above) vs_store_realloc(w->store, f->above, (f->count + 1) * sizeof *f->above, 0);
  vs_nodemap_free(&f->dissolves);
  vs_store_realloc(w->store, f, sizeof *f, 0);
}

/* Returns true if the set `new`, which replaces the node `old`, will be merged into the set that refers to it. */
static bool flatten_fits(const vs_rewrite *w, const vs_flatten *f, const vs_node *old, const vs_node *new) {
  return new->child_count && vs_rewrite_lone(w, old) && f->above[vs_order_of(old)] >> new->kind & 1;
}

typedef struct { const vs_ref *at; size_t left; } vs_flatten_run; /* Members of a set that are not collected yet. `at`:
                                                                   * the first of them; `left`: their number. */

/* Collects the members of a set with the children `kids`, in order; the members of nested sets that are merged replace
 * these sets. If `out` is NULL, only counts the members. Returns false if memory is out. */
static bool flatten_gather(const vs_flatten *f, const vs_ref *kids, size_t kid_count, vs_ref *out, size_t *count) {
  size_t room = 16, depth = 1, n = 0;
  vs_flatten_run *stack = vs_store_realloc(f->store, NULL, 0, room * sizeof *stack);
  if (!stack) return false;
  stack[0] = (vs_flatten_run){ kids, kid_count };
  bool ok = true;
  while (ok && depth) {
    vs_flatten_run *top = &stack[depth - 1];
    if (!top->left) {
      depth--;
      continue;
    }
    vs_ref at = *top->at++;
    top->left--;
    if (!vs_nodemap_get(&f->dissolves, at.node)) {
      if (out) out[n] = at;
      n++;
      continue;
    }
    if (depth == room) {
      vs_flatten_run *grown = vs_store_realloc(f->store, stack, room * sizeof *stack, 2 * room * sizeof *stack);
      ok = grown != NULL;
      if (!ok) break;
      stack = grown;
      room *= 2;
    }
    stack[depth++] = (vs_flatten_run){ at.node->children, at.node->child_count };
  }
  vs_store_realloc(f->store, stack, room * sizeof *stack, 0);
  *count = n;
  return ok;
}

static vs_node *flatten_set(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  const vs_flatten *f = w->state;
  bool plain = true;
  for (uint32_t i = 0; plain && kids != n->children && i < n->child_count; i++)
    plain = !vs_nodemap_get(&f->dissolves, kids[i].node);
  if (plain) return vs_rewrite_keep(w, n, kids);
  size_t count;
  if (!flatten_gather(f, kids, n->child_count, NULL, &count)) return NULL;
  vs_ref *all = vs_store_realloc(w->store, NULL, 0, (count ? count : 1) * sizeof *all);
  if (!all) return NULL;
  size_t filled;
  vs_node *flat = flatten_gather(f, kids, n->child_count, all, &filled)
                      ? vs_node_new(w->store, (vs_kind)n->kind, vs_node_data(n), all, count)
                      : NULL;
  vs_store_realloc(w->store, all, (count ? count : 1) * sizeof *all, 0);
  w->changed++;
  return flat;
}

vs_node *vs_pass_flatten(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  vs_flatten *f = w->state;
  if (!vs_node_is_set(n)) return vs_rewrite_keep(w, n, kids);
  /* A set with one member equals this member, except a union of one closed curve, which is a region. */
  bool one = n->child_count == 1 && kids[0].node->class_ == n->class_ && !vs_nodemap_get(&f->dissolves, kids[0].node);
  vs_node *new;
  if (one) {
    *origin = kids[0].origin;
    w->changed++;
    new = vs_node_retain(kids[0].node);
    /* The only member replaces the set. If it has no other reference, it may be merged into the parent set. */
    if (!vs_rewrite_lone(w, n->children[0].node) || !flatten_fits(w, f, n, new)) return new;
  } else if (flatten_fits(w, f, n, n)) {
    new = vs_rewrite_keep(w, n, kids);
  } else {
    return flatten_set(w, n, kids);
  }
  if (new && !vs_nodemap_put(&f->dissolves, new, NULL)) {
    vs_node_release(new);
    new = NULL;
  }
  return new;
}
