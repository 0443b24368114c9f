/* Searches the manual, which is part of the command. The Makefile joins the pages of manual/ into one text, with a line
 * "\001PATH" before each. markdown.c prints it. */
#include "cli/prompt/manual.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "cli/prompt/editor.h"
#include "cli/prompt/markdown.h"

extern const char vs_manual_text[], vs_manual_text_end[];

typedef struct { const char *at, *end; } part;

static part line_at(const char *at) {
  const char *end = memchr(at, '\n', (size_t)(vs_manual_text_end - at));
  return (part){at, end ? end : vs_manual_text_end};
}
static const char *after(part line) { return line.end < vs_manual_text_end ? line.end + 1 : line.end; }

static int level(part line) { return cli_markdown_level(line.at, (size_t)(line.end - line.at)); }

static bool is_word_of(part line, const char *word) { /* returns true if the line contains the word as a whole; upper
                                                       * and lower case are the same */
  size_t n = strlen(word);
  for (const char *p = line.at; n && p + n <= line.end; p++) {
    if (strncasecmp(p, word, n) != 0) continue;
    bool before = p == line.at || !isalnum((unsigned char)p[-1]), behind = p + n == line.end ||
        !isalnum((unsigned char)p[n]);
    if (before && behind) return true;
  }
  return false;
}

/* Returns true if the heading describes the name, as `name` or `(name argument ...)`. */
static bool describes(part line, const char *name) {
  size_t n = strlen(name);
  for (const char *p = line.at; p + 1 < line.end; p++) {
    if (*p != '`') continue;
    const char *q = p + 1 + (p[1] == '(');
    if (q + n <= line.end && !memcmp(q, name, n) && (q[n] == ' ' || q[n] == ')' || q[n] == '`')) return true;
    p = memchr(p + 1, '`', (size_t)(line.end - p - 1));
    if (!p) return false;
  }
  return false;
}

/* ---- printing a section ---- */

/* Prints the text from a heading to the next one of the same or a higher level. With whole_page, prints to the end of
 * the page. */
static bool print_section(const char *at, FILE *to, bool whole_page) {
  const char *from = at;
  bool code = false;
  int top = level(line_at(at));
  while (at < vs_manual_text_end) {
    part line = line_at(at);
    int depth = code ? 0 : level(line);
    if (*line.at == '\001' || (at > from && depth && !whole_page && depth <= top)) break;
    if (line.end - line.at >= 3 && !memcmp(line.at, "```", 3)) code = !code;
    at = after(line);
  }
  bool bold = to == stdout && cli_colours(1);
  return cli_markdown_print(from, (size_t)(at - from), cli_terminal_width(), bold, to);
}

/* ---- searching the pages ---- */

/* Returns the name of a page: "points" for language/points.md, "language" for language/README.md. */
static part page_name(part line) {
  const char *from = line.at + 1, *to = line.end, readme[] = "/README.md";
  size_t n = sizeof readme - 1;
  if ((size_t)(to - from) > n && !memcmp(to - n, readme, n)) to -= n;
  else if (to - from > 3) to -= 3;
  for (const char *p = from; p < to; p++)
    if (*p == '/') from = p + 1;
  return (part){from, to};
}

static bool same(part p, const char *word) {
  return (size_t)(p.end - p.at) == strlen(word) && !strncasecmp(p.at, word, strlen(word));
}

/* Returns the heading of the entry for a name of the language, or NULL. */
static const char *find_entry(const char *word) {
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    if (level(line) == 3 && describes(line, word)) return at;
    at = after(line);
  }
  return NULL;
}

/* Returns true if the line is an item of a list of calls, "- `(make-box p q)`, `(make-wedge p q)`: ...", and one of
 * them calls the name. */
static bool calls(part line, const char *name) {
  if (line.end - line.at < 4 || memcmp(line.at, "- `", 3) != 0) return false;
  bool code = false;
  const char *p = line.at;
  for (; p < line.end && (code || *p != ':'); p++) code = code != (*p == '`');
  return describes((part){line.at, p}, name);
}

/* Returns the first line of the page with that name. If there is none, returns that of a page whose list of calls ("-
 * `(make-box p q)`: ...") contains the name, or NULL. */
static const char *find_page(const char *word) {
  const char *page = NULL, *called = NULL;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at == '\001') {
      if (same(page_name(line), word)) return at;
      page = at;
    } else if (!called && calls(line, word)) called = page;
  }
  return called;
}

static const char *find_section(const char *word) {
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    if (level(line) && is_word_of(line, word)) return at;
    at = after(line);
  }
  return NULL;
}

/* Returns true if a cell such as "point, gvector" contains the word, in singular or plural ("radians" for "radian"). */
static bool has_word(part cell, const char *word) {
  size_t n = strlen(word);
  for (const char *p = cell.at; p < cell.end;) {
    const char *comma = memchr(p, ',', (size_t)(cell.end - p)), *end = comma ? comma : cell.end;
    size_t length = (size_t)(end - p);
    bool several = n == length + 1 && (word[length] == 's' || word[length] == 'S');
    if (length && !strncasecmp(p, word, length) && (n == length || several)) return true;
    p = comma ? comma + 1 : end;
    while (p < cell.end && *p == ' ') p++;
  }
  return false;
}

/* Prints the explanation of a word from the page of words for beginners: "radian: the angle whose ...". Returns false
 * if the page lacks the word. */
static bool print_meaning(const char *word, FILE *to) {
  bool on = false;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at == '\001') on = same(page_name(line), "words");
    if (!on || line.end - line.at < 6 || memcmp(line.at, "| ", 2) != 0) continue;
    part cell = { line.at + 2, memchr(line.at + 2, '|', (size_t)(line.end - line.at - 2)) };
    char text[600];
    if (!cell.end || cell.end[-1] != ' ' || !has_word((part){ cell.at, cell.end - 1 }, word)) continue;
    const char *meaning = cell.end + 2, *end = line.end - 2; /* end: before the last " |" */
    int n = meaning < end ? snprintf(text, sizeof text, "%.*s: %.*s\n", (int)(cell.end - 1 - cell.at), cell.at,
                                     (int)(end - meaning), meaning) : -1;
    if (n < 0 || (size_t)n >= sizeof text) continue;
    return cli_markdown_print(text, (size_t)n, cli_terminal_width(), to == stdout && cli_colours(1), to);
  }
  return false;
}

bool cli_manual_print(const char *word, FILE *to) {
  if (!*word) return false;
  const char *entry = find_entry(word), *page = find_page(word);
  bool known = print_meaning(word, to);
  if (known && (entry || page)) fputc('\n', to);
  if (entry) {
    if (print_section(entry, to, false) && page) fputc('\n', to);
  }
  if (page) print_section(page, to, true);
  if (known || entry || page) return true;
  const char *section = find_section(word);
  if (section) print_section(section, to, false);
  return section != NULL;
}

bool cli_manual_command(const char *word, FILE *to) {
  char call[40];
  size_t n = (size_t)snprintf(call, sizeof call, "`vs %s", word);
  for (const char *at = vs_manual_text; at < vs_manual_text_end && n < sizeof call;) {
    part line = line_at(at);
    if (level(line))
      for (const char *p = line.at; p + n < line.end; p++)
        if (!memcmp(p, call, n) && (p[n] == ' ' || p[n] == '`')) return print_section(at, to, level(line) == 1);
    at = after(line);
  }
  return false;
}

void cli_manual_mentions(const char *word, FILE *to) {
  part page = {vs_manual_text, vs_manual_text}, heading = page;
  bool told = false, any = false, code = false;
  int count = 0;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at == '\001') page = page_name(line), heading = (part){line.at, line.at}, told = code = false;
    else {
      if (line.end - line.at >= 3 && !memcmp(line.at, "```", 3)) code = !code;
      if (!code && level(line)) heading = (part){line.at + level(line) + 1, line.end}, told = false;
      if (!told && count < 12 && is_word_of(line, word)) {
        if (!any) fputs("in the manual (vs help PAGE, or ,help PAGE):\n", to);
        fprintf(to, "  %.*s: ", (int)(page.end - page.at), page.at);
        part shown = heading.at < heading.end ? heading : line;
        cli_markdown_print_line(shown.at, (size_t)(shown.end - shown.at), to);
        fputc('\n', to);
        told = any = true;
        count++;
      }
    }
  }
}

void cli_manual_topics(FILE *to) {
  fputs("vs help WORD shows the manual's text on a name, a page or a topic. Pages:\n ", to);
  int column = 1, width = cli_terminal_width();
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at != '\001') continue;
    part name = page_name(line);
    if (column + 1 + (name.end - name.at) > width) fputs("\n ", to), column = 1;
    fprintf(to, " %.*s", (int)(name.end - name.at), name.at);
    column += (int)(name.end - name.at) + 1;
  }
  fputc('\n', to);
}
