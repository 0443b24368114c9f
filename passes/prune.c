/* Implements the pass prune: it removes empty nodes, and differences and intersections of parts that cannot intersect.
 *
 * Bounds of curved shapes come from sample points, so the pass enlarges bounds by a thousandth before it compares
 * them. */
#include "passes/rewrite.h"

static bool prune_empty(const vs_node *n) { return n->kind == VS_EMPTY; }

static vs_node *prune_to_nothing(vs_rewrite *w) {
  w->changed++;
  return vs_node_new(w->store, VS_EMPTY, NULL, NULL, 0);
}

/* Sets *apart to true if the bounds of nodes a and b prove that they have no common point. Returns false on failure. */
static bool prune_apart(const vs_rewrite *w, const vs_node *a, const vs_node *b, bool *apart) {
  vs_bounds p, q;
  *apart = false;
  if (!w->options->bounds || a->class_ != VS_SOLID || b->class_ != VS_SOLID) return true;
  if (!w->options->bounds(w->options->context, a, &p, w->error) ||
      !w->options->bounds(w->options->context, b, &q, w->error))
    return false;
  double slack = 1e-3 * (vs_bounds_diagonal(&p) + vs_bounds_diagonal(&q));
  *apart = p.min.x - slack > q.max.x || q.min.x - slack > p.max.x || p.min.y - slack > q.max.y ||
           q.min.y - slack > p.max.y || p.min.z - slack > q.max.z || q.min.z - slack > p.max.z;
  return true;
}

vs_node *vs_pass_prune(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  if (vs_node_has(n, VS_IS_OF_FIRST) && n->child_count && prune_empty(kids[0].node)) return prune_to_nothing(w);
  if (!vs_node_is_set(n)) return vs_rewrite_keep(w, n, kids);
  bool untouched = kids == n->children || !w->changed;
  /* keeps the union n if none of its children was or became empty */
  if (n->kind == VS_UNION && !w->order.empty && n->child_count && untouched) return vs_rewrite_keep(w, n, kids);
  size_t kept = 0;
  vs_ref *all = vs_store_realloc(w->store, NULL, 0, (n->child_count + (size_t)1) * sizeof *all);
  if (!all) return NULL;
  bool nothing = n->child_count == 0, ok = true, misses = n->kind == VS_DIFFERENCE && n->child_count > 1;
  for (uint32_t i = 0; ok && !nothing && i < n->child_count; i++) {
    bool empty = prune_empty(kids[i].node), apart = false;
    if (n->kind != VS_UNION && !empty && i) ok = prune_apart(w, kids[0].node, kids[i].node, &apart);
    misses = misses && (i == 0 ? !empty : apart);
    if (n->kind == VS_INTERSECTION && (empty || apart)) nothing = true;
    else if (n->kind == VS_DIFFERENCE && i == 0 && empty) nothing = true;
    else if (!empty && !apart) all[kept++] = kids[i];
  }
  const vs_pass_notes *notes = w->options->notes;
  if (ok && misses && notes)
    notes->warn(notes->context, w->at, "subtract takes nothing away here: no other object meets the first one; "
                                       "move it, or (bounding-box object) shows where it is");
  vs_node *result = NULL;
  if (ok && (nothing || !kept)) result = prune_to_nothing(w);
  else if (ok && kept == n->child_count) result = vs_rewrite_keep(w, n, kids);
  else if (ok) {
    w->changed++;
    if (kept == 1 && all[0].node->class_ == n->class_) {
      *origin = all[0].origin;
      result = vs_node_retain(all[0].node);
    } else result = vs_node_new(w->store, (vs_kind)n->kind, vs_node_data(n), all, kept);
  }
  vs_store_realloc(w->store, all, (n->child_count + (size_t)1) * sizeof *all, 0);
  return result;
}
