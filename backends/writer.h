/* Declares the output of text: a buffered writer to any sink, with numbers (number_spelling.c), indentation and a count
 * of lines.
 *
 * A writer remembers its first failure. Each later call does nothing and returns false, so an emitter may print freely
 * and check once. A number is the shortest text of at most 12 significant digits. Its decimal sign is a point in every
 * locale, and -0 is written as 0. */
#ifndef VS_BACKENDS_WRITER_H
#define VS_BACKENDS_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "model/characters.h"
#include "model/vec.h"

typedef bool vs_sink_fn(void *context, const void *bytes, size_t count); /* Function that receives `count` bytes.
                                                                          * Returns false on failure; `context` keeps
                                                                          * the reason. */

enum { VS_WRITER_ROOM = 1 << 16, VS_NUMBER_ROOM = 32 };

typedef struct {
  vs_sink_fn *sink;
  void *context;
  size_t used;
  uint64_t bytes;  /* number of bytes written so far, including the bytes in the buffer */
  uint64_t limit;  /* greatest number of bytes that may be written; 0: no limit */
  size_t counted;  /* number of bytes at the beginning of the buffer whose newlines are already counted in `line` */
  uint32_t line;   /* number of the line at the end of the first `counted` bytes of the buffer */
  bool failed, full; /* failed: whether a call has failed; full: whether the limit was the reason */
  bool keeps_lines;  /* true if the caller uses vs_writer_line */
  bool (*going)(void *context); /* called each time the buffer is full, to test for an interrupt. If it returns false,
                                 * the writer fails, and `context` keeps the reason. NULL: no tests */
  void *going_context;
  /* Function that receives a copy of the bytes that leave the buffer, beginning with byte number tap_from. NULL: no
   * copies */
  void (*tap)(void *context, const void *bytes, size_t count);
  void *tap_context;
  size_t tap_from;
  char buffer[VS_WRITER_ROOM];
} vs_writer;

void vs_writer_init(vs_writer *w, vs_sink_fn *sink, void *context);
bool vs_writer_flush(vs_writer *w);
uint32_t vs_writer_line(vs_writer *w); /* Returns the number of the current line, from 1. Only for a writer with
                                        * keeps_lines. */

/* Returns memory for `most` bytes (at most VS_WRITER_ROOM) in the buffer, for items that are written a million times.
 * The caller fills the memory and passes the end of the text to vs_writer_filled. Returns NULL if the writer has
 * failed. */
static inline char *vs_writer_room(vs_writer *w, size_t most) {
  if (w->failed || (VS_WRITER_ROOM - w->used < most && !vs_writer_flush(w))) return NULL;
  return w->buffer + w->used;
}
bool vs_writer_filled(vs_writer *w, const char *end);
#define VS_WRITE(to, literal) (memcpy(to, literal, sizeof literal - 1), (to) += sizeof literal - 1) /* writes a literal
                                                                                                     * into the room
                                                                                                     * that
                                                                                                     * vs_writer_room
                                                                                                     * returned */

bool vs_put(vs_writer *w, const void *bytes, size_t count); /* writes bytes of any value */
bool vs_puts(vs_writer *w, const char *text);
/* Writes formatted text as printf does, for short texts without doubles: names, integers, fixed words. Fails for a text
 * longer than 1 KB. */
bool vs_putf(vs_writer *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_put_number(vs_writer *w, double x);
/* writes three numbers between `open` and `close`, such as <1, 2, 3> */
bool vs_put_triple(vs_writer *w, const char *open, vs_vec3 v, const char *between, const char *close);
bool vs_put_spaces(vs_writer *w, size_t count);
bool vs_put_u32(vs_writer *w, uint32_t x); /* writes x in decimal */
bool vs_put_base64(vs_writer *w, const unsigned char *bytes, size_t count); /* writes base64; the text ends in = if
                                                                             * count is not a multiple of 3 */
/* Writes a text of the user or of a file, escaped by the function `spell` for the output's notation. */
void vs_put_spelled(vs_writer *w, vs_speller *spell, const char *text);
void vs_put_xml(vs_writer *w, const char *text); /* escapes text for XML and HTML, including attributes */
/* Writes a 32-bit little-endian number for a binary format. Returns the position after the written bytes. */
static inline unsigned char *vs_le_u32(unsigned char *to, uint32_t x) {
  to[0] = (unsigned char)x, to[1] = (unsigned char)(x >> 8), to[2] = (unsigned char)(x >> 16),
  to[3] = (unsigned char)(x >> 24);
  return to + 4;
}
static inline unsigned char *vs_le_float(unsigned char *to, double x) { /* writes a 32-bit float; -0 becomes 0 */
  float number = (float)x + 0.0f; /* adding 0 turns -0 into 0 */
  uint32_t bits;
  memcpy(&bits, &number, sizeof bits);
  return vs_le_u32(to, bits);
}
unsigned char *vs_le_double(unsigned char *to, double x);

#endif
