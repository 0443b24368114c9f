/* Walks through a program and finds the meanings of its names.
 *
 * A stack contains tasks: an expression in a scope, or a body. In a body, the walk first searches for definitions, and
 * expands macros at the heads of the forms, so that each name is known wherever it is used. The file binding_forms.c
 * implements the effect of each form on names. A name without a known definition is searched again at the end. */
#include "languages/analysis/resolve_names.h"

#include <stdlib.h>
#include <string.h>

#include "languages/analysis/binding_forms.h"
#include "languages/analysis/form_table.h"
#include "languages/analysis/macro_rules.h"
#include "languages/analysis/name_walk.h"
#include "languages/analysis/source_tree.h"
#include "model/store/array.h"

static bool no_memory(knowledge *k) { return know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory"); }

/* Moves the tasks that the current form has deferred to the stack, so that they run in the form's order. */
static void flush(know_walk *w) {
  if (!VS_GROW(w->tasks, w->task_room, w->task_count + w->later_count)) {
    no_memory(w->k);
    return;
  }
  while (w->later_count) w->tasks[w->task_count++] = w->later[--w->later_count];
}

/* ---- macros ---- */

struct opaque_context { know_walk *w; know_index scope; };

static void opaque_one(knowledge *k, know_index node, void *context) {
  struct opaque_context *c = context;
  if (k->nodes[node].kind == KNOW_SYMBOL && k->nodes[node].role == KNOW_EXPRESSION) know_refer(c->w, node, c->scope,
      KNOW_OPAQUE, false);
}

static void opaque(know_walk *w, know_index node, know_index scope) {
  struct opaque_context context = {w, scope};
  w->k->open = true;
  for (know_index i = w->k->nodes[w->k->nodes[node].first].next; i; i = w->k->nodes[i].next) know_each_in(w->k, i,
      opaque_one, &context);
}

/* Expands the program's own macros at the head of the node. Returns the resulting node, or 0 if no further walk is
 * necessary. *row is the row of binding_forms.def if the result is a form of the language. */
static know_index settle(know_walk *w, know_index node, know_index scope, uint16_t *row) {
  knowledge *k = w->k;
  *row = 0;
  while (!*k->trouble && k->nodes[node].kind == KNOW_LIST) {
    know_index head = k->nodes[node].first;
    if (!head || k->nodes[head].kind != KNOW_SYMBOL) return node;
    know_index s = know_find(w, k->nodes[head].name, scope);
    if (!s || k->symbols[s].kind != KNOW_MACRO) return node;
    if (k->symbols[s].row) {
      know_mark(k, head, KNOW_SYNTAX, s, scope);
      know_use_add(k, s, know_written(k, head), KNOW_SYNTAX, false);
      k->nodes[node].form = *row = k->symbols[s].row;
      k->nodes[know_written(k, node)].form = *row;
      return node;
    }
    know_refer(w, head, scope, KNOW_REFERENCE, true);
    know_index out = 0;
    if (!know_macro_expand(w, s, node, scope, &out)) {
      opaque(w, node, scope);
      return 0;
    }
    know_index use = know_written(k, node);
    k->nodes[node].expansion = out;
    k->nodes[use].expansion = out;
    if (!k->nodes[out].parent) k->nodes[out].parent = k->nodes[node].parent;
    node = out;
  }
  return *k->trouble ? 0 : node;
}

/* ---- expressions and bodies ---- */

static void expression(know_walk *w, know_index node, know_index scope) {
  knowledge *k = w->k;
  know_index written = know_written(k, node);
  /* a macro has used this node of the text twice, and it was already walked */
  if (k->nodes[written].walked && k->nodes[written].kind != KNOW_SYMBOL) return;
  k->nodes[node].walked = k->nodes[written].walked = true;
  if (k->nodes[node].role != KNOW_SYNTAX) k->nodes[node].scope = k->nodes[written].scope = scope;
  uint16_t row;
  node = settle(w, node, scope, &row);
  if (!node) return;
  if (k->nodes[node].kind == KNOW_KEYWORD) {
    know_mark(k, node, KNOW_SYNTAX, 0, scope);
    return;
  }
  if (k->nodes[node].kind == KNOW_SYMBOL) {
    know_refer(w, node, scope, KNOW_REFERENCE, false);
    return;
  }
  if (k->nodes[node].kind == KNOW_VECTOR) {
    know_mark_data(k, node, KNOW_DATUM);
    return;
  }
  if (k->nodes[node].kind != KNOW_LIST) return;
  k->nodes[node].scope = scope;
  if (row) {
    if (know_form_defines(row)) know_form_declare(w, node, scope, row);
    else know_form_walk(w, node, scope, row);
    return;
  }
  know_index head = k->nodes[node].first;
  if (!head) return;
  if (k->nodes[head].kind == KNOW_SYMBOL) know_refer(w, head, scope, KNOW_REFERENCE, true);
  else know_later(w, KNOW_TASK_EXPRESSION, head, scope);
  know_later_each(w, k->nodes[head].next, scope);
}

static bool is_load(const knowledge *k, know_index node) {
  return know_is(k, k->nodes[node].first, "load") && k->nodes[node].count >= 2 && k->nodes[know_nth(k, node,
      1)].kind == KNOW_STRING;
}

typedef struct { know_index *at; size_t count, room; } cursors;

static void follow(knowledge *k, cursors *c, know_index first) {
  if (!first) return;
  if (!VS_GROW(c->at, c->room, c->count + 1)) no_memory(k);
  else c->at[c->count++] = first;
}

/* Walks a body: binds its definitions at once, and defers all expressions. */
static void body(know_walk *w, know_index first, know_index scope) {
  knowledge *k = w->k;
  cursors c = {0};
  follow(k, &c, first);
  while (c.count && !*k->trouble) {
    know_index node = c.at[c.count - 1];
    if (!node) {
      c.count--;
      continue;
    }
    c.at[c.count - 1] = k->nodes[node].next;
    know_index written = know_written(k, node);
    if (k->nodes[written].walked && k->nodes[written].kind == KNOW_LIST) continue;
    k->nodes[written].statement = k->nodes[node].statement = true;
    k->nodes[written].scope = k->nodes[node].scope = scope;
    uint16_t row = 0;
    know_index settled = settle(w, node, scope, &row);
    if (!settled) {
      k->nodes[written].walked = true;
      continue;
    }
    know_index second = know_nth(k, settled, 1);
    if (row && know_form_splices(row)) {
      k->nodes[written].walked = k->nodes[settled].walked = true;
      k->nodes[settled].scope = scope;
      follow(k, &c, second);
    } else if (row && know_form_defines(row)) {
      k->nodes[written].walked = k->nodes[settled].walked = true;
      k->nodes[settled].scope = scope;
      bool loads = know_form_row("include") == row || know_form_row("require") == row ||
          know_form_row("include-ci") == row;
      if (!loads) know_form_declare(w, settled, scope, row);
      for (know_index i = loads ? second : 0; i; i = k->nodes[i].next) {
        if (k->nodes[i].kind != KNOW_STRING) continue;
        know_index file = know_file_named(w, i);
        if (file != UINT32_MAX) follow(k, &c, k->nodes[k->files[file].root].first);
        else k->open = true;
      }
    } else {
      if (!row && is_load(k, settled)) {
        know_index file = know_file_named(w, second);
        if (file == UINT32_MAX) k->open = true;
        else if (!k->files[file].run) {
          k->files[file].run = true;
          follow(k, &c, k->nodes[k->files[file].root].first);
        }
      }
      w->begun = true;
      know_later(w, KNOW_TASK_EXPRESSION, settled == node ? node : settled, scope);
    }
  }
  free(c.at);
}

static bool defines_anything(know_walk *w, know_index first, know_index scope) {
  const knowledge *k = w->k;
  for (know_index i = first; i; i = k->nodes[i].next) {
    know_index head = k->nodes[i].kind == KNOW_LIST ? k->nodes[i].first : 0;
    if (!head || k->nodes[head].kind != KNOW_SYMBOL) continue;
    know_index s = know_find(w, k->nodes[head].name, scope);
    if (s && k->symbols[s].kind == KNOW_MACRO && (!k->symbols[s].row || know_form_defines(k->symbols[s].row) ||
        know_form_splices(k->symbols[s].row))) return true;
  }
  return false;
}

/* Returns whether the scope is that of a whole library, whose exports and bodies share it. */
static bool is_library(const knowledge *k, know_index scope) {
  know_index node = k->scopes[scope].node;
  return k->scopes[scope].kind == KNOW_SCOPE_BODY && node && know_is(k, k->nodes[node].first, "define-library");
}

static void run(know_walk *w) {
  knowledge *k = w->k;
  flush(w);
  while (w->task_count && !*k->trouble) {
    know_task t = w->tasks[--w->task_count];
    if (t.kind == KNOW_TASK_BODY) {
      know_index scope = t.scope;
      if (scope != KNOW_PROGRAM && !is_library(k, scope) && defines_anything(w, t.node, scope))
        scope = know_scope_new(k, scope, KNOW_SCOPE_BODY, k->nodes[t.node].parent);
      body(w, t.node, scope);
    } else expression(w, t.node, t.scope);
    flush(w);
  }
}

/* ---- comments ---- */

static know_index comment_before(const knowledge *k, const know_file *f, uint32_t line, know_index *end) {
  know_index last = 0, first = 0;
  for (know_index lo = f->first_comment, hi = f->comment_end; lo < hi;) { /* binary search: the last comment that ends
                                                                           * on the line before `line` */
    know_index mid = lo + (hi - lo) / 2;
    if (k->comments[mid].end_line < line) last = mid, lo = mid + 1;
    else hi = mid;
  }
  if (!last || k->comments[last].end_line + 1 != line || !k->comments[last].alone) return 0;
  first = last;
  while (first > f->first_comment && k->comments[first - 1].alone &&
      k->comments[first - 1].end_line + 1 == k->comments[first].line) first--;
  *end = last + 1;
  return first;
}

static know_index comment_beside(const knowledge *k, const know_file *f, uint32_t line, uint32_t from,
    know_index *end) {
  for (know_index lo = f->first_comment, hi = f->comment_end; lo < hi;) {
    know_index mid = lo + (hi - lo) / 2;
    const know_comment *c = &k->comments[mid];
    if (c->line < line) lo = mid + 1;
    else if (c->line > line) hi = mid;
    else return c->from > from && !c->alone ? (*end = mid + 1, mid) : 0;
  }
  return 0;
}

static void find_comments(knowledge *k) {
  for (know_index s = 1; s < k->symbol_count; s++) {
    know_symbol *y = &k->symbols[s];
    if (!y->definition || y->made || !y->form) continue;
    const know_place *form = &k->nodes[y->form].at, *name = &k->nodes[y->definition].at;
    const know_file *f = &k->files[form->file];
    bool top = y->kind != KNOW_PARAMETER && y->kind != KNOW_LOCAL;
    if (top) y->comment = comment_before(k, f, form->line, &y->comment_end);
    if (!y->comment) y->comment = comment_beside(k, f, name->line, name->from, &y->comment_end);
    if (!y->comment && form->end_line != name->line) y->comment = comment_beside(k, f, form->end_line, form->to,
        &y->comment_end);
  }
}

/* ---- the program ---- */

/* Sets k->open if the program may define further names: if it evaluates data, or loads a file whose name is known only
 * in a run. */
static void find_openness(knowledge *k) {
  for (know_index i = 1; i < k->node_count && !k->script; i++) {
    const know_node *n = &k->nodes[i];
    if (n->kind != KNOW_SYMBOL || n->role != KNOW_REFERENCE || !n->symbol) continue;
    const know_symbol *s = &k->symbols[n->symbol];
    if (s->kind != KNOW_BUILTIN) continue;
    bool loads = !strcmp(s->text, "load");
    bool followed = loads && n->parent && k->nodes[n->parent].first == i && k->nodes[n->parent].statement &&
                    is_load(k, n->parent);
    if ((loads && !followed) || !strcmp(s->text, "eval")) k->open = true;
  }
}

static bool resolve(knowledge *k) {
  know_walk w = {.k = k};
  know_scope_new(k, 0, KNOW_SCOPE_LANGUAGE, 0);
  know_scope_new(k, KNOW_LANGUAGE, KNOW_SCOPE_PROGRAM, k->files[0].root);
  k->text_nodes = k->node_count ? k->node_count - 1 : 0; /* does not count node 0, which means that there is no node */
  k->files[0].run = true;
  know_later_body(&w, k->nodes[k->files[0].root].first, KNOW_PROGRAM);
  run(&w);
  for (size_t i = 0; i < w.unknown_count && !*k->trouble; i++) {
    know_task t = w.unknown[i];
    know_index s = know_find(&w, k->nodes[t.node].name, t.scope);
    know_role role = (know_role)(t.kind & 63);
    if (!s) continue;
    know_mark(k, t.node, role, s, t.scope);
    know_use_add(k, s, know_written(k, t.node), role, (t.kind & 64) != 0);
  }
  for (know_index s = 1; k->script && s < k->symbol_count; s++)
    k->symbols[s].arity.least = 0; /* a script may omit arguments of a function, which are then undefined */
  for (know_index i = 1; i < k->node_count; i++) /* marks the nodes that the patterns of macros have used as literal
                                                  * words */
    if (k->nodes[i].kind == KNOW_SYMBOL && k->nodes[i].role == KNOW_EXPRESSION) k->nodes[i].role = KNOW_SYNTAX;
  if (!*k->trouble) find_openness(k), find_comments(k);
  free(w.tasks);
  free(w.later);
  free(w.unknown);
  return !*k->trouble;
}

bool know_read(knowledge *k, vs_scheme *scheme, const char *path, const char *library_path) {
  return know_read_given(k, scheme, path, NULL, 0, library_path);
}

bool know_read_given(knowledge *k, vs_scheme *scheme, const char *path, const char *text, size_t length,
                     const char *library_path) {
  *k = (knowledge){.scheme = scheme, .library_path = library_path, .given = text, .given_length = length};
  if (!know_open(k)) return false;
  know_index file = know_read_file(k, path, 0);
  return file != UINT32_MAX && !*k->trouble && resolve(k) && !*k->trouble;
}
