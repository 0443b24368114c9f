/* Owns the interface of node_natives.c: the frames of nodes as matrices, the drawing that changes with the focus, and
 * the objects that a scene shows. nodes.scm is the rest. */
#ifndef VS_BIND_SCENE_NODE_NATIVES_H
#define VS_BIND_SCENE_NODE_NATIVES_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

extern const vs_native_table vs_node_table;

/* Returns all tables of natives above the VM, NULL-terminated: those of bind/ and of this layer. For vs_config, here
 * and in the program that makes the image. */
const vs_native_table *const *vs_nodes_tables(void);

/* Returns true if the program has made a node or called for one. */
bool vs_nodes_are_there(const vs_bind *b);

typedef enum { VS_NODE_NAME, VS_NODE_PARENT, VS_NODE_CHILDREN } vs_node_part;

/* Reads a part of a node without running the program. *out becomes the node's name, a string or #f; its parent, a node
 * or #f; or the list of its children. Returns false with *out #f if v is no node, or with the condition set when memory
 * is out. */
bool vs_node_read(vs_scheme *vm, vs_value v, vs_node_part part, vs_value *out);

/* Computes the objects that the scene shows; runs Scheme. *list: the objects, a Scheme list. *beside: true if they are
 * shown beside the drawing; false if they replace it, since a node other than the root has the focus. Returns false
 * with the condition set. */
bool vs_nodes_shown(vs_bind *b, bool *beside, vs_value *list);

#endif
