/* Implements the arrays of a translation, and its list of complaints: parts of the program that the target cannot
 * express. */
#include "languages/translate/core_tree.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "model/store/array.h"

static tr_index no_memory(translation *t) { return know_fail(t->k, NULL, VS_OUTCOME_MACHINE, "out of memory"), 0; }

tr_index tr_node_new(translation *t, tr_index parent, tr_node_kind kind, know_index source) {
  if (t->node_count >= KNOW_MOST_NODES) {
    return know_fail(t->k, NULL, VS_OUTCOME_MODEL, "the program has too many parts to be translated"), 0;
  }
  if (!VS_GROW(t->nodes, t->node_room, t->node_count + 1)) return no_memory(t);
  tr_index made = (tr_index)t->node_count++;
  t->nodes[made] = (tr_node){.kind = (uint8_t)kind, .parent = parent, .source = source, .text = ""};
  if (!parent) return made;
  tr_node *p = &t->nodes[parent];
  if (p->last) t->nodes[p->last].next = made;
  else p->first = made;
  p->last = made;
  p->count++;
  return made;
}

tr_index tr_variable_new(translation *t, const char *text) {
  if (!VS_GROW(t->variables, t->variable_room, t->variable_count + 1)) return no_memory(t);
  t->variables[t->variable_count] = (tr_variable){.text = text};
  return (tr_index)t->variable_count++;
}

tr_index tr_nth(const translation *t, tr_index node, uint32_t nth) {
  tr_index i = t->nodes[node].first;
  while (i && nth--) i = t->nodes[i].next;
  return i;
}

void tr_move(translation *t, tr_index from, tr_index to) {
  tr_node *a = &t->nodes[from], *b = &t->nodes[to];
  tr_index parent = b->parent, next = b->next;
  *b = *a;
  b->parent = parent, b->next = next;
  for (tr_index i = b->first; i; i = t->nodes[i].next) t->nodes[i].parent = to;
  *a = (tr_node){.text = ""};
}

/* Compares places by their file, then by their position in bytes. */
static int order(const know_place *a, const know_place *b) {
  if (a->file != b->file) return a->file < b->file ? -1 : 1;
  return a->from < b->from ? -1 : a->from > b->from;
}

static void complain(translation *t, know_index source, const char *format, va_list list) {
  char text[400];
  while (source && t->k->nodes[source].origin && !t->k->nodes[source].made) source = t->k->nodes[source].origin;
  know_place at = t->k->nodes[source].at;
  vsnprintf(text, sizeof text, format, list);
  if (t->complaint_count >= TR_MOST_COMPLAINTS) return;
  size_t where = t->complaint_count;
  while (where && order(&t->complaints[where - 1].at, &at) > 0) where--;
  for (size_t i = where; i && !order(&t->complaints[i - 1].at, &at); i--)
    if (!strcmp(t->complaints[i - 1].text, text)) return;
  if (!VS_GROW(t->complaints, t->complaint_room, t->complaint_count + 1)) {
    no_memory(t);
    return;
  }
  memmove(t->complaints + where + 1, t->complaints + where, (t->complaint_count - where) * sizeof *t->complaints);
  t->complaints[where] = (tr_complaint){at, know_text(t->k, text, strlen(text))};
  t->complaint_count++;
}

bool tr_complain_at(translation *t, know_index source, const char *format, ...) {
  va_list list;
  va_start(list, format);
  complain(t, source, format, list);
  va_end(list);
  return false;
}

bool tr_complain(translation *t, tr_index node, const char *format, ...) {
  va_list list;
  while (node && !t->nodes[node].source) node = t->nodes[node].parent;
  va_start(list, format);
  complain(t, t->nodes[node].source, format, list);
  va_end(list);
  return false;
}
