/* Owns the memory of a checked call: blocks, nodes and growing arrays, all freed when the call ends. */
#ifndef VS_BIND_CALL_SCRATCH_H
#define VS_BIND_CALL_SCRATCH_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Returns a block of these bytes, freed when the call ends; NULL with the error set when memory is out. */
void *vs_bind_scratch(vs_args *f, size_t bytes);
/* Takes over a reference to node and releases it when the call ends. Returns false with the memory error set if node is
 * NULL. */
bool vs_bind_keep(vs_args *f, vs_node *node);
void vs_bind_scratch_free(vs_args *f);

/* A growing array. The newest block grows in place; any other moves, and its old block stays until the call ends. */
typedef struct { void *at; size_t count, room, size; } vs_growing;
/* Returns the next element's place; NULL with the error set when memory is out. */
void *vs_bind_grow(vs_args *f, vs_growing *g);

#endif
