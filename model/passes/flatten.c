/* Owns flatten: n-ary unions and intersections of their own kind's members, (a - b) - c as a - (b c), sets of one as their member.
 *
 * Only through nodes that are named once: a shared union is a template and stays. Order is kept, and with it the rule that where solids
 * overlap the earlier one's material wins. */
#include "model/passes/rewrite.h"

/* Does member i of a set of this kind dissolve into it? old: what it was; new: what it has become. */
static bool vs_flatten_dissolves(const vs_rewrite *w, vs_kind set, uint32_t i, const vs_node *old, const vs_node *new) {
  if (!vs_rewrite_lone(w, old) || !new->child_count) return false;
  if (set == VS_DIFFERENCE) return new->kind == (i ? VS_UNION : VS_DIFFERENCE);
  return new->kind == set;
}

vs_node *vs_pass_flatten(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  bool set = n->kind == VS_UNION || n->kind == VS_INTERSECTION || n->kind == VS_DIFFERENCE;
  size_t members = 0;
  if (!set) return vs_rewrite_keep(w, n, kids);
  for (uint32_t i = 0; i < n->child_count; i++)
    members += vs_flatten_dissolves(w, (vs_kind)n->kind, i, n->children[i].node, kids[i].node) ? kids[i].node->child_count : 1;
  /* A set of one is its member: but the union of one closed curve is a region */
  if (members == 1 && n->child_count == 1 && kids[0].node->class_ == n->class_) {
    *origin = kids[0].origin;
    w->changed++;
    return vs_node_retain(kids[0].node);
  }
  if (members == n->child_count) return vs_rewrite_keep(w, n, kids);
  vs_ref *all = vs_store_realloc(w->store, NULL, 0, members * sizeof *all);
  if (!all) return NULL;
  size_t k = 0;
  for (uint32_t i = 0; i < n->child_count; i++) {
    if (!vs_flatten_dissolves(w, (vs_kind)n->kind, i, n->children[i].node, kids[i].node)) all[k++] = kids[i];
    else
      for (uint32_t j = 0; j < kids[i].node->child_count; j++) all[k++] = kids[i].node->children[j];
  }
  vs_node *flat = vs_node_new(w->store, (vs_kind)n->kind, n->data, all, members);
  vs_store_realloc(w->store, all, members * sizeof *all, 0);
  w->changed++;
  return flat;
}
