/* Declares the world cache. It keeps results of long computations from one drawing, output or evaluation to the next.
 *
 * A key is a kind of result, a node (compared by value; may be NULL) and words: all other numbers on which the result
 * depends. Hashes only find candidates; keys are compared in full. A result is a block of bytes that never changes,
 * with a unique serial number. The key of another result may contain this number.
 *
 * Keys retain their nodes. Results and keys count towards a limit in bytes. If the limit is exceeded, the least
 * recently used result is dropped. A turn is one evaluation or one output. A result that was used in this turn is not
 * dropped to make room for a later result of the same turn. Otherwise a model larger than the limit would lose every
 * result before its next use. If memory is out, a result is simply not kept. Only one thread uses the cache and its
 * store. */
#ifndef VS_MODEL_STORE_CACHE_H
#define VS_MODEL_STORE_CACHE_H

#include <string.h>

#include "model/node.h"

typedef enum {
#define VS_CACHED(upper, lower, doc) VS_CACHED_##upper,
#include "model/store/cache.def"
  VS_CACHED_KINDS
} vs_cached_kind;

/* A key of the cache. kind, node, words: everything on which the result depends; count: number of words; hash: hash of
 * the words, or 0 if it is not computed yet */
typedef struct { vs_cached_kind kind; vs_node *node; const uint64_t *words; size_t count; uint64_t hash; } vs_cache_key;
typedef struct { uint64_t serial; const void *data; size_t size; } vs_cached; /* A result in the cache. serial: unique
                                                                               * number; data: its bytes, aligned for
                                                                               * any type; size: number of bytes */
typedef struct { const void *at; size_t size; } vs_cache_piece;
static inline uint64_t vs_cache_real(double d) { /* Returns the bits of the real number d as a word of a key. */
  uint64_t bits;
  memcpy(&bits, &d, sizeof bits);
  return bits;
}

typedef struct {
  size_t hits[VS_CACHED_KINDS], misses[VS_CACHED_KINDS];
  size_t entries, bytes, peak; /* entries: number of results in the cache; bytes: number of bytes that they use; peak:
                                * greatest number of bytes so far */
  size_t evicted, refused;     /* evicted: number of results that were dropped to make room for others; refused: number
                                * of results that were not kept because they were too large or memory was out */
} vs_cache_stats;

/* Creates a cache of at most `limit` bytes; nodes in its keys belong to store s. vs_store_cache(s) returns the cache
 * until vs_cache_free is called. The store must exist longer than the cache. Returns NULL when memory is out. */
vs_cache *vs_cache_new(vs_store *s, size_t limit);
void vs_cache_free(vs_cache *c); /* Frees the cache. No caller may hold a result. */
vs_cache *vs_store_cache(const vs_store *s); /* Returns the cache of the store, or NULL. */

/* Begins a new turn, one evaluation or one output. If keeps is false, the cache keeps no new results in this turn,
 * because no later turn will use them. */
void vs_cache_turn(vs_cache *c, bool keeps);
bool vs_cache_keeps(const vs_cache *c);      /* Returns true if the cache keeps new results in this turn; otherwise
                                              * their keys need not be computed. */
bool vs_cache_asks(const vs_cache *c);       /* Returns true if the cache may contain results; otherwise keys for a
                                              * search need not be computed. */

/* Returns the result for the key, or NULL if the cache does not contain it. The caller holds the result, which stays
 * valid until vs_cache_let_go. */
const vs_cached *vs_cache_find(vs_cache *c, const vs_cache_key *key);
/* Keeps a result for the key: the given pieces, one after another. Returns the result, which the caller holds, or NULL
 * if it was not kept. The caller has searched for the key before, without success. */
const vs_cached *vs_cache_keep(vs_cache *c, const vs_cache_key *key, const vs_cache_piece *pieces, size_t count);
void vs_cache_let_go(vs_cache *c, const vs_cached *held); /* Ends the caller's hold on a result, which the cache may
                                                           * then drop. held may be NULL. */

/* Drops results that no caller holds, the least recently used first, until `bytes` bytes are free or none is left.
 * Returns true if it has dropped any. */
bool vs_cache_shrink(vs_cache *c, size_t bytes);
vs_cache_stats vs_cache_count(const vs_cache *c);

#endif
