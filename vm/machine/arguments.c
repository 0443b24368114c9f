/* Arranges the arguments of calls with optional, keyword or rest parameters, and reports wrong numbers of arguments. */
#include "vm/machine/arguments.h"

#include "vm/front/source.h"
#include "vm/machine/signature.h"
#include "vm/values/text.h"
#include "vm/front/suggest.h"

#include <stdio.h>
#include <string.h>

/* Returns a procedure's name for messages, without the % at the start of internal names. */
static const char *name_of(vs_value name) {
  const char *text = vs_is_symbol(name) ? vs_as_symbol(name)->name : "the procedure";
  return text + (text[0] == '%' && text[1]);
}

/* A procedure's parameters as text for messages: " (from to [step])". Parameters that do not fit are omitted. */
typedef struct { char text[160]; size_t used; } wanted;

static void want(wanted *w, const char *before, const char *name, size_t length, const char *after) {
  int n = snprintf(w->text + w->used, sizeof w->text - w->used, "%s%s%.*s%s", w->used ? " " : " (", before, (int)length,
                   name, after);
  w->used = n < 0 || w->used + (size_t)n + 2 > sizeof w->text ? sizeof w->text : w->used + (size_t)n;
}

static const char *want_end(wanted *w) {
  if (!w->used || w->used >= sizeof w->text) return "";
  memcpy(w->text + w->used, ")", 2);
  return w->text;
}

static const char *want_closure(const vs_code *code, wanted *w) {
  const vs_vector *names = vs_as_vector(code->params);
  for (size_t i = 0; i < names->length && w->used < sizeof w->text; i++) {
    bool keyword = i >= code->required + code->optional && i < code->required + code->optional + code->keywords;
    bool rest = i >= code->required + code->optional + code->keywords,
         optional = !rest && !keyword && i >= code->required;
    if (!vs_is_symbol(names->at[i])) return "";
    const char *name = vs_as_symbol(names->at[i])->name;
    if (!keyword) want(w, optional ? "[" : "", name, strlen(name), optional ? "]" : rest ? " ..." : "");
  }
  return want_end(w);
}

static const char *want_native(const vs_native *native, wanted *w) {
  const char *at = native->def ? native->def->signature : "", *name;
  int depth = 0;
  size_t length;
  for (vs_signature_kind kind;
       w->used < sizeof w->text && (kind = vs_signature_next(&at, &depth, &name, &length)) != VS_SIG_END;)
    if (kind != VS_SIG_KEYWORD)
      want(w, kind == VS_SIG_OPTIONAL ? "[" : "", name, length,
           kind == VS_SIG_OPTIONAL ? "]"
           : kind == VS_SIG_REST   ? " ..."
                                   : "");
  return want_end(w);
}

/* Stores the failed call, as a list (callee argument ...), in the current error, for session/advice.c. Returns false,
 * since the error is set. */
static bool keep_call(vs_scheme *vm, vs_value callee, const vs_value *a, size_t n) {
  VS_ROOTS(vm, r, 3);
  r[0] = vm->condition, r[1] = VS_NIL, r[2] = callee;
  if (!vs_is(r[0], VS_T_CONDITION) || r[0] == vm->at.no_memory || n > 64) return false;
  for (size_t i = n; i-- > 0;)
    if (!vs_cons(vm, a[i], r[1], &r[1])) return vm->condition = r[0], false;
  if (!vs_cons(vm, r[2], r[1], &r[1])) return vm->condition = r[0], false;
  vs_gc_store(vm, vs_as_condition(r[0]), &vs_as_condition(r[0])->payload, r[1]);
  vm->condition = r[0];
  return false;
}

/* Returns a text such as "; the others go by keyword: #:segments #:plane", for the error of a call with too many
 * positional arguments. */
static const char *want_keywords(const vs_value *names, size_t count, wanted *w) {
  for (size_t i = 0; i < count && w->used < sizeof w->text; i++) {
    const char *name = name_of(names[i]);
    if (!w->used) want(w, "; the others go by keyword: #:", name, strlen(name), "");
    else want(w, "#:", name, strlen(name), "");
  }
  if (!w->used || w->used >= sizeof w->text) return "";
  return w->text + 2; /* omits the blank and the parenthesis at the start of the list of names */
}

/* The arguments that a procedure accepts. */
typedef struct {
  size_t min, max;          /* least and greatest number of positional arguments; SIZE_MAX: no limit */
  const char *names;        /* names of the required arguments, as text */
  const vs_value *keywords; /* names of the procedure's keywords, `count` symbols */
  size_t count;
} taken;

static bool fail_count(vs_scheme *vm, vs_value name, const taken *t, size_t got) {
  const char *who = vs_source_word(vm, name_of(name)), *names = t->names;
  size_t min = t->min, max = t->max;
  wanted w = {.used = 0};
  const char *others = max && got > max ? want_keywords(t->keywords, t->count, &w) : "";
  if (max == SIZE_MAX)
    return vs_fail(vm, vm->sym.arity, "%s needs at least %zu argument%s%s, got %zu", who, min, min == 1 ? "" : "s",
                   names, got);
  if (min == max && min == 0) return vs_fail(vm, vm->sym.arity, "%s takes no arguments, got %zu", who, got);
  if (min == max)
    return vs_fail(vm, vm->sym.arity, "%s needs %zu argument%s%s, got %zu%s", who, min, min == 1 ? "" : "s", names, got,
                   others);
  return vs_fail(vm, vm->sym.arity, "%s needs %zu to %zu arguments%s, got %zu%s", who, min, max, names, got, others);
}

/* Reports an unknown keyword. names: the keywords of the procedure, `count` symbols. */
static bool fail_keyword(vs_scheme *vm, vs_value name, vs_value keyword, const vs_value *names, size_t count) {
  wanted w = {.used = 0};
  for (size_t i = 0; i < count && w.used < sizeof w.text; i++)
    if (vs_is_symbol(names[i])) want(&w, "#:", vs_as_symbol(names[i])->name, strlen(vs_as_symbol(names[i])->name), "");
  const char *there = want_end(&w);
  vs_text advice;
  vs_text_open(vm, &advice, 300);
  bool ok = vs_keyword_advice(name_of(keyword), &advice) && vs_text_end(&advice);
  const char *more = ok ? advice.at : "";
  if (!*there) vs_fail(vm, vm->sym.arity, "%s has no keyword #:%s%s", name_of(name), name_of(keyword), more);
  /* prints the list of the procedure's keywords without parentheses */
  else vs_fail(vm, vm->sym.arity, "%s has no keyword #:%s; it has %.*s%s", name_of(name), name_of(keyword),
      (int)strlen(there) - 3, there + 2, more);
  vs_text_close(&advice);
  return false;
}

/* Returns the first keyword of the call that is not in `names`, or NULL. If a call with too few arguments has such a
 * keyword, as (make-sphere p #:radius 2), the error names the keyword. */
static const vs_value *unknown_keyword(vs_value kw, const vs_value *names, size_t count) {
  const vs_keywords *k = vs_as_keywords(kw);
  for (size_t i = 0; i < k->count; i++) {
    size_t j = 0;
    while (j < count && names[j] != k->name[i]) j++;
    if (j == count) return &k->name[i];
  }
  return NULL;
}

const char *vs_procedure_form(vs_value f, char *room, size_t size) {
  wanted w = {.used = 0};
  const char *names = "";
  vs_value name = VS_FALSE;
  if (vs_is(f, VS_T_CLOSURE)) {
    const vs_code *code = vs_as_code(vs_as_closure(f)->code);
    name = code->name, names = want_closure(code, &w);
  } else if (vs_is(f, VS_T_NATIVE)) name = vs_as_native(f)->name, names = want_native(vs_as_native(f), &w);
  if (!vs_is_symbol(name)) return NULL;
  int n = snprintf(room, size, "(%s%s%s", vs_as_symbol(name)->name, *names ? " " : "", *names ? names + 2 : ")");
  return n > 0 && (size_t)n < size ? room : NULL;
}

bool vs_fail_clauses(vs_scheme *vm, const vs_case *c, size_t got) {
  char text[400] = "";
  size_t used = 0;
  vs_value who = c->count ? vs_as_code(vs_as_closure(c->clause[0])->code)->name : VS_FALSE;
  for (size_t i = 0; i < c->count && used < sizeof text; i++) {
    wanted w = {.used = 0};
    const char *names = want_closure(vs_as_code(vs_as_closure(c->clause[i])->code), &w);
    int n = snprintf(text + used, sizeof text - used, "%s%s", i ? " or" : "; it takes", *names ? names : " ()");
    used += n < 0 ? sizeof text : (size_t)n;
  }
  return vs_fail(vm, vm->sym.arity, "%s cannot take %zu argument%s%s", name_of(who), got, got == 1 ? "" : "s",
                 used < sizeof text ? text : "");
}

bool vs_arguments_fit(const vs_code *code, size_t n, vs_value kw) {
  size_t named = kw == VS_FALSE ? 0 : vs_as_keywords(kw)->count;
  VS_ASSERT(named <= n);
  return n - named >= code->required && (code->flags & VS_CODE_REST || n - named <= code->required + code->optional) &&
         (!named || code->keywords);
}

static bool names_self_alone(const vs_scheme *vm, vs_value kw) {
  return vs_as_keywords(kw)->count == 1 && vs_as_keywords(kw)->name[0] == vm->sym.self;
}

bool vs_leaves_self(const vs_scheme *vm, vs_value f, vs_value kw) {
  if (!names_self_alone(vm, kw)) return false;
  if (!vs_is(f, VS_T_CLOSURE)) return true;
  const vs_code *code = vs_as_code(vs_as_closure(f)->code);
  const vs_value *names = vs_as_vector(code->params)->at + code->required + code->optional;
  for (size_t i = 0; i < code->keywords; i++)
    if (names[i] == vm->sym.self) return false;
  return true;
}

/* Copies the values of the last `named` arguments of the call, which are passed by keyword, to vm->call_args. */
static bool stash(vs_scheme *vm, const vs_value *a, size_t n, size_t named) {
  VS_ASSERT(named <= n);
  vs_call_begin(vm, VS_FALSE);
  for (size_t i = n - named; i < n; i++)
    if (!vs_call_push(vm, a[i])) return false;
  return true;
}

/* Moves the keyword values from vm->call_args to the array `at`, in the order of the parameters' `names`, which are
 * `count` symbols. */
static bool place(vs_scheme *vm, vs_value who, vs_value kw, const vs_value *names, size_t count, vs_value *at) {
  for (size_t i = 0; i < count; i++) at[i] = VS_ABSENT;
  const vs_keywords *k = kw == VS_FALSE ? NULL : vs_as_keywords(kw);
  for (size_t i = 0; k && i < k->count; i++) {
    size_t j = 0;
    while (j < count && names[j] != k->name[i]) j++;
    if (j == count) return fail_keyword(vm, who, k->name[i], names, count);
    if (at[j] != VS_ABSENT) return vs_fail(vm, vm->sym.arity, "%s got #:%s twice", name_of(who), name_of(k->name[i]));
    at[j] = vm->call_args[i];
  }
  vm->call_count = 0;
  return true;
}

bool vs_arguments_closure(vs_scheme *vm, const vs_code *code, vs_value *a, size_t n, vs_value kw) {
  size_t named = kw == VS_FALSE ? 0 : vs_as_keywords(kw)->count, given = n - named;
  size_t most = code->required + code->optional, rest = most + code->keywords;
  bool has_rest = (code->flags & VS_CODE_REST) != 0;
  VS_ASSERT(named <= n);
  if (given < code->required || (given > most && !has_rest)) {
    const vs_value *names = vs_as_vector(code->params)->at + most, *unknown;
    if (named && given < code->required && (unknown = unknown_keyword(kw, names, code->keywords)))
      return fail_keyword(vm, code->name, *unknown, names, code->keywords);
    wanted text = {.used = 0};
    const taken t = {code->required, has_rest ? SIZE_MAX : most, want_closure(code, &text), names, code->keywords};
    return fail_count(vm, code->name, &t, given);
  }
  if (named && !code->keywords) return fail_keyword(vm, code->name, vs_as_keywords(kw)->name[0], NULL, 0);
  bool self = named && code->keywords == 1 && names_self_alone(vm, kw); /* self: whether a function of a script is
                                                                         * called with `this` and no other keyword */
  if (named && !self && !stash(vm, a, n, named)) return false;
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  r[1] = self ? a[n - 1] : VS_FALSE;
  if (has_rest)
    for (size_t i = given; i > most; i--)
      if (!vs_cons(vm, a[i - 1], r[0], &r[0])) return false;
  for (size_t i = given; i < most; i++) a[i] = VS_ABSENT;
  const vs_value *keyword = vs_as_vector(code->params)->at + most;
  if (self) a[most] = r[1];
  else if (code->keywords && !place(vm, code->name, kw, keyword, code->keywords, a + most)) return false;
  if (has_rest) a[rest] = r[0];
  return true;
}

bool vs_arguments_native(vs_scheme *vm, const vs_native *native, vs_value *a, size_t n, vs_value kw, size_t *given,
                         size_t *total) {
  size_t named = kw == VS_FALSE ? 0 : vs_as_keywords(kw)->count, positional = n - named;
  size_t max = native->max == UINT32_MAX ? SIZE_MAX : native->max;
  VS_ASSERT(named <= n);
  *given = *total = positional;
  if (positional < native->min || positional > max) {
    const vs_vector *names = native->keywords == VS_FALSE ? NULL : vs_as_vector(native->keywords);
    const vs_value *list = names ? names->at : NULL, *unknown;
    size_t count = names ? names->length : 0;
    vm->top = a + n;
    if (named && positional < native->min && (unknown = unknown_keyword(kw, list, count)))
      return fail_keyword(vm, native->name, *unknown, list, count);
    wanted text = {.used = 0};
    fail_count(vm, native->name, &(taken){native->min, max, want_native(native, &text), list, count}, positional);
    return keep_call(vm, vs_from_object(native), a, positional);
  }
  if (named && native->keywords == VS_FALSE)
    return fail_keyword(vm, native->name, vs_as_keywords(kw)->name[0], NULL, 0);
  if (!vs_native_laid_out(native)) return true;
  if (named && !stash(vm, a, n, named)) return false;
  if (max == SIZE_MAX) max = positional;          /* the values of keyword arguments follow the positional arguments */
  for (size_t i = positional; i < max; i++) a[i] = VS_ABSENT;
  size_t at = max;
  if (native->keywords != VS_FALSE) {
    const vs_vector *names = vs_as_vector(native->keywords);
    if (!place(vm, native->name, kw, names->at, names->length, a + at)) return false;
    at += names->length;
  }
  for (int i = 0; i < native->def->slots; i++) a[at++] = VS_FALSE;
  *total = at;
  return true;
}
