/* Expands parameter lists: lambda, case-lambda and the procedures of define; contracts, optional and keyword
 * parameters.
 *
 * A parameter has one of the forms
 *   name   [name predicate]   [name predicate default]
 * After #:key, each of these forms is a keyword parameter. The rest parameter is . name or . [name predicate].
 *
 * A predicate is evaluated once, outside the lambda: in a LET around it, unless it is a constant of the library. The
 * checks of the arguments are a SEQ before the body, one CHECK for each parameter, in order. A computed default value
 * may use the parameters before it, so these are checked before it is computed. */
#include "vm/front/lambda.h"

#include "vm/front/expand.h"
#include "vm/machine/fail.h"

typedef struct {
  vs_value id, predicate, fallback;     /* name, predicate and default as forms of the source; an absent form is
                                         * VS_ABSENT */
  vs_pos pos;
  vs_var *var, *contract;               /* var: the parameter's variable; contract: variable of the LET for the
                                         * predicate, or NULL if the predicate is a constant */
  uint32_t keyword;                     /* 0, or 1 + constant index of the keyword (vs_param.keyword) */
} parameter;

/* The parameters of a lambda that is being built. Their values are reachable by the garbage collector through the
 * parameter list. */
typedef struct {
  vs_scheme *vm;
  parameter *at;
  size_t count, room;
  vs_value *values;
  struct vs_roots roots;
  bool rest, tail;
} parameters;

static bool is_keyword(vs_value v) {
  return vs_is_symbol(v) && vs_as_symbol(v)->length > 2 && !memcmp(vs_as_symbol(v)->name, "#:", 2);
}

static bool add(parameters *p, vs_value id, vs_value predicate, vs_value fallback, vs_pos pos, uint32_t keyword) {
  if (p->count == p->room) {
    size_t room = p->room ? 2 * p->room : 8;
    parameter *at = vs_mem(p->vm, p->at, p->room * sizeof *at, room * sizeof *at);
    if (!at) return false;
    p->at = at;
    p->room = room;
  }
  p->at[p->count++] = (parameter){id, predicate, fallback, pos, NULL, NULL, keyword};
  return true;
}

static bool specification(vs_expansion *x, parameters *p, vs_value spec, vs_pos pos, uint32_t keyword, bool rest) {
  if (vs_is_identifier(spec)) return add(p, spec, VS_ABSENT, VS_ABSENT, pos, keyword);
  int64_t n = vs_list_length(spec);
  if (n < 2 || n > (rest ? 2 : 3) || !vs_is_identifier(vs_car(spec)))
    return vs_expand_fail(x, pos, spec,
                          rest ? "the rest parameter is a name or [name predicate], not"
                               : "a parameter is a name, [name predicate] or [name predicate default], not");
  vs_value id = vs_car(spec), predicate = vs_car(vs_cdr(spec)),
           fallback = n == 3 ? vs_car(vs_cdr(vs_cdr(spec))) : VS_ABSENT;
  /* Reports a parameter such as [width 5], where other Schemes read 5 as the default. Without this report, a call
   * without the argument would show a misleading error. */
  if (n == 2 && (vs_is_fixnum(predicate) || vs_is_double(predicate) || vs_is(predicate, VS_T_STRING) ||
                 predicate == VS_TRUE || predicate == VS_FALSE))
    return vs_expand_fail(x, pos, spec,
                          "a default follows a predicate, [name any? value] or [name positive? value], not");
  return add(p, id, predicate, fallback, pos, keyword);
}

/* Parses the parameter list. The values in p->at are valid only until the next allocation; `reload` then reads them
 * again from the list. */
static bool parse(vs_expansion *x, parameters *p, vs_value list, vs_pos outer) {
  vs_value l = list;
  bool optional = false, keyed = false;
  for (bool first = !p->tail; vs_is_pair(l); l = vs_cdr(l), first = false) {
    vs_pos pos = vs_element_pos(l, false, outer);
    vs_value spec = vs_car(l);
    if (!first && (vs_object_of(l)->flags & VS_F_SQUARE)) {
      p->rest = true;
      return specification(x, p, l, vs_pair_pos(l) ? vs_pair_pos(l) : outer, 0, true);
    }
    uint32_t keyword = 0;
    if (is_keyword(spec)) {
      const vs_symbol *s = vs_as_symbol(spec);
      vs_value name;
      char copy[128];
      if (s->length - 2 > sizeof copy) return vs_expand_fail(x, pos, VS_ABSENT, "this keyword is too long");
      memcpy(copy, s->name + 2, s->length - 2);
      if (!vs_intern(x->vm, copy, s->length - 2, &name) || !vs_ast_const(&x->ast, name, &keyword)) return false;
      keyword++;
      l = vs_cdr(l);
      if (!vs_is_pair(l))
        return vs_expand_fail(x, pos, VS_ABSENT, "a parameter is missing after #:%s", vs_as_symbol(name)->name);
      spec = vs_car(l);
      keyed = true;
    } else if (keyed) return vs_expand_fail(x, pos, spec, "keyword parameters come last; this follows one:");
    if (!specification(x, p, spec, pos, keyword, false)) return false;
    bool has_default = p->at[p->count - 1].fallback != VS_ABSENT;
    if (!keyword && optional && !has_default)
      return vs_expand_fail(x, pos, spec, "a parameter without a default follows one with a default:");
    optional = optional || (!keyword && has_default);
  }
  if (vs_is_identifier(l)) { p->rest = true; return specification(x, p, l, outer, 0, true); }
  if (l != VS_NIL) return vs_expand_fail(x, outer, list, "the parameters of a procedure are names in parentheses, not");
  return true;
}

/* In a contract, the words and, or and not combine predicates, at any depth and within list-of. Each word then means a
 * procedure of the library. */
static const struct { int form; const char *word, *procedure; } combinations[] = {
  { VS_FORM_and, NULL, "and-of" }, { VS_FORM_or, NULL, "or-of" }, { -1, "not", "not-of" }, { -1, "list-of", "list-of" },
};

/* Returns the library procedure that a form (and, or, not) in a contract means, or NULL if the form is an ordinary
 * expression. */
static const char *combination(vs_value form, vs_value env) {
  if (!vs_is_pair(form) || vs_list_length(form) < 1 || !vs_is_identifier(vs_car(form))) return NULL;
  for (size_t i = 0; i < sizeof combinations / sizeof *combinations; i++) {
    if (combinations[i].form >= 0 && vs_is_form(env, vs_car(form), combinations[i].form))
      return combinations[i].procedure;
    if (combinations[i].form >= 0) continue;
    vs_meaning m = vs_environment_find(env, vs_car(form));
    /* skips a word that the program has defined itself */
    if (m.kind != VS_MEANS_CELL || !(vs_object_of(m.value)->flags & VS_F_CONSTANT)) continue;
    if (!strcmp(vs_as_symbol(vs_as_cell(m.value)->name)->name, combinations[i].word)) return combinations[i].procedure;
  }
  return NULL;
}

bool vs_predicate_step(vs_expansion *x) {
  const char *procedure = combination(x->now.form, x->now.env);
  if (!procedure)
    return vs_expand_push(x, VS_TASK_EXPR, x->now.form, x->now.env, x->now.pos, x->now.into, x->now.depth);
  if (!vs_expand_outline(x)) return false;
  vs_core_node *call = vs_expand_call(x, procedure, (size_t)vs_list_length(x->now.form) - 1, x->now.pos);
  if (!call) return false;
  *x->now.into = call;
  size_t i = 0;
  bool ok = true;
  for (vs_value l = vs_cdr(x->now.form); ok && vs_is_pair(l); l = vs_cdr(l), i++)
    ok = vs_expand_push(x, VS_TASK_PREDICATE, vs_car(l), x->now.env, vs_element_pos(l, false, x->now.pos),
                        &call->as.call.at[i], x->now.depth + 1);
  return ok;
}

/* Reads the values of the parameters from the list again, since an allocation has moved them. */
static void reload(parameters *p, vs_value list) {
  size_t i = 0;
  bool first = !p->tail;
  for (vs_value l = list; i < p->count; first = false) {
    vs_value spec = l;
    if (vs_is_pair(l) && (first || !(vs_object_of(l)->flags & VS_F_SQUARE))) { spec = vs_car(l); l = vs_cdr(l); }
    if (is_keyword(spec) && p->at[i].keyword) { spec = vs_car(l); l = vs_cdr(l); }
    parameter *q = &p->at[i++];
    q->id = spec;
    q->predicate = q->fallback = VS_ABSENT;
    if (!vs_is_pair(spec)) continue;
    q->id = vs_car(spec);
    q->predicate = vs_car(vs_cdr(spec));
    if (vs_is_pair(vs_cdr(vs_cdr(spec)))) q->fallback = vs_car(vs_cdr(vs_cdr(spec)));
  }
}

static vs_core_node *check(vs_expansion *x, const parameter *q, vs_value env, uint32_t name) {
  vs_core_node *n = vs_expand_node(x, VS_AST_CHECK, q->pos);
  if (!n || !(n->as.check.value = vs_ast_local(&x->ast, q->var, q->pos))) return NULL;
  n->as.check.name = q->var->name;
  VS_ROOTS(x->vm, r, 2);
  r[0] = q->predicate; r[1] = env;
  if (!vs_strip(x->vm, r[0], &r[0]) || !vs_ast_const(&x->ast, r[0], &n->as.check.text)) return NULL;
  n->as.check.who = name;
  n->as.check.predicate =
      q->contract ? vs_ast_local(&x->ast, q->contract, q->pos) : vs_expand_ref(x, q->predicate, r[1], q->pos);
  return n->as.check.predicate ? n : NULL;
}

/* Returns true for a predicate that need not be evaluated: a variable of the library, which is never assigned. */
static bool is_constant(vs_value form, vs_value env) {
  if (!vs_is_identifier(form)) return false;
  vs_meaning m = vs_environment_find(env, form);
  return m.kind == VS_MEANS_CELL && (vs_object_of(m.value)->flags & VS_F_CONSTANT) &&
         vs_as_cell(m.value)->value != VS_UNDEFINED;
}

/* The data of a lambda that is being built. */
typedef struct {
  vs_expansion *x;
  parameters *p;
  vs_value *roots;           /* roots of the garbage collector, by the indices ROOT_LIST ... */
  uint32_t who;              /* constant index of the lambda's name, which errors of its contracts show */
  vs_pos pos;
  vs_core_node *let;         /* LET around the lambda for the evaluated predicates; NULL if there are none */
  size_t contracts;          /* number of predicates that are already in the LET around the lambda */
  vs_core_node *lambda;
} making;
/* ROOT_SCOPE: scope that contains the lambda's parameters */
enum { ROOT_LIST, ROOT_BODY, ROOT_ENV, ROOT_SCOPE, ROOT_EARLIER /* ROOT_EARLIER: scope of a default value, with the
                                                                 * parameters before it */, ROOTS };

static void again(making *m) { reload(m->p, m->roots[ROOT_LIST]); }

static bool is_evaluated(const making *m, const parameter *q) {
  return q->predicate != VS_ABSENT && !is_constant(q->predicate, m->roots[ROOT_ENV]);
}

/* Returns how many of the first n parameters have a predicate. */
static size_t checks_of(const parameters *p, size_t n) {
  size_t checks = 0;
  for (size_t i = 0; i < n; i++) checks += p->at[i].predicate != VS_ABSENT;
  return checks;
}

/* If predicates must be evaluated, creates their LET at *outer, and sets *outer to the LET's body. Creates the lambda
 * at *into. */
static bool make_frame(making *m, vs_core_node ***outer, vs_core_node **into) {
  size_t evaluated = 0;
  for (size_t i = 0; i < m->p->count; i++) evaluated += is_evaluated(m, &m->p->at[i]);
  if (evaluated) {
    if (!(m->let = vs_expand_many(m->x, VS_AST_LET, evaluated, m->pos))) return false;
    bool same = *outer == into;
    **outer = m->let;
    *outer = &m->let->as.let.body;
    if (same) into = *outer;
  }
  m->lambda = vs_expand_many(m->x, VS_AST_LAMBDA, m->p->count - m->p->rest, m->pos);
  if (!m->lambda) return false;
  *into = m->lambda;
  return true;
}

/* Adds a variable for the predicate of parameter i to the LET around the lambda. */
static bool make_contract(making *m, size_t i) {
  parameter *q = &m->p->at[i];
  if (!is_evaluated(m, q)) return true;
  vs_core_node **into = &m->let->as.let.values[m->contracts];
  q->contract = vs_ast_var(&m->x->ast, vs_identifier_symbol(q->id));
  if (!q->contract ||
      !vs_expand_push(m->x, VS_TASK_PREDICATE, q->predicate, m->roots[ROOT_ENV], q->pos, into, 2))
    return false;
  m->let->as.let.vars[m->contracts++] = q->contract;
  again(m);
  return true;
}

/* Creates the checks of the first n parameters at *at. Sets *at to the place of the node that follows the checks. */
static bool make_checks(making *m, size_t n, vs_pos pos, vs_core_node ***at) {
  size_t checks = checks_of(m->p, n), done = 0;
  if (!checks) return true;
  vs_core_node *seq = vs_expand_many(m->x, VS_AST_SEQ, checks + 1, pos);
  if (!seq) return false;
  for (size_t i = 0; i < n; i++) {
    again(m);
    const parameter *q = &m->p->at[i];
    if (q->predicate != VS_ABSENT && !(seq->as.seq.at[done++] = check(m->x, q, m->roots[ROOT_ENV], m->who)))
      return false;
  }
  again(m);
  **at = seq;
  *at = &seq->as.seq.at[checks];
  return true;
}

/* Creates the default value of parameter i. The default may use the parameters before i, which are checked first if the
 * default is computed. */
static bool make_default(making *m, size_t i, vs_param *param) {
  vs_value *r = m->roots;
  parameter *q = &m->p->at[i];
  vs_core_node **at = &param->fallback;
  bool plain = !vs_is_pair(q->fallback) && !vs_is_identifier(q->fallback);
  if (!plain && !make_checks(m, i, q->pos, &at)) return false;
  /* A default has its own scope, since the lambda's scope already binds later parameters, which the default must not
   * use. */
  if (!vs_expand_scope(m->x, r[ROOT_ENV], &r[ROOT_EARLIER])) return false;
  for (size_t k = 0; k < i; k++) {
    again(m);
    vs_value var = vs_fix((int64_t)(uintptr_t)m->p->at[k].var);
    if (!vs_environment_bind(m->x->vm, r[ROOT_EARLIER], m->p->at[k].id, var)) return false;
  }
  again(m);
  return vs_expand_push(m->x, VS_TASK_EXPR, q->fallback, r[ROOT_EARLIER], q->pos, at, 2);
}

static bool make_parameter(making *m, size_t i) {
  again(m);
  parameter *q = &m->p->at[i];
  if (vs_idtable_get(vs_as_environment(m->roots[ROOT_SCOPE])->table, q->id) != VS_VACANT)
    return vs_expand_fail(m->x, q->pos, VS_ABSENT, "two parameters are called %s; give one of them another name",
                          vs_as_symbol(vs_identifier_symbol(q->id))->name);
  if (!make_contract(m, i)) return false;
  bool rest = i == m->p->count - 1 && m->p->rest;
  vs_param *param = rest ? NULL : &m->lambda->as.lambda.params[i];
  if (param && q->fallback != VS_ABSENT && !make_default(m, i, param)) return false;
  if (!vs_expand_var(m->x, q->id, m->roots[ROOT_SCOPE], &q->var)) return false;
  if (param) param->var = q->var, param->keyword = q->keyword;
  else m->lambda->as.lambda.rest = q->var;
  return true;
}

/* Builds the lambda at *into. *outer is the place for the LET of the evaluated predicates, and becomes the body of that
 * LET. */
static bool build(making *m, vs_value name, vs_core_node ***outer, vs_core_node **into) {
  vs_value *r = m->roots;
  if (!vs_ast_const(&m->x->ast, name, &m->who) || !vs_expand_scope(m->x, r[ROOT_ENV], &r[ROOT_SCOPE])) return false;
  again(m);
  if (!make_frame(m, outer, into)) return false;
  if (name != VS_FALSE) m->lambda->as.lambda.name = 1 + m->who;
  for (size_t i = 0; i < m->p->count; i++)
    if (!make_parameter(m, i)) return false;
  into = &m->lambda->as.lambda.body;
  return make_checks(m, m->p->count, m->pos, &into) &&
         vs_expand_body(m->x, r[ROOT_BODY], r[ROOT_SCOPE], m->pos, into, 2); /* the nesting of the body is counted from
                                                                              * the start again in each lambda */
}

static bool expand_lambda(vs_expansion *x, const vs_lambda_form *form, vs_core_node ***outer, vs_core_node **into) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, ROOTS);
  r[ROOT_LIST] = form->params, r[ROOT_BODY] = form->body, r[ROOT_ENV] = form->env;
  parameters p = {.vm = vm, .tail = form->tail};
  making m = {.x = x, .p = &p, .roots = r, .pos = form->pos};
  bool ok = parse(x, &p, r[ROOT_LIST], vs_form_pos(form->params, form->pos)) && build(&m, form->name, outer, into);
  if (p.at) vs_mem(vm, p.at, p.room * sizeof *p.at, 0);
  return ok;
}

bool vs_expand_lambda(vs_expansion *x, const vs_lambda_form *form, vs_core_node **into) {
  vs_core_node **outer = into;
  return expand_lambda(x, form, &outer, into);
}

static vs_value task_name(vs_expansion *x) { return x->now.var ? x->ast.pool[x->now.var->name] : VS_FALSE; }

bool vs_form_lambda(vs_expansion *x) {
  if (vs_list_length(x->now.form) < 3) return vs_expand_shape(x, VS_FORM_lambda);
  vs_value rest = vs_cdr(x->now.form);
  const vs_lambda_form form = {.params = vs_car(rest), .body = vs_cdr(rest), .env = x->now.env, .name = task_name(x),
                               .pos = x->now.pos};
  return vs_expand_lambda(x, &form, x->now.into);
}
bool vs_form_lambda_letter(vs_expansion *x) { return vs_form_lambda(x); }

bool vs_form_case_lambda(vs_expansion *x) {
  int64_t n = vs_list_length(x->now.form);
  if (n < 2) return vs_expand_shape(x, VS_FORM_case_lambda);
  vs_core_node *node = vs_expand_many(x, VS_AST_CASE, (size_t)n - 1, x->now.pos);
  if (!node) return false;
  vs_value name = task_name(x);
  if (name != VS_FALSE) {
    uint32_t index;
    if (!vs_ast_const(&x->ast, name, &index)) return false;
    node->as.clauses.name = 1 + index;
  }
  VS_ROOTS(x->vm, r, 1);
  bool ok = true;
  size_t i = 0;
  vs_core_node **outer = x->now.into;        /* the LETs for the predicates of all clauses are around the case-lambda */
  for (r[0] = vs_cdr(x->now.form); ok && vs_is_pair(r[0]); r[0] = vs_cdr(r[0]), i++) {
    vs_value clause = vs_car(r[0]);
    if (vs_list_length(clause) < 2)
      return vs_expand_fail(x, vs_element_pos(r[0], false, x->now.pos), clause,
                            "case-lambda is written %s; this is no clause:", vs_form_shape(VS_FORM_case_lambda));
    const vs_lambda_form form = {.params = vs_car(clause), .body = vs_cdr(clause), .env = x->now.env, .name = name,
                                 .pos = vs_form_pos(clause, x->now.pos)};
    ok = expand_lambda(x, &form, &outer, &node->as.clauses.at[i]);
  }
  *outer = node;
  return ok;
}
