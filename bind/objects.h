/* Declares objects and paints as Scheme values, implemented in objects.c. */
#ifndef VS_BIND_OBJECTS_H
#define VS_BIND_OBJECTS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

#define VS_BIND_NO_VALUE "one expression gave no value" /* text of the error for a list of objects that contains the
                                                         * value of an expression without a result */

/* vs_shape_type: type of objects, which own a reference to a node, with its origin. vs_paint_type: type of paints,
 * which refer to an interned vs_material. */
extern const vs_foreign_type vs_shape_type, vs_paint_type;
/* Returns the node and origin of a Scheme object, without retaining the node. The node is NULL if v is no object. */
static inline vs_ref vs_bind_take_ref(vs_value v) {
  vs_node *node = (vs_node *)vs_foreign_get(v, &vs_shape_type);
  return (vs_ref){ node, node ? (const vs_origin *)vs_as_foreign(v)->with : NULL };
}

/* Sets *out to a Scheme object of the node and origin in ref. Retains the node. */
vs_status vs_bind_give_ref(vs_bind *b, vs_ref ref, vs_value *out);
/* Sets *out to a list of Scheme objects for the `count` nodes and origins, in their order. Retains the nodes. */
vs_status vs_bind_give_refs(vs_bind *b, const vs_ref *refs, size_t count, vs_value *out);
/* Sets *out to a Scheme object of the node, and takes over the reference to it. If node is NULL, memory was out: sets
 * the error. */
vs_status vs_bind_give_object(vs_bind *b, vs_node *node, vs_value *out);

#endif
