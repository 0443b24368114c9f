/* Prints the manual's pages, in Markdown, on a terminal.
 *
 * The lines of a block (a paragraph, an item, a cell) are joined into one plain text with three marks. BOLD and PLAIN
 * switch the type. TIED is a blank at which no line may break, so that a short call stays on one line. This text is
 * then broken into lines of the terminal's width. */
#include "cli/prompt/markdown.h"

#include <stdlib.h>
#include <string.h>

#include "cli/prompt/line_buffer.h"

enum { BOLD = 1, PLAIN = 2, TIED = 3 };
enum { LONGEST_TIED = 40, MOST_COLUMNS = 12, GAP = 2, INDENT = 4 };

typedef struct { const char *at, *end; } part;
typedef struct {
  FILE *to;
  int width;
  bool bold;
  bool blank;    /* whether the last printed line was empty, or nothing was printed yet */
  line_buffer source;  /* lines of a block (a paragraph, an item, a cell), joined */
  line_buffer plain;   /* the joined lines, with marks instead of Markdown's signs */
} printer;

static bool add_sign(line_buffer *t, char sign) { return cli_line_buffer_add(t, &sign, 1); }

/* ---- kinds of lines ---- */

static part line_at(const char *at, const char *end) {
  const char *stop = memchr(at, '\n', (size_t)(end - at));
  return (part){at, stop ? stop : end};
}
static bool begins(part line, const char *with) {
  size_t n = strlen(with);
  return (size_t)(line.end - line.at) >= n && !memcmp(line.at, with, n);
}

int cli_markdown_level(const char *line, size_t length) {
  size_t n = 0;
  while (n < length && line[n] == '#') n++;
  return n > 0 && n < length && line[n] == ' ' ? (int)n : 0;
}
static int level(part line) { return cli_markdown_level(line.at, (size_t)(line.end - line.at)); }

/* Returns the width of a list item's sign with the blanks around it: 2 for "- word", 3 for "1. word". Returns 0 if the
 * line begins no item. */
static int item_sign(part line) {
  const char *p = line.at;
  while (p < line.end && *p == ' ') p++;
  const char *sign = p;
  while (p < line.end && *p >= '0' && *p <= '9') p++;
  bool numbered = p > sign && p < line.end && *p == '.';
  if (!numbered && (p > sign || p >= line.end || (*p != '-' && *p != '*'))) return 0;
  return p + 1 < line.end && p[1] == ' ' ? (int)(p + 2 - line.at) : 0;
}

static bool is_empty(part line) {
  while (line.at < line.end && *line.at == ' ') line.at++;
  return line.at == line.end;
}
static bool goes_on(part line) { /* returns true if the line continues the paragraph or item before it */
  return !is_empty(line) && !level(line) && !item_sign(line) && !begins(line, "```") && !begins(line, "|") &&
      !begins(line, "![");
}

/* ---- signs within a block ---- */

/* Returns the end of the code that begins with the backquote at p, or NULL if there is no second backquote. */
static const char *code_end(const char *p, const char *end) { return memchr(p + 1, '`', (size_t)(end - p - 1)); }

static bool add_code(line_buffer *plain, const char *at, const char *end) {
  bool tied = end - at <= LONGEST_TIED;
  if (!add_sign(plain, BOLD)) return false;
  for (; at < end; at++)
    if (!add_sign(plain, tied && *at == ' ' ? TIED : *at)) return false;
  return add_sign(plain, PLAIN);
}

/* Appends the text of `from` to `plain`, with marks instead of Markdown's signs. */
static bool add_plain(line_buffer *plain, part from) {
  bool strong = false;
  const char *link = NULL; /* end of the link's text that is being read: position of the ] in ](to) */
  for (const char *p = from.at; p < from.end; p++) {
    const char *close = *p == '`' ? code_end(p, from.end) : NULL;
    if (close) {
      if (!add_code(plain, p + 1, close) || (strong && !add_sign(plain, BOLD))) return false;
      p = close;
    } else if (p == link) {
      const char *stop = memchr(p, ')', (size_t)(from.end - p));
      p = stop ? stop : p;
      link = NULL;
    } else if (*p == '*' && p + 1 < from.end && p[1] == '*') {
      if (!add_sign(plain, strong ? PLAIN : BOLD)) return false;
      strong = !strong;
      p++;
    } else {
      if (*p == '[' && !link)
        for (const char *q = p + 1; q + 1 < from.end && !link && *q != '['; q++)
          if (*q == ']' && q[1] == '(') link = q;
      if (*p == '[' && link) continue;
      if (*p == '\\' && p + 1 < from.end && strchr("|*`[]_#", p[1])) p++;
      if (!add_sign(plain, *p)) return false;
    }
  }
  return !strong || add_sign(plain, PLAIN);
}

static int columns(const char *at, const char *end) {
  int n = 0;
  for (; at < end; at++) n += *at != BOLD && *at != PLAIN && ((unsigned char)*at & 0xC0) != 0x80;
  return n;
}

/* Removes a line's words from *rest: as many as fit `width` columns, but at least one. Returns them. */
static part take_line(part *rest, int width) {
  while (rest->at < rest->end && *rest->at == ' ') rest->at++;
  part line = {rest->at, rest->at};
  for (const char *p = rest->at; p < rest->end;) {
    const char *word = p;
    while (p < rest->end && *p == ' ') p++;
    while (p < rest->end && *p != ' ') p++;
    if (line.end > line.at && columns(line.at, p) > width) {
      p = word;
      break;
    }
    line.end = p;
  }
  rest->at = line.end;
  return line;
}

static void print_blanks(printer *o, int n) {
  for (int i = 0; i < n; i++) fputc(' ', o->to);
}

/* Prints the words of a line. *bold: whether the line begins in bold type; on return, whether it ends in bold type. */
static void print_words(printer *o, part line, bool *bold) {
  if (*bold && o->bold) fputs("\033[1m", o->to);
  for (const char *p = line.at; p < line.end; p++) {
    if (*p == BOLD || *p == PLAIN) {
      bool now = *p == BOLD;
      if (now != *bold && o->bold) fputs(now ? "\033[1m" : "\033[0m", o->to);
      *bold = now;
    } else fputc(*p == TIED ? ' ' : *p, o->to);
  }
  if (*bold && o->bold) fputs("\033[0m", o->to);
}

/* Prints the text `rest` in several lines, with `indent` blanks before each line except the first. */
static void fill(printer *o, part rest, int indent, bool bold) {
  int before = 0;
  do {
    part line = take_line(&rest, o->width - indent);
    print_blanks(o, before);
    print_words(o, line, &bold);
    fputc('\n', o->to);
    before = indent;
  } while (rest.at < rest.end);
  o->blank = false;
}

static void leave_blank(printer *o) {
  if (!o->blank) fputc('\n', o->to);
  o->blank = true;
}

/* ---- printing blocks; each function returns the start of the next block, or NULL when memory is out ---- */

static const char *after(part line, const char *end) { return line.end < end ? line.end + 1 : end; }

static const char *print_code(printer *o, const char *at, const char *end) {
  leave_blank(o);
  for (at = after(line_at(at, end), end); at < end;) {
    part line = line_at(at, end);
    at = after(line, end);
    if (begins(line, "```")) break;
    if (line.at < line.end) print_blanks(o, INDENT);
    fprintf(o->to, "%.*s\n", (int)(line.end - line.at), line.at);
  }
  o->blank = false;
  leave_blank(o);
  return at;
}

/* Prints a paragraph or a list item. The text of an item is indented by the width of its sign. */
static const char *print_text(printer *o, const char *at, const char *end) {
  part first = line_at(at, end), line = first;
  int sign = item_sign(line);
  o->source.length = o->plain.length = 0;
  if (!cli_line_buffer_add(&o->source, line.at + sign, (size_t)(line.end - line.at - sign))) return NULL;
  for (at = after(line, end); at < end; at = after(line, end)) {
    line = line_at(at, end);
    if (!goes_on(line)) break;
    while (line.at < line.end && *line.at == ' ') line.at++;
    if (!add_sign(&o->source, ' ') || !cli_line_buffer_add(&o->source, line.at, (size_t)(line.end - line.at)))
      return NULL;
  }
  if (!add_plain(&o->plain, (part){o->source.at, o->source.at + o->source.length})) return NULL;
  fprintf(o->to, "%.*s", sign, first.at);
  fill(o, (part){o->plain.at, o->plain.at + o->plain.length}, sign, false);
  return at;
}

static const char *print_heading(printer *o, const char *at, const char *end) {
  part line = line_at(at, end);
  o->plain.length = 0;
  if (!add_plain(&o->plain, (part){line.at + level(line) + 1, line.end})) return NULL;
  for (size_t i = 0; i < o->plain.length; i++) /* removes the marks for bold type within a paragraph that is bold as a
                                                * whole */
    if (o->plain.at[i] == PLAIN) o->plain.at[i] = BOLD;
  leave_blank(o);
  fill(o, (part){o->plain.at, o->plain.at + o->plain.length}, 2, true);
  leave_blank(o);
  return after(line, end);
}

/* ---- printing tables ---- */

typedef struct { size_t from, to; } cell; /* offsets in `plain` of the beginning and the end of the cell's text */
typedef struct { cell cells[MOST_COLUMNS]; int count; } row;

static bool is_rule(part line) { /* returns true for a line such as |---|---| */
  for (const char *p = line.at; p < line.end; p++)
    if (!strchr("|-: ", *p)) return false;
  return true;
}

/* Splits a row of a table, |a|b|, at its bars. A bar within `code` or after a backslash is text. */
static bool read_row(printer *o, part line, row *r) {
  r->count = 0;
  while (line.end > line.at && line.end[-1] == ' ') line.end--;
  if (line.end > line.at + 1 && line.end[-1] == '|' && line.end[-2] != '\\') line.end--;
  const char *from = line.at + 1;
  for (const char *p = from; p <= line.end; p++) {
    const char *close = p < line.end && *p == '`' ? code_end(p, line.end) : NULL;
    if (close) {
      p = close;
      continue;
    }
    if (p < line.end && (*p != '|' || p[-1] == '\\' || r->count == MOST_COLUMNS - 1)) continue;
    part inside = {from, p};
    while (inside.at < inside.end && *inside.at == ' ') inside.at++;
    while (inside.end > inside.at && inside.end[-1] == ' ') inside.end--;
    cell *c = &r->cells[r->count++];
    c->from = o->plain.length;
    if (!add_plain(&o->plain, inside) || !add_sign(&o->plain, '\n')) return false;
    c->to = o->plain.length - 1;
    from = p + 1;
  }
  return true;
}

/* Reduces the widths of the columns, which are at first those of the widest cells, until their sum fits `width`. Always
 * reduces the widest column, and none below its longest word. */
static void share_width(int *wide, const int *least, int count, int width) {
  int room = width - GAP * (count - 1), cap = 0;
  for (int i = 0; i < count; i++) cap = wide[i] > cap ? wide[i] : cap;
  for (int sum = room + 1; sum > room && cap > 8; cap--) {
    sum = 0;
    for (int i = 0; i < count; i++) {
      if (wide[i] > cap) wide[i] = least[i] > cap ? least[i] : cap;
      sum += wide[i];
    }
  }
}

static int longest_word(const char *at, const char *end) {
  int longest = 0;
  for (const char *word = at; word < end;) {
    const char *stop = memchr(word, ' ', (size_t)(end - word));
    if (!stop) stop = end;
    int n = columns(word, stop);
    longest = n > longest ? n : longest;
    word = stop + 1;
  }
  return longest;
}

static void print_row(printer *o, const row *r, const int *wide, int count, bool bold) {
  part rest[MOST_COLUMNS];
  bool types[MOST_COLUMNS];
  for (int i = 0; i < r->count; i++) {
    rest[i] = (part){o->plain.at + r->cells[i].from, o->plain.at + r->cells[i].to};
    types[i] = bold;
  }
  for (bool more = true; more;) {
    more = false;
    int gap = 0;
    for (int i = 0; i < r->count && i < count; i++) {
      part line = take_line(&rest[i], wide[i]);
      if (line.end > line.at) {
        print_blanks(o, gap);
        print_words(o, line, &types[i]);
        gap = 0;
      }
      int left = wide[i] - columns(line.at, line.end);
      gap += (left > 0 ? left : 0) + GAP;
      more = more || rest[i].at < rest[i].end;
    }
    fputc('\n', o->to);
  }
}

static const char *print_table(printer *o, const char *at, const char *end) {
  line_buffer read = {0}; /* the rows of the table that have been read, as an array */
  bool fine = true;
  o->plain.length = 0;
  while (fine && at < end && *at == '|') {
    part line = line_at(at, end);
    row r;
    at = after(line, end);
    if (!is_rule(line)) fine = read_row(o, line, &r) && cli_line_buffer_add(&read, (const char *)&r, sizeof r);
  }
  const row *rows = (const void *)read.at;
  size_t count = fine ? read.length / sizeof *rows : 0;
  int wide[MOST_COLUMNS] = {0}, least[MOST_COLUMNS] = {0}, most = 0, line = 0;
  for (size_t i = 0; i < count; i++) {
    most = rows[i].count > most ? rows[i].count : most;
    for (int c = 0; c < rows[i].count; c++) {
      const char *from = o->plain.at + rows[i].cells[c].from, *to = o->plain.at + rows[i].cells[c].to;
      int n = columns(from, to), word = longest_word(from, to);
      wide[c] = n > wide[c] ? n : wide[c];
      least[c] = word > least[c] ? word : least[c];
    }
  }
  if (count) {
    leave_blank(o);
    share_width(wide, least, most, o->width);
    print_row(o, &rows[0], wide, most, true);
    for (int c = 0; c < most; c++) line += wide[c] + (c ? GAP : 0);
    for (int i = 0; i < line; i++) fputc('-', o->to);
    fputc('\n', o->to);
    for (size_t i = 1; i < count; i++) print_row(o, &rows[i], wide, most, false);
    o->blank = false;
    leave_blank(o);
  }
  free(read.at);
  return fine ? at : NULL;
}

/* ---- printing a text ---- */

bool cli_markdown_print(const char *start, size_t length, int width, bool bold, FILE *to) {
  printer o = {.to = to, .width = width < 20 ? 20 : width, .bold = bold, .blank = true};
  const char *at = start, *end = at + length;
  while (at && at < end) {
    part line = line_at(at, end);
    if (is_empty(line)) {
      leave_blank(&o);
      at = after(line, end);
    } else if (begins(line, "![")) at = after(line, end);
    else if (begins(line, "```")) at = print_code(&o, at, end);
    else if (begins(line, "|")) at = print_table(&o, at, end);
    else if (level(line)) at = print_heading(&o, at, end);
    else at = print_text(&o, at, end);
  }
  free(o.source.at);
  free(o.plain.at);
  return at != NULL;
}

void cli_markdown_print_line(const char *start, size_t length, FILE *to) {
  printer o = {.to = to};
  bool bold = false;
  if (add_plain(&o.plain, (part){start, start + length}))
    print_words(&o, (part){o.plain.at, o.plain.at + o.plain.length}, &bold);
  free(o.plain.at);
}
