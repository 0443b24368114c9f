/* Declares a map from node addresses to 64-bit words. Passes and measures store a result for each shared node in it. */
#ifndef VS_MODEL_STORE_NODEMAP_H
#define VS_MODEL_STORE_NODEMAP_H

#include "model/node.h"

typedef struct { const void *key; uint64_t value; } vs_nodemap_slot;
/* initial value of an empty map: { .store = s } */
typedef struct { vs_store *store; vs_nodemap_slot *slots; size_t count, room; } vs_nodemap;

void vs_nodemap_free(vs_nodemap *m); /* Frees the map's memory; the map is then empty and may be used again. */
uint64_t *vs_nodemap_get(const vs_nodemap *m, const void *key); /* Returns the address of the value for the key, or NULL
                                                                 * if the map lacks the key. The address is valid until
                                                                 * the next key is added. */
/* Adds the key with the value 0 if the map lacks it. Returns the address of the value, or NULL when memory is out. Sets
 * *found to true if the map already had the key; found may be NULL. */
uint64_t *vs_nodemap_put(vs_nodemap *m, const void *key, bool *found);
/* Adds a key as vs_nodemap_put does, but retains the node. Without a reference, a temporary node could be freed and
 * another node get its address. All keys of such a map are added by this function, and vs_nodemap_free_held frees the
 * map. */
uint64_t *vs_nodemap_put_held(vs_nodemap *m, vs_node *key, bool *found);
void vs_nodemap_free_held(vs_nodemap *m);

#endif
