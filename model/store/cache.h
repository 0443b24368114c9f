/* Owns the world cache: results that took work, found again by what decides them, from one drawing, output or
 * evaluation to the next.
 *
 * A key is a kind, a node (equal by value; NULL: none) and words: numbers that say whatever else decides the result.
 * Hashes only lead to candidates; an answer was compared in full. A result is a block of bytes that never changes, with
 * a serial number that no other result ever gets: so one key can name another result. Keys hold their nodes; what a
 * result and its key hold counts, and past the bound the least recently used goes. A turn is one evaluation or one
 * output. A result that was asked for in this turn is not dropped for the sake of a later one of the same turn: a model
 * larger than the bound would else drop everything before it is asked for again. Refused memory loses the result, no
 * more. Used by one thread, as the store. */
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
static inline uint64_t vs_cache_real(double d) { /* as a word of a key: equal bits are equal */
  uint64_t bits;
  memcpy(&bits, &d, sizeof bits);
  return bits;
}

typedef struct {
  size_t hits[VS_CACHED_KINDS], misses[VS_CACHED_KINDS];
  size_t entries, bytes, peak; /* now; now; the most so far */
  size_t evicted, refused;     /* dropped for room; not kept: too large, no room or no memory */
} vs_cache_stats;

/* The store is the one whose nodes are keys; it must outlive the cache, and finds it by vs_store_cache until
 * vs_cache_free. limit: bytes. NULL: out of memory. */
vs_cache *vs_cache_new(vs_store *s, size_t limit);
void vs_cache_free(vs_cache *c); /* nothing may be held */
vs_cache *vs_store_cache(const vs_store *s); /* NULL: there is none */

/* a new turn begins; keeps false: nothing new is kept in it, for nothing will be asked after it */
void vs_cache_turn(vs_cache *c, bool keeps);
bool vs_cache_keeps(const vs_cache *c);      /* is it worth making a key for something to keep? */
bool vs_cache_asks(const vs_cache *c);       /* is it worth making a key to ask with? */

/* The result, held until it is let go; NULL: not known. */
const vs_cached *vs_cache_find(vs_cache *c, const vs_cache_key *key);
/* Keeps the pieces, one after the other, as the result; held. NULL: not kept. The key was not found before. */
const vs_cached *vs_cache_keep(vs_cache *c, const vs_cache_key *key, const vs_cache_piece *pieces, size_t count);
void vs_cache_let_go(vs_cache *c, const vs_cached *held); /* NULL is fine */

/* Drops what is not held, oldest first, until that many bytes are given back or nothing is left. True: something
 * was. */
bool vs_cache_shrink(vs_cache *c, size_t bytes);
vs_cache_stats vs_cache_count(const vs_cache *c);

#endif
