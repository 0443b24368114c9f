/* Owns a text of the prompt that grows: what has been typed and is not whole yet, and what was pasted. */
#ifndef VS_CLI_PROMPT_LINE_BUFFER_H
#define VS_CLI_PROMPT_LINE_BUFFER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  char *at; /* NULL while nothing was added; ends in NUL; the owner frees it */
  size_t length, room;
} line_buffer;

/* Appends length bytes; false where memory is out, and then the buffer is as it was. */
bool cli_line_buffer_add(line_buffer *b, const char *more, size_t length);

#endif
