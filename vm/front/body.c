/* Expands definitions: bodies, the top level, define, define-syntax and transformers.
 *
 * A body is expanded form by form. The macro at the head of a form is expanded until the form is a definition, a
 * `begin` or an expression. The name of a definition is bound at once, and the form of its value is stored; the forms
 * of a `begin` are inserted into the body. When all names are known, the stored forms are expanded. All definitions,
 * with the expressions between them, become one FIX (letrec*), and the expressions after the last definition become its
 * body.
 *
 * The stored forms are a list, newest first, of vectors #(variable form place parameters). The variable is a fixnum
 * address, or #f for an expression. If a procedure is defined, `form` is the procedure's body; otherwise `parameters`
 * is VS_ABSENT. */
#include "vm/front/body.h"

#include "vm/front/derived_syntax.h"
#include "vm/front/expand.h"
#include "vm/front/lambda.h"
#include "vm/front/syntax_rules.h"
#include "vm/library/library.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"

#include <stdio.h>


/* ---- the parts of a define ---- */
/* Returns true if all elements of the list are names, none of which is an operator. */
static bool is_parameter_list(vs_value list) {
  for (; vs_is_pair(list); list = vs_cdr(list))
    if (!vs_is_symbol(vs_car(list)) || strchr("+-*/<>=", *vs_as_symbol(vs_car(list))->name)) return false;
  return list == VS_NIL;
}

/* Reports the mistake (define f (x) body): the name f must be inside the parentheses of the parameters. */
static bool fail_split(vs_expansion *x, vs_pos pos, const char *name, vs_value parameters) {
  char shown[200];
  size_t used = 0;
  for (vs_value l = parameters; vs_is_pair(l) && used < sizeof shown; l = vs_cdr(l)) {
    bool named = vs_is_identifier(vs_car(l));
    const char *one = named ? vs_as_symbol(vs_identifier_symbol(vs_car(l)))->name : "parameter";
    int n = snprintf(shown + used, sizeof shown - used, " %s", one);
    used += n < 0 ? sizeof shown : (size_t)n;
  }
  shown[used < sizeof shown ? used : 0] = 0;
  return vs_expand_fail(
      x, pos, VS_ABSENT,
      "define: a procedure is written (define (%s%s) body ...), its name inside the parentheses of its parameters",
      name, shown);
}

/* Divides a define form into name, parameters and body. A curried definition (define ((f a) b) ...) becomes a procedure
 * whose body is a lambda. */
bool vs_define_parts(vs_expansion *x, vs_value form, vs_value parts[3], bool *procedure) {
  vs_scheme *vm = x->vm;
  vs_value *name = &parts[0], *params = &parts[1], *rest = &parts[2];
  vs_pos pos = vs_form_pos(form, x->now.pos);
  int64_t n = vs_list_length(form);
  if (n < 2) return vs_expand_fail(x, pos, form, "define is written %s, not", vs_form_shape(VS_FORM_define));
  VS_ROOTS(vm, r, 3);
  r[0] = vs_car(vs_cdr(form));
  r[1] = vs_cdr(vs_cdr(form));
  *procedure = vs_is_pair(r[0]);
  while (vs_is_pair(r[0]) && vs_is_pair(vs_car(r[0]))) {          /* a curried definition: (define ((f a) b) ...) */
    if (!vs_core_name(vm, "lambda", &r[2]) || !vs_cons(vm, vs_cdr(r[0]), r[1], &r[1]) ||
        !vs_cons_at(vm, r[2], r[1], pos, &r[1]) || !vs_cons(vm, r[1], VS_NIL, &r[1]))
      return false;
    r[0] = vs_car(r[0]);
  }
  if (*procedure) {
    *name = vs_car(r[0]);
    *params = vs_cdr(r[0]);
    *rest = r[1];
    if (!vs_is_identifier(*name)) return vs_expand_fail(x, pos, *name, "define needs a name, got");
    if (r[1] == VS_NIL)
      return vs_expand_fail(x, pos, VS_ABSENT,
                            "define: the procedure %s has no body; its value is an expression: (define (%s%s) value)",
                            vs_as_symbol(vs_identifier_symbol(*name))->name,
                            vs_as_symbol(vs_identifier_symbol(*name))->name, *params == VS_NIL ? "" : " parameter ...");
    return true;
  }
  *name = r[0];
  if (!vs_is_identifier(r[0]))
    return vs_expand_fail(x, pos, r[0], "define needs a name%s, got",
                          vs_is_string(r[0]) ? ", which has no quotes" : "");
  const char *text = vs_as_symbol(vs_identifier_symbol(r[0]))->name;
  if (n == 2)
    return vs_expand_fail(x, pos, VS_ABSENT, "define: %s gets no value; it is written (define %s value)", text, text);
  if (n > 3) {
    vs_value second = vs_car(r[1]);
    if (n == 4 && vs_is_symbol(second) && !strcmp(vs_as_symbol(second)->name, "="))
      return vs_expand_fail(x, pos, VS_ABSENT, "define: it is written (define %s value), without =", text);
    if (second == VS_NIL || (vs_is_pair(second) && is_parameter_list(second)))
      return fail_split(x, pos, text, second);
    const char *more = !vs_is_symbol(second)                                  ? ""
                       : !strcmp(vs_as_symbol(second)->name, "lambda") ? "; a procedure is (lambda (x) body ...)"
                       : n == 4 && vs_is_pair(vs_car(vs_cdr(r[1])))
                           ? "; a call has its name inside its parentheses: (list 1 2 3)" : "";
    return vs_expand_fail(x, pos, VS_ABSENT, "define: %s gets %lld values; it is written (define %s value)%s", text,
                          (long long)(n - 2), text, more);
  }
  *params = VS_ABSENT;
  *rest = vs_car(r[1]);
  return true;
}

/* ---- transformers of macros ---- */
bool vs_expand_transformer(vs_expansion *x, vs_value spec, vs_value env, vs_value *macro, bool *done) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 4);
  r[0] = spec; r[1] = env;
  *done = true;
  vs_pos pos = vs_form_pos(spec, x->now.pos);
  if (vs_is(spec, VS_T_MACRO)) {                      /* spec is the value of a transformer expression, a macro */
    vs_macro *m = (vs_macro *)(void *)vs_gc_alloc(vm, VS_T_MACRO, VS_WORDS(vs_macro));
    if (!m) return false;
    const vs_macro *from = vs_as_macro(r[0]);
    m->kind = from->kind; m->transformer = from->transformer; m->data = from->data;
    m->env = from->env == VS_FALSE ? r[1] : from->env;
    *macro = vs_from_object(m);
    return true;
  }
  if (vs_is_identifier(spec)) {                       /* another name for syntax: (define-syntax mine if) */
    vs_meaning m = vs_environment_find(env, spec);
    if (m.kind == VS_MEANS_MACRO) { *macro = m.value; return true; }
  }
  if (vs_is_pair(spec) && vs_is_form(env, vs_car(spec), VS_FORM_syntax_rules))
    return vs_rules_make(x, spec, env, pos, macro);
  if (vs_is_pair(spec) && vs_is_identifier(vs_car(spec))) {      /* a macro that expands to a transformer */
    vs_meaning m = vs_environment_find(env, vs_car(spec));
    if (m.kind == VS_MEANS_MACRO && vs_as_macro(m.value)->kind == vs_fix(VS_MACRO_RULES))
      return vs_rules_expand(x, m.value, spec, env, pos, &r[2]) && vs_expand_transformer(x, r[2], r[1], macro, done);
  }
  if (!vs_is_pair(spec) && !vs_is_identifier(spec))
    return vs_expand_fail(x, pos, spec, "a transformer is (syntax-rules ...) or (er-macro-transformer ...), not");
  *done = false;
  if (!vs_intern_c(vm, "%eval-transformer", &r[3]) || !vs_cons(vm, r[1], VS_NIL, &r[2]) ||
      !vs_cons(vm, r[0], r[2], &r[2]))
    return false;
  x->procedure = vs_environment_value(vm->at.core, r[3]);
  x->args = r[2];
  return true;
}

/* Binds the macro of (define-syntax name spec) in env. (define-syntax-rule ...) is a macro of the prelude. Sets *wait
 * to true if a procedure must be called first; its value then replaces spec. */
static bool define_syntax(vs_expansion *x, vs_value form, vs_value env, bool *wait) {
  VS_ROOTS(x->vm, r, 3);
  r[0] = form; r[1] = env;
  *wait = false;
  if (vs_list_length(form) != 3 || !vs_is_identifier(vs_car(vs_cdr(form))))
    return vs_expand_fail(x, vs_form_pos(form, x->now.pos), form, "define-syntax is written %s, not",
                          vs_form_shape(VS_FORM_define_syntax));
  bool done;
  if (!vs_expand_transformer(x, vs_car(vs_cdr(vs_cdr(form))), env, &r[2], &done)) return false;
  if (!done) { *wait = true; return true; }
  return vs_environment_bind(x->vm, r[1], vs_car(vs_cdr(r[0])), r[2]);
}

/* Sets *out to the form (define-syntax name spec) with `value` in the place of spec. */
static bool with_value(vs_scheme *vm, vs_value form, vs_value value, vs_pos pos, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = form;
  return vs_cons(vm, value, VS_NIL, &r[1]) && vs_cons(vm, vs_car(vs_cdr(r[0])), r[1], &r[1]) &&
         vs_cons_at(vm, vs_car(r[0]), r[1], pos, out);
}

/* ---- bodies ---- */
enum { WAIT_HEAD = 0, WAIT_TRANSFORMER = 1 };

static bool keep(vs_expansion *x, vs_value variable, vs_value form, vs_pos pos, vs_value params) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 3);
  r[0] = form; r[1] = params;
  if (!vs_make_vector(vm, 4, VS_FALSE, &r[2])) return false;
  vs_vector *v = vs_as_vector(r[2]);
  v->at[0] = variable;
  vs_gc_store(vm, v, &v->at[1], r[0]);
  v->at[2] = vs_fix((int64_t)pos);
  vs_gc_store(vm, v, &v->at[3], r[1]);
  return vs_cons(vm, r[2], x->now.acc, &x->now.acc);
}

static bool expand_kept(vs_expansion *x, vs_value kept, vs_core_node **into, uint32_t depth) {
  VS_ROOTS(x->vm, r, 2);
  const vs_vector *v = vs_as_vector(kept);
  vs_pos pos = vs_pos_of(v->at[2]);
  if (v->at[3] == VS_ABSENT) {
    vs_value form = v->at[1];
    vs_value name = v->at[0];
    if (!vs_expand_push(x, VS_TASK_EXPR, form, x->now.env, pos, into, depth)) return false;
    vs_expand_top(x)->var = vs_is_fixnum(name) ? (vs_var *)(uintptr_t)vs_fixnum(name) : NULL;
    return true;
  }
  r[0] = kept;
  vs_var *var = (vs_var *)(uintptr_t)vs_fixnum(v->at[0]);
  vs_value name = x->ast.pool[var->name];
  const vs_lambda_form form = {.params = v->at[3], .body = v->at[1], .tail = true, .env = x->now.env, .name = name,
                               .pos = pos};
  return vs_expand_lambda(x, &form, into);
}

static bool finish_body(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  size_t total = 0, defined = 0;                    /* total: number of stored forms of the body; defined: number of
                                                     * stored forms up to the last definition */
  for (vs_value l = x->now.acc; vs_is_pair(l); l = vs_cdr(l)) {
    if (!defined && vs_is_fixnum(vs_as_vector(vs_car(l))->at[0])) defined = 1;
    else if (defined) defined++;
    total++;
  }
  if (defined == total)
    return vs_expand_fail(x, x->now.pos, VS_ABSENT,
                          total ? "this body ends with a definition; an expression must follow, whose value it has"
                                : "this body is empty; an expression is missing");
  VS_ROOTS(vm, r, 1);
  r[0] = x->now.acc;
  size_t rest = total - defined;
  vs_core_node *seq = NULL, *fix = NULL, **into = x->now.into;
  vs_pos pos = x->now.pos;
  if (defined) {
    if (!(fix = vs_expand_many(x, VS_AST_FIX, defined, pos))) return false;
    *into = fix;
    into = &fix->as.let.body;
  }
  if (rest > 1) {
    if (!(seq = vs_expand_many(x, VS_AST_SEQ, rest, pos))) return false;
    *into = seq;
  }
  uint32_t depth = x->now.depth + (fix != NULL) + (seq != NULL);
  bool ok = true;
  for (size_t i = total; ok && i-- > 0; r[0] = vs_cdr(r[0])) {      /* pushes the tasks newest first, so that they run
                                                                     * in the order of the text */
    const vs_vector *v = vs_as_vector(vs_car(r[0]));
    if (i >= defined) {
      ok = expand_kept(x, vs_car(r[0]), seq ? &seq->as.seq.at[i - defined] : into, depth);
      continue;
    }
    vs_var *var = vs_is_fixnum(v->at[0]) ? (vs_var *)(uintptr_t)vs_fixnum(v->at[0]) : NULL;
    if (!var) {                                                     /* an entry without a variable is an expression
                                                                     * between definitions */
      vs_value name;
      ok = vs_intern_c(vm, "_", &name) && (var = vs_ast_var(&x->ast, name)) != NULL;
      if (!ok) break;
    }
    fix->as.let.vars[i] = var;
    ok = expand_kept(x, vs_car(r[0]), &fix->as.let.values[i], depth);
  }
  return ok;
}

/* Inserts the forms of a `begin` before the remaining forms of the body. */
static bool splice(vs_expansion *x, vs_value forms) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 4);
  r[0] = forms; r[1] = VS_NIL;
  if (vs_list_length(forms) < 0)
    return vs_expand_fail(x, x->now.pos, forms, "begin is written %s, not", vs_form_shape(VS_FORM_begin));
  if (vs_cdr(x->now.form) == VS_NIL) { x->now.form = r[0]; return true; }
  r[2] = VS_NIL;
  for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
    if (!vs_cons_at(vm, vs_car(r[0]), VS_NIL, vs_pair_pos(r[0]), &r[3])) return false;
    if (r[1] == VS_NIL) r[1] = r[3];
    else vs_gc_store(vm, vs_as_pair(r[2]), &vs_as_pair(r[2])->cdr, r[3]);
    r[2] = r[3];
  }
  if (r[1] == VS_NIL) { x->now.form = vs_cdr(x->now.form); return true; }
  vs_gc_store(vm, vs_as_pair(r[2]), &vs_as_pair(r[2])->cdr, vs_cdr(x->now.form));
  x->now.form = r[1];
  return true;
}

bool vs_body_step(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 5);
  while (vs_is_pair(x->now.form)) {
    vs_meaning m;
    vs_pos outer = x->now.pos, pos = vs_element_pos(x->now.form, false, outer);
    r[0] = vs_car(x->now.form);
    if (!vs_expand_settle(x, &r[0], &m, &pos)) return false;
    int form = m.kind == VS_MEANS_MACRO ? (int)vs_fixnum(vs_as_macro(m.value)->kind) : -1;
    if (form == VS_FORM_begin) {
      if (!splice(x, vs_cdr(r[0]))) return false;
      continue;
    }
    if (form == VS_FORM_define) {
      bool procedure;
      vs_var *var;
      if (!vs_define_parts(x, r[0], &r[1], &procedure)) return false;
      vs_value known = vs_idtable_get(vs_as_environment(x->now.env)->table, r[1]);
      if (known != VS_VACANT)
        return vs_expand_fail(x, pos, VS_ABSENT, "%s is defined twice in this body",
                              vs_as_symbol(vs_identifier_symbol(r[1]))->name);
      if (!vs_expand_var(x, r[1], x->now.env, &var) || !keep(x, vs_fix((int64_t)(uintptr_t)var), r[3], pos, r[2]))
        return false;
    } else if (form == VS_FORM_define_syntax) {
      bool wait;
      if (!define_syntax(x, r[0], x->now.env, &wait)) return false;
      if (wait) {
        if (!vs_cons(vm, r[0], vs_cdr(x->now.form), &x->now.form)) return false;
        x->now.waiting = true;
        x->now.n = WAIT_TRANSFORMER;
        return false;
      }
    } else if (!keep(x, VS_FALSE, r[0], pos, VS_ABSENT)) return false;
    x->now.pos = outer;
    x->now.form = vs_cdr(x->now.form);
  }
  if (x->now.form != VS_NIL)
    return vs_expand_fail(x, x->now.pos, x->now.form, "a body is a list: remove the . before");
  return finish_body(x);
}

/* Continues a task of a body or of the top level that waited for the result of a call; `value` is this result. */
bool vs_body_resume(vs_expansion *x, vs_value value) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 1);
  r[0] = value;
  bool top = x->now.kind == VS_TASK_TOP, transformer = x->now.n == WAIT_TRANSFORMER;
  x->now.n = WAIT_HEAD;
  vs_value form = top ? x->now.form : vs_car(x->now.form);
  if (transformer && !vs_is(value, VS_T_MACRO))
    return vs_expand_fail(x, vs_form_pos(form, x->now.pos), value,
                          "a transformer is (syntax-rules ...) or (er-macro-transformer ...), this gave");
  if (transformer && !with_value(vm, form, r[0], vs_form_pos(form, x->now.pos), &r[0])) return false;
  if (top) { x->now.form = r[0]; return true; }
  return vs_cons_at(vm, r[0], vs_cdr(x->now.form), vs_form_pos(x->now.form, x->now.pos), &x->now.form);
}

/* ---- the top level ---- */
/* Handles (begin (define name ...) ...) as the result of a macro: binds all names before any form is expanded, so that
 * the first form may refer to the last name. */
static bool bind_renamed(vs_expansion *x, vs_value forms) {
  VS_ROOTS(x->vm, r, 1);
  for (r[0] = forms; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
    vs_value f = vs_car(r[0]), cell;
    if (!vs_is_pair(f) || !vs_is_pair(vs_cdr(f)) || !vs_is_form(x->now.env, vs_car(f), VS_FORM_define)) continue;
    vs_value name = vs_car(vs_cdr(f));
    while (vs_is_pair(name)) name = vs_car(name);
    if (vs_is(name, VS_T_ALIAS) && vs_idtable_get(vs_as_environment(x->now.env)->table, name) == VS_VACANT &&
        !vs_environment_define(x->vm, x->now.env, name, &cell)) return false;
  }
  return true;
}

bool vs_top_step(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 5);
  vs_meaning m;
  vs_pos pos = x->now.pos;
  r[0] = x->now.form;
  if (!vs_expand_settle(x, &r[0], &m, &pos)) return false;
  x->now.form = r[0];
  x->now.pos = pos;
  /* The form is the transformer expression of a macro that is defined in a body. */
  if (!vs_is_top(x->now.env)) return vs_expand_push(x, VS_TASK_EXPR, r[0], x->now.env, pos, x->now.into, 0);
  int form = m.kind == VS_MEANS_MACRO ? (int)vs_fixnum(vs_as_macro(m.value)->kind) : vs_unit_word(&m);
  if (form != VS_FORM_begin && form != VS_FORM_import && form != VS_FORM_define_library &&
      vs_environment_intake(x->now.env) == VS_INTAKE_FRESH)
    vs_environment_set_intake(x->now.env, VS_INTAKE_OPEN);        /* the program does not begin with an import */
  switch (form) {
  case VS_FORM_begin:
    if (vs_list_length(r[0]) < 0) return vs_expand_shape(x, VS_FORM_begin);
    if (!bind_renamed(x, vs_cdr(r[0]))) return false;
    x->forms = vs_cdr(x->now.form);
    x->result = VS_EXPAND_FORMS;
    return true;
  case VS_FORM_define: {
    bool procedure;
    vs_value cell;
    if (!vs_define_parts(x, r[0], &r[1], &procedure)) return false;
    vs_core_node *n = vs_expand_node(x, VS_AST_DEFGLOBAL, pos);
    if (!n || !vs_environment_define(vm, x->now.env, r[1], &cell) || !vs_ast_const(&x->ast, cell, &n->as.global.cell))
      return false;
    *x->now.into = n;
    x->definition = true;
    if (procedure) {
      const vs_lambda_form lambda = {.params = r[2], .body = r[3], .tail = true, .env = x->now.env,
                                     .name = vs_identifier_symbol(r[1]), .pos = pos};
      return vs_expand_lambda(x, &lambda, &n->as.global.value);
    }
    if (!vs_expand_push(x, VS_TASK_EXPR, r[3], x->now.env, pos, &n->as.global.value, 1)) return false;
    /* The variable's name becomes the name of the lambda that is its value. */
    return (vs_expand_top(x)->var = vs_ast_var(&x->ast, vs_identifier_symbol(r[1]))) != NULL;
  }
  case VS_FORM_define_syntax: {
    bool wait;
    if (!define_syntax(x, r[0], x->now.env, &wait)) return false;
    if (wait) { x->now.waiting = true; x->now.n = WAIT_TRANSFORMER; return false; }
    x->result = VS_EXPAND_NOTHING;
    return true;
  }
  case VS_FORM_import: return vs_library_import(x);
  case VS_FORM_define_library: return vs_library_define(x);
  case VS_FORM_require: return vs_library_require(x);
  case VS_FORM_provide: x->result = VS_EXPAND_NOTHING; return true;
  default: return vs_expand_push(x, VS_TASK_EXPR, r[0], x->now.env, pos, x->now.into, 0);
  }
}
