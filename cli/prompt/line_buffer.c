/* Implements the prompt's growing text buffer. It grows to twice the needed size, and its text always ends in NUL. */
#include "cli/prompt/line_buffer.h"

#include <stdlib.h>
#include <string.h>

bool cli_line_buffer_add(line_buffer *b, const char *more, size_t length) {
  if (b->room - b->length <= length) {
    size_t room = (b->length + length + 1) * 2;
    char *grown = realloc(b->at, room);
    if (!grown) return false;
    b->at = grown;
    b->room = room;
  }
  memcpy(b->at + b->length, more, length);
  b->length += length;
  b->at[b->length] = 0;
  return true;
}
