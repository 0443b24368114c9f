/* Writes scripts as modules for three.js.
 *
 * A script is already JavaScript. Its text is copied, with its comments, into a function whose scope hides the module's
 * names. The libraries that the script calls are helpers of the target. A module is in strict mode: the translation
 * complains about text that strict mode treats differently or rejects. */
#include "languages/targets/script_to_javascript.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/translate/lower_definitions.h"
#include "languages/translate/text_plan.h"

static void put(tr_writer *w, const char *text) { tr_put(w, text, strlen(text)); }

static bool is(const knowledge *k, know_index n, const char *word) {
  know_index head = k->nodes[n].kind == KNOW_LIST ? k->nodes[n].first : 0;
  return head && k->nodes[head].kind == KNOW_SYMBOL && !strcmp(k->names[k->nodes[head].name].text, word);
}

/* Returns the first parameter whose name equals that of an earlier parameter in the list, or 0 if there is none. */
static know_index twice(const knowledge *k, know_index list) {
  know_index first = list && k->nodes[list].kind == KNOW_LIST ? k->nodes[list].first : 0;
  for (know_index i = first; i; i = k->nodes[i].next)
    for (know_index before = first; before != i; before = k->nodes[before].next)
      if (k->nodes[before].name == k->nodes[i].name) return i;
  return 0;
}

/* Complains about all parts of the script that a module cannot contain. */
static void refuse(translation *t) {
  static const char reserved[] = " let static yield await implements interface package private protected public eval ";
  knowledge *k = t->k;
  for (know_index i = 1; i <= k->text_nodes; i++) {
    if (is(k, i, "js:native")) tr_complain_at(t, i, "Scheme code cannot be translated to JavaScript");
    know_index again = is(k, i, "js:define") || is(k, i, "js:lambda") ? twice(k, know_nth(k, i, 1)) : 0;
    if (again) tr_complain_at(t, again, "two parameters of one name cannot be translated to JavaScript");
    if (is(k, i, "js:declared"))
      tr_complain_at(t, i, "a function declared within a statement cannot be translated to JavaScript");
  }
  for (know_index s = 1; s < k->symbol_count; s++) {
    char word[40];
    snprintf(word, sizeof word, " %.30s ", k->symbols[s].text ? k->symbols[s].text : "");
    if (k->symbols[s].definition && strstr(reserved, word))
      tr_complain_at(t, k->symbols[s].definition, "the name %s is a word of JavaScript's modules",
                     k->symbols[s].text);
  }
}

/* Writes declarations of the variables that the script assigns and never declares. */
static void put_globals(tr_writer *w) {
  const knowledge *k = w->t->k;
  bool any = false;
  for (know_index i = 1; i <= k->text_nodes; i++) {
    know_index named = is(k, i, "js:set!") ? know_nth(k, i, 1) : 0, before = 1;
    if (!named || k->nodes[named].symbol) continue;
    for (; before < i; before++) /* searches an earlier assignment of the variable, so that it is declared once */
      if (is(k, before, "js:set!") && k->nodes[know_nth(k, before, 1)].name == k->nodes[named].name) break;
    if (before < i) continue;
    put(w, any ? ", " : "var ");
    put(w, k->names[k->nodes[named].name].text);
    any = true;
  }
  if (any) put(w, ";\n");
}

/* Writes the value that the user has set for a parameter, from its lowered form. */
static void put_value(tr_writer *w, tr_index n) {
  const tr_node *value = &w->t->nodes[n];
  if (value->kind == TR_STRING) tr_plan_quoted(w, value->text);
  else tr_plan(w, "%s", value->kind == TR_BOOLEAN ? value->yes ? "true" : "false" : value->text);
  tr_write_planned(w);
}

void tr_script_program(tr_writer *w) {
  translation *t = w->t;
  knowledge *k = t->k;
  const know_file *f = &k->files[0];
  char text[60];
  lowering l = {.t = t, .k = k};
  refuse(t);
  snprintf(text, sizeof text, "%u; // facets of a full turn\n\n(function () {\n", w->segments);
  put(w, "import * as THREE from \"three\";\n\nconst segments = ");
  put(w, text);
  put_globals(w);
  uint32_t from = 0;
  for (know_index i = k->nodes[f->root].first; i && !*k->trouble; i = k->nodes[i].next) {
    if (!is(k, i, "js:define-parameter") || !know_nth(k, i, 2)) continue;
    tr_lower_parameter(&l, i, t->root);
    tr_index value = t->nodes[t->nodes[t->root].last].first;
    if (!value || t->nodes[value].kind == TR_NOTHING) continue; /* the user has set no value, so the default in the text
                                                                 * remains */
    const know_place *at = &k->nodes[know_nth(k, i, 2)].at;
    tr_put(w, f->text + from, at->from - from);
    put_value(w, value);
    from = at->to;
  }
  free(l.tasks);
  tr_put(w, f->text + from, f->size - from);
  if (w->out_count && w->out[w->out_count - 1] != '\n') put(w, "\n");
  put(w, "})();\n");
  tr_lower_settings(&l);
}
