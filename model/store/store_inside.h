/* Owns the inside of the store, for model/ alone: the counting of bytes, the hash tables of interned values, and the
 * arena. */
#ifndef VS_MODEL_STORE_STORE_INSIDE_H
#define VS_MODEL_STORE_STORE_INSIDE_H

#include "model/store/store.h"
#include "model/store/hashes.h"

typedef struct { void **slots; size_t count, room; } vs_intern; /* open addressing, room a power of two */
typedef struct vs_block vs_block;
typedef struct vs_slab vs_slab;
typedef struct vs_piece vs_piece;
enum { VS_PIECE_MOST = 256 }; /* bytes; larger ones are separate allocations */

struct vs_store {
  size_t refs; /* by its owners and by every node */
  size_t bytes;
  vs_alloc_fn *alloc;
  void *context;
  size_t fail_at; /* counts down; the allocation that reaches 0 fails, as do all after it until it is set again */
  bool failing;
  vs_intern texts, origins, materials;
  const vs_picture *pictures; /* few: a list */
  void *kept;           /* data that geometry/ keeps as long as the store lives (fonts); let_go frees it first */
  void (*let_go)(vs_store *s, void *kept);
  bool (*going)(void *context); /* the callback that may stop long work; NULL: none */
  void *going_context;
  uint32_t work;        /* steps since its last call */
  struct vs_tally *tally; /* the owner's; NULL: none (tally.h) */
  vs_cache *cache;      /* the owner's, which frees it before the store; NULL: none (cache.h) */
  void (*ticket_gone)(void *context, uint32_t id);
  void *ticket_context;
  vs_block *blocks; /* the memory of interned values, freed with the store */
  vs_slab *slabs;   /* piece.c: pieces come from the first */
  size_t slab_bytes, piece_count;
  vs_piece *given_back[VS_PIECE_MOST / 8 + 1]; /* by size in words */
};

#endif
