/* Implements the reader of AutoLISP, which converts a text to forms of Scheme.
 *
 * A list stays a list, at its place; the library (autolisp) defines its first name, such as :setq. A name becomes the
 * symbol of its small letters after a colon, so that it differs from all names of Scheme:
 *
 *   Foo  nil  ()      :foo  :nil  :nil
 *   'x                (:quote :x)
 *   12  2.5  "a\n"    the number or the string
 *   (defun f ...)     (:defun :f ...), inside another list (lisp:defun :f ...)
 *
 * A variable that is never set is nil. The second form of the program, (lisp:variables assigned mentioned), therefore
 * lists the variables that the text sets, and the other names that are not only called. Open lists are on an explicit
 * stack. */
#include "vm/autolisp/autolisp_reader.h"
#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/front/text_cursor.h"
#include "vm/numbers/number.h"
#include "vm/values/heap.h"
#include "vm/values/text.h"

#include <string.h>

typedef enum { LIST, PARAMETERS, DATA, QUOTATION } list_kind;

/* A list whose closing parenthesis was not read yet. dot: 0, 1 after a dot in the list, 2 after the datum that follows
 * the dot. */
typedef struct { vs_pos pos; size_t count; uint8_t kind, dot; } level;

/* Indices in the array `work` of garbage-collector roots. work[OPEN]: a list with the element (before-first . last
 * pair) for each open list, the innermost first. */
enum { OPEN, ASSIGNED, MENTIONED, DATUM, ROOTS };

typedef struct {
  vs_scheme *vm;
  vs_text_cursor from;
  level *levels;
  size_t depth, room;
  vs_value *work;
} reader;

static vs_pos place(const reader *r) { return vs_cursor_place(&r->from); }
static int peek(const reader *r, size_t ahead) { return vs_cursor_peek(&r->from, ahead); }
static void advance(reader *r, size_t bytes) { vs_cursor_advance(&r->from, bytes); }


static bool refuse(reader *r, vs_pos pos, const char *message) {
  return vs_fail_at(r->vm, r->vm->sym.read, pos, VS_NIL, "%s", message);
}

/* Skips blanks and comments: ; to the end of the line, and ;| to |; . */
static bool skip(reader *r) {
  for (;;) {
    int c = peek(r, 0);
    if (c == ';' && peek(r, 1) == '|') {
      vs_pos pos = place(r);
      advance(r, 2);
      while (r->from.at < r->from.size && !(peek(r, 0) == '|' && peek(r, 1) == ';')) advance(r, 1);
      if (r->from.at == r->from.size) return refuse(r, pos, "this comment is never closed: |; is missing");
      advance(r, 2);
    } else if (c == ';') {
      while (r->from.at < r->from.size && peek(r, 0) != '\n' && peek(r, 0) != '\r') advance(r, 1);
    } else if (c >= 0 && c <= ' ') {
      advance(r, 1);
    } else {
      return true;
    }
  }
}

/* ---- names that the program uses ---- */

/* Returns the name at the start of the open list that is `up` levels outside the innermost one, or "" if it does not
 * start with a name. */
static const char *head(const reader *r, size_t up) {
  if (up + 1 >= r->depth) return "";
  vs_value open = r->work[OPEN];
  while (up--) open = vs_cdr(open);
  vs_value items = vs_cdr(vs_car(vs_car(open)));
  return vs_is_pair(items) && vs_is_symbol(vs_car(items)) ? vs_as_symbol(vs_car(items))->name : "";
}

static bool is_definition(const char *word) { return !strcmp(word, ":defun") || !strcmp(word, "lisp:defun"); }

/* Returns true if the next item of the innermost open list is a variable that this list sets, as in (setq variable
 * value). */
static bool is_assigned(const reader *r) {
  const level *l = &r->levels[r->depth - 1];
  const char *word = head(r, 0);
  if (l->kind == PARAMETERS) return true;
  if (!strcmp(word, ":setq")) return l->count % 2 == 1;
  return l->count == 1 && (!strcmp(word, ":foreach") || !strcmp(word, "lisp:defun"));
}

/* Returns true if the next item of the innermost open list is a name that this list only calls or defines. */
static bool is_only_called(const reader *r) {
  const level *l = &r->levels[r->depth - 1];
  if (r->depth == 1 || l->kind == QUOTATION) return false;
  if (l->count == 0) return strcmp(head(r, 1), ":cond") != 0;
  return l->count == 1 && !strcmp(head(r, 0), ":defun");
}

static bool note_name(reader *r, vs_value name) {
  if (r->levels[r->depth - 1].kind == PARAMETERS && !strcmp(vs_as_symbol(name)->name, ":/")) return true;
  if (is_assigned(r)) return vs_idtable_put(r->vm, &r->work[ASSIGNED], name, VS_TRUE);
  return is_only_called(r) || vs_idtable_put(r->vm, &r->work[MENTIONED], name, VS_TRUE);
}

/* ---- lists that are being built ---- */

static bool open_list(reader *r, list_kind kind, vs_pos pos) {
  if (r->depth == r->room) {
    size_t room = r->room ? 2 * r->room : 32;
    level *levels = vs_mem(r->vm, r->levels, r->room * sizeof *levels, room * sizeof *levels);
    if (!levels) return false;
    r->levels = levels;
    r->room = room;
  }
  VS_ROOTS(r->vm, p, 1);
  if (!vs_cons_at(r->vm, VS_FALSE, VS_NIL, pos, &p[0]) || !vs_cons(r->vm, p[0], p[0], &p[0]) ||
      !vs_cons(r->vm, p[0], r->work[OPEN], &r->work[OPEN]))
    return false;
  r->levels[r->depth++] = (level){ .pos = pos, .kind = (uint8_t)kind };
  return true;
}

/* Appends work[DATUM] to the innermost open list. */
static bool append(reader *r, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  level *l = &r->levels[r->depth - 1];
  vs_pair *ends = vs_as_pair(vs_car(r->work[OPEN]));
  if (l->dot == 1) {
    vs_pair *last = vs_as_pair(ends->cdr);
    vs_gc_store(r->vm, last, &last->cdr, r->work[DATUM]);
    l->dot = 2;
    return true;
  }
  if (l->dot) return refuse(r, pos, "only one datum can follow a dot");
  if (!vs_cons_at(r->vm, r->work[DATUM], VS_NIL, pos, &p[0])) return false;
  ends = vs_as_pair(vs_car(r->work[OPEN]));
  vs_pair *last = vs_as_pair(ends->cdr);
  vs_gc_store(r->vm, last, &last->cdr, p[0]);
  vs_gc_store(r->vm, ends, &ends->cdr, p[0]);
  l->count++;
  return true;
}

/* Moves the innermost open list to work[DATUM]. Returns the place of the list in the source text. */
static vs_pos take_list(reader *r) {
  vs_pos pos = r->levels[--r->depth].pos;
  vs_value list = vs_cdr(vs_car(vs_car(r->work[OPEN])));
  r->work[OPEN] = vs_cdr(r->work[OPEN]);
  r->work[DATUM] = list;
  if (vs_is_pair(list)) ((vs_located_pair *)(void *)vs_object_of(list))->pos = pos;
  return pos;
}

/* Adds work[DATUM] to the innermost open list. If that list is a quotation, it is then complete and is itself added to
 * the list around it. */
static bool add(reader *r, vs_pos pos) {
  for (;;) {
    if (!append(r, pos)) return false;
    if (r->levels[r->depth - 1].kind != QUOTATION) return true;
    pos = take_list(r);
  }
}

static bool open_quotation(reader *r, vs_pos pos) {
  advance(r, 1);
  return open_list(r, QUOTATION, pos) && vs_intern_c(r->vm, ":quote", &r->work[DATUM]) && append(r, pos);
}

static bool open_parenthesis(reader *r, vs_pos pos) {
  const level *l = &r->levels[r->depth - 1];
  const char *word = head(r, 0);
  list_kind kind = l->kind == DATA ? DATA : LIST;
  bool function = !strcmp(word, ":lambda");
  if ((is_definition(word) && l->count == 2) || (function && l->count == 1)) kind = PARAMETERS;
  else if (l->kind == QUOTATION || (!strcmp(word, ":quote") && l->count == 1)) kind = DATA;
  advance(r, 1);
  return open_list(r, kind, pos);
}

static bool close_parenthesis(reader *r, vs_pos pos) {
  const level *l = &r->levels[r->depth - 1];
  advance(r, 1);
  if (l->kind == QUOTATION) return refuse(r, l->pos, "a datum is missing after this '");
  if (r->depth == 1) return refuse(r, pos, "this ) closes nothing");
  if (l->dot == 1) return refuse(r, pos, "a datum is missing after the dot");
  vs_pos start = take_list(r);
  return (r->work[DATUM] != VS_NIL || vs_intern_c(r->vm, ":nil", &r->work[DATUM])) && add(r, start);
}

/* ---- atoms ---- */

static bool ends_atom(int c) { return c <= ' ' || strchr("()'\";", c); }
static bool is_digit(int c) { return c >= '0' && c <= '9'; }

/* Returns true if the atom of n bytes is a number. Sets *whole to true if it has neither a point nor an exponent. */
static bool is_number(const char *s, size_t n, bool *whole) {
  size_t i = n > 1 && (*s == '-' || *s == '+'), digits = 0;
  for (; i < n && is_digit(s[i]); i++) digits++;
  *whole = i == n;
  if (i < n && s[i] == '.') for (i++; i < n && is_digit(s[i]); i++) digits++;
  if (!digits) return false;
  if (i < n && (s[i] == 'e' || s[i] == 'E')) {
    i += i + 1 < n && (s[i + 1] == '-' || s[i + 1] == '+') ? 2 : 1;
    if (i == n) return false;
    while (i < n && is_digit(s[i])) i++;
  }
  return i == n;
}

/* Reads a number. A whole number that does not fit into 32 bits becomes a real number, as in AutoLISP. */
static bool read_number(reader *r, size_t n, bool whole, vs_pos pos) {
  size_t plus = peek(r, 0) == '+';
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  bool ok = vs_read_number(r->vm, r->from.text + r->from.at + plus, n - plus, pos, &r->work[DATUM]);
  vs_value v = r->work[DATUM];
  bool small = vs_is_fixnum(v) && vs_fixnum(v) <= INT32_MAX && vs_fixnum(v) >= INT32_MIN;
  if (ok && whole && !small)
    ok = vs_text_put(&t, r->from.text + r->from.at + plus, n - plus) && vs_text_puts(&t, ".0") &&
         vs_read_number(r->vm, t.at, t.count, pos, &r->work[DATUM]);
  vs_text_close(&t);
  if (ok && !vs_is_number(r->work[DATUM])) return refuse(r, pos, "this is no number in the allowed range");
  if (ok) advance(r, n);
  return ok && add(r, pos);
}

static bool read_name(reader *r, size_t n, vs_pos pos) {
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  bool ok = vs_text_puts(&t, ":");
  for (size_t i = 0; ok && i < n; i++) {
    char c = r->from.text[r->from.at + i];
    if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
    ok = vs_text_put(&t, &c, 1);
  }
  bool inner = ok && t.count == 6 && !memcmp(t.at, ":defun", 6) && r->depth > 2 && !r->levels[r->depth - 1].count &&
               r->levels[r->depth - 1].kind == LIST;
  ok = ok && (inner ? vs_intern_c(r->vm, "lisp:defun", &r->work[DATUM])
                    : vs_intern(r->vm, t.at, t.count, &r->work[DATUM]));
  vs_text_close(&t);
  advance(r, n);
  return ok && note_name(r, r->work[DATUM]) && add(r, pos);
}

static bool read_dot(reader *r, vs_pos pos) {
  level *l = &r->levels[r->depth - 1];
  advance(r, 1);
  if (r->depth == 1 || l->kind == QUOTATION || !l->count || l->dot) return refuse(r, pos, "a dot is out of place here");
  l->dot = 1;
  return true;
}

static bool read_atom(reader *r, vs_pos pos) {
  size_t n = 0;
  bool whole;
  while (!ends_atom(peek(r, n))) n++;
  const char *s = r->from.text + r->from.at;
  if (n == 1 && *s == '.') return read_dot(r, pos);
  return is_number(s, n, &whole) ? read_number(r, n, whole, pos) : read_name(r, n, pos);
}

/* Returns the value of the at most `most` digits of base `base` that begin at offset `from`. Sets *n to the number of
 * these digits. */
static uint32_t digits_value(const reader *r, size_t from, size_t most, uint32_t base, size_t *n) {
  uint32_t value = 0;
  for (*n = 0; *n < most; ++*n) {
    int c = peek(r, from + *n), small = c | 32, digit = 99;
    if (is_digit(c)) digit = c - '0';
    else if (small >= 'a' && small <= 'f') digit = small - 'a' + 10;
    if ((uint32_t)digit >= base) break;
    value = value * base + (uint32_t)digit;
  }
  return value;
}

/* Reads an escape after its backslash: \n \r \t \e, three octal digits, U+ and four hexadecimal digits, or a
 * character. */
static bool read_escape(reader *r, vs_text *t) {
  static const char marks[] = "nrte", meanings[] = "\n\r\t\033";
  int c = peek(r, 0);
  size_t n;
  const char *mark = c > 0 ? strchr(marks, c) : NULL;
  uint32_t code = digits_value(r, 0, 3, 8, &n);
  if (!n && (c == 'U' || c == 'u') && peek(r, 1) == '+') {
    code = digits_value(r, 2, 4, 16, &n);
    n = n == 4 ? 6 : 0;
    if (code >= 0xD800 && code < 0xE000) code = 0xFFFD;
  }
  if (n) return advance(r, n), vs_text_char(t, code);
  if (c < 0) return true;
  char plain = mark ? meanings[mark - marks] : (char)c;
  advance(r, 1);
  return vs_text_put(t, &plain, 1);
}

static bool read_string(reader *r, vs_pos pos) {
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  advance(r, 1);
  bool ok = true;
  while (ok && peek(r, 0) >= 0 && peek(r, 0) != '"') {
    char c = r->from.text[r->from.at];
    advance(r, 1);
    ok = c == '\\' ? read_escape(r, &t) : vs_text_put(&t, &c, 1);
  }
  if (ok && peek(r, 0) < 0) ok = refuse(r, pos, "this string is never closed: a \" is missing");
  if (ok) advance(r, 1);
  ok = ok && vs_string_from_utf8(r->vm, t.at ? t.at : "", t.count, &r->work[DATUM]);
  vs_text_close(&t);
  if (ok) vs_object_of(r->work[DATUM])->flags |= VS_F_IMMUTABLE;
  return ok && add(r, pos);
}

static bool read_token(reader *r) {
  vs_pos pos = place(r);
  switch (peek(r, 0)) {
  case '(': return open_parenthesis(r, pos);
  case ')': return close_parenthesis(r, pos);
  case '\'': return open_quotation(r, pos);
  case '"': return read_string(r, pos);
  default: return read_atom(r, pos);
  }
}

/* ---- the program around the text ---- */

/* Sets *out to a list of the keys of `table` whose value is #t, except those that also have the value #t in the table
 * `known`. */
static bool names(reader *r, vs_value table, vs_value known, vs_value *out) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = table, p[2] = known;
  vs_value key, value;
  for (size_t i = 0; vs_idtable_slot(p[1], i, &key, &value); i++) {
    if (key == VS_VACANT || value != VS_TRUE || (p[2] != VS_NIL && vs_idtable_get(p[2], key) == VS_TRUE)) continue;
    if (!vs_cons(r->vm, key, p[0], &p[0])) return false;
  }
  *out = p[0];
  return true;
}

/* Puts two forms before the forms in `rest`: the import of the library (autolisp) and (lisp:variables assigned
 * mentioned). */
static bool begin(reader *r, vs_value rest, vs_value *out) {
  vs_scheme *vm = r->vm;
  static const char text[] = "(import (autolisp))";
  vs_pos pos = vs_pos_make(r->from.file, 1, 1);
  VS_ROOTS(vm, p, 3);
  p[2] = rest;
  return names(r, r->work[MENTIONED], r->work[ASSIGNED], &p[0]) && vs_cons_at(vm, p[0], VS_NIL, pos, &p[1]) &&
         names(r, r->work[ASSIGNED], VS_NIL, &p[0]) && vs_cons_at(vm, p[0], p[1], pos, &p[1]) &&
         vs_intern_c(vm, "lisp:variables", &p[0]) && vs_cons_at(vm, p[0], p[1], pos, &p[1]) &&
         vs_cons_at(vm, p[1], p[2], pos, &p[2]) && vs_read_datum(vm, text, sizeof text - 1, &p[0], NULL) &&
         vs_cons_at(vm, p[0], p[2], pos, out);
}

static bool finish(reader *r) {
  const level *l = &r->levels[r->depth - 1];
  if (r->depth > 1)
    return refuse(r, l->pos, l->kind == QUOTATION ? "a datum is missing after this '" : "this ( is never closed");
  vs_pos pos = place(r);
  return vs_intern_c(r->vm, "lisp:finish", &r->work[DATUM]) &&
         vs_cons_at(r->vm, r->work[DATUM], VS_NIL, pos, &r->work[DATUM]) && append(r, pos);
}

bool vs_autolisp_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms) {
  if (!vs_check_utf8(vm, text, size, file, line)) return false;
  VS_ROOTS(vm, p, ROOTS);
  for (int i = 0; i < ROOTS; i++) p[i] = VS_NIL;
  reader r = { .vm = vm, .from = { .text = text, .size = size, .file = file, .line = line, .col = 1 }, .work = p };
  bool ok = vs_idtable_new(vm, &p[ASSIGNED]) && vs_idtable_new(vm, &p[MENTIONED]) &&
            open_list(&r, LIST, vs_pos_make(file, line, 1));
  if (ok && size >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3)) r.from.at = 3;
  while (ok && (ok = skip(&r)) && r.from.at < size) ok = read_token(&r);
  ok = ok && finish(&r) && begin(&r, vs_cdr(vs_car(vs_car(p[OPEN]))), forms);
  if (r.levels) vs_mem(vm, r.levels, r.room * sizeof *r.levels, 0);
  return ok;
}
