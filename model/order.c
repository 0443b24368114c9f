/* Implements the order of nodes (order.h): numbers the distinct nodes of a drawing, with an explicit stack instead of
 * recursion. */
#include "model/order.h"

#include "model/store/store_inside.h"

typedef struct { vs_ref ref; uint32_t next; bool inner; } order_level;

static bool order_grow(vs_order *o) {
  size_t room = o->room ? o->room * 2 : 64;
  if (room > UINT32_MAX) return false;
  vs_ref *at = vs_store_realloc(o->store, o->at, o->room * sizeof *at, room * sizeof *at);
  if (!at) return false;
  o->at = at;
  vs_order_note *note = vs_store_realloc(o->store, o->note, o->room * sizeof *note, room * sizeof *note);
  if (!note) { /* the arrays `at` and `note` always have equal numbers of elements */
    at = vs_store_realloc(o->store, o->at, room * sizeof *at, o->room * sizeof *at);
    if (at || !o->room) o->at = at;
    return false;
  }
  o->note = note;
  o->room = room;
  return true;
}

/* Adds a node to the order, after its children. inner: true if a child has a number. */
static bool order_add(vs_order *o, vs_ref ref, bool inner) {
  if (o->count == o->room && !order_grow(o)) return false;
  ref.node->slot = (uint32_t)o->count;
  o->note[o->count] = (vs_order_note){ 0, inner };
  o->at[o->count++] = ref;
  o->empty |= ref.node->kind == VS_EMPTY;
  for (uint32_t i = 0; inner && i < ref.node->child_count; i++) {
    const vs_node *child = ref.node->children[i].node;
    if (vs_order_has(o, child)) o->note[child->slot].uses++;
  }
  return true;
}

static void order_pass_by(vs_order *o, const vs_node *leaf) {
  bool empty = leaf->kind == VS_EMPTY;
  o->empty |= empty;
  o->lone += !empty;
}

/* Finds the next child, of the node at the level `top` of the stack, that needs a number. Counts the lone leaves
 * (leaves with one reference) before it. Returns false if there is no such child. */
static bool order_next(vs_order *o, order_level *top, vs_ref *child) {
  const vs_node *n = top->ref.node;
  while (top->next < n->child_count) {
    *child = *vs_node_next(n, top->next++);
    if (!vs_order_is_lone(child->node)) {
      top->inner = true;
      return true;
    }
    order_pass_by(o, child->node);
  }
  return false;
}

bool vs_order_make(vs_order *o, const vs_ref *refs, size_t count, vs_error *e) {
  order_level *levels = NULL;
  size_t depth = 0, room = 0;
  bool ok = true, going = true;
  o->count = o->lone = 0;
  o->empty = false;
  for (size_t i = 0; ok && (going = vs_store_going(o->store, VS_ORDER_WORK, e)) && i < count; i++) {
    vs_ref at = refs[i];
    if (vs_order_is_lone(at.node)) {
      order_pass_by(o, at.node);
      continue;
    }
    for (bool down = true; ok && (going = vs_store_going(o->store, VS_ORDER_WORK, e));) {
      if (down && !vs_order_has(o, at.node) && at.node->child_count) {
        if (depth == room) {
          size_t more = room ? room * 2 : 64;
          order_level *grown = vs_store_realloc(o->store, levels, room * sizeof *levels, more * sizeof *levels);
          if (!(ok = grown != NULL)) break;
          levels = grown;
          room = more;
        }
        levels[depth++] = (order_level){ .ref = at };
      } else if (down && !vs_order_has(o, at.node)) {
        ok = order_add(o, at, false);
      }
      if (!ok || !depth) break;
      order_level *top = &levels[depth - 1];
      down = order_next(o, top, &at);
      if (!down) {
        depth--;
        ok = order_add(o, top->ref, top->inner);
      }
    }
    if (ok && going) o->note[refs[i].node->slot].uses++;
    else break;
  }
  vs_store_realloc(o->store, levels, room * sizeof *levels, 0);
  if (ok && going) return true;
  vs_order_free(o);
  return going ? vs_error_memory(e, NULL) : false;
}

void vs_order_free(vs_order *o) {
  vs_store_realloc(o->store, o->at, o->room * sizeof *o->at, 0);
  vs_store_realloc(o->store, o->note, o->room * sizeof *o->note, 0);
  *o = (vs_order){ .store = o->store };
}
