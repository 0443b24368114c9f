/* Owns the manual that the command carries. The build joins the pages of manual/ into one text (Makefile): a line
 * "\001PATH" before each. Of Markdown it shows
 * what reads well in a terminal: headings, text, blocks of code indented. */
#include "cli/prompt/manual.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "cli/prompt/editor.h"

extern const char vs_manual_text[], vs_manual_text_end[];

typedef struct { const char *at, *end; } part;

static part line_at(const char *at) {
  const char *end = memchr(at, '\n', (size_t)(vs_manual_text_end - at));
  return (part){at, end ? end : vs_manual_text_end};
}
static const char *after(part line) { return line.end < vs_manual_text_end ? line.end + 1 : line.end; }

static int level(part line) {
  int n = 0;
  while (line.at + n < line.end && line.at[n] == '#') n++;
  return n && line.at + n < line.end && line.at[n] == ' ' ? n : 0;
}

static bool is_word_of(part line, const char *word) { /* anywhere in it, whatever the case, as a word of its own */
  size_t n = strlen(word);
  for (const char *p = line.at; n && p + n <= line.end; p++) {
    if (strncasecmp(p, word, n) != 0) continue;
    bool before = p == line.at || !isalnum((unsigned char)p[-1]), behind = p + n == line.end ||
        !isalnum((unsigned char)p[n]);
    if (before && behind) return true;
  }
  return false;
}

/* Is the name one of those a heading describes, `name` or `(name argument ...)`? */
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

/* ---- printing ---- */

static void print_inline(part line, FILE *to, int width, bool bold) {
  int column = 0;
  if (bold) fputs("\033[1m", to);
  for (const char *p = line.at; p < line.end;) {
    if (*p == '`') { p++; continue; }
    if (p + 1 < line.end && p[0] == '*' && p[1] == '*') { p += 2; continue; }
    if (*p == '[') { /* a link: its words alone */
      const char *close = memchr(p, ']', (size_t)(line.end - p)), *stop = close && close + 1 < line.end &&
          close[1] == '(' ? memchr(close, ')', (size_t)(line.end - close)) : NULL;
      if (stop) {
        for (const char *q = p + 1; q < close; q++) if (*q != '`') fputc(*q, to), column++;
        p = stop + 1;
        continue;
      }
    }
    if (*p == ' ') {
      int next = 1;
      while (p + next < line.end && p[next] != ' ') next++;
      if (column + next > width && column > 20) {
        fputs("\n  ", to);
        column = 2;
        p++;
        continue;
      }
    }
    fputc(*p++, to);
    column++;
  }
  if (bold) fputs("\033[0m", to);
  fputc('\n', to);
}

/* From a line to the next heading of its level or above, or the end of the page. */
static void print_section(const char *at, FILE *to, bool whole_page) {
  int width = to == stdout ? cli_terminal_width() - 1 : 100, top = 0;
  bool colours = to == stdout && cli_colours(1), code = false;
  for (bool first = true; at < vs_manual_text_end; first = false) {
    part line = line_at(at);
    if (*line.at == '\001') return;
    int depth = code ? 0 : level(line);
    if (first) top = depth;
    else if (depth && !whole_page && depth <= top) return;
    at = after(line);
    if (line.end - line.at >= 3 && !memcmp(line.at, "```", 3)) {
      code = !code;
      continue;
    }
    if (line.end - line.at >= 2 && !memcmp(line.at, "![", 2)) continue;
    if (code) fprintf(to, "    %.*s\n", (int)(line.end - line.at), line.at);
    else if (depth) print_inline((part){line.at + depth + 1, line.end}, to, 1000, colours);
    else if (line.at < line.end && *line.at == '|') fprintf(to, "%.*s\n", (int)(line.end - line.at), line.at);
    else print_inline(line, to, width, false);
  }
}

/* ---- looking up ---- */

/* The name of a page: language/points.md is points. */
static part page_name(part line) {
  const char *from = line.at + 1, *to = line.end;
  for (const char *p = from; p < to; p++)
    if (*p == '/') from = p + 1;
  if (to - from > 3) to -= 3;
  return (part){from, to};
}

static bool same(part p, const char *word) { return (size_t)(p.end - p.at) == strlen(word) && !strncasecmp(p.at,
    word, strlen(word)); }

bool cli_manual_print(const char *word, FILE *to) {
  if (!*word) return false;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) { /* a name of the language */
    part line = line_at(at);
    if (level(line) == 3 && describes(line, word)) {
      print_section(at, to, false);
      return true;
    }
    at = after(line);
  }
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) { /* a page */
    part line = line_at(at);
    at = after(line);
    if (*line.at == '\001' && same(page_name(line), word)) {
      print_section(at, to, true);
      return true;
    }
  }
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) { /* a section */
    part line = line_at(at);
    if (level(line) && is_word_of(line, word)) {
      print_section(at, to, false);
      return true;
    }
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
        print_inline(heading.at < heading.end ? heading : line, to, 100, false);
        told = any = true;
        count++;
      }
    }
  }
}

void cli_manual_topics(FILE *to) {
  fputs("vs help WORD shows what the manual has on a name of the language, a page or a topic. Pages:\n ", to);
  int column = 1;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at != '\001') continue;
    part name = page_name(line);
    if (column + (name.end - name.at) > 90) fputs("\n ", to), column = 1;
    fprintf(to, " %.*s", (int)(name.end - name.at), name.at);
    column += (int)(name.end - name.at) + 1;
  }
  fputc('\n', to);
}
