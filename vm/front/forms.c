/* Expands the syntax of choice and sequence: quote if begin cond case and or when unless assert, quasiquote. */
#include "vm/front/forms.h"

#include "vm/front/expand.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"

static vs_core_node *put(vs_expansion *x, vs_core_node *n) { return *x->now.into = n; }
static vs_core_node *unspecific(vs_expansion *x, vs_pos pos) { return vs_expand_many(x, VS_AST_SEQ, 0, pos); }

bool vs_form_quote(vs_expansion *x) {
  if (vs_list_length(x->now.form) != 2) return vs_expand_shape(x, VS_FORM_quote);
  VS_ROOTS(x->vm, r, 1);
  return vs_strip(x->vm, vs_car(vs_cdr(x->now.form)), &r[0]) &&
         put(x, vs_ast_constant(&x->ast, r[0], x->now.pos)) != NULL;
}

static vs_core_node *branch(vs_expansion *x) { return put(x, vs_expand_node(x, VS_AST_IF, x->now.pos)); }

bool vs_form_if(vs_expansion *x) {
  int64_t n = vs_list_length(x->now.form);
  if (n != 3 && n != 4) return vs_expand_shape(x, VS_FORM_if);
  vs_core_node *node = branch(x);
  bool test = x->now.test;
  if (!node) return false;
  if (n == 4) {
    if (!vs_expand_nth(x, 3, x->now.env, &node->as.branch.otherwise)) return false;
    vs_expand_top(x)->test = test;
  }
  if (!vs_expand_nth(x, 2, x->now.env, &node->as.branch.then)) return false;
  vs_expand_top(x)->test = test;
  if (!vs_expand_nth(x, 1, x->now.env, &node->as.branch.test)) return false;
  vs_expand_top(x)->test = vs_expand_top(x)->decides = true;
  return true;
}

/* Expands expressions in sequence. The last expression gets the place of the whole form. */
static bool sequence(vs_expansion *x, vs_value forms, vs_pos pos, vs_core_node **into, uint32_t depth) {
  int64_t n = vs_list_length(forms);
  if (n == 1)
    return vs_expand_push(x, VS_TASK_EXPR, vs_car(forms), x->now.env, vs_element_pos(forms, false, pos), into, depth);
  vs_core_node *seq = vs_expand_many(x, VS_AST_SEQ, n > 0 ? (size_t)n : 0, pos);
  if (!seq) return false;
  *into = seq;
  return vs_expand_list(x, forms, x->now.env, seq->as.seq.at, depth + 1);
}

/* Expands the values of a clause of cond or case: a body, which may begin with definitions. */
static bool clause_values(vs_expansion *x, vs_value forms, vs_pos pos, vs_core_node **into, uint32_t depth) {
  return vs_is_pair(forms) ? vs_expand_body(x, forms, x->now.env, pos, into, depth)
                           : sequence(x, forms, pos, into, depth);
}

bool vs_form_begin(vs_expansion *x) {
  if (vs_list_length(x->now.form) < 1) return vs_expand_shape(x, VS_FORM_begin);
  return sequence(x, vs_cdr(x->now.form), x->now.pos, x->now.into, x->now.depth);
}

/* Expands the parts in `rest` of the current form and, or or cond as a form of the same kind. */
static bool chain(vs_expansion *x, vs_value rest, vs_core_node **into, bool test) {
  VS_ROOTS(x->vm, r, 1);
  vs_pos pos = vs_is_pair(rest) ? vs_element_pos(rest, false, x->now.pos) : x->now.pos;
  if (!vs_cons_at(x->vm, vs_car(x->now.form), rest, pos, &r[0]) ||
      !vs_expand_push(x, VS_TASK_EXPR, r[0], x->now.env, pos, into, x->now.depth + 1)) return false;
  vs_expand_top(x)->test = test;
  vs_expand_top(x)->chained = true;
  return true;
}

/* Returns the length of the current form, or -1 if it is no list. If the form consists of the last parts of a checked
 * and, or, cond, counts at most 4 elements: counting all elements at each part would make long forms slow. */
static int64_t parts(const vs_expansion *x) {
  if (!x->now.chained) return vs_list_length(x->now.form);
  int64_t n = 0;
  for (vs_value l = x->now.form; n < 4 && vs_is_pair(l); l = vs_cdr(l)) n++;
  return n;
}

bool vs_form_and(vs_expansion *x) {
  int64_t n = parts(x);
  if (n < 1) return vs_expand_shape(x, VS_FORM_and);
  if (n == 1) return put(x, vs_ast_constant(&x->ast, VS_TRUE, x->now.pos)) != NULL;
  if (n == 2) {
    if (!vs_expand_nth(x, 1, x->now.env, x->now.into)) return false;
    vs_expand_top(x)->test = x->now.test;
    return true;
  }
  vs_core_node *node = branch(x);
  if (!node || !(node->as.branch.otherwise = vs_ast_constant(&x->ast, VS_FALSE, x->now.pos))) return false;
  if (!chain(x, vs_cdr(vs_cdr(x->now.form)), &node->as.branch.then, x->now.test)) return false;
  if (!vs_expand_nth(x, 1, x->now.env, &node->as.branch.test)) return false;
  vs_expand_top(x)->test = vs_expand_top(x)->decides = true;
  return true;
}

/* Returns a LET with one variable that programs cannot name. The caller pushes the task for the variable's value. */
static vs_core_node *let_temporary(vs_expansion *x, const char *name, vs_pos pos) {
  vs_value symbol;
  vs_core_node *let = vs_expand_many(x, VS_AST_LET, 1, pos);
  if (!let || !vs_intern_c(x->vm, name, &symbol) || !(let->as.let.vars[0] = vs_ast_var(&x->ast, symbol))) return NULL;
  return let;
}

bool vs_form_or(vs_expansion *x) {
  int64_t n = parts(x);
  if (n < 1) return vs_expand_shape(x, VS_FORM_or);
  if (n == 1) return put(x, vs_ast_constant(&x->ast, VS_FALSE, x->now.pos)) != NULL;
  if (n == 2) {
    if (!vs_expand_nth(x, 1, x->now.env, x->now.into)) return false;
    vs_expand_top(x)->test = x->now.test;
    return true;
  }
  vs_core_node *let = NULL, *node = vs_expand_node(x, VS_AST_IF, x->now.pos);
  if (!node) return false;
  bool test = x->now.test;
  if (test) {
    put(x, node);
    node->as.branch.then = vs_ast_constant(&x->ast, VS_TRUE, x->now.pos);
  } else {
    if (!(let = let_temporary(x, "or", x->now.pos))) return false;
    put(x, let);
    let->as.let.body = node;
    node->as.branch.test = vs_ast_local(&x->ast, let->as.let.vars[0], x->now.pos);
    node->as.branch.then = vs_ast_local(&x->ast, let->as.let.vars[0], x->now.pos);
    if (!node->as.branch.test) return false;
  }
  if (!node->as.branch.then || !chain(x, vs_cdr(vs_cdr(x->now.form)), &node->as.branch.otherwise, test)) return false;
  if (!vs_expand_nth(x, 1, x->now.env, test ? &node->as.branch.test : &let->as.let.values[0])) return false;
  vs_expand_top(x)->test = test;
  vs_expand_top(x)->decides = true;
  return true;
}

static bool when_unless(vs_expansion *x, bool when, int form) {
  if (vs_list_length(x->now.form) < 3) return vs_expand_shape(x, form);
  vs_core_node *node = branch(x), *nothing = when ? NULL : unspecific(x, x->now.pos);
  if (!node || (!when && !nothing)) return false;
  if (!when) node->as.branch.then = nothing;
  /* The body of when and unless may contain definitions. */
  if (!vs_expand_body(x, vs_cdr(vs_cdr(x->now.form)), x->now.env, x->now.pos,
                      when ? &node->as.branch.then : &node->as.branch.otherwise, x->now.depth + 1))
    return false;
  if (!vs_expand_nth(x, 1, x->now.env, &node->as.branch.test)) return false;
  vs_expand_top(x)->test = vs_expand_top(x)->decides = true;
  return true;
}
bool vs_form_when(vs_expansion *x) { return when_unless(x, true, VS_FORM_when); }
bool vs_form_unless(vs_expansion *x) { return when_unless(x, false, VS_FORM_unless); }

/* Expands (assert test detail ...). The error message shows the values of the details. */
bool vs_form_assert(vs_expansion *x) {
  int64_t n = vs_list_length(x->now.form);
  if (n < 2) return vs_expand_shape(x, VS_FORM_assert);
  VS_ROOTS(x->vm, r, 1);
  vs_core_node *node = branch(x), *nothing = unspecific(x, x->now.pos);
  vs_core_node *fail = vs_expand_call(x, "%assertion-failed", (size_t)n - 1, x->now.pos);
  if (!node || !fail || !nothing || !vs_strip(x->vm, vs_car(vs_cdr(x->now.form)), &r[0]) ||
      !(fail->as.call.at[0] = vs_ast_constant(&x->ast, r[0], x->now.pos))) return false;
  node->as.branch.then = nothing;
  node->as.branch.otherwise = fail;
  if (n > 2 && !vs_expand_list(x, vs_cdr(vs_cdr(x->now.form)), x->now.env, fail->as.call.at + 1, x->now.depth + 2))
    return false;
  if (!vs_expand_nth(x, 1, x->now.env, &node->as.branch.test)) return false;
  vs_expand_top(x)->test = vs_expand_top(x)->decides = true;
  return true;
}

/* ---- cond ---- */
bool vs_form_cond(vs_expansion *x) {
  vs_value clauses = vs_cdr(x->now.form);
  if (parts(x) < 1) return vs_expand_shape(x, VS_FORM_cond);
  if (clauses == VS_NIL) return put(x, unspecific(x, x->now.pos)) != NULL;
  vs_value clause = vs_car(clauses), more = vs_cdr(clauses), env = x->now.env;
  vs_pos pos = vs_element_pos(clauses, false, x->now.pos), outer = x->now.pos;
  int64_t n = vs_list_length(clause);
  if (n < 1)
    return vs_expand_fail(x, pos, clause,
                          "a clause of cond is (test value ...), as in (cond [(> x 3) 1] [else 2]), not");
  /* A clause lacks its inner parentheses, as in (cond (> x 3) 'big ...). */
  if (n > 1 && vs_is_identifier(vs_car(clause)) && vs_is_form(env, vs_car(clause), VS_FORM_quote))
    return vs_expand_fail(x, pos, VS_ABSENT, "a clause of cond is in parentheses with its test: ((> x 3) 'big)");
  if (vs_is_form(env, vs_car(clause), VS_FORM_else)) {
    if (more != VS_NIL) return vs_expand_fail(x, pos, VS_ABSENT, "else must be the last clause of cond");
    if (n == 1) return vs_expand_fail(x, pos, VS_ABSENT, "an expression is missing in this else");
    return clause_values(x, vs_cdr(clause), pos, x->now.into, x->now.depth);
  }
  vs_core_node *node = vs_expand_node(x, VS_AST_IF, pos), *let = NULL;
  if (!node) return false;
  bool arrow = n > 1 && vs_is_form(env, vs_car(vs_cdr(clause)), VS_FORM_arrow);
  if (arrow && n != 3) return vs_expand_fail(x, pos, clause, "one procedure follows =>:");
  vs_core_node **test = &node->as.branch.test;
  if (arrow || n == 1) {
    if (!(let = let_temporary(x, "cond", pos)) || !(*test = vs_ast_local(&x->ast, let->as.let.vars[0], pos)))
      return false;
    let->as.let.body = node;
    test = &let->as.let.values[0];
  }
  put(x, let ? let : node);
  VS_ROOTS(x->vm, r, 1);
  r[0] = clause;
  if (more != VS_NIL && !chain(x, more, &node->as.branch.otherwise, x->now.test)) return false;
  if (arrow) {
    vs_core_node *call = vs_expand_many(x, VS_AST_CALL, 1, pos);
    if (!call || !(call->as.call.at[0] = vs_ast_local(&x->ast, let->as.let.vars[0], pos))) return false;
    node->as.branch.then = call;
    vs_value l = vs_cdr(vs_cdr(r[0]));
    if (!vs_expand_push(x, VS_TASK_EXPR, vs_car(l), x->now.env, vs_element_pos(l, false, pos), &call->as.call.callee,
                        x->now.depth + 2))
      return false;
  } else if (n == 1) {
    if (!(node->as.branch.then = vs_ast_local(&x->ast, let->as.let.vars[0], pos))) return false;
  } else if (!clause_values(x, vs_cdr(r[0]), pos, &node->as.branch.then, x->now.depth + 1)) return false;
  if (!vs_expand_push(x, VS_TASK_EXPR, vs_car(r[0]), x->now.env, vs_element_pos(r[0], true, outer), test,
                      x->now.depth + 1))
    return false;
  vs_expand_top(x)->test = !let;
  vs_expand_top(x)->decides = true;
  return true;
}

/* ---- case ---- */
bool vs_form_case(vs_expansion *x) {
  int64_t n = vs_list_length(x->now.form);
  if (n < 2) return vs_expand_shape(x, VS_FORM_case);
  vs_core_node *let = let_temporary(x, "key", x->now.pos);
  if (!let) return false;
  put(x, let);
  if (!vs_expand_push(x, VS_TASK_CASE, vs_cdr(vs_cdr(x->now.form)), x->now.env, x->now.pos, &let->as.let.body,
                      x->now.depth + 1))
    return false;
  vs_expand_top(x)->var = let->as.let.vars[0];
  return vs_expand_nth(x, 1, x->now.env, &let->as.let.values[0]);
}

/* Returns a node that tests whether the key of a case equals one of the data of a clause: (or (eqv? key 'd) ...), with
 * eq? where it is equivalent. More than six data are searched by memv. */
static vs_core_node *key_test(vs_expansion *x, vs_value data, vs_pos pos) {
  VS_ROOTS(x->vm, r, 2);
  int64_t n = vs_list_length(data);
  if (n == 0) return vs_ast_constant(&x->ast, VS_FALSE, pos);
  if (!vs_strip(x->vm, data, &r[0])) return NULL;
  if (n > 6) {
    vs_core_node *call = vs_expand_call(x, "memv", 2, pos);
    return call && (call->as.call.at[0] = vs_ast_local(&x->ast, x->now.var, pos)) &&
                   (call->as.call.at[1] = vs_ast_constant(&x->ast, r[0], pos))
               ? call
               : NULL;
  }
  vs_core_node *first = NULL, **into = &first;
  for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
    vs_value d = vs_car(r[0]);
    bool same = !vs_is_double(d) && (!vs_is_object(d) || vs_is_symbol(d));
    vs_core_node *call = vs_expand_call(x, same ? "eq?" : "eqv?", 2, pos);
    if (!call || !(call->as.call.at[0] = vs_ast_local(&x->ast, x->now.var, pos)) ||
        !(call->as.call.at[1] = vs_ast_constant(&x->ast, vs_car(r[0]), pos)))
      return NULL;
    if (vs_cdr(r[0]) == VS_NIL) { *into = call; break; }
    vs_core_node *node = vs_expand_node(x, VS_AST_IF, pos);
    if (!node || !(node->as.branch.then = vs_ast_constant(&x->ast, VS_TRUE, pos))) return NULL;
    node->as.branch.test = call;
    *into = node;
    into = &node->as.branch.otherwise;
  }
  return first;
}

bool vs_case_step(vs_expansion *x) {
  if (!vs_expand_outline(x)) return false;
  vs_value clauses = x->now.form;
  if (clauses == VS_NIL) return put(x, unspecific(x, x->now.pos)) != NULL;
  vs_value clause = vs_car(clauses), more = vs_cdr(clauses);
  vs_pos pos = vs_element_pos(clauses, false, x->now.pos);
  int64_t n = vs_list_length(clause);
  bool last = n > 0 && vs_is_form(x->now.env, vs_car(clause), VS_FORM_else);
  if (n < 2 || (!last && vs_list_length(vs_car(clause)) < 0))
    return vs_expand_fail(x, pos, clause, "a clause of case is ((datum ...) value ...), not");
  if (last && more != VS_NIL) return vs_expand_fail(x, pos, VS_ABSENT, "else must be the last clause of case");
  vs_core_node **value = x->now.into;
  uint32_t depth = x->now.depth;
  VS_ROOTS(x->vm, r, 1);
  r[0] = clause;
  if (!last) {
    vs_core_node *node = vs_expand_node(x, VS_AST_IF, pos);
    if (!node || !(node->as.branch.test = key_test(x, vs_car(clause), pos))) return false;
    put(x, node);
    if (!vs_expand_push(x, VS_TASK_CASE, vs_cdr(x->now.form), x->now.env, x->now.pos, &node->as.branch.otherwise,
                        depth + 1))
      return false;
    vs_expand_top(x)->var = x->now.var;
    value = &node->as.branch.then;
    depth++;
  }
  vs_value body = vs_cdr(r[0]);
  if (!vs_is_form(x->now.env, vs_car(body), VS_FORM_arrow)) return clause_values(x, body, pos, value, depth);
  if (n != 3) return vs_expand_fail(x, pos, r[0], "one procedure follows =>:");
  vs_core_node *call = vs_expand_many(x, VS_AST_CALL, 1, pos);
  if (!call || !(call->as.call.at[0] = vs_ast_local(&x->ast, x->now.var, pos))) return false;
  *value = call;
  body = vs_cdr(vs_cdr(r[0]));
  return vs_expand_push(x, VS_TASK_EXPR, vs_car(body), x->now.env, vs_element_pos(body, false, pos),
                        &call->as.call.callee, depth + 1);
}

/* ---- quasiquote: one task for each list, which processes all its elements ---- */
static vs_datum_test is_comma(vs_scheme *vm, vs_value v) {
  if (!vs_is_identifier(v)) return VS_DATUM_NO;
  v = vs_identifier_symbol(v);
  return v == vm->sym.unquote || v == vm->sym.unquote_splicing ? VS_DATUM_YES : VS_DATUM_NO;
}

enum { RUN = 64 };   /* greatest number of elements in one call of list */

bool vs_form_quasiquote(vs_expansion *x) {
  bool comma;
  if (vs_list_length(x->now.form) != 2) return vs_expand_shape(x, VS_FORM_quasiquote);
  if (!vs_datum_any(x->vm, vs_car(vs_cdr(x->now.form)), is_comma, &comma)) return false;
  if (!comma) return vs_form_quote(x);
  vs_value l = vs_cdr(x->now.form);
  if (!vs_expand_push(x, VS_TASK_QUASI, vs_car(l), x->now.env, vs_element_pos(l, false, x->now.pos), x->now.into,
                      x->now.depth))
    return false;
  vs_expand_top(x)->n = 1;
  return true;
}

/* Returns the quasiquote form that v is, such as VS_FORM_unquote for (unquote e). Returns -1 for other values. */
static int quasi_kind(vs_value env, vs_value v) {
  if (!vs_is_pair(v) || !vs_is_pair(vs_cdr(v)) || vs_cdr(vs_cdr(v)) != VS_NIL || !vs_is_identifier(vs_car(v)))
    return -1;
  vs_meaning m = vs_environment_find(env, vs_car(v));
  if (m.kind != VS_MEANS_MACRO) return -1;
  int64_t k = vs_fixnum(vs_as_macro(m.value)->kind);
  return k == VS_FORM_quasiquote || k == VS_FORM_unquote || k == VS_FORM_unquote_splicing ? (int)k : -1;
}

static bool push_quasi(vs_expansion *x, vs_value form, vs_pos pos, vs_core_node **into, uint32_t level) {
  if (!vs_expand_push(x, VS_TASK_QUASI, form, x->now.env, pos, into, x->now.depth + 1)) return false;
  vs_expand_top(x)->n = level;
  return true;
}

bool vs_quasi_step(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  vs_value form = x->now.form;
  uint32_t level = x->now.n;
  vs_pos pos = vs_form_pos(form, x->now.pos);
  VS_ROOTS(vm, r, 3);
  if (vs_is_vector(form)) {
    vs_core_node *call = vs_expand_call(x, "list->vector", 1, pos);
    if (!call) return false;
    r[0] = VS_NIL;
    for (size_t i = vs_as_vector(x->now.form)->length; i-- > 0;)
      if (!vs_cons(vm, vs_as_vector(x->now.form)->at[i], r[0], &r[0])) return false;
    put(x, call);
    return push_quasi(x, r[0], pos, &call->as.call.at[0], level);
  }
  if (!vs_is_pair(form)) return vs_strip(vm, form, &r[0]) && put(x, vs_ast_constant(&x->ast, r[0], pos)) != NULL;
  if (!vs_expand_outline(x)) return false;
  form = x->now.form;
  int kind = quasi_kind(x->now.env, form);
  if (kind == VS_FORM_unquote && level == 1) {
    vs_value l = vs_cdr(form);
    return vs_expand_push(x, VS_TASK_EXPR, vs_car(l), x->now.env, vs_element_pos(l, false, pos), x->now.into,
                          x->now.depth);
  }
  /* in ``(a ,,@l), the inner list is an ordinary list */
  bool spliced = kind >= 0 && level == 2 && quasi_kind(x->now.env, vs_car(vs_cdr(form))) == VS_FORM_unquote_splicing;
  if (kind >= 0 && !(spliced && kind != VS_FORM_quasiquote)) {
    if (kind == VS_FORM_unquote_splicing && level == 1)
      return vs_expand_fail(x, pos, VS_ABSENT, ",@ belongs inside a list");
    vs_core_node *call = vs_expand_call(x, "list", 2, pos);
    if (!call) return false;
    put(x, call);
    r[0] = vs_identifier_symbol(vs_car(x->now.form));
    if (!(call->as.call.at[0] = vs_ast_constant(&x->ast, r[0], pos))) return false;
    vs_value l = vs_cdr(x->now.form);
    return push_quasi(x, vs_car(l), vs_element_pos(l, false, pos), &call->as.call.at[1],
                      kind == VS_FORM_quasiquote ? level + 1 : level - 1);
  }
  level -= kind >= 0;
  /* Counts three things: the elements of the list, the elements that insert a list (unquote-splicing), and the
   * sequences of other elements between them. */
  size_t elements = 0, splices = 0, runs = 0;
  size_t in_run = 0;
  vs_value l = form, met = VS_NIL; /* Brent's cycle detection: `met` is an earlier pair; each time the distance to it
                                    * has doubled, `met` becomes l */
  for (; vs_is_pair(l) && (l == form || quasi_kind(x->now.env, l) < 0); l = vs_cdr(l)) {
    if (l == met) return vs_expand_fail(x, pos, VS_ABSENT, "a list without an end (#0#) cannot contain , or ,@");
    if ((elements & (elements - 1)) == 0) met = l;
    bool splice = level == 1 && quasi_kind(x->now.env, vs_car(l)) == VS_FORM_unquote_splicing;
    if (splice) { splices++; in_run = 0; }
    else { runs += in_run == 0; in_run = in_run + 1 == RUN ? 0 : in_run + 1; }
    elements++;
  }
  bool tail = l != VS_NIL;
  vs_core_node *outer = NULL;
  if (splices || tail || runs > 1) {
    if (!(outer = vs_expand_call(x, "append", splices + runs + tail, pos))) return false;
    put(x, outer);
  }
  vs_core_node *run = NULL;
  size_t segment = 0, inside = 0;
  r[0] = x->now.form;
  for (size_t i = 0; i < elements; i++, r[0] = vs_cdr(r[0])) {
    vs_value e = vs_car(r[0]);
    vs_pos place = vs_element_pos(r[0], i == 0, pos);
    if (level == 1 && quasi_kind(x->now.env, e) == VS_FORM_unquote_splicing) {
      run = NULL;
      vs_value s = vs_cdr(e);
      if (!vs_expand_push(x, VS_TASK_EXPR, vs_car(s), x->now.env, vs_element_pos(s, false, place),
                          &outer->as.call.at[segment++], x->now.depth + 2))
        return false;
      continue;
    }
    if (!run) {
      size_t length = 0;
      for (vs_value k = r[0]; length < elements - i && length < RUN; k = vs_cdr(k), length++)
        if (level == 1 && quasi_kind(x->now.env, vs_car(k)) == VS_FORM_unquote_splicing) break;
      if (!(run = vs_expand_call(x, "list", length, pos))) return false;
      inside = 0;
      if (outer) outer->as.call.at[segment++] = run;
      else put(x, run);
    }
    if (!push_quasi(x, vs_car(r[0]), place, &run->as.call.at[inside++], level)) return false;
    if (inside == RUN) run = NULL;
  }
  return !tail || push_quasi(x, r[0], pos, &outer->as.call.at[segment], level);
}
