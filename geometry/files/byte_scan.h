/* Declares, for the readers of mesh files, scanning of bytes: words and numbers by line, numbers by their width. Nothing
 * reads past the end. */
#ifndef VS_GEOMETRY_FILES_BYTE_SCAN_H
#define VS_GEOMETRY_FILES_BYTE_SCAN_H

#include "model/long_work.h"
#include "model/node.h"

typedef struct {
  const char *name;           /* of the file, without its folders */
  const unsigned char *bytes;
  size_t size, at;
  uint32_t line, ticks;
  bool nowhere;               /* accept numbers that are not finite: the position of a point is then unknown */
  vs_poller poll;
  vs_error *error;
} vs_byte_scan;

enum { VS_SCAN_WORD = 64 }; /* bytes; longer words are cut, because no number and no keyword is longer */

/* Sets the error "NAME: line N: ..." and returns false. */
bool vs_scan_fail(const vs_byte_scan *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_scan_poll(vs_byte_scan *s);
/* Skips blanks; returns true if the line ends there. */
bool vs_scan_line_end(vs_byte_scan *s);
/* Goes to the next line, at most to the end of the text. */
void vs_scan_next_line(vs_byte_scan *s);
/* Reads the next word; lines: also from the lines that follow. "": the end (of the line). Skips comments from `comment`
 * (0: none) to the line's end. */
void vs_scan_word(vs_byte_scan *s, bool lines, char comment, char word[VS_SCAN_WORD]);
bool vs_scan_real(vs_byte_scan *s, bool lines, char comment, double *out);       /* the number is finite */
bool vs_scan_integer(vs_byte_scan *s, bool lines, char comment, int64_t *out);
bool vs_scan_point(vs_byte_scan *s, bool lines, char comment, vs_vec3 *out);

#endif
