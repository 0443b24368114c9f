/* Expands the binding syntax: let let* letrec letrec* do, named let, let-syntax letrec-syntax. */
#include "vm/front/body.h"
#include "vm/front/derived_syntax.h"
#include "vm/front/expand.h"
#include "vm/front/suggest.h"
#include "vm/front/environment.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"
#include "vm/values/text.h"

/* Reports a binding that lacks the parentheses around all bindings, such as (let (x 5) ...). step: the form is `do`,
 * whose bindings have a third part. Returns false, without an error, if `list` is no such binding. */
static bool fail_bare(vs_expansion *x, vs_value list, vs_pos outer, int form, bool step) {
  int64_t n = vs_list_length(list);
  if ((n != 2 && !(step && n == 3)) || !vs_is_identifier(vs_car(list))) return false;
  const char *name = vs_as_symbol(vs_identifier_symbol(vs_car(list)))->name;
  vs_value form_head = vs_car(x->now.form), second = vs_car(vs_cdr(x->now.form));
  const char *loop =
      form == VS_FORM_let && vs_is_identifier(second) ? vs_as_symbol(vs_identifier_symbol(second))->name : "";
  const char *word = vs_is_identifier(form_head) ? vs_as_symbol(vs_identifier_symbol(form_head))->name : "let";
  vs_text value;
  vs_text_open(x->vm, &value, 60);
  VS_ROOTS(x->vm, r, 2);
  r[0] = vs_car(vs_cdr(list)), r[1] = n == 3 ? vs_car(vs_cdr(vs_cdr(list))) : VS_UNSPECIFIC;
  bool ok = vs_strip(x->vm, r[0], &r[0]) && vs_strip(x->vm, r[1], &r[1]) &&
            vs_print(x->vm, r[0], VS_PRINT_WRITE, &value) &&
            (n < 3 || (vs_text_puts(&value, " ") && vs_print(x->vm, r[1], VS_PRINT_WRITE, &value))) &&
            vs_text_end(&value);
  if (ok)
    vs_expand_fail(x, outer, VS_ABSENT,
                   "put the bindings into parentheses of their own, even a single binding: (%s %s%s%s%s %s%s%s ...)",
                   word, loop, *loop ? " " : "", step ? "((" : "([", name, value.at, value.cut ? " ..." : "",
                   step ? "))" : "])");
  vs_text_close(&value);
  return true;
}

/* Checks bindings of the form ((name value) ...). For a usual mistake, the message shows the correct form. */
static bool check_bindings(vs_expansion *x, vs_value list, vs_pos outer, int form, bool step) {
  const char *name = vs_form_shape(form);
  if (fail_bare(x, list, outer, form, step)) return false;
  if (vs_list_length(list) < 0)
    return vs_expand_fail(x, outer, list, "the bindings are a list: %s%s; not", name,
                          vs_list_length(x->now.form) == 3 ? ", and (set! x 2) changes a value that is there" : "");
  for (vs_value l = list; vs_is_pair(l); l = vs_cdr(l)) {
    vs_value b = vs_car(l);
    vs_pos pos = vs_element_pos(l, false, outer);
    int64_t n = vs_list_length(b);
    if ((n == 2 || (step && n == 3)) && vs_is_identifier(vs_car(b))) continue;
    if (n == 1) return vs_expand_fail(x, pos, b, "this binding has no value: %s; not", name);
    if (n > 2 && vs_is_identifier(vs_car(b)))
      return vs_expand_fail(x, pos, b, "this binding has more than one value: %s; not", name);
    return vs_expand_fail(x, pos, b, "a binding is (name value)%s: %s; not", step ? " or (name start step)" : "", name);
  }
  return true;
}

/* Creates a variable for each name of `list`, stores it in vars, and binds it in the scope. */
static bool bind_names(vs_expansion *x, vs_value list, vs_value scope, vs_var **vars) {
  VS_ROOTS(x->vm, r, 2);
  r[0] = list; r[1] = scope;
  for (size_t i = 0; vs_is_pair(r[0]); r[0] = vs_cdr(r[0]), i++) {
    vs_value id = vs_car(vs_car(r[0]));
    if (vs_idtable_get(vs_as_environment(r[1])->table, id) != VS_VACANT)
      return vs_expand_fail(x, vs_form_pos(vs_car(r[0]), x->now.pos), VS_ABSENT, "%s is bound twice here",
                            vs_as_symbol(vs_identifier_symbol(id))->name);
    if (!vs_expand_var(x, id, r[1], &vars[i])) return false;
  }
  return true;
}

static bool push_values(vs_expansion *x, vs_value list, vs_value env, vs_core_node **values, vs_var **vars,
                        uint32_t depth) {
  bool ok = true;
  for (size_t i = 0; ok && vs_is_pair(list); list = vs_cdr(list), i++) {
    vs_value l = vs_cdr(vs_car(list));
    ok = vs_expand_push(x, VS_TASK_EXPR, vs_car(l), env,
                        vs_element_pos(l, false, vs_form_pos(vs_car(list), x->now.pos)), &values[i], depth);
    if (ok && vars) vs_expand_top(x)->var = vars[i];
  }
  return ok;
}

/* (let name ((v e) ...) body ...) becomes a FIX of name = LAMBDA, with a call of it as its body. */
static bool named_let(vs_expansion *x) {
  VS_ROOTS(x->vm, r, 2);
  vs_value form = x->now.form, id = vs_car(vs_cdr(form)), list = vs_car(vs_cdr(vs_cdr(form)));
  if (!check_bindings(x, list, x->now.pos, VS_FORM_let, false)) return false;
  size_t n = (size_t)vs_list_length(list);
  vs_pos pos = x->now.pos;
  vs_core_node *fix = vs_expand_many(x, VS_AST_FIX, 1, pos), *lambda = vs_expand_many(x, VS_AST_LAMBDA, n, pos),
          *call = vs_expand_many(x, VS_AST_CALL, n, pos);
  if (!fix || !lambda || !call || !vs_expand_scope(x, x->now.env, &r[0]) ||
      !vs_expand_var(x, id, r[0], &fix->as.let.vars[0]) || !vs_expand_scope(x, r[0], &r[1]) ||
      !(call->as.call.callee = vs_ast_local(&x->ast, fix->as.let.vars[0], pos)))
    return false;
  lambda->as.lambda.name = 1 + fix->as.let.vars[0]->name;
  *x->now.into = fix;
  fix->as.let.values[0] = lambda;
  fix->as.let.body = call;
  vs_var **vars = vs_ast_alloc(&x->ast, (n + 1) * sizeof *vars);
  list = vs_car(vs_cdr(vs_cdr(x->now.form)));
  if (!vars || !bind_names(x, list, r[1], vars)) return false;
  for (size_t i = 0; i < n; i++) lambda->as.lambda.params[i].var = vars[i];
  return vs_expand_body(x, vs_cdr(vs_cdr(vs_cdr(x->now.form))), r[1], pos, &lambda->as.lambda.body, 2) &&
         push_values(x, vs_car(vs_cdr(vs_cdr(x->now.form))), x->now.env, call->as.call.at, NULL, x->now.depth + 2);
}

/* Stores the names that this let binds and that have no other binding. If a value of this let refers to one of these
 * names, the error message suggests let*. */
static bool mention_let_star(vs_expansion *x, vs_value list) {
  VS_ROOTS(x->vm, r, 2);
  for (r[0] = list; vs_is_pair(vs_cdr(r[0])); r[0] = vs_cdr(r[0])) {
    r[1] = vs_car(vs_car(r[0]));
    if (!vs_is_symbol(r[1]) || vs_environment_find(x->now.env, r[1]).kind != VS_MEANS_NOTHING) continue;
    if (!vs_suggest_let_star(x->vm, r[1])) return false;
  }
  return true;
}

/* Returns true if evaluating this value of a letrec may create a continuation. A lambda or an expression that contains
 * no call creates none. */
static bool may_return_again(vs_value value) {
  if (!vs_is_pair(value)) return false;
  if (!vs_is_identifier(vs_car(value))) return true;
  const char *name = vs_as_symbol(vs_identifier_symbol(vs_car(value)))->name;
  return strcmp(name, "lambda") && strcmp(name, "case-lambda") && strcmp(name, "quote");
}

static size_t returning_again(vs_value list) {
  size_t n = 0;
  for (; vs_is_pair(list); list = vs_cdr(list)) n += may_return_again(vs_car(vs_cdr(vs_car(list))));
  return n;
}

/* Completes a letrec whose last `again` values may be computed a second time, when a continuation returns to them. The
 * variables of these values are boxes that are set after all the values have been computed: FIX (procedure value) ...
 * (a' value) ... (a a') ... with hidden names a'. */
static bool letrec_apart(vs_expansion *x, vs_core_node *fix, vs_var **vars, size_t again, vs_value env,
                         uint32_t depth) {
  VS_ROOTS(x->vm, r, 2);
  r[0] = vs_car(vs_cdr(x->now.form)); r[1] = env;
  size_t n = (size_t)vs_list_length(r[0]), direct = 0, first = n - again;
  for (size_t i = 0; i < n; i++, r[0] = vs_cdr(r[0])) {
    vs_value l = vs_cdr(vs_car(r[0]));
    vs_pos pos = vs_element_pos(l, false, vs_form_pos(vs_car(r[0]), x->now.pos));
    bool apart = may_return_again(vs_car(l));
    size_t at = apart ? first++ : direct++;
    fix->as.let.vars[at] = vars[i];
    if (apart) {
      vs_var *value = vs_ast_var(&x->ast, x->ast.pool[vars[i]->name]);
      if (!value || !(fix->as.let.values[at + again] = vs_ast_local(&x->ast, value, pos))) return false;
      value->introduced = true;
      fix->as.let.vars[at] = value;
      fix->as.let.vars[at + again] = vars[i];
      vars[i]->given_again = true;
    }
    if (!vs_expand_push(x, VS_TASK_EXPR, vs_car(l), r[1], pos, &fix->as.let.values[at], depth)) return false;
    vs_expand_top(x)->var = fix->as.let.vars[at];
  }
  return true;
}

static bool binding_form(vs_expansion *x, int form, int kind) {
  vs_value l = vs_cdr(x->now.form);
  int64_t parts = vs_list_length(x->now.form);
  if (form == VS_FORM_let && parts > 3 && vs_is_identifier(vs_car(l))) return named_let(x);
  if (parts < 3) {
    if (parts == 2 && vs_is_pair(vs_car(l)))
      return vs_expand_fail(x, x->now.pos, VS_ABSENT, "a body is missing: %s", vs_form_shape(form));
    return vs_expand_shape(x, form);
  }
  vs_pos pos = x->now.pos;
  if (!check_bindings(x, vs_car(l), vs_element_pos(l, false, pos), form, false)) return false;
  size_t n = (size_t)vs_list_length(vs_car(l));
  if (!n) return vs_expand_body(x, vs_cdr(l), x->now.env, pos, x->now.into, x->now.depth);
  VS_ROOTS(x->vm, r, 1);
  size_t again = form == VS_FORM_letrec ? returning_again(vs_car(l)) : 0;
  vs_core_node *node = vs_expand_many(x, kind, n + again, pos);
  vs_var **vars = again ? vs_ast_alloc(&x->ast, n * sizeof *vars) : node ? node->as.let.vars : NULL;
  if (!node || !vars || !vs_expand_scope(x, x->now.env, &r[0]) ||
      !bind_names(x, vs_car(vs_cdr(x->now.form)), r[0], vars))
    return false;
  *x->now.into = node;
  if (kind == VS_AST_LET && n > 1 && !mention_let_star(x, vs_car(vs_cdr(x->now.form)))) return false;
  l = vs_cdr(x->now.form);
  if (!vs_expand_body(x, vs_cdr(l), r[0], pos, &node->as.let.body, x->now.depth + 1)) return false;
  return again ? letrec_apart(x, node, vars, again, r[0], x->now.depth + 1)
               : push_values(x, vs_car(vs_cdr(x->now.form)), kind == VS_AST_LET ? x->now.env : r[0],
                             node->as.let.values, node->as.let.vars, x->now.depth + 1);
}

bool vs_form_let(vs_expansion *x) { return binding_form(x, VS_FORM_let, VS_AST_LET); }
/* Expands a let whose variables may be assigned in their registers, because no continuation that is created in its body
 * is called twice. */
bool vs_form_let_registers(vs_expansion *x) {
  vs_core_node **into = x->now.into;
  if (!binding_form(x, VS_FORM_let_registers, VS_AST_LET)) return false;
  if ((*into)->kind == VS_AST_LET)
    for (uint32_t i = 0; i < (*into)->count; i++) (*into)->as.let.vars[i]->in_register = true;
  return true;
}
bool vs_form_letrec(vs_expansion *x) { return binding_form(x, VS_FORM_letrec, VS_AST_FIX); }
bool vs_form_letrec_star(vs_expansion *x) { return binding_form(x, VS_FORM_letrec_star, VS_AST_FIX); }

/* Expands let*: binds the first variable; the body is a let* of the other variables. */
bool vs_form_let_star(vs_expansion *x) {
  if (!x->now.chained && vs_list_length(x->now.form) < 3) return vs_expand_shape(x, VS_FORM_let_star);
  vs_value l = vs_cdr(x->now.form);
  vs_pos pos = x->now.pos;
  if (!x->now.chained && !check_bindings(x, vs_car(l), vs_element_pos(l, false, pos), VS_FORM_let_star, false))
    return false;
  vs_value list = vs_car(l);
  if (list == VS_NIL) return vs_expand_body(x, vs_cdr(l), x->now.env, pos, x->now.into, x->now.depth);
  VS_ROOTS(x->vm, r, 3);
  vs_core_node *node = vs_expand_many(x, VS_AST_LET, 1, pos);
  if (!node || !vs_expand_scope(x, x->now.env, &r[0])) return false;
  *x->now.into = node;
  r[1] = vs_car(vs_car(vs_car(vs_cdr(x->now.form))));
  if (!vs_expand_var(x, r[1], r[0], &node->as.let.vars[0])) return false;
  l = vs_cdr(x->now.form);
  bool last = vs_cdr(vs_car(l)) == VS_NIL;
  if (last) {
    if (!vs_expand_body(x, vs_cdr(l), r[0], pos, &node->as.let.body, x->now.depth + 1)) return false;
  } else {
    if (!vs_cons_at(x->vm, vs_cdr(vs_car(l)), vs_cdr(l), vs_pair_pos(l), &r[2]) ||
        !vs_cons_at(x->vm, vs_car(x->now.form), r[2], pos, &r[2]) ||
        !vs_expand_push(x, VS_TASK_EXPR, r[2], r[0], pos, &node->as.let.body, x->now.depth + 1))
      return false;
    vs_expand_top(x)->chained = true;
  }
  vs_value first = vs_car(vs_car(vs_cdr(x->now.form))), v = vs_cdr(first);
  if (!vs_expand_push(x, VS_TASK_EXPR, vs_car(v), x->now.env, vs_element_pos(v, false, vs_form_pos(first, pos)),
                      &node->as.let.values[0], x->now.depth + 1))
    return false;
  vs_expand_top(x)->var = node->as.let.vars[0];
  return true;
}

/* (do ((v start step) ...) (test result ...) body ...) becomes a FIX of loop = LAMBDA with the body IF test result (SEQ
 * body ... (loop step ...)). */
bool vs_form_do(vs_expansion *x) {
  if (vs_list_length(x->now.form) < 3) return vs_expand_shape(x, VS_FORM_do);
  vs_value l = vs_cdr(x->now.form), list = vs_car(l), end = vs_car(vs_cdr(l)), body = vs_cdr(vs_cdr(l)), name;
  vs_pos pos = x->now.pos;
  if (!check_bindings(x, list, vs_element_pos(l, false, pos), VS_FORM_do, true)) return false;
  int64_t results = vs_list_length(end);
  if (results < 1)
    return vs_expand_fail(x, vs_element_pos(vs_cdr(l), false, pos), end, "the end of do is (test result ...), not");
  size_t n = (size_t)vs_list_length(list), steps = (size_t)vs_list_length(body);
  vs_core_node *fix = vs_expand_many(x, VS_AST_FIX, 1, pos), *lambda = vs_expand_many(x, VS_AST_LAMBDA, n, pos),
          *call = vs_expand_many(x, VS_AST_CALL, n, pos), *again = vs_expand_many(x, VS_AST_CALL, n, pos),
          *seq = vs_expand_many(x, VS_AST_SEQ, steps + 1, pos), *test = vs_expand_node(x, VS_AST_IF, pos);
  vs_var **vars = vs_ast_alloc(&x->ast, (n + 1) * sizeof *vars);
  VS_ROOTS(x->vm, r, 1);
  if (!fix || !lambda || !call || !again || !seq || !test || !vars || !vs_intern_c(x->vm, "do", &name) ||
      !(fix->as.let.vars[0] = vs_ast_var(&x->ast, name)) ||
      !(call->as.call.callee = vs_ast_local(&x->ast, fix->as.let.vars[0], pos)) ||
      !(again->as.call.callee = vs_ast_local(&x->ast, fix->as.let.vars[0], pos)) ||
      !vs_expand_scope(x, x->now.env, &r[0]) || !bind_names(x, vs_car(vs_cdr(x->now.form)), r[0], vars))
    return false;
  *x->now.into = fix;
  fix->as.let.values[0] = lambda;
  fix->as.let.body = call;
  lambda->as.lambda.name = 1 + fix->as.let.vars[0]->name;
  for (size_t i = 0; i < n; i++) lambda->as.lambda.params[i].var = vars[i];
  lambda->as.lambda.body = test;
  test->as.branch.otherwise = steps ? seq : again;
  if (steps) seq->as.seq.at[steps] = again;
  l = vs_cdr(x->now.form);
  list = vs_car(l);
  bool ok = true;
  for (size_t i = 0; ok && i < n; i++, list = vs_cdr(list)) {
    vs_value s = vs_cdr(vs_cdr(vs_car(list)));
    vs_pos place = vs_form_pos(vs_car(list), pos);
    if (vs_is_pair(s))
      ok = vs_expand_push(x, VS_TASK_EXPR, vs_car(s), r[0], vs_element_pos(s, false, place), &again->as.call.at[i], 4);
    else ok = (again->as.call.at[i] = vs_ast_local(&x->ast, vars[i], place)) != NULL;
  }
  end = vs_car(vs_cdr(l));
  if (results == 1) ok = ok && (test->as.branch.then = vs_expand_many(x, VS_AST_SEQ, 0, pos)) != NULL;
  else {
    vs_core_node *result = vs_expand_many(x, VS_AST_SEQ, (size_t)results - 1, pos);
    if (!result) return false;
    test->as.branch.then = result;
    ok = ok && vs_expand_list(x, vs_cdr(end), r[0], result->as.seq.at, 3);
  }
  ok = ok && vs_expand_list(x, vs_cdr(vs_cdr(l)), r[0], seq->as.seq.at, 4) &&
       vs_expand_push(x, VS_TASK_EXPR, vs_car(end), r[0], vs_element_pos(end, true, pos), &test->as.branch.test, 3);
  if (!ok) return false;
  vs_expand_top(x)->test = vs_expand_top(x)->decides = true;
  return push_values(x, vs_car(vs_cdr(x->now.form)), x->now.env, call->as.call.at, NULL, x->now.depth + 2);
}

/* Binds the macros of let-syntax or letrec-syntax in a new scope. If all transformers are syntax-rules, they are bound
 * directly. Otherwise they become define-syntax forms at the start of a body, which can wait for the transformers'
 * values. */
static bool syntax_binding(vs_expansion *x, bool recursive, int form) {
  vs_scheme *vm = x->vm;
  if (vs_list_length(x->now.form) < 3) return vs_expand_shape(x, form);
  if (!check_bindings(x, vs_car(vs_cdr(x->now.form)), x->now.pos, form, false)) return false;
  VS_ROOTS(vm, r, 5);
  if (!vs_expand_scope(x, x->now.env, &r[0])) return false;
  r[3] = VS_NIL;
  for (r[1] = vs_car(vs_cdr(x->now.form)); vs_is_pair(r[1]); r[1] = vs_cdr(r[1])) {
    vs_value b = vs_car(r[1]);
    bool done;
    if (!vs_expand_transformer(x, vs_car(vs_cdr(b)), recursive ? r[0] : x->now.env, &r[2], &done)) return false;
    if (done) { if (!vs_environment_bind(vm, r[0], vs_car(vs_car(r[1])), r[2])) return false; continue; }
    if (!vs_core_name(vm, "define-syntax", &r[2]) ||
        !vs_cons_at(vm, r[2], vs_car(r[1]), vs_form_pos(vs_car(r[1]), x->now.pos), &r[2]) ||
        !vs_cons(vm, r[2], r[3], &r[3]))
      return false;
  }
  r[4] = vs_cdr(vs_cdr(x->now.form));
  for (; vs_is_pair(r[3]); r[3] = vs_cdr(r[3]))
    if (!vs_cons(vm, vs_car(r[3]), r[4], &r[4])) return false;
  return vs_expand_body(x, r[4], r[0], x->now.pos, x->now.into, x->now.depth);
}
bool vs_form_let_syntax(vs_expansion *x) { return syntax_binding(x, false, VS_FORM_let_syntax); }
bool vs_form_letrec_syntax(vs_expansion *x) { return syntax_binding(x, true, VS_FORM_letrec_syntax); }
