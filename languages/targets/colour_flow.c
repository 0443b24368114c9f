/* Finds the texts of a lowered tree that are names of colours.
 *
 * Some target languages do not have these names of colours. A text is a colour if it occurs where the language expects
 * a colour. The same holds for texts that reach such a place: the value of a variable, an argument for a parameter, the
 * result of a procedure, an element of a list. The search marks nodes and variables as colours. It repeats loops over
 * the nodes until no mark is added. */
#include "languages/targets/colour_flow.h"

#include <string.h>

#include "languages/translate/words.h"

typedef struct { translation *t; bool changed; } flow;

static void raise(flow *f, uint8_t *mark, uint8_t to) {
  if (to > *mark && to < TR_DEEPEST) *mark = to, f->changed = true;
}

static void raise_node(flow *f, tr_index n, uint8_t to) {
  if (n) raise(f, &f->t->nodes[n].colour, to);
}

/* Returns true if the language expects a colour at this node, because of the primitive around it. */
static bool takes_colour(const translation *t, tr_index n) {
  const tr_node *p = &t->nodes[t->nodes[n].parent];
  if (p->kind == TR_KEYWORD) return !strcmp(p->text, "color");
  return p->kind == TR_PRIMITIVE && p->first == n && (!strcmp(p->text, "color") || !strcmp(p->text, "with-material"));
}

/* Returns the procedure of a call, or 0 if it is not known. */
static tr_index called(const translation *t, const tr_node *call) {
  const tr_node *callee = &t->nodes[call->first];
  return callee->kind == TR_NAME ? t->variables[callee->variable].procedure : 0;
}

/* Passes the mark of a node to the parts from which its value comes, such as the arms of an if. */
static void carry_down(flow *f, tr_index n) {
  translation *t = f->t;
  const tr_node *node = &t->nodes[n];
  uint8_t colour = node->colour, element = (uint8_t)(colour - 1);
  switch ((tr_node_kind)node->kind) {
  case TR_NAME: raise(f, &t->variables[node->variable].colour, colour); break;
  case TR_IF: raise_node(f, tr_nth(t, n, 1), colour), raise_node(f, tr_nth(t, n, 2), colour); break;
  case TR_AND: case TR_OR:
    for (tr_index i = node->first; i; i = t->nodes[i].next) raise_node(f, i, colour);
    break;
  case TR_BODY: case TR_KEYWORD: raise_node(f, node->last, colour); break;
  case TR_MAP: raise_node(f, node->last, element); break;
  case TR_LIST: /* a list of three numbers is a colour itself, so its elements are not marked */
    for (tr_index i = node->first; i && colour > 1; i = t->nodes[i].next) raise_node(f, i, element);
    break;
  case TR_CALL: {
    tr_index procedure = called(t, node);
    if (procedure) raise_node(f, t->nodes[procedure].last, colour);
    break;
  }
  case TR_PRIMITIVE: {
    char gives = node->row ? *tr_word_row(t->target, node->row).result : 0;
    if (gives == 'e') raise_node(f, node->first, (uint8_t)(colour + 1));
    for (tr_index i = node->first; gives == 'J' && i; i = t->nodes[i].next) raise_node(f, i, colour);
    break;
  }
  case TR_NOTHING: case TR_NUMBER: case TR_STRING: case TR_BOOLEAN: case TR_PROCEDURE: case TR_PARAMETER:
  case TR_DEFINE: case TR_WHEN: case TR_SET: case TR_ABSENT: break;
  }
}

/* Passes the mark of the node's variable on to the values of the variable. */
static void carry_into(flow *f, tr_index n) {
  translation *t = f->t;
  const tr_node *node = &t->nodes[n];
  if (node->kind == TR_DEFINE || node->kind == TR_SET || node->kind == TR_PARAMETER) {
    uint8_t colour = t->variables[node->variable].colour;
    /* runs: whether the variable takes the elements of a list, so that the list is marked */
    bool runs = node->kind == TR_DEFINE && t->nodes[node->parent].kind == TR_MAP;
    if (colour) raise_node(f, node->first, (uint8_t)(colour + runs));
  }
  if (node->kind != TR_CALL) return;
  tr_index procedure = called(t, node), parameter = procedure ? t->nodes[procedure].first : 0;
  for (tr_index i = t->nodes[node->first].next; i && parameter; i = t->nodes[i].next) {
    const tr_node *p = &t->nodes[parameter];
    if (p->kind != TR_PARAMETER || p->rest) break;
    raise_node(f, i, t->variables[p->variable].colour);
    parameter = p->next;
  }
}

static void carry(flow *f, tr_index n) {
  if (f->t->nodes[n].colour) carry_down(f, n);
  carry_into(f, n);
}

void tr_find_colours(translation *t) {
  flow f = { .t = t };
  tr_index count = (tr_index)t->node_count;
  for (tr_index n = 1; n < count; n++)
    if (takes_colour(t, n)) t->nodes[n].colour = 1;
  do { /* visits the nodes in both directions, because a chain of variables may lead in either direction */
    f.changed = false;
    for (tr_index n = 1; n < count; n++) carry(&f, n);
    for (tr_index n = count; f.changed && n-- > 1;) carry(&f, n);
  } while (f.changed);
}
