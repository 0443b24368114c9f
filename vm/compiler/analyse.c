/* Analyses core trees, the expanded programs, in two passes.
 *
 * A home is a LAMBDA whose calls have an activation (a frame of registers) of their own. Every LAMBDA is a home unless
 * it is a loop.
 *
 * Loops: the first pass finds the lambdas bound by a FIX that can run in the activation that defines them. Every
 * reference to such a lambda must be a call with the right number of arguments, in tail position of the FIX's body or
 * of the lambda's own body. Scopes (struct tail) are chained from the inside out. A call is such a tail call if the
 * chain from it reaches the FIX. If the chain passes through the body of another candidate, that candidate must become
 * a loop, too. These dependencies are stored, and decided at the end of the pass.
 *
 * Homes: the second pass finds the LAMBDA that contains each variable, the captured variables of every lambda, and the
 * variables that need a box. Each node of the tree that defines a variable or creates a closure has a number, its
 * moment, counted from 1. If a closure is created before the moment at which one of its captured variables gets its
 * value, this variable is boxed and its references are checked. Consecutive lambdas of a FIX are created at one moment:
 * they may capture each other, and the compiler patches them.
 *
 * Both passes recurse only within a home (VS_AST_DEPTH times the few loops nested in it). Other lambdas wait in a
 * list. */
#include "vm/compiler/analyse.h"

#include "vm/machine/native.h"

enum { MOST_LOOPS = 24 /* greatest number of loops, nested or in sequence, in a LAMBDA with its own activation; each may
                        * be compiled inside the previous loop */, MOST_DEPTH = 1500 };

struct tail { struct tail *parent; vs_core_node *fix; vs_var *var; /* A scope: the body of the lambda of the variable
                                                                    * var or, if var is NULL, the body of `fix`. parent:
                                                                    * the enclosing scope */ };
struct job { struct job *next; vs_core_node *lambda; struct tail *tail; int loops; };
struct needs { struct needs *next; vs_var *loop, *through; };

struct analysis { vs_ast *ast; struct job *jobs; struct needs *needs; uint32_t now; };

static bool add_job(struct analysis *a, vs_core_node *lambda, struct tail *tail, int loops) {
  struct job *j = vs_ast_alloc(a->ast, sizeof *j);
  if (!j) return false;
  *j = (struct job){a->jobs, lambda, tail, loops};
  a->jobs = j;
  return true;
}

static vs_var_info *bind(struct analysis *a, vs_var *v) {
  v->assigned = v->given_again;
  v->captured = false;
  v->refs = v->calls = 0;
  return v->extra = vs_ast_alloc(a->ast, sizeof(vs_var_info));
}

static struct tail *scope(struct analysis *a, struct tail *parent, vs_core_node *fix, vs_var *var) {
  struct tail *t = vs_ast_alloc(a->ast, sizeof *t);
  if (t) *t = (struct tail){parent, fix, var};
  return t;
}

static bool plain(const vs_core_node *lambda) {
  if (lambda->as.lambda.rest) return false;
  for (uint32_t i = 0; i < lambda->count; i++)
    if (lambda->as.lambda.params[i].fallback || lambda->as.lambda.params[i].keyword) return false;
  return true;
}

/* ---- first pass: loops ---- */
static bool called(struct analysis *a, vs_var *v, const vs_core_node *call, struct tail *t) {
  vs_var_info *info = vs_info(v);
  v->calls++;
  if (!info->loop) return true;
  if (call->as.call.keywords || call->count != v->value->count) { info->loop = false; return true; }
  for (; t; t = t->parent) {
    if (t->fix == info->fix && (!t->var || t->var == v)) return true;
    if (!t->var) continue;
    struct needs *n = vs_ast_alloc(a->ast, sizeof *n);
    if (!n) return false;
    *n = (struct needs){a->needs, v, t->var};
    a->needs = n;
  }
  info->loop = false;
  return true;
}

/* Finds FIX-bound lambdas below n that can run as loops. t is the chain of scopes in whose tail position n is, or
 * NULL. */
static bool find_loops(struct analysis *a, vs_core_node *n, struct tail *t, int depth, int loops) {
  if (!n) return true;
  if (!vs_poll(a->ast->vm, 16)) return false;
  depth++;
  switch (n->kind) {
    case VS_AST_CONST: case VS_AST_GLOBAL: return true;
    case VS_AST_LOCAL:
      n->as.var->refs++;
      vs_info(n->as.var)->loop = false;
      return true;
    case VS_AST_SETLOCAL:
      n->as.set.var->assigned = true;
      vs_info(n->as.set.var)->loop = false;
      return find_loops(a, n->as.set.value, NULL, depth, loops);
    case VS_AST_SETGLOBAL: case VS_AST_DEFGLOBAL: return find_loops(a, n->as.global.value, NULL, depth, loops);
    case VS_AST_IF:
      return find_loops(a, n->as.branch.test, NULL, depth, loops) &&
             find_loops(a, n->as.branch.then, t, depth, loops) &&
             find_loops(a, n->as.branch.otherwise, t, depth, loops);
    case VS_AST_SEQ:
      for (uint32_t i = 0; i < n->count; i++)
        if (!find_loops(a, n->as.seq.at[i], i + 1 == n->count ? t : NULL, depth, loops)) return false;
      return true;
    case VS_AST_CALL: {
      vs_core_node *f = n->as.call.callee;
      if (f->kind == VS_AST_LAMBDA && f->count && f->count == n->count && plain(f) && !n->as.call.keywords &&
          depth < MOST_DEPTH / 3) {
        vs_core_node *list = vs_ast_list(a->ast, VS_AST_LET, n->count, n->pos);      /* a call of a lambda, ((lambda
                                                                                      * (x ...) body) v ...), becomes
                                                                                      * a LET */
        if (!list) return false;
        for (uint32_t i = 0; i < n->count; i++) {
          list->as.let.vars[i] = f->as.lambda.params[i].var;
          list->as.let.values[i] = n->as.call.at[i];
        }
        list->as.let.body = f->as.lambda.body;
        *n = *list;
        return find_loops(a, n, t, depth - 1, loops);
      }
      if (f->kind == VS_AST_LOCAL) {
        f->as.var->refs++;
        if (!called(a, f->as.var, n, t)) return false;
      } else if (!find_loops(a, f, NULL, depth, loops)) {
        return false;
      }
      for (uint32_t i = 0; i < n->count; i++)
        if (!find_loops(a, n->as.call.at[i], NULL, depth, loops)) return false;
      return true;
    }
    case VS_AST_LET:
      for (uint32_t i = 0; i < n->count; i++)
        if (!bind(a, n->as.let.vars[i]) || !find_loops(a, n->as.let.values[i], NULL, depth, loops)) return false;
      return find_loops(a, n->as.let.body, t, depth, loops);
    case VS_AST_FIX: {
      struct tail *body = scope(a, t, n, NULL);
      if (!body) return false;
      for (uint32_t i = 0; i < n->count; i++) {
        vs_var *v = n->as.let.vars[i];
        if (!bind(a, v)) return false;
        vs_info(v)->fix = n;
        v->value = n->as.let.values[i]->kind == VS_AST_LAMBDA ? n->as.let.values[i] : NULL;
        vs_info(v)->loop = v->value && plain(v->value) && loops < MOST_LOOPS;
        loops += vs_info(v)->loop;
      }
      for (uint32_t i = 0; i < n->count; i++) {
        vs_var *v = n->as.let.vars[i];
        if (!v->value) {
          if (!find_loops(a, n->as.let.values[i], NULL, depth, loops)) return false;
          continue;
        }
        struct tail *own = vs_info(v)->loop ? scope(a, body, n, v) : NULL;
        if ((vs_info(v)->loop && !own) || !add_job(a, v->value, own, own ? loops : 0)) return false;
      }
      return find_loops(a, n->as.let.body, body, depth, loops);
    }
    case VS_AST_LAMBDA: return add_job(a, n, NULL, 0);
    case VS_AST_CASE:
      for (uint32_t i = 0; i < n->count; i++)
        if (!add_job(a, n->as.clauses.at[i], NULL, 0)) return false;
      return true;
    case VS_AST_CHECK:
      return find_loops(a, n->as.check.predicate, NULL, depth, loops) &&
             find_loops(a, n->as.check.value, NULL, depth, loops);
  }
  return true;
}

static bool find_loops_in(struct analysis *a, const struct job *j) {
  vs_core_node *l = j->lambda;
  for (uint32_t i = 0; i < l->count; i++)
    if (!bind(a, l->as.lambda.params[i].var)) return false;
  if (l->as.lambda.rest && !bind(a, l->as.lambda.rest)) return false;
  for (uint32_t i = 0; i < l->count; i++)
    if (!find_loops(a, l->as.lambda.params[i].fallback, NULL, 0, j->loops)) return false;
  return find_loops(a, l->as.lambda.body, j->tail, 0, j->loops);
}

/* ---- second pass: the LAMBDA in whose activation each variable lives ---- */
static vs_lambda_info *info_of(vs_core_node *lambda) { return lambda->as.lambda.extra; }

static bool make_info(struct analysis *a, vs_core_node *lambda, vs_core_node *parent, uint32_t made) {
  vs_lambda_info *f = vs_ast_alloc(a->ast, sizeof *f);
  if (!f) return false;
  f->parent = parent;
  f->made = made;
  lambda->as.lambda.extra = f;
  return add_job(a, lambda, NULL, 0);
}

/* Returns the entry of f's hash index at which to begin the search for the variable v. The number of entries is a power
 * of two. */
static uint32_t home(const vs_lambda_info *f, const vs_var *v) {
  VS_ASSERT(f->index_room > 0 && (f->index_room & (f->index_room - 1)) == 0);
  return (uint32_t)((uintptr_t)v >> 4) * 2654435761u & (f->index_room - 1);
}

/* Adds captured variable i of the lambda f to f's hash index. */
static void index_put(vs_lambda_info *f, uint32_t i) {
  uint32_t at = home(f, f->free[i]);
  VS_ASSERT(i < f->free_count);
  while (f->index[at]) at = (at + 1) & (f->index_room - 1);
  f->index[at] = i + 1;
}

uint32_t vs_free_index(const vs_lambda_info *f, const vs_var *v) {
  if (!f->index_room) {
    for (uint32_t i = 0; i < f->free_count; i++)
      if (f->free[i] == v) return i;
    return UINT32_MAX;
  }
  for (uint32_t at = home(f, v); f->index[at]; at = (at + 1) & (f->index_room - 1))
    if (f->free[f->index[at] - 1] == v) return f->index[at] - 1;
  return UINT32_MAX;
}

/* Adds v to the captured variables of f, which does not capture it yet. */
static bool capture(struct analysis *a, vs_lambda_info *f, vs_var *v) {
  VS_ASSERT(vs_free_index(f, v) == UINT32_MAX);
  if (f->free_count == f->free_room) {
    uint32_t room = f->free_room ? f->free_room * 2 : 4;
    vs_var **at = vs_ast_alloc(a->ast, room * sizeof(vs_var *));
    bool *early = vs_ast_alloc(a->ast, room * sizeof(bool));
    if (!at || !early) return false;
    if (f->free_count) memcpy(at, f->free, f->free_count * sizeof(vs_var *));
    if (f->free_count) memcpy(early, f->early, f->free_count * sizeof(bool));
    f->free = at;
    f->early = early;
    f->free_room = room;
    if (room >= 16) {                          /* from 16 captured variables on, builds a hash index */
      f->index_room = room * 2;
      if (!(f->index = vs_ast_alloc(a->ast, f->index_room * sizeof *f->index))) return false;
      for (uint32_t i = 0; i < f->free_count; i++) index_put(f, i);
    }
  }
  f->free[f->free_count++] = v;
  if (f->index_room) index_put(f, f->free_count - 1);
  return true;
}

/* Records that the lambda `in` refers to v. Sets *early to true if the reference may be evaluated before v has a
 * value. */
static bool use(struct analysis *a, vs_core_node *in, vs_var *v, bool *early) {
  vs_var_info *info = vs_info(v);
  *early = false;
  if (info->lambda == in) {
    *early = info->ready == VS_NOT_READY;
  } else {
    v->captured = true;
    /* Goes outwards from `in` to the first enclosing lambda that has already captured v, and copies its entry of
     * `early`. If there is none, ends at the outermost lambda inside v's home. */
    vs_core_node *at = in;
    uint32_t known;
    for (;; at = info_of(at)->parent) {
      vs_lambda_info *f = info_of(at);
      if ((known = vs_free_index(f, v)) != UINT32_MAX) { *early = f->early[known]; break; }
      if (!capture(a, f, v)) return false;
      if (f->parent == info->lambda) { *early = f->made < info->ready; known = f->free_count - 1; break; }
    }
    info_of(at)->early[known] = *early;
    for (vs_core_node *f = in; f != at; f = info_of(f)->parent)
      info_of(f)->early[info_of(f)->free_count - 1] = *early;
    if (*early) info->boxed = true;
  }
  if (*early) info->early = true;
  return true;
}

static bool find_homes(struct analysis *a, vs_core_node *n, vs_core_node *in) {
  if (!n) return true;
  if (!vs_poll(a->ast->vm, 16)) return false;
  bool early;
  switch (n->kind) {
    case VS_AST_CONST: case VS_AST_GLOBAL: return true;
    case VS_AST_LOCAL:
      if (!use(a, in, n->as.var, &early)) return false;
      n->flag = early;
      return true;
    case VS_AST_SETLOCAL:
      return find_homes(a, n->as.set.value, in) && use(a, in, n->as.set.var, &early);
    case VS_AST_SETGLOBAL: case VS_AST_DEFGLOBAL: return find_homes(a, n->as.global.value, in);
    case VS_AST_IF:
      return find_homes(a, n->as.branch.test, in) && find_homes(a, n->as.branch.then, in) &&
             find_homes(a, n->as.branch.otherwise, in);
    case VS_AST_SEQ:
      for (uint32_t i = 0; i < n->count; i++)
        if (!find_homes(a, n->as.seq.at[i], in)) return false;
      return true;
    case VS_AST_CALL:
      if (!(n->as.call.callee->kind == VS_AST_LOCAL && vs_info(n->as.call.callee->as.var)->loop) &&
          !find_homes(a, n->as.call.callee, in))
        return false;
      for (uint32_t i = 0; i < n->count; i++)
        if (!find_homes(a, n->as.call.at[i], in)) return false;
      return true;
    case VS_AST_LET:
      for (uint32_t i = 0; i < n->count; i++) {
        vs_info(n->as.let.vars[i])->lambda = in;
        if (!find_homes(a, n->as.let.values[i], in)) return false;
      }
      return find_homes(a, n->as.let.body, in);
    case VS_AST_FIX: {
      for (uint32_t i = 0; i < n->count; i++) {
        vs_info(n->as.let.vars[i])->lambda = in;
        vs_info(n->as.let.vars[i])->ready = VS_NOT_READY;
      }
      bool run = false;
      for (uint32_t i = 0; i < n->count; i++) {
        vs_var *v = n->as.let.vars[i];
        vs_var_info *info = vs_info(v);
        if (info->loop) { info->ready = 0; continue; }
        if (v->value) {                       /* consecutive lambdas of a FIX are created at the same moment */
          if (!run) a->now++;
          run = true;
          if (!make_info(a, v->value, in, a->now)) return false;
        } else {
          run = false;
          if (!find_homes(a, n->as.let.values[i], in)) return false;
          a->now++;
        }
        info->ready = a->now;
      }
      for (uint32_t i = 0; i < n->count; i++) {
        vs_var *v = n->as.let.vars[i];
        if (!vs_info(v)->loop) continue;
        for (uint32_t p = 0; p < v->value->count; p++) vs_info(v->value->as.lambda.params[p].var)->lambda = in;
        if (!find_homes(a, v->value->as.lambda.body, in)) return false;
      }
      return find_homes(a, n->as.let.body, in);
    }
    case VS_AST_LAMBDA: return make_info(a, n, in, ++a->now);
    case VS_AST_CASE:
      for (uint32_t i = 0; i < n->count; i++)
        if (!make_info(a, n->as.clauses.at[i], in, ++a->now)) return false;
      return true;
    case VS_AST_CHECK: return find_homes(a, n->as.check.predicate, in) && find_homes(a, n->as.check.value, in);
  }
  return true;
}

static bool find_homes_in(struct analysis *a, vs_core_node *l) {
  for (uint32_t i = 0; i < l->count; i++) vs_info(l->as.lambda.params[i].var)->lambda = l;
  if (l->as.lambda.rest) vs_info(l->as.lambda.rest)->lambda = l;
  for (uint32_t i = 0; i < l->count; i++)
    if (!find_homes(a, l->as.lambda.params[i].fallback, l)) return false;
  return find_homes(a, l->as.lambda.body, l);
}

bool vs_analyse(vs_ast *ast, vs_core_node *top) {
  struct analysis a = {ast, NULL, NULL, 0};
  if (!add_job(&a, top, NULL, 0)) return false;
  while (a.jobs) {
    struct job *j = a.jobs;
    a.jobs = j->next;
    if (!find_loops_in(&a, j)) return false;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (struct needs *n = a.needs; n; n = n->next)
      if (vs_info(n->loop)->loop && !vs_info(n->through)->loop) { vs_info(n->loop)->loop = false; changed = true; }
  }
  if (!make_info(&a, top, NULL, 0)) return false;
  while (a.jobs) {
    struct job *j = a.jobs;
    a.jobs = j->next;
    if (!find_homes_in(&a, j->lambda)) return false;
  }
  return true;
}
