/* Owns the order of a drawing's distinct nodes, children before their parents: what passes go through, and number their own arrays by.
 *
 * A node remembers its number itself (`slot`), so that finding it costs no search: a million nodes in a map of addresses are a million misses
 * of the cache for every question. The numbers are those of the order made last; two orders over one node are not in use together. */
#ifndef VS_MODEL_ORDER_H
#define VS_MODEL_ORDER_H

#include "model/node.h"

typedef struct {
  vs_store *store;
  vs_ref *at;      /* each with the origin of the reference met first; not retained */
  uint32_t *uses;  /* references in the drawing that name it */
  size_t count, room;
} vs_order; /* { .store = s } is an empty one */

bool vs_order_make(vs_order *o, const vs_ref *refs, size_t count, vs_error *e); /* anew; on failure *o is empty */
void vs_order_free(vs_order *o);
/* The number of a node that is in the order. */
static inline size_t vs_order_of(const vs_node *n) { return n->slot; }

#endif
