/* Owns the walk that numbers distinct nodes, on a stack of its own. See order.h. */
#include "model/order.h"

#include "model/store.h"

typedef struct { vs_ref ref; uint32_t next; } order_level;

static bool order_has(const vs_order *o, const vs_node *n) { return n->slot < o->count && o->at[n->slot].node == n; }

static bool order_grow(vs_order *o) {
  size_t room = o->room ? o->room * 2 : 64;
  if (room > UINT32_MAX) return false;
  vs_ref *at = vs_store_realloc(o->store, o->at, o->room * sizeof *at, room * sizeof *at);
  if (!at) return false;
  o->at = at;
  uint32_t *uses = vs_store_realloc(o->store, o->uses, o->room * sizeof *uses, room * sizeof *uses);
  if (!uses) { /* the two keep one size */
    at = vs_store_realloc(o->store, o->at, room * sizeof *at, o->room * sizeof *at);
    if (at || !o->room) o->at = at;
    return false;
  }
  o->uses = uses;
  o->room = room;
  return true;
}

/* Its children are numbered. */
static bool order_add(vs_order *o, vs_ref ref) {
  if (o->count == o->room && !order_grow(o)) return false;
  ref.node->slot = (uint32_t)o->count;
  o->uses[o->count] = 0;
  o->at[o->count++] = ref;
  for (uint32_t i = 0; i < ref.node->child_count; i++) o->uses[ref.node->children[i].node->slot]++;
  return true;
}

bool vs_order_make(vs_order *o, const vs_ref *refs, size_t count, vs_error *e) {
  order_level *levels = NULL;
  size_t depth = 0, room = 0;
  bool ok = true;
  o->count = 0;
  for (size_t i = 0; ok && i < count; i++) {
    vs_ref at = refs[i];
    for (bool down = true; ok;) {
      if (down && !order_has(o, at.node) && at.node->child_count) {
        if (depth == room) {
          size_t more = room ? room * 2 : 64;
          order_level *grown = vs_store_realloc(o->store, levels, room * sizeof *levels, more * sizeof *levels);
          if (!(ok = grown != NULL)) break;
          levels = grown;
          room = more;
        }
        levels[depth++] = (order_level){ at, 0 };
      } else if (down && !order_has(o, at.node)) {
        ok = order_add(o, at);
      }
      if (!ok || !depth) break;
      order_level *top = &levels[depth - 1];
      down = top->next < top->ref.node->child_count;
      if (down) at = top->ref.node->children[top->next++];
      else ok = order_add(o, levels[--depth].ref);
    }
    if (ok) o->uses[refs[i].node->slot]++;
  }
  vs_store_realloc(o->store, levels, room * sizeof *levels, 0);
  if (ok) return true;
  vs_order_free(o);
  return vs_error_memory(e, NULL);
}

void vs_order_free(vs_order *o) {
  vs_store_realloc(o->store, o->at, o->room * sizeof *o->at, 0);
  vs_store_realloc(o->store, o->uses, o->room * sizeof *o->uses, 0);
  *o = (vs_order){ .store = o->store };
}
