/* Declares a scanner for the readers of mesh files. It reads words and numbers from lines of text, and binary numbers
 * of a given width. No function reads past the end of the file. */
#ifndef VS_GEOMETRY_FILES_BYTE_SCAN_H
#define VS_GEOMETRY_FILES_BYTE_SCAN_H

#include "model/long_work.h"
#include "model/node.h"

typedef struct {
  const char *name;           /* name of the scanned file without its folders, for messages */
  const unsigned char *bytes;
  size_t size, at;
  uint32_t line, ticks;
  bool nowhere;               /* true if infinite and NaN coordinates are accepted; a point with such a coordinate has
                               * an unknown position */
  vs_poller poll;
  vs_error *error;
} vs_byte_scan;

enum { VS_SCAN_WORD = 64 }; /* size in bytes of a word with its NUL; longer words are truncated, because no number and
                             * no keyword is longer */

/* Sets the error to "NAME: line N: " and a text in printf's format. Returns false. */
bool vs_scan_fail(const vs_byte_scan *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_scan_poll(vs_byte_scan *s);
/* Skips blanks. Returns true if nothing but blanks is left on the current line. */
bool vs_scan_line_end(vs_byte_scan *s);
/* Moves to the beginning of the next line, or to the end of the text. */
void vs_scan_next_line(vs_byte_scan *s);
/* Reads the next word of the current line, or of a later line if `lines` is true. Sets word to "" if there is none.
 * Skips comments, which extend from the character `comment` to the end of the line; 0: no comments. */
void vs_scan_word(vs_byte_scan *s, bool lines, char comment, char word[VS_SCAN_WORD]);
bool vs_scan_real(vs_byte_scan *s, bool lines, char comment, double *out);       /* reads a word as a number; returns
                                                                                  * false and sets the error if it is
                                                                                  * not a number, or if it is infinite
                                                                                  * or NaN and s->nowhere is false */
bool vs_scan_integer(vs_byte_scan *s, bool lines, char comment, int64_t *out);
bool vs_scan_point(vs_byte_scan *s, bool lines, char comment, vs_vec3 *out);

#endif
