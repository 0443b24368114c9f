/* Answers a host's questions about a program: the meaning of a name, the calls that led to the last error, the
 * procedures that take the most time. */
#include "session/names.h"

#include <stdio.h>
#include <stdlib.h>

#include "bind/call/procedure.h"
#include "bind/procedures.h"
#include "session/report.h"
#include "vm/machine/arguments.h"
#include "vm/compiler/code.h"
#include "vm/compiler/dump.h"
#include "vm/front/environment.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"
#include "vm/machine/run.h"
#include "vm/machine/activation.h"
#include "vm/front/suggest.h"

/* Returns a copy of the text that is valid as long as the store; returns "" when memory is out. */
static const char *kept(vs_session *s, vs_text *t) {
  const char *text = vs_text_end(t) ? vs_store_text(s->bind.store, t->at, t->count) : NULL;
  return text ? text : "";
}

static bool put(vs_text *t, const char *a, const char *b, const char *c) { return vs_text_puts(t, a) &&
    vs_text_puts(t, b) && vs_text_puts(t, c); }

/* ---- meanings of names ---- */

static const char *const all_forms[] = { /* argument lists of the special forms, whose definitions do not contain such
                                          * lists */
  "(define name value)\n(define (name parameter ...) body ...)", "define", "(if test then else)", "if",
      "(cond [test value ...] ... [else value ...])", "cond",
  "(let ([name value] ...) body ...)\n(let loop ([name value] ...) body ...)", "let",
      "(let* ([name value] ...) body ...)", "let*", "(lambda (parameter ...) body ...)", "lambda",
  "(for ([name sequence] ...) body ...)", "for", "(for/list ([name sequence] ...) value)", "for/list",
      "(for*/list ([name sequence] ...) value)", "for*/list",
  "(when test body ...)", "when", "(unless test body ...)", "unless",
      "(case value [(datum ...) value ...] ... [else value ...])", "case", "(set! name value)", "set!",
  "(begin body ...)", "begin", "(do ([name start step] ...) (test value) body ...)", "do",
      "(define-syntax name (syntax-rules () [(name part ...) result] ...))", "define-syntax",
  "(define-parameter name default #:min low #:max high)", "define-parameter",
      "(define-primitive (name parameter ...) body ...)", "define-primitive",
  "(and test ...)", "and", "(or test ...)", "or", "(guard (e [test value ...] ...) body ...)", "guard",
      "(parameterize ([parameter value] ...) body ...)", "parameterize",
};

static const char *form_of_syntax(const char *name) {
  for (size_t i = 0; i + 1 < sizeof all_forms / sizeof *all_forms; i += 2)
    if (!strcmp(all_forms[i + 1], name)) return all_forms[i];
  return "";
}

/* Writes the argument lists of a built-in procedure, one on each line. */
static bool put_forms(vs_text *t, const vs_procedure *p, const char *name) {
  for (int i = 0; i < VS_MAX_FORMS && p->form[i].used; i++) {
    if (!put(t, i ? "\n(" : "(", name, "")) return false;
    for (const vs_bind_param *q = p->form[i].at; q->mode != VS_ARG_END; q++)
      if (!put(t, q->mode == VS_ARG_OPTIONAL ? " [" : " ", q->name, q->mode == VS_ARG_OPTIONAL ? "]"
          : q->mode == VS_ARG_REST ? " ..." : "")) return false;
    if (!vs_text_puts(t, ")")) return false;
  }
  return true;
}

static bool put_keywords(vs_text *t, vs_value f) {
  vs_value list = VS_FALSE;
  size_t from = 0, to = 0;
  if (vs_is(f, VS_T_NATIVE) && vs_is_vector(vs_as_native(f)->keywords)) list = vs_as_native(f)->keywords, to =
      vs_as_vector(list)->length;
  if (vs_is(f, VS_T_CLOSURE)) {
    const vs_code *code = vs_as_code(vs_as_closure(f)->code);
    list = code->params, from = (size_t)code->required + code->optional, to = from + code->keywords;
  }
  for (size_t i = from; i < to; i++)
    if (vs_is_symbol(vs_as_vector(list)->at[i]) && !put(t, i > from ? " #:" : "#:",
        vs_as_symbol(vs_as_vector(list)->at[i])->name, "")) return false;
  return true;
}

static bool put_call(vs_text *t, vs_value f, const char *name) {
  char room[400];
  if (vs_is(f, VS_T_CASE)) {
    for (uint64_t i = 0; i < vs_as_case(f)->count; i++) {
      const char *form = vs_procedure_form(vs_as_case(f)->clause[i], room, sizeof room);
      if (form && !put(t, i ? "\n(" : "(", name, form + 1 + strcspn(form + 1, " )"))) return false;
    }
    return true;
  }
  if (vs_is(f, VS_T_NATIVE) && vs_as_native(f)->def && vs_as_native(f)->def->fn == vs_bind_enter) return put_forms(t,
      &vs_bind_procedures[vs_as_native(f)->def - vs_bind_defs], name);
  const char *form = vs_procedure_form(f, room, sizeof room);
  return !form || put(t, "(", name, form + 1 + strcspn(form + 1, " )"));
}

/* Returns the native procedure that the library's procedure `name` calls, such as %subtract for subtract, or #f if it
 * calls none. Both have the same description in the table of procedures. */
static vs_value helper_of(vs_scheme *vm, const char *name) {
  char room[80];
  vs_value symbol, value;
  if (snprintf(room, sizeof room, "%%%s", name) >= (int)sizeof room || !vs_intern_c(vm, room, &symbol)) return VS_FALSE;
  value = vs_environment_value(vm->at.core, symbol);
  return vs_is(value, VS_T_NATIVE) ? value : VS_FALSE;
}

bool vs_name_get(vs_scheme *vm, const char *name, vs_name_info *out) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 2);
  *out = (vs_name_info){ .kind = "value", .call = "", .keywords = "", .doc = "", .value = "" };
  if (!vs_intern(vm, name, strlen(name), &r[0])) return false;
  vs_meaning m = vs_environment_find(vm->at.program, r[0]);
  if (m.kind == VS_MEANS_MACRO) return out->kind = "form", out->call = form_of_syntax(name), true;
  if (m.kind != VS_MEANS_CELL || vs_as_cell(m.value)->value == VS_UNDEFINED) return false;
  r[1] = vs_as_cell(m.value)->value;
  vs_meaning language = vs_environment_find(vm->at.core, r[0]);
  /* A program that uses a name of the language has a variable of its own with the language's value. The name counts as
   * defined by the program only if the variable's value differs from the language's. */
  out->own = language.kind != VS_MEANS_CELL || vs_as_cell(language.value)->value != r[1];
  vs_text t;
  if (vs_is(r[1], VS_T_NATIVE) || vs_is(r[1], VS_T_CLOSURE) || vs_is(r[1], VS_T_CASE) || vs_is(r[1], VS_T_PARAMETER)) {
    out->kind = "procedure";
    vs_text_open(vm, &t, 1000);
    if (put_call(&t, r[1], name)) out->call = kept(s, &t);
    vs_text_close(&t);
    vs_text_open(vm, &t, 400);
    if (put_keywords(&t, r[1])) out->keywords = kept(s, &t);
    vs_text_close(&t);
    vs_value native = vs_is(r[1], VS_T_NATIVE) ? r[1] : helper_of(vm, name);
    if (vs_is(native, VS_T_NATIVE) && vs_as_native(native)->def && vs_as_native(native)->def->doc) out->doc =
        vs_as_native(native)->def->doc;
    vs_value closure = vs_is(r[1], VS_T_CASE) && vs_as_case(r[1])->count ? vs_as_case(r[1])->clause[0] : r[1];
    if (vs_is(closure, VS_T_CLOSURE) && vs_is_string(vs_as_code(vs_as_closure(closure)->code)->doc)) {
      vs_text_open(vm, &t, 4000);
      if (vs_text_string(&t, vs_as_code(vs_as_closure(closure)->code)->doc)) out->doc = kept(s, &t);
      vs_text_close(&t);
    }
    if (vs_is(closure, VS_T_CLOSURE)) vs_session_span(s, vs_code_place(vs_as_code(vs_as_closure(closure)->code),
        UINT32_MAX), &out->at);
    return true;
  }
  vs_text_open(vm, &t, 100);
  if (vs_print(vm, r[1], VS_PRINT_WRITE, &t)) out->value = kept(s, &t);
  vs_text_close(&t);
  return true;
}

const char *vs_name_advice(vs_scheme *vm, const char *name) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 1);
  vs_text t;
  vs_text_open(vm, &t, 400);
  const char *advice = vs_intern(vm, name, strlen(name), &r[0]) && vs_suggest(vm, vm->at.program, r[0], &t) ? kept(s,
      &t) : "";
  vs_text_close(&t);
  return advice + strspn(advice, "; ");
}

bool vs_disassemble(vs_scheme *vm, const char *name, bool (*each)(void *context, const char *line), void *context) {
  VS_ROOTS(vm, r, 2);
  if (!vs_intern(vm, name, strlen(name), &r[0])) return false;
  r[1] = vs_environment_value(vm->at.program, r[0]);
  if (vs_is(r[1], VS_T_CASE) && vs_as_case(r[1])->count) r[1] = vs_as_case(r[1])->clause[0];
  if (!vs_is(r[1], VS_T_CLOSURE)) return false;
  return vs_code_dump(vm, vs_as_closure(r[1])->code, each, context);
}

/* ---- the calls that led to an error ---- */

const vs_value *vs_session_call(vs_session *s, vs_value calls, size_t index, vs_span *at) {
  if (!vs_is_vector(calls)) return NULL;
  const vs_vector *v = vs_as_vector(calls);
  for (size_t i = 0; i < v->length && vs_is(v->at[i + VS_CALL_PROCEDURE], VS_T_CLOSURE); i += VS_CALL_WORDS)
    /* Calls inside the library are omitted: they do not concern users. */
    if (vs_session_span(s, vs_pos_of(v->at[i + VS_CALL_PLACE]), at) && !index--) return v->at + i;
  return NULL;
}

bool vs_session_put_value(vs_scheme *vm, vs_text *t, vs_value v, size_t most) {
  vs_text value;
  vs_text_open(vm, &value, most);
  bool ok = vs_print(vm, v, VS_PRINT_WRITE, &value) && vs_text_end(&value) &&
            vs_text_put(t, value.at, value.count) && (!value.cut || vs_text_puts(t, " ..."));
  vs_text_close(&value);
  return ok;
}

bool vs_call_get(vs_scheme *vm, size_t index, vs_call_info *out) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 1);
  *out = (vs_call_info){ .procedure = "", .variables = "" };
  if (!vs_is(vm->condition, VS_T_CONDITION)) return false;
  r[0] = vs_as_condition(vm->condition)->calls;
  const vs_value *call = vs_session_call(s, r[0], index, &out->at);
  if (!call) return false;
  const vs_code *code = vs_as_code(vs_as_closure(call[VS_CALL_PROCEDURE])->code);
  if (vs_is_symbol(code->name)) out->procedure = vs_as_symbol(code->name)->name;
  size_t first = (size_t)(call - vs_as_vector(r[0])->at);
  vs_text t;
  vs_text_open(vm, &t, 600);
  bool ok = true;
  for (size_t k = first + VS_CALL_VARIABLES; ok && k < first + VS_CALL_WORDS; k += 2) {
    vs_value symbol = vs_as_vector(r[0])->at[k];     /* reads the symbol again in each step, since printing may move the
                                                      * vector that contains it */
    if (!vs_is_symbol(symbol)) break;
    ok = put(&t, t.count ? ", " : "", vs_as_symbol(symbol)->name, " = ") &&
         vs_session_put_value(vm, &t, vs_as_vector(r[0])->at[k + 1], 60);
  }
  if (ok) out->variables = kept(s, &t);
  vs_text_close(&t);
  return true;
}
