/* Owns the order of a drawing's distinct nodes, children before their parents. Passes use it to visit nodes, and to
 * index their arrays.
 *
 * A node contains its number (`slot`), so finding it costs no search: with a map of addresses, a million nodes are a
 * million cache misses. The numbers are those of the last order; two orders over one node cannot be used together.
 *
 * A lone leaf is a primitive with one reference, which no pass would change. Lone leaves are counted and have no
 * number: a union of a million of them costs one visit to each. */
#ifndef VS_MODEL_ORDER_H
#define VS_MODEL_ORDER_H

#include "model/node.h"

typedef struct {
  uint32_t uses; /* the number of references to it in the drawing */
  bool inner;    /* some child has a number: else all are lone leaves */
} vs_order_note;

typedef struct {
  vs_store *store;
  vs_ref *at;      /* each with the origin of its first reference; not retained */
  vs_order_note *note;
  size_t count, room;
  size_t lone;     /* the number of leaves without a number that draw something */
  bool empty;      /* the drawing contains an EMPTY, with a number or without */
} vs_order; /* { .store = s } is an empty one */

enum { VS_ORDER_WORK = 1 << 8 }; /* the work of visiting one node, for vs_store_going: much less than a pass does for
                                  * it */
/* Makes the order anew. Fails when memory is out or the user interrupts; *o is then empty. */
bool vs_order_make(vs_order *o, const vs_ref *refs, size_t count, vs_error *e);
void vs_order_free(vs_order *o);
static inline bool vs_order_is_lone(const vs_node *n) {
  return n->child_count == 0 && n->refs == 1 && !(n->flags & VS_NODE_SUGAR);
}
/* Returns true if the node, which is in the drawing, has a number. */
static inline bool vs_order_has(const vs_order *o, const vs_node *n) {
  return n->slot < o->count && o->at[n->slot].node == n;
}
/* Returns the number of references to the node in the drawing. */
static inline uint32_t vs_order_uses(const vs_order *o, const vs_node *n) {
  return vs_order_has(o, n) ? o->note[n->slot].uses : 1;
}
/* Returns the number of a node that has one. */
static inline size_t vs_order_of(const vs_node *n) { return n->slot; }

#endif
