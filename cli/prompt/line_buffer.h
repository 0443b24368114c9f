/* Declares a growing text buffer of the prompt, for text that is typed, unfinished or pasted. */
#ifndef VS_CLI_PROMPT_LINE_BUFFER_H
#define VS_CLI_PROMPT_LINE_BUFFER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  char *at; /* the text, ending in NUL, or NULL while it is empty; the owner frees it */
  size_t length, room;
} line_buffer;

/* Appends `length` bytes of `more`. Returns false, and changes nothing, when memory is out. */
bool cli_line_buffer_add(line_buffer *b, const char *more, size_t length);

#endif
