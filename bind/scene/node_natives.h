/* Owns what nodes need of C: their frames as matrices, the drawing that changes hands with the focus, and the objects
 * that a scene shows when the drawing is handed over. nodes.scm is the rest. */
#ifndef VS_BIND_SCENE_NODE_NATIVES_H
#define VS_BIND_SCENE_NODE_NATIVES_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

extern const vs_native_table vs_node_table;

/* All tables of natives above the VM, NULL-terminated: bind/'s and this layer's. For vs_config, here and where the
 * image is made. */
const vs_native_table *const *vs_nodes_tables(void);

/* Is there a scene: has the program made or asked for a node? */
bool vs_nodes_are_there(const vs_bind *b);

typedef enum { VS_NODE_NAME, VS_NODE_PARENT, VS_NODE_CHILDREN } vs_node_part;

/* Reads a part of a node without a run of the program: *out becomes its name, a string or #f; its parent, a node or #f;
 * or the list of its children. False: v is no node, and *out is #f, or there was no memory for the list, and the
 * condition is set. */
bool vs_node_read(vs_scheme *vm, vs_value v, vs_node_part part, vs_value *out);

/* Works out what the scene shows; runs Scheme. *list becomes the objects, a Scheme list; *beside: they stand beside
 * what was drawn, else instead of it, since another node than the root has the focus. False: the condition is set. */
bool vs_nodes_shown(vs_bind *b, bool *beside, vs_value *list);

#endif
