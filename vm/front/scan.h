/* Owns the test whether a text is complete. */
#ifndef VS_VM_FRONT_SCAN_H
#define VS_VM_FRONT_SCAN_H

#include "vm/machine/native.h"

/* ---- is it complete? A machine that gets one character at a time, for the prompt and for (read) from a port ---- */
typedef enum {
  VS_SCAN_MORE,
  VS_SCAN_WHOLE /* ended before this character */,
  VS_SCAN_WHOLE_WITH /* ended with it */,
  VS_SCAN_BAD
} vs_scan_result;
typedef struct vs_scan {
  vs_scheme *vm;
  uint8_t state, after_hash;
  bool any, escaped, returned;    /* a character but blanks has come; the last was a backslash; it was a \r */
  uint32_t comment;               /* depth of block comments */
  uint32_t wanted;                /* number of data still expected at depth 0 */
  size_t depth, room;
  struct vs_scan_open { char open; uint32_t line, col; } *at;
  uint32_t line, col;             /* of the next character */
  const char *trouble;            /* BAD: the reason */
  uint32_t token_line, token_col; /* the begin of the last string, comment or |symbol| */
} vs_scan;
void vs_scan_open(vs_scheme *vm, vs_scan *s);
void vs_scan_close(vs_scan *s);
bool vs_scan_feed(vs_scan *s, uint32_t c, vs_scan_result *result);    /* returns false when memory is out */
bool vs_scan_end(vs_scan *s);                                         /* true: nothing is open at the end */

typedef enum { VS_TEXT_EMPTY, VS_TEXT_WHOLE, VS_TEXT_OPEN, VS_TEXT_BAD } vs_text_state;
typedef struct vs_text_check { vs_text_state state; uint32_t depth, line, col; const char *trouble; } vs_text_check;
/* Tests whether this text is complete: any number of whole data. OPEN: line and col of the parenthesis, string or
 * comment opened last; BAD: of the mistake. */
bool vs_read_whole(vs_scheme *vm, const char *text, size_t size, vs_text_check *out);

#endif
