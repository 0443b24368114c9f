/* Reads a program's text into nodes with places and comments.
 *
 * The language's own reader reads the text first, and reports each error as a run would. The reader in this file
 * therefore receives only correct texts, and needs no messages. There are two readers because a run needs neither the
 * places of single names, nor comments, nor the spelling of numbers, and should not spend time on them. A stack of open
 * lists replaces the C stack. */
#include "languages/analysis/source_tree.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/analysis/notation.h"
#include "languages/script/script_tree.h"
#include "model/characters.h"
#include "model/store/array.h"

/* A list that is being read. skip: whether it is not a list but #;, which drops the next datum */
typedef struct { know_index node, last; char close; bool dot, skip; } open_list;

typedef struct {
  knowledge *k;
  const char *text;
  size_t size, at, line_start;
  uint32_t file, line;
  size_t column_at;         /* offset of the byte whose column was computed last; columns are requested from left to
                             * right */
  uint32_t column;
  bool line_has_code;
  bool fold;
  open_list *open;
  size_t depth, room;
} reader;

static int peek(const reader *r, size_t ahead) { return r->at + ahead < r->size ? (unsigned char)r->text[r->at + ahead]
    : -1; }

static uint32_t column_of(reader *r, size_t offset) {
  if (r->column_at < r->line_start || r->column_at > offset) r->column_at = r->line_start, r->column = 1;
  for (; r->column_at < offset; r->column_at++) r->column += ((unsigned char)r->text[r->column_at] & 0xC0) != 0x80;
  return r->column;
}

static void advance(reader *r) { /* moves over one byte; counts lines, which end in \n, \r\n or a single \r */
  int c = peek(r, 0);
  r->at++;
  if (c == '\n' || (c == '\r' && peek(r, 0) != '\n')) r->line++, r->line_start = r->at, r->line_has_code = false;
}

static know_place begin(reader *r) {
  return (know_place){.file = r->file, .from = (uint32_t)r->at, .line = r->line, .column = column_of(r, r->at)};
}
static void finish(reader *r, know_index node) {
  if (!node) return;
  know_place *p = &r->k->nodes[node].at;
  p->to = (uint32_t)r->at, p->end_line = r->line, p->end_column = column_of(r, r->at);
}

/* Returns the length in bytes of the blank character at the reader's position, or 0 if there is none. */
static size_t blank(const reader *r) {
  int c = peek(r, 0);
  if (c < 0) return 0;
  if (c <= ' ') return 1;
  const unsigned char *s = (const unsigned char *)r->text + r->at;
  if (c == 0xC2 && peek(r, 1) == 0xA0) return 2;
  if (c < 0xE2 || r->size - r->at < 3) return 0;
  uint32_t u = (uint32_t)(s[0] & 15) << 12 | (uint32_t)(s[1] & 63) << 6 | (uint32_t)(s[2] & 63);
  return u == 0xFEFF || u == 0x3000 || (u >= 0x2000 && u <= 0x200B) || u == 0x2028 ? 3 : 0;
}

static bool delimiter(const reader *r) {
  int c = peek(r, 0);
  return c < 0 || strchr("()[]{}\";,'`", c) || blank(r);
}

/* ---- comments ---- */

static bool comment(reader *r, size_t from, uint32_t line, bool alone) {
  knowledge *k = r->k;
  if (!VS_GROW(k->comments, k->comment_room, k->comment_count + 1)) return know_fail(k, NULL, VS_OUTCOME_MACHINE,
      "out of memory");
  k->comments[k->comment_count++] = (know_comment){r->file, (uint32_t)from, (uint32_t)r->at, line, r->line, alone};
  return true;
}

static void rest_of_line(reader *r) { while (r->at < r->size && r->text[r->at] != '\n' &&
    r->text[r->at] != '\r') r->at++; }

static void block(reader *r) {
  for (size_t depth = 0; r->at < r->size;) {
    int c = peek(r, 0), d = peek(r, 1);
    if (c == '#' && d == '|') depth++, r->at += 2;
    else if (c == '|' && d == '#') {
      r->at += 2;
      if (!--depth) return;
    } else advance(r);
  }
}

/* Skips blanks and comments. Returns false at the end of the text, or on failure. */
static bool skip(reader *r) {
  for (;;) {
    int c = peek(r, 0);
    if (c < 0) return false;
    size_t from = r->at, n = blank(r);
    uint32_t line = r->line;
    bool alone = !r->line_has_code;
    if (n == 1) advance(r);
    else if (n) r->at += n;
    else if (c == ';') {
      rest_of_line(r);
      if (!comment(r, from, line, alone)) return false;
    } else if (c == '#' && peek(r, 1) == '|') {
      block(r);
      if (!comment(r, from, line, alone)) return false;
    } else if (c == '#' && r->size - r->at > 5 && !memcmp(r->text + r->at, "#lang", 5) && peek(r,
        5) <= ' ') rest_of_line(r);
    else if (c == '#' && peek(r, 1) == '!' && r->at == 0 && (peek(r, 2) == '/' || peek(r, 2) == ' ')) rest_of_line(r);
    else if (c == '#' && peek(r, 1) == '!') {
      r->at += 2;
      while (!delimiter(r)) r->at++;
      size_t length = r->at - from;
      if (length == 11 && !memcmp(r->text + from, "#!fold-case", 11)) r->fold = true;
      else if (length == 14 && !memcmp(r->text + from, "#!no-fold-case", 14)) r->fold = false;
      else if (length == 5) return r->at = from, true; /* #!eof is a datum */
    } else return true;
  }
}

/* ---- data ---- */

static bool push(reader *r, know_index node, char close) {
  if (r->depth >= KNOW_MOST_NESTING)
    return know_fail(r->k, &r->k->nodes[node].at, VS_OUTCOME_MODEL, "the program nests deeper than %d levels",
        KNOW_MOST_NESTING);
  if (!VS_GROW(r->open, r->room, r->depth + 1)) return know_fail(r->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  r->open[r->depth++] = (open_list){.node = node, .close = close};
  return true;
}

/* a datum after #; is not part of the program, so its node has no parent */
static void drop(reader *r, know_index node) {
  r->k->nodes[node].parent = 0;
}

/* Adds a complete node to the list that is being read. Also completes quotes before the node. */
static void deliver(reader *r, know_index node) {
  for (;;) {
    open_list *o = &r->open[r->depth - 1];
    knowledge *k = r->k;
    if (o->skip && !o->close) { /* a #; precedes the node, which is dropped */
      know_index hidden = o->node;
      r->depth--;
      drop(r, node);
      drop(r, hidden);
      return;
    }
    k->nodes[node].parent = o->node;
    if (o->last) k->nodes[o->last].next = node;
    else k->nodes[o->node].first = node;
    o->last = node;
    k->nodes[o->node].count++;
    if (o->dot) k->nodes[o->node].dotted = true;
    if (o->close) return;
    node = o->node; /* a quote precedes the node: this completes the quote */
    finish(r, node);
    r->depth--;
  }
}

static know_index symbol(reader *r, know_place at, const char *text, size_t length) {
  know_index name = know_name_of(r->k, text, length, 0, 0), node = know_node_new(r->k, KNOW_SYMBOL);
  if (!node || !name) return 0;
  r->k->nodes[node].name = name;
  r->k->nodes[node].at = at;
  if (length > 2 && text[0] == '#' && text[1] == ':') r->k->nodes[node].kind = KNOW_KEYWORD;
  return node;
}

static bool quote(reader *r, const char *word, char mark, size_t bytes) {
  know_place at = begin(r);
  know_index node = know_node_new(r->k, KNOW_LIST);
  if (!node) return false;
  r->k->nodes[node].open = mark;
  r->k->nodes[node].at = at;
  r->at += bytes;
  if (!push(r, node, 0)) return false;
  know_index name = symbol(r, at, word, strlen(word));
  if (!name) return false;
  finish(r, name);
  open_list *o = &r->open[r->depth - 1];
  r->k->nodes[name].parent = node;
  r->k->nodes[node].first = o->last = name;
  r->k->nodes[node].count = 1;
  return true;
}

static bool list(reader *r, know_kind kind, char open, size_t bytes) {
  know_place at = begin(r);
  know_index node = know_node_new(r->k, kind);
  if (!node) return false;
  r->k->nodes[node].open = open;
  r->k->nodes[node].at = at;
  r->at += bytes;
  return push(r, node, open == '[' ? ']' : open == '{' ? '}' : ')');
}

static void delimited(reader *r, char end) {
  advance(r);
  while (r->at < r->size) {
    char c = r->text[r->at];
    advance(r);
    if (c == end) return;
    if (c == '\\' && r->at < r->size) advance(r);
  }
}

static bool number_like(const char *s, size_t n) {
  size_t i = n && (*s == '+' || *s == '-');
  if (i < n && s[i] == '.') i++;
  if (i < n && s[i] >= '0' && s[i] <= '9') { /* names may begin with digits, such as 2pi and 1+ */
    for (; i < n; i++)
      if (!strchr("0123456789.eE+-/ @i", s[i])) return false;
    char last = s[n - 1];
    return (last >= '0' && last <= '9') || last == '.' || last == 'i';
  }
  if (n > 2 && *s == '#' && strchr("xXbBoOdDeEiI", s[1])) return true;
  return n == 6 && (!memcmp(s, "+inf.0", 6) || !memcmp(s, "-inf.0", 6) || !memcmp(s, "+nan.0", 6) || !memcmp(s,
      "-nan.0", 6));
}

static bool is_word(const char *s, size_t n, const char *word) { return n == strlen(word) && !memcmp(s, word, n); }

/* Reads a name or number, including a name in bars: |a name|. */
static bool token(reader *r) {
  know_place at = begin(r);
  size_t from = r->at;
  bool bars = false;
  while (!delimiter(r)) {
    if (r->text[r->at] == '|') bars = true, delimited(r, '|');
    else r->at++;
  }
  if (r->at == from) r->at++; /* reads a single character that begins neither a name nor a number */
  const char *s = r->text + from;
  size_t n = r->at - from;
  know_index node;
  if (!bars && is_word(s, n, ".")) {
    r->open[r->depth - 1].dot = true;
    return true;
  }
  know_kind kind = KNOW_SYMBOL;
  if (!bars && number_like(s, n)) kind = KNOW_NUMBER;
  else if (!bars && *s == '#' && (is_word(s, n, "#t") || is_word(s, n, "#f") || is_word(s, n, "#true") || is_word(s, n,
      "#false"))) kind = KNOW_BOOLEAN;
  else if (!bars && *s == '#' && !(n > 2 && s[1] == ':')) kind = KNOW_OTHER;
  if (kind != KNOW_SYMBOL) {
    node = know_node_new(r->k, kind);
    if (!node) return false;
    r->k->nodes[node].at = at;
  } else {
    char small[200];
    size_t used = 0;
    bool plain = !bars && !r->fold;
    for (size_t i = 0; !plain && i < n && used + 1 < sizeof small; i++)
      if (s[i] != '|') small[used++] = (char)(r->fold && s[i] >= 'A' && s[i] <= 'Z' ? s[i] | 32 : s[i]);
    node = plain ? symbol(r, at, s, n) : symbol(r, at, small, used);
    if (!node) return false;
  }
  finish(r, node);
  deliver(r, node);
  return true;
}

static bool leaf(reader *r, know_kind kind, size_t bytes, bool more) {
  know_place at = begin(r);
  know_index node = know_node_new(r->k, kind);
  if (!node) return false;
  r->k->nodes[node].at = at;
  if (kind == KNOW_STRING) delimited(r, '"');
  else {
    for (size_t i = 0; i < bytes && r->at < r->size; i++) advance(r);
    while (r->at < r->size && ((unsigned char)r->text[r->at] & 0xC0) == 0x80) r->at++;
    while (more && !delimiter(r)) r->at++;
  }
  finish(r, node);
  deliver(r, node);
  return true;
}

static bool datum(reader *r) {
  int c = peek(r, 0), d = peek(r, 1);
  r->line_has_code = true;
  switch (c) {
  case '(': case '[': case '{': return list(r, KNOW_LIST, (char)c, 1);
  case ')': case ']': case '}':
    if (r->depth < 2) return know_fail(r->k, NULL, VS_OUTCOME_MODEL, "a ) too many in line %u", r->line);
    r->at++;
    know_index done = r->open[r->depth - 1].node;
    r->depth--;
    finish(r, done);
    deliver(r, done);
    return true;
  case '\'': return quote(r, "quote", '\'', 1);
  case '`': return quote(r, "quasiquote", '`', 1);
  case ',': return d == '@' ? quote(r, "unquote-splicing", '@', 2) : quote(r, "unquote", ',', 1);
  case '"': return leaf(r, KNOW_STRING, 0, false);
  case '#':
    if (d == '(') return list(r, KNOW_VECTOR, '#', 2);
    if (d == '\\') return leaf(r, KNOW_CHARACTER, 3, true);
    if (d == ';') {
      know_place at = begin(r);
      know_index hidden = know_node_new(r->k, KNOW_OTHER);
      if (!hidden) return false;
      r->k->nodes[hidden].at = at;
      r->at += 2;
      if (!push(r, hidden, 0)) return false;
      r->open[r->depth - 1].skip = true;
      return true;
    }
    if (r->size - r->at > 4 && (!memcmp(r->text + r->at, "#u8(", 4) || !memcmp(r->text + r->at, "#U8(",
        4))) return list(r, KNOW_VECTOR, '#', 4);
    if (d >= '0' && d <= '9') { /* a label of a shared datum, #0= or #0# */
      size_t n = 1;
      while (peek(r, n) >= '0' && peek(r, n) <= '9') n++;
      if (peek(r, n) == '=') return r->at += n + 1, true;
      if (peek(r, n) == '#') return leaf(r, KNOW_OTHER, n + 1, false);
    }
    return token(r);
  default: return token(r);
  }
}

static bool read_nodes(reader *r, know_index *root) {
  know_index top = know_node_new(r->k, KNOW_LIST);
  if (!top || !push(r, top, ')')) return false;
  r->k->nodes[top].at = begin(r);
  while (skip(r))
    if (!datum(r) || *r->k->trouble) return false;
  if (*r->k->trouble) return false;
  if (r->depth != 1) return know_fail(r->k, &r->k->nodes[r->open[r->depth - 1].node].at, VS_OUTCOME_MODEL,
      "this is never closed");
  finish(r, top);
  *root = top;
  return true;
}

/* ---- files ---- */

static bool exists(const char *path) {
  FILE *f = fopen(path, "rb");
  if (f) fclose(f);
  return f != NULL;
}

/* Joins folder and name to a path, with a / if needed. Returns false if the path is too long, or if there is no such
 * file. */
static bool in_folder(const char *folder, size_t length, const char *name, size_t n, char path[KNOW_PATH]) {
  const char *slash = length && folder[length - 1] != '/' ? "/" : "";
  int room = snprintf(path, KNOW_PATH, "%.*s%s%.*s", (int)length, folder, slash, (int)n, name);
  return room > 0 && room < KNOW_PATH && exists(path);
}

static size_t folder_of(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? (size_t)(slash - path + 1) : 0;
}

bool know_reads(const char *path) {
  const char *language = vs_language_of(path);
  return !language || strcmp(language, "JavaScript") == 0;
}

bool know_find_file(const knowledge *k, know_index node, char path[KNOW_PATH]) {
  size_t n;
  const char *s = know_spelling(k, node, &n), *from = k->files[k->nodes[node].at.file].path, *own = k->files[0].path;
  *path = 0;
  if (n < 3 || *s != '"' || memchr(s, '\\', n)) return false;
  s++, n -= 2;
  if (*s == '/') return in_folder("", 0, s, n, path);
  if (in_folder(from, folder_of(from), s, n, path) || in_folder(own, folder_of(own), s, n, path)) return true;
  for (const char *at = k->library_path; at && *at;) {
    size_t length = strcspn(at, ":");
    if (length && in_folder(at, length, s, n, path)) return true;
    at += length + (at[length] == ':');
  }
  return in_folder(from, folder_of(from), s, n, path);
}

static char *given_text(knowledge *k, size_t *length) {
  char *text = NULL;
  size_t room = 0;
  if (k->given_length > KNOW_MOST_BYTES || !VS_GROW(text, room, k->given_length + 1))
    return know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory"), NULL;
  memcpy(text, k->given, k->given_length);
  text[*length = k->given_length] = 0;
  return text;
}

char *know_file_text(knowledge *k, const char *path, size_t *length) {
  bool standard = !strcmp(path, "-");
  FILE *f = standard ? stdin : fopen(path, "rb");
  char *text = NULL;
  size_t room = 0, used = 0, got = 0;
  if (!f) return know_fail(k, NULL, VS_OUTCOME_USAGE, "%s: %s", path, errno == ENOENT ? "no such file"
      : strerror(errno)), NULL;
  do {
    if (!VS_GROW(text, room, used + 65537)) {
      know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
      break;
    }
    got = fread(text + used, 1, 65536, f);
    used += got;
  } while (got && used <= KNOW_MOST_BYTES);
  bool bad = ferror(f) != 0;
  int why = errno;
  if (!standard) fclose(f);
  if (bad) know_fail(k, NULL, VS_OUTCOME_USAGE, "%s: %s", path, strerror(why));
  else if (used > KNOW_MOST_BYTES) know_fail(k, NULL, VS_OUTCOME_MODEL,
      "%s: a program of more than %d MB is not analysed", path, KNOW_MOST_BYTES >> 20);
  if (*k->trouble) return free(text), NULL;
  text[used] = 0;
  *length = used;
  return text;
}

static bool is_text(const char *text, size_t length) {
  for (size_t i = 0; i < length;) {
    uint32_t code = 0;
    size_t n = vs_character_read(text + i, length - i, &code);
    if (!n || !code) return false;
    i += n;
  }
  return true;
}

/* The interpreter reads a whole text before it runs a part. A form that cannot be expanded is therefore added in a line
 * before the text, so that the text is read but not run. The host ignores messages about that line. */
bool know_readable(knowledge *k, const char *path, const char *text, size_t length) {
  static const char before[] = "(lambda)\n";
  char *whole = NULL;
  if (!is_text(text, length)) { /* if the text is no valid UTF-8, uses the interpreter's message, which counts bytes; no
                                 * part of the text can run */
    vs_eval_text(k->scheme, path, 1, text, length, 0);
    return know_fail(k, NULL, VS_OUTCOME_MODEL, "%s", "-");
  }
  size_t room = 0;
  if (!VS_GROW(whole, room, length + sizeof before)) return know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  memcpy(whole, before, sizeof before - 1);
  memcpy(whole + sizeof before - 1, text, length);
  k->reading = true, k->unreadable = false;
  vs_outcome outcome = vs_eval_text(k->scheme, path, 0, whole, length + sizeof before - 1, 0);
  k->reading = false;
  free(whole);
  if (outcome == VS_OUTCOME_MODEL && !k->unreadable) return true;
  /* the interpreter's host has already received the message */
  know_fail(k, NULL, outcome == VS_OUTCOME_DONE ? VS_OUTCOME_MODEL : outcome, "%s", "-");
  return false;
}

static bool is_script(const char *path) {
  size_t n = strlen(path);
  return n > 3 && !strcmp(path + n - 3, ".js");
}

know_index know_read_file(knowledge *k, const char *path, know_index loaded_by) {
  for (size_t i = 0; i < k->file_count; i++)
    if (loaded_by && !strcmp(k->files[i].path, path)) return (know_index)i;
  size_t length;
  char *text = k->given && !k->file_count ? given_text(k, &length) : know_file_text(k, path, &length);
  if (!text) return UINT32_MAX;
  if (!VS_GROW(k->files, k->file_room, k->file_count + 1)) {
    free(text);
    know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
    return UINT32_MAX;
  }
  know_index file = (know_index)k->file_count++;
  k->files[file] = (know_file){know_text(k, path, strlen(path)), text, length, 0, (know_index)k->comment_count, 0,
      loaded_by, false};
  if (is_script(path)) {
    static const char import[] = "(import (javascript runtime))";
    k->script = true;
    if (!file) vs_eval_text(k->scheme, "javascript", 1, import, sizeof import - 1, VS_EVAL_PROGRAM);
    know_index statements = 0;
    bool read = know_read_script(k, file, &statements);
    k->files[file].root = statements;
    k->files[file].comment_end = (know_index)k->comment_count;
    return read ? file : UINT32_MAX;
  }
  if (!know_readable(k, k->files[file].path, text, length)) return UINT32_MAX;
  reader r = {.k = k, .text = text, .size = length, .file = file, .line = 1, .column = 1};
  know_index root = 0;
  bool ok = read_nodes(&r, &root);
  free(r.open);
  k->files[file].root = root;
  k->files[file].comment_end = (know_index)k->comment_count;
  return ok ? file : UINT32_MAX;
}
