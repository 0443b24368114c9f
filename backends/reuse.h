/* Owns the keeping of text that is written again: runs of the drawing, found in the world cache (model/store/cache.h)
 * by all values that decide their bytes.
 *
 * The driver divides a drawing into runs of some hundred shapes (drive_run), and spells each as words, which form its
 * key. The words are the nodes' numbers, not their addresses. Therefore a program that runs again finds the text of its
 * last run, and the cache holds no node. The driver writes a text that it finds unchanged; it catches and keeps a text
 * that it must make.
 *
 * Numbers of templates and paints need care: one more at the front changes all others. A key has them in the order in
 * which the run names them, and kept text has slots into which the current numbers are put. When memory is refused,
 * only the text to be kept is lost. */
#ifndef VS_BACKENDS_REUSE_H
#define VS_BACKENDS_REUSE_H

#include "backends/writer.h"
#include "model/store/cache.h"

/* the origin of a line of the text, and of the lines up to the next */
typedef struct { uint32_t line; const vs_origin *origin; } vs_reuse_line;

typedef enum { VS_NUMBER_TEMPLATE, VS_NUMBER_PAINT, VS_NUMBER_KINDS } vs_number_kind;
typedef struct { uint32_t run, local; } vs_reuse_local;

typedef struct {
  vs_cache *cache;   /* NULL: no text is kept */
  vs_store *store;
  uint64_t *words;   /* the key of the last run that was looked for */
  size_t count, room;
  uint64_t hash;     /* of the nodes in it, never 0 */
  bool unfit;        /* it cannot be a key: too long, memory is out, or it contains a number of the running program */
  bool open;         /* the run is being written, to be kept */
  uint64_t triangles; /* of an open run, at its end: the number of triangles in it */
  uint64_t from;     /* of an open run: the number of bytes that the writer had before it */
  char *caught;      /* the part of the run that has left the writer's buffer */
  size_t caught_count, caught_room;
  /* The numbers that the run names, each once, in order of use; and the inverse: a number's index there, valid if `run`
   * is the current run. */
  uint32_t *numbers[VS_NUMBER_KINDS], run;
  size_t number_count[VS_NUMBER_KINDS], number_room[VS_NUMBER_KINDS];
  vs_reuse_local *locals[VS_NUMBER_KINDS];
  size_t local_room[VS_NUMBER_KINDS];
  uint64_t *slots;   /* numbers in its text: position << 32 | index in `numbers` << 8 | count of digits << 1 | kind */
  size_t slot_count, slot_room;
  const char **said; /* the warnings that it caused, by address */
  size_t said_count, said_room;
} vs_reuse;

/* Grows an array whose items have `size` bytes; when memory is refused, the run becomes unfit, nothing else. */
bool vs_reuse_more(vs_reuse *r, void *array, size_t *room, size_t need, size_t size);
bool vs_reuse_grow(vs_reuse *r, size_t need);
/* Puts the next word into the key, or the words of a payload except the numbers of its materials, which the caller
 * puts. */
static inline bool vs_reuse_room(vs_reuse *r, size_t need) {
  return r->room - r->count >= need || vs_reuse_grow(r, need);
}
static inline void vs_reuse_put(vs_reuse *r, uint64_t word) {
  if (vs_reuse_room(r, 1)) r->words[r->count++] = word;
}
void vs_reuse_put_reals(vs_reuse *r, const double *reals, size_t count);
void vs_reuse_put_number(vs_reuse *r, vs_number_kind kind, uint32_t number); /* puts the index of the number within the
                                                                              * run */
void vs_reuse_put_payload(vs_reuse *r, const vs_kind_info *info, const void *data);

/* The run with that key: its text, the numbers in it, its lines (counted from 0 on the first) and its warnings. The
 * cache holds it until vs_cache_let_go. */
typedef struct {
  const vs_cached *held;
  const char *text;
  const uint64_t *slots;
  const vs_reuse_line *lines;
  const char *const *said;
  size_t size, slot_count, line_count, said_count, triangles;
} vs_reused;
void vs_reuse_start(vs_reuse *r); /* begins an empty key */
void vs_reuse_mix(vs_reuse *r, uint64_t hash); /* The hash only narrows the search: equal hashes do not mean equal
                                                * keys. */
bool vs_reuse_find(vs_reuse *r, vs_reused *out);
bool vs_reuse_put_out(const vs_reuse *r, const vs_reused *found, vs_writer *w);

void vs_reuse_begin(vs_reuse *r, vs_writer *w); /* the text from now on belongs to the run */
/* Records a number that the caller writes next. */
void vs_reuse_numbered(vs_reuse *r, const vs_writer *w, vs_number_kind kind, uint32_t number);
void vs_reuse_warned(vs_reuse *r, const char *message);
void vs_reuse_end(vs_reuse *r, vs_writer *w, const vs_reuse_line *lines, size_t line_count);
void vs_reuse_free(vs_reuse *r);

#endif
