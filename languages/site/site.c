/* Writes the pages of `vs doc` (site.h) in XHTML 1.0 Strict: functions, variables, statements, the overview, and the
 * text of each file. In the texts, every name links to its definition. The anchor of a symbol is s followed by its
 * index; that of a line is L followed by its number. */
#include "languages/site/site.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "languages/analysis/first_calls.h"
#include "languages/analysis/notation.h"
#include "languages/site/site_assets.h"
#include "languages/analysis/tree_report.h"
#include "model/store/array.h"

enum { PATH_ROOM = 4096, SAID = 160 /* SAID: bytes of a comment in a result of the search */, REFERENCES = 40 };

typedef struct {
  knowledge *k;
  const char *folder, *title;
  bool *pictured; size_t pictured_room; /* pictured[s]: whether symbol s has a picture */
  bool shown;                           /* whether there is a picture of the whole model */
} site;

/* ---- text ---- */

static void puts_to(FILE *f, const char *text) { know_xml_text(f, text, strlen(text)); }

static bool is_shown(const know_symbol *s) { return s->definition && !s->made; }
static bool is_function(const know_symbol *s) {
  return s->kind == KNOW_FUNCTION || s->kind == KNOW_RULE || s->kind == KNOW_MACRO;
}

static void link_symbol(FILE *f, const knowledge *k, know_index symbol) {
  const know_symbol *s = &k->symbols[symbol];
  fprintf(f, "<a href=\"%s.html#s%u\">", is_function(s) ? "functions" : "variables", (unsigned)symbol);
  puts_to(f, s->text);
  fputs("</a>", f);
}

static void link_place(FILE *f, const knowledge *k, const know_place *at, bool name) {
  fprintf(f, "<a href=\"file-%u.html#L%u\">", (unsigned)at->file + 1, (unsigned)at->line);
  if (name) puts_to(f, k->files[at->file].path), fputc(':', f);
  fprintf(f, "%u</a>", (unsigned)at->line);
}

/* Writes a line of a comment. Text between backquotes is code. */
static void put_line(FILE *f, const char *text, size_t n) {
  bool code = false;
  for (size_t i = 0; i < n;) {
    const char *tick = memchr(text + i, '`', n - i);
    size_t end = tick ? (size_t)(tick - text) : n;
    know_xml_text(f, text + i, end - i);
    if (!tick) break;
    if (!code && !memchr(tick + 1, '`', n - end - 1)) fputc('`', f);
    else fputs(code ? "</code>" : "<code>", f), code = !code;
    i = end + 1;
  }
}

/* Writes comments as paragraphs; comment lines without text separate them. Indented lines after an empty line, or after
 * other indented lines, keep their line ends and blanks. */
static void put_comments(FILE *f, const knowledge *k, know_index first, know_index end) {
  enum { CLOSED, PARAGRAPH, AS_WRITTEN } open = CLOSED;
  static const char *const close[] = {"", "</p>\n", "</pre>\n"};
  for (know_index i = first; i && i < end; i++) {
    size_t n, length;
    const char *text = know_comment_text(k, i, &n), *stop = text + n;
    if (!n) fputs(close[open], f), open = CLOSED;
    for (size_t inwards = 0; text < stop; text += length + (text + length < stop)) {
      const char *before = text;
      length = strcspn(text, "\n");
      if (length > (size_t)(stop - text)) length = (size_t)(stop - text);
      if (k->script)
        while (length && strchr(" \t*", *text)) text++, length--;
      while (before > k->files[k->comments[i].file].text && before[-1] == ' ') before--;
      inwards = (size_t)(text - before);
      bool as_written = open != PARAGRAPH && inwards > 2;
      if (open == AS_WRITTEN && !as_written) fputs(close[open], f), open = CLOSED;
      fputs(open == CLOSED ? as_written ? "<pre>" : "<p>" : open == AS_WRITTEN ? "\n" : " ", f);
      if (as_written) know_xml_text(f, text, length), open = AS_WRITTEN;
      else put_line(f, text, length), open = PARAGRAPH;
    }
  }
  fputs(close[open], f);
}

/* ---- pages ---- */

static bool is_of_program(const knowledge *k, const char *path) {
  struct stat page, file;
  if (stat(path, &page) != 0) return false;
  for (size_t i = 0; i < k->file_count; i++)
    if (stat(k->files[i].path, &file) == 0 && page.st_dev == file.st_dev && page.st_ino == file.st_ino) return true;
  return false;
}

static FILE *open_file(site *s, const char *name) {
  char path[PATH_ROOM];
  int n = snprintf(path, sizeof path, "%s/%s", s->folder, name);
  if (n > 0 && n < PATH_ROOM && is_of_program(s->k, path))
    return know_fail(s->k, NULL, VS_OUTCOME_USAGE, "%s: the pages would take the place of a file of the program; -o "
                     "names another folder", path), NULL;
  FILE *f = n > 0 && n < PATH_ROOM ? fopen(path, "w") : NULL;
  if (!f) know_fail(s->k, NULL, VS_OUTCOME_USAGE, "%s/%s: %s", s->folder, name, strerror(errno));
  return f;
}

static bool close_file(site *s, FILE *f, const char *name) {
  bool ok = !ferror(f);
  if (fclose(f) == 0 && ok) return true;
  return know_fail(s->k, NULL, VS_OUTCOME_USAGE, "%s/%s: %s", s->folder, name, strerror(errno));
}

static FILE *open_page(site *s, const char *name, const char *title) {
  static const char *const pages[][2] = {
    {"index.html", "overview"}, {"functions.html", "functions"}, {"variables.html", "variables"},
    {"statements.html", "statements"}, {"files.html", "files"}};
  FILE *f = open_file(s, name);
  if (!f) return NULL;
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE html PUBLIC \"-//W3C//DTD XHTML 1.0 Strict//EN\" "
        "\"http://www.w3.org/TR/xhtml1/DTD/xhtml1-strict.dtd\">\n"
        "<html xmlns=\"http://www.w3.org/1999/xhtml\" xml:lang=\"en\" lang=\"en\">\n<head>\n"
        "<meta http-equiv=\"Content-Type\" content=\"text/html; charset=utf-8\" />\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n<title>", f);
  puts_to(f, title);
  fputs("</title>\n<link rel=\"stylesheet\" type=\"text/css\" href=\"style.css\" />\n</head>\n<body>\n"
        "<div id=\"head\"><div><span class=\"name\">", f);
  puts_to(f, s->title);
  fputs("</span>\n", f);
  for (size_t i = 0; i < sizeof pages / sizeof *pages; i++)
    fprintf(f, "<a href=\"%s\">%s</a>\n", pages[i][0], pages[i][1]);
  fputs("<input id=\"search\" type=\"text\" title=\"search\" /></div></div>\n<div id=\"hits\"></div>\n"
        "<div id=\"body\">\n<h1>", f);
  puts_to(f, title);
  fputs("</h1>\n", f);
  return f;
}

static bool close_page(site *s, FILE *f, const char *name) {
  fputs("</div>\n<script type=\"text/javascript\" src=\"search-index.js\"></script>\n"
        "<script type=\"text/javascript\" src=\"search.js\"></script>\n</body>\n</html>\n", f);
  return close_file(s, f, name);
}

/* ---- symbols ---- */

/* Writes a link to each line that uses the symbol. */
static void put_uses(FILE *f, const knowledge *k, const know_symbol *s) {
  uint32_t last = 0, file = UINT32_MAX, n = 0;
  for (know_index u = s->first_use; u; u = k->uses[u].next) {
    const know_place *at = &k->nodes[k->uses[u].node].at;
    if (k->uses[u].role == KNOW_DEFINITION || (at->line == last && at->file == file)) continue;
    if (n == REFERENCES) {
      fputs(" ...", f);
      break;
    }
    fputs(n++ ? ", " : "used in ", f);
    link_place(f, k, at, at->file != file && k->file_count > 1);
    last = at->line, file = at->file;
  }
  if (!n) fputs("not used", f);
}

/* writes a call of a script's function, such as f(a, b) */
static void put_script_call(FILE *f, const knowledge *k, const know_symbol *s) {
  know_index p = s->parameters ? k->nodes[s->parameters].first : 0;
  bool begun = false;
  if (p && p == s->definition) p = k->nodes[p].next;
  puts_to(f, s->text);
  fputc('(', f);
  for (; p; p = k->nodes[p].next) {
    if (k->nodes[s->parameters].dotted && !k->nodes[p].next) break; /* skips the rest parameter `arguments`, which the
                                                                     * text does not contain */
    if (begun) fputs(", ", f);
    puts_to(f, k->names[k->nodes[p].name].text);
    begun = true;
  }
  fputc(')', f);
}

/* Writes a call of the symbol, with its name and parameters as the text has them. */
static void put_call(FILE *f, const knowledge *k, const know_symbol *s) {
  size_t n = 0;
  if (k->script) {
    put_script_call(f, k, s);
    return;
  }
  if (s->rules && s->value) { /* for a macro of define-syntax-rule, writes its pattern */
    const char *pattern = know_spelling(k, s->value, &n);
    know_xml_text(f, pattern, n);
    return;
  }
  const char *text = s->parameters ? know_spelling(k, s->parameters, &n) : NULL;
  fputc('(', f);
  puts_to(f, s->text);
  if (text && k->nodes[s->parameters].kind == KNOW_LIST) {
    bool whole = k->nodes[s->parameters].first == s->definition; /* whole: in (define (name x) ...), the first element
                                                                  * of the parameter list is the name */
    const char *inner = text + 1, *end = text + n - 1;
    if (whole) inner += strlen(s->text);
    while (inner < end && *inner == ' ') inner++;
    if (inner < end) fputc(' ', f), know_xml_text(f, inner, (size_t)(end - inner));
  } else if (text) fputs(" . ", f), know_xml_text(f, text, n);
  else
    for (know_index i = 1; i < k->symbol_count; i++)
      if (k->symbols[i].owner && &k->symbols[k->symbols[i].owner] == s) fputc(' ', f), puts_to(f, k->symbols[i].text);
  fputc(')', f);
}

/* Writes links to the functions of the program that the text of the symbol uses, each once. */
static void put_needs(FILE *f, const knowledge *k, know_index symbol) {
  const know_symbol *s = &k->symbols[symbol];
  const know_place *in = s->form ? &k->nodes[s->form].at : NULL;
  bool any = false;
  for (know_index i = 1; in && i < k->symbol_count; i++) {
    const know_symbol *other = &k->symbols[i];
    bool needed = false;
    if (i == symbol || !is_shown(other) || !is_function(other)) continue;
    for (know_index u = other->first_use; u && !needed; u = k->uses[u].next) {
      const know_place *at = &k->nodes[k->uses[u].node].at;
      needed = k->uses[u].role != KNOW_DEFINITION && at->file == in->file && at->from > in->from && at->to < in->to;
    }
    if (!needed) continue;
    fputs(any ? ", " : "<br />uses ", f);
    link_symbol(f, k, i);
    any = true;
  }
}

static void put_symbol(site *s, FILE *f, know_index i) {
  const knowledge *k = s->k;
  const know_symbol *y = &k->symbols[i];
  fprintf(f, "<div class=\"card\" id=\"s%u\">\n", (unsigned)i);
  if (s->pictured[i]) {
    fprintf(f, "<img src=\"pictures/s%u.png\" alt=\"what ", (unsigned)i);
    puts_to(f, y->text);
    fputs(" makes\" />\n", f);
  }
  fputs("<h3>", f);
  if (is_function(y)) put_call(f, k, y);
  else puts_to(f, y->text);
  fputs("</h3>\n", f);
  put_comments(f, k, y->comment, y->comment_end);
  if (y->doc_string) {
    size_t n;
    const char *text = know_spelling(k, y->doc_string, &n);
    fputs("<p>", f);
    know_xml_text(f, text + 1, n - 2);
    fputs("</p>\n", f);
  }
  if (y->value && !is_function(y)) {
    size_t n;
    const char *text = know_spelling(k, y->value, &n);
    fputs("<p><code>", f);
    know_xml_text(f, text, n < SAID ? n : strcspn(text, "\n") < SAID ? strcspn(text, "\n") : SAID / 2);
    fputs(n < SAID ? "</code></p>\n" : " ...</code></p>\n", f);
  }
  fprintf(f, "<p class=\"soft\">%s", know_symbol_word((know_symbol_kind)y->kind));
  if (y->owner) fputs(" of ", f), link_symbol(f, k, y->owner);
  fprintf(f, ", seen in the %s, defined in ", know_scope_word((know_scope_kind)k->scopes[y->scope].kind));
  link_place(f, k, &k->nodes[y->definition].at, true);
  fputs(", ", f);
  put_uses(f, k, y);
  if (y->hides) fputs("; hides another ", f), link_symbol(f, k, y->hides);
  if (is_function(y)) put_needs(f, k, i);
  fputs("</p>\n</div>\n", f);
}

static bool symbol_page(site *s, bool functions) {
  const char *name = functions ? "functions.html" : "variables.html";
  FILE *f = open_page(s, name, functions ? "Functions" : "Variables");
  bool any = false;
  if (!f) return false;
  for (int deep = 0; deep < 2; deep++) { /* first lists the symbols at top level, then those inside procedures and
                                          * lets */
    for (know_index i = 1; i < s->k->symbol_count; i++) {
      const know_symbol *y = &s->k->symbols[i];
      bool inner = s->k->scopes[y->scope].kind != KNOW_SCOPE_PROGRAM;
      if (!is_shown(y) || is_function(y) != functions || inner != deep) continue;
      if (inner && !any) fputs("<h2>Within procedures</h2>\n", f);
      if (inner) any = true;
      put_symbol(s, f, i);
    }
  }
  return close_page(s, f, name);
}

/* ---- statements, and equal parts of statements ---- */

enum { LEAST_ALIKE = 8 /* least number of nodes of a part that is searched for equal parts */ };
typedef struct { uint64_t hash; uint32_t nodes; know_index node; } alike;

static int by_hash(const void *a, const void *b) {
  const alike *p = a, *q = b;
  return p->hash != q->hash ? (p->hash < q->hash ? -1 : 1) : p->node < q->node ? -1 : p->node > q->node;
}
static int by_size(const void *a, const void *b) {
  const alike *p = a, *q = b;
  return p->nodes != q->nodes ? (p->nodes > q->nodes ? -1 : 1) : p->node < q->node ? -1 : p->node > q->node;
}

static uint64_t hash_bytes(uint64_t h, const char *text, size_t n) {
  for (size_t i = 0; i < n; i++) h = (h ^ (unsigned char)text[i]) * UINT64_C(0x100000001b3);
  return h;
}

/* Computes a hash of every tree in the texts. A node's children come after it in the array, so the loop runs
 * downwards. */
static void hash_trees(const knowledge *k, alike *of) {
  for (know_index i = (know_index)k->text_nodes; i > 0; i--) {
    const know_node *n = &k->nodes[i];
    uint64_t h = hash_bytes(UINT64_C(0xcbf29ce484222325), (const char *)&n->kind, 1);
    uint32_t nodes = 1;
    if (n->kind == KNOW_LIST || n->kind == KNOW_VECTOR)
      for (know_index c = n->first; c; c = k->nodes[c].next) {
        h = (h ^ of[c].hash ^ of[c].hash >> 31) * UINT64_C(0x9e3779b97f4a7c15);
        nodes += of[c].nodes;
      }
    else {
      size_t length;
      const char *text = know_spelling(k, i, &length);
      /* A word such as js:get has no text in the script, so its name is hashed. */
      if (!length && n->kind == KNOW_SYMBOL) text = k->names[n->name].text, length = strlen(text);
      h = hash_bytes(h, text, length);
    }
    of[i] = (alike){h, nodes, i};
  }
}

static void put_alike(FILE *f, const knowledge *k, const alike *group, size_t count) {
  size_t n;
  const char *text = know_spelling(k, group->node, &n);
  fprintf(f, "<div class=\"card\">\n<p class=\"soft\">%zu times: ", count);
  for (size_t i = 0; i < count && i < REFERENCES; i++) {
    if (i) fputs(", ", f);
    link_place(f, k, &k->nodes[group[i].node].at, true);
  }
  fputs("</p>\n<pre>", f);
  know_xml_text(f, text, n < 2000 ? n : strcspn(text, "\n"));
  fputs("</pre>\n</div>\n", f);
}

/* Writes groups of equal trees, the largest first. Omits a group whose trees are parts of those of a larger group with
 * the same count. */
static bool put_duplicates(site *s, FILE *f) {
  const knowledge *k = s->k;
  alike *of = NULL, *lists = NULL, *groups = NULL;
  size_t of_room = 0, list_room = 0, count = 0, group_room = 0, group_count = 0;
  bool ok = VS_GROW(of, of_room, k->text_nodes + 1) && VS_GROW(lists, list_room, k->text_nodes + 1) &&
            VS_GROW(groups, group_room, k->text_nodes + 1);
  if (ok) {
    hash_trees(k, of);
    for (know_index i = 1; i <= k->text_nodes; i++)
      if (k->nodes[i].kind == KNOW_LIST && k->nodes[i].parent && of[i].nodes >= LEAST_ALIKE) lists[count++] = of[i];
    if (count) qsort(lists, count, sizeof *lists, by_hash);
    for (size_t i = 0, next; i < count; i = next) {
      bool inner = true;
      for (next = i; next < count && lists[next].hash == lists[i].hash; next++) {
        know_index up = k->nodes[lists[next].node].parent, first = k->nodes[lists[i].node].parent;
        if (of[up].hash != of[first].hash) inner = false;
      }
      if (next - i > 1 && !(inner && k->nodes[lists[i].node].parent != k->nodes[lists[i + 1].node].parent))
        groups[group_count++] = (alike){i, lists[i].nodes, (know_index)(next - i)};
    }
    if (group_count) qsort(groups, group_count, sizeof *groups, by_size);
    fputs("<h2>Repeated code</h2>\n", f);
    if (!group_count) fputs("<p>No expression of eight words or more does.</p>\n", f);
    for (size_t i = 0; i < group_count && i < 100; i++) put_alike(f, k, &lists[groups[i].hash], groups[i].node);
  }
  free(of);
  free(lists);
  free(groups);
  return ok || know_fail(s->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
}

static bool statement_page(site *s) {
  const knowledge *k = s->k;
  FILE *f = open_page(s, "statements.html", "Statements");
  if (!f) return false;
  for (size_t i = 0; i < k->file_count; i++) {
    fputs("<h2>", f);
    puts_to(f, k->files[i].path);
    fputs("</h2>\n<div class=\"wide\"><table>\n<tr><th>line</th><th>statement</th></tr>\n", f);
    for (know_index n = k->nodes[k->files[i].root].first; n; n = k->nodes[n].next) {
      size_t length;
      const char *text = know_spelling(k, n, &length);
      size_t line = strcspn(text, "\n");
      fputs("<tr><td>", f);
      link_place(f, k, &k->nodes[n].at, false);
      fputs("</td><td><code>", f);
      know_xml_text(f, text, line < length ? line : length);
      fputs(line < length ? " ...</code></td></tr>\n" : "</code></td></tr>\n", f);
    }
    if (!k->nodes[k->files[i].root].first) fputs("<tr><td></td><td>none</td></tr>\n", f);
    fputs("</table></div>\n", f);
  }
  bool ok = put_duplicates(s, f);
  return close_page(s, f, "statements.html") && ok;
}

/* ---- texts ---- */

typedef struct { FILE *f; const know_file *file; size_t at; uint32_t line; } printer;

static void begin_line(printer *p) {
  p->line++;
  fprintf(p->f, "<span class=\"n\" id=\"L%u\">%u</span>", (unsigned)p->line, (unsigned)p->line);
}

/* Writes the text up to byte `to`, with the numbers of the lines that begin in it. */
static void print_to(printer *p, size_t to, const char *open, const char *close) {
  if (to > p->at) fputs(open, p->f);
  while (p->at < to) {
    size_t end = p->at;
    while (end < to && p->file->text[end] != '\n') end++;
    know_xml_text(p->f, p->file->text + p->at, end - p->at);
    p->at = end;
    if (end == to) break;
    p->at++;
    fprintf(p->f, "%s\n", close);
    if (p->at < p->file->size) begin_line(p);
    fputs(open, p->f);
    if (p->at >= to) break;
  }
  fputs(close, p->f);
}

static void print_node(printer *p, const knowledge *k, know_index i) {
  const know_node *n = &k->nodes[i];
  const know_symbol *y = n->symbol ? &k->symbols[n->symbol] : NULL;
  if (n->kind == KNOW_STRING || n->kind == KNOW_CHARACTER) print_to(p, n->at.to, "<span class=\"s\">", "</span>");
  else if (n->kind == KNOW_NUMBER || n->kind == KNOW_BOOLEAN) print_to(p, n->at.to, "<span class=\"d\">", "</span>");
  else if (y && is_shown(y)) {
    fprintf(p->f, "<a href=\"%s.html#s%u\">", is_function(y) ? "functions" : "variables", (unsigned)n->symbol);
    print_to(p, n->at.to, "", "");
    fputs("</a>", p->f);
  } else if (y && y->doc && *y->doc) {
    fputs("<span class=\"b\" title=\"", p->f);
    puts_to(p->f, y->doc);
    fputs("\">", p->f);
    print_to(p, n->at.to, "", "");
    fputs("</span>", p->f);
  } else print_to(p, n->at.to, "", "");
}

static bool file_page(site *s, know_index file, know_index *node) {
  const knowledge *k = s->k;
  char name[40];
  snprintf(name, sizeof name, "file-%u.html", (unsigned)file + 1);
  FILE *f = open_page(s, name, k->files[file].path);
  if (!f) return false;
  printer p = {f, &k->files[file], 0, 0};
  know_index comment = p.file->first_comment;
  fputs("<pre>", f);
  begin_line(&p);
  for (; *node <= k->text_nodes; ++*node) {
    const know_node *n = &k->nodes[*node];
    if (n->at.file != file) break;
    if (n->kind == KNOW_LIST || n->kind == KNOW_VECTOR || n->at.from < p.at || n->at.to <= n->at.from) continue;
    for (; comment < p.file->comment_end && k->comments[comment].from < n->at.from; comment++) {
      print_to(&p, k->comments[comment].from, "", "");
      print_to(&p, k->comments[comment].to, "<span class=\"c\">", "</span>");
    }
    print_to(&p, n->at.from, "", "");
    print_node(&p, k, *node);
  }
  for (; comment < p.file->comment_end; comment++) {
    print_to(&p, k->comments[comment].from, "", "");
    print_to(&p, k->comments[comment].to, "<span class=\"c\">", "</span>");
  }
  print_to(&p, p.file->size, "", "");
  fputs("</pre>\n", f);
  return close_page(s, f, name);
}

/* Writes the comment at the beginning of a file, up to the first empty line or statement. */
static void put_file_comment(FILE *f, const knowledge *k, const know_file *file) {
  know_index end = file->first_comment;
  while (end < file->comment_end && k->comments[end].alone &&
         (end == file->first_comment || k->comments[end].line == k->comments[end - 1].end_line + 1)) end++;
  know_index first = k->nodes[file->root].first;
  if (first && file->first_comment < end && k->comments[file->first_comment].from > k->nodes[first].at.from) return;
  put_comments(f, k, file->first_comment, end);
}

static bool files_page(site *s) {
  FILE *f = open_page(s, "files.html", "Files");
  if (!f) return false;
  for (size_t i = 0; i < s->k->file_count; i++) {
    const know_file *file = &s->k->files[i];
    fprintf(f, "<div class=\"card\"><h3><a href=\"file-%zu.html\">", i + 1);
    puts_to(f, file->path);
    fputs("</a></h3>\n", f);
    put_file_comment(f, s->k, file);
    fprintf(f, "<p class=\"soft\">%zu bytes", file->size);
    if (file->loaded_by) fputs(", loaded by ", f), link_place(f, s->k, &s->k->nodes[file->loaded_by].at, true);
    fputs("</p></div>\n", f);
  }
  return close_page(s, f, "files.html");
}

/* ---- the overview, and the search ---- */

static bool index_page(site *s) {
  const knowledge *k = s->k;
  FILE *f = open_page(s, "index.html", s->title);
  if (!f) return false;
  if (k->file_count) put_file_comment(f, k, &k->files[0]);
  if (s->shown) fputs("<p><img class=\"shown\" src=\"pictures/model.png\" alt=\"the model\" /></p>\n", f);
  bool any = false;
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (y->kind != KNOW_MODEL_PARAMETER || !is_shown(y)) continue;
    size_t n;
    const char *text = know_spelling(k, y->form, &n);
    if (!any) fputs("<h2>Parameters</h2>\n<div class=\"wide\"><table>\n<tr><th>name</th><th>as defined</th></tr>\n", f);
    any = true;
    fputs("<tr><td>", f);
    link_symbol(f, k, i);
    fputs("</td><td><code>", f);
    know_xml_text(f, text, n < 300 ? n : strcspn(text, "\n"));
    fputs("</code></td></tr>\n", f);
  }
  if (any) fputs("</table></div>\n", f);
  any = false;
  for (int pass = 0; pass < 2; pass++) { /* first lists the symbols that have a picture, then all others */
    bool begun = false;
    for (know_index i = 1; i < k->symbol_count; i++) {
      const know_symbol *y = &k->symbols[i];
      if (!is_shown(y) || !is_function(y) || k->scopes[y->scope].kind != KNOW_SCOPE_PROGRAM ||
          s->pictured[i] != !pass) continue;
      if (!any) fputs("<h2>Functions</h2>\n", f);
      if (!begun) fputs("<div class=\"grid\">\n", f);
      any = begun = true;
      fprintf(f, "<a href=\"functions.html#s%u\">", (unsigned)i);
      if (s->pictured[i]) fprintf(f, "<img src=\"pictures/s%u.png\" alt=\"\" />", (unsigned)i);
      fputs("<span>", f);
      puts_to(f, y->text);
      fputs("</span></a>\n", f);
    }
    if (begun) fputs("</div>\n", f);
  }
  return close_page(s, f, "index.html");
}

static bool search_index(site *s) {
  const knowledge *k = s->k;
  FILE *f = open_file(s, "search-index.js");
  if (!f) return false;
  fputs("var siteIndex=[\n", f);
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (!is_shown(y)) continue;
    char to[60];
    snprintf(to, sizeof to, "%s.html#s%u", is_function(y) ? "functions" : "variables", (unsigned)i);
    size_t n = 0;
    const char *said = y->comment ? know_comment_text(k, y->comment, &n) : "";
    const char *kind = know_symbol_word((know_symbol_kind)y->kind);
    if (n > SAID)
      for (n = SAID; n && ((unsigned char)said[n] & 0xc0) == 0x80;) n--;
    fputc('[', f);
    know_json_text(f, y->text, strlen(y->text));
    fputc(',', f);
    know_json_text(f, kind, strlen(kind));
    fprintf(f, ",\"%s\",", to);
    know_json_text(f, said, n);
    fputs("],\n", f);
  }
  fputs("];\n", f);
  return close_file(s, f, "search-index.js");
}

static bool asset(site *s, const char *name, const char *text) {
  FILE *f = open_file(s, name);
  if (!f) return false;
  fputs(text, f);
  return close_file(s, f, name);
}

/* ---- pictures ---- */

/* Returns true if the expression is in a text and uses no variable of a procedure or a let, so that it can be evaluated
 * at top level. */
static bool stands_alone(const knowledge *k, know_index node) {
  for (know_index i = node; i <= k->text_nodes && k->nodes[i].at.from < k->nodes[node].at.to &&
       k->nodes[i].at.file == k->nodes[node].at.file; i++) {
    know_index symbol = k->nodes[i].symbol;
    if (!symbol) continue;
    know_scope_kind scope = (know_scope_kind)k->scopes[k->symbols[symbol].scope].kind;
    if (scope != KNOW_SCOPE_PROGRAM && scope != KNOW_SCOPE_LANGUAGE) return false;
  }
  return node <= k->text_nodes;
}

/* Makes a picture of a procedure's result. First calls the procedure with its defaults. If this fails, uses the result
 * of the procedure's first call in the program. If this fails too, calls the procedure as the program does, if that
 * call uses only top-level variables. */
static bool picture_of(site *s, know_index symbol, know_picture *picture, void *context, const char *path) {
  const knowledge *k = s->k;
  const know_symbol *y = &k->symbols[symbol];
  char text[2000];
  if (y->arity.known && y->arity.least == 0) {
    snprintf(text, sizeof text, "(%.1900s)", y->text);
    if (picture(context, text, path)) return true;
  }
  if (know_remembers(k, symbol)) {
    know_first_result(symbol, text);
    if (picture(context, text, path)) return true;
  }
  int tries = 0;
  for (know_index u = y->first_use; u && tries < 3; u = k->uses[u].next) {
    know_index call = k->nodes[k->uses[u].node].parent;
    size_t n;
    if (!k->uses[u].called || !call || k->nodes[call].made || !stands_alone(k, call)) continue;
    const char *spelled = know_spelling(k, call, &n);
    if (n >= sizeof text) continue;
    memcpy(text, spelled, n);
    text[n] = 0;
    tries++;
    if (picture(context, text, path)) return true;
  }
  return false;
}

static bool take_pictures(site *s, know_picture *picture, void *context) {
  const knowledge *k = s->k;
  char path[PATH_ROOM];
  if (!VS_GROW(s->pictured, s->pictured_room, k->symbol_count + 1))
    return know_fail(s->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  memset(s->pictured, 0, (k->symbol_count + 1) * sizeof *s->pictured);
  if (!picture) return true;
  snprintf(path, sizeof path, "%s/pictures/model.png", s->folder);
  s->shown = picture(context, NULL, path);
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (!is_shown(y) || y->kind != KNOW_FUNCTION || k->scopes[y->scope].kind != KNOW_SCOPE_PROGRAM) continue;
    int n = snprintf(path, sizeof path, "%s/pictures/s%u.png", s->folder, (unsigned)i);
    if (n > 0 && n < PATH_ROOM) s->pictured[i] = picture_of(s, i, picture, context, path);
  }
  return true;
}

bool know_write_site(knowledge *k, const char *folder, const char *title, know_picture *picture, void *context) {
  site s = {.k = k, .folder = folder, .title = title};
  know_index node = 1;
  bool ok = take_pictures(&s, picture, context) && asset(&s, "style.css", know_site_style) &&
            asset(&s, "search.js", know_site_script) && search_index(&s) && index_page(&s) && symbol_page(&s, true) &&
            symbol_page(&s, false) && statement_page(&s) && files_page(&s);
  for (know_index i = 0; ok && i < k->file_count; i++) {
    while (node <= k->text_nodes && k->nodes[node].at.file != i) node++;
    ok = file_page(&s, i, &node);
  }
  free(s.pictured);
  return ok;
}
