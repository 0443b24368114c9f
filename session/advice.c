/* Computes the advice that is added to error messages. From the program's text and the arguments of the failed call, it
 * guesses the form that the user meant. The error object's payload contains these arguments (vm/machine/arguments.c). A
 * payload of #t means that the called value is no procedure (vm/machine/run_failures.h). */
#include "session/advice.h"

#include <ctype.h>
#include <stdio.h>

#include "bind/call/contract.h"
#include "bind/constructors/regroup.h"
#include "bind/objects.h"
#include "bind/procedures.h"
#include "model/looks/ready_materials.h"
#include "session/file_advice.h"
#include "session/report.h"
#include "session/source_outline.h"
#include "session/text_advice.h"
#include "session/type_advice.h"
#include "vm/machine/arguments.h"
#include "vm/machine/fail.h"
#include "vm/values/printer.h"
#include "vm/front/environment.h"
#include "vm/front/source.h"
#include "vm/front/suggest.h"

/* ---- the text at a place in a source ---- */

typedef struct { const vs_source *source; const char *at, *end; } place;

static bool find_place(const vs_session *s, vs_span span, place *out) {
  for (size_t i = 0; span.file && span.line && i < s->source_count; i++) {
    const vs_source *source = &s->sources[i];
    if (strcmp(source->name, span.file) || span.line < source->first_line) continue;
    const char *at = source->text, *end = source->text + source->length;
    for (uint32_t l = source->first_line; l < span.line && at; l++) {
      at = memchr(at, '\n', (size_t)(end - at));
      if (at) at++;
    }
    if (!at) return false;
    for (uint32_t c = 1; c < span.column && at < end && *at != '\n'; c++) /* the span's columns count characters, not
                                                                           * bytes */
      for (at++; at < end && ((unsigned char)*at & 0xC0) == 0x80;) at++;
    *out = (place){ source, at, end };
    return at < end;
  }
  return false;
}

typedef struct { const char *name; size_t length; uint32_t line, first_line; bool found; } wanted_definition;

static bool match(void *context, const vs_outline_item *item) {
  wanted_definition *w = context;
  if (item->length != w->length || memcmp(item->name, w->name, w->length)) return true;
  w->line = item->line + w->first_line - 1;
  return w->found = true, false;
}

/* Returns the line of the first top-level definition of the name in the source, or 0 if there is none. */
static uint32_t defined_on(const vs_source *source, const char *name, size_t length) {
  wanted_definition w = { .name = name, .length = length, .first_line = source->first_line };
  vs_outline_each(source->text, source->length, match, &w);
  return w.found ? w.line : 0;
}

static vs_text_place view_of(place p) {
  return (vs_text_place){ p.source->text, p.at, p.end, p.source->first_line };
}

/* ---- undefined names ---- */

/* Returns true if the text at p is an assignment in another language's form, "x = 5" or "x := 5". name: the length of x
 * in bytes. Sets *value to the text after the sign. */
static bool is_assignment(place p, size_t name, const char **value, size_t *length) {
  const char *at = p.at + name;
  while (at < p.end && (*at == ' ' || *at == '\t')) at++;
  if (at < p.end && *at == ':') at++;
  if (at >= p.end || *at != '=' || at + 1 >= p.end || (at[1] != ' ' && at[1] != '\t')) return false;
  while (at < p.end && (*at == '=' || *at == ' ' || *at == '\t')) at++;
  *value = at, *length = 0;
  while (at + *length < p.end && at[*length] != '\n' && at[*length] != ';' && at[*length] != '\r') ++*length;
  while (*length && at[*length - 1] == ' ') --*length;
  return *length > 0 && *length < 100;
}

static bool is_word_of(const char *words, const char *word, size_t n) {
  for (const char *w = words; n && *w; w += *w == ' ') {
    size_t length = strcspn(w, " ");
    if (length == n && !memcmp(w, word, n)) return true;
    w += length;
  }
  return false;
}

/* Returns the operator of the call that contains the name at `p`. Sets *before to the word before the name, which may
 * be a keyword. Parentheses inside strings are counted, too; the operator may then be wrong, which usually leads to no
 * advice. */
static const char *operator_around(place p, size_t *length, const char **before, size_t *before_length) {
  const char *start = p.source->text, *at = p.at;
  while (at > start && (at[-1] == ' ' || at[-1] == '\t' || at[-1] == '\n')) at--;
  const char *end = at;
  while (at > start && !strchr(" \t\r\n()[]\"';", at[-1])) at--;
  *before = at, *before_length = (size_t)(end - at);
  for (size_t depth = 0; at > start; at--) {
    if (at[-1] == ')' || at[-1] == ']') depth++;
    else if ((at[-1] == '(' || at[-1] == '[') && depth-- == 0) {
      *length = vs_outline_word(at, p.end);
      return at;
    }
  }
  return NULL;
}

/* Calls and keywords whose argument must be a text or a quoted word. Users often write a plain name instead: (color
 * crimson o), (units cm), #:align center. If `words` is not NULL, the row applies only to these words, and its advice
 * replaces other advice. first: whether the row applies only to the first argument. */
static const struct { const char *operators, *keywords, *words; bool first; const char *mark, *what; } meant[] = {
  { "color", "#:color #:pattern-color", NULL, true, "\"", "the name of a colour is a text" },
  { "layer", "", NULL, true, "\"", "the name of a layer is a text" },
  { "view grid-axis", "", NULL, true, "\"", "a name that is a text is written in double quotes" },
  { "make-text text-width display displayln label level", "#:text #:label #:unit", NULL, false, "\"",
    "a text is written in double quotes" },
  { "with-material", "#:material", NULL, true, "'",
    "the name of a material that is no variable has a quote before it" },
  { "do-rotate rotate do-revolve do-sweep make-plane rotation-matrix scope-split scope-repeat scope-turn", "#:up",
    "x y z", false, "'", "the name of an axis has a quote before it" },
  { "", "#:align #:valign", "left right center centre top bottom baseline", false, "'",
    "a word that is no variable has a quote before it" },
  { "view-from view", "",
    "top bottom front back left right iso isometric plan section perspective panorama axonometric", false, "'",
    "a word that is no variable has a quote before it" },
  { "units", "", "m mm cm in ft", true, "'", "the name of a unit has a quote before it" },
};

/* Returns true if the word of n characters names a ready material. */
static bool is_material(const char *word, size_t n) {
  const char *name;
  for (size_t i = 0; (name = vs_ready_material_name(i)); i++)
    if (strlen(name) == n && !memcmp(name, word, n)) return true;
  return false;
}

static bool advise_word(place p, size_t n, size_t bare, vs_text *t) {
  const char *before;
  size_t length, m;
  const char *operator = operator_around(p, &length, &before, &m);
  if (!operator) return true;
  for (size_t i = 0; i < sizeof meant / sizeof *meant; i++) {
    bool keyword = is_word_of(meant[i].keywords, before, m);
    if (!keyword && (!is_word_of(meant[i].operators, operator, length) || (meant[i].first && before != operator)))
      continue;
    if (meant[i].words ? !is_word_of(meant[i].words, p.at, n) : t->count > bare) continue;
    t->count = bare;
    if (is_word_of("#:material", meant[i].keywords, strlen(meant[i].keywords)) && !is_material(p.at, n))
      return vs_text_puts(t, "; no ready material has this name: vs help materials lists them, such as wood and "
                          "'aluminium");
    return vs_text_printf(t, "; %s: %s%.*s%s", meant[i].what, meant[i].mark, (int)n, p.at,
                          *meant[i].mark == '"' ? "\"" : "");
  }
  return true;
}

/* Returns the length of an operator that is written after its first operand, as in "(x > 3)", or 0 if there is none.
 * The first operand has n characters at p. *operand receives the second operand if that is a single word. */
static size_t operator_behind(const char *p, size_t n, const char *end, const char **operator, const char ** operand,
                              size_t *length) {
  uint32_t unused = 0;
  *operator = vs_outline_blanks(p + n, end, &unused);
  size_t m = vs_outline_word(*operator, end);
  if (!n || !m || m > 2 || *operator == p + n || strspn(*operator, "+-*/<>=") < m) return 0;
  *operand = vs_outline_blanks(*operator + m, end, &unused);
  *length = vs_outline_word(*operand, end);
  const char *after = vs_outline_blanks(*operand + *length, end, &unused);
  if (!*length || *length > 40 || after >= end || (*after != ')' && *after != ']')) *length = 0;
  return m;
}

/* Advises on an assignment to an undefined variable, (set! name value). p: place of the word set!. */
static bool advise_set(place p, vs_text *t) {
  uint32_t unused = 0;
  const char *name = vs_outline_blanks(p.at + 4, p.end, &unused);
  size_t n = vs_outline_word(name, p.end);
  const char *value = vs_outline_blanks(name + n, p.end, &unused), *end = vs_outline_datum(value, p.end, &unused);
  if (t->count < n || !n || memcmp(t->at, name, n)) return true;
  return vs_text_printf(t, "; set! changes a value that is there: (define %.*s %.*s) makes it first",
                        (int)(n < 60 ? n : 60), name, end - value < 60 ? (int)(end - value) : 5,
                        end - value < 60 ? value : "value");
}

static bool advise_unbound(place p, vs_span at, vs_text *t) {
  size_t n = vs_outline_word(p.at, p.end), m;
  const char *value;
  uint32_t unused = 0;
  bool call = n == 0 && *p.at == '(';
  size_t bare;
  if (call) p.at = vs_outline_blanks(p.at + 1, p.end, &unused), n = vs_outline_word(p.at, p.end);
  if (!n || n > 100) return true;
  if (call && n == 4 && !memcmp(p.at, "set!", 4)) return advise_set(p, t);
  static const char is_not[] = " is not defined";
  if (t->count < n + sizeof is_not - 1 || memcmp(t->at, p.at, n) || memcmp(t->at + n, is_not,
      sizeof is_not - 1)) return true;
  uint32_t line = defined_on(p.source, p.at, n);
  bare = n + sizeof is_not - 1;
  if (!call && p.at > p.source->text && p.at[-1] == '"') {
    t->count = bare;
    return vs_text_printf(t, "; a quotation mark within a text is written \\\"");
  }
  if (!call && n == 1 && p.at + n < p.end && p.at[n] == '"') {
    t->count = bare;
    return vs_text_printf(t, "; (format \"x = ~a\" x) sets values into a text");
  }
  size_t before = t->count;
  if (!call && !vs_text_advise_operator(view_of(p), t)) return false;
  if (t->count != before) return true;
  if (line >= at.line && line) {
    t->count = bare; /* removes the advice about a similar name that was appended before */
    return vs_text_printf(t, " yet: line %u defines it, after this use; move the definition up", (unsigned)line);
  }
  if (is_assignment(p, n, &value, &m)) {
    /* The assignment is in parentheses, (x = 5): removes the closing parenthesis from the value. */
    while (call && m && (value[m - 1] == ')' || value[m - 1] == ' ')) m--;
    return !m || vs_text_printf(t, "; (define %.*s %.*s) names a value", (int)n, p.at, (int)m, value);
  }
  const char *operator, *operand;
  size_t length, sign = p.at > p.source->text && strchr("([", p.at[-1])
                            ? operator_behind(p.at, n, p.end, &operator, &operand, &length) : 0;
  if (sign)
    return vs_text_printf(t, "; the operator comes first: (%.*s %.*s %.*s)", (int)sign, operator, (int)n, p.at,
               length ? (int)length : 3, length ? operand : "...");
  return call || advise_word(p, n, bare, t);
}

/* ---- calls of a value that is no procedure ---- */

static bool advise_callee(place p, vs_span at, vs_value irritants, vs_text *t, vs_scheme *vm) {
  uint32_t unused = 0;
  if (*p.at != '(' && *p.at != '[') return true;
  const char *name = vs_outline_blanks(p.at + 1, p.end, &unused);
  size_t n = vs_outline_word(name, p.end), length;
  const char *operator, *operand;
  size_t sign = n < 100 ? operator_behind(name, n, p.end, &operator, &operand, &length) : 0;
  if (sign) {
    size_t before = t->count;
    if (!vs_text_advise_operator((vs_text_place){ p.source->text, operator, p.end, p.source->first_line }, t))
      return false;
    if (t->count != before) return true;
    t->count = 0;
    return vs_text_printf(t, "the operator comes first: (%.*s %.*s %.*s)", (int)sign, operator,(int) n, name,
               length ? (int)length : 3, length ? operand : "...");
  }
  if (*p.at == '[' && p.at > p.source->text && (isalnum((unsigned char)p.at[-1]) || p.at[-1] == ')')) {
    if (p.at[-1] == ')') return vs_text_printf(t, "; an element is (list-ref list %.*s), counted from 0", (int)n, name);
    const char *list = p.at;
    while (list > p.source->text && !strchr(" \t\r\n()[]\"';", list[-1])) list--;
    return vs_text_printf(t, "; an element is (list-ref %.*s %.*s), counted from 0", (int)(p.at - list), list, (int)n,
                          name);
  }
  if (*p.at == '(' && p.at > p.source->text && (isalnum((unsigned char)p.at[-1]) || p.at[-1] == '_'))
    return vs_text_advise_statement(vm, view_of(p), t);
  uint32_t line = n && n < 100 ? defined_on(p.source, name, n) : 0;
  vs_value symbol;
  if (!vs_intern(vm, name, n, &symbol)) return false;
  bool ours = vs_idtable_get(vs_as_environment(vm->at.core)->table, symbol) != VS_VACANT;
  if (!line && ours) return vs_text_advise_hidden(view_of(p), t);
  if (!line || line > at.line || !vs_is_pair(irritants)) return true;
  t->count = 0;
  return vs_text_printf(t, "%.*s is %s here, no procedure: line %u made it ", (int)n, name,
                        vs_noun(vm, vs_car(irritants)), (unsigned)line) &&
         vs_print(vm, vs_car(irritants), VS_PRINT_WRITE, t) &&
         (ours || name[n] != ')' || vs_text_printf(t, "; its value is %.*s, without parentheses", (int)n, name)) &&
         (!ours ||
          vs_text_printf(t, "; give this value another name, and (%.*s ...) calls the procedure again", (int)n, name));
}

/* ---- wrong numbers of arguments ---- */

static const vs_procedure *procedure_of(const vs_native *native) {
  if (!native->def || native->def->fn != vs_bind_enter) return NULL;
  return &vs_bind_procedures[native->def - vs_bind_defs];
}

/* Advises on a call such as (map make-sphere points): map passes one argument for each list, and the procedure needs
 * more. */
static bool advise_mapped(const place *p, vs_value callee, vs_text *t) {
  char form[200];
  const char *call = vs_is_procedure(callee) ? vs_procedure_form(callee, form, sizeof form) : NULL;
  uint32_t unused = 0;
  if (!call || (*p->at != '(' && *p->at != '[')) return true;
  const char *head = vs_outline_blanks(p->at + 1, p->end, &unused);
  size_t n = vs_outline_word(head, p->end), name = strcspn(call + 1, " )");
  if (!is_word_of("map for-each append-map filter map-division", head, n) || call[1 + name] != ' ') return true;
  const char *first = call + 1 + name + 1;
  size_t length = strcspn(first, " )");
  return vs_text_printf(t, "; (lambda (%.*s) %s) adds the missing arguments", (int)length, first, call);
}

static bool advise_arity(vs_scheme *vm, vs_value payload, vs_text *t) {
  vs_value callee = vs_is_pair(payload) ? vs_car(payload) : VS_FALSE;
  if (vs_text_end(t) && !strncmp(t->at, "the procedure needs ", 20))
    return vs_text_printf(t, "; a lambda has its parameters in one list: (lambda (u v) ...)");
  if (vs_text_end(t) && strstr(t->at, " / "))
    return vs_text_printf(t, "; names behind / are not local here: (let ([y 0]) ...) in the body makes one");
  if (!vs_is(callee, VS_T_NATIVE)) return true;
  const vs_native *native = vs_as_native(callee);
  if (!vs_is_symbol(native->name)) return true;
  const char *name = vs_as_symbol(native->name)->name;
  const vs_procedure *p = procedure_of(native);
  vs_value a[VS_MAX_ARGUMENTS];
  int n = 0;
  for (vs_value l = vs_cdr(payload); vs_is_pair(l) && n < VS_MAX_ARGUMENTS; l = vs_cdr(l)) a[n++] = vs_car(l);
  char text[300];
  const vs_bind_param *first = p ? p->form[0].at : NULL;
  /* advises that the procedure needs keyword arguments: the call has only positional arguments, as in (sun 210 35), but
   * at most one of the procedure's arguments is positional */
  if (p && p->key[0].mode != VS_ARG_END && n &&
      (first->mode == VS_ARG_END || (first->mode == VS_ARG_OPTIONAL && first[1].mode == VS_ARG_END && n > 1))) {
    if (!vs_text_printf(t, "; its arguments have names: (%s", name)) return false;
    for (int i = 0; i < n && p->key[i].mode != VS_ARG_END; i++)
      if (!vs_text_printf(t, " #:%s ", p->key[i].name) || !vs_print(vm, a[i], VS_PRINT_WRITE, t)) return false;
    return vs_text_puts(t, ")");
  }
  if (p && vs_bind_grouped(vm, p, &(vs_plain_call){ name, a, n }, text, sizeof text))
    return vs_text_printf(t, "; perhaps %s", text);
  if (p && p->form[1].used) { /* the procedure has several argument lists, but the message states the number of
                               * arguments of only one */
    vs_bind_forms(p, name, text, sizeof text);
    return vs_text_printf(t, "; it %s", text);
  }
  return vs_foreign_advice(name, t);
}

/* ---- texts in single quotes ---- */

/* Finds a text in single quotes ('red') within the form at p, and returns its length, or 0. In Scheme a single quote
 * has another meaning. */
static size_t quoted_word(place p, const char **word) {
  uint32_t unused = 0;
  const char *stop = vs_outline_datum(p.at, p.end, &unused);
  for (const char *at = p.at; at < stop; at++) {
    if (*at == '"') at = vs_outline_datum(at, stop, &unused) - 1;
    if (*at != '\'') continue;
    size_t n = vs_outline_word(at + 1, stop);
    if (n && at + 1 + n < stop && at[1 + n] == '\'') return *word = at + 1, n;
  }
  return 0;
}

/* Returns true if an argument of the call at p is a quoted call: (draw '(make-sphere p 1)). */
static bool is_quoted_call(place p) {
  uint32_t unused = 0;
  const char *stop = vs_outline_datum(p.at, p.end, &unused);
  for (const char *at = p.at; at + 2 < stop; at++)
    if (*at == '\'' && at[1] == '(' && (!strncmp(at + 2, "make-", 5) || !strncmp(at + 2, "do-", 3))) return true;
  return false;
}

/* Returns true if the error is that the name of a special form was written without its parentheses. */
static bool is_word_alone(vs_text *t) { return vs_text_end(t) && t->at && strstr(t->at, "is syntax and has no value"); }

bool vs_session_advise(vs_session *s, vs_value condition, vs_span at, vs_text *t) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 1);
  r[0] = condition;
  const vs_condition *c = vs_as_condition(r[0]);
  place p;
  bool known = find_place(s, at, &p);
  if (c->kind == vm->sym.file) return vs_session_advise_file(vm, t);
  if (c->kind == vm->sym.arity) {
    size_t before = t->count;
    vs_value callee = vs_is_pair(c->payload) ? vs_car(c->payload) : VS_FALSE;
    if (known && !advise_mapped(&p, callee, t)) return false;
    return t->count > before || advise_arity(vm, vs_as_condition(r[0])->payload, t);
  }
  if (!known) return c->kind == vm->sym.unbound || vs_session_advise_value(vm, c, t);
  if (c->kind == vm->sym.unbound) return advise_unbound(p, at, t);
  if (vs_source_language(at.file)) return vs_session_advise_value(vm, c, t);
  if (c->kind == vm->sym.read || (c->kind == vm->sym.syntax && is_word_alone(t)))
    return vs_text_advise_statement(vm, view_of(p), t);
  if (c->kind != vm->sym.type) return vs_session_advise_value(vm, c, t);
  if (vs_is_string(c->payload)) return vs_text_puts(t, "; ") && vs_text_string(t, c->payload);
  if (c->payload == VS_TRUE) return advise_callee(p, at, c->irritants, t, vm);
  const char *word;
  if (vs_text_end(t) && strstr(t->at, "must be an object") && is_quoted_call(p))
    return vs_text_printf(t, "; the ' before a parenthesis passes the list itself, and does not call: remove the '");
  size_t n = quoted_word(p, &word);
  if (n) return vs_text_printf(t, "; a text is written in double quotes: \"%.*s\"", (int)(n < 60 ? n : 60), word);
  if (vs_text_end(t) && !strncmp(t->at, "display", 7) && strstr(t->at, "port must be an output port"))
    return vs_foreign_advice("display", t);
  size_t before = t->count;
  vs_value got = vs_is_pair(c->irritants) ? vs_car(c->irritants) : VS_UNSPECIFIC;
  bool ok = vs_text_end(t);
  if (ok && strstr(t->at, VS_BIND_NO_VALUE)) ok = vs_text_advise_valueless(view_of(p), t);
  if (ok && t->count == before && vs_is_symbol(got)) ok = vs_text_advise_quoted(view_of(p), vs_as_symbol(got)->name, t);
  if (ok && t->count == before && vs_is_procedure(got)) ok = vs_text_advise_chain(view_of(p), t);
  if (ok && t->count == before && got == VS_FALSE) ok = vs_text_advise_missing_key(vm, view_of(p), t);
  if (ok && t->count == before && vs_is_pair(got)) ok = vs_text_advise_rest(view_of(p), t);
  if (!ok || t->count > before) return ok;
  return vs_session_advise_value(vm, vs_as_condition(r[0]), t);
}

const char *vs_place_advice(vs_scheme *vm, vs_advice_kind kind, const char *text, size_t length, size_t at,
                            const char *message) {
  vs_session *s = vs_session_of(vm);
  vs_source source = { .name = "", .text = (char *)(uintptr_t)text, .length = length, .first_line = 1 };
  place p = { &source, text + at, text + length };
  vs_span span = { .line = 1 };
  for (size_t i = 0; i < at; i++) span.line += text[i] == '\n';
  vs_text t;
  vs_text_open(vm, &t, 800);
  bool ok = at < length && vs_text_puts(&t, message);
  if (ok && kind == VS_ADVICE_NAME) ok = advise_unbound(p, span, &t);
  else if (ok && kind == VS_ADVICE_CALL) ok = advise_callee(p, span, VS_NIL, &t, vm);
  else if (ok && kind == VS_ADVICE_CHAIN) ok = vs_text_advise_chain(view_of(p), &t);
  else if (ok) ok = vs_text_advise_statement(vm, view_of(p), &t);
  const char *kept = ok && vs_text_end(&t) ? vs_store_text(s->bind.store, t.at, t.count) : NULL;
  vs_text_close(&t);
  return kept ? kept : message;
}

/* ---- calls without parentheses ---- */

void vs_session_advise_named(vs_session *s, vs_value v, vs_pos pos) {
  const vs_scheme *vm = s->bind.vm;
  vs_span at;
  place p;
  char text[300];
  if (!vs_is_procedure(v) || !vm->config.warn || !vs_session_span(s, pos, &at) || vs_source_language(at.file)) return;
  if (!find_place(s, at, &p)) return;
  size_t n = vs_outline_word(p.at, p.end);
  const char *more = p.at + n;
  while (more < p.end && (*more == ' ' || *more == '\t')) more++;
  if (!n || n > 80 || more == p.end || strchr("\r\n;)]", *more)) return;
  size_t assigned = vs_outline_word(more, p.end); /* gives no advice for a form such as const r = 3: the undefined
                                                   * variable r will cause an error with advice */
  const char *sign = more + assigned + (more + assigned < p.end && more[assigned] == ' ');
  if (assigned && sign < p.end && *sign == '=') return;
  uint32_t line = 0;
  const char *end = more; /* end: where the line of the name ends, unless a datum continues further */
  for (const char *next = more; !line && next < p.end && *next != ')' && *next != ']';) {
    end = vs_outline_datum(next, p.end, &line);
    next = vs_outline_blanks(end, p.end, &line);
    if (next == p.end) break;
  }
  if (n <= 2 && strspn(p.at, "+-*/<>=") >= n) /* the operator follows its first operand, as in 3 + 4 */
    snprintf(text, sizeof text, "%.*s is only named here, and not called: the operator comes first, (%.*s a b)",
             (int)n, p.at, (int)n, p.at);
  else {
    bool shown = end > more && end - more < 100 && !memchr(more, '\n', (size_t)(end - more));
    snprintf(text, sizeof text,
             "%.*s is only named here, and not called: the parenthesis comes before it, (%.*s %.*s)", (int)n, p.at,
             (int)n, p.at, shown ? (int)(end - more) : 3, shown ? more : "...");
  }
  vm->config.warn(s->bind.vm, pos, text);
}

/* ---- drawings without objects ---- */

typedef struct { vs_text *t; size_t count; const char *last; size_t last_length; bool ok; } naming;

static bool name_procedure(void *context, const vs_outline_item *item) {
  naming *n = context;
  if (!item->procedure) return true;
  if (n->count < 4)
    n->ok = n->ok && vs_text_printf(n->t, "%s%.*s", n->count ? ", " : "", (int)(item->length < 60 ? item->length : 60),
                                    item->name);
  n->count++, n->last = item->name, n->last_length = item->length < 60 ? item->length : 60;
  return n->ok;
}

bool vs_session_advise_empty(vs_session *s, vs_text *t) {
  if (!s->source_count) return true;
  size_t before = t->count;
  if (!vs_text_printf(t, ": the program defines ")) return false;
  naming n = { .t = t, .ok = true };
  /* Searches only the source of the program that ran last. The sources of imported libraries come later in the list,
   * but they define procedures only within define-library. */
  for (size_t i = s->source_count; i-- > 0 && !n.count && n.ok;)
    if (!s->sources[i].before) vs_outline_each(s->sources[i].text, s->sources[i].length, name_procedure, &n);
  if (!n.ok) return false;
  if (!n.count) {
    t->count = before;
    return vs_text_printf(t, "; (draw object) draws an object");
  }
  return vs_text_printf(t, "%s and draws nothing; (draw (%.*s ...)) draws its result", n.count > 4 ? " and others" : "",
      (int)n.last_length, n.last);
}
