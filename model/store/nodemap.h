/* Owns a map from nodes (by address) to 64-bit words: what passes and measures remember of each shared node. */
#ifndef VS_MODEL_STORE_NODEMAP_H
#define VS_MODEL_STORE_NODEMAP_H

#include "model/node.h"

typedef struct { const void *key; uint64_t value; } vs_nodemap_slot;
/* { .store = s } is an empty map */
typedef struct { vs_store *store; vs_nodemap_slot *slots; size_t count, room; } vs_nodemap;

void vs_nodemap_free(vs_nodemap *m); /* leaves it empty and usable */
uint64_t *vs_nodemap_get(const vs_nodemap *m, const void *key); /* NULL: not there; valid until the next put */
/* The value's place, 0 at first; *found (may be NULL) says whether it was there. NULL: out of memory. */
uint64_t *vs_nodemap_put(vs_nodemap *m, const void *key, bool *found);
/* As vs_nodemap_put; the map holds a reference to the node: one that was made for a moment could else be freed, and
 * another take its address. Such a map is freed by vs_nodemap_free_held, and holds nothing else. */
uint64_t *vs_nodemap_put_held(vs_nodemap *m, vs_node *key, bool *found);
void vs_nodemap_free_held(vs_nodemap *m);

#endif
