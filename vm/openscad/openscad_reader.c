/* Implements the reader of OpenSCAD, which converts tokens to a tree of data. The program becomes two forms:
 *
 *   (import (openscad))
 *   (scad:program (statement ...) (statement ...) ...)
 *
 * The first list is the main file, the others are the files that `use` names. README.md has the table of trees.
 *
 * Statements and expressions within each other are read by recursion down to DEPTH levels. */
#include "vm/openscad/openscad_reader.h"

#include <string.h>

#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/front/source.h"
#include "vm/openscad/openscad_scanner.h"
#include "vm/values/heap.h"
#include "vm/values/text.h"

enum { DEPTH = 400 };

/* A list under construction: at[0] is the list, at[1] its last pair. Both are roots of the garbage collector. */
typedef struct { vs_value *at; } list;

typedef struct {
  vs_scheme *vm;
  vs_scad_scanner in;
  vs_scad_token now, ahead;   /* the current token and the next */
  unsigned depth;
  bool main;                  /* reads the main file */
  bool parameters;            /* no module and no function was read yet: assignments are parameters of the customizer */
  vs_value *used;             /* root: a list of (file number . path), the last found first */
  size_t used_count;
} reader;

static bool expression(reader *r, vs_value *out);
static bool element(reader *r, vs_value *out);
static bool statement(reader *r, list to);

static bool refuse(reader *r, vs_pos pos, const char *message) {
  return vs_fail_at(r->vm, r->vm->sym.read, pos, VS_NIL, "%s", message);
}

static bool advance(reader *r) {
  r->now = r->ahead;
  return vs_scad_next(&r->in, &r->ahead);
}

static bool is(const reader *r, const char *mark) { return vs_scad_is(&r->now, mark); }
static bool is_name(const reader *r, const char *name) { return vs_scad_is_name(&r->now, name); }

/* Reports that the current token is not the one that the program needs. */
static bool expected(reader *r, const char *what) {
  if (r->now.kind == VS_SCAD_END)
    return vs_fail_at(r->vm, r->vm->sym.read, r->now.pos, VS_NIL, "%s is missing before the end of the file", what);
  int size = r->now.size > 40 ? 40 : (int)r->now.size;
  while (size > 0 && size < (int)r->now.size && (r->now.text[size] & 0xC0) == 0x80) size--;
  return vs_fail_at(r->vm, r->vm->sym.read, r->now.pos, VS_NIL, "%s is missing before %.*s", what, size, r->now.text);
}

static bool need(reader *r, const char *mark) { return is(r, mark) ? advance(r) : expected(r, mark); }

static bool deeper(reader *r) {
  return ++r->depth <= DEPTH || refuse(r, r->now.pos, "more than 400 levels of brackets and statements");
}

/* ---- building data ---- */

static bool put(reader *r, list to, vs_value v, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  if (!vs_cons_at(r->vm, v, VS_NIL, pos, &p[0])) return false;
  if (to.at[0] == VS_NIL) {
    to.at[0] = p[0];
  } else {
    vs_pair *last = vs_as_pair(to.at[1]);
    vs_gc_store(r->vm, last, &last->cdr, p[0]);
  }
  to.at[1] = p[0];
  return true;
}

static bool put_word(reader *r, list to, const char *word, vs_pos pos) {
  VS_ROOTS(r->vm, p, 1);
  return vs_intern_c(r->vm, word, &p[0]) && put(r, to, p[0], pos);
}

/* Appends the name that is the current token, and advances. */
static bool put_name(reader *r, list to) {
  VS_ROOTS(r->vm, p, 1);
  if (r->now.kind != VS_SCAD_NAME) return expected(r, "a name");
  return vs_intern(r->vm, r->now.text, r->now.size, &p[0]) && put(r, to, p[0], r->now.pos) && advance(r);
}

static bool put_expression(reader *r, list to) {
  VS_ROOTS(r->vm, p, 1);
  vs_pos pos = r->now.pos;
  return expression(r, &p[0]) && put(r, to, p[0], pos);
}

/* ---- arguments and parameters ---- */

/* Appends the lists (name value) or (#f value), and reads the closing parenthesis. With in_for, a semicolon may end the
 * lists. */
static bool put_arguments(reader *r, bool in_for, list to) {
  VS_ROOTS(r->vm, p, 2);
  vs_pos open = r->now.pos;
  if (!need(r, "(")) return false;
  while (!is(r, ")")) {
    if (is(r, ",")) { if (!advance(r)) return false; continue; }
    if (in_for && is(r, ";")) return true;
    if (r->now.kind == VS_SCAD_END) return refuse(r, open, "this ( is never closed");
    p[0] = VS_NIL, p[1] = VS_NIL;
    list item = { p };
    vs_pos pos = r->now.pos;
    bool named = r->now.kind == VS_SCAD_NAME && vs_scad_is(&r->ahead, "=");
    bool ok = named ? put_name(r, item) && advance(r) && put_expression(r, item)
                    : put(r, item, VS_FALSE, pos) && put_expression(r, item);
    if (!ok || !put(r, to, p[0], pos)) return false;
    if (!is(r, ")") && !is(r, ",") && !(in_for && is(r, ";"))) return expected(r, "a , or )");
  }
  return advance(r);
}

static bool put_argument_list(reader *r, bool in_for, list to) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL, p[1] = VS_NIL;
  vs_pos pos = r->now.pos;
  return put_arguments(r, in_for, (list){ p }) && put(r, to, p[0], pos);
}

static bool put_parameters(reader *r, list to) {
  VS_ROOTS(r->vm, p, 4);
  for (int i = 0; i < 4; i++) p[i] = VS_NIL;
  vs_pos open = r->now.pos;
  if (!need(r, "(")) return false;
  while (!is(r, ")")) {
    if (is(r, ",")) { if (!advance(r)) return false; continue; }
    if (r->now.kind == VS_SCAD_END) return refuse(r, open, "this ( is never closed");
    p[2] = VS_NIL, p[3] = VS_NIL;
    list item = { p + 2 };
    vs_pos pos = r->now.pos;
    if (!put_name(r, item) || (is(r, "=") && !(advance(r) && put_expression(r, item))) ||
        !put(r, (list){ p }, p[2], pos))
      return false;
    if (!is(r, ")") && !is(r, ",")) return expected(r, "a , or )");
  }
  return advance(r) && put(r, to, p[0], open);
}

/* ---- expressions ---- */

static bool number(reader *r, vs_value *out) {
  vs_text t;
  vs_text_open(r->vm, &t, 0);
  bool ok = vs_text_put(&t, r->now.text, r->now.size) &&
            (memchr(r->now.text, '.', r->now.size) || memchr(r->now.text, 'e', r->now.size) ||
             memchr(r->now.text, 'E', r->now.size) || vs_text_puts(&t, ".0")) &&
            vs_read_number(r->vm, t.at, t.count, r->now.pos, out);
  vs_text_close(&t);
  return ok && advance(r);
}

/* Reads let (...) value, assert (...) value or echo (...) value, where the value is an expression or, in a list, an
 * element. After assert and echo the value may be missing. */
static bool with_arguments(reader *r, bool in_list, list to) {
  VS_ROOTS(r->vm, p, 1);
  bool optional = !is_name(r, "let");
  vs_pos pos = r->now.pos;
  if (!put_name(r, to) || !put_argument_list(r, false, to)) return false;
  bool ends = is(r, ",") || is(r, ")") || is(r, "]") || is(r, ";") || is(r, ":");
  if (optional && ends) return true;
  return (in_list ? element(r, &p[0]) : expression(r, &p[0])) && put(r, to, p[0], pos);
}

static bool list_or_range(reader *r, list to) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = VS_NIL;
  vs_pos open = r->now.pos;
  list items = { p };
  bool range = false;
  if (!advance(r)) return false;
  while (!is(r, "]")) {
    if (r->now.kind == VS_SCAD_END) return refuse(r, open, "this [ is never closed");
    vs_pos pos = r->now.pos;
    if (!element(r, &p[2]) || !put(r, items, p[2], pos)) return false;
    if (is(r, ":")) range = true;
    else if (!is(r, ",") && !is(r, "]")) return expected(r, "a , or ]");
    if (is(r, "]")) break;
    if (!advance(r)) return false;
    while (!range && is(r, ",")) if (!advance(r)) return false;
  }
  if (!advance(r) || !put_word(r, to, range ? "range" : "list", open)) return false;
  to.at[1] = to.at[0];
  vs_pair *first = vs_as_pair(to.at[0]);
  vs_gc_store(r->vm, first, &first->cdr, p[0]);
  return true;
}

static bool function_literal(reader *r, list to) {
  return put_word(r, to, "fn", r->now.pos) && advance(r) && put_parameters(r, to) && put_expression(r, to);
}

static bool named_value(reader *r, list to) {
  vs_pos pos = r->now.pos;
  static const char *const words[] = { "true", "false", "undef" };
  for (int i = 0; i < 3; i++) {
    if (!is_name(r, words[i])) continue;
    if (i == 2) return put_word(r, to, "undef", pos) && advance(r);
    to.at[0] = i == 0 ? VS_TRUE : VS_FALSE;
    return advance(r);
  }
  return put_word(r, to, "var", pos) && put_name(r, to);
}

static bool primary(reader *r, vs_value *out) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list to = { p };
  vs_pos open = r->now.pos;
  bool ok;
  if (r->now.kind == VS_SCAD_NUMBER) return number(r, out);
  if (r->now.kind == VS_SCAD_STRING) return vs_scad_string(r->vm, &r->now, out) && advance(r);
  if (is(r, "(")) {
    if (!advance(r) || !expression(r, out)) return false;
    return is(r, ")") ? advance(r) : r->now.kind == VS_SCAD_END ? refuse(r, open, "this ( is never closed")
                                                                 : expected(r, ")");
  }
  if (is(r, "[")) ok = list_or_range(r, to);
  else if (is_name(r, "function")) ok = function_literal(r, to);
  else if (is_name(r, "let") || is_name(r, "assert") || is_name(r, "echo")) ok = with_arguments(r, false, to);
  else if (r->now.kind == VS_SCAD_NAME) ok = named_value(r, to);
  else return expected(r, "a value");
  *out = p[0];
  return ok;
}

/* Reads a value with the calls, indices and members after it. */
static bool postfix(reader *r, vs_value *out) {
  VS_ROOTS(r->vm, p, 3);
  vs_pos start = r->now.pos;
  if (!primary(r, &p[2])) return false;
  while (is(r, "(") || is(r, "[") || is(r, ".")) {
    p[0] = VS_NIL, p[1] = VS_NIL;
    list to = { p };
    bool call = is(r, "("), index = is(r, "[");
    bool ok = put_word(r, to, call ? "call" : index ? "index" : "member", start) && put(r, to, p[2], start);
    if (call) ok = ok && put_argument_list(r, false, to);
    else if (index) ok = ok && advance(r) && put_expression(r, to) && need(r, "]");
    else ok = ok && advance(r) && put_name(r, to);
    if (!ok) return false;
    p[2] = p[0];
  }
  *out = p[2];
  return true;
}

static bool unary(reader *r, vs_value *out);

/* Reads a value, or value ^ exponent. */
static bool power(reader *r, vs_value *out) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list to = { p };
  if (!postfix(r, &p[2])) return false;
  *out = p[2];
  if (!is(r, "^")) return true;
  vs_pos pos = r->now.pos;
  if (!put_word(r, to, "^", pos) || !put(r, to, p[2], pos) || !advance(r) || !unary(r, &p[2]) ||
      !put(r, to, p[2], pos))
    return false;
  *out = p[0];
  return true;
}

static bool unary(reader *r, vs_value *out) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list to = { p };
  bool negates = is(r, "-"), inverts = is(r, "!");
  if (!negates && !inverts && !is(r, "+")) return power(r, out);
  vs_pos pos = r->now.pos;
  bool ok = deeper(r) && advance(r) && unary(r, &p[2]) &&
            put_word(r, to, negates ? "negate" : inverts ? "not" : "plus", pos) && put(r, to, p[2], pos);
  r->depth--;
  *out = p[0];
  return ok;
}

/* Returns how tightly the current token binds as a binary operator: 1 (||) to 6 (*), 0 if it is none. */
static int binding(const reader *r) {
  static const char *const levels[] = { "|| ", "&& ", "== != ", "< <= > >= ", "+ - ", "* / % " };
  if (r->now.kind != VS_SCAD_MARK) return 0;
  for (int i = 0; i < 6; i++) {
    for (const char *m = levels[i]; *m; m = strchr(m, ' ') + 1) {
      size_t n = (size_t)(strchr(m, ' ') - m);
      if (n == r->now.size && !memcmp(m, r->now.text, n)) return i + 1;
    }
  }
  return 0;
}

/* Reads operands and the binary operators between them that bind at least as tightly as `least`. */
static bool binary(reader *r, int least, vs_value *out) {
  VS_ROOTS(r->vm, p, 4);
  if (!deeper(r) || !unary(r, &p[2])) return false;
  for (int tight; (tight = binding(r)) >= least && tight;) {
    p[0] = VS_NIL, p[1] = VS_NIL;
    list to = { p };
    vs_pos pos = r->now.pos;
    if (!vs_intern(r->vm, r->now.text, r->now.size, &p[3]) || !put(r, to, p[3], pos) || !put(r, to, p[2], pos) ||
        !advance(r) || !binary(r, tight + 1, &p[3]) || !put(r, to, p[3], pos))
      return false;
    p[2] = p[0];
  }
  r->depth--;
  *out = p[2];
  return true;
}

static bool expression(reader *r, vs_value *out) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list to = { p };
  if (!deeper(r) || !binary(r, 1, &p[2])) return false;
  *out = p[2];
  if (is(r, "?")) {
    vs_pos pos = r->now.pos;
    if (!put_word(r, to, "?", pos) || !put(r, to, p[2], pos) || !advance(r) || !put_expression(r, to) ||
        !need(r, ":") || !put_expression(r, to))
      return false;
    *out = p[0];
  }
  r->depth--;
  return true;
}

/* ---- elements of lists ---- */

/* Reads for (arguments) element, or for (first; test; next) element, which becomes (for first test next element). */
static bool list_for(reader *r, list to) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL, p[1] = VS_NIL;
  vs_pos pos = r->now.pos;
  if (!put_word(r, to, "for", pos) || !advance(r) || !put_argument_list(r, true, to)) return false;
  if (is(r, ";")) {
    if (!advance(r) || !put_expression(r, to)) return false;
    if (!is(r, ";")) return expected(r, ";");
    r->now = (vs_scad_token){ .kind = VS_SCAD_MARK, .pos = r->now.pos, .text = "(", .size = 1 }; /* arguments follow */
    if (!put_argument_list(r, false, to)) return false;
  }
  return element(r, &p[0]) && put(r, to, p[0], pos);
}

static bool list_if(reader *r, list to) {
  VS_ROOTS(r->vm, p, 1);
  vs_pos pos = r->now.pos;
  if (!put_word(r, to, "if", pos) || !advance(r) || !need(r, "(") || !put_expression(r, to) || !need(r, ")") ||
      !element(r, &p[0]) || !put(r, to, p[0], pos))
    return false;
  return !is_name(r, "else") || (advance(r) && element(r, &p[0]) && put(r, to, p[0], pos));
}

static bool generates(const vs_scad_token *t) {
  return vs_scad_is_name(t, "for") || vs_scad_is_name(t, "if") || vs_scad_is_name(t, "each");
}

/* Reads an element of a list: an expression, or for, if, each and let, which make any number of values. */
static bool element(reader *r, vs_value *out) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list to = { p };
  vs_pos pos = r->now.pos;
  bool ok = deeper(r);
  if (!ok) return false;
  if (is(r, "(") && generates(&r->ahead)) {
    ok = advance(r) && element(r, &p[0]) && need(r, ")");
  } else if (is_name(r, "for")) ok = list_for(r, to);
  else if (is_name(r, "if")) ok = list_if(r, to);
  else if (is_name(r, "each"))
    ok = put_word(r, to, "each", pos) && advance(r) && element(r, &p[2]) && put(r, to, p[2], pos);
  else if (is_name(r, "let") && vs_scad_is(&r->ahead, "(")) ok = with_arguments(r, true, to);
  else ok = expression(r, &p[0]);
  r->depth--;
  *out = p[0];
  return ok;
}

/* ---- the customizer ---- */

/* Appends the text of the comment that begins at `at`, or #f if none begins there. */
static bool put_comment(reader *r, list to, const char *at, const char *end) {
  VS_ROOTS(r->vm, p, 1);
  p[0] = VS_FALSE;
  const char *stop = at + 2;
  bool comment = end - at > 2 && at[0] == '/' && at[1] == '/';
  while (comment && stop < end && *stop != '\n' && *stop != '\r') stop++;
  return (!comment || vs_string_from_utf8(r->vm, at + 2, (size_t)(stop - at) - 2, &p[0])) &&
         put(r, to, p[0], r->now.pos);
}

/* Appends the comment after the assignment on its line, the comment in the line before, and the name of the group. */
static bool put_customizer(reader *r, list to, const vs_scad_token *name, const vs_scad_group *group) {
  VS_ROOTS(r->vm, p, 1);
  const vs_scad_token *end = &r->now;
  const char *after = end->text + 1, *before = name->text;
  while (after < end->end && (*after == ' ' || *after == '\t')) after++;
  if (before > name->start && before[-1] == '\n') before--;
  while (before > name->start && before[-1] != '\n') before--;
  p[0] = VS_FALSE;
  return put_comment(r, to, after, end->end) && put_comment(r, to, before, name->text) &&
         (!group->at || vs_string_from_utf8(r->vm, group->at, group->size, &p[0])) &&
         put(r, to, p[0], name->pos);
}

/* ---- statements ---- */

static bool assignment(reader *r, list to) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list item = { p };
  vs_scad_token name = r->now;
  const vs_scad_group group = r->in.group; /* the tokens ahead may belong to the next group */
  bool parameter = r->main && r->parameters && r->depth == 1 && vs_pos_file(name.pos) == r->in.main_file;
  if (!put_word(r, item, "=", name.pos) || !put_name(r, item) || !advance(r) || !put_expression(r, item)) return false;
  if (!is(r, ";")) return expected(r, ";");
  if (parameter && !put_customizer(r, item, &name, &group)) return false;
  return advance(r) && put(r, to, p[0], name.pos);
}

static bool block(reader *r, list to) {
  vs_pos open = r->now.pos;
  if (!advance(r)) return false;
  while (!is(r, "}")) {
    if (r->now.kind == VS_SCAD_END) return refuse(r, open, "this { is never closed");
    if (!statement(r, to)) return false;
  }
  return advance(r);
}

/* Reads the children of a module or the branch of an if: a statement, a block, or only a semicolon. */
static bool children(reader *r, list to) {
  if (is(r, ";")) return advance(r);
  return is(r, "{") ? block(r, to) : statement(r, to);
}

static bool put_children(reader *r, list to) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL, p[1] = VS_NIL;
  vs_pos pos = r->now.pos;
  return children(r, (list){ p }) && put(r, to, p[0], pos);
}

static bool if_statement(reader *r, list to) {
  if (!put_word(r, to, "if", r->now.pos) || !advance(r) || !need(r, "(") || !put_expression(r, to) || !need(r, ")") ||
      !put_children(r, to))
    return false;
  return !is_name(r, "else") || (advance(r) && put_children(r, to));
}

static bool instantiation(reader *r, list to) {
  VS_ROOTS(r->vm, p, 3);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list item = { p };
  vs_pos pos = r->now.pos;
  if (is(r, "#") || is(r, "%") || is(r, "!") || is(r, "*")) {
    const vs_scad_token mark = r->now;
    if (!vs_string_from_utf8(r->vm, mark.text, 1, &p[2]) || !put_word(r, item, "mark", pos) ||
        !put(r, item, p[2], pos) || !deeper(r) || !advance(r) || !instantiation(r, item))
      return false;
    r->depth--;
    return *mark.text == '*' || put(r, to, p[0], pos);
  }
  if (is_name(r, "if")) return if_statement(r, item) && put(r, to, p[0], pos);
  if (r->now.kind != VS_SCAD_NAME) return expected(r, "a statement");
  if (!vs_scad_is(&r->ahead, "(")) return advance(r) && expected(r, "( or =");
  return put_word(r, item, "do", pos) && put_name(r, item) && put_argument_list(r, false, item) && children(r, item) &&
         put(r, to, p[0], pos);
}

static bool definition(reader *r, list to) {
  VS_ROOTS(r->vm, p, 2);
  p[0] = VS_NIL, p[1] = VS_NIL;
  list item = { p };
  vs_pos pos = r->now.pos;
  bool module = is_name(r, "module");
  r->parameters = false;
  if (!put_name(r, item) || !put_name(r, item) || !put_parameters(r, item)) return false;
  bool ok = module ? children(r, item) : need(r, "=") && put_expression(r, item) && need(r, ";");
  return ok && put(r, to, p[0], pos);
}

/* Reads `use <file>`. The file becomes a list of its own, once for each file. */
static bool use(reader *r, list to) {
  VS_ROOTS(r->vm, p, 5);
  for (int i = 0; i < 5; i++) p[i] = VS_NIL;
  list item = { p };
  vs_text path;
  vs_text_open(r->vm, &path, 0);
  vs_scad_token name = r->now;
  uint32_t file = 0;
  size_t k = 0;
  bool found = false;
  bool ok = vs_string_from_utf8(r->vm, name.text, name.size, &p[2]) &&
            vs_scad_find(r->vm, p[2], vs_pos_file(name.pos), &path, &found) && vs_text_end(&path) &&
            (!found || vs_file_number(r->vm, path.at, path.count, &file));
  size_t n = r->used_count;
  for (vs_value l = *r->used; found && vs_is_pair(l); l = vs_cdr(l), n--)
    if (vs_car(vs_car(l)) == vs_fix(file)) k = n;
  if (ok && found && !k) {
    ok = vs_string_from_utf8(r->vm, path.at, path.count, &p[3]) && vs_cons(r->vm, vs_fix(file), p[3], &p[4]) &&
         vs_cons(r->vm, p[4], *r->used, r->used);
    k = ++r->used_count;
  }
  ok = ok && (found ? put_word(r, item, "use", name.pos) && put(r, item, vs_fix((int64_t)k), name.pos)
                    : put_word(r, item, "missing", name.pos) && put(r, item, p[2], name.pos));
  vs_text_close(&path);
  return ok && advance(r) && put(r, to, p[0], name.pos);
}

static bool statement(reader *r, list to) {
  if (!vs_poll(r->vm, 16) || !deeper(r)) return false;
  bool ok;
  if (is(r, ";")) ok = advance(r);
  else if (is(r, "{")) ok = block(r, to);
  else if (is_name(r, "module") || is_name(r, "function")) ok = definition(r, to);
  else if (r->now.kind == VS_SCAD_USE) ok = use(r, to);
  else if (r->now.kind == VS_SCAD_NAME && vs_scad_is(&r->ahead, "=")) ok = assignment(r, to);
  else ok = instantiation(r, to);
  r->depth--;
  return ok;
}

/* ---- files ---- */

/* Appends the list of a file's statements. The scanner has opened the file. */
static bool put_file(reader *r, list to, vs_pos pos) {
  VS_ROOTS(r->vm, p, 4);
  for (int i = 0; i < 4; i++) p[i] = VS_NIL;
  list statements = { p };
  bool ok = vs_scad_next(&r->in, &r->now) && vs_scad_next(&r->in, &r->ahead);
  while (ok && r->now.kind != VS_SCAD_END) ok = statement(r, statements);
  for (p[2] = *r->in.missing; ok && vs_is_pair(p[2]); p[2] = vs_cdr(p[2])) {
    VS_ROOTS(r->vm, q, 2);
    q[0] = VS_NIL, q[1] = VS_NIL;
    list item = { q };
    vs_pos at = vs_pair_pos(p[2]);
    ok = put_word(r, item, "missing", at) && put(r, item, vs_car(p[2]), at) && put(r, statements, q[0], at);
  }
  *r->in.missing = VS_NIL;
  vs_scad_close(&r->in);
  return ok && put(r, to, p[0], pos);
}

/* Reads the files that `use` names, in the order in which they were found. */
static bool put_used_files(reader *r, list to) {
  VS_ROOTS(r->vm, p, 1);
  vs_text path;
  r->main = false;
  for (size_t k = 1; k <= r->used_count; k++) {
    p[0] = *r->used;
    for (size_t i = r->used_count; i > k; i--) p[0] = vs_cdr(p[0]);
    uint32_t file = (uint32_t)vs_fixnum(vs_car(vs_car(p[0])));
    vs_text_open(r->vm, &path, 0);
    bool ok = vs_text_string(&path, vs_cdr(vs_car(p[0]))) && vs_text_end(&path) &&
              vs_scad_open_file(&r->in, path.at, file);
    vs_text_close(&path);
    if (!ok || !put_file(r, to, vs_pos_make(file, 1, 1))) return false;
  }
  return true;
}

bool vs_openscad_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms) {
  static const char import[] = "(import (openscad))";
  VS_ROOTS(vm, p, 7); /* two lists of two roots, used files, missing files, a datum */
  for (int i = 0; i < 7; i++) p[i] = VS_NIL;
  list all = { p }, program = { p + 2 };
  reader r = { .vm = vm, .in = { .vm = vm, .main_file = file, .missing = &p[5] }, .main = true, .parameters = true,
               .used = &p[4] };
  vs_pos pos = vs_pos_make(file, line, 1);
  bool ok = vs_read_datum(vm, import, sizeof import - 1, &p[6], NULL) && put(&r, all, p[6], pos) &&
            put_word(&r, program, "scad:program", pos) && vs_scad_open_text(&r.in, text, size, file, line) &&
            put_file(&r, program, pos) && put_used_files(&r, program) && put(&r, all, p[2], pos);
  vs_scad_close(&r.in);
  *forms = p[0];
  return ok;
}
