/* Searches the manual, whose text is part of the command. The Makefile joins the pages of manual/ into one text, with a
 * line "\001PATH" before each page. markdown.c prints it. */
#include "cli/prompt/manual.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "cli/nearby.h"
#include "cli/prompt/editor.h"
#include "cli/prompt/markdown.h"
#include "cli/prompt/stems.h"

extern const char vs_manual_text[], vs_manual_text_end[];

/* Paths within the manual: its folder, the page of common tasks, and the page that links the trade's words to
 * sections. */
#define MANUAL "manual/"
#define TASKS "i-want-to"
#define INDEX "studio"

typedef struct { const char *at, *end; } part;

static part line_at(const char *at) {
  const char *end = memchr(at, '\n', (size_t)(vs_manual_text_end - at));
  return (part){at, end ? end : vs_manual_text_end};
}
static const char *after(part line) { return line.end < vs_manual_text_end ? line.end + 1 : line.end; }

static int level(part line) { return cli_markdown_level(line.at, (size_t)(line.end - line.at)); }

/* Returns true if the heading is that of the name's entry, `name` or `(name argument ...)`. */
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

/* Prints the text from a heading up to the next heading of the same or a higher level. With whole_page, prints up to
 * the end of the page. */
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

/* Returns true if the line is an item of a list of calls, such as "- `(make-box p q)`, `(make-wedge p q)`: ...", and
 * one of the calls has this name. */
static bool calls(part line, const char *name) {
  if (line.end - line.at < 4 || memcmp(line.at, "- `", 3) != 0) return false;
  bool code = false;
  const char *p = line.at;
  for (; p < line.end && (code || *p != ':'); p++) code = code != (*p == '`');
  return describes((part){line.at, p}, name);
}

/* Returns the first line of the page with the name `word`. If there is no such page, returns the first line of a page
 * whose list of calls ("- `(make-box p q)`: ...") contains the name, or NULL. */
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

/* Returns true if the line begins a page that is seldom useful to people who write models: a page about the sources, or
 * a list of words. */
static bool is_inside(part line) {
  static const char *const inside[] = { "internals/", "glossary.", "walk.", "back-ends.", "embedding.", "README." };
  for (size_t i = 0; i < sizeof inside / sizeof *inside; i++) {
    size_t n = strlen(inside[i]), folder = strlen(MANUAL);
    if ((size_t)(line.end - line.at) > folder + n && !memcmp(line.at + 1 + folder, inside[i], n)) return true;
  }
  return false;
}

/* A word or phrase for which the manual is searched: its words as typed, and the stems of its words. */
typedef struct { cli_stems stems; cli_phrase exact, stem; } wanted;

/* Begins the search for a word. The caller ends it by cli_stems_close. */
static void want(wanted *w, const char *word) {
  cli_stems_open(&w->stems);
  w->exact = cli_phrase_of(NULL, word, strlen(word));
  w->stem = cli_phrase_of(&w->stems, word, strlen(word));
}

static bool exact_is(const wanted *w, part text) {
  return cli_phrase_is(NULL, &w->exact, text.at, (size_t)(text.end - text.at));
}

static bool stem_in(const wanted *w, part text) {
  return cli_phrase_in(&w->stems, &w->stem, text.at, (size_t)(text.end - text.at));
}
static bool stem_is(const wanted *w, part text) {
  return cli_phrase_is(&w->stems, &w->stem, text.at, (size_t)(text.end - text.at));
}

/* Sets of pages, in which a search for headings is done one after another. */
typedef enum { PAGES_TASKS, PAGES_MODELS, PAGES_INSIDE } pages;

/* Returns the first heading of these pages that contains the searched words, or with `stem` their stems. Returns NULL
 * if there is none. */
static const char *find_heading(const wanted *w, pages which, bool stem) {
  bool on = false;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    if (*line.at == '\001')
      on = which == PAGES_TASKS ? same(page_name(line), TASKS) : is_inside(line) == (which == PAGES_INSIDE);
    else if (on && level(line) && (stem ? stem_in(w, line) : cli_phrase_in(NULL, &w->exact, line.at,
                                                                           (size_t)(line.end - line.at)))) return at;
    at = after(line);
  }
  return NULL;
}

static const char *find_section(const wanted *w) {
  static const pages order[] = { PAGES_TASKS, PAGES_MODELS, PAGES_INSIDE };
  for (size_t i = 0; i < sizeof order / sizeof *order; i++)
    for (int stem = 0; stem < 2; stem++) {
      const char *found = find_heading(w, order[i], stem);
      if (found) return found;
    }
  return NULL;
}

/* Returns the first line of the page whose name has the stems of the searched words, or NULL. */
static const char *find_page_by_stem(const wanted *w) {
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at == '\001' && !is_inside(line) && stem_is(w, page_name(line))) return at;
  }
  return NULL;
}

/* ---- tables in which words are explained ---- */

/* Splits a row of a table, "| several, words | text |". Returns false for other lines. */
static bool row_of(part line, part *words, part *text) {
  if (line.end - line.at < 6 || memcmp(line.at, "| ", 2) != 0 || memcmp(line.end - 2, " |", 2) != 0) return false;
  const char *bar = memchr(line.at + 2, '|', (size_t)(line.end - line.at - 2));
  if (!bar || bar + 2 >= line.end - 2 || bar[-1] != ' ') return false;
  *words = (part){ line.at + 2, bar - 1 };
  *text = (part){ bar + 2, line.end - 2 };
  return true;
}

/* Returns the next word of a cell such as "point, gvector", and moves cell->at past the word. */
static part next_word(part *cell) {
  const char *comma = memchr(cell->at, ',', (size_t)(cell->end - cell->at));
  part word = { cell->at, comma ? comma : cell->end };
  cell->at = comma ? comma + 1 : cell->end;
  while (word.at < word.end && *word.at == ' ') word.at++;
  return word;
}

static bool has_word(part cell, const wanted *w, bool stem) {
  while (cell.at < cell.end) {
    part word = next_word(&cell);
    if (stem ? stem_is(w, word) : exact_is(w, word)) return true;
  }
  return false;
}

/* Searches a page's table for a row whose first cell contains the searched word or, with `stem`, its stem. Returns the
 * second cell of the row, and sets *words to the first cell. If there is no such row, the result's `at` is NULL. */
static part find_row_by(const char *page, const wanted *w, bool stem, part *words) {
  bool on = false;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at), text;
    at = after(line);
    if (*line.at == '\001') on = same(page_name(line), page);
    if (on && row_of(line, words, &text) && has_word(*words, w, stem)) return text;
  }
  return (part){ NULL, NULL };
}

/* Searches as find_row_by does, first for the word, then for its stem. name: the word is a name of the language, whose
 * stem is not searched: `draw` must not find "drawing". */
static part find_row(const char *page, const wanted *w, bool name, part *words) {
  part text = find_row_by(page, w, false, words);
  return text.at || name ? text : find_row_by(page, w, true, words);
}

/* Prints the explanation of a word from the page of words for beginners, such as "radian: the angle whose ...". Returns
 * false if the page does not contain the word. */
static bool print_meaning(const wanted *w, bool name, FILE *to) {
  char text[600];
  part words, meaning = find_row("words", w, name, &words);
  if (!meaning.at) return false;
  int n = snprintf(text, sizeof text, "%.*s: %.*s\n", (int)(words.end - words.at), words.at,
                   (int)(meaning.end - meaning.at), meaning.at);
  if (n < 0 || (size_t)n >= sizeof text) return false;
  return cli_markdown_print(text, (size_t)n, cli_terminal_width(), to == stdout && cli_colours(1), to);
}

/* ---- the index: links of the page of the trade's words ---- */

/* Returns true if the heading has this anchor: its letters, digits and hyphens in lower case, and a hyphen for each
 * blank. */
static bool has_anchor(part heading, part anchor) {
  const char *p = heading.at + level(heading) + 1, *a = anchor.at;
  for (; p < heading.end; p++) {
    char c = *p == ' ' ? '-' : (char)tolower((unsigned char)*p);
    if (!isalnum((unsigned char)c) && c != '-' && c != '_' && (unsigned char)c < 0x80) continue;
    if (a == anchor.end || *a++ != c) return false;
  }
  return a == anchor.end;
}

/* Returns the place to which a link leads: the first line of a page, or a heading. NULL if there is none. */
static const char *find_link(part link) {
  const char *sharp = memchr(link.at, '#', (size_t)(link.end - link.at));
  part path = { link.at, sharp ? sharp : link.end }, anchor = { sharp ? sharp + 1 : link.end, link.end };
  size_t folder = strlen(MANUAL), n = (size_t)(path.end - path.at);
  bool on = false;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    const char *next = after(line);
    if (*line.at == '\001') {
      if (on) return NULL;
      on = (size_t)(line.end - line.at) == 1 + folder + n && !memcmp(line.at + 1 + folder, path.at, n);
      if (on && anchor.at == anchor.end) return next;
    } else if (on && level(line) && has_anchor(line, anchor)) return at;
    at = next;
  }
  return NULL;
}

/* Returns the target of the first link in [text.at, text.end), and moves text.at past the link. */
static part next_link(part *text) {
  for (const char *p = text->at; p + 1 < text->end; p++) {
    if (p[0] != ']' || p[1] != '(') continue;
    const char *end = memchr(p, ')', (size_t)(text->end - p));
    if (!end) break;
    text->at = end + 1;
    return (part){ p + 2, end };
  }
  return (part){ NULL, NULL };
}

/* If `place` is the first line of a page, returns the line before this line, which has the page's path after the byte
 * 1. */
static part page_of(const char *place) {
  const char *p = place - 1;
  while (p > vs_manual_text && p[-1] != '\n') p--;
  return line_at(p);
}

/* Prints a line with the command that shows the place: `vs help "a roof"`, or at the prompt `,help a roof`. */
static void print_call(const char *place, const char *how, FILE *to) {
  part line = page_of(place), heading = line_at(place);
  bool page = *line.at == '\001';
  const char *quote = page || *how == ',' ? "" : "\"";
  heading.at += level(heading) + 1;
  if (page) heading = page_name(line);
  fprintf(to, "  %s %s", how, quote);
  cli_markdown_print_line(heading.at, (size_t)(heading.end - heading.at), to);
  fprintf(to, "%s\n", quote);
}

/* Parts of the manual that the search has already printed: an entry and a page; NULL: none. */
typedef struct { const char *entry, *page; } printed;

/* Prints the sections to which a row of the index (text) links. Prints the section of the first link, unless another
 * text was already printed. For all other links, prints the commands that show them. */
static void print_index(part text, const printed *done, const char *how, FILE *to) {
  bool whole = !done->entry && !done->page, first = true;
  part link;
  while (text.at && (link = next_link(&text)).at) {
    const char *place = find_link(link);
    if (!place || place == done->entry || place == done->page) continue;
    if (whole) {
      print_section(place, to, *page_of(place).at == '\001');
      whole = false;
      continue;
    }
    if (first) fputs("\nRead on:\n", to);
    first = false;
    print_call(place, how, to);
  }
}

static bool print_wanted(const wanted *w, const char *word, const char *how, FILE *to) {
  printed done = { find_entry(word), find_page(word) };
  part words, listed = find_row(INDEX, w, done.entry != NULL, &words);
  bool known = print_meaning(w, done.entry != NULL, to);
  if (!done.entry && !done.page && !listed.at) done.page = find_page_by_stem(w);
  if (known && (done.entry || done.page || listed.at)) fputc('\n', to);
  if (done.entry && print_section(done.entry, to, false) && done.page) fputc('\n', to);
  if (done.page) print_section(done.page, to, true);
  print_index(listed, &done, how, to);
  if (known || done.entry || done.page || listed.at) return true;
  const char *section = find_section(w);
  if (section) print_section(section, to, false);
  return section != NULL;
}

bool cli_manual_print(const char *word, const char *how, FILE *to) {
  if (!*word) return false;
  wanted w;
  want(&w, word);
  bool found = print_wanted(&w, word, how, to);
  cli_stems_close(&w.stems);
  return found;
}

bool cli_manual_near(const char *word, char *room, size_t size) {
  cli_nearby near = cli_nearby_start(word);
  bool on = false, found = false;
  char name[48];
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at), words, text;
    at = after(line);
    if (*line.at == '\001') on = same(page_name(line), INDEX);
    if (!on || !row_of(line, &words, &text)) continue;
    while (words.at < words.end) {
      part one = next_word(&words);
      if (snprintf(name, sizeof name, "%.*s", (int)(one.end - one.at), one.at) >= (int)sizeof name) continue;
      near.best = NULL; /* forgets the name, since the next word overwrites it; the distance remains valid */
      cli_nearby_offer(&near, name);
      if (near.best) found = (size_t)snprintf(room, size, "%s", name) < size;
    }
  }
  return found;
}

bool cli_manual_describes(const char *word) { return find_entry(word) || find_page(word); }

void cli_manual_see_also(const char *word, FILE *to) {
  wanted w;
  want(&w, word);
  part words, listed = find_row(INDEX, &w, true, &words);
  print_index(listed, &(printed){ vs_manual_text, vs_manual_text }, "vs help", to);
  cli_stems_close(&w.stems);
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

size_t cli_manual_mentions(const char *word, FILE *to) {
  wanted w;
  want(&w, word);
  part page = {vs_manual_text, vs_manual_text}, heading = page;
  bool told = false, any = false, code = false;
  size_t count = 0;
  for (const char *at = vs_manual_text; at < vs_manual_text_end;) {
    part line = line_at(at);
    at = after(line);
    if (*line.at == '\001') page = page_name(line), heading = (part){line.at, line.at}, told = code = false;
    else {
      if (line.end - line.at >= 3 && !memcmp(line.at, "```", 3)) code = !code;
      if (!code && level(line)) heading = (part){line.at + level(line) + 1, line.end}, told = false;
      if (!told && count < 12 && stem_in(&w, line)) {
        if (!any) fprintf(to, "%s is in these sections of the manual (vs help PAGE, or ,help PAGE):\n", word);
        fprintf(to, "  %.*s: ", (int)(page.end - page.at), page.at);
        part shown = heading.at < heading.end ? heading : line;
        cli_markdown_print_line(shown.at, (size_t)(shown.end - shown.at), to);
        fputc('\n', to);
        told = any = true;
        count++;
      }
    }
  }
  cli_stems_close(&w.stems);
  return count;
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
