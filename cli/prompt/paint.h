/* Declares the painting of a line that libedit has drawn: colours over the same characters, and rows below it. */
#ifndef VS_CLI_PROMPT_PAINT_H
#define VS_CLI_PROMPT_PAINT_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/prompt/line_buffer.h"

/* Position of the painted rows below the line, by which they are erased. All members are 0 if there are no such
 * rows. */
typedef struct {
  int down;   /* number of rows from the cursor's row to the first row below the line */
  int column; /* column of the cursor, counted from 0 */
} cli_paint;

typedef struct {
  const char *text;             /* the text of the line, which may contain newlines */
  size_t length, cursor;        /* length of the text, and position of the cursor in it, in bytes */
  const unsigned char *classes; /* classes[i]: cli_syntax of byte i of the text, for colours; NULL: no colours */
  int prompt, width, height;    /* prompt: columns of the prompt; width, height: columns and rows of the terminal */
  const char *below;            /* text of the rows below the line, each ending in "\r\n" and narrower than the
                                 * terminal */
  int rows;                     /* number of rows below the line */
} cli_painted;

/* Paints the line that libedit shows on standard output, and its rows below. Expects the cursor at its place in the
 * line, and returns it there. Does nothing if the text contains control characters or does not fit on the terminal. */
void cli_paint_show(cli_paint *p, const cli_painted *line);
/* Returns the greatest number of rows below the line for which the terminal has room. */
int cli_paint_room(const cli_painted *line);
/* Appends a row of less than `width` columns. `text` begins with two blanks. Up to text[call] it contains the ways to
 * call a procedure, separated by newlines; a description follows. With `colours` the row is dim, and parameter number
 * `argument` is in bold type. */
bool cli_hint_row(const char *text, size_t call, int argument, int width, bool colours, line_buffer *to);
/* Erases the rows below the line, so that the terminal is again in the state in which libedit left it. */
void cli_paint_erase(cli_paint *p);

#endif
