/* Declares a map from node addresses to 64-bit words. Passes and measures store a result for each shared node in it. */
#ifndef VS_MODEL_STORE_NODEMAP_H
#define VS_MODEL_STORE_NODEMAP_H

#include "model/node.h"

typedef struct { const void *key; uint64_t value; } vs_nodemap_slot;
/* initial value of an empty map: { .store = s } */
typedef struct { vs_store *store; vs_nodemap_slot *slots; size_t count, room; } vs_nodemap;

void vs_nodemap_free(vs_nodemap *m); /* Frees the map's memory; the map is then empty and may be used again. */
uint64_t *vs_nodemap_get(const vs_nodemap *m, const void *key); /* Returns the address of the value for the key, or NULL
                                                                 * if the map does not contain the key. The address is
                                                                 * valid until the next key is added. */
/* Adds the key with the value 0 if the map does not contain it. Returns the address of its value, or NULL when memory
 * is out. *found: true if the map contained the key before; found may be NULL. */
uint64_t *vs_nodemap_put(vs_nodemap *m, const void *key, bool *found);
/* Adds a key as vs_nodemap_put does, and a reference to its node: a node that was freed could otherwise give its
 * address to another. All keys of such a map are added by this function, and vs_nodemap_free_held frees the map. */
uint64_t *vs_nodemap_put_held(vs_nodemap *m, vs_node *key, bool *found);
void vs_nodemap_free_held(vs_nodemap *m);

#endif
