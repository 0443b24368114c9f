/* Paints colours over the line that libedit has drawn, and rows below this line. libedit supports neither. While
 * libedit waits for a key, the cursor is where it expects the cursor; all movements here begin and end there. The
 * painted characters are those that libedit has drawn, at the same places. */
#define _XOPEN_SOURCE 700 /* for wcwidth */
#include "cli/prompt/paint.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

#include "cli/prompt/line_buffer.h"
#include "cli/prompt/source_text.h"

typedef struct { int row, column; } place;

/* Returns the number of bytes of the character at `at`. Sets *columns to its width, or to -1 for a control character or
 * bytes that are no character. */
static size_t character(const char *at, size_t length, int *columns) {
  wchar_t wide;
  mbstate_t state = { 0 };
  size_t n = mbrtowc(&wide, at, length, &state);
  bool invalid = n == (size_t)-1 || n == (size_t)-2 || n == 0;
  *columns = invalid ? -1 : wcwidth(wide);
  return invalid ? 1 : n;
}

/* Moves the place p past the character c, by libedit's rules. */
static void advance(place *p, char c, int columns, int width) {
  if (c == '\n') p->row++, p->column = 0;
  else {
    if (p->column + columns > width) p->row++, p->column = 0; /* a wide character that does not fit into the row is
                                                               * placed in the next row */
    p->column += columns;
    if (p->column >= width) p->row++, p->column = 0;
  }
}

/* Computes the places of the cursor and of the text's end on the terminal. Returns false if the text cannot be
 * painted. */
static bool measure(const cli_painted *line, place *cursor, place *end) {
  place p = { 0, line->prompt };
  *cursor = p;
  if (line->width < 2 || line->prompt >= line->width) return false;
  for (size_t i = 0; i < line->length;) {
    int columns;
    size_t n = character(line->text + i, line->length - i, &columns);
    if (columns < 0 && line->text[i] != '\n') return false;
    if (i == line->cursor) *cursor = p;
    advance(&p, line->text[i], columns, line->width);
    i += n;
  }
  if (line->cursor >= line->length) *cursor = p;
  *end = p;
  return p.row + 1 < line->height;
}

static bool put(line_buffer *to, const char *text) { return cli_line_buffer_add(to, text, strlen(text)); }

static bool move(line_buffer *to, int rows, char way) {
  char text[24];
  if (rows <= 0) return true;
  snprintf(text, sizeof text, "\033[%d%c", rows, way);
  return put(to, text);
}

static bool set_colour(line_buffer *to, unsigned class) {
  char text[24];
  snprintf(text, sizeof text, *cli_syntax_colours[class] ? "\033[0;%sm" : "\033[0m", cli_syntax_colours[class]);
  return put(to, text);
}

/* Writes the text in colours, from after the prompt. The terminal's cursor is then after the last character. If the
 * last row is full, the cursor is still in this row, while the computed end is in the next row. */
static bool put_text(const cli_painted *line, line_buffer *to) {
  unsigned class = CLI_SYNTAX_PLAIN;
  bool ok = true;
  for (size_t i = 0; ok && i < line->length;) {
    int columns;
    size_t n = character(line->text + i, line->length - i, &columns);
    if (line->classes[i] != class) ok = set_colour(to, class = line->classes[i]);
    ok = ok && (line->text[i] == '\n' ? put(to, "\r\n") : cli_line_buffer_add(to, line->text + i, n));
    i += n;
  }
  return ok && (class == CLI_SYNTAX_PLAIN || set_colour(to, CLI_SYNTAX_PLAIN));
}

int cli_paint_room(const cli_painted *line) {
  place cursor, end;
  return measure(line, &cursor, &end) ? line->height - end.row - 1 : 0;
}

void cli_paint_show(cli_paint *p, const cli_painted *line) {
  place cursor, end;
  line_buffer out = { 0 };
  int rows = line->rows;
  if (!measure(line, &cursor, &end) || (!line->classes && !rows)) return;
  if (end.row + rows >= line->height) rows = 0;
  int row = cursor.row; /* row of the terminal's cursor */
  bool ok = true;
  if (line->classes && line->length) {
    ok = move(&out, row, 'A') && move(&out, line->prompt ? line->prompt + 1 : 1, 'G') && put_text(line, &out);
    /* full: whether the last row is full, so that the terminal's cursor is a row above the computed end */
    bool full = end.column == 0 && line->text[line->length - 1] != '\n';
    ok = ok && (!full || put(&out, "\r\n"));
    row = end.row;
  }
  if (rows) {
    while (ok && row++ <= end.row) ok = put(&out, "\r\n"); /* creates rows that the terminal does not have yet, which
                                                            * moving the cursor would not */
    ok = ok &&
         cli_line_buffer_add(&out, line->below, strlen(line->below) - 2); /* omits the line end of the last row */
    row = end.row + rows;
  }
  ok = ok && move(&out, row - cursor.row, 'A') && move(&out, cursor.row - row, 'B') &&
       move(&out, cursor.column + 1, 'G');
  if (ok) {
    fwrite(out.at, 1, out.length, stdout);
    fflush(stdout);
    *p = rows ? (cli_paint){ end.row + 1 - cursor.row, cursor.column } : (cli_paint){ 0, 0 };
  }
  free(out.at);
}

void cli_paint_erase(cli_paint *p) {
  if (!p->down) return;
  printf("\033[%dB\r\033[J\033[%dA\033[%dG", p->down, p->down, p->column + 1);
  fflush(stdout);
  *p = (cli_paint){ 0, 0 };
}

/* ---- the row of a call ---- */

/* Finds parameter `number` in a form of call such as "(name p [q] r ...)". If "..." follows the last parameter, it is
 * also found for all larger numbers. Returns false if there is no such parameter. */
static bool find_parameter(const char *form, size_t length, int number, size_t *from, size_t *to) {
  int depth = 0, at = -1;         /* at: number of the parameter that is being read; -1: the procedure's name */
  size_t start = 0, previous = 0; /* positions where this parameter and the previous parameter begin */
  for (size_t i = 0; i < length; i++) {
    depth += form[i] == '(' || form[i] == '[';
    depth -= form[i] == ')' || form[i] == ']';
    if ((form[i] != ' ' || depth != 1) && depth != 0) continue;
    bool dots = i - start == 3 && !memcmp(form + start, "...", 3);
    if (dots && at > 0) return *from = previous, *to = i, true;
    if (at >= 0 && at == number && strncmp(form + i, " ...", 4) != 0) return *from = start, *to = i, true;
    previous = start;
    start = i + 1;
    at++;
  }
  return false;
}

bool cli_hint_row(const char *text, size_t call, int argument, int width, bool colours, line_buffer *to) {
  enum { GAP = 2 };
  int column = 0;
  size_t from = 0, till = 0;
  bool ok = !colours || put(to, "\033[2m");
  for (size_t i = 0; ok && text[i] && column < width - 1; i++) {
    bool starts = i < call && (i == GAP || text[i - (i > 0)] == '\n');
    if (starts && colours) {
      size_t length = strcspn(text + i, "\n");
      if (length > call - i) length = call - i;
      from = till = 0;
      if (argument < 0 || !find_parameter(text + i, length, argument, &from, &till)) from = till = 0;
      else from += i, till += i;
    }
    if (till > from && i == from) ok = put(to, "\033[0;1m");
    if (text[i] == '\n') ok = ok && put(to, "  "), column += 2;
    else ok = ok && cli_line_buffer_add(to, text + i, 1), column += ((unsigned char)text[i] & 0xC0) != 0x80;
    if (till > from && i + 1 == till) ok = ok && put(to, "\033[0;2m");
  }
  return ok && (!colours || put(to, "\033[0m")) && put(to, "\r\n");
}
