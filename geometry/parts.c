/* Finds the parts of a set of curves or surfaces.
 *
 * Placements, materials and layers may be above a set, between sets, and above a part. The walk replaces a set by its
 * children, and wraps each child in the wrappers above the set. It does so again for each child that is a set. The
 * pending nodes are on an explicit stack, so a deep tree does not need much of the C stack. */
#include "geometry/parts.h"

#include <stdlib.h>

#include "model/store/array.h"

bool vs_is_wrapper(const vs_node *n) {
  return vs_node_is_around(n);
}

bool vs_is_several(const vs_node *n) {
  if (n->class_ != VS_CURVE && n->class_ != VS_SURFACE) return false;
  while (vs_is_wrapper(n)) n = n->children[0].node;
  return n->kind == VS_UNION;
}

void vs_several_free(vs_ref *parts, size_t count) {
  for (size_t i = 0; i < count; i++) vs_node_release(parts[i].node);
  free(parts);
}

vs_node *vs_parts_within(vs_ref whole, vs_ref inner) {
  size_t depth = 0;
  for (const vs_node *n = whole.node; vs_is_wrapper(n); n = n->children[0].node) depth++;
  const vs_node **chain = vs_fresh(depth + 1, sizeof *chain);
  if (!chain) return NULL;
  size_t k = 0;
  for (const vs_node *n = whole.node; vs_is_wrapper(n); n = n->children[0].node) chain[k++] = n;
  vs_node *made = vs_node_retain(inner.node);
  while (made && k > 0) {
    const vs_node *n = chain[--k];
    vs_ref child = { made, inner.origin };
    made = vs_node_new(n->store, (vs_kind)n->kind, vs_node_data(n), &child, 1);
    vs_node_release(child.node);
  }
  free(chain);
  return made;
}

bool vs_several_parts(vs_ref whole, vs_ref **out, size_t *count) {
  vs_ref *done = NULL, *todo = NULL;
  size_t done_count = 0, done_room = 0, todo_count = 0, todo_room = 0;
  bool ok = VS_GROW(todo, todo_room, 1);
  if (ok) todo[todo_count++] = (vs_ref){ vs_node_retain(whole.node), whole.origin };
  while (ok && todo_count > 0) {
    vs_ref at = todo[--todo_count];
    const vs_node *set = at.node;
    while (vs_is_wrapper(set)) set = set->children[0].node;
    if (set->kind != VS_UNION) {
      ok = VS_GROW(done, done_room, done_count + 1);
      if (ok) done[done_count++] = at;
      else vs_node_release(at.node);
      continue;
    }
    ok = VS_GROW(todo, todo_room, todo_count + set->child_count);
    for (uint32_t i = set->child_count; ok && i-- > 0;) { /* pushes the children in reverse order, so that the first
                                                           * child is on top of the stack */
      vs_node *part = vs_parts_within(at, set->children[i]);
      ok = part != NULL;
      if (ok) todo[todo_count++] = (vs_ref){ part, set->children[i].origin };
    }
    vs_node_release(at.node);
  }
  vs_several_free(todo, todo_count);
  if (!ok) vs_several_free(done, done_count), done = NULL, done_count = 0;
  *out = done, *count = done_count;
  return ok;
}
