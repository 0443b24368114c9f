/* Owns text that is written again: runs of what is drawn, found in the world cache (model/store/cache.h) by all that
 * decides their bytes.
 *
 * The driver cuts a drawing into runs, some hundred shapes each (drive_run), and spells each out as words: the nodes'
 * numbers, not their addresses, so that a program that ran again finds what its last run wrote, and nothing holds a
 * node for it. A text that is found is written as it is; what is not is written, caught on its way, and kept. Numbers
 * of templates and paints are another matter: one more at the front makes all of them others. A key has them in the
 * order in which the run names them, and kept text has places where those that they have now are put in. Refused memory
 * loses what would be kept, no more. */
#ifndef VS_BACKENDS_REUSE_H
#define VS_BACKENDS_REUSE_H

#include "backends/writer.h"
#include "model/store/cache.h"

/* what stands on a line of the text, and on those up to the next */
typedef struct { uint32_t line; const vs_origin *origin; } vs_reuse_line;

typedef enum { VS_NUMBER_TEMPLATE, VS_NUMBER_PAINT, VS_NUMBER_KINDS } vs_number_kind;
typedef struct { uint32_t run, local; } vs_reuse_local;

typedef struct {
  vs_cache *cache;   /* NULL: nothing is looked for */
  vs_store *store;
  uint64_t *words;   /* the key of the run looked for last */
  size_t count, room;
  uint64_t hash;     /* of the nodes in it, never 0 */
  bool unfit;        /* it cannot be a key: too long, no memory, or something of the program's stands in it */
  bool open;         /* the run is being written, to be kept */
  uint64_t triangles; /* then, at its end: those in it */
  uint64_t from;     /* then: bytes of the writer before it */
  char *caught;      /* what has left the writer's buffer of it */
  size_t caught_count, caught_room;
  /* The numbers that the run names: each once, in that order, and back: a number's place there, if `run` is this
   * run. */
  uint32_t *numbers[VS_NUMBER_KINDS], run;
  size_t number_count[VS_NUMBER_KINDS], number_room[VS_NUMBER_KINDS];
  vs_reuse_local *locals[VS_NUMBER_KINDS];
  size_t local_room[VS_NUMBER_KINDS];
  uint64_t *slots;   /* numbers in its text: where << 32 | which of them << 8 | how many digits << 1 | kind */
  size_t slot_count, slot_room;
  const char **said; /* warnings that it called for, by address */
  size_t said_count, said_room;
} vs_reuse;

/* Room in an array of `size` bytes an item; refused memory makes the run unfit, no more. */
bool vs_reuse_more(vs_reuse *r, void *array, size_t *room, size_t need, size_t size);
bool vs_reuse_grow(vs_reuse *r, size_t need);
/* The next word of the key, or the words of a payload: all but the numbers of its materials, which are the caller's to
 * put. */
static inline bool vs_reuse_room(vs_reuse *r, size_t need) {
  return r->room - r->count >= need || vs_reuse_grow(r, need);
}
static inline void vs_reuse_put(vs_reuse *r, uint64_t word) {
  if (vs_reuse_room(r, 1)) r->words[r->count++] = word;
}
void vs_reuse_put_reals(vs_reuse *r, const double *reals, size_t count);
void vs_reuse_put_number(vs_reuse *r, vs_number_kind kind, uint32_t number); /* which of the run's it is */
void vs_reuse_put_payload(vs_reuse *r, const vs_kind_info *info, const void *data);

/* The run with that key: its text, the numbers in it, the lines in it (counted from 0 on its first) and what it warns
 * of. Held until it is let go. */
typedef struct {
  const vs_cached *held;
  const char *text;
  const uint64_t *slots;
  const vs_reuse_line *lines;
  const char *const *said;
  size_t size, slot_count, line_count, said_count, triangles;
} vs_reused;
void vs_reuse_start(vs_reuse *r); /* a key, from nothing */
void vs_reuse_mix(vs_reuse *r, uint64_t hash); /* what else the key has is like this: an order of candidates, no more */
bool vs_reuse_find(vs_reuse *r, vs_reused *out);
bool vs_reuse_put_out(const vs_reuse *r, const vs_reused *found, vs_writer *w);

void vs_reuse_begin(vs_reuse *r, vs_writer *w); /* what is written from now on is the run's */
/* it is about to be written */
void vs_reuse_numbered(vs_reuse *r, const vs_writer *w, vs_number_kind kind, uint32_t number);
void vs_reuse_warned(vs_reuse *r, const char *message);
void vs_reuse_end(vs_reuse *r, vs_writer *w, const vs_reuse_line *lines, size_t line_count);
void vs_reuse_free(vs_reuse *r);

#endif
