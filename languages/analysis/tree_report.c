/* Writes the report of an analysis: files, scopes, variables, functions and statements, each with its place, comments,
 * scope, and references from it and to it. Macro uses are reported as written and as expanded. */
#include "languages/analysis/tree_report.h"

#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

void know_write_place(know_writer *w, const knowledge *k, const know_place *at) {
  know_write_word(w, "file", k->files[at->file].path);
  know_write_number(w, "line", at->line);
  know_write_number(w, "column", at->column);
  know_write_number(w, "end_line", at->end_line);
  know_write_number(w, "end_column", at->end_column);
}

const char *know_comment_text(const knowledge *k, know_index comment, size_t *length) {
  const know_comment *c = &k->comments[comment];
  const char *s = k->files[c->file].text + c->from, *end = k->files[c->file].text + c->to;
  if (*s == '#') {
    s += 2;
    if (end - s >= 2) end -= 2;
  }
  if (k->script && s[1] == '*' && end - s >= 4) s += 2, end -= 2;
  while (s < end && (*s == ';' || (k->script && strchr("/*@", *s)) || *s == ' ' || *s == '\t' || *s == '\n')) s++;
  while (end > s && (unsigned char)end[-1] <= ' ') end--;
  *length = (size_t)(end - s);
  return s;
}

void know_write_comment(know_writer *w, const knowledge *k, know_index first, know_index end) {
  if (!first) return;
  size_t total = 0, room = 0;
  char *all = NULL;
  for (know_index i = first; i < end; i++) {
    size_t n;
    const char *s = know_comment_text(k, i, &n);
    if (!VS_GROW(all, room, total + n + 1)) break;
    if (total) all[total++] = '\n';
    memcpy(all + total, s, n);
    total += n;
  }
  if (total) know_write_text(w, "comment", all, total);
  free(all);
}

/* ---- the tree ---- */

typedef struct { know_index node, at; uint8_t stage; } step;

static void describe(know_writer *w, const knowledge *k, know_index i) {
  const know_node *n = &k->nodes[i];
  know_write_number(w, "id", i);
  know_write_word(w, "kind", know_kind_word((know_kind)n->kind));
  know_write_word(w, "role", know_role_word((know_role)n->role));
  know_write_place(w, k, &n->at);
  know_write_flag(w, "statement", n->statement);
  know_write_flag(w, "made", n->made);
  if (n->kind == KNOW_SYMBOL || n->kind == KNOW_KEYWORD) know_write_word(w, "text", k->names[n->name].text);
  else if (n->kind != KNOW_LIST && n->kind != KNOW_VECTOR) {
    size_t length;
    know_index origin = i;
    while (k->nodes[origin].origin) origin = k->nodes[origin].origin;
    const char *s = know_spelling(k, origin, &length);
    know_write_text(w, "text", s, length);
  } else if (n->open) know_write_text(w, "open", &n->open, 1);
  know_write_flag(w, "dotted", n->dotted);
  if (n->symbol) know_write_number(w, "symbol", n->symbol);
  if (n->scope) know_write_number(w, "scope", n->scope);
  if (n->origin) know_write_number(w, "origin", n->origin);
}

/* Writes a node with all nodes below it, and then the expansion if it is a macro use. A stack contains the open
 * nodes. */
static bool tree(know_writer *w, const knowledge *k, know_index root) {
  step *stack = NULL;
  size_t count = 0, room = 0;
  bool ok = VS_GROW(stack, room, 1);
  if (ok) stack[count++] = (step){root, 0, 0};
  while (ok && count) {
    step *s = &stack[count - 1];
    const know_node *n = &k->nodes[s->node];
    know_index child = 0;
    switch (s->stage) {
    case 0:
      know_write_item(w, "node");
      describe(w, k, s->node);
      s->stage = n->first ? 1 : n->expansion ? 3 : 5;
      if (s->stage == 1) know_write_list(w, "parts"), s->at = n->first;
      break;
    case 1:
      if (s->at) child = s->at, s->at = k->nodes[child].next;
      else know_write_list_end(w, "parts"), s->stage = n->expansion ? 3 : 5;
      break;
    case 3:
      know_write_list(w, "expansion");
      child = n->expansion;
      s->stage = 4;
      break;
    case 4:
      know_write_list_end(w, "expansion");
      s->stage = 5;
      break;
    default:
      know_write_item_end(w, "node");
      count--;
    }
    if (child && !(ok = VS_GROW(stack, room, count + 1))) break;
    if (child) stack[count++] = (step){child, 0, 0};
  }
  free(stack);
  return ok;
}

static bool is_function(const know_symbol *s) {
  return s->kind == KNOW_FUNCTION || s->kind == KNOW_RULE || s->kind == KNOW_MACRO || s->kind == KNOW_LOOP ||
      (s->kind == KNOW_FIELD && s->arity.known);
}

static void symbol(know_writer *w, const knowledge *k, know_index i, const char *item) {
  const know_symbol *s = &k->symbols[i];
  know_write_item(w, item);
  know_write_number(w, "id", i);
  know_write_text(w, "name", s->text, strlen(s->text));
  know_write_word(w, "kind", know_symbol_word((know_symbol_kind)s->kind));
  know_write_number(w, "scope", s->scope);
  if (s->definition) {
    know_write_place(w, k, &k->nodes[s->definition].at);
    know_write_number(w, "definition", s->definition);
    know_write_number(w, "form", s->form);
  }
  know_write_flag(w, "made", s->made);
  know_write_number(w, "reads", s->reads);
  know_write_number(w, "sets", s->sets);
  know_write_number(w, "calls", s->calls);
  if (s->arity.known) {
    know_write_number(w, "least", s->arity.least);
    if (s->arity.most != UINT32_MAX) know_write_number(w, "most", s->arity.most);
  }
  if (s->value) know_write_number(w, "value", s->value);
  if (s->owner) know_write_number(w, "function", s->owner);
  if (s->hides) know_write_number(w, "hides", s->hides);
  know_write_word(w, "call", s->call);
  know_write_word(w, "doc", s->doc);
  if (s->doc_string) {
    size_t n;
    const char *text = know_spelling(k, s->doc_string, &n);
    know_write_text(w, "doc", text + 1, n - 2);
  }
  know_write_comment(w, k, s->comment, s->comment_end);
  if (s->first_use) {
    know_write_list(w, "uses");
    for (know_index u = s->first_use; u; u = k->uses[u].next) {
      know_write_item(w, "use");
      know_write_number(w, "node", k->uses[u].node);
      know_write_word(w, "role", know_role_word((know_role)k->uses[u].role));
      know_write_flag(w, "called", k->uses[u].called);
      know_write_flag(w, "made", k->nodes[k->uses[u].node].made);
      know_write_place(w, k, &k->nodes[k->uses[u].node].at);
      know_write_item_end(w, "use");
    }
    know_write_list_end(w, "uses");
  }
  know_write_item_end(w, item);
}

bool know_report_tree(const knowledge *k, FILE *to, know_notation notation) {
  know_writer w;
  bool ok = true;
  know_write_start(&w, to, notation, "program");
  know_write_number(&w, "schema", KNOW_SCHEMA);
  know_write_flag(&w, "open", k->open);
  know_write_list(&w, "files");
  for (know_index i = 0; i < k->file_count; i++) {
    know_write_item(&w, "file");
    know_write_text(&w, "path", k->files[i].path, strlen(k->files[i].path));
    know_write_number(&w, "bytes", (uint32_t)k->files[i].size);
    if (k->files[i].loaded_by) know_write_number(&w, "loaded_by", k->files[i].loaded_by);
    if (k->files[i].first_comment < k->files[i].comment_end) {
      know_write_list(&w, "comments");
      for (know_index c = k->files[i].first_comment; c < k->files[i].comment_end; c++) {
        know_write_item(&w, "comment");
        know_write_number(&w, "line", k->comments[c].line);
        size_t n;
        const char *s = know_comment_text(k, c, &n);
        know_write_text(&w, "text", s, n);
        know_write_item_end(&w, "comment");
      }
      know_write_list_end(&w, "comments");
    }
    know_write_item_end(&w, "file");
  }
  know_write_list_end(&w, "files");
  know_write_list(&w, "scopes");
  for (know_index i = 1; i < k->scope_count; i++) {
    know_write_item(&w, "scope");
    know_write_number(&w, "id", i);
    know_write_word(&w, "kind", know_scope_word((know_scope_kind)k->scopes[i].kind));
    if (k->scopes[i].parent) know_write_number(&w, "parent", k->scopes[i].parent);
    if (k->scopes[i].node) know_write_number(&w, "node", k->scopes[i].node);
    know_write_item_end(&w, "scope");
  }
  know_write_list_end(&w, "scopes");
  for (int functions = 0; functions < 2; functions++) {
    know_write_list(&w, functions ? "functions" : "variables");
    for (know_index i = 1; i < k->symbol_count; i++)
      if (k->symbols[i].definition && is_function(&k->symbols[i]) == functions) symbol(&w, k, i,
          functions ? "function" : "variable");
    know_write_list_end(&w, functions ? "functions" : "variables");
  }
  know_write_list(&w, "language");
  for (know_index i = 1; i < k->symbol_count; i++)
    if (!k->symbols[i].definition && k->symbols[i].first_use) symbol(&w, k, i, "name");
  know_write_list_end(&w, "language");
  know_write_list(&w, "statements");
  for (size_t i = 0; ok && i < k->file_count; i++)
    for (know_index node = k->nodes[k->files[i].root].first; ok && node; node = k->nodes[node].next) ok = tree(&w, k,
        node);
  know_write_list_end(&w, "statements");
  know_write_end(&w, "program");
  return ok;
}

/* ---- the outline ---- */

void know_report_outline(const knowledge *k, FILE *to) {
  for (size_t f = 0; f < k->file_count; f++) {
    size_t statements = 0;
    for (know_index i = k->nodes[k->files[f].root].first; i; i = k->nodes[i].next) statements++;
    fprintf(to, "%s: %zu statements\n", k->files[f].path, statements);
  }
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *s = &k->symbols[i];
    if (!s->definition || s->made) continue;
    const know_place *at = &k->nodes[s->definition].at;
    fprintf(to, "%s:%u:%u: %s %s", k->files[at->file].path, at->line, at->column,
        know_symbol_word((know_symbol_kind)s->kind), s->text);
    if (s->owner) fprintf(to, " of %s", k->symbols[s->owner].text);
    if (s->reads || s->sets) {
      fputs(", used in", to);
      uint32_t last = 0, shown = 0;
      for (know_index u = s->first_use; u; u = k->uses[u].next) {
        uint32_t line = k->nodes[k->uses[u].node].at.line;
        if (k->uses[u].role == KNOW_DEFINITION || line == last) continue;
        if (++shown > 12) {
          fputs(" ...", to);
          break;
        }
        fprintf(to, " %u", last = line);
      }
    }
    fputc('\n', to);
  }
}
