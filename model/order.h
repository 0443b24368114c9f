/* Owns the order of a drawing's distinct nodes, children before their parents: what passes go through, and number their
 * own arrays by.
 *
 * A node remembers its number itself (`slot`), so that finding it costs no search: a million nodes in a map of
 * addresses are a million misses of the cache for every question. The numbers are those of the order made last; two
 * orders over one node are not in use together.
 *
 * Lone leaves, primitives that one reference names and no pass would change, are counted and have no number: a union of
 * a million of them costs one look at each. */
#ifndef VS_MODEL_ORDER_H
#define VS_MODEL_ORDER_H

#include "model/node.h"

typedef struct {
  uint32_t uses; /* references in the drawing that name it */
  bool inner;    /* some child has a number: else all are lone leaves */
} vs_order_note;

typedef struct {
  vs_store *store;
  vs_ref *at;      /* each with the origin of the reference met first; not retained */
  vs_order_note *note;
  size_t count, room;
  size_t lone;     /* leaves without a number that draw something */
  bool empty;      /* an EMPTY stands somewhere, with a number or without */
} vs_order; /* { .store = s } is an empty one */

enum { VS_ORDER_WORK = 1 << 8 }; /* of a look at one node, told to vs_store_going: a good deal less than a pass does for
                                  * it */
/* anew; on failure *o is empty; may be interrupted */
bool vs_order_make(vs_order *o, const vs_ref *refs, size_t count, vs_error *e);
void vs_order_free(vs_order *o);
static inline bool vs_order_is_lone(const vs_node *n) {
  return n->child_count == 0 && n->refs == 1 && !(n->flags & VS_NODE_SUGAR);
}
/* Of a node of the drawing: has it a number? */
static inline bool vs_order_has(const vs_order *o, const vs_node *n) {
  return n->slot < o->count && o->at[n->slot].node == n;
}
/* References in the drawing that name it. */
static inline uint32_t vs_order_uses(const vs_order *o, const vs_node *n) {
  return vs_order_has(o, n) ? o->note[n->slot].uses : 1;
}
/* The number of a node that has one. */
static inline size_t vs_order_of(const vs_node *n) { return n->slot; }

#endif
