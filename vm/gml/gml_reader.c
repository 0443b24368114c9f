/* Implements the reader of the Generative Modeling Language, which converts tokens to forms of Scheme.
 *
 * Each token becomes one form at the token's place, so that errors, limits and warnings refer to the token:
 *
 *   add          (gml:call 'add)
 *   A.b.c   .b   (gml:path '(A b c))   (gml:member '(b))
 *   12 "s" /n    (gml:push '12), in runs (gml:push-all '(12 "s" n))
 *   (1,2,3)      (gml:push (gml:point 1 2 3))
 *   !x   :x  ;x  (set! !x (gml:pop '!x))   (gml:register !x '!x)   (gml:value !x '!x)
 *   { ... }      (gml:push (gml:procedure '#(tokens) (lambda () forms ... #t)))
 *
 * A register is a variable of the nearest enclosing braces with usereg, or else of the file. The final #t of a body
 * keeps the activation of the call before it, so that an error reports that call. Open braces are on an explicit
 * stack. */
#include "vm/gml/gml_reader.h"
#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/front/text_cursor.h"
#include "vm/numbers/number.h"
#include "vm/values/heap.h"
#include "vm/values/text.h"

#include <stdio.h>

/* Indices of the data for a pair of braces. They are the lists of forms and of tokens, each with its last pair; the
 * literals not yet pushed; the registers (VS_NIL: none yet); and the data of the enclosing braces. The data are
 * elements of a vector, so that one root of the garbage collector suffices for all open braces. */
enum { FORMS, FORMS_LAST, TOKENS, TOKENS_LAST, LITERALS, LITERALS_LAST, REGISTERS, AROUND, SLOTS };

typedef struct { vs_pos pos, literals; bool usereg; } level;

typedef struct {
  vs_scheme *vm;
  vs_text_cursor from;
  level *levels;
  size_t depth, room;
  vs_value *work;          /* a root of the garbage collector: the vector of the innermost open braces */
} reader;

static vs_pos place(const reader *r) { return vs_cursor_place(&r->from); }
static int peek(const reader *r, size_t ahead) { return vs_cursor_peek(&r->from, ahead); }
static void advance(reader *r, size_t bytes) { vs_cursor_advance(&r->from, bytes); }

static vs_value slot(const reader *r, int which) { return vs_as_vector(*r->work)->at[which]; }
static void set_slot(reader *r, int which, vs_value v) {
  vs_vector *work = vs_as_vector(*r->work);
  vs_gc_store(r->vm, work, &work->at[which], v);
}

static bool refuse(reader *r, vs_pos pos, const char *message) {
  return vs_fail_at(r->vm, r->vm->sym.read, pos, VS_NIL, "%s", message);
}

static void skip(reader *r) {
  for (;;) {
    int c = peek(r, 0);
    if (c == '%') while (r->from.at < r->from.size && peek(r, 0) != '\n' && peek(r, 0) != '\r') advance(r, 1);
    else if (c >= 0 && c <= ' ') advance(r, 1);
    else return;
  }
}

static bool ends_name(int c) { return c <= ' ' || strchr("()[]{}/;:!.,\"%", c); }

static size_t name_length(const reader *r, size_t from) {
  size_t n = 0;
  while (!ends_name(peek(r, from + n))) n++;
  return n;
}

/* ---- lists that are being built ---- */

static bool append(reader *r, int list, vs_value v, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  if (!vs_cons_at(r->vm, v, VS_NIL, pos, &p[0])) return false;
  if (slot(r, list) == VS_NIL) {
    set_slot(r, list, p[0]);
  } else {
    vs_pair *last = vs_as_pair(slot(r, list + 1));
    vs_gc_store(r->vm, last, &last->cdr, p[0]);
  }
  set_slot(r, list + 1, p[0]);
  return true;
}

/* Sets *out to the form (word a), or to (word a b) if b is not NULL. a and b point to roots of the garbage
 * collector. */
static bool form(reader *r, const char *word, const vs_value *a, const vs_value *b, vs_pos pos, vs_value *out) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL;
  return (!b || vs_cons_at(r->vm, *b, VS_NIL, pos, &p[0])) && (!a || vs_cons_at(r->vm, *a, p[0], pos, &p[0])) &&
         vs_intern_c(r->vm, word, &p[1]) && vs_cons_at(r->vm, p[1], p[0], pos, out);
}

static bool quoted(reader *r, const vs_value *v, vs_pos pos, vs_value *out) {
  return form(r, "quote", v, NULL, pos, out);
}

static bool emit(reader *r, const char *word, const vs_value *a, const vs_value *b, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  return form(r, word, a, b, pos, &p[0]) && append(r, FORMS, p[0], pos);
}

static bool flush(reader *r) {
  vs_value literals = slot(r, LITERALS);
  if (literals == VS_NIL) return true;
  VS_ROOTS(r->vm, p, 1);
  vs_pos pos = r->levels[r->depth - 1].literals;
  bool one = vs_cdr(literals) == VS_NIL;
  p[0] = one ? vs_car(literals) : literals;
  if (!quoted(r, &p[0], pos, &p[0]) || !emit(r, one ? "gml:push" : "gml:push-all", &p[0], NULL, pos)) return false;
  set_slot(r, LITERALS, VS_NIL);
  set_slot(r, LITERALS_LAST, VS_NIL);
  return true;
}

/* Adds a datum to the literals of the innermost braces, which must exist. */
static bool literal(reader *r, const vs_value *v, vs_pos pos) {
  VS_ASSERT(r->depth > 0);
  if (slot(r, LITERALS) == VS_NIL) r->levels[r->depth - 1].literals = pos;
  return append(r, LITERALS, *v, pos) && append(r, TOKENS, *v, pos);
}

/* Adds a token that is not a literal: its form to the list of forms, and (token argument) to the list of tokens, which
 * a program may examine. */
static bool active(reader *r, const char *word, const vs_value *argument, const char *token, vs_pos pos) {
  VS_ROOTS(r->vm, p, 2);
  return flush(r) && quoted(r, argument, pos, &p[0]) && emit(r, word, &p[0], NULL, pos) &&
         form(r, token, argument, NULL, pos, &p[1]) && append(r, TOKENS, p[1], pos);
}

/* ---- registers ---- */

/* Adds the register to those of the innermost braces, unless they contain it already. name points to a root of the
 * garbage collector. */
static bool know_register(reader *r, const vs_value *name) {
  VS_ROOTS(r->vm, p, 1);
  p[0] = slot(r, REGISTERS);
  bool ok = (p[0] != VS_NIL || vs_idtable_new(r->vm, &p[0])) && vs_idtable_put(r->vm, &p[0], *name, VS_TRUE);
  if (ok) set_slot(r, REGISTERS, p[0]);
  return ok;
}

static bool read_register(reader *r, int mark, vs_pos pos) {
  VS_ROOTS(r->vm, p, 3);
  size_t n = name_length(r, 1);
  if (!n) return refuse(r, pos, mark == '!' ? "a register is set by !name" : "a register is read by :name");
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  bool ok = vs_text_puts(&t, "!") && vs_text_put(&t, r->from.text + r->from.at + 1, n) &&
      vs_intern(r->vm, t.at, t.count, &p[0]);
  vs_text_close(&t);
  if (!ok || !flush(r) || !know_register(r, &p[0]) || !quoted(r, &p[0], pos, &p[1])) return false;
  advance(r, n + 1);
  if (mark == '!') ok = form(r, "gml:pop", &p[1], NULL, pos, &p[2]) && emit(r, "set!", &p[0], &p[2], pos);
  else ok = emit(r, mark == ':' ? "gml:register" : "gml:value", &p[0], &p[1], pos);
  return ok && form(r, mark == '!' ? "set-register" : mark == ':' ? "register" : "value", &p[0], NULL, pos, &p[2]) &&
         append(r, TOKENS, p[2], pos);
}

/* ---- opening and closing braces ---- */

static bool open_frame(reader *r, vs_pos pos) {
  if (r->depth == r->room) {
    size_t room = r->room ? 2 * r->room : 16;
    level *levels = vs_mem(r->vm, r->levels, r->room * sizeof *levels, room * sizeof *levels);
    if (!levels) return false;
    r->levels = levels;
    r->room = room;
  }
  VS_ROOTS(r->vm, p, 1);
  if (!vs_make_vector(r->vm, SLOTS, VS_NIL, &p[0])) return false;
  vs_value around = *r->work;
  *r->work = p[0];
  set_slot(r, AROUND, around);
  r->levels[r->depth++] = (level){ .pos = pos };
  return true;
}

/* Sets *out to `rest` with declarations of the innermost braces' registers before it: the list ((!x gml:unset) ...), or
 * at top level forms (define !x gml:unset). */
static bool declare(reader *r, bool top, vs_pos pos, vs_value rest, vs_value *out) {
  VS_ROOTS(r->vm, p, 4);
  p[0] = rest;
  vs_value key, value;
  if (!vs_intern_c(r->vm, "gml:unset", &p[1])) return false;
  for (size_t i = 0; slot(r, REGISTERS) != VS_NIL && vs_idtable_slot(slot(r, REGISTERS), i, &key, &value); i++) {
    if (key == VS_VACANT || value != VS_TRUE) continue;
    p[2] = key;
    bool ok = top ? form(r, "define", &p[2], &p[1], pos, &p[3])
                  : vs_cons_at(r->vm, p[1], VS_NIL, pos, &p[3]) && vs_cons_at(r->vm, p[2], p[3], pos, &p[3]);
    if (!ok || !vs_cons_at(r->vm, p[3], p[0], pos, &p[0])) return false;
  }
  *out = p[0];
  return true;
}

/* Adds the registers in *from, which belong to braces without usereg, to those of the enclosing braces, which are now
 * the innermost. If the enclosing braces have no registers, they get the table *from itself. The time thus stays
 * proportional to the depth of nesting. */
static bool pass_registers(reader *r, const vs_value *from) {
  vs_value key, value;
  VS_ROOTS(r->vm, p, 1);
  if (*from == VS_NIL) return true;
  if (slot(r, REGISTERS) == VS_NIL) return set_slot(r, REGISTERS, *from), true;
  for (size_t i = 0; vs_idtable_slot(*from, i, &key, &value); i++) {
    p[0] = key;
    if (key != VS_VACANT && value == VS_TRUE && !know_register(r, &p[0])) return false;
  }
  return true;
}

static bool close_frame(reader *r) {
  vs_scheme *vm = r->vm;
  VS_ROOTS(vm, p, 6);
  const level f = r->levels[r->depth - 1];
  vs_pos pos = f.pos;
  if (!flush(r) || !append(r, FORMS, VS_TRUE, pos)) return false;
  p[0] = slot(r, FORMS);
  p[4] = VS_NIL;
  p[5] = f.usereg ? VS_NIL : slot(r, REGISTERS);
  if (f.usereg) {
    if (!declare(r, false, pos, VS_NIL, &p[4])) return false;
    if (p[4] != VS_NIL && (!vs_intern_c(vm, "let", &p[1]) || !vs_cons_at(vm, p[4], p[0], pos, &p[0]) ||
        !vs_cons_at(vm, p[1], p[0], pos, &p[0]) || !vs_cons_at(vm, p[0], VS_NIL, pos, &p[0]))) return false;
  }
  p[4] = VS_NIL;
  if (!vs_intern_c(vm, "lambda", &p[1]) || !vs_cons_at(vm, p[4], p[0], pos, &p[0]) ||
      !vs_cons_at(vm, p[1], p[0], pos, &p[0])) return false;
  size_t count = 0;
  for (vs_value v = slot(r, TOKENS); vs_is_pair(v); v = vs_cdr(v)) count++;
  if (!vs_make_vector(vm, count, VS_FALSE, &p[1])) return false;
  size_t i = 0;
  for (vs_value v = slot(r, TOKENS); vs_is_pair(v); v = vs_cdr(v), i++)
    vs_gc_store(vm, vs_as_vector(p[1]), &vs_as_vector(p[1])->at[i], vs_car(v));
  vs_object_of(p[1])->flags |= VS_F_IMMUTABLE;
  *r->work = slot(r, AROUND);
  r->depth--;
  return pass_registers(r, &p[5]) && quoted(r, &p[1], pos, &p[2]) &&
         form(r, "gml:procedure", &p[2], &p[0], pos, &p[3]) && emit(r, "gml:push", &p[3], NULL, pos) &&
         form(r, "procedure", &p[1], NULL, pos, &p[2]) && append(r, TOKENS, p[2], pos);
}

/* ---- reading tokens ---- */

/* Returns the length in bytes of the number at offset `from`, or 0 if there is none. Digits followed by letters, such
 * as 2nd, are no number. */
static size_t number_length(const reader *r, size_t from) {
  size_t n = from;
  if (peek(r, n) == '-' || peek(r, n) == '+') n++;
  size_t digits = 0;
  while (peek(r, n) >= '0' && peek(r, n) <= '9') n++, digits++;
  if (peek(r, n) == '.' && (digits || (peek(r, n + 1) >= '0' && peek(r, n + 1) <= '9'))) {
    n++;
    while (peek(r, n) >= '0' && peek(r, n) <= '9') n++, digits++;
  }
  if (!digits) return 0;
  if (peek(r, n) == 'e' || peek(r, n) == 'E') {
    size_t e = n + 1;
    if (peek(r, e) == '-' || peek(r, e) == '+') e++;
    if (peek(r, e) >= '0' && peek(r, e) <= '9') {
      while (peek(r, e) >= '0' && peek(r, e) <= '9') e++;
      n = e;
    }
  }
  return ends_name(peek(r, n)) ? n - from : 0;
}

static bool read_number(reader *r, size_t n, vs_pos pos, vs_value *out) {
  size_t plus = peek(r, 0) == '+';
  if (!vs_read_number(r->vm, r->from.text + r->from.at + plus, n - plus, pos, out)) return false;
  if (!vs_is_number(*out)) return refuse(r, pos, "this is no number in the allowed range");
  advance(r, n);
  return true;
}

static bool read_vector(reader *r, vs_pos pos) {
  VS_ROOTS(r->vm, p, 5);
  static const char message[] = "a vector is written (x,y) or (x,y,z), of numbers";
  int count = 0;
  advance(r, 1);
  for (;;) {
    skip(r);
    size_t n = number_length(r, 0);
    if (!n || count == 3) return refuse(r, pos, message);
    if (!read_number(r, n, place(r), &p[count++])) return false;
    skip(r);
    int c = peek(r, 0);
    if (c != ',' && c != ')') return refuse(r, pos, message);
    advance(r, 1);
    if (c == ')') break;
  }
  if (count < 2) return refuse(r, pos, message);
  p[3] = VS_NIL;
  for (int i = count; i--;) if (!vs_cons_at(r->vm, p[i], p[3], pos, &p[3])) return false;
  const char *word = count == 3 ? "gml:point" : "gml:vector2";
  if (!flush(r) || !vs_intern_c(r->vm, word, &p[4]) || !vs_cons_at(r->vm, p[4], p[3], pos, &p[4]) ||
      !emit(r, "gml:push", &p[4], NULL, pos)) return false;
  return vs_intern_c(r->vm, "vector", &p[4]) && vs_cons_at(r->vm, p[4], p[3], pos, &p[4]) &&
         append(r, TOKENS, p[4], pos);
}

static bool read_string(reader *r, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  advance(r, 1);
  bool ok = true;
  while (ok && peek(r, 0) >= 0 && peek(r, 0) != '"') {
    bool escaped = peek(r, 0) == '\\' && (peek(r, 1) == '"' || peek(r, 1) == '\\' || peek(r, 1) == 'n');
    char c = r->from.text[r->from.at + escaped];
    if (escaped && c == 'n') c = '\n';
    advance(r, escaped ? 2 : 1);
    ok = vs_text_put(&t, &c, 1);
  }
  if (ok && peek(r, 0) < 0) ok = refuse(r, pos, "this string is never closed: a \" is missing");
  if (ok) advance(r, 1);
  ok = ok && vs_string_from_utf8(r->vm, t.at ? t.at : "", t.count, &p[0]);
  vs_text_close(&t);
  if (ok) vs_object_of(p[0])->flags |= VS_F_IMMUTABLE;
  return ok && literal(r, &p[0], pos);
}

/* Reads a name, or several names with dots between them, into a list. Sets *count to the number of dots. */
static bool read_names(reader *r, size_t *count, vs_value *list) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL;
  for (*count = 0;; (*count)++) {
    size_t n = name_length(r, 0);
    if (!n) return refuse(r, place(r), "a name is missing here");
    if (!vs_intern(r->vm, r->from.text + r->from.at, n, &p[1]) || !vs_cons(r->vm, p[1], p[0], &p[0])) return false;
    advance(r, n);
    if (peek(r, 0) != '.') break;
    advance(r, 1);
  }
  ++*count;
  *list = VS_NIL;
  for (; vs_is_pair(p[0]); p[0] = vs_cdr(p[0])) if (!vs_cons(r->vm, vs_car(p[0]), *list, list)) return false;
  return true;
}

static bool read_name(reader *r, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  size_t count;
  bool member = peek(r, 0) == '.';
  if (member) advance(r, 1);
  if (!read_names(r, &count, &p[0])) return false;
  if (member) return active(r, "gml:member", &p[0], "member", pos);
  if (count > 1) return active(r, "gml:path", &p[0], "path", pos);
  p[0] = vs_car(p[0]);
  if (!strcmp(vs_as_symbol(p[0])->name, "usereg")) {
    r->levels[r->depth - 1].usereg = true;
    return true;
  }
  return active(r, "gml:call", &p[0], "call", pos);
}

static bool read_literal_name(reader *r, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  size_t n = name_length(r, 1);
  if (!n) return refuse(r, pos, "a name is missing after this /");
  if (!vs_intern(r->vm, r->from.text + r->from.at + 1, n, &p[0])) return false;
  advance(r, n + 1);
  return literal(r, &p[0], pos);
}

static bool read_token(reader *r) {
  vs_pos pos = place(r);
  int c = peek(r, 0);
  VS_ROOTS(r->vm, p, 1);
  size_t n = number_length(r, 0);
  if (n) return read_number(r, n, pos, &p[0]) && literal(r, &p[0], pos);
  switch (c) {
  case '(': return read_vector(r, pos);
  case '"': return read_string(r, pos);
  case '/': return read_literal_name(r, pos);
  case '!': case ':': case ';': return read_register(r, c, pos);
  case '{': advance(r, 1); return flush(r) && open_frame(r, pos);
  case '}':
    if (r->depth == 1) return refuse(r, pos, "this } closes nothing");
    advance(r, 1);
    return close_frame(r);
  case '[': case ']':
    advance(r, 1);
    return vs_intern_c(r->vm, c == '[' ? "[" : "]", &p[0]) && active(r, "gml:call", &p[0], "call", pos);
  case ')': case ',': return refuse(r, pos, "a vector is written (x,y) or (x,y,z), of numbers");
  default: return read_name(r, pos);
  }
}

/* Sets *out to `rest` with (import (only (scheme base) define lambda let quote set!) (gml)) before it. */
static bool import(reader *r, vs_value rest, vs_value *out) {
  vs_scheme *vm = r->vm;
  static const char text[] = "(import (only (scheme base) define lambda let quote set!) (gml))";
  VS_ROOTS(vm, p, 2);
  p[1] = rest;
  return vs_read_datum(vm, text, sizeof text - 1, &p[0], NULL) &&
         vs_cons_at(vm, p[0], p[1], vs_pos_make(r->from.file, 1, 1), out);
}

bool vs_gml_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms) {
  if (!vs_check_utf8(vm, text, size, file, line)) return false;
  VS_ROOTS(vm, p, 2);
  p[0] = p[1] = VS_NIL;
  reader r = { .vm = vm, .from = { .text = text, .size = size, .file = file, .line = line, .col = 1 }, .work = &p[0] };
  bool ok = open_frame(&r, vs_pos_make(file, line, 1));
  if (ok && size >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3)) r.from.at = 3;
  while (ok && (skip(&r), r.from.at < size)) ok = read_token(&r);
  if (ok && r.depth > 1) ok = refuse(&r, r.levels[r.depth - 1].pos, "this { is never closed");
  ok = ok && flush(&r) && emit(&r, "gml:finish", NULL, NULL, place(&r)) &&
       declare(&r, true, place(&r), slot(&r, FORMS), &p[1]) && import(&r, p[1], &p[1]);
  if (r.levels) vs_mem(vm, r.levels, r.room * sizeof *r.levels, 0);
  if (ok) *forms = p[1];
  return ok;
}
