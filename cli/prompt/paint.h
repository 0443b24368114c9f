/* Declares the painting of a line that libedit has drawn: colours over the same characters, and rows below it. */
#ifndef VS_CLI_PROMPT_PAINT_H
#define VS_CLI_PROMPT_PAINT_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/prompt/line_buffer.h"

/* The place of the rows beneath the line; all 0 if there are none. */
typedef struct {
  int down;   /* rows from the cursor to the first row beneath */
  int column; /* of the cursor, from 0 */
} cli_paint;

typedef struct {
  const char *text;             /* the line, perhaps with newlines */
  size_t length, cursor;        /* in bytes */
  const unsigned char *classes; /* a cli_syntax for each byte, or NULL: no colours */
  int prompt, width, height;    /* columns of the prompt; columns and rows of the terminal */
  const char *below;            /* text beneath, whose rows end in "\r\n" and are narrower than the terminal */
  int rows;                     /* its number of rows */
} cli_painted;

/* Paints the line that libedit shows on standard output, while the cursor is at its place, and returns it there. Does
 * nothing if the text has control characters or does not fit on the terminal. */
void cli_paint_show(cli_paint *p, const cli_painted *line);
/* Returns the number of rows that are free beneath the line on the whole terminal. */
int cli_paint_room(const cli_painted *line);
/* Appends a row of less than `width` columns. `text` has two blanks, up to text[call] the forms of a call, with a
 * newline between them, and a description. With `colours`, the row is dim, and the parameter of number `argument`
 * bold. */
bool cli_hint_row(const char *text, size_t call, int argument, int width, bool colours, line_buffer *to);
/* Erases the rows beneath the line, so that libedit finds the terminal as it left it. */
void cli_paint_erase(cli_paint *p);

#endif
