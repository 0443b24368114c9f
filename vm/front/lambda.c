/* Owns parameter lists: lambda, case-lambda and the procedures of define; contracts, optional and keyword parameters.

   A parameter is one of
     name   [name predicate]   [name predicate default]
   and behind #:key the same;   . name   or   . [name predicate]   is the rest. The predicate is evaluated once, outside
   the lambda: a LET around it, unless it is a constant of the library. The checks are a SEQ in front of the body, one
   CHECK a parameter, in order; a default that is computed is preceded by the checks of the parameters it can see. */
#include "vm/front/lambda.h"

#include "vm/front/expand.h"
#include "vm/machine/fail.h"

typedef struct {
  vs_value id, predicate, fallback;     /* predicate, fallback: forms, or VS_ABSENT */
  vs_pos pos;
  vs_var *var, *contract;               /* contract: the LET's variable for the predicate, or NULL: a constant */
  uint32_t keyword;                     /* as in vs_param */
} parameter;

/* The parameters of a lambda while it is built; their values are rooted. */
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
  /* [width 5], as other Schemes write a default: told where it stands, since a call without the argument fails first */
  if (n == 2 && (vs_is_fixnum(predicate) || vs_is_double(predicate) || vs_is(predicate, VS_T_STRING) ||
                 predicate == VS_TRUE || predicate == VS_FALSE))
    return vs_expand_fail(x, pos, spec,
                          "a default stands behind a predicate, [name any? value] or [name positive? value], not");
  return add(p, id, predicate, fallback, pos, keyword);
}

/* the parameter list; the values of p->at are only good until something allocates: they are read again by shape in
   `reload` */
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
        return vs_expand_fail(x, pos, VS_ABSENT, "a parameter is missing behind #:%s", vs_as_symbol(name)->name);
      spec = vs_car(l);
      keyed = true;
    } else if (keyed) return vs_expand_fail(x, pos, spec, "keyword parameters come last; this stands behind one:");
    if (!specification(x, p, spec, pos, keyword, false)) return false;
    bool has_default = p->at[p->count - 1].fallback != VS_ABSENT;
    if (!keyword && optional && !has_default)
      return vs_expand_fail(x, pos, spec, "a parameter without a default stands behind one with a default:");
    optional = optional || (!keyword && has_default);
  }
  if (vs_is_identifier(l)) { p->rest = true; return specification(x, p, l, outer, 0, true); }
  if (l != VS_NIL) return vs_expand_fail(x, outer, list, "the parameters of a procedure are names in parentheses, not");
  return true;
}

/* In a contract and, or and not combine predicates, at any depth and within list-of: there they are the library's
   procedures of these names. */
static const struct { int form; const char *word, *procedure; } combinations[] = {
  { VS_FORM_and, NULL, "and-of" }, { VS_FORM_or, NULL, "or-of" }, { -1, "not", "not-of" }, { -1, "list-of", "list-of" },
};

/* Returns the procedure that a form of a contract calls, or NULL if it is an expression like any other. */
static const char *combination(vs_value form, vs_value env) {
  if (!vs_is_pair(form) || vs_list_length(form) < 1 || !vs_is_identifier(vs_car(form))) return NULL;
  for (size_t i = 0; i < sizeof combinations / sizeof *combinations; i++) {
    if (combinations[i].form >= 0 && vs_is_form(env, vs_car(form), combinations[i].form))
      return combinations[i].procedure;
    if (combinations[i].form >= 0) continue;
    vs_meaning m = vs_environment_find(env, vs_car(form));
    /* a name of the program's own */
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

/* reads ids and forms out of the list again: allocation has moved them */
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

/* a predicate that needs no evaluation: a variable of the library that is never assigned */
static bool is_constant(vs_value form, vs_value env) {
  if (!vs_is_identifier(form)) return false;
  vs_meaning m = vs_environment_find(env, form);
  return m.kind == VS_MEANS_CELL && (vs_object_of(m.value)->flags & VS_F_CONSTANT) &&
         vs_as_cell(m.value)->value != VS_UNDEFINED;
}

/* *outer: where the LET of the contracts goes, and then its body */
static bool build(vs_expansion *x, parameters *p, vs_value *r, vs_value name, vs_pos pos, vs_core_node ***outer,
                  vs_core_node **into) {
  /* r: 0 list, 1 body, 2 env, 3 the scope of the lambda, 4 scratch */
  vs_scheme *vm = x->vm;
  uint32_t who;
  size_t contracts = 0, checks = 0;
  if (!vs_ast_const(&x->ast, name, &who) || !vs_expand_scope(x, r[2], &r[3])) return false;
  reload(p, r[0]);
  for (size_t i = 0; i < p->count; i++) {
    checks += p->at[i].predicate != VS_ABSENT;
    contracts += p->at[i].predicate != VS_ABSENT && !is_constant(p->at[i].predicate, r[2]);
  }
  vs_core_node *let = NULL;
  if (contracts) {
    if (!(let = vs_expand_many(x, VS_AST_LET, contracts, pos))) return false;
    bool same = *outer == into;
    **outer = let;
    *outer = &let->as.let.body;
    if (same) into = *outer;
  }
  vs_core_node *lambda = vs_expand_many(x, VS_AST_LAMBDA, p->count - p->rest, pos);
  if (!lambda) return false;
  *into = lambda;
  if (name != VS_FALSE) lambda->as.lambda.name = 1 + who;
  size_t c = 0;
  for (size_t i = 0; i < p->count; i++) {
    reload(p, r[0]);
    parameter *q = &p->at[i];
    if (vs_idtable_get(vs_as_environment(r[3])->table, q->id) != VS_VACANT)
      return vs_expand_fail(x, q->pos, VS_ABSENT, "two parameters are called %s",
                            vs_as_symbol(vs_identifier_symbol(q->id))->name);
    if (q->predicate != VS_ABSENT && !is_constant(q->predicate, r[2])) {
      q->contract = vs_ast_var(&x->ast, vs_identifier_symbol(q->id));
      if (!q->contract || !vs_expand_push(x, VS_TASK_PREDICATE, q->predicate, r[2], q->pos, &let->as.let.values[c], 2))
        return false;
      let->as.let.vars[c++] = q->contract;
      reload(p, r[0]);
    }
    vs_param *param = i == p->count - 1 && p->rest ? NULL : &lambda->as.lambda.params[i];
    if (param && q->fallback != VS_ABSENT) {           /* sees the parameters before it */
      vs_core_node **at = &param->fallback;
      size_t before = 0;
      bool plain = !vs_is_pair(q->fallback) && !vs_is_identifier(q->fallback);
      for (size_t k = 0; !plain && k < i; k++) before += p->at[k].predicate != VS_ABSENT;
      if (before) {
        vs_core_node *seq = vs_expand_many(x, VS_AST_SEQ, before + 1, q->pos);
        if (!seq) return false;
        for (size_t k = 0, j = 0; k < i; k++) {
          if (p->at[k].predicate == VS_ABSENT) continue;
          if (!(seq->as.seq.at[j++] = check(x, &p->at[k], r[2], who))) return false;
          reload(p, r[0]);
        }
        *at = seq;
        at = &seq->as.seq.at[before];
      }
      /* a scope of its own: later parameters must not be seen, though they are bound in r[3] by the time it is
         expanded */
      if (!vs_expand_scope(x, r[2], &r[4])) return false;
      for (size_t k = 0; k < i; k++) {
        reload(p, r[0]);
        if (!vs_environment_bind(vm, r[4], p->at[k].id, vs_fix((int64_t)(uintptr_t)p->at[k].var))) return false;
      }
      reload(p, r[0]);
      if (!vs_expand_push(x, VS_TASK_EXPR, p->at[i].fallback, r[4], q->pos, at, 2)) return false;
    }
    if (!vs_expand_var(x, q->id, r[3], &q->var)) return false;
    if (param) { param->var = q->var; param->keyword = q->keyword; }
    else lambda->as.lambda.rest = q->var;
  }
  into = &lambda->as.lambda.body;
  if (checks) {
    vs_core_node *seq = vs_expand_many(x, VS_AST_SEQ, checks + 1, pos);
    if (!seq) return false;
    size_t j = 0;
    for (size_t i = 0; i < p->count; i++) {
      reload(p, r[0]);
      if (p->at[i].predicate != VS_ABSENT && !(seq->as.seq.at[j++] = check(x, &p->at[i], r[2], who))) return false;
    }
    *into = seq;
    into = &seq->as.seq.at[checks];
  }
  return vs_expand_body(x, r[1], r[3], pos, into, 2);     /* a lambda's depth is its own */
}

static bool expand_lambda(vs_expansion *x, vs_value params, bool tail, vs_value body, vs_value env, vs_value name,
                          vs_pos pos, vs_core_node ***outer, vs_core_node **into) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 5);
  r[0] = params; r[1] = body; r[2] = env;
  parameters p = {.vm = vm, .tail = tail};
  bool ok = parse(x, &p, r[0], vs_form_pos(params, pos)) && build(x, &p, r, name, pos, outer, into);
  if (p.at) vs_mem(vm, p.at, p.room * sizeof *p.at, 0);
  return ok;
}

bool vs_expand_lambda(vs_expansion *x, vs_value params, bool tail, vs_value body, vs_value env, vs_value name,
                      vs_pos pos, vs_core_node **into) {
  vs_core_node **outer = into;
  return expand_lambda(x, params, tail, body, env, name, pos, &outer, into);
}

static vs_value task_name(vs_expansion *x) { return x->now.var ? x->ast.pool[x->now.var->name] : VS_FALSE; }

bool vs_form_lambda(vs_expansion *x) {
  if (vs_list_length(x->now.form) < 3) return vs_expand_shape(x, VS_FORM_lambda);
  vs_value rest = vs_cdr(x->now.form);
  return vs_expand_lambda(x, vs_car(rest), false, vs_cdr(rest), x->now.env, task_name(x), x->now.pos, x->now.into);
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
  vs_core_node **outer = x->now.into;        /* the LETs of all clauses' contracts stand around the whole */
  for (r[0] = vs_cdr(x->now.form); ok && vs_is_pair(r[0]); r[0] = vs_cdr(r[0]), i++) {
    vs_value clause = vs_car(r[0]);
    if (vs_list_length(clause) < 2)
      return vs_expand_fail(x, vs_element_pos(r[0], false, x->now.pos), clause,
                            "case-lambda is written %s; this is no clause:", vs_form_shape(VS_FORM_case_lambda));
    ok = expand_lambda(x, vs_car(clause), false, vs_cdr(clause), x->now.env, name, vs_form_pos(clause, x->now.pos),
                       &outer, &node->as.clauses.at[i]);
  }
  *outer = node;
  return ok;
}
