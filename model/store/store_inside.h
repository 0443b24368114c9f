/* Declares the members of the store for the files of model/: the count of bytes, the hash tables of interned values,
 * and the blocks and slabs of memory. */
#ifndef VS_MODEL_STORE_STORE_INSIDE_H
#define VS_MODEL_STORE_STORE_INSIDE_H

#include "model/store/store.h"
#include "model/store/hashes.h"

typedef struct { void **slots; size_t count, room; } vs_intern; /* A hash table of interned values, with open
                                                                 * addressing. slots: addresses of the values; count:
                                                                 * number of values; room: number of slots, a power of
                                                                 * two. */
typedef struct vs_block vs_block;
typedef struct vs_slab vs_slab;
typedef struct vs_piece vs_piece;
enum { VS_PIECE_MOST = 256 }; /* greatest size of a piece (a small object cut from a slab) in bytes; larger objects are
                               * separate allocations */

struct vs_store {
  size_t refs; /* number of references to the store, by its owners and by its nodes */
  size_t bytes;
  vs_alloc_fn *alloc;
  void *context;
  size_t fail_at; /* for tests: how many allocations until the first that fails, which is included; 0 if none is to
                   * fail, or after the failure */
  bool failing;
  bool abandoned; /* true: the process is about to end, and frees no node (vs_store_abandon) */
  vs_intern texts, origins, materials;
  const vs_picture *pictures; /* list of the store's pictures, which are few */
  void *kept;           /* data that geometry/ keeps until the store is freed (fonts); let_go frees it */
  void (*let_go)(vs_store *s, void *kept);
  struct vs_job *job;   /* job in progress (job.h), or NULL; the caller owns it */
  uint32_t work;        /* work since the last call of vs_job_going, in the unit of vs_store_going (about a
                         * nanosecond) */
  vs_cache *cache;      /* world cache (cache.h), or NULL; the caller owns it and frees it before the store */
  void (*ticket_gone)(void *context, uint32_t id);
  void *ticket_context;
  vs_block *blocks; /* memory of interned values, freed with the store */
  vs_slab *slabs;   /* slabs: blocks of memory from which pieces (small objects) are cut (piece.c); new pieces come from
                     * the first slab */
  size_t slab_bytes, piece_count;
  vs_piece *given_back[VS_PIECE_MOST / 8 + 1]; /* given_back[i]: list of freed pieces (small objects) with a size of i
                                                * words */
};

#endif
