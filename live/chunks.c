/* Implements content-defined chunking: the division of bytes into pieces whose ends depend on the bytes near them. See
 * chunks.h.
 *
 * The gear hash (Xia et al., FastCDC, 2016) depends on the last 64 bytes: each byte doubles the sum and adds the byte's
 * random number. A piece ends where 13 high bits of the sum are zero. The hash of a piece has 64 bits: FNV-1a over
 * eight bytes at a time, with a final mix. A window treats pieces of equal hash and length as equal. */
#include "live/chunks.h"

#include <stdlib.h>
#include <string.h>

enum { LEAST = 2048, MOST = 65536 };

/* The SplitMix64 function. It computes the random number of a byte, so that the source needs no table of random
 * numbers. */
static uint64_t chunk_mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

static uint64_t chunk_hash(const unsigned char *at, size_t count) {
  uint64_t h = 0xcbf29ce484222325u ^ count;
  for (; count >= 8; at += 8, count -= 8) {
    uint64_t word;
    memcpy(&word, at, 8);
    h = (h ^ chunk_mix(word)) * 0x100000001b3u;
  }
  for (; count > 0; at++, count--) h = (h ^ *at) * 0x100000001b3u;
  return chunk_mix(h);
}

bool live_chunks_cut(const unsigned char *bytes, size_t count, live_chunks *out) {
  uint64_t gear[256];
  size_t room = count / LEAST + 2;
  *out = (live_chunks){ malloc(room * sizeof *out->at), 0 };
  if (out->at == NULL) return false;
  for (unsigned i = 0; i < 256; i++) gear[i] = chunk_mix(i);
  for (size_t from = 0; from < count;) {
    size_t left = count - from, end = left < LEAST ? left : LEAST, most = left < MOST ? left : MOST;
    for (uint64_t sum = 0; end < most; end++) {
      sum = (sum << 1) + gear[bytes[from + end]];
      if (sum >> 51 == 0) break;
    }
    out->at[out->count++] = (live_chunk){ chunk_hash(bytes + from, end), from, (uint32_t)end };
    from += end;
  }
  return true;
}

static int chunk_order(const void *a, const void *b) {
  const live_chunk *x = a, *y = b;
  return x->hash < y->hash ? -1 : x->hash > y->hash;
}

bool live_chunks_sorted(const live_chunks *c, live_chunks *out) {
  *out = (live_chunks){ malloc((c->count + 1) * sizeof *out->at), c->count };
  if (out->at == NULL) return false;
  memcpy(out->at, c->at, c->count * sizeof *out->at);
  qsort(out->at, out->count, sizeof *out->at, chunk_order);
  return true;
}

bool live_chunks_have(const live_chunks *c, uint64_t hash, uint32_t length) {
  live_chunk wanted = { hash, 0, length };
  const live_chunk *found = c->count > 0 ? bsearch(&wanted, c->at, c->count, sizeof *c->at, chunk_order) : NULL;
  return found != NULL && found->length == length;
}

void live_chunks_free(live_chunks *c) {
  free(c->at);
  *c = (live_chunks){ NULL, 0 };
}
