/* Implements the expander's loop of tasks, expressions, applications and uses of macros (expand.h). */
#include "vm/front/expand.h"
#include "vm/front/body.h"
#include "vm/front/forms.h"
#include "vm/front/lambda.h"
#include "vm/front/syntax_rules.h"
#include "vm/library/standard.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"
#include "vm/front/suggest.h"
#include "vm/front/environment.h"

#include <stdarg.h>
#include <stdio.h>

enum { MOST_ARGUMENTS = 2000 };
enum { DEPTH_LIMIT = 180 };   /* greatest nesting of tasks; a task adds at most two levels to the tree (limit:
                               * VS_AST_DEPTH) */

enum { KIND_CORE, KIND_DEFINITION, KIND_AUXILIARY, KIND_REWRITE };
static const struct { const char *name, *shape; bool rewrite, auxiliary; } form_table[] = {
#define VS_FORM(id, name, kind, shape) {name, shape, KIND_##kind == KIND_REWRITE, KIND_##kind == KIND_AUXILIARY},
#include "vm/front/forms.def"
#undef VS_FORM
};
const char *vs_form_shape(int form) { return form_table[form].shape; }

typedef bool core_fn(vs_expansion *x);
typedef bool rewrite_fn(vs_expansion *x, vs_value *form);
static core_fn *const core_table[] = {
#define FN_CORE(id) vs_form_##id
#define FN_REWRITE(id) NULL
#define FN_DEFINITION(id) NULL
#define FN_AUXILIARY(id) NULL
#define VS_FORM(id, name, kind, shape) FN_##kind(id),
#include "vm/front/forms.def"
#undef VS_FORM
#undef FN_CORE
#undef FN_REWRITE
};
static rewrite_fn *const rewrite_table[] = {
#define FN_CORE(id) NULL
#define FN_REWRITE(id) vs_form_##id
#define VS_FORM(id, name, kind, shape) FN_##kind(id),
#include "vm/front/forms.def"
#undef VS_FORM
};

/* ---- creating and freeing ---- */
static void trace(vs_scheme *vm, void *object, void (*mark)(vs_scheme *vm, vs_value *slot)) {
  vs_expansion *x = object;
  mark(vm, &x->now.form); mark(vm, &x->now.env); mark(vm, &x->now.acc);
  mark(vm, &x->procedure); mark(vm, &x->args); mark(vm, &x->forms); mark(vm, &x->later);
  for (size_t i = vs_gc_is_minor(vm) ? x->old : 0; i < x->count; i++) {
    mark(vm, &x->tasks[i].form);
    mark(vm, &x->tasks[i].env);
    mark(vm, &x->tasks[i].acc);
  }
  if (vs_gc_is_minor(vm)) x->old = x->count; /* after a minor garbage collection, the values of waiting tasks are in old
                                              * space and do not change */
}

static void release(void *object) {
  vs_expansion *x = object;
  if (x->tree) vs_ast_close(&x->ast);
  if (x->tasks) vs_mem(x->vm, x->tasks, x->room * sizeof *x->tasks, 0);
  vs_mem(x->vm, x, sizeof *x, 0);
}

const vs_foreign_type vs_expansion_type = {.name = "expansion", .release = release, .trace = trace};

static const vs_task no_task = {.form = VS_UNSPECIFIC, .env = VS_UNSPECIFIC, .acc = VS_UNSPECIFIC};

bool vs_expansion_make(vs_scheme *vm, vs_value *out) {
  vs_expansion *x = vs_mem(vm, NULL, 0, sizeof *x);
  if (!x) return false;
  memset(x, 0, sizeof *x);
  x->vm = vm;
  x->now = no_task;
  x->procedure = x->args = x->forms = x->later = VS_UNSPECIFIC;
  return vs_make_foreign(vm, &vs_expansion_type, x, sizeof *x, out);
}

/* ---- the stack of tasks ---- */
vs_task *vs_expand_top(vs_expansion *x) { return &x->tasks[x->count - 1]; }

static bool push_task(vs_expansion *x, const vs_task *t) {
  if (x->count == x->room) {
    size_t room = x->room ? 2 * x->room : 64;
    vs_task *tasks = vs_mem(x->vm, x->tasks, x->room * sizeof *tasks, room * sizeof *tasks);
    if (!tasks) return false;
    x->tasks = tasks;
    x->room = room;
  }
  if (x->old > x->count) x->old = x->count;
  x->tasks[x->count++] = *t;
  return true;
}

bool vs_expand_push(vs_expansion *x, vs_task_kind kind, vs_value form, vs_value env, vs_pos pos, vs_core_node **into,
                    uint32_t depth) {
  vs_task t = {
    .kind = (uint8_t)kind, .depth = depth, .pos = pos, .into = into, .form = form, .env = env, .acc = VS_NIL
  };
  return push_task(x, &t);
}

/* ---- places of forms ---- */
vs_pos vs_form_pos(vs_value form, vs_pos outer) {
  vs_pos p = vs_is_pair(form) ? vs_pair_pos(form) : 0;
  return p ? p : outer;
}

vs_pos vs_element_pos(vs_value pair, bool first, vs_pos outer) {
  vs_value car = vs_car(pair);
  vs_pos p = vs_is_pair(car) ? vs_pair_pos(car) : 0;
  if (p) return p;
  p = vs_pair_pos(pair);
  if (!p) return outer;
  return first ? vs_pos_make(vs_pos_file(p), vs_pos_line(p), vs_pos_col(p) + 1) : p;
}

/* ---- reporting errors ---- */
bool vs_expand_fail(vs_expansion *x, vs_pos pos, vs_value what, const char *format, ...) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 1);
  r[0] = what;
  char text[400];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  if (what != VS_ABSENT && !(vs_strip(vm, r[0], &r[0]) && vs_cons(vm, r[0], VS_NIL, &r[0]))) return false;
  return vs_fail_at(vm, vm->sym.syntax, pos, what == VS_ABSENT ? VS_NIL : r[0], "%s", text);
}

bool vs_expand_shape(vs_expansion *x, int form) {
  VS_ASSERT(form >= 0 && form < VS_FORM_COUNT);
  return vs_expand_fail(x, x->now.pos, x->now.form, "%s is written %s%s, not", form_table[form].name,
                        form_table[form].shape,
                        form == VS_FORM_if && vs_list_length(x->now.form) > 4
                            ? ", and (begin a b ...) is one part of several" : "");
}

/* ---- creating nodes ---- */
vs_core_node *vs_expand_node(vs_expansion *x, int kind, vs_pos pos) { return vs_ast_node(&x->ast, kind, pos); }
vs_core_node *vs_expand_many(vs_expansion *x, int kind, size_t n, vs_pos pos) {
  return vs_ast_list(&x->ast, kind, n, pos);
}

static vs_core_node *global(vs_expansion *x, int kind, vs_value cell, vs_pos pos) {
  vs_core_node *n = vs_ast_node(&x->ast, kind, pos);
  return n && vs_ast_const(&x->ast, cell, &n->as.global.cell) ? n : NULL;
}

vs_core_node *vs_expand_core(vs_expansion *x, const char *name, vs_pos pos) {
  vs_value id, cell;
  if (!vs_intern_c(x->vm, name, &id)) return NULL;
  vs_meaning m = vs_environment_find(x->vm->at.core, id);
  if (m.kind == VS_MEANS_MACRO) {
    vs_fail_at(x->vm, x->vm->sym.internal, pos, VS_NIL, "%s is syntax", name);
    return NULL;
  }
  return vs_environment_cell(x->vm, &m, &cell) ? global(x, VS_AST_GLOBAL, cell, pos) : NULL;
}

vs_core_node *vs_expand_call(vs_expansion *x, const char *name, size_t n, vs_pos pos) {
  vs_core_node *call = vs_ast_list(&x->ast, VS_AST_CALL, n, pos);
  return call && (call->as.call.callee = vs_expand_core(x, name, pos)) ? call : NULL;
}

bool vs_is_form(vs_value env, vs_value id, int form) {
  VS_ASSERT(form >= 0 && form < VS_FORM_COUNT);
  if (!vs_is_identifier(id)) return false;
  vs_meaning m = vs_environment_find(env, id);
  if (m.kind == VS_MEANS_MACRO) return vs_as_macro(m.value)->kind == vs_fix(form);
  /* auxiliary words such as else and => keep their meaning even if they were not imported */
  return m.kind == VS_MEANS_NOTHING && form_table[form].auxiliary &&
         !strcmp(vs_as_symbol(vs_identifier_symbol(id))->name, form_table[form].name);
}

/* ---- syntax that was not imported ---- */
int vs_unit_word(const vs_meaning *m) {
  const char *name = m->kind == VS_MEANS_NOTHING && vs_is_symbol(m->id) ? vs_as_symbol(m->id)->name : "";
  return !strcmp(name, "import") ? VS_FORM_import : !strcmp(name, "define-library") ? VS_FORM_define_library : -1;
}

static bool defines(vs_value form, vs_value name) {
  if (!vs_is_pair(form) || !vs_is_symbol(vs_car(form)) || !vs_is_pair(vs_cdr(form)) ||
      strncmp(vs_as_symbol(vs_car(form))->name, "define", 6))
    return false;
  vs_value what = vs_car(vs_cdr(form));
  while (vs_is_pair(what)) what = vs_car(what);
  return what == name;
}

/* Reports a call of an undefined name that is syntax in the language's library or in a library that vs contains, since
 * expanding the call's operands would report misleading errors. If a later form of the program defines the name, it is
 * a procedure, and there is no error. */
static bool check_imported(vs_expansion *x, vs_value id, vs_pos pos) {
  vs_scheme *vm = x->vm;
  vs_value name = vs_identifier_symbol(id), known = vs_idtable_get(vs_as_environment(vm->at.core)->table, name);
  if ((known != VS_VACANT && !vs_is(known, VS_T_MACRO)) || *vs_as_symbol(name)->name == '%') return true;
  for (vs_value l = x->later; vs_is_pair(l); l = vs_cdr(l)) if (defines(vs_car(l), name)) return true;
  vs_text t;
  vs_text_open(vm, &t, 300);
  bool known_here = known != VS_VACANT, ok = vs_library_advice(vm, name, !known_here, &t) && vs_text_end(&t);
  if (ok && (known_here || t.count))
    ok = vs_fail_at(vm, vm->sym.unbound, pos, VS_NIL, "%s is not defined%s", vs_as_symbol(name)->name, t.at);
  vs_text_close(&t);
  return ok;
}

static bool not_an_expression(vs_expansion *x, vs_value id, const vs_meaning *m, vs_pos pos) {
  vs_value kind = vs_as_macro(m->value)->kind;
  const char *name = vs_as_symbol(vs_identifier_symbol(id))->name;
  if (kind == vs_fix(VS_FORM_arrow))
    return vs_expand_fail(x, pos, VS_ABSENT,
                          "=> belongs in a clause of cond; a procedure is written (lambda (x) body ...), without =>");
  if (kind == vs_fix(VS_FORM_and) || kind == vs_fix(VS_FORM_or))
    return vs_expand_fail(x, pos, VS_ABSENT,
                          "%s comes first in parentheses of its own: (%s a b), (%s (= x 1) (= x 2)); it has no value",
                          name, name, name);
  if (vs_is_fixnum(kind) && vs_fixnum(kind) >= 0)
    return vs_expand_fail(x, pos, VS_ABSENT, "%s is syntax and has no value; it is written %s", name,
                          form_table[vs_fixnum(kind)].shape);
  return vs_expand_fail(x, pos, VS_ABSENT, "%s is syntax and has no value; it comes first in parentheses", name);
}

/* Returns the variable to which the local meaning m refers. If the variable belongs to another expansion, reports an
 * error and returns NULL. */
static vs_var *local(vs_expansion *x, const vs_meaning *m, vs_value id, vs_pos pos) {
  if (vs_as_environment(m->env)->data != vs_fix(x->serial)) {
    vs_expand_fail(x, pos, VS_ABSENT, "%s is a variable that has no value yet when macros are expanded",
                   vs_as_symbol(vs_identifier_symbol(id))->name);
    return NULL;
  }
  return (vs_var *)(uintptr_t)vs_fixnum(m->value);
}

/* Searches the local names for a name that is similar to an undefined name. *m is not changed, but its objects are
 * updated if the garbage collector moves them. */
static bool near_local(vs_expansion *x, vs_value env, vs_meaning *m) {
  VS_ROOTS(x->vm, r, 2);
  r[0] = m->env; r[1] = m->id;
  bool ok = vs_suggest_local(x->vm, env, m->id);
  m->env = r[0]; m->id = r[1];
  return ok;
}

vs_core_node *vs_expand_ref(vs_expansion *x, vs_value id, vs_value env, vs_pos pos) {
  vs_meaning m = vs_environment_find(env, id);
  if (m.kind == VS_MEANS_MACRO) { not_an_expression(x, id, &m, pos); return NULL; }
  if (m.kind == VS_MEANS_LOCAL) {
    vs_var *var = local(x, &m, id, pos);
    return var ? vs_ast_local(&x->ast, var, pos) : NULL;
  }
  vs_value cell;
  if (m.kind == VS_MEANS_NOTHING && !vs_is_top(env) && !near_local(x, env, &m)) return NULL;
  return vs_environment_cell(x->vm, &m, &cell) ? global(x, VS_AST_GLOBAL, cell, pos) : NULL;
}

bool vs_expand_scope(vs_expansion *x, vs_value env, vs_value *out) { return vs_scope_new(x->vm, env, x->serial, out); }

bool vs_expand_var(vs_expansion *x, vs_value id, vs_value scope, vs_var **var) {
  bool introduced = !vs_is_symbol(id);
  *var = vs_ast_var(&x->ast, vs_identifier_symbol(id));
  if (*var) (*var)->introduced = introduced;
  return *var && vs_environment_bind(x->vm, scope, id, vs_fix((int64_t)(uintptr_t)*var));
}

bool vs_expand_nth(vs_expansion *x, int64_t nth, vs_value env, vs_core_node **into) {
  vs_value l = x->now.form;
  VS_ASSERT(nth >= 0 && nth < vs_list_length(x->now.form));
  for (int64_t i = 0; i < nth; i++) l = vs_cdr(l);
  return vs_expand_push(x, VS_TASK_EXPR, vs_car(l), env, vs_element_pos(l, nth == 0, x->now.pos), into,
                        x->now.depth + 1);
}

bool vs_expand_list(vs_expansion *x, vs_value list, vs_value env, vs_core_node **at, uint32_t depth) {
  bool ok = true;
  for (size_t i = 0; ok && vs_is_pair(list); list = vs_cdr(list), i++)
    ok = vs_expand_push(x, VS_TASK_EXPR, vs_car(list), env, vs_element_pos(list, false, x->now.pos), &at[i], depth);
  return ok;
}

bool vs_expand_body(vs_expansion *x, vs_value forms, vs_value env, vs_pos pos, vs_core_node **into, uint32_t depth) {
  VS_ROOTS(x->vm, r, 2);
  r[0] = forms;
  return vs_expand_scope(x, env, &r[1]) && vs_expand_push(x, VS_TASK_BODY, r[0], r[1], pos, into, depth);
}

/* ---- assignments ---- */
bool vs_form_set(vs_expansion *x) {
  vs_value form = x->now.form;
  if (vs_list_length(form) == 4 && vs_is_symbol(vs_car(vs_cdr(form))) && vs_is_symbol(vs_car(vs_cdr(vs_cdr(form))))) {
    const char *name = vs_as_symbol(vs_car(vs_cdr(form)))->name,
               *sign = vs_as_symbol(vs_car(vs_cdr(vs_cdr(form))))->name;
    if (strlen(sign) == 2 && sign[1] == '=' && strchr("+-*/", *sign))
      return vs_expand_fail(x, x->now.pos, VS_ABSENT, "set! gets the whole new value: (set! %s (%c %s 1))", name, *sign,
                            name);
  }
  if (vs_list_length(form) != 3 || !vs_is_identifier(vs_car(vs_cdr(form)))) return vs_expand_shape(x, VS_FORM_set);
  vs_value id = vs_car(vs_cdr(form));
  vs_pos pos = vs_element_pos(vs_cdr(form), false, x->now.pos);
  vs_meaning m = vs_environment_find(x->now.env, id);
  vs_core_node *n;
  if (m.kind == VS_MEANS_MACRO) return not_an_expression(x, id, &m, pos);
  if (m.kind == VS_MEANS_LOCAL) {
    vs_var *var = local(x, &m, id, pos);
    if (!var || !(n = vs_expand_node(x, VS_AST_SETLOCAL, x->now.pos))) return false;
    n->as.set.var = var;
    *x->now.into = n;
    return vs_expand_nth(x, 2, x->now.env, &n->as.set.value);
  }
  vs_value cell;
  if (m.kind == VS_MEANS_NOTHING && !vs_is_top(x->now.env) && !near_local(x, x->now.env, &m)) return false;
  if (!vs_environment_cell(x->vm, &m, &cell)) return false;
  if (!m.foreign) vs_object_of(cell)->flags |= VS_F_ASSIGNED;
  if (!(n = global(x, VS_AST_SETGLOBAL, cell, x->now.pos))) return false;
  *x->now.into = n;
  return vs_expand_nth(x, 2, x->now.env, &n->as.global.value);
}

/* ---- applications ---- */
static bool is_keyword(vs_value v) {
  return vs_is_symbol(v) && vs_as_symbol(v)->length > 2 && !memcmp(vs_as_symbol(v)->name, "#:", 2);
}

/* Compiles a call with more arguments than an activation can hold as smaller calls, such as (apply f (append (list ...)
 * (list ...) ...)). A mesh that is written as data is such a call. */
static bool long_application(vs_expansion *x, size_t n) {
  vs_pos pos = x->now.pos;
  size_t lists = (n + MOST_ARGUMENTS - 1) / MOST_ARGUMENTS;
  vs_core_node *apply = vs_expand_call(x, "apply", 2, pos), *append = vs_expand_call(x, "append", lists, pos);
  if (!apply || !append) return false;
  *x->now.into = apply;
  apply->as.call.at[1] = append;
  bool ok = vs_expand_nth(x, 0, x->now.env, &apply->as.call.at[0]);
  vs_value l = vs_cdr(x->now.form);
  for (size_t i = 0; ok && i < lists; i++) {
    size_t count = n - i * MOST_ARGUMENTS < MOST_ARGUMENTS ? n - i * MOST_ARGUMENTS : MOST_ARGUMENTS;
    VS_ROOTS(x->vm, r, 1);
    r[0] = l;
    vs_core_node *list = append->as.call.at[i] = vs_expand_call(x, "list", count, pos);
    if (!list) return false;
    l = r[0];
    for (size_t k = 0; ok && k < count; k++, l = vs_cdr(l))
      ok = vs_expand_push(x, VS_TASK_EXPR, vs_car(l), x->now.env, vs_element_pos(l, false, pos), &list->as.call.at[k],
                          x->now.depth + 3);
  }
  return ok;
}

/* Compiles a call in which a keyword is given twice to an error at run time. It is not reported as a syntax error, so
 * that a program can handle it. */
static bool given_twice(vs_expansion *x, vs_value name) {
  char text[300];
  VS_ROOTS(x->vm, r, 1);
  int n = snprintf(text, sizeof text, "#:%.200s is given twice", vs_as_symbol(name)->name);
  vs_core_node *call = vs_expand_call(x, "error", 1, x->now.pos);
  return call && (*x->now.into = call) && vs_string_from_utf8(x->vm, text, (size_t)n, &r[0]) &&
         (call->as.call.at[0] = vs_ast_constant(&x->ast, r[0], x->now.pos)) != NULL;
}

static void warn_of_one(vs_expansion *x, vs_value form);

/* Reports a form such as (class name (define ...)) by its first word, which has no meaning here. An error about the
 * definition inside would mislead. */
static bool check_words(vs_expansion *x, vs_value form) {
  vs_scheme *vm = x->vm;
  vs_value head = vs_car(form);
  if (!vs_is_symbol(head) || !vs_is_pair(vs_cdr(form))) return true;
  bool defines_inside = false;
  for (vs_value l = vs_cdr(form); vs_is_pair(l) && !defines_inside; l = vs_cdr(l)) {
    vs_value part = vs_car(l), inner = vs_is_pair(part) && vs_is_pair(vs_car(part)) ? vs_car(part) : part;
    vs_value word = vs_is_pair(inner) ? vs_car(inner) : VS_FALSE;
    defines_inside = vs_is_symbol(word) && vs_is_form(x->now.env, word, VS_FORM_define);
  }
  if (!defines_inside || !vs_is_foreign_word(head)) return true;
  vs_meaning m = vs_environment_find(x->now.env, head);
  bool bound = m.kind == VS_MEANS_LOCAL || (m.kind == VS_MEANS_CELL && vs_as_cell(m.value)->value != VS_UNDEFINED);
  if (bound || m.kind == VS_MEANS_MACRO) return true;
  vs_text t;
  vs_text_open(vm, &t, 600);
  bool ok = vs_foreign_advice(vs_as_symbol(head)->name, &t) && vs_text_end(&t) &&
            vs_fail_at(vm, vm->sym.unbound, x->now.pos, VS_NIL, "%s is not defined%s", vs_as_symbol(head)->name, t.at);
  vs_text_close(&t);
  return ok;
}

static bool application(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  vs_value form = x->now.form;
  int64_t length = vs_list_length(form);
  if (length < 0) return vs_expand_fail(x, x->now.pos, form, "a call is a list: remove the . in it:");
  size_t keys = 0;
  for (vs_value l = vs_cdr(form); vs_is_pair(l); l = vs_cdr(l)) {
    if (!is_keyword(vs_car(l))) continue;
    keys++;
    if (!vs_is_pair(vs_cdr(l)) || is_keyword(vs_car(vs_cdr(l))))
      return vs_expand_fail(x, vs_element_pos(l, false, x->now.pos), VS_ABSENT, "a value is missing after %s",
                            vs_as_symbol(vs_car(l))->name);
    l = vs_cdr(l);
  }
  if (!check_words(x, form)) return false;
  if (length == 2) warn_of_one(x, form);
  size_t n = (size_t)length - 1 - keys, plain = 0, keyed = n - keys;
  if (n > MOST_ARGUMENTS && !keys) return long_application(x, n);
  vs_core_node *call = vs_expand_many(x, VS_AST_CALL, n, x->now.pos);
  if (!call) return false;
  *x->now.into = call;
  if (keys) {
    VS_ROOTS(vm, r, 2);
    if (!vs_make_vector(vm, keys, VS_FALSE, &r[0])) return false;
    size_t k = 0;
    for (vs_value l = vs_cdr(x->now.form); vs_is_pair(l); l = vs_cdr(l)) {
      if (!is_keyword(vs_car(l))) continue;
      const vs_symbol *s = vs_as_symbol(vs_car(l));
      vs_value name;
      char copy[256];
      if (s->length - 2 > sizeof copy) return vs_expand_fail(x, x->now.pos, VS_ABSENT, "this keyword is too long");
      memcpy(copy, s->name + 2, s->length - 2);
      if (!vs_intern(vm, copy, s->length - 2, &name)) return false;
      for (size_t i = 0; i < k; i++)
        if (vs_as_vector(r[0])->at[i] == name) return given_twice(x, name);
      vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[k++], name);
      l = vs_cdr(l);
    }
    vs_value names[64];
    if (keys > 64) return vs_expand_fail(x, x->now.pos, VS_ABSENT, "more than 64 keywords");
    memcpy(names, vs_as_vector(r[0])->at, keys * sizeof *names);      /* symbols do not move in memory, so their
                                                                       * addresses may be copied */
    uint32_t index;
    if (!vs_make_keywords(vm, names, keys, &r[1]) || !vs_ast_const(&x->ast, r[1], &index)) return false;
    call->as.call.keywords = 1 + index;
  }
  uint32_t depth = x->now.depth + 1;
  bool ok = vs_expand_nth(x, 0, x->now.env, &call->as.call.callee);
  for (vs_value l = vs_cdr(x->now.form); ok && vs_is_pair(l); l = vs_cdr(l)) {
    vs_core_node **into = &call->as.call.at[plain];
    if (is_keyword(vs_car(l))) { l = vs_cdr(l); into = &call->as.call.at[keyed++]; }
    else plain++;
    ok = vs_expand_push(x, VS_TASK_EXPR, vs_car(l), x->now.env, vs_element_pos(l, false, x->now.pos), into, depth);
  }
  return ok;
}

/* ---- uses of macros ---- */
/* Expands a macro use once: the current task's form, or the first form of a body. Sets *wait to true if the task must
 * wait for the result of the macro's transformer. */
static bool use_macro(vs_expansion *x, vs_value macro, vs_value form, vs_pos pos, vs_value *out, bool *wait) {
  vs_scheme *vm = x->vm;
  *wait = false;
  if (!vs_poll(vm, 256)) return false;
  if (vs_as_macro(macro)->kind == vs_fix(VS_MACRO_RULES)) return vs_rules_expand(x, macro, form, x->now.env, pos, out);
  /* Calls (transformer form rename compare). A procedure of the library creates rename and compare from the two
   * environments. */
  VS_ROOTS(vm, r, 4);
  r[0] = form; r[1] = macro;
  if (!vs_cons(vm, x->now.env, VS_NIL, &r[2]) || !vs_cons(vm, vs_as_macro(r[1])->env, r[2], &r[2]) ||
      !vs_cons(vm, r[0], r[2], &r[2]) || !vs_cons(vm, vs_as_macro(r[1])->transformer, r[2], &r[2]) ||
      !vs_intern_c(vm, "%expand-by-renaming", &r[3]))
    return false;
  x->procedure = vs_environment_value(vm->at.core, r[3]);
  x->args = r[2];
  vm->top_place = pos;        /* vm->top_place: the place for errors in the transformer's calls */
  *wait = true;
  return true;
}

/* Expands the macro at the head of *form, repeatedly, until *form is core syntax, an application or no pair. Sets *m to
 * the meaning of its head. Returns false on an error, or with x->now.waiting set if the task must wait. */
bool vs_expand_settle(vs_expansion *x, vs_value *form, vs_meaning *m, vs_pos *pos) {
  for (;;) {
    *m = (vs_meaning){.kind = VS_MEANS_NOTHING, .value = VS_VACANT, .env = x->now.env, .id = VS_FALSE};
    *pos = vs_form_pos(*form, *pos);
    if (!vs_is_pair(*form) || !vs_is_identifier(vs_car(*form))) return true;
    *m = vs_environment_find(x->now.env, vs_car(*form));
    if (m->kind == VS_MEANS_NOTHING)
      return (x->now.kind == VS_TASK_TOP && vs_unit_word(m) >= 0) || check_imported(x, vs_car(*form), *pos);
    if (m->kind != VS_MEANS_MACRO) return true;
    vs_value kind = vs_as_macro(m->value)->kind;
    if (vs_fixnum(kind) >= 0 && !form_table[vs_fixnum(kind)].rewrite) return true;
    vs_pos before = x->now.pos;
    x->now.pos = *pos;
    if (vs_fixnum(kind) >= 0) {
      if (!rewrite_table[vs_fixnum(kind)](x, form)) return false;
    } else if (!use_macro(x, m->value, *form, *pos, form, &x->now.waiting) || x->now.waiting) return false;
    x->now.pos = before;
  }
}


bool vs_expand_outline(vs_expansion *x) {
  if (x->now.depth <= DEPTH_LIMIT) return true;
  vs_core_node *call = vs_expand_many(x, VS_AST_CALL, 0, x->now.pos),
          *thunk = vs_expand_many(x, VS_AST_LAMBDA, 0, x->now.pos);
  if (!call || !thunk) return false;
  call->as.call.callee = thunk;
  *x->now.into = call;
  x->now.into = &thunk->as.lambda.body;
  x->now.depth = 0;
  return true;
}

/* ---- tests that are procedures ---- */

/* Returns true if the identifier names a procedure of the library, or a procedure that the program has defined. */
static bool names_procedure(vs_value id, vs_value env) {
  vs_meaning m = vs_environment_find(env, id);
  if (m.kind != VS_MEANS_CELL || !vs_is(m.value, VS_T_CELL)) return false;
  vs_value value = vs_as_cell(m.value)->value;
  if (vs_object_of(m.value)->flags & VS_F_CONSTANT) return value != VS_UNDEFINED && vs_is_procedure(value);
  return vs_is(value, VS_T_CLOSURE) && vs_as_code(vs_as_closure(value)->code)->name == vs_identifier_symbol(id);
}

static bool combines_predicates(vs_value id, vs_value env) {
  static const char *const names[] = { "list-of", "and-of", "or-of", "not-of", NULL };
  if (!vs_is_identifier(id)) return false;
  vs_meaning m = vs_environment_find(env, id);
  if (m.kind != VS_MEANS_CELL || !(vs_object_of(m.value)->flags & VS_F_CONSTANT)) return false;
  for (size_t i = 0; names[i]; i++)
    if (!strcmp(vs_as_symbol(vs_identifier_symbol(id))->name, names[i])) return true;
  return false;
}

/* Warns about (random 1), whose result is always 0. */
static void warn_of_one(vs_expansion *x, vs_value form) {
  vs_scheme *vm = x->vm;
  if (!vs_is_symbol(vs_car(form)) || vs_cdr(vs_cdr(form)) != VS_NIL || vs_car(vs_cdr(form)) != vs_fix(1)) return;
  if (strcmp(vs_as_symbol(vs_car(form))->name, "random") != 0 || !names_procedure(vs_car(form), x->now.env)) return;
  if (vm->config.warn)
    vm->config.warn(vm, x->now.pos, "(random 1) is always 0: it is a whole number below 1; (random 1.0) is any number "
                                    "from 0 to 1, (random 6) one of 0 to 5");
}

/* Warns about a test whose value is certainly a procedure and therefore true. For example, (and integer? positive?) has
 * the value positive?. */
static void warn_of_procedure(vs_expansion *x, vs_value form, const vs_meaning *head) {
  vs_scheme *vm = x->vm;
  char text[300];
  if (!vm->config.warn) return;
  if (vs_is_identifier(form)) {
    if (!names_procedure(form, x->now.env)) return;
    const char *name = vs_as_symbol(vs_identifier_symbol(form))->name;
    snprintf(text, sizeof text,
             "%.60s is a procedure, which counts as true: it is not called here; (%.60s x) asks it, and (and-of p q), "
             "(or-of p q), (not-of p) combine predicates",
             name, name);
  } else if (vs_is_pair(form) && head->kind == VS_MEANS_MACRO &&
             vs_as_macro(head->value)->kind == vs_fix(VS_FORM_lambda)) {
    snprintf(text, sizeof text, "this lambda is a procedure, which counts as true: it is not called here");
  } else if (vs_is_pair(form) && combines_predicates(vs_car(form), x->now.env)) {
    const char *name = vs_as_symbol(vs_identifier_symbol(vs_car(form)))->name;
    snprintf(text, sizeof text,
             "(%s ...) gives a procedure, which counts as true: it is not called here; (and-of p q), (or-of p q), "
             "(not-of p) combine predicates",
             name);
  } else {
    return;
  }
  vm->config.warn(vm, x->now.pos, text);
}

static bool expression(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  if (vs_is_pair(x->now.form) && !vs_expand_outline(x)) return false;
  VS_ROOTS(vm, r, 1);
  r[0] = x->now.form;
  vs_meaning m;
  if (!vs_expand_settle(x, &r[0], &m, &x->now.pos)) { if (x->now.waiting) x->now.form = r[0]; return false; }
  x->now.form = r[0];
  if (x->now.decides) warn_of_procedure(x, r[0], &m);
  if (vs_is_identifier(r[0])) {
    if (is_keyword(r[0]))
      return vs_expand_fail(x, x->now.pos, VS_ABSENT, "the keyword %s belongs before an argument of a call",
                            vs_as_symbol(r[0])->name);
    return (*x->now.into = vs_expand_ref(x, r[0], x->now.env, x->now.pos)) != NULL;
  }
  if (!vs_is_pair(r[0])) {
    if (r[0] == VS_NIL)
      return vs_expand_fail(x, x->now.pos, VS_ABSENT, "() calls nothing; the empty list is written '()");
    return vs_strip(vm, r[0], &r[0]) && (*x->now.into = vs_ast_constant(&x->ast, r[0], x->now.pos)) != NULL;
  }
  if (m.kind != VS_MEANS_MACRO) return application(x);
  int form = (int)vs_fixnum(vs_as_macro(m.value)->kind);
  if (core_table[form]) return core_table[form](x);
  switch (form) {
  case VS_FORM_define:
  case VS_FORM_define_syntax:
  case VS_FORM_define_library:
  case VS_FORM_import:
  case VS_FORM_require:
  case VS_FORM_provide:
    return vs_expand_fail(
        x, x->now.pos, VS_ABSENT, "%s is not allowed here, only at top level%s", form_table[form].name,
        form <= VS_FORM_define_syntax
            ? " or in the body of a procedure, let, when, cond and the like; for a name inside an expression use let"
            : "");
  case VS_FORM_else: case VS_FORM_arrow:
    return vs_expand_fail(x, x->now.pos, VS_ABSENT, "%s belongs in a clause of cond or case%s", form_table[form].name,
                          form == VS_FORM_else ? "; if has no word before its last part: (if test then else)" : "");
  case VS_FORM_unquote: case VS_FORM_unquote_splicing:
    return vs_expand_fail(x, x->now.pos, VS_ABSENT,
                          "a comma belongs inside a template: %s; a decimal point is a point, 1.5",
                          form_table[form].shape);
  default:
    return vs_expand_fail(x, x->now.pos, VS_ABSENT, "%s is not allowed here; it belongs into %s", form_table[form].name,
                          form_table[form].shape);
  }
}

/* ---- the loop of tasks ---- */

bool vs_expansion_begin(vs_expansion *x, vs_value form, vs_value env, vs_pos pos) {
  x->count = 0;
  x->now = no_task;
  x->procedure = x->args = x->forms = x->later = VS_UNSPECIFIC;
  x->root = NULL;
  x->definition = false;
  x->serial = ++x->vm->expansions;
  VS_ROOTS(x->vm, r, 2);
  r[0] = form; r[1] = env;
  if (!x->tree && !(x->tree = vs_ast_open(x->vm, &x->ast))) return false;
  vs_ast_clear(&x->ast);
  x->result = VS_EXPAND_NODE;
  return vs_expand_push(x, VS_TASK_TOP, r[0], r[1], pos, &x->root, 0);
}

vs_expand_result vs_expansion_step(vs_expansion *x, vs_value value) {
  x->vm->native = NULL;      /* an error must not show the native that runs the expansion */
  while (x->count) {
    x->now = x->tasks[--x->count];
    bool ok = vs_poll(x->vm, 64);
    if (ok && x->now.waiting) {
      x->now.waiting = false;
      if (x->now.kind == VS_TASK_EXPR) x->now.form = value;
      else ok = vs_body_resume(x, value);
      value = VS_UNSPECIFIC;
    }
    if (ok) switch ((vs_task_kind)x->now.kind) {
    case VS_TASK_EXPR: ok = expression(x); break;
    case VS_TASK_BODY: ok = vs_body_step(x); break;
    case VS_TASK_TOP: ok = vs_top_step(x); break;
    case VS_TASK_QUASI: ok = vs_quasi_step(x); break;
    case VS_TASK_CASE: ok = vs_case_step(x); break;
    case VS_TASK_PREDICATE: ok = vs_predicate_step(x); break;
    }
    if (x->now.waiting) return push_task(x, &x->now) ? VS_EXPAND_CALL : VS_EXPAND_ERROR;
    if (!ok) {
      vs_value c = x->vm->condition;      /* errors such as a missing file have no place yet */
      if (vs_is(c, VS_T_CONDITION) && !vs_as_condition(c)->place) vs_as_condition(c)->place = x->now.pos;
      x->count = 0;
      x->now = no_task;
      return VS_EXPAND_ERROR;
    }
  }
  x->now = no_task;
  return x->result;
}
