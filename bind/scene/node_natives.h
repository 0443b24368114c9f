/* Declares the natives of node_natives.c: matrices of nodes, drawings that change with the focus, and the objects that
 * a scene shows. nodes.scm implements everything else. */
#ifndef VS_BIND_SCENE_NODE_NATIVES_H
#define VS_BIND_SCENE_NODE_NATIVES_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

extern const vs_native_table vs_node_table;

/* Returns all tables of natives except those of the VM, with a NULL at the end. vs_config refers to these tables, both
 * in the library and in the program that creates the heap image. */
const vs_native_table *const *vs_nodes_tables(void);

/* Returns true if the program has created or used a scene node. */
bool vs_nodes_are_there(const vs_bind *b);

typedef enum { VS_NODE_NAME, VS_NODE_PARENT, VS_NODE_CHILDREN } vs_node_part;

/* Reads a property of a scene node without running the program. Sets *out to the node's name (a string or #f), its
 * parent (a node or #f), or the list of its children. Returns false, with *out #f, if v is no node. When memory is out,
 * returns false with the error set. */
bool vs_node_read(vs_scheme *vm, vs_value v, vs_node_part part, vs_value *out);

/* Computes the objects that the scene shows, by running Scheme code, and sets *list to a Scheme list of these objects.
 * *beside: whether they are shown in addition to the drawing; false if they replace it, because a node other than the
 * root has the focus. If it fails, sets the error and returns false. */
bool vs_nodes_shown(vs_bind *b, bool *beside, vs_value *list);

#endif
