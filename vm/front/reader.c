/* Implements the reader, which converts text to data with the place of every pair.
 *
 * A stack contains all data that are being read (lists, vectors, quotes, datum comments, labels). Its memory counts for
 * the memory limit. Each level of the stack has two roots of the garbage collector: the first and the last pair of its
 * elements. A complete datum is added to the level on top. The reader collects mistakes and continues after them, so
 * that one reading reports all.
 *
 * The end of the text shows that a parenthesis is not closed, but not which. The reader therefore compares the
 * indentation of each line with the column of the open parenthesis. It records the first line that begins at this
 * column or left of it: the line before probably lacks the closing parenthesis. It then reads the text a second time,
 * in which each (define at the left margin begins a new form (`anew`). It thus reports every unclosed form, not only
 * the first.
 *
 * A missing quote exchanges the inside and outside of all later strings. The reader therefore records the first string
 * of several lines whose end touches a word: the missing quote is probably there. */
#include "vm/front/reader.h"
#include "vm/numbers/number.h"
#include "vm/numbers/number_text.h"
#include "vm/values/heap.h"
#include "vm/values/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { PROBLEMS = 20, PROBLEM_TEXT = 200 };

typedef enum { NO_QUOTE, QUOTE_PLAIN, QUASI, UNQUOTE, SPLICE } quote_kind;
typedef enum { LIST, VECTOR, BYTEVECTOR, QUOTE, COMMENT, LABEL } frame_kind;

typedef struct {
  frame_kind kind;
  char open;                 /* opening parenthesis: ( or [ */
  uint8_t dot;               /* LIST: 1 after a dot, 2 after the datum that follows the dot, otherwise 0 */
  vs_pos pos;
  quote_kind quote;
} level;

typedef struct {
  vs_scheme *vm;
  const char *text;
  size_t size, at;
  uint32_t file, line;
  size_t line_start;         /* offset at which the current line begins */
  size_t col_at; uint32_t col;   /* col: column of the byte at offset col_at; cached, so that the column of a later byte
                                  * of the line needs no new count */
  bool located, fold, blank_line;   /* blank_line: whether the current line has only blanks so far */
  level *levels; size_t depth, room;
  vs_value *slots;           /* values that the garbage collector visits: two for each level of the stack, then the
                              * labels */
  struct vs_roots roots;
  vs_value labels;           /* list of (number . box) for the labels; a root of the garbage collector */
  bool label_used;
  size_t quasi;              /* number of levels of the stack that are quasiquotes */
  size_t problems; bool more;
  struct { vs_pos pos; char text[PROBLEM_TEXT]; } problem[PROBLEMS];
  /* suspect: place of the open parenthesis that should be closed, judging by the indentation. suspect_line: line of the
   * last token inside this parenthesis */
  vs_pos suspect; uint32_t suspect_line;
  uint32_t content_line;     /* line of the last token */
  uint32_t comma_line;       /* line of the last comma between elements that was reported */
  bool cut;                  /* whether an unclosed string or |symbol| extends to the end of the text, so that open
                              * parentheses are not separate mistakes */
  bool anew, left_open;      /* anew: whether the text is read a second time, to find all unclosed forms; left_open:
                              * whether a form was not closed */
  vs_pos odd_string; uint32_t odd_end;   /* odd_string: the string that probably lacks its closing quote; odd_end: its
                                          * last line */
  vs_pos last_top; uint32_t last_close_line; bool stray; vs_pos stray_top; uint32_t stray_line;
} reader;

/* Returns the column, counted in characters from 1, of an offset in the current line. */
static uint32_t column(reader *r, size_t offset) {
  VS_ASSERT(offset >= r->line_start);
  if (offset < r->col_at || r->col_at < r->line_start) { r->col_at = r->line_start; r->col = 1; }
  for (; r->col_at < offset; r->col_at++) r->col += ((unsigned char)r->text[r->col_at] & 0xC0) != 0x80;
  return r->col;
}
static vs_pos place(reader *r, size_t offset) { return vs_pos_make(r->file, r->line, column(r, offset)); }

static void problem(reader *r, vs_pos pos, const char *format, ...) __attribute__((format(printf, 3, 4)));
static void problem(reader *r, vs_pos pos, const char *format, ...) {
  if (r->problems == PROBLEMS) { r->more = true; return; }
  va_list list;
  va_start(list, format);
  vsnprintf(r->problem[r->problems].text, PROBLEM_TEXT, format, list);
  va_end(list);
  r->problem[r->problems++].pos = pos;
}

static void newline(reader *r, size_t next) {
  r->line++;
  r->line_start = r->col_at = next;
  r->col = 1;
  r->blank_line = true;
}

static int peek(const reader *r, size_t ahead) {
  return r->at + ahead < r->size ? (unsigned char)r->text[r->at + ahead] : -1;
}

/* Returns the length in bytes of the blank character at the reader's position, or 0 if another character is there. */
static size_t blank(const reader *r) {
  int c = peek(r, 0);
  if (c < 0) return 0;
  if (c <= ' ') return 1;
  if (c < 0xC2) return 0;
  uint32_t u;
  size_t n = vs_utf8_decode(r->text + r->at, r->size - r->at, &u);
  return u == 0xA0 || u == 0xFEFF || u == 0x3000 || (u >= 0x2000 && u <= 0x200B) || u == 0x2028 ? n : 0;
}

/* Returns true if the byte c, which was just read, ends a line: \n, or \r without a following \n. */
static bool ends_line(const reader *r, int c) { return c == '\n' || (c == '\r' && peek(r, 0) != '\n'); }

static bool is_delimiter(const reader *r) {
  int c = peek(r, 0);
  return c < 0 || strchr("()[]{}\";,'`", c) || blank(r);
}

static void skip_line(reader *r) {
  while (r->at < r->size && r->text[r->at] != '\n' && r->text[r->at] != '\r') r->at++;
}

static void skip_block(reader *r) {
  vs_pos pos = place(r, r->at);
  size_t depth = 0;
  while (r->at < r->size) {
    int c = peek(r, 0), d = peek(r, 1);
    if (c == '#' && d == '|') { depth++; r->at += 2; }
    else if (c == '|' && d == '#') { r->at += 2; if (!--depth) return; }
    else { r->at++; if (ends_line(r, c)) newline(r, r->at); }
  }
  problem(r, pos, "this comment #| is never closed by |#");
}

/* Skips blanks and comments (except #;). Returns false at the end of the text. */
static bool skip(reader *r) {
  for (;;) {
    int c = peek(r, 0);
    size_t n = blank(r);
    if (c < 0) return false;
    if (n) { r->at += n; if (ends_line(r, c)) newline(r, r->at); }
    else if (c == ';') skip_line(r);
    else if (c == '#' && peek(r, 1) == '|') skip_block(r);
    else if (c == '#' && r->size - r->at > 5 && !memcmp(r->text + r->at, "#lang", 5) && peek(r, 5) <= ' ') skip_line(r);
    else if (c == '#' && peek(r, 1) == '!' && r->at == 0 && (peek(r, 2) == '/' || peek(r, 2) == ' '))
      skip_line(r); /* a first line such as #!/usr/bin/env vs_scheme */
    else if (c == '#' && peek(r, 1) == '!') {
      size_t start = r->at;
      r->at += 2;
      while (!is_delimiter(r)) r->at++;
      size_t length = r->at - start;
      if (length == 11 && !memcmp(r->text + start, "#!fold-case", 11)) r->fold = true;
      else if (length == 14 && !memcmp(r->text + start, "#!no-fold-case", 14)) r->fold = false;
      else if (length == 5 && !memcmp(r->text + start, "#!eof", 5)) { r->at = start; return true; }
    } else return true;
  }
}

/* ---- the stack of levels ---- */
static bool push(reader *r, frame_kind kind, vs_pos pos, char open, quote_kind quote) {
  if (r->depth == r->room) {
    size_t room = r->room ? 2 * r->room : 32;
    level *levels = vs_mem(r->vm, r->levels, r->room * sizeof *levels, room * sizeof *levels);
    if (!levels) return false;
    r->levels = levels;
    vs_value *slots = vs_mem(r->vm, r->slots, 2 * r->room * sizeof *slots, 2 * room * sizeof *slots);
    if (!slots) {   /* gives `levels` its old size again, so that both arrays have room for the same number of levels */
      r->levels = vs_mem(r->vm, levels, room * sizeof *levels, r->room * sizeof *levels);
      return false;
    }
    r->slots = r->roots.slots = slots;
    r->room = room;
  }
  r->levels[r->depth] = (level){kind, open, 0, pos, quote};
  r->slots[2 * r->depth] = r->slots[2 * r->depth + 1] = VS_NIL;
  r->roots.count = 2 * ++r->depth;
  r->quasi += quote == QUASI;
  return true;
}

/* Removes the level on top of the stack, which must not be empty. */
static void pop(reader *r) {
  VS_ASSERT(r->depth > 0);
  level *f = &r->levels[--r->depth];
  r->quasi -= f->quote == QUASI;
  r->roots.count = 2 * r->depth;
}

static bool cons(reader *r, vs_value car, vs_value cdr, vs_pos pos, vs_value *out) {
  return r->located ? vs_cons_at(r->vm, car, cdr, pos, out) : vs_cons(r->vm, car, cdr, out);
}

/* Adds the datum *v, a root of the garbage collector, to the level on top of the stack. If the stack is empty, sets
 * *done to true: the datum is complete. */
static bool deliver(reader *r, vs_value *v, vs_pos pos, bool *done) {
  *done = false;
  for (;;) {
    if (!r->depth) { *done = true; return true; }
    level *f = &r->levels[r->depth - 1];
    vs_value *slot = &r->slots[2 * (r->depth - 1)];
    switch (f->kind) {
    case COMMENT: pop(r); return true;
    case QUOTE: {
      vs_pos mark = f->pos;
      quote_kind quote = f->quote;
      pop(r);
      if (!cons(r, *v, VS_NIL, pos, v)) return false;
      const struct vs_scheme *vm = r->vm;
      vs_value name = quote == QUASI     ? vm->sym.quasiquote
                      : quote == UNQUOTE ? vm->sym.unquote
                      : quote == SPLICE  ? vm->sym.unquote_splicing
                                         : vm->sym.quote;
      if (!cons(r, name, *v, mark, v)) return false;
      pos = mark;
      break;
    }
    case LABEL: {
      vs_value box = slot[0];
      pop(r);
      vs_gc_store(r->vm, vs_as_box(box), &vs_as_box(box)->value, *v);
      break;
    }
    case LIST:
      if (f->dot) {
        if (f->dot == 2) { problem(r, pos, "only one datum may follow the . of a list"); return true; }
        f->dot = 2;
        vs_pair *last = vs_as_pair(slot[1]);
        vs_gc_store(r->vm, last, &last->cdr, *v);
        return true;
      } /* fall through */
    case VECTOR: case BYTEVECTOR: {
      bool first = slot[0] == VS_NIL;
      if (!cons(r, *v, VS_NIL, first ? f->pos : pos, v)) return false;
      slot = &r->slots[2 * (r->depth - 1)];
      if (first) slot[0] = *v;
      else vs_gc_store(r->vm, vs_as_pair(slot[1]), &vs_as_pair(slot[1])->cdr, *v);
      slot[1] = *v;
      return true;
    }
    }
  }
}

/* Removes the level on top of the stack, which must not be empty. Sets *out to the level's datum. */
static bool close_frame(reader *r, vs_value *out) {
  level f = r->levels[r->depth - 1];
  vs_value head = r->slots[2 * (r->depth - 1)];
  VS_ASSERT(r->depth > 0);
  if (f.kind == LIST && head != VS_NIL && f.open == '[') vs_object_of(head)->flags |= VS_F_SQUARE;
  if (f.kind == LIST && f.dot == 1) problem(r, f.pos, "a datum is missing after the . of this list");
  *out = head;
  if (f.kind == VECTOR || f.kind == BYTEVECTOR) {
    size_t n = 0;
    for (vs_value v = head; vs_is_pair(v); v = vs_cdr(v)) n++;
    if (f.kind == VECTOR ? !vs_make_vector(r->vm, n, VS_FALSE, out) : !vs_make_bytes(r->vm, n, out)) return false;
    size_t i = 0;
    for (vs_value v = r->slots[2 * (r->depth - 1)]; vs_is_pair(v); v = vs_cdr(v), i++) {
      vs_value e = vs_car(v);
      if (f.kind == VECTOR) vs_gc_store(r->vm, vs_as_vector(*out), &vs_as_vector(*out)->at[i], e);
      else if (vs_is_fixnum(e) && vs_fixnum(e) >= 0 && vs_fixnum(e) < 256)
        vs_as_bytes(*out)->at[i] = (uint8_t)vs_fixnum(e);
      else problem(r, f.pos, "a bytevector holds integers from 0 to 255");
    }
    if (r->located) vs_object_of(*out)->flags |= VS_F_IMMUTABLE;      /* literals of a program are immutable */
  }
  pop(r);
  return true;
}

/* ---- tokens that are data ---- */
static const struct { const char *name; uint32_t c;
} char_names[] = {
  { "space", ' ' }, { "newline", '\n' }, { "tab", '\t' },      { "return", '\r' }, { "null", 0 },
  { "nul", 0 },     { "alarm", 7 },      { "backspace", 8 },   { "delete", 127 },  { "rubout", 127 },
  { "escape", 27 }, { "altmode", 27 },   { "linefeed", '\n' }, { "page", 12 },     { "vtab", 11 },
};

static bool hex(const char *s, size_t n, uint32_t *out) {
  uint32_t c = 0;
  if (!n || n > 8) return false;
  for (size_t i = 0; i < n; i++) {
    int d = s[i] >= '0' && s[i] <= '9'   ? s[i] - '0'
            : s[i] >= 'a' && s[i] <= 'f' ? s[i] - 'a' + 10
            : s[i] >= 'A' && s[i] <= 'F' ? s[i] - 'A' + 10
                                         : -1;
    if (d < 0) return false;
    c = c << 4 | (uint32_t)d;
  }
  *out = c;
  return c <= 0x10FFFF && !(c >= 0xD800 && c < 0xE000);
}

static void read_char(reader *r, vs_value *out) {
  size_t start = r->at;
  vs_pos pos = place(r, start);
  r->at += 2;
  uint32_t c = 0;
  *out = VS_CHAR(' ');
  if (r->at >= r->size) { problem(r, pos, "a character is missing after #\\"); return; }
  size_t n = vs_utf8_decode(r->text + r->at, r->size - r->at, &c), first = r->at;
  r->at += n;
  if (c < 128 && ends_line(r, (int)c)) newline(r, r->at);
  else while (!is_delimiter(r)) r->at++;
  size_t length = r->at - first;
  const char *s = r->text + first;
  *out = VS_CHAR(c);
  if (length == n) return;
  if ((*s == 'x' || *s == 'u' || *s == 'U') && hex(s + 1, length - 1, &c)) { *out = VS_CHAR(c); return; }
  for (size_t i = 0; i < sizeof char_names / sizeof *char_names; i++) {
    if (strlen(char_names[i].name) != length) continue;
    bool same = true;
    for (size_t k = 0; k < length; k++)
      same &= s[k] == char_names[i].name[k] || (r->fold && (s[k] | 32) == char_names[i].name[k]);
    if (same) { *out = VS_CHAR(char_names[i].c); return; }
  }
  problem(r, pos, "no character has the name #\\%.*s", (int)(length > 40 ? 40 : length), s);
}

/* Reads an escape in a string or |symbol|: the characters after its backslash. */
static bool read_escape(reader *r, vs_text *t) {
  vs_pos pos = place(r, r->at - 1);
  int c = peek(r, 0);
  size_t start = r->at;
  if (c >= 0) r->at++; /* advances past the character after the backslash, unless the text has ended */
  switch (c) {
  case 'a': return vs_text_char(t, 7);
  case 'b': return vs_text_char(t, 8);
  case 't': return vs_text_char(t, '\t');
  case 'n': return vs_text_char(t, '\n');
  case 'r': return vs_text_char(t, '\r');
  case 'v': return vs_text_char(t, 11);
  case 'f': return vs_text_char(t, 12);
  case 'e': return vs_text_char(t, 27);
  case '"': case '\\': case '|': case '\'': return vs_text_char(t, (uint32_t)c);
  case 'x': case 'X': {
    while (r->at < r->size && r->text[r->at] != ';' && r->text[r->at] != '"' && r->text[r->at] != '\n') r->at++;
    uint32_t u = 0xFFFD;
    if (peek(r, 0) != ';' || !hex(r->text + start + 1, r->at - start - 1, &u))
      problem(r, pos, "a character by number is written \\x41;");
    if (peek(r, 0) == ';') r->at++;
    return vs_text_char(t, u);
  }
  case ' ': case '\t': case '\n': case '\r': {        /* a backslash at the end of a line: omits the line end and the
                                                       * blanks around it */
    r->at = start;
    while (peek(r, 0) == ' ' || peek(r, 0) == '\t' || (peek(r, 0) == '\r' && peek(r, 1) == '\n')) r->at++;
    if (peek(r, 0) != '\n' && peek(r, 0) != '\r') {
      problem(r, pos, "the line must end after this backslash");
      return true;
    }
    newline(r, ++r->at);
    while (peek(r, 0) == ' ' || peek(r, 0) == '\t') r->at++;
    return true;
  }
  default: break;
  }
  if (c < 0) return true;
  uint32_t u;
  r->at = start + vs_utf8_decode(r->text + start, r->size - start, &u);
  char shown[5] = {0};
  vs_utf8_encode(u, shown);
  bool drive = start > 2 && r->text[start - 2] == ':'; /* whether the string may be a path of Windows, such as
                                                        * C:\models */
  problem(r, pos, "\\%s means nothing in a string; a backslash is written \\\\%s", shown,
          drive ? ", and the name of a file has /: \"C:/models/a.vs\"" : "");
  return vs_text_char(t, u);
}

static bool read_delimited(reader *r, char end, vs_text *t) {
  vs_pos pos = place(r, r->at);
  uint32_t first_line = r->line;
  r->at++;
  while (r->at < r->size) {
    size_t run = r->at;
    while (r->at < r->size && r->text[r->at] != end && r->text[r->at] != '\\' && r->text[r->at] != '\n' &&
           r->text[r->at] != '\r')
      r->at++;
    if (!vs_text_put(t, r->text + run, r->at - run)) return false;
    int c = peek(r, 0);
    if (c < 0) break;
    r->at++;
    if (c == end) {
      if (end == '"' && !r->odd_string && r->line != first_line && !is_delimiter(r)) {
        r->odd_string = pos;
        r->odd_end = r->line;
      }
      return true;
    }
    if (c == '\\') { if (!read_escape(r, t)) return false; }
    else {                                              /* every line end in a string becomes \n; line ends in a symbol
                                                         * are kept */
      const char kept = (char)c;
      bool ends = ends_line(r, c);
      if (ends) newline(r, r->at);
      if (end == '|' ? !vs_text_put(t, &kept, 1) : ends && !vs_text_put(t, "\n", 1)) return false;
    }
  }
  if (end == '"' && r->odd_string)
    problem(r, r->odd_string, "this string goes on to line %u; a \" is missing, probably on line %u", r->odd_end,
            vs_pos_line(r->odd_string));
  else {
    r->odd_string = 0;
    problem(r, pos,
            end == '"' ? "this string is never closed: a \" is missing"
                       : "this |symbol is never closed: a | is missing");
  }
  r->cut = true;
  return true;
}

static bool is_hexadecimal(const char *s, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (!strchr("0123456789abcdefABCDEF", s[i])) return false;
  return true;
}

/* Reports a word in typographic quotation marks, as word processors write them. */
static void typographic_quote(reader *r, vs_pos pos, const char *s, size_t length) {
  size_t n = 3; /* first the length of the quotation mark in bytes, later the offset of the closing quotation mark */
  while (n < length && !(n + 2 < length && !memcmp(s + n, "\xE2\x80", 2) && (unsigned char)s[n + 2] >= 0x98 &&
                         (unsigned char)s[n + 2] <= 0x9F))
    n++;
  bool apostrophe = n == length && (unsigned char)s[2] <= 0x99;
  int word = (int)(n - 3 > 60 ? 60 : n - 3);
  if (word)
    problem(r, pos, "%.3s is a typographic quotation mark; write %s%.*s%s", s, apostrophe ? "'" : "\"", word, s + 3,
            apostrophe ? "" : "\"");
  else problem(r, pos, "%.3s is a typographic quotation mark; write \" (or ' before a symbol)", s);
}

/* Reports full-width parentheses and digits, as keyboards for Chinese and Japanese write them. */
static void full_width(reader *r, vs_pos pos, const char *s, size_t length) {
  char digits[20];
  size_t count = 0, i = 0;
  for (; i + 2 < length && !memcmp(s + i, "\xEF\xBC", 2); i += 3) {
    unsigned char last = (unsigned char)s[i + 2];
    if (last < 0x90 || last > 0x99 || count + 1 >= sizeof digits) break;
    digits[count++] = (char)('0' + last - 0x90);
  }
  digits[count] = 0;
  if (count && i == length) problem(r, pos, "%.*s is in full-width digits; write %s", (int)length, s, digits);
  for (i = 0; i + 2 < length; i++)
    if (!memcmp(s + i, "\xEF\xBC\x88", 3) || !memcmp(s + i, "\xEF\xBC\x89", 3)) {
      problem(r, pos, "%.3s is a full-width parenthesis; write %c", s + i, (unsigned char)s[i + 2] == 0x88 ? '(' : ')');
      return;
    }
}

static bool read_symbol(reader *r, vs_value *out) {
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  bool ok = true, bars = false;
  size_t start = r->at;
  vs_pos pos = place(r, start);
  while (ok && !is_delimiter(r)) {
    if (r->text[r->at] == '|') { bars = true; ok = read_delimited(r, '|', &t); continue; }
    char c = r->text[r->at++];
    if (r->fold && c >= 'A' && c <= 'Z') c = (char)(c | 32);
    ok = vs_text_put(&t, &c, 1);
  }
  size_t length = r->at - start;
  const char *s = r->text + start;
  int c = length ? (unsigned char)*s : 0;
  *out = VS_FALSE;
  if (ok && !bars && ((c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == '#')) {
    ok = vs_read_number(r->vm, s, length, pos, out);
    if (ok && *out == VS_FALSE && c == '#' && (length == 7 || length == 4) && is_hexadecimal(s + 1, length - 1)) {
      problem(r, pos, "a colour is a text: \"%.*s\"", (int)length, s);
      *out = VS_UNSPECIFIC;
    } else if (ok && *out == VS_FALSE && c == '#') {
      problem(r, pos,
              "%.*s is not known here: # begins #t, #f, #\\a (a character), #(1 2) (a vector), #:name (a keyword) and "
              "#;, #| (comments); ; begins a comment to the end of the line%s",
              (int)(length > 60 ? 60 : length), s,
              peek(r, 0) == '(' ? "; (highlight object) marks one as # does in OpenSCAD" : "");
      *out = VS_UNSPECIFIC;
    }
    if (ok && vs_is_number(*out) && !r->quasi && peek(r, 0) == ',' && peek(r, 1) >= '0' && peek(r, 1) <= '9') {
      size_t more = 1;
      while (peek(r, more) >= '0' && peek(r, more) <= '9') more++;
      if (peek(r, more) == ',' || (r->depth && r->levels[r->depth - 1].open == '[')) { /* commas between elements, as in
                                                                                        * other languages: [1,2,3] */
        problem(r, pos, "separate elements by blanks, not by commas: (list 1 2 3), or (xyz 1 2 3) for a point");
        while (peek(r, more) >= 0 &&
               (peek(r, more) == ',' || peek(r, more) == '.' || (peek(r, more) >= '0' && peek(r, more) <= '9')))
          more++;
      } else
        problem(r, pos, "a decimal point is a point: %.*s.%.*s instead of %.*s", (int)length, s, (int)(more - 1),
                s + length + 1, (int)(length + more), s);
      r->at += more;
    }
  }
  /* The token begins a vector of POV-Ray: <0,0,0>. */
  if (ok && !bars && c == '<' && length > 1 && strchr("+-.0123456789", s[1]) && peek(r, 0) == ',' && !r->quasi) {
    char numbers[80];
    size_t more = 0, used = 0;
    while (peek(r, more) >= 0 && strchr("+-.,0123456789eE \t", peek(r, more))) more++;
    for (const char *p = s + 1; p < s + length + more && used + 1 < sizeof numbers; p++)
      if (*p != ',') numbers[used++] = *p;
      else if (used && numbers[used - 1] != ' ' && p[1] != ' ') numbers[used++] = ' ';
    numbers[used] = 0;
    problem(r, pos, "a point is written (xyz %s), a gvector (vxyz %s)", numbers, numbers);
    r->at += more;
    while (!is_delimiter(r)) r->at++; /* skips to the > that closes the vector */
    *out = VS_UNSPECIFIC;
  }
  if (ok && !bars && c == 0xE2 && length >= 3 && (unsigned char)s[1] == 0x80 && (unsigned char)s[2] >= 0x98 &&
      (unsigned char)s[2] <= 0x9F)
    typographic_quote(r, pos, s, length);
  if (ok && !bars && *out == VS_FALSE) full_width(r, pos, s, length);
  if (ok && *out == VS_FALSE) ok = vs_intern(r->vm, t.at ? t.at : "", t.count, out);
  vs_text_close(&t);
  return ok;
}

/* Returns true if the token at the reader's position is the word `word`; upper and lower case count as equal. */
static bool same(const reader *r, const char *word) {
  size_t n = strlen(word);
  if (r->size - r->at < n) return false;
  for (size_t i = 0; i < n; i++)
    if (r->text[r->at + i] != word[i] && (r->text[r->at + i] | 32) != word[i]) return false;
  reader after = {.text = r->text, .size = r->size, .at = r->at + n};
  return is_delimiter(&after);
}

/* Reads a token that begins with #. Sets *prefix to true if the token is a prefix of the next datum, such as #; or #0=,
 * for which a level was pushed. */
static bool read_hash(reader *r, vs_value *out, bool *prefix) {
  static const struct { const char *word; vs_value value; } words[] = {
    {"#t", VS_TRUE}, {"#true", VS_TRUE}, {"#f", VS_FALSE}, {"#false", VS_FALSE}, {"#!eof", VS_EOF}};
  vs_pos pos = place(r, r->at);
  int c = peek(r, 1);
  *prefix = true;
  if (c == ';') { r->at += 2; return push(r, COMMENT, pos, 0, NO_QUOTE); }
  if (c == '(' || c == '[') { r->at += 2; return push(r, VECTOR, pos, (char)c, NO_QUOTE); }
  if (c == 'u' && peek(r, 2) == '8' && (peek(r, 3) == '(' || peek(r, 3) == '[')) {
    c = peek(r, 3);
    r->at += 4;
    return push(r, BYTEVECTOR, pos, (char)c, NO_QUOTE);
  }
  if (c >= '0' && c <= '9') {
    size_t i = 1;
    int64_t number = 0;
    while (peek(r, i) >= '0' && peek(r, i) <= '9' && number < 1000000000) number = 10 * number + (peek(r, i++) - '0');
    if (peek(r, i) == '=') {
      r->at += i + 1;
      if (!push(r, LABEL, pos, 0, NO_QUOTE)) return false;
      vs_value *slot = &r->slots[2 * (r->depth - 1)];
      if (!vs_make_box(r->vm, VS_UNDEFINED, &slot[0])) return false;
      slot = &r->slots[2 * (r->depth - 1)];
      return vs_cons(r->vm, vs_fix(number), slot[0], &slot[1]) &&
             vs_cons(r->vm, r->slots[2 * (r->depth - 1) + 1], r->labels, &r->labels);
    }
    if (peek(r, i) == '#') {
      *prefix = false;
      r->at += i + 1;
      r->label_used = true;
      for (vs_value l = r->labels; vs_is_pair(l); l = vs_cdr(l))
        if (vs_car(vs_car(l)) == vs_fix(number)) { *out = vs_cdr(vs_car(l)); return true; }
      problem(r, pos, "there is no label #%lld= before this", (long long)number);
      *out = VS_FALSE;
      return true;
    }
  }
  *prefix = false;
  if (c == '\\') { read_char(r, out); return true; }
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (same(r, words[i].word)) { r->at += strlen(words[i].word); *out = words[i].value; return true; }
  if (c == ':') {                                    /* a keyword such as #:name becomes the symbol "#:name" */
    size_t start = r->at;
    while (!is_delimiter(r)) r->at++;
    return vs_intern(r->vm, r->text + start, r->at - start, out);
  }
  return read_symbol(r, out);
}

/* Reads the closing parenthesis c. Sets *got to true if it completes a datum, which is then *out. */
static bool read_close(reader *r, char c, vs_pos pos, vs_value *out, bool *got) {
  *got = false;
  while (r->depth && r->levels[r->depth - 1].kind >= QUOTE) {     /* closes prefixes that have no datum, as in '),
                                                                   * #;) */
    if (r->levels[r->depth - 1].quote == QUOTE_PLAIN)
      problem(r, r->levels[r->depth - 1].pos,
              "a datum is missing after this '; a text is written in double quotes, \"like this\"");
    else
      problem(r, r->levels[r->depth - 1].pos, "a datum is missing here, before the %c%s", c,
              r->levels[r->depth - 1].quote == QUASI
                  ? "; a text is written in double quotes, \"like this\", not between ` and `" : "");
    pop(r);
  }
  if (!r->depth) {
    if (r->stray && r->last_top)
      problem(r, pos, "this %c closes nothing: the form of line %u was already closed on line %u", c,
              vs_pos_line(r->stray_top), r->stray_line);
    else if (r->last_top)
      problem(r, pos, "this %c closes nothing: one too many for the form of line %u", c, vs_pos_line(r->last_top));
    else problem(r, pos, "this %c closes nothing", c);
    return true;
  }
  level *f = &r->levels[r->depth - 1];
  if ((f->open == '(') != (c == ')'))
    problem(r, pos, "the %c of line %u, column %u is closed by %c; %c belongs here", f->open, vs_pos_line(f->pos),
            vs_pos_col(f->pos), c, f->open == '(' ? ')' : ']');
  *got = true;
  return close_frame(r, out);
}

/* At the first token of a line: records an open parenthesis that should be closed before this line, judging by the
 * indentation. */
static void watch_indentation(reader *r, vs_pos pos) {
  uint32_t col = vs_pos_col(pos);
  if (r->depth && !r->suspect) {
    for (size_t i = 0; i < r->depth; i++)
      if (r->levels[i].kind <= BYTEVECTOR && col <= vs_pos_col(r->levels[i].pos) &&
          vs_pos_line(r->levels[i].pos) < r->line) {
        r->suspect = r->levels[i].pos;
        r->suspect_line = r->content_line;
        break;
      }
  } else if (!r->depth && !r->stray && r->last_top && col > vs_pos_col(r->last_top)) {
    r->stray = true;
    r->stray_top = r->last_top;
    r->stray_line = r->last_close_line;
  }
  r->blank_line = false;
}

/* Reports that the lowest `count` levels of the stack were not closed. The place of the report is the innermost of
 * these levels. */
static void never_closed(reader *r, size_t count) {
  VS_ASSERT(count <= r->depth);
  if (!count) return;
  r->left_open = true;
  const level *f = &r->levels[count - 1];
  char close = f->open == '(' ? ')' : ']';
  if (r->suspect)
    problem(r, r->suspect, "this parenthesis is never closed; by the indentation a %c is missing at the end of line %u",
            close, r->suspect_line);
  else if (count > 1 && r->levels[0].kind <= BYTEVECTOR)
    problem(r, f->pos, "this parenthesis is never closed (%zu are open at the end): a %c is missing", count, close);
  else problem(r, f->pos, "this parenthesis is never closed: a %c is missing", close);
}

/* In the second reading: if a definition begins at the left margin, closes all open levels. */
static void begin_anew(reader *r, vs_pos pos) {
  static const char word[] = "(define";
  if (vs_pos_col(pos) != 1 || r->size - r->at < sizeof word || memcmp(r->text + r->at, word, sizeof word - 1)) return;
  size_t count = r->depth;
  while (count > 0 && r->levels[count - 1].kind >= QUOTE) count--;
  never_closed(r, count);
  while (r->depth) pop(r);
  r->suspect = 0;
}

/* Reads a datum at the outermost level. Returns 1, or 0 at the end of the text. If memory is out or a limit is reached,
 * sets the error and returns -1. */
static int next(reader *r, vs_value *out, vs_pos *where) {
  while (skip(r)) {
    vs_pos pos = place(r, r->at);
    if (!vs_poll(r->vm, 16)) {
      vs_condition *c = vs_is(r->vm->condition, VS_T_CONDITION) ? vs_as_condition(r->vm->condition) : NULL;
      if (c && !c->place) c->place = pos;
      return -1;
    }
    if (r->blank_line) {
      watch_indentation(r, pos);
      if (r->anew && r->depth) begin_anew(r, pos);
    }
    r->content_line = r->line;
    if (!r->depth) { *where = pos; if (r->text[r->at] != ')' && r->text[r->at] != ']') r->last_top = pos; }
    char c = r->text[r->at];
    bool ok = true, got = true;
    switch (c) {
    case '(': case '[': r->at++; ok = push(r, LIST, pos, c, NO_QUOTE); got = false; break;
    case ')': case ']':
      r->at++;
      {
        vs_pos opened = r->depth ? r->levels[r->depth - 1].pos : pos;
        ok = read_close(r, c, pos, out, &got);
        pos = opened;
      }
      break;
    case '{':
    case '}':
      problem(r, pos, "%c is not used here; parentheses are ( ) and [ ]%s", c,
              c == '{' && peek(r, 1) == '"'
                  ? "; a table is (define sizes (make-hash)), filled by (hash-set! sizes \"door\" 2)" : "");
      r->at++;
      got = false;
      break;
    case '\'': r->at++; ok = push(r, QUOTE, pos, 0, QUOTE_PLAIN); got = false; break;
    case '`': r->at++; ok = push(r, QUOTE, pos, 0, QUASI); got = false; break;
    case ',': {
      bool splice = peek(r, 1) == '@';
      char before = r->at ? r->text[r->at - 1] : ' ';
      /* Commas between elements, as in (list 1, 2, 3), are reported. */
      if (r->located && !r->quasi && peek(r, 1) == ' ' && before > ' ' && !strchr("([{'`,;", before)) {
        if (r->comma_line != r->line)
          problem(r, pos, "separate elements by blanks, not by commas: (list 1 2 3), or (xyz 1 2 3) for a point");
        r->comma_line = r->line;
        r->at++;
        got = false;
        break;
      }
      r->at += splice ? 2 : 1;
      ok = push(r, QUOTE, pos, 0, splice ? SPLICE : UNQUOTE);
      got = false;
      break;
    }
    case '"': {
      vs_text t;
      vs_text_open(r->vm, &t, 0);
      ok = read_delimited(r, '"', &t) && vs_string_from_utf8(r->vm, t.at ? t.at : "", t.count, out);
      if (ok && r->located) vs_object_of(*out)->flags |= VS_F_IMMUTABLE;
      vs_text_close(&t);
      break;
    }
    case '#': { bool prefix; ok = read_hash(r, out, &prefix); got = !prefix; break; }
    case '.':
      if (same(r, ".")) {
        r->at++;
        got = false;
        level *f = r->depth ? &r->levels[r->depth - 1] : NULL;
        if (!f || f->kind != LIST || r->slots[2 * (r->depth - 1)] == VS_NIL)
          problem(r, pos, "a . belongs before the last datum of a list");
        else if (f->dot) problem(r, pos, "a second . in one list");
        else f->dot = 1;
        break;
      } /* fall through */
    default: ok = read_symbol(r, out); break;
    }
    if (!ok) return -1;
    if (!got) continue;
    bool done;
    if (!deliver(r, out, pos, &done)) return -1;
    if (done) { r->last_close_line = r->line; return 1; }
  }
  if (r->depth && !r->cut) {
    size_t i = r->depth;
    while (i > 0 && r->levels[i - 1].kind >= QUOTE) i--;
    if (i != r->depth) problem(r, r->levels[r->depth - 1].pos, "an expression is missing after this");
    never_closed(r, i);
  }
  return 0;
}

/* ---- labels: every reference to a label is a box until the labelled datum replaces it ---- */
typedef struct { vs_value *at; size_t count, room; struct vs_roots roots; vs_scheme *vm; } work;
static bool work_push(work *w, vs_value v) {
  if (w->count == w->room) {
    size_t room = w->room ? 2 * w->room : 64;
    vs_value *at = vs_mem(w->vm, w->at, w->room * sizeof *at, room * sizeof *at);
    if (!at) return false;
    w->at = at;
    w->room = room;
  }
  w->at[w->count++] = v;
  return true;
}
static bool is_label(vs_value v) { return vs_is(v, VS_T_BOX); }
static vs_value label_value(vs_value v) {
  for (int i = 0; is_label(v) && i < 1000; i++) v = vs_as_box(v)->value;     /* follows several labels of one datum:
                                                                              * #0=#1=x */
  return v;
}
/* Replaces the boxes of labels by the labelled data. Creates no objects, so that nothing moves. Before this call, the
 * datum is a tree. */
static bool resolve_labels(reader *r, vs_value *root) {
  work w = {.vm = r->vm};
  *root = label_value(*root);
  bool ok = work_push(&w, *root);
  while (ok && w.count) {
    vs_value v = w.at[--w.count];
    if (vs_is_pair(v)) {
      vs_pair *p = vs_as_pair(v);
      if (is_label(p->car)) vs_gc_store(r->vm, p, &p->car, label_value(p->car)); else ok = work_push(&w, p->car);
      if (is_label(p->cdr)) vs_gc_store(r->vm, p, &p->cdr, label_value(p->cdr)); else ok = ok && work_push(&w, p->cdr);
    } else if (vs_is_vector(v)) {
      vs_vector *vec = vs_as_vector(v);
      for (size_t i = 0; ok && i < vec->length; i++)
        if (is_label(vec->at[i]))
          vs_gc_store(r->vm, vec, &vec->at[i], label_value(vec->at[i]));
        else
          ok = work_push(&w, vec->at[i]);
    }
  }
  if (w.at) vs_mem(r->vm, w.at, w.room * sizeof *w.at, 0);
  return ok;
}

/* ---- reading texts ---- */
static bool start(reader *r, vs_scheme *vm, const vs_passage *text, uint32_t file, bool located) {
  memset(r, 0, sizeof *r);
  r->vm = vm;
  r->text = text->at;
  r->size = text->size;
  r->file = file;
  r->line = text->line;
  r->located = located;
  r->col = 1;
  r->blank_line = true;
  r->labels = VS_NIL;
  r->roots = (struct vs_roots){NULL, vm, NULL, 0};
  vs_gc_link(&r->roots);
  if (r->size >= 3 && !memcmp(r->text, "\xEF\xBB\xBF", 3)) r->at = r->line_start = r->col_at = 3;
  return true;
}

static void finish(reader *r) {
  vs_gc_unlink(&r->roots);
  if (r->levels) vs_mem(r->vm, r->levels, r->room * sizeof *r->levels, 0);
  if (r->slots) vs_mem(r->vm, r->slots, 2 * r->room * sizeof *r->slots, 0);
}

bool vs_check_utf8(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line) {
  size_t begin = 0;
  for (size_t i = 0; i < size;) {
    unsigned char c = (unsigned char)text[i];
    if (c == '\n') { line++; begin = i + 1; }
    if (c && c < 0x80) { i++; continue; }
    uint32_t u;
    size_t n = c ? vs_utf8_decode(text + i, size - i, &u) : 0;
    if (!n) {
      uint32_t col = 1;
      for (size_t k = begin; k < i; k++) col += ((unsigned char)text[k] & 0xC0) != 0x80;
      /* A text in UTF-16, as some editors save it, begins with FF FE or FE FF. */
      bool wide = i == 0 && size > 1 && (!memcmp(text, "\xFF\xFE", 2) || !memcmp(text, "\xFE\xFF", 2));
      return vs_fail_at(vm, vm->sym.read, vs_pos_make(file, line, col), VS_NIL,
                        "this is not a text in UTF-8 (byte %02X at offset %zu)%s", c, i,
                        wide       ? "; the editor has saved it as UTF-16: save it as UTF-8"
                        : c < 0x80 ? ""
                                   : "; the editor has saved it in an older encoding, as Latin-1: save it as UTF-8");
    }
    i += n;
  }
  return true;
}

/* Compares two mistakes by their places in the text, then by the order of their detection. An unclosed parenthesis is
 * detected last, but its place is early. */
static int by_place(const void *a, const void *b) {
  const vs_pos *p = a, *q = b;
  return *p < *q ? -1 : *p > *q;
}

static bool report(reader *r) {
  vs_scheme *vm = r->vm;
  VS_ROOTS(vm, v, 3);
  qsort(r->problem, r->problems, sizeof *r->problem, by_place);
  v[0] = VS_NIL;
  for (size_t i = r->problems; i-- > 1;)
    if (!vs_string_from_utf8(vm, r->problem[i].text, strlen(r->problem[i].text), &v[1]) ||
        !vs_cons(vm, vs_fix((int64_t)r->problem[i].pos), v[1], &v[1]) || !vs_cons(vm, v[1], v[0], &v[0])) return false;
  vs_fail_at(vm, vm->sym.read, r->problem[0].pos, VS_NIL, "%s", r->problem[0].text);
  if (vs_is(vm->condition, VS_T_CONDITION) && v[0] != VS_NIL) {
    vs_condition *c = vs_as_condition(vm->condition);
    vs_gc_store(vm, c, &c->payload, v[0]);
  }
  return false;
}

/* Reads all data of the text. *anew must be true in the second reading. Sets *anew to true if a second reading is
 * necessary. */
static bool read_all(vs_scheme *vm, const vs_passage *text, uint32_t file, bool fold, bool *anew, vs_value *forms) {
  VS_ROOTS(vm, v, 3);                                  /* roots of the garbage collector: first pair, last pair,
                                                        * datum */
  reader r;
  start(&r, vm, text, file, true);
  r.fold = fold;
  r.anew = *anew;
  struct vs_roots labels = {NULL, vm, &r.labels, 1};
  labels.next = vm->roots;
  vm->roots = &labels;
  v[0] = v[1] = VS_NIL;
  int got;
  bool ok = true;
  vs_pos where = 0;
  while (ok && (got = next(&r, &v[2], &where)) == 1) {
    ok = !r.label_used || resolve_labels(&r, &v[2]);
    r.labels = VS_NIL;
    r.label_used = false;
    ok = ok && vs_cons_at(vm, v[2], VS_NIL, where, &v[2]);
    if (!ok) break;
    if (v[0] == VS_NIL) v[0] = v[2];
    else vs_gc_store(vm, vs_as_pair(v[1]), &vs_as_pair(v[1])->cdr, v[2]);
    v[1] = v[2];
  }
  ok = ok && got == 0;
  vs_pos reached = place(&r, r.at);
  vm->roots = labels.next;
  finish(&r);
  /* Releases the data that were read, so that there is memory for the error message, which shows the place of the last
   * token read. */
  if (!ok && vm->condition == vm->at.no_memory) {
    v[0] = v[1] = v[2] = VS_NIL;
    bool over_limit = vm->over_limit;
    vs_gc_major(vm);
    vs_fail_at(vm, vm->sym.memory, reached, VS_NIL, "out of memory");
    vm->over_limit = over_limit;
  }
  *anew = ok && r.left_open && !*anew;
  if (ok && r.problems) return *anew ? false : report(&r);
  *forms = v[0];
  return ok;
}

bool vs_read_all(vs_scheme *vm, const vs_passage *text, uint32_t file, bool fold, vs_value *forms) {
  bool anew = false;
  if (!vs_check_utf8(vm, text->at, text->size, file, text->line)) return false;
  return read_all(vm, text, file, fold, &anew, forms) || (anew && read_all(vm, text, file, fold, &anew, forms));
}

bool vs_read_number(vs_scheme *vm, const char *s, size_t n, vs_pos place, vs_value *out) {
  if (vs_number_parse(vm, s, n, 10, out)) return true;
  vs_value why = vm->condition;
  /* returns other errors than mistakes in the text, such as no memory, unchanged */
  if (!vs_is(why, VS_T_CONDITION) || vs_as_condition(why)->kind != vm->sym.range) return false;
  return vs_fail_at(vm, vm->sym.read, place, VS_NIL, "%.*s%s: this exact number is too large to be written out",
                    (int)(n > 60 ? 60 : n), s, n > 60 ? "..." : "");
}

bool vs_read_datum(vs_scheme *vm, const char *text, size_t size, vs_value *out, size_t *used) {
  VS_ROOTS(vm, v, 1);
  reader r;
  start(&r, vm, &(vs_passage){text, size, 1}, 0, false);
  struct vs_roots labels = {NULL, vm, &r.labels, 1};
  labels.next = vm->roots;
  vm->roots = &labels;
  vs_pos where;
  int got = next(&r, &v[0], &where);
  bool ok = got >= 0 && (got == 0 || !r.label_used || resolve_labels(&r, &v[0]));
  vm->roots = labels.next;
  finish(&r);
  if (used) *used = r.at;
  if (ok && r.problems) {
    for (size_t i = 0; i < r.problems; i++) r.problem[i].pos = 0;
    return report(&r);
  }
  *out = got ? v[0] : VS_EOF;
  return ok;
}

bool vs_file_number(vs_scheme *vm, const char *name, size_t bytes, uint32_t *number) {
  VS_ROOTS(vm, v, 2);
  if (!vs_string_from_utf8(vm, name, bytes, &v[0])) return false;
  size_t n = vs_is_vector(vm->at.files) ? vs_as_vector(vm->at.files)->length : 0;
  for (size_t i = 1; i < n; i++) {
    vs_value f = vs_as_vector(vm->at.files)->at[i];
    if (!vs_is_string(f)) continue;
    const vs_string *a = vs_as_string(f), *b = vs_as_string(v[0]);
    size_t width = a->h.flags & VS_F_WIDE ? 4 : 1;
    if (a->length == b->length && (a->h.flags & VS_F_WIDE) == (b->h.flags & VS_F_WIDE) &&
        !memcmp(vs_as_bytes(a->store)->at, vs_as_bytes(b->store)->at, a->length * width)) {
      *number = (uint32_t)i;
      return true;
    }
  }
  /* Files are numbered in order. There are few files, so the vector of their names may grow by one element each
   * time. */
  if (!vs_make_vector(vm, n ? n + 1 : 2, VS_FALSE, &v[1])) return false;
  for (size_t i = 0; i < n; i++)
    vs_gc_store(vm, vs_as_vector(v[1]), &vs_as_vector(v[1])->at[i], vs_as_vector(vm->at.files)->at[i]);
  size_t last = vs_as_vector(v[1])->length - 1;
  vs_gc_store(vm, vs_as_vector(v[1]), &vs_as_vector(v[1])->at[last], v[0]);
  vm->at.files = v[1];
  *number = (uint32_t)last;
  return true;
}
