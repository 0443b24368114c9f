/* Declares the data and functions that the lowering files share: tasks, queries about the trees of the program's text,
 * new nodes of the lowered tree. */
#ifndef VS_LANGUAGES_TRANSLATE_LOWERING_H
#define VS_LANGUAGES_TRANSLATE_LOWERING_H

#include <stdio.h>
#include <string.h>

#include "languages/translate/core_tree.h"
#include "model/store/array.h"

typedef enum { AS_EXPRESSION, AS_DATUM, AS_TEMPLATE } task_kind;
typedef struct { know_index node; tr_index into; uint8_t kind; } task;
/* A clause of (define name (case-lambda ...)). A call of `symbol` with `arguments` arguments is translated as a call of
 * `variable`. more: the clause also accepts more arguments. */
typedef struct { know_index symbol; tr_index variable; uint32_t arguments; bool more; } case_clause;
typedef struct {
  translation *t;
  knowledge *k;
  task *tasks; size_t count, room;
  case_clause *clauses; size_t clause_count, clause_room;
} lowering;

/* ---- the trees of the text ---- */

static inline know_index next(const lowering *l, know_index n) { return n ? l->k->nodes[n].next : 0; }
static inline bool is_list(const lowering *l, know_index n) { return n && l->k->nodes[n].kind == KNOW_LIST; }
static inline bool is_symbol(const lowering *l, know_index n) { return n && l->k->nodes[n].kind == KNOW_SYMBOL; }
static inline know_index first_of(const lowering *l, know_index n) { return is_list(l, n) ? l->k->nodes[n].first : 0; }

static inline know_index written(const lowering *l, know_index n) {
  while (l->k->nodes[n].origin && !l->k->nodes[n].made) n = l->k->nodes[n].origin;
  return n;
}

/* Returns the form at the node after macro expansion. If a macro uses a node twice, only the first copy was
 * expanded. */
static inline know_index settled(const lowering *l, know_index n) {
  for (;;) {
    know_index w = written(l, n);
    if (!l->k->nodes[n].walked && l->k->nodes[w].walked) n = w;
    if (!l->k->nodes[n].expansion) return n;
    n = l->k->nodes[n].expansion;
  }
}

static inline know_index symbol_of(const lowering *l, know_index n) {
  know_index s = l->k->nodes[n].symbol;
  return s ? s : l->k->nodes[written(l, n)].symbol;
}

/* Returns the word of the form at the node if it is a form of the language, otherwise NULL. */
static inline const char *form_word(const lowering *l, know_index n) {
  if (!is_list(l, n) || !(l->k->nodes[n].form || l->k->nodes[written(l, n)].form)) return NULL;
  know_index s = symbol_of(l, l->k->nodes[n].first);
  return s ? l->k->symbols[s].text : l->k->names[l->k->nodes[l->k->nodes[n].first].name].text;
}

/* Returns the name of the procedure at the node if it is one of the language, otherwise NULL. */
static inline const char *builtin(const lowering *l, know_index n) {
  know_index s = is_symbol(l, n) ? symbol_of(l, n) : 0;
  return s && l->k->symbols[s].kind == KNOW_BUILTIN ? l->k->symbols[s].text : NULL;
}

static inline bool same(const char *a, const char *b) { return a && !strcmp(a, b); }

/* ---- nodes ---- */

static inline void push(lowering *l, know_index n, tr_index into, task_kind kind) {
  if (!into || *l->k->trouble) return;
  if (!n) return;
  if (!VS_GROW(l->tasks, l->room, l->count + 1)) know_fail(l->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  else l->tasks[l->count++] = (task){n, into, (uint8_t)kind};
}
static inline tr_index add(lowering *l, tr_index parent, tr_node_kind kind, know_index source) {
  return tr_node_new(l->t, parent, kind, source);
}
static inline tr_index part(lowering *l, tr_index parent, know_index n) {
  tr_index made = add(l, parent, TR_NOTHING, n);
  push(l, n, made, AS_EXPRESSION);
  return made;
}
static inline void parts(lowering *l, tr_index parent, know_index first) {
  for (know_index i = first; i; i = next(l, i)) part(l, parent, i);
}
static inline tr_node *at(lowering *l, tr_index n) { return &l->t->nodes[n]; }
static inline void become(lowering *l, tr_index into, tr_node_kind kind, const char *text) {
  at(l, into)->kind = (uint8_t)kind, at(l, into)->text = text;
}
static inline tr_index primitive(lowering *l, tr_index parent, const char *name, know_index source) {
  tr_index made = add(l, parent, TR_PRIMITIVE, source);
  at(l, made)->text = name;
  return made;
}
static inline tr_index name(lowering *l, tr_index parent, tr_index variable, know_index source) {
  tr_index made = add(l, parent, TR_NAME, source);
  at(l, made)->variable = variable;
  return made;
}
static inline tr_index number(lowering *l, tr_index parent, const char *text, know_index source) {
  tr_index made = add(l, parent, TR_NUMBER, source);
  at(l, made)->text = text;
  return made;
}
/* Makes the node bind the variable of the symbol at the node `named`. If there is no such symbol, makes a new variable
 * named `fresh`. */
static inline tr_index bind(lowering *l, tr_index node, know_index named, const char *fresh) {
  know_index s = named && is_symbol(l, named) ? symbol_of(l, named) : 0;
  tr_index v = s ? s : tr_variable_new(l->t, fresh ? fresh : named ? l->k->names[l->k->nodes[named].name].text : "x");
  at(l, node)->variable = v;
  if (!l->t->variables[v].define) l->t->variables[v].define = node;
  return v;
}
static inline tr_index define(lowering *l, tr_index parent, know_index named, const char *fresh, know_index source) {
  tr_index d = add(l, parent, TR_DEFINE, source);
  bind(l, d, named, fresh);
  return d;
}
static inline void unable(lowering *l, know_index n, const char *what) { tr_complain_at(l->t, n,
    "%s cannot be translated", what); }

#endif
