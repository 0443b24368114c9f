/* A position in the text of a program, which the readers of GML and AutoLISP share. */
#ifndef VS_VM_FRONT_TEXT_CURSOR_H
#define VS_VM_FRONT_TEXT_CURSOR_H

#include "vm/values/value.h"

typedef struct {
  const char *text;         /* text in UTF-8 */
  size_t size, at;          /* size: length of the text in bytes; at: index of the current byte */
  uint32_t file, line, col; /* file: number of the source file; line, col: line and column of the current byte, from
                             * 1 */
} vs_text_cursor;

static inline vs_pos vs_cursor_place(const vs_text_cursor *c) { return vs_pos_make(c->file, c->line, c->col); }

/* Returns the byte that is `ahead` bytes after the current one, or -1 after the end. */
static inline int vs_cursor_peek(const vs_text_cursor *c, size_t ahead) {
  return c->at + ahead < c->size ? (unsigned char)c->text[c->at + ahead] : -1;
}

/* Advances by a number of bytes, which the text must have. A line ends with \n, \r or both; the column is counted in
 * characters. */
static inline void vs_cursor_advance(vs_text_cursor *c, size_t bytes) {
  for (; bytes--; c->at++) {
    if (c->text[c->at] == '\n' || (c->text[c->at] == '\r' && vs_cursor_peek(c, 1) != '\n')) c->line++, c->col = 1;
    else c->col += ((unsigned char)c->text[c->at] & 0xC0) != 0x80;
  }
}

#endif
