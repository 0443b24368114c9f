/* Owns a map from nodes (by address) to 64-bit words, in which passes and measures keep a result for each shared
 * node. */
#ifndef VS_MODEL_STORE_NODEMAP_H
#define VS_MODEL_STORE_NODEMAP_H

#include "model/node.h"

typedef struct { const void *key; uint64_t value; } vs_nodemap_slot;
/* { .store = s } is an empty map */
typedef struct { vs_store *store; vs_nodemap_slot *slots; size_t count, room; } vs_nodemap;

void vs_nodemap_free(vs_nodemap *m); /* leaves it empty and usable */
uint64_t *vs_nodemap_get(const vs_nodemap *m, const void *key); /* NULL: the map lacks the key; the address is valid
                                                                 * until the next put */
/* Returns the address of the value, which is 0 at first; *found (found may be NULL): the map had the key. NULL: out of
 * memory. */
uint64_t *vs_nodemap_put(vs_nodemap *m, const void *key, bool *found);
/* As vs_nodemap_put, for a map that retains its nodes: a temporary node could else be freed, and another take its
 * address. Such a map is freed by vs_nodemap_free_held, and all its keys are put by this function. */
uint64_t *vs_nodemap_put_held(vs_nodemap *m, vs_node *key, bool *found);
void vs_nodemap_free_held(vs_nodemap *m);

#endif
