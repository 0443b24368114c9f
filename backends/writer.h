/* Owns text on its way out: a buffered writer over any sink, numbers in their one spelling (number_spelling.c),
 * indentation, line counting.
 *
 * A writer remembers its first failure; every call after that does nothing and returns false, so an emitter may print
 * freely and look once. Numbers are the shortest text of at most 12 significant digits, a point as decimal sign
 * whatever the locale, never -0. */
#ifndef VS_BACKENDS_WRITER_H
#define VS_BACKENDS_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "model/characters.h"
#include "model/vec.h"

typedef bool vs_sink_fn(void *context, const void *bytes, size_t count); /* false: failed, and the sink knows why */

enum { VS_WRITER_ROOM = 1 << 16, VS_NUMBER_ROOM = 32 };

typedef struct {
  vs_sink_fn *sink;
  void *context;
  size_t used;
  uint64_t bytes;  /* handed over or waiting: the size so far */
  uint64_t limit;  /* no more bytes than this; 0: any number */
  size_t counted;  /* of the buffer: newlines up to there are in `line` */
  uint32_t line;   /* as far as counted: vs_writer_line */
  bool failed, full; /* full: stopped by the limit */
  bool keeps_lines;  /* somebody will ask vs_writer_line */
  bool (*going)(void *context); /* asked each time the buffer is full; false: fails, and who was asked knows why. NULL:
                                 * goes on */
  void *going_context;
  /* gets a copy of what leaves the buffer, from tap_from on; NULL: nobody does */
  void (*tap)(void *context, const void *bytes, size_t count);
  void *tap_context;
  size_t tap_from;
  char buffer[VS_WRITER_ROOM];
} vs_writer;

void vs_writer_init(vs_writer *w, vs_sink_fn *sink, void *context);
bool vs_writer_flush(vs_writer *w);
uint32_t vs_writer_line(vs_writer *w); /* the line being written, from 1; of a writer that keeps_lines */

/* For what is written a million times: room for `most` bytes (at most VS_WRITER_ROOM) in the buffer, to be filled from
 * there; vs_writer_filled says how far. NULL: the writer has failed. */
static inline char *vs_writer_room(vs_writer *w, size_t most) {
  if (w->failed || (VS_WRITER_ROOM - w->used < most && !vs_writer_flush(w))) return NULL;
  return w->buffer + w->used;
}
bool vs_writer_filled(vs_writer *w, const char *end);
#define VS_WRITE(to, literal) (memcpy(to, literal, sizeof literal - 1), (to) += sizeof literal - 1) /* into such room */

bool vs_put(vs_writer *w, const void *bytes, size_t count); /* binary is fine */
bool vs_puts(vs_writer *w, const char *text);
/* As printf, for short things that hold no doubles: names, integers, fixed words. Longer than 1 KB is a failure. */
bool vs_putf(vs_writer *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_put_number(vs_writer *w, double x);
/* <1, 2, 3> and the like */
bool vs_put_triple(vs_writer *w, const char *open, vs_vec3 v, const char *between, const char *close);
bool vs_put_spaces(vs_writer *w, size_t count);
bool vs_put_u32(vs_writer *w, uint32_t x); /* decimal digits */
bool vs_put_base64(vs_writer *w, const unsigned char *bytes, size_t count); /* = at the end, if not of threes */
/* A text of the user or of a file, as the notation has it. */
void vs_put_spelled(vs_writer *w, vs_speller *spell, const char *text);
void vs_put_xml(vs_writer *w, const char *text); /* for XML and HTML, attributes too */
/* Little-endian bytes, as the binary formats have them; each returns the place behind them. */
static inline unsigned char *vs_le_u32(unsigned char *to, uint32_t x) {
  to[0] = (unsigned char)x, to[1] = (unsigned char)(x >> 8), to[2] = (unsigned char)(x >> 16),
  to[3] = (unsigned char)(x >> 24);
  return to + 4;
}
static inline unsigned char *vs_le_float(unsigned char *to, double x) { /* 32 bits; never -0 */
  float number = (float)x + 0.0f; /* + 0: -0 becomes 0 */
  uint32_t bits;
  memcpy(&bits, &number, sizeof bits);
  return vs_le_u32(to, bits);
}
unsigned char *vs_le_double(unsigned char *to, double x);

#endif
