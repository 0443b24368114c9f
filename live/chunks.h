/* Declares the division of a scene into pieces. The content decides where a piece ends. After a change most pieces are
 * therefore unchanged, even at other positions, and need not be sent again. */
#ifndef VS_LIVE_CHUNKS_H
#define VS_LIVE_CHUNKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct { uint64_t hash; size_t from; uint32_t length; } live_chunk;
typedef struct { live_chunk *at; size_t count; } live_chunks;

/* Divides `count` bytes into pieces of 2 to 64 KB, 8 KB on average. Returns false if memory is out. */
bool live_chunks_cut(const unsigned char *bytes, size_t count, live_chunks *out);
/* Returns true if c contains a piece with this hash and length; c must come from live_chunks_sorted. */
bool live_chunks_have(const live_chunks *c, uint64_t hash, uint32_t length);
bool live_chunks_sorted(const live_chunks *c, live_chunks *out); /* Sets *out to a copy of c's pieces, sorted by hash.
                                                                  * Returns false if memory is out. */
void live_chunks_free(live_chunks *c);

#endif
