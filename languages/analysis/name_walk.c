/* Implements the scopes of the walk through a program: it finds, binds and marks names, and defers parts of the program
 * as tasks. */
#include "languages/analysis/name_walk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/analysis/form_table.h"
#include "languages/script/script_tree.h"
#include "languages/analysis/source_tree.h"
#include "model/store/array.h"

static bool no_memory(knowledge *k) { return know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory"); }

/* ---- tasks ---- */

void know_later(know_walk *w, know_task_kind kind, know_index node, know_index scope) {
  if (!node || *w->k->trouble) return;
  if (!VS_GROW(w->later, w->later_room, w->later_count + 1)) no_memory(w->k);
  else w->later[w->later_count++] = (know_task){node, scope, (uint8_t)kind};
}

void know_later_each(know_walk *w, know_index first, know_index scope) {
  for (know_index i = first; i; i = w->k->nodes[i].next) know_later(w, KNOW_TASK_EXPRESSION, i, scope);
}

void know_later_body(know_walk *w, know_index first, know_index scope) { know_later(w, KNOW_TASK_BODY, first, scope); }

/* ---- marks ---- */

know_index know_written(const knowledge *k, know_index node) {
  while (k->nodes[node].origin && !k->nodes[node].made) node = k->nodes[node].origin;
  return node;
}

void know_mark(knowledge *k, know_index node, know_role role, know_index symbol, know_index scope) {
  for (know_index i = node;; i = k->nodes[i].origin) {
    know_node *n = &k->nodes[i];
    if (i == node || n->role == KNOW_EXPRESSION || n->role == KNOW_OPAQUE ||
        n->role == KNOW_UNBOUND) n->role = (uint8_t)role, n->symbol = symbol, n->scope = scope;
    if (n->made || !n->origin) return;
  }
}

/* Calls `each` for the node and for all nodes below it. */
void know_each_in(knowledge *k, know_index root, void (*each)(knowledge *k, know_index node, void *context),
    void *context) {
  know_index *stack = NULL;
  size_t count = 0, room = 0;
  if (!VS_GROW(stack, room, 1)) {
    no_memory(k);
    return;
  }
  stack[count++] = root;
  while (count && !*k->trouble) {
    know_index node = stack[--count];
    each(k, node, context);
    for (know_index i = k->nodes[node].first; i; i = k->nodes[i].next) {
      if (!VS_GROW(stack, room, count + 1)) {
        no_memory(k);
        break;
      }
      stack[count++] = i;
    }
  }
  free(stack);
}

static void mark_one(knowledge *k, know_index node, void *context) { know_mark(k, node, *(know_role *)context, 0, 0); }
void know_mark_data(knowledge *k, know_index node, know_role role) {
  if (node) know_each_in(k, node, mark_one, &role);
}

/* ---- names ---- */

/* Returns the symbol of the language, or of an imported library, with this name; the interpreter provides its facts. */
static know_index ask_language(know_walk *w, know_index name) {
  knowledge *k = w->k;
  const char *text = k->names[name].text;
  vs_name_info info;
  uint16_t row;
  if (k->script && know_script_word(text, &row)) {
    know_index word = know_symbol_new(k, KNOW_LANGUAGE, name, KNOW_MACRO);
    if (word) k->symbols[word].row = row;
    return word;
  }
  if (!vs_name_get(k->scheme, text, &info)) return 0;
  /* in a script, the analysis does not know how many arguments the language's procedures accept */
  if (k->script) return know_symbol_new(k, KNOW_LANGUAGE, name, KNOW_BUILTIN);
  bool form = !strcmp(info.kind, "form");
  know_index s = know_symbol_new(k, KNOW_LANGUAGE, name, form ? KNOW_MACRO : KNOW_BUILTIN);
  if (!s) return 0;
  k->symbols[s].call = know_text(k, info.call, strlen(info.call));
  k->symbols[s].keywords = know_text(k, info.keywords, strlen(info.keywords));
  k->symbols[s].doc = know_text(k, info.doc, strlen(info.doc));
  if (form) k->symbols[s].row = know_form_row(text);
  return s;
}

know_index know_find(know_walk *w, know_index name, know_index scope) {
  const knowledge *k = w->k;
  for (;;) {
    for (know_index s = scope; s; s = k->scopes[s].parent) {
      know_index found = know_bound_in(k, s, name);
      if (found) return found;
    }
    if (!k->names[name].base) return ask_language(w, name);
    scope = k->names[name].scope;
    name = k->names[name].base;
  }
}

void know_refer(know_walk *w, know_index node, know_index scope, know_role role, bool called) {
  knowledge *k = w->k;
  know_index s = know_find(w, k->nodes[node].name, scope);
  if (!s) {
    if (!VS_GROW(w->unknown, w->unknown_room, w->unknown_count + 1)) no_memory(k);
    else w->unknown[w->unknown_count++] = (know_task){node, scope, (uint8_t)(role | (called ? 64 : 0))};
    know_mark(k, node, role == KNOW_OPAQUE ? KNOW_OPAQUE : KNOW_UNBOUND, 0, scope);
    return;
  }
  know_mark(k, node, role, s, scope);
  know_use_add(k, s, know_written(k, node), role, called);
}

static know_index find_binding_place(const knowledge *k, know_index scope, know_index name) {
  know_index hidden = 0;
  for (know_index s = k->scopes[scope].parent; s > KNOW_LANGUAGE && !hidden;
      s = k->scopes[s].parent) hidden = know_bound_in(k, s, name);
  return hidden;
}

know_index know_bind(know_walk *w, know_index node, know_index scope, know_symbol_kind kind, know_index form) {
  knowledge *k = w->k;
  if (!node || k->nodes[node].kind != KNOW_SYMBOL) return 0;
  know_index s = know_bound_in(k, scope, k->nodes[node].name), written = know_written(k, node);
  bool again = s != 0;
  if (!again) {
    s = know_symbol_new(k, scope, k->nodes[node].name, kind);
    if (!s) return 0;
    k->symbols[s].definition = written;
    k->symbols[s].form = know_written(k, form);
    k->symbols[s].made = k->nodes[written].made;
    k->symbols[s].hides = find_binding_place(k, scope, k->nodes[node].name);
  }
  know_mark(k, node, KNOW_DEFINITION, s, scope);
  know_use_add(k, s, written, KNOW_DEFINITION, false);
  return s;
}

typedef enum { PLAIN, KEYWORD, REST } parameter_mode;

static void parameter(know_walk *w, const know_parameters *p, know_index node, parameter_mode mode, know_arity *arity) {
  knowledge *k = w->k;
  bool keyword = mode == KEYWORD, rest = mode == REST;
  know_index name = node, contract = 0, fallback = 0;
  if (k->nodes[node].kind == KNOW_LIST) {
    name = k->nodes[node].first, contract = know_nth(k, node, 1), fallback = know_nth(k, node, 2);
  }
  know_index s = know_bind(w, name, p->scope, KNOW_PARAMETER, node);
  if (s) {
    k->symbols[s].owner = p->owner;
    k->symbols[s].optional = rest || fallback || keyword;
    k->symbols[s].checked = contract != 0 && !know_is(k, contract, "any?");
    k->symbols[s].parameters = contract;
    k->symbols[s].value = fallback;
  }
  if (contract) know_later(w, KNOW_TASK_EXPRESSION, contract, p->outside);
  if (fallback) know_later(w, KNOW_TASK_EXPRESSION, fallback, p->scope);
  if (rest) arity->most = UINT32_MAX;
  else if (!keyword) {
    if (!fallback) arity->least++;
    if (arity->most != UINT32_MAX) arity->most++;
  }
}

void know_bind_parameters(know_walk *w, const know_parameters *p, know_arity *arity) {
  knowledge *k = w->k;
  know_index list = p->list;
  *arity = (know_arity){.known = true, .keywords = list};
  if (list && k->nodes[list].kind == KNOW_SYMBOL) {
    parameter(w, p, list, REST, arity);
    return;
  }
  bool keyword = false;
  for (know_index i = p->first; i; i = k->nodes[i].next) {
    bool rest = list && k->nodes[list].dotted && !k->nodes[i].next;
    if (k->nodes[i].kind == KNOW_KEYWORD) {
      know_mark(k, i, KNOW_SYNTAX, 0, p->scope);
      arity->any_keyword = true;
      keyword = true;
      continue;
    }
    parameter(w, p, i, rest ? REST : keyword ? KEYWORD : PLAIN, arity);
    keyword = false;
  }
}

/* ---- files ---- */

/* Returns the index of the file to which the string at the node refers. */
know_index know_file_named(know_walk *w, know_index node) {
  char path[KNOW_PATH];
  know_index string = know_written(w->k, node);
  if (!know_find_file(w->k, string, path) || !know_reads(path)) return UINT32_MAX;
  return know_read_file(w->k, path, string);
}

void know_load(know_walk *w, know_index node, know_index scope) {
  know_index file = w->k->nodes[node].kind == KNOW_STRING ? know_file_named(w, node) : UINT32_MAX;
  if (file == UINT32_MAX) w->k->open = true;
  else know_later_body(w, w->k->nodes[w->k->files[file].root].first, scope);
}
