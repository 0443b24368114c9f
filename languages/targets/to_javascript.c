/* Writes programs in JavaScript: modules for three.js.
 *
 * In such a module solids are values, lists of flat faces. The drawing becomes a group of three.js meshes. Procedures
 * are functions with their lexical scope. A function that calls itself only at its end becomes a loop, since
 * JavaScript's stack is short. */
#include "languages/targets/to_javascript.h"

#include <stdio.h>
#include <string.h>

#include "languages/targets/target_colours.h"
#include "languages/translate/lift_procedures.h"
#include "languages/translate/text_plan.h"
#include "languages/translate/value_kinds.h"
#include "languages/translate/words.h"

/* In this file, a piece of kind TR_PIECE_STATEMENTS is a node as statements that return its value; TR_PIECE_DRAW is a
 * node as statements that drop its value. */

static const tr_node *at(const tr_writer *w, tr_index n) { return &w->t->nodes[n]; }
static tr_variable *var(const tr_writer *w, tr_index n) { return &w->t->variables[at(w, n)->variable]; }
static const char *name(const tr_writer *w, tr_index n) { return var(w, n)->name ? var(w, n)->name : "undefined"; }

/* ---- values ---- */

static void plan_test(tr_writer *w, tr_index n, int level) {
  uint8_t type = at(w, n)->type;
  if (type == TR_A_BOOLEAN) tr_plan_value(w, n, level);
  else if (type == TR_UNKNOWN || type == TR_ANYTHING)
    tr_plan(w, level > TR_EQUAL ? "(%t !== false)" : "%t !== false", n);
  else tr_plan(w, "true");
}

static void plan_parameters(tr_writer *w, tr_index procedure) {
  for (tr_index p = at(w, procedure)->first; at(w, p)->kind == TR_PARAMETER; p = at(w, p)->next) {
    tr_plan(w, p == at(w, procedure)->first ? "%s" : ",%_%s", name(w, p));
    if (at(w, p)->first) tr_plan(w, " = %v", at(w, p)->first);
  }
}

static bool has_statements(const tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (node->kind == TR_BODY) return true;
  if (node->kind == TR_SET || (node->kind == TR_MAP && node->effect) || tr_turns(w->t, n)) return true;
  if (node->kind != TR_IF) return false;
  for (tr_index i = at(w, node->first)->next; i; i = at(w, i)->next)
    if (at(w, i)->kind == TR_BODY || at(w, i)->kind == TR_IF || at(w, i)->kind == TR_SET || tr_turns(w->t, i))
      return true;
  return false;
}

static void plan_function(tr_writer *w, tr_index n, int level) {
  tr_index body = at(w, n)->last;
  if (level > TR_LOOSE) tr_plan(w, "(");
  tr_plan(w, "(");
  plan_parameters(w, n);
  if (has_statements(w, body)) tr_plan(w, ") => {%>%l%<%n}", body);
  else tr_plan(w, ") =>%_%v", body);
  if (level > TR_LOOSE) tr_plan(w, ")");
}

static void plan_call(tr_writer *w, tr_index n) {
  tr_index callee = at(w, n)->first;
  tr_plan(w, "%t(", callee);
  for (tr_index a = at(w, callee)->next; a; a = at(w, a)->next) {
    if (a != at(w, callee)->next) tr_plan(w, ",%_");
    if (at(w, a)->kind == TR_ABSENT) tr_plan(w, "undefined");
    else tr_plan(w, "%v", a);
  }
  tr_plan(w, ")");
}

/* Plans the tests of a map from the node `test` on, then the map's element. */
static void plan_map(tr_writer *w, tr_index n) {
  tr_index made = at(w, n)->last, i = at(w, n)->first, open = 0;
  if (at(w, n)->parallel) {
    tr_plan(w, "zip(");
    for (tr_index d = i; at(w, d)->kind == TR_DEFINE; d = at(w, d)->next)
      tr_plan(w, d == i ? "%v" : ",%_%v", at(w, d)->first);
    tr_plan(w, ")");
  }
  while (i != made) {
    tr_index last = i;
    if (at(w, n)->parallel)
      while (at(w, at(w, last)->next)->kind == TR_DEFINE) last = at(w, last)->next;
    else tr_plan(w, "%t", at(w, i)->first);
    for (tr_index test = at(w, last)->next;; test = at(w, test)->next) { /* plans each test, and the pieces that follow
                                                                          * it */
      bool tests = at(w, test)->kind == TR_WHEN, more = at(w, test)->kind == TR_DEFINE;
      bool itself = test == made && at(w, made)->kind == TR_NAME && !at(w, n)->parallel &&
          at(w, made)->variable == at(w, i)->variable;
      if (itself) {
        i = made;
        break;
      }
      tr_plan(w, tests ? ".filter((" : more ? ".flatMap((" : ".map((");
      if (at(w, n)->parallel) tr_plan(w, "[");
      for (tr_index d = i; d != at(w, last)->next; d = at(w, d)->next) tr_plan(w, d == i ? "%s" : ", %s", name(w, d));
      tr_plan(w, at(w, n)->parallel ? "]) =>%_" : ") =>%_");
      if (tests) tr_plan(w, "%b)", at(w, test)->first);
      if (tests) continue;
      i = test;
      if (!more && has_statements(w, made)) tr_plan(w, "{%>%l%<%n})", made);
      else if (!more) tr_plan(w, "%v)", made);
      else open++;
      break;
    }
  }
  while (open--) tr_plan(w, ")");
}

/* Plans the text of and, or. If all operands are tests, uses JavaScript's operators. Otherwise the value is that of an
 * operand, as in Scheme. */
static void plan_and_or(tr_writer *w, tr_index n, int level) {
  bool and = at(w, n)->kind == TR_AND, tests = at(w, n)->type == TR_A_BOOLEAN;
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) tests = tests && at(w, i)->type == TR_A_BOOLEAN;
  if (!tests && !and) {
    tr_plan(w, "either(");
    for (tr_index i = at(w, n)->first; i; i = at(w, i)->next)
      tr_plan(w, at(w, i)->next ? "() => %t,%_" : "() => %t)", i);
    return;
  }
  int own = tests ? and ? TR_BOTH : TR_EITHER : TR_CHOICE;
  if (own < level) tr_plan(w, "(");
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    bool last = !at(w, i)->next;
    if (tests) {
      tr_plan_value(w, i, own + 1);
      if (!last) tr_plan(w, and ? " &&%_" : " ||%_");
    } else if (last) tr_plan_value(w, i, TR_CHOICE);
    else tr_plan(w, "%t === false ? false :%_", i);
  }
  if (own < level) tr_plan(w, ")");
}

static void plan_value(tr_writer *w, tr_index n, int level) {
  const tr_node *node = at(w, n);
  switch ((tr_node_kind)node->kind) {
  case TR_NUMBER: tr_plan_number(w, node->text, level); break;
  case TR_STRING:
    if (tr_is_colour(w, n)) tr_plan_css_colour(w, n);
    else tr_plan_quoted(w, node->text);
    break;
  case TR_BOOLEAN: tr_plan(w, node->yes ? "true" : "false"); break;
  case TR_NAME: tr_plan(w, "%s", name(w, n)); break;
  case TR_PRIMITIVE:
    if (!strcmp(node->text, "native")) tr_plan(w, "%s", at(w, node->first)->text);
    else if (node->row) tr_plan_row(w, n, level);
    break;
  case TR_CALL: plan_call(w, n); break;
  case TR_PROCEDURE: plan_function(w, n, level); break;
  case TR_BODY:
    if (node->first && node->first == node->last && at(w, node->last)->kind != TR_DEFINE)
      tr_plan_value(w, node->last, level);
    else tr_plan(w, "(() => {%>%l%<%n})()", n);
    break;
  case TR_IF: {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    if (level > TR_CHOICE) tr_plan(w, "(");
    tr_plan(w, "%b ?%_", node->first);
    tr_plan_value(w, then, TR_EITHER);
    tr_plan(w, " :%_");
    if (other) tr_plan_value(w, other, TR_CHOICE);
    else tr_plan(w, "undefined");
    if (level > TR_CHOICE) tr_plan(w, ")");
    break;
  }
  case TR_AND: case TR_OR: plan_and_or(w, n, level); break;
  case TR_LIST:
    tr_plan(w, "[");
    for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, i == node->first ? "%v" : ",%_%v", i);
    tr_plan(w, "]");
    break;
  case TR_MAP:
    if (node->effect) tr_plan(w, "(() => {%>%d%<%n})()", n);
    else plan_map(w, n);
    break;
  case TR_SET: tr_plan(w, "(%s = %v)", name(w, n), node->first); break;
  case TR_KEYWORD: tr_plan_value(w, node->first, level); break;
  case TR_NOTHING: case TR_ABSENT: case TR_DEFINE: case TR_PARAMETER: case TR_WHEN: tr_plan(w, "undefined"); break;
  }
}

/* ---- statements ---- */

static void plan_define(tr_writer *w, tr_index define) {
  const tr_variable *v = var(w, define);
  tr_index value = at(w, define)->first;
  if (v->define != define) tr_plan(w, "%s = %v;", name(w, define), value); /* a variable that has been defined before is
                                                                            * assigned */
  else if (v->procedure && !v->set) {
    tr_plan(w, "function %s(", name(w, define));
    plan_parameters(w, value);
    tr_plan(w, v->loops ? ") {%>%nfor (;;) {%>%l%<%n}%<%n}" : ") {%>%l%<%n}", at(w, value)->last);
  } else tr_plan(w, v->set ? "let %s = %v;" : "const %s = %v;", name(w, define), value);
}

static void plan_defines(tr_writer *w, tr_index body, bool gives) {
  tr_index last = at(w, body)->last;
  for (tr_index i = at(w, body)->first; i; i = at(w, i)->next) {
    if (at(w, i)->kind == TR_DEFINE) {
      tr_plan_comments(w, i, TR_PIECE_COMMENTS, false);
      tr_plan(w, "%n");
      plan_define(w, i);
      tr_plan_comments(w, i, TR_PIECE_BEHIND, false);
    } else tr_plan(w, gives && i == last ? "%l" : "%d", i);
  }
}

static void plan_turn(tr_writer *w, tr_index n) {
  tr_index p = at(w, var(w, at(w, n)->first)->procedure)->first, a = at(w, at(w, n)->first)->next;
  bool several = a && at(w, a)->next;
  tr_plan(w, several ? "%n[" : "%n");
  for (tr_index i = p; at(w, i)->kind == TR_PARAMETER; i = at(w, i)->next)
    tr_plan(w, i == p ? "%s" : ", %s", name(w, i));
  if (a) tr_plan(w, several ? "] = [" : " = ");
  for (tr_index i = a; i; i = at(w, i)->next) tr_plan(w, i == a ? "%v" : ",%_%v", i);
  if (a) tr_plan(w, several ? "];" : ";");
  tr_plan(w, "%ncontinue;");
}

/* Plans the node as statements that return its value. */
static void plan_return(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (node->kind == TR_BODY) {
    plan_defines(w, n, true);
    if (!node->last || at(w, node->last)->kind == TR_DEFINE) tr_plan(w, "%nreturn;");
  } else if (tr_turns(w->t, n)) plan_turn(w, n);
  else if (node->kind == TR_IF && has_statements(w, n)) {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    tr_plan(w, "%nif (%b) ", node->first);
    if (has_statements(w, then)) tr_plan(w, "{%>%l%<%n}", then);
    else tr_plan(w, "return %v;", then);
    if (!other) tr_plan(w, "%nreturn;");
    else if (at(w, other)->kind == TR_BODY) tr_plan(w, "%nelse {%>%l%<%n}", other);
    else tr_plan(w, "%l", other);
  } else if (node->kind == TR_SET || (node->kind == TR_MAP && node->effect)) tr_plan(w, "%d%nreturn;", n);
  else tr_plan_commented(w, "%nreturn %v;", n);
}

/* Plans the node as statements that drop its value. */
static void plan_effect(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  switch ((tr_node_kind)node->kind) {
  case TR_BODY:
    tr_plan(w, "%n{%>");
    plan_defines(w, n, false);
    tr_plan(w, "%<%n}");
    break;
  case TR_IF: {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    tr_plan(w, "%nif (%b) {%>%d%<%n}", node->first, then);
    if (other) tr_plan(w, " else {%>%d%<%n}", other);
    break;
  }
  case TR_MAP: {
    if (!node->effect) {
      tr_plan(w, "%n%v;", n);
      break;
    }
    tr_plan(w, "%n");
    if (node->parallel) {
      tr_plan(w, "for (const [");
      tr_index i = node->first;
      for (; at(w, i)->kind == TR_DEFINE; i = at(w, i)->next) tr_plan(w, i == node->first ? "%s" : ", %s", name(w, i));
      tr_plan(w, "] of zip(");
      for (i = node->first; at(w, i)->kind == TR_DEFINE; i = at(w, i)->next)
        tr_plan(w, i == node->first ? "%v" : ", %v", at(w, i)->first);
      tr_plan(w, ")) ");
    }
    for (tr_index i = node->first; i != node->last; i = at(w, i)->next)
      if (at(w, i)->kind == TR_WHEN) tr_plan(w, "if (%b) ", at(w, i)->first);
      else if (!node->parallel) tr_plan(w, "for (const %s of %v) ", name(w, i), at(w, i)->first);
    tr_plan(w, "{%>");
    if (at(w, node->last)->kind == TR_BODY) plan_defines(w, node->last, false);
    else tr_plan(w, "%d", node->last);
    tr_plan(w, "%<%n}");
    break;
  }
  case TR_SET: tr_plan(w, "%n%s = %v;", name(w, n), node->first); break;
  case TR_PRIMITIVE:
    if (node->row && !*tr_word_row(w->target, node->row).text && strcmp(node->text, "native")) break;
    /* fall through */
  case TR_CALL:
    tr_plan_commented(w, "%n%v;", n);
    break;
  default: break; /* plans nothing for a value that is not used */
  }
}

static void emit(tr_writer *w, const tr_piece *p) {
  switch ((tr_piece_kind)p->kind) {
  case TR_PIECE_VALUE: plan_value(w, p->node, p->level); break;
  case TR_PIECE_TEST: plan_test(w, p->node, p->level); break;
  case TR_PIECE_STATEMENTS: plan_return(w, p->node); break;
  case TR_PIECE_DRAW: plan_effect(w, p->node); break;
  default: break;
  }
}

static void put(tr_writer *w, const char *text) { tr_put(w, text, strlen(text)); }

void tr_javascript_program(tr_writer *w) {
  char text[60];
  w->emit = emit;
  snprintf(text, sizeof text, "%u; // facets of a full turn\n", w->segments);
  put(w, "import * as THREE from \"three\";\n\nconst segments = ");
  put(w, text);
  for (tr_index i = at(w, w->t->root)->first; i && !*w->t->k->trouble; i = at(w, i)->next) {
    bool define = at(w, i)->kind == TR_DEFINE;
    tr_gap_before(w, at(w, i)->source);
    tr_comments_before(w, at(w, i)->source);
    size_t before = w->out_count;
    if (define) plan_define(w, i);
    else if (!w->t->draws && tr_is_solid(w->t, i)) tr_plan(w, "%ndraw(%v);", i);
    else tr_plan(w, "%d", i);
    tr_write_statement(w, before, at(w, i)->source);
  }
}
