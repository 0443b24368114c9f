/* Implements a hash map from nodes to 64-bit words: open addressing, linear probing, at most two thirds full. */
#include "model/store/nodemap.h"

#include <string.h>

#include "model/store/store_inside.h"

/* Returns the slot that contains the key; or if there is none, the free slot in which to store it. m->room is a power
 * of two. */
static size_t nodemap_place(const vs_nodemap *m, const void *key) {
  size_t at = (size_t)vs_hash_mix(5, (uintptr_t)key) & (m->room - 1);
  VS_ASSERT(m->room > 0 && (m->room & (m->room - 1)) == 0);
  while (m->slots[at].key && m->slots[at].key != key) at = (at + 1) & (m->room - 1);
  return at;
}

void vs_nodemap_free(vs_nodemap *m) {
  if (m->slots) vs_store_realloc(m->store, m->slots, m->room * sizeof *m->slots, 0);
  *m = (vs_nodemap){ .store = m->store };
}

uint64_t *vs_nodemap_get(const vs_nodemap *m, const void *key) {
  if (!m->room) return NULL;
  size_t at = nodemap_place(m, key);
  return m->slots[at].key ? &m->slots[at].value : NULL;
}

uint64_t *vs_nodemap_put(vs_nodemap *m, const void *key, bool *found) {
  if (m->count * 3 >= m->room * 2) {
    vs_nodemap grown = { m->store, NULL, m->count, m->room ? m->room * 2 : 32 };
    grown.slots = vs_store_realloc(m->store, NULL, 0, grown.room * sizeof *grown.slots);
    if (!grown.slots) return NULL;
    memset(grown.slots, 0, grown.room * sizeof *grown.slots);
    for (size_t i = 0; i < m->room; i++)
      if (m->slots[i].key) grown.slots[nodemap_place(&grown, m->slots[i].key)] = m->slots[i];
    vs_store_realloc(m->store, m->slots, m->room * sizeof *m->slots, 0);
    *m = grown;
  }
  size_t at = nodemap_place(m, key);
  if (found) *found = m->slots[at].key != NULL;
  if (!m->slots[at].key) {
    m->slots[at] = (vs_nodemap_slot){ key, 0 };
    m->count++;
  }
  return &m->slots[at].value;
}

uint64_t *vs_nodemap_put_held(vs_nodemap *m, vs_node *key, bool *found) {
  bool there = false;
  uint64_t *value = vs_nodemap_put(m, key, &there);
  if (value && !there) vs_node_retain(key);
  if (found) *found = there;
  return value;
}

void vs_nodemap_free_held(vs_nodemap *m) {
  for (size_t i = 0; i < m->room && !vs_store_is_abandoned(m->store); i++)
    if (m->slots[i].key) vs_node_release((vs_node *)(uintptr_t)m->slots[i].key);
  vs_nodemap_free(m);
}
