/* Declares the cache of written text for later exports. The text is stored in the cache of model/store/cache.h. The key
 * of a text contains all values that determine its bytes.
 *
 * The driver divides a drawing into runs: sequences of a few hundred shapes (text_runs.h). It describes each run by a
 * list of words, the key. The words contain the values of the nodes instead of their addresses. Therefore a program
 * that is evaluated again finds the text of the evaluation before, and the cache refers to no node. If the driver finds
 * the text of a run, it writes that text. Otherwise it makes the text, and stores a copy.
 *
 * Numbers of templates and materials need care: a new number at the front changes all later numbers. A key contains
 * these numbers as positions in the order in which the run uses them. Cached text contains slots into which the current
 * numbers are put. If memory is refused, only the copy of the text is lost. */
#ifndef VS_BACKENDS_REUSE_H
#define VS_BACKENDS_REUSE_H

#include "backends/writer.h"
#include "model/store/cache.h"

/* An origin, and the first line of the text that has it. The origin applies to all lines before the next such entry. */
typedef struct { uint32_t line; const vs_origin *origin; } vs_reuse_line;

typedef enum { VS_NUMBER_TEMPLATE, VS_NUMBER_PAINT, VS_NUMBER_KINDS } vs_number_kind;
typedef struct { uint32_t run, local; } vs_reuse_local;

typedef struct {
  vs_cache *cache;   /* cache of text; NULL: no text is cached */
  vs_store *store;
  uint64_t *words;   /* words of the key of the run (sequence of shapes) that was last searched for */
  size_t count, room;
  uint64_t hash;     /* hash of the nodes in the key, never 0 */
  bool unfit;        /* true if the words cannot be a key: they are too many, memory is out, or they contain a number
                      * that is valid only during this evaluation */
  bool open;         /* true while a run (sequence of shapes) is written whose text will be cached */
  uint64_t triangles; /* number of triangles in the run (sequence of shapes) that is being written, set at its end */
  uint64_t from;     /* number of bytes that the writer had written before the current run */
  char *caught;      /* part of the current run's text that has already left the writer's buffer */
  size_t caught_count, caught_room;
  /* numbers: the numbers of templates and materials in the run (sequence of shapes), each once, in order of use. The
   * second array is its inverse: it maps a number to its index, valid if `run` is the current run. */
  uint32_t *numbers[VS_NUMBER_KINDS], run;
  size_t number_count[VS_NUMBER_KINDS], number_room[VS_NUMBER_KINDS];
  vs_reuse_local *locals[VS_NUMBER_KINDS];
  size_t local_room[VS_NUMBER_KINDS];
  uint64_t *slots;   /* positions of numbers in the run's text, packed: position << 32 | index in `numbers` << 8 | count
                      * of digits << 1 | kind */
  size_t slot_count, slot_room;
  const char **said; /* addresses of the warnings that writing the run has caused */
  size_t said_count, said_room;
} vs_reuse;

/* Grows an array whose items have `size` bytes. If memory is refused, the current text is not cached, and nothing else
 * changes. */
bool vs_reuse_more(vs_reuse *r, void *array, size_t *room, size_t need, size_t size);
bool vs_reuse_grow(vs_reuse *r, size_t need);
/* The functions of this group put words into the key: the next word, or the words of a node's values. The caller puts
 * the numbers of the node's materials. */
static inline bool vs_reuse_room(vs_reuse *r, size_t need) {
  return r->room - r->count >= need || vs_reuse_grow(r, need);
}
static inline void vs_reuse_put(vs_reuse *r, uint64_t word) {
  if (vs_reuse_room(r, 1)) r->words[r->count++] = word;
}
void vs_reuse_put_reals(vs_reuse *r, const double *reals, size_t count);
void vs_reuse_put_number(vs_reuse *r, vs_number_kind kind, uint32_t number); /* puts the number's index, by order of use
                                                                              * within the run, into the key */
void vs_reuse_put_payload(vs_reuse *r, const vs_kind_info *info, const void *data);

/* A text found in the cache: its bytes, the numbers in it, the origins of its lines (the first is line 0) and its
 * warnings. It is valid until vs_cache_let_go. */
typedef struct {
  const vs_cached *held;
  const char *text;
  const uint64_t *slots;
  const vs_reuse_line *lines;
  const char *const *said;
  size_t size, slot_count, line_count, said_count, triangles;
} vs_reused;
void vs_reuse_start(vs_reuse *r); /* begins an empty key */
void vs_reuse_mix(vs_reuse *r, uint64_t hash); /* Mixes a node's hash into the hash of the key. Equal hashes do not
                                                * imply equal keys: the hash only narrows the search. */
bool vs_reuse_find(vs_reuse *r, vs_reused *out);
bool vs_reuse_put_out(const vs_reuse *r, const vs_reused *found, vs_writer *w);

void vs_reuse_begin(vs_reuse *r, vs_writer *w); /* begins a text to cache, which is all text that w writes from now
                                                 * on */
/* Records that the caller will write this number next, at the current position of the text. */
void vs_reuse_numbered(vs_reuse *r, const vs_writer *w, vs_number_kind kind, uint32_t number);
void vs_reuse_warned(vs_reuse *r, const char *message);
void vs_reuse_end(vs_reuse *r, vs_writer *w, const vs_reuse_line *lines, size_t line_count);
void vs_reuse_free(vs_reuse *r);

#endif
