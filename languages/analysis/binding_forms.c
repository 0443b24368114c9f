/* Implements the forms of binding_forms.def: finds the expressions and bindings among a form's parts, and the scope of
 * each binding. */
#include "languages/analysis/binding_forms.h"

#include <stdio.h>
#include <string.h>

typedef struct {
  know_walk *w;
  knowledge *k;
  know_index node, scope;
  know_index head, second, third; /* nodes of the form's first three elements; the first is its word */
} form;

static know_index next(const form *f, know_index node) { return node ? f->k->nodes[node].next : 0; }
static bool is_list(const form *f, know_index node) { return node && f->k->nodes[node].kind == KNOW_LIST; }
static bool is_symbol(const form *f, know_index node) { return node && f->k->nodes[node].kind == KNOW_SYMBOL; }
static know_index first_of(const form *f, know_index node) { return is_list(f, node) ? f->k->nodes[node].first : 0; }
static void one(form *f, know_index node, know_index scope) { know_later(f->w, KNOW_TASK_EXPRESSION, node, scope); }
static void each(form *f, know_index first, know_index scope) { know_later_each(f->w, first, scope); }
static void body(form *f, know_index first, know_index scope) { know_later_body(f->w, first, scope); }
static know_index scope_in(form *f, know_index parent, know_scope_kind kind) { return know_scope_new(f->k, parent,
    kind, f->node); }
static void word(form *f, know_index node) { know_mark(f->k, node, KNOW_SYNTAX, 0, f->scope); }

/* Walks a lambda: its parameters, which are the elements of `list` from `first` on, and the forms of its body. */
static void lambda_into(form *f, know_index list, know_index first, know_index forms, know_index scope,
                        know_arity *arity) {
  know_index inner = know_scope_new(f->k, scope, KNOW_SCOPE_PROCEDURE, f->node);
  know_bind_parameters(f->w, &(know_parameters){list, first, inner, scope, 0}, arity);
  body(f, forms, inner);
}

/* ---- forms without bindings, or with local ones ---- */

static void walk_DATA(form *f) {
  for (know_index i = f->second; i; i = next(f, i)) know_mark_data(f->k, i, KNOW_DATUM);
}

/* Walks a quasiquote template. Expressions after , and ,@ at the template's own level are evaluated. A stack of nodes
 * counts nested levels. */
static void walk_QUASI(form *f) {
  enum { MOST = 200 };
  struct { know_index at; int level; } stack[MOST];
  int count = 0;
  stack[count].at = f->second, stack[count++].level = 1;
  while (count) {
    know_index at = stack[count - 1].at;
    int level = stack[count - 1].level;
    if (!at) {
      count--;
      continue;
    }
    stack[count - 1].at = next(f, at);
    know_mark(f->k, at, KNOW_DATUM, 0, f->scope);
    know_index head = f->k->nodes[at].first;
    if (!head) continue;
    bool out = know_is(f->k, head, "unquote") || know_is(f->k, head, "unquote-splicing");
    if (out && level == 1) {
      word(f, head);
      each(f, next(f, head), f->scope);
    } else if (count < MOST) {
      stack[count].at = head;
      stack[count++].level = level + (know_is(f->k, head, "quasiquote") ? 1 : out ? -1 : 0);
    } else know_mark_data(f->k, at, KNOW_OPAQUE);
  }
}

static void walk_PARTS(form *f) { each(f, f->second, f->scope); }
static void walk_SEQUENCE(form *f) { body(f, f->second, f->scope); }
static void walk_TEST_BODY(form *f) {
  one(f, f->second, f->scope);
  body(f, f->third, f->scope);
}
static void walk_SET(form *f) {
  if (is_symbol(f, f->second)) know_refer(f->w, f->second, f->scope, KNOW_ASSIGNMENT, false);
  each(f, f->third, f->scope);
}
static void walk_ASSIGNED(form *f) { /* walks (parameterize ([parameter value] ...) body ...) */
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) each(f, first_of(f, i), f->scope);
  body(f, f->third, f->scope);
}
static void walk_SLOTS(form *f) {
  for (know_index i = f->second; i; i = next(f, i))
    if (know_is(f->k, i, "<>") || know_is(f->k, i, "<...>")) word(f, i);
    else one(f, i, f->scope);
}
static void walk_FLAGS(form *f) { /* walks '(name (name test)), where the tests are expressions */
  one(f, f->second, f->scope);
  know_index quoted = know_nth(f->k, f->third, 1);
  if (is_list(f, f->third) && know_is(f->k, first_of(f, f->third), "quote") && is_list(f, quoted)) {
    word(f, first_of(f, f->third));
    for (know_index i = first_of(f, quoted); i; i = next(f, i)) {
      know_mark(f->k, is_list(f, i) ? first_of(f, i) : i, KNOW_DATUM, 0, f->scope);
      if (is_list(f, i)) each(f, next(f, first_of(f, i)), f->scope);
    }
  } else one(f, f->third, f->scope);
  each(f, next(f, f->third), f->scope);
}

/* Walks a clause of cond or case: (test value ...), (test => procedure) or (else value ...). data: the test is data, as
 * in case. */
static void clause(form *f, know_index node, know_index scope, bool data) {
  know_index test = first_of(f, node), value = next(f, test);
  if (!test) return;
  if (know_is(f->k, test, "else")) word(f, test);
  else if (data) know_mark_data(f->k, test, KNOW_DATUM);
  else one(f, test, scope);
  if (know_is(f->k, value, "=>")) {
    word(f, value);
    each(f, next(f, value), scope);
  } else if (value) body(f, value, scope);
}
static void clauses(form *f, know_index first, know_index scope, bool data) {
  for (know_index i = first; i; i = next(f, i)) clause(f, i, scope, data);
}
static void walk_COND(form *f) { clauses(f, f->second, f->scope, false); }
static void walk_CASE(form *f) {
  one(f, f->second, f->scope);
  clauses(f, f->third, f->scope, true);
}
static void walk_CASE_STAR(form *f) {
  one(f, f->second, f->scope);
  clauses(f, f->third, f->scope, false);
}
static void walk_COND_EXPAND(form *f) {
  for (know_index i = f->second; i; i = next(f, i)) {
    know_mark_data(f->k, first_of(f, i), KNOW_SYNTAX);
    body(f, next(f, first_of(f, i)), f->scope);
  }
}

/* ---- procedures ---- */

static void walk_LAMBDA(form *f) {
  know_arity arity;
  lambda_into(f, f->second, first_of(f, f->second), f->third, f->scope, &arity);
}
static void walk_CASE_LAMBDA(form *f) {
  know_arity arity;
  for (know_index i = f->second; i; i = next(f, i)) {
    know_index list = first_of(f, i);
    if (list) lambda_into(f, list, first_of(f, list), next(f, list), f->scope, &arity);
  }
}
static void walk_ESCAPE(form *f) { /* walks (let/ec k body ...) */
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET);
  know_bind(f->w, f->second, inner, KNOW_LOCAL, f->second);
  body(f, f->third, inner);
}
static void walk_REC(form *f) {
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET);
  if (is_list(f, f->second)) {
    know_arity arity;
    know_index name = first_of(f, f->second);
    know_bind(f->w, name, inner, KNOW_FUNCTION, f->node);
    lambda_into(f, f->second, next(f, name), f->third, inner, &arity);
  } else {
    know_bind(f->w, f->second, inner, KNOW_LOCAL, f->node);
    each(f, f->third, inner);
  }
}

/* Records facts about a defined symbol from the node of its value. If the value is a lambda, the symbol's parameters
 * are those of the lambda. Returns true if it is one. */
static bool describe(form *f, know_index symbol, know_index value) {
  knowledge *k = f->k;
  know_symbol *s = &k->symbols[symbol];
  if (!symbol) return false;
  if (!s->value) s->value = value;
  know_index head = first_of(f, value);
  if (!is_symbol(f, head) || !(know_is(k, head, "lambda") || know_is(k, head, "\316\273"))) return false;
  if (s->kind == KNOW_VARIABLE || s->kind == KNOW_LOCAL) s->kind = KNOW_FUNCTION;
  know_index list = next(f, head);
  s->parameters = list, s->body = next(f, list);
  return true;
}

/* ---- lets ---- */

static know_index bind_clause(form *f, know_index i, know_index scope, know_symbol_kind kind) {
  know_index name = is_list(f, i) ? first_of(f, i) : i, s = know_bind(f->w, name, scope, kind, i);
  if (is_list(f, i)) describe(f, s, next(f, name));
  return s;
}
static void walk_LET(form *f) {
  know_index list = f->second, forms = f->third, outer = f->scope, loop = 0;
  if (is_symbol(f, list)) { /* a named let: (let name ([variable start] ...) body ...) */
    outer = scope_in(f, f->scope, KNOW_SCOPE_LOOP);
    loop = know_bind(f->w, list, outer, KNOW_LOOP, f->node);
    list = f->third, forms = next(f, f->third);
  }
  for (know_index i = first_of(f, list); i; i = next(f, i)) each(f, next(f, first_of(f, i)), f->scope);
  know_index inner = know_scope_new(f->k, outer, loop ? KNOW_SCOPE_PROCEDURE : KNOW_SCOPE_LET, f->node);
  uint32_t count = 0;
  for (know_index i = first_of(f, list); i; i = next(f, i), count++) {
    know_index s = bind_clause(f, i, inner, loop ? KNOW_LOOP_VARIABLE : KNOW_LOCAL);
    if (loop && s) f->k->symbols[s].owner = loop;
  }
  if (loop) {
    know_symbol *s = &f->k->symbols[loop];
    s->arity = (know_arity){.least = count, .most = count, .known = true};
    s->parameters = list, s->body = forms;
  }
  body(f, forms, inner);
}
static void walk_LET_STAR(form *f) {
  know_index scope = f->scope;
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) {
    each(f, next(f, first_of(f, i)), scope);
    scope = scope_in(f, scope, KNOW_SCOPE_LET);
    bind_clause(f, i, scope, KNOW_LOCAL);
  }
  body(f, f->third, scope);
}
static void walk_LETREC(form *f) {
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) bind_clause(f, i, inner, KNOW_LOCAL);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) each(f, next(f, first_of(f, i)), inner);
  body(f, f->third, inner);
}
static void macro(form *f, know_index name, know_index value, know_index scope, bool rules) {
  know_index s = know_bind(f->w, name, scope, KNOW_MACRO, f->node);
  if (s) f->k->symbols[s].value = value, f->k->symbols[s].rules = rules;
  know_mark_data(f->k, value, KNOW_DATUM);
}
static void walk_LET_SYNTAX(form *f) {
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_SYNTAX);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) macro(f, first_of(f, i), next(f, first_of(f, i)),
      inner, false);
  body(f, f->third, inner);
}
static void formals(form *f, know_index node, know_index scope, know_symbol_kind kind, know_index where) {
  if (is_symbol(f, node)) know_bind(f->w, node, scope, kind, where);
  else
    for (know_index i = first_of(f, node); i; i = next(f, i)) know_bind(f->w, is_list(f, i) ? first_of(f, i) : i,
        scope, kind, where);
}
static void walk_LET_VALUES(form *f) {
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) each(f, next(f, first_of(f, i)), f->scope);
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) formals(f, first_of(f, i), inner, KNOW_LOCAL, i);
  body(f, f->third, inner);
}
static void walk_LET_STAR_VALUES(form *f) {
  know_index scope = f->scope;
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) {
    each(f, next(f, first_of(f, i)), scope);
    scope = scope_in(f, scope, KNOW_SCOPE_LET);
    formals(f, first_of(f, i), scope, KNOW_LOCAL, i);
  }
  body(f, f->third, scope);
}
static void walk_RECEIVE(form *f) {
  one(f, f->third, f->scope);
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET);
  formals(f, f->second, inner, KNOW_LOCAL, f->node);
  body(f, next(f, f->third), inner);
}
static void walk_AND_LET(form *f) {
  know_index scope = f->scope;
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) {
    know_index name = first_of(f, i);
    if (!is_list(f, i)) one(f, i, scope);
    else if (f->k->nodes[i].count == 1) one(f, name, scope);
    else {
      each(f, next(f, name), scope);
      scope = scope_in(f, scope, KNOW_SCOPE_LET);
      bind_clause(f, i, scope, KNOW_LOCAL);
    }
  }
  body(f, f->third, scope);
}

/* ---- loops ---- */

static void walk_DO(form *f) { /* walks (do ([name start step] ...) (test result ...) body ...) */
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LOOP);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) one(f, next(f, first_of(f, i)), f->scope);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) {
    know_index s = know_bind(f->w, first_of(f, i), inner, KNOW_LOOP_VARIABLE, i);
    if (s) f->k->symbols[s].value = know_nth(f->k, i, 1);
  }
  each(f, first_of(f, f->third), inner);
  body(f, next(f, f->third), inner);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) one(f, know_nth(f->k, i, 2), inner);
}

/* Walks the clauses of a loop, [name sequence] and #:when test, and returns the scope of the loop's body. In a `for`, a
 * clause cannot use the name of another clause, but here it may: this does not change which names are used. */
static know_index sequences(form *f, know_index list, know_index scope) {
  bool guard = false; /* whether the next element is the test after #:when or #:unless */
  for (know_index i = first_of(f, list); i; i = next(f, i)) {
    bool test = guard;
    guard = f->k->nodes[i].kind == KNOW_KEYWORD;
    if (guard) word(f, i);
    else if (test || !is_list(f, i)) one(f, i, scope);
    else {
      know_index name = first_of(f, i);
      each(f, next(f, name), scope);
      scope = scope_in(f, scope, KNOW_SCOPE_LOOP);
      formals(f, name, scope, KNOW_LOOP_VARIABLE, i);
    }
  }
  return scope;
}
static void walk_FOR(form *f) { body(f, f->third, sequences(f, f->second, f->scope)); }
static void walk_FOR_FOLD(form *f) {
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) each(f, next(f, first_of(f, i)), f->scope);
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET);
  for (know_index i = first_of(f, f->second); i; i = next(f, i)) {
    know_index s = know_bind(f->w, first_of(f, i), inner, KNOW_LOOP_VARIABLE, i);
    if (s) know_use_add(f->k, s, know_written(f->k, first_of(f, i)), KNOW_REFERENCE, false);
        /* the value of the body's last form is part of the loop's value */
  }
  body(f, next(f, f->third), sequences(f, f->third, inner));
}
static void walk_GUARD(form *f) { /* walks (guard (name clause ...) body ...) */
  know_index inner = scope_in(f, f->scope, KNOW_SCOPE_LET), name = first_of(f, f->second);
  know_index s = know_bind(f->w, name, inner, KNOW_LOCAL, f->second);
  /* s is the name of the caught error; catching the error counts as a use of this name */
  if (s) know_use_add(f->k, s, know_written(f->k, name), KNOW_REFERENCE, false);
  clauses(f, next(f, name), inner, false);
  body(f, f->third, f->scope);
}

/* ---- definitions ---- */

static void walk_DEFINE(form *f) {
  know_index target = f->second, forms = f->third;
  knowledge *k = f->k;
  if (is_symbol(f, target)) {
    know_index s = know_bind(f->w, target, f->scope, KNOW_VARIABLE, f->node);
    if (describe(f, s, forms)) { /* counts the lambda's parameters without binding them, because the walk of the lambda
                                  * binds them */
      know_arity a = {.known = true, .keywords = k->symbols[s].parameters};
      know_index list = k->symbols[s].parameters;
      if (is_symbol(f, list)) a.most = UINT32_MAX;
      bool keyword = false;
      for (know_index i = first_of(f, list); i; i = next(f, i)) {
        if (k->nodes[i].kind == KNOW_KEYWORD) {
          keyword = a.any_keyword = true;
          continue;
        }
        if (k->nodes[list].dotted && !next(f, i)) a.most = UINT32_MAX;
        else if (!keyword) {
          if (!is_list(f, i) || !know_nth(k, i, 2)) a.least++;
          if (a.most != UINT32_MAX) a.most++;
        }
        keyword = false;
      }
      k->symbols[s].arity = a;
    }
    each(f, forms, f->scope);
    return;
  }
  if (!is_list(f, target)) return;
  know_index list = target, name = first_of(f, target), outer = 0;
  /* the curried form ((f a) b) defines a procedure that returns procedures */
  while (is_list(f, name)) outer = list, list = name, name = first_of(f, name);
  know_index s = know_bind(f->w, name, f->scope, KNOW_FUNCTION, f->node);
  know_index scope = know_scope_new(k, f->scope, KNOW_SCOPE_PROCEDURE, f->node);
  know_arity arity;
  know_bind_parameters(f->w, &(know_parameters){list, next(f, name), scope, f->scope, s}, &arity);
  if (s) {
    know_symbol *y = &k->symbols[s];
    y->arity = arity, y->parameters = list, y->body = forms;
    if (forms && k->nodes[forms].kind == KNOW_STRING && next(f, forms)) y->doc_string = forms;
  }
  while (outer) {
    scope = know_scope_new(k, scope, KNOW_SCOPE_PROCEDURE, f->node);
    know_bind_parameters(f->w, &(know_parameters){outer, next(f, first_of(f, outer)), scope, scope, 0}, &arity);
    know_index up = 0; /* up: innermost list that contains the defined name */
    for (know_index i = target; i != outer; i = first_of(f, i)) up = i;
    outer = up;
  }
  body(f, forms, scope);
}
/* Walks (define-function (f x ...) #:x (from to steps) expression): the ranges are lists of expressions. */
static void walk_DEFINE_FUNCTION(form *f) {
  know_index name = first_of(f, f->second), expression = 0;
  if (!is_symbol(f, name)) {
    walk_DEFINE(f);
    return;
  }
  know_index s = know_bind(f->w, name, f->scope, KNOW_FUNCTION, f->node);
  know_index scope = know_scope_new(f->k, f->scope, KNOW_SCOPE_PROCEDURE, f->node);
  know_arity arity;
  know_bind_parameters(f->w, &(know_parameters){f->second, next(f, name), scope, f->scope, s}, &arity);
  for (know_index i = f->third; i; i = next(f, i)) {
    know_index range = next(f, i);
    if (f->k->nodes[i].kind != KNOW_KEYWORD) {
      expression = i;
      one(f, i, scope);
    } else if (is_list(f, range)) {
      know_mark(f->k, range, KNOW_SYNTAX, 0, f->scope);
      each(f, first_of(f, range), f->scope);
      i = range;
    }
  }
  if (s) f->k->symbols[s].arity = arity, f->k->symbols[s].parameters = f->second, f->k->symbols[s].body = expression;
}
static void walk_DEFINE_VALUES(form *f) {
  formals(f, f->second, f->scope, KNOW_VARIABLE, f->node);
  each(f, f->third, f->scope);
}
/* Returns a name composed of a, b and c, such as that of an accessor. The text does not contain this name, so its place
 * is that of the name in the form. */
static know_index derived(form *f, know_index place, const char *a, const char *b, const char *c) {
  char text[256];
  know_index scope = f->scope;
  int n = snprintf(text, sizeof text, "%s%s%s", a, b, c);
  know_index name = n > 0 && n < (int)sizeof text ? know_name_of(f->k, text, (size_t)n, 0, 0) : 0;
  if (!name || know_bound_in(f->k, scope, name)) return 0;
  know_index s = know_symbol_new(f->k, scope, name, KNOW_FIELD);
  if (!s) return 0;
  f->k->symbols[s].definition = know_written(f->k, place);
  f->k->symbols[s].form = know_written(f->k, f->node);
  f->k->symbols[s].made = true;
  know_use_add(f->k, s, know_written(f->k, place), KNOW_DEFINITION, false);
  return s;
}
static const char *text_of(const form *f, know_index node) { return f->k->names[f->k->nodes[node].name].text; }

static void walk_DEFINE_RECORD(form *f) {
  know_index type = is_list(f, f->second) ? first_of(f, f->second) : f->second, maker = f->third, predicate = next(f,
      maker), fields = 0;
  know_bind(f->w, type, f->scope, KNOW_FIELD, f->node);
  if (is_list(f, maker)) {
    know_index s = know_bind(f->w, first_of(f, maker), f->scope, KNOW_FIELD, f->node);
    for (know_index i = next(f, first_of(f, maker)); i; i = next(f, i)) fields++, know_mark(f->k, i, KNOW_DATUM, 0,
        f->scope);
    if (s) f->k->symbols[s].arity = (know_arity){.least = fields, .most = fields, .known = true},
        f->k->symbols[s].parameters = maker;
  } else know_bind(f->w, maker, f->scope, KNOW_FIELD, f->node);
  know_bind(f->w, predicate, f->scope, KNOW_FIELD, f->node);
  for (know_index i = next(f, predicate); i; i = next(f, i)) {
    if (!is_list(f, i)) continue;
    know_mark(f->k, first_of(f, i), KNOW_DATUM, 0, f->scope);
    know_index get = know_nth(f->k, i, 1), set = know_nth(f->k, i, 2);
    know_index s = know_bind(f->w, get, f->scope, KNOW_FIELD, f->node);
    if (s) f->k->symbols[s].arity = (know_arity){.least = 1, .most = 1, .known = true};
    s = know_bind(f->w, set, f->scope, KNOW_FIELD, f->node);
    if (s) f->k->symbols[s].arity = (know_arity){.least = 2, .most = 2, .known = true};
  }
}
static void walk_STRUCT(form *f) {
  if (!is_symbol(f, f->second)) return;
  const char *type = text_of(f, f->second);
  uint32_t fields = f->k->nodes[f->third].count;
  know_index s = 0;
  know_arity all = {.least = fields, .most = fields, .known = true}, one_each = {.least = 1, .most = 1, .known = true};
  if (know_is(f->k, f->head, "struct")) s = know_bind(f->w, f->second, f->scope, KNOW_FIELD, f->node);
  else know_mark(f->k, f->second, KNOW_DATUM, 0, f->scope), s = derived(f, f->second, "make-", type, "");
  if (s) f->k->symbols[s].arity = all, f->k->symbols[s].parameters = f->third;
  if ((s = derived(f, f->second, type, "?", "")) != 0) f->k->symbols[s].arity = one_each;
  for (know_index i = first_of(f, f->third); i; i = next(f, i)) {
    know_index field = is_list(f, i) ? first_of(f, i) : i;
    if (!is_symbol(f, field)) continue;
    know_mark(f->k, field, KNOW_DATUM, 0, f->scope);
    if ((s = derived(f, field, type, "-", text_of(f, field))) != 0) f->k->symbols[s].arity = one_each;
    char setter[256];
    snprintf(setter, sizeof setter, "set-%s-%s!", type, text_of(f, field));
    s = derived(f, field, setter, "", "");
    if (s) f->k->symbols[s].arity = (know_arity){.least = 2, .most = 2, .known = true};
  }
}
static void walk_DEFINE_SYNTAX(form *f) {
  bool rule = is_list(f, f->second);
  if (rule) {
    know_mark_data(f->k, f->second, KNOW_DATUM);
    macro(f, first_of(f, f->second), f->second, f->scope, true);
    know_mark_data(f->k, f->third, KNOW_DATUM);
    know_index s = know_bound_in(f->k, f->scope, f->k->nodes[first_of(f, f->second)].name);
    know_mark(f->k, first_of(f, f->second), KNOW_DEFINITION, s, f->scope);
  } else macro(f, f->second, f->third, f->scope, false);
}
static void walk_DEFINE_PARAMETER(form *f) {
  know_index s = know_bind(f->w, f->second, f->scope, KNOW_MODEL_PARAMETER, f->node);
  if (s && !f->k->symbols[s].value) f->k->symbols[s].value = f->third;
  each(f, f->third, f->scope);
}
static void walk_DEFINE_PRIMITIVE(form *f) {
  bool called = is_list(f, f->second);
  know_index name = called ? first_of(f, f->second) : f->second;
  if (!is_symbol(f, name)) return;
  const char *plain = text_of(f, name);
  know_index scope = know_scope_new(f->k, f->scope, KNOW_SCOPE_PROCEDURE, f->node), s;
  know_arity arity;
  if (called) s = know_bind(f->w, name, f->scope, KNOW_FUNCTION, f->node);
  else know_mark(f->k, name, KNOW_DATUM, 0, f->scope), s = derived(f, name, "make-", plain, "");
  know_index fields = called ? next(f, name) : f->third;
  know_bind_parameters(f->w, &(know_parameters){called ? f->second : 0, fields, scope, f->scope, s}, &arity);
  if (s) f->k->symbols[s].arity = arity, f->k->symbols[s].parameters = called ? f->second : 0,
      f->k->symbols[s].body = called ? f->third : 0;
  derived(f, name, plain, "?", "");
  for (know_index i = fields; i; i = next(f, i)) {
    know_index field = is_list(f, i) ? first_of(f, i) : i;
    if (!is_symbol(f, field) || f->k->nodes[i].kind == KNOW_KEYWORD) continue;
    derived(f, field, plain, "-", text_of(f, field));
    know_index p = know_bound_in(f->k, scope, f->k->nodes[field].name);
    /* the object stores the value of the field's parameter, which counts as a use */
    if (p) know_use_add(f->k, p, know_written(f->k, field), KNOW_REFERENCE, false);
  }
  if (called) body(f, f->third, scope);
}
/* Walks (define-rule (name [self scope?] ...) clause or definition ...). In a clause, (=> call ...) divides the scope.
 * Each of these calls receives the scope as its first argument, which the text does not contain. */
static void rule_parts(form *f, know_index node, know_index scope) {
  for (know_index i = first_of(f, node); i; i = next(f, i)) {
    know_index head = first_of(f, i);
    if (f->k->nodes[i].kind == KNOW_KEYWORD || know_is(f->k, i, "=>")) word(f, i);
    else if (is_symbol(f, head) && !know_is(f->k, head, "quote") && know_is(f->k, first_of(f, node), "=>")) {
      know_mark(f->k, i, KNOW_SYNTAX, 0, scope); /* marks the call: it has one argument more than its text shows */
      one(f, head, scope); /* adds the expression as a task, to be walked when the forms after the rule have defined
                            * their names */
      each(f, next(f, head), scope);
    } else one(f, i, scope);
  }
}
static void walk_DEFINE_RULE(form *f) {
  know_index name = first_of(f, f->second);
  if (!is_symbol(f, name)) return;
  know_index s = know_bind(f->w, name, f->scope, KNOW_RULE, f->node), scope = know_scope_new(f->k, f->scope,
      KNOW_SCOPE_PROCEDURE, f->node);
  know_arity arity;
  know_bind_parameters(f->w, &(know_parameters){f->second, next(f, name), scope, f->scope, s}, &arity);
  know_index self = next(f, name), self_name = is_list(f, self) ? first_of(f, self) : self;
  know_index p = is_symbol(f, self_name) ? know_bound_in(f->k, scope, f->k->nodes[self_name].name) : 0;
  if (p) know_use_add(f->k, p, know_written(f->k, self_name), KNOW_REFERENCE, false);
  if (s) f->k->symbols[s].parameters = f->second, f->k->symbols[s].body = f->third;
      /* the rule can also be called without `self`, so its number of arguments is not checked */
  know_index inner = know_scope_new(f->k, scope, KNOW_SCOPE_BODY, f->node);
  for (know_index i = f->third; i; i = next(f, i)) {
    know_index head = first_of(f, i);
    bool defines = is_symbol(f, head) && (know_is(f->k, head, "define") || know_is(f->k, head, "define-rule"));
    if (defines) know_bind(f->w, is_list(f, know_nth(f->k, i, 1)) ? first_of(f, know_nth(f->k, i, 1)) : know_nth(f->k,
        i, 1), inner,
                           know_is(f->k, head, "define") && !is_list(f, know_nth(f->k, i,
                               1)) ? KNOW_VARIABLE : KNOW_RULE, i);
  }
  for (know_index i = f->third; i; i = next(f, i)) {
    know_index head = first_of(f, i);
    if (know_is(f->k, head, "=>")) rule_parts(f, i, inner);
    else if (is_list(f, i) && (is_list(f, head) || (head && f->k->nodes[head].kind == KNOW_KEYWORD))) {
      for (know_index c = head; c; c = next(f, c)) {
        if (f->k->nodes[c].kind == KNOW_KEYWORD) word(f, c);
        else if (know_is(f->k, first_of(f, c), "=>")) rule_parts(f, c, inner);
        else one(f, c, inner);
      }
    } else one(f, i, inner);
  }
}
static void walk_BACK_END(form *f) {
  if (is_symbol(f, f->second)) know_mark(f->k, f->second, KNOW_DATUM, 0, f->scope);
  else one(f, f->second, f->scope);
  each(f, f->third, f->scope);
}

/* ---- the structure of a program ---- */

static void walk_IMPORT(form *f) {
  knowledge *k = f->k;
  for (know_index i = f->second; i; i = next(f, i)) know_mark_data(k, i, KNOW_SYNTAX);
  know_index written = know_written(k, f->node);
  size_t n;
  const char *text = know_spelling(k, written, &n);
  k->muted = true;
  vs_outcome outcome = vs_eval_text(k->scheme, k->files[k->nodes[written].at.file].path, 1, text, n,
      f->w->begun ? 0 : VS_EVAL_PROGRAM);
  k->muted = false;
  f->w->begun = true;
  if (outcome != VS_OUTCOME_DONE) k->open = true; /* the import failed: the library may be one that the program
                                                   * defines */
}
static void walk_LIBRARY(form *f) {
  know_mark_data(f->k, f->second, KNOW_SYNTAX);
  know_index scope = know_scope_new(f->k, f->scope, KNOW_SCOPE_BODY, f->node);
  f->k->open = f->k->library = true;
  for (know_index i = f->third; i; i = next(f, i)) {
    know_index head = first_of(f, i);
    if (know_is(f->k, head, "begin")) word(f, head), know_later(f->w, KNOW_TASK_BODY, next(f, head), scope);
    else if (know_is(f->k, head, "include")) word(f, head), know_load(f->w, next(f, head), scope);
    else if (know_is(f->k, head, "export")) {
      word(f, head);
      for (know_index e = next(f, head); e; e = next(f, e)) {
        know_index inner = is_list(f, e) ? know_nth(f->k, e, 1) : e;
        if (is_symbol(f, inner)) know_refer(f->w, inner, scope, KNOW_REFERENCE, false);
      }
    } else know_mark_data(f->k, i, KNOW_SYNTAX);
  }
}
static void walk_LOAD(form *f) {
  for (know_index i = f->second; i; i = next(f, i))
    if (f->k->nodes[i].kind == KNOW_STRING) know_load(f->w, i, f->scope);
    else know_mark_data(f->k, i, KNOW_SYNTAX);
}
static void walk_PROVIDE(form *f) {
  for (know_index i = f->second; i; i = next(f, i))
    if (is_symbol(f, i)) know_refer(f->w, i, f->scope, KNOW_REFERENCE, false);
    else know_mark_data(f->k, i, KNOW_SYNTAX);
}

/* ---- the table ---- */

static const struct { const char *name; void (*walk)(form *f); } rows[] = {
#define KNOW_FORM(name, shape) {name, walk_##shape},
#include "languages/analysis/binding_forms.def"
};

void know_form_walk(know_walk *w, know_index node, know_index scope, uint16_t row) {
  form f = {w, w->k, node, scope, w->k->nodes[node].first, know_nth(w->k, node, 1), know_nth(w->k, node, 2)};
  rows[row - 1].walk(&f);
}

void know_form_declare(know_walk *w, know_index node, know_index scope, uint16_t row) { know_form_walk(w, node, scope,
    row); }
