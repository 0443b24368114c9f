/* Owns the world cache: results that took work, found again by the values that decide them, from one drawing, output or
 * evaluation to the next.
 *
 * A key is a kind, a node (equal by value; NULL: none) and words: numbers for all else that decides the result. Hashes
 * only find candidates; keys are compared in full. A result is a block of bytes that never changes, with a serial
 * number that no other result ever gets: so one key can name another result.
 *
 * Keys hold their nodes. The bytes of a result and its key count, and when they exceed the bound the least recently
 * used result is dropped. A turn is one evaluation or one output. A result used in this turn is not dropped for a later
 * one of the same turn: a model larger than the bound would else drop every result before its next use. When memory is
 * refused, only the result is lost. A single thread uses the cache, as it does the store. */
#ifndef VS_MODEL_STORE_CACHE_H
#define VS_MODEL_STORE_CACHE_H

#include <string.h>

#include "model/node.h"

typedef enum {
#define VS_CACHED(upper, lower, doc) VS_CACHED_##upper,
#include "model/store/cache.def"
  VS_CACHED_KINDS
} vs_cached_kind;

/* hash: of the words; 0: not known */
typedef struct { vs_cached_kind kind; vs_node *node; const uint64_t *words; size_t count; uint64_t hash; } vs_cache_key;
typedef struct { uint64_t serial; const void *data; size_t size; } vs_cached; /* data: aligned for anything */
typedef struct { const void *at; size_t size; } vs_cache_piece;
static inline uint64_t vs_cache_real(double d) { /* a number as a word of a key: equal bits are equal */
  uint64_t bits;
  memcpy(&bits, &d, sizeof bits);
  return bits;
}

typedef struct {
  size_t hits[VS_CACHED_KINDS], misses[VS_CACHED_KINDS];
  size_t entries, bytes, peak; /* entries and bytes now; the most bytes up to now */
  size_t evicted, refused;     /* dropped for room; not kept: too large, no room or memory is out */
} vs_cache_stats;

/* Makes a cache whose keys are nodes of the store. The store must outlive the cache, and vs_store_cache returns it
 * until vs_cache_free. limit: bytes. NULL: out of memory. */
vs_cache *vs_cache_new(vs_store *s, size_t limit);
void vs_cache_free(vs_cache *c); /* no caller may hold a result */
vs_cache *vs_store_cache(const vs_store *s); /* NULL: there is none */

/* Begins a new turn. keeps false: it keeps no new results, since nothing follows that could use them. */
void vs_cache_turn(vs_cache *c, bool keeps);
bool vs_cache_keeps(const vs_cache *c);      /* returns true if it is worth making a key to keep a result */
bool vs_cache_asks(const vs_cache *c);       /* returns true if it is worth making a key to look for a result */

/* Returns the result, held until vs_cache_let_go; NULL: not known. */
const vs_cached *vs_cache_find(vs_cache *c, const vs_cache_key *key);
/* Keeps the concatenated pieces as the result, and returns it, held. NULL: not kept. The caller has looked for the key,
 * and not found it. */
const vs_cached *vs_cache_keep(vs_cache *c, const vs_cache_key *key, const vs_cache_piece *pieces, size_t count);
void vs_cache_let_go(vs_cache *c, const vs_cached *held); /* NULL is fine */

/* Drops results that no caller holds, the oldest first, until that many bytes are free or none is left. Returns true if
 * it dropped one. */
bool vs_cache_shrink(vs_cache *c, size_t bytes);
vs_cache_stats vs_cache_count(const vs_cache *c);

#endif
