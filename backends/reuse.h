/* Declares the cache of written text for later exports. The text is stored in the cache of model/store/cache.h. The key
 * of a text contains all values that determine its bytes.
 *
 * The driver divides a drawing into runs: sequences of a few hundred shapes (text_runs.h). It describes each run by a
 * list of words, the key. The words contain the values of the nodes instead of their addresses. Therefore a program
 * that is evaluated again finds the text of the evaluation before, and the cache refers to no node. If the driver finds
 * the text of a run, it writes that text. Otherwise it produces the text, and stores a copy.
 *
 * The numbers of templates and materials may change: a new template or material in the drawing changes all later
 * numbers. A key therefore contains these numbers by their order of use in the run. Cached text contains slots into
 * which the current numbers are written. If memory for a copy is refused, only the copy is lost. */
#ifndef VS_BACKENDS_REUSE_H
#define VS_BACKENDS_REUSE_H

#include "backends/writer.h"
#include "model/store/cache.h"

/* The origin (place in the program) of lines of text, and the first line that has it. The following lines have the same
 * origin, up to the line of the next entry. */
typedef struct { uint32_t line; const vs_origin *origin; } vs_reuse_line;

typedef enum { VS_NUMBER_TEMPLATE, VS_NUMBER_PAINT, VS_NUMBER_KINDS } vs_number_kind;
typedef struct { uint32_t run, local; } vs_reuse_local;

typedef struct {
  vs_cache *cache;   /* cache of text; NULL: no text is cached */
  vs_store *store;
  uint64_t *words;   /* words of the key of the last run (sequence of shapes) for which the cache was searched */
  size_t count, room;
  uint64_t hash;     /* hash of the nodes in the key, never 0 */
  bool unfit;        /* whether the words cannot be a key: they are too many, memory is out, or they contain a number
                      * that is valid only during this evaluation */
  bool open;         /* whether the text of the run that is being written will be cached */
  uint64_t triangles; /* number of triangles in the run (sequence of shapes) that is being written, set at its end */
  uint64_t from;     /* number of bytes that the writer had written before the current run */
  char *caught;      /* part of the text of the current run (sequence of shapes) that has already left the writer's
                      * buffer */
  size_t caught_count, caught_room;
  /* numbers: the numbers of templates and materials in the run (sequence of shapes), without duplicates, in order of
   * use. The second array maps a number to its index in `numbers`; an entry is valid if its member `run` is the current
   * run. */
  uint32_t *numbers[VS_NUMBER_KINDS], run;
  size_t number_count[VS_NUMBER_KINDS], number_room[VS_NUMBER_KINDS];
  vs_reuse_local *locals[VS_NUMBER_KINDS];
  size_t local_room[VS_NUMBER_KINDS];
  uint64_t *slots;   /* slots: positions of numbers in the run's text, packed: position << 32 | index in `numbers` << 8
                      * | count of digits << 1 | kind */
  size_t slot_count, slot_room;
  const char **said; /* addresses of the warnings that writing the run (sequence of shapes) has caused */
  size_t said_count, said_room;
} vs_reuse;

/* Grows an array whose items have `size` bytes to at least `need` items. If memory is refused, the current text is not
 * cached, and nothing else changes. */
bool vs_reuse_more(vs_reuse *r, void *array, size_t *room, size_t need, size_t size);
bool vs_reuse_grow(vs_reuse *r, size_t need);
/* Makes room for `need` more words in the key. Returns false if the text cannot be cached. */
static inline bool vs_reuse_room(vs_reuse *r, size_t need) {
  return r->room - r->count >= need || vs_reuse_grow(r, need);
}
static inline void vs_reuse_put(vs_reuse *r, uint64_t word) {
  if (vs_reuse_room(r, 1)) r->words[r->count++] = word;
}
void vs_reuse_put_reals(vs_reuse *r, const double *reals, size_t count);
void vs_reuse_put_number(vs_reuse *r, vs_number_kind kind, uint32_t number); /* puts a number of a template or
                                                                              * material into the key, as its index
                                                                              * in `numbers` */
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
void vs_reuse_start(vs_reuse *r); /* begins an empty key for another run */
void vs_reuse_mix(vs_reuse *r, uint64_t hash); /* Combines a node's hash with the hash of the key. Equal hashes do not
                                                * imply equal keys: the hash only accelerates the search. */
bool vs_reuse_find(vs_reuse *r, vs_reused *out);
bool vs_reuse_put_out(const vs_reuse *r, const vs_reused *found, vs_writer *w);

void vs_reuse_begin(vs_reuse *r, vs_writer *w); /* begins to record a text for the cache: all text that w writes from
                                                 * now on */
/* Records that the caller will write this number next, at the current position of the text. */
void vs_reuse_numbered(vs_reuse *r, const vs_writer *w, vs_number_kind kind, uint32_t number);
void vs_reuse_warned(vs_reuse *r, const char *message);
void vs_reuse_end(vs_reuse *r, vs_writer *w, const vs_reuse_line *lines, size_t line_count);
void vs_reuse_free(vs_reuse *r);

#endif
