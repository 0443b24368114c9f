/* Declares the order of a drawing's distinct nodes: children before their parents. Passes visit nodes in this order,
 * and use a node's number as an index into arrays.
 *
 * Each node contains its number (`slot`), so that no search is needed: a map from addresses would cost a million cache
 * misses for a million nodes. A new order overwrites the numbers: two orders that share a node cannot be used together.
 *
 * A lone leaf is a primitive with only one reference, which no pass would change. Lone leaves are counted and get no
 * number: a union of a million lone leaves costs one visit to each. */
#ifndef VS_MODEL_ORDER_H
#define VS_MODEL_ORDER_H

#include "model/node.h"

typedef struct {
  uint32_t uses; /* number of references to the node in the drawing */
  bool inner;    /* true if a child of the node has a number; false if all its children are leaves with a single
                  * reference */
} vs_order_note;

typedef struct {
  vs_store *store;
  vs_ref *at;      /* the nodes in order, each with the origin of its first reference; not retained */
  vs_order_note *note;
  size_t count, room;
  size_t lone;     /* number of leaves with a single reference, which have no number; nodes of kind VS_EMPTY are not
                    * counted */
  bool empty;      /* true if the drawing contains a node of kind VS_EMPTY */
} vs_order; /* initial value of an empty order: { .store = s } */

enum { VS_ORDER_WORK = 1 << 8 }; /* Work of visiting one node, in the unit of vs_store_going (about a nanosecond).
                                  * Passes do far more work for each node. */
/* Computes the order of the nodes to which refs leads, directly or indirectly. On an interrupt, or when memory is out,
 * returns false, and *o is empty. */
bool vs_order_make(vs_order *o, const vs_ref *refs, size_t count, vs_error *e);
void vs_order_free(vs_order *o);
static inline bool vs_order_is_lone(const vs_node *n) {
  return n->child_count == 0 && n->refs == 1 && !(n->flags & VS_NODE_SUGAR);
}
/* Returns true if node n of the drawing has a number in the order. */
static inline bool vs_order_has(const vs_order *o, const vs_node *n) {
  return n->slot < o->count && o->at[n->slot].node == n;
}
/* Returns the number of references to the node in the drawing. */
static inline uint32_t vs_order_uses(const vs_order *o, const vs_node *n) {
  return vs_order_has(o, n) ? o->note[n->slot].uses : 1;
}
/* Returns the number of node n in the order; it must have one. */
static inline size_t vs_order_of(const vs_node *n) { return n->slot; }

#endif
