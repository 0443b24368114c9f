/* Declares a test whether a text is complete. */
#ifndef VS_VM_FRONT_SCAN_H
#define VS_VM_FRONT_SCAN_H

#include "vm/machine/native.h"

/* ---- a state machine that reads one character at a time, for the prompt and for (read) from a port ---- */
typedef enum {
  VS_SCAN_MORE,
  VS_SCAN_WHOLE /* the data are complete; they end before the character that was passed */,
  VS_SCAN_WHOLE_WITH /* the data are complete; they end with the character that was passed */,
  VS_SCAN_BAD
} vs_scan_result;
typedef struct vs_scan {
  vs_scheme *vm;
  uint8_t state, after_hash;
  bool any, escaped, returned;    /* any: whether a character other than blanks was processed; escaped: whether the last
                                   * character was a backslash; returned: whether the last character was \r */
  uint32_t comment;               /* nesting depth of block comments */
  uint32_t wanted;                /* number of data (outside all parentheses) that must still follow */
  size_t depth, room;
  struct vs_scan_open { char open; uint32_t line, col; } *at;
  uint32_t line, col;             /* line and column of the next character to process */
  const char *trouble;            /* for the result BAD: text that describes the mistake */
  uint32_t token_line, token_col; /* place at which the last string, comment or |symbol| begins */
} vs_scan;
void vs_scan_open(vs_scheme *vm, vs_scan *s);
void vs_scan_close(vs_scan *s);
bool vs_scan_feed(vs_scan *s, uint32_t c, vs_scan_result *result);    /* Processes one character. Returns false when
                                                                       * memory is out. */
bool vs_scan_end(vs_scan *s);                                         /* Returns true if no parenthesis, string or
                                                                       * comment is open at the end of the text. */

typedef enum { VS_TEXT_EMPTY, VS_TEXT_WHOLE, VS_TEXT_OPEN, VS_TEXT_BAD } vs_text_state;
typedef struct vs_text_check { vs_text_state state; uint32_t depth, line, col; const char *trouble; } vs_text_check;
/* Tests whether the text consists of complete data. For the result OPEN, sets line and column of *out to those of the
 * innermost open parenthesis, string or comment; for BAD, to those of the mistake. Returns false when memory is out. */
bool vs_read_whole(vs_scheme *vm, const char *text, size_t size, vs_text_check *out);

#endif
