/* Declares, for the readers of mesh files, a scanner. It reads words and numbers from lines of text, and binary numbers
 * by their width. No function reads past the end of the file. */
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

/* Sets the error to the text "NAME: line N: ..." and returns false. */
bool vs_scan_fail(const vs_byte_scan *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_scan_poll(vs_byte_scan *s);
/* Skips blanks. Returns true if the current line ends after them. */
bool vs_scan_line_end(vs_byte_scan *s);
/* Moves to the beginning of the next line, or to the end of the text. */
void vs_scan_next_line(vs_byte_scan *s);
/* Reads the next word of the current line. If `lines` is true and the line has no more words, continues with later
 * lines. At the end of the line or text, the word is "". Skips comments, which extend from the character `comment` to
 * the end of the line. If `comment` is 0, the format has no comments. */
void vs_scan_word(vs_byte_scan *s, bool lines, char comment, char word[VS_SCAN_WORD]);
bool vs_scan_real(vs_byte_scan *s, bool lines, char comment, double *out);       /* reads a word as a number; returns
                                                                                  * false and sets the error if it is
                                                                                  * not one, or not finite unless
                                                                                  * s->nowhere */
bool vs_scan_integer(vs_byte_scan *s, bool lines, char comment, int64_t *out);
bool vs_scan_point(vs_byte_scan *s, bool lines, char comment, vs_vec3 *out);

#endif
