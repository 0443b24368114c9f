/* Owns, for the readers of mesh files, walking through bytes: words and numbers by line, numbers by their width.
 * Nothing reads past the end. */
#ifndef VS_GEOMETRY_FILES_BYTE_SCAN_H
#define VS_GEOMETRY_FILES_BYTE_SCAN_H

#include "model/long_work.h"
#include "model/node.h"

typedef struct {
  const char *name;           /* of the file, without folders */
  const unsigned char *bytes;
  size_t size, at;
  uint32_t line, ticks;
  bool nowhere;               /* numbers that are not finite are points that are nowhere, and no error */
  vs_poller poll;
  vs_error *error;
} vs_byte_scan;

enum { VS_SCAN_WORD = 64 }; /* longer words are cut: no number and no keyword is so long */

/* "NAME: line N: ..." */
bool vs_scan_fail(const vs_byte_scan *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_scan_poll(vs_byte_scan *s);
/* are there only blanks before the line's end? They are passed over */
bool vs_scan_line_end(vs_byte_scan *s);
/* Goes on to the next line; nothing is read past the end. */
void vs_scan_next_line(vs_byte_scan *s);
/* The next word, over line ends where `lines`; "" at the end (of the line). Comments from `comment` (0: none) to the
 * line's end are passed over. */
void vs_scan_word(vs_byte_scan *s, bool lines, char comment, char word[VS_SCAN_WORD]);
bool vs_scan_real(vs_byte_scan *s, bool lines, char comment, double *out);       /* finite, or the error */
bool vs_scan_integer(vs_byte_scan *s, bool lines, char comment, int64_t *out);
bool vs_scan_point(vs_byte_scan *s, bool lines, char comment, vs_vec3 *out);

#endif
