/* Declares the memory of a checked call: blocks, nodes and growing arrays that are freed when the call ends. */
#ifndef VS_BIND_CALL_SCRATCH_H
#define VS_BIND_CALL_SCRATCH_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Returns a block of `bytes` bytes, which is freed when the call ends. When memory is out, sets the error and returns
 * NULL. */
void *vs_bind_scratch(vs_args *f, size_t bytes);
/* Takes over a reference to the node, and releases it when the call ends. If node is NULL, memory was out: sets the
 * error and returns false. */
bool vs_bind_keep(vs_args *f, vs_node *node);
void vs_bind_scratch_free(vs_args *f);

/* A growing array. If it is the call's latest block of memory, it grows in place. Otherwise it is copied to a new
 * block, and the old block remains until the call ends. */
typedef struct { void *at; size_t count, room, size; } vs_growing;
/* Returns the address of a new element at the array's end. When memory is out, sets the error and returns NULL. */
void *vs_bind_grow(vs_args *f, vs_growing *g);

#endif
