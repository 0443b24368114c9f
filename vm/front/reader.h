/* Owns the way from text to data: whole files with positions, single data from ports, and the question whether a text is whole.

   Data from source files are made of located pairs: the first pair of a list carries the place of its parenthesis, every further pair the
   place of its element, so that an atom's place follows from the pair that holds it (vs_form_pos in syntax.h). `#:name` reads
   as the symbol "#:name". Nothing recurses on the C stack. */
#ifndef VS_READER_H
#define VS_READER_H

#include "vm/machine/native.h"

/* The number of a source file in positions; the same name gives the same number. */
bool vs_file_number(vs_scheme *vm, const char *name, size_t bytes, uint32_t *number);

/* Is it text at all? An error tells the place of the first byte that is none. */
bool vs_check_utf8(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line);

/* All data of a text, in order, as one located list. A text with mistakes gives one condition of kind `read` for the first; its payload is a
   list of (place . message) of the others, in order. `line` is the number of the text's first line; fold: as
   after #!fold-case. */
bool vs_read_all(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, bool fold, vs_value *forms);

/* The first datum of a text, unlocated, or VS_EOF. *used: bytes up to its end. */
bool vs_read_datum(vs_scheme *vm, const char *text, size_t size, vs_value *out, size_t *used);

/* ---- is it whole? A machine fed one character at a time, for the REPL and for (read) from a port. ---- */
typedef enum { VS_SCAN_MORE, VS_SCAN_WHOLE /* ended before this character */, VS_SCAN_WHOLE_WITH /* ended with it */, VS_SCAN_BAD } vs_scan_result;
typedef struct vs_scan {
  vs_scheme *vm;
  uint8_t state, after_hash;
  bool any, escaped, returned;    /* something but blanks was seen; the last character was a backslash; it was a \r */
  uint32_t comment;               /* depth of block comments */
  uint32_t wanted;                /* data still to come at depth 0 */
  size_t depth, room;
  struct vs_scan_open { char open; uint32_t line, col; } *at;
  uint32_t line, col;             /* of the character fed next */
  const char *trouble;            /* BAD: why */
  uint32_t token_line, token_col; /* where the last string, comment or |symbol| began */
} vs_scan;
void vs_scan_open(vs_scheme *vm, vs_scan *s);
void vs_scan_close(vs_scan *s);
bool vs_scan_feed(vs_scan *s, uint32_t c, vs_scan_result *result);    /* false: out of memory */
bool vs_scan_end(vs_scan *s);                                         /* at the end of the text: nothing is open */

typedef enum { VS_TEXT_EMPTY, VS_TEXT_WHOLE, VS_TEXT_OPEN, VS_TEXT_BAD } vs_text_state;
typedef struct vs_text_check { vs_text_state state; uint32_t depth, line, col; const char *trouble; } vs_text_check;
/* Is this text any number of whole data? OPEN: line, col of what was opened last. BAD: of the trouble. */
bool vs_read_whole(vs_scheme *vm, const char *text, size_t size, vs_text_check *out);

#endif
