/* Lays out a program in one style, and checks that the tokens of the old and the new text are equal. */
#include "languages/format/format_program.h"

#include <stdlib.h>
#include <string.h>

#include "languages/format/format_layout.h"
#include "model/store/array.h"

typedef struct { char *text; size_t length, room; bool failed; } buffer;

static void put(buffer *b, const char *text, size_t length) {
  if (b->failed || !VS_GROW(b->text, b->room, b->length + length + 1)) {
    b->failed = true;
    return;
  }
  if (length) memcpy(b->text + b->length, text, length);
  b->length += length;
}

static void put_blanks(buffer *b, uint32_t count) {
  static const char blanks[] = "                                ";
  for (uint32_t n; count; count -= n) {
    n = count < sizeof blanks - 1 ? count : (uint32_t)sizeof blanks - 1;
    put(b, blanks, n);
  }
}

/* Returns the line end that the first line of the text has: \n, \r\n or \r. */
static const char *line_end(const char *text, size_t length) {
  const char *end = memchr(text, '\n', length);
  return end && end > text && end[-1] == '\r' ? "\r\n" : "\n";
}

static void write_tokens(buffer *b, const format_tokens *t) {
  const char *end = t->length ? line_end(t->text, t->length) : "\n";
  for (size_t i = 0; i < t->count; i++) {
    const format_token *x = &t->tokens[i];
    bool apart = x->lines > 1 && i && x->kind != FORMAT_TOKEN_CLOSE && x[-1].kind != FORMAT_TOKEN_OPEN;
    if (i && x->breaks) put(b, end, strlen(end));
    if (i && x->breaks && apart) put(b, end, strlen(end));
    put_blanks(b, x->breaks ? x->column : x->column - x[-1].end);
    put(b, t->text + x->from, x->to - x->from);
  }
  if (t->count) put(b, end, strlen(end));
}

/* Returns true if the text in the buffer has the tokens t. Sets b->failed when memory is out. */
static bool keeps_tokens(buffer *b, const format_tokens *t) {
  format_tokens again;
  b->failed = !format_tokens_read(&again, b->text, b->length);
  bool equal = !b->failed && format_tokens_equal(t, &again);
  format_tokens_free(&again);
  return equal;
}

char *format_program(const char *text, size_t length, size_t *formatted) {
  format_tokens t;
  buffer b = { 0 };
  b.failed = !format_tokens_read(&t, text, length);
  if (!b.failed) {
    format_layout(&t);
    put(&b, "", 0);
    write_tokens(&b, &t);
  }
  if (!b.failed && !keeps_tokens(&b, &t)) {
    b.length = 0;
    put(&b, text, length);
  }
  format_tokens_free(&t);
  if (b.failed) return free(b.text), NULL;
  b.text[b.length] = 0;
  *formatted = b.length;
  return b.text;
}
