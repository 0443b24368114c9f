/* Reports forms that the language cannot expand. The interpreter expands each form, and runs none. */
#include "languages/checks/syntax_checks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { PROGRAM = 2, MOST_FORM = 200000 /* MOST_FORM: greatest length of a form in bytes */ };

typedef struct { char *at; size_t count, room; bool ok; } text;

static void put(text *t, const char *s, size_t n) {
  t->ok = t->ok && VS_GROW(t->at, t->room, t->count + n);
  if (!t->ok) return;
  memcpy(t->at + t->count, s, n);
  t->count += n;
}

/* Returns false for a form that is permitted only at the top level of a program, or that another check handles. */
static bool is_expandable(const knowledge *k, know_index form) {
  static const char *const others[] = {"import", "require", "include", "include-ci", "load", "provide", "begin",
                                       "cond-expand", "export"};
  know_index head = k->nodes[form].first;
  know_index symbol = k->nodes[form].symbol;
  if (k->nodes[form].kind == KNOW_SYMBOL) /* a form that is only a name has no syntax to check */
    return k->nodes[form].role == KNOW_SYNTAX ||
           (symbol && k->symbols[symbol].kind == KNOW_MACRO && !k->symbols[symbol].definition);
  if (k->nodes[form].kind != KNOW_LIST || !head || k->nodes[head].kind != KNOW_SYMBOL) return false;
  if (k->nodes[form].at.to - k->nodes[form].at.from > MOST_FORM) return false;
  const char *word = k->names[k->nodes[head].name].text;
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if (!strcmp(word, others[i])) return false;
  return strncmp(word, "define-", 7) != 0;
}

/* Returns true if a form contains a use of a macro that the program defines, or of a macro that only a run can expand.
 * form, end: range of its nodes. */
static bool uses_macros(const knowledge *k, know_index form, know_index end) {
  for (know_index i = form; i < end; i++) {
    const know_node *n = &k->nodes[i];
    if (n->role == KNOW_OPAQUE) return true;
    if (n->kind == KNOW_SYMBOL && n->symbol && k->symbols[n->symbol].kind == KNOW_MACRO &&
        k->symbols[n->symbol].definition) return true;
  }
  return false;
}

/* Writes the names that the program defines and that are also forms of the language, separated by blanks. In the
 * program, forms with these names are calls. */
static void put_own_names(const knowledge *k, text *t) {
  for (know_index s = k->scopes[PROGRAM].first_symbol; s; s = k->symbols[s].next_in_scope) {
    vs_name_info info;
    if (!k->symbols[s].definition || k->symbols[s].made) continue;
    if (!vs_name_get(k->scheme, k->symbols[s].text, &info) || strcmp(info.kind, "form") != 0) continue;
    put(t, " ", 1);
    put(t, k->symbols[s].text, strlen(k->symbols[s].text));
  }
}

/* Returns the innermost node of the form that contains this place in the text. */
static know_index node_at(const knowledge *k, know_index form, know_index end, uint32_t line, uint32_t column) {
  know_index found = form;
  for (know_index i = form; i < end; i++)
    if (k->nodes[i].at.line == line && k->nodes[i].at.column == column) found = i;
  return found;
}

/* Reports an import of a library that does not exist. */
static void import(know_findings *f, know_index form) {
  knowledge *k = f->k;
  const know_file *file = &k->files[k->nodes[form].at.file];
  size_t n;
  const char *s = know_spelling(k, form, &n);
  *k->heard = 0;
  k->heard_warning = false;
  k->muted = true;
  vs_outcome outcome = vs_eval_text(k->scheme, file->path, 1, s, n, 0);
  k->muted = false;
  if (outcome == VS_OUTCOME_MODEL && strstr(k->heard, "there is no library"))
    know_found(f, KNOW_CHECK_SYNTAX, form, "%s", k->heard);
}

static void expand(know_findings *f, know_index form, know_index end, const text *names) {
  knowledge *k = f->k;
  const know_place *at = &k->nodes[form].at;
  text t = {.ok = true};
  put(&t, "(lambda (", 9);
  put(&t, names->at, names->count);
  put(&t, ")\n", 2);
  for (uint32_t i = 1; i < at->column; i++) put(&t, " ", 1);
  put(&t, k->files[at->file].text + at->from, at->to - at->from);
  put(&t, "\n#t)", 4);
  *k->heard = 0;
  k->heard_warning = false;
  k->muted = true;
  vs_outcome outcome = t.ok ? vs_eval_text(k->scheme, "form", at->line, t.at, t.count, 0) : VS_OUTCOME_DONE;
  k->muted = false;
  free(t.at);
  if (!t.ok) know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  bool warned = outcome == VS_OUTCOME_DONE && k->heard_warning; /* warned: whether the interpreter has only warned, as
                                                                 * about a test that is a procedure in (cond (> 3 2)
                                                                 * ...) */
  if ((outcome != VS_OUTCOME_MODEL && !warned) || !*k->heard ||
      (strstr(k->heard, "top level") && !strstr(k->heard, "or in the body")))
    return;
  know_index node = node_at(k, form, end, k->heard_line - 1, k->heard_column);
  bool word = k->nodes[node].kind == KNOW_SYMBOL;
  know_found(f, KNOW_CHECK_SYNTAX, node, "%s", word ? know_advised(k, VS_ADVICE_WORD, node, k->heard) : k->heard);
}

void know_check_syntax(know_findings *f) {
  knowledge *k = f->k;
  text names = {.ok = true};
  if (k->script || k->library) return;
  put_own_names(k, &names);
  for (size_t file = 0; names.ok && file < k->file_count; file++)
    for (know_index i = k->nodes[k->files[file].root].first; i && !*k->trouble; i = k->nodes[i].next) {
      know_index end = k->nodes[i].next ? k->nodes[i].next : i + 1;
      while (!k->nodes[i].next && end <= k->text_nodes && k->nodes[end].at.file == file) end++;
      if (know_is(k, k->nodes[i].first, "import") && !k->nodes[i].made) import(f, i);
      if (is_expandable(k, i) && !uses_macros(k, i, end)) expand(f, i, end, &names);
    }
  free(names.at);
}
