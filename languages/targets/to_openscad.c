/* Writes programs in OpenSCAD's language.
 *
 * In OpenSCAD solids are not values. A procedure that makes a solid becomes a module. A solid argument becomes a child
 * of the module's call, and a variable whose value is a solid becomes a module without parameters. All other
 * definitions become functions or variables. Procedures as values become function literals, which OpenSCAD has since
 * 2021. */
#include "languages/targets/to_openscad.h"

#include <stdio.h>
#include <string.h>

#include "languages/translate/value_kinds.h"
#include "languages/targets/target_colours.h"
#include "languages/translate/lift_procedures.h"
#include "languages/translate/literals.h"
#include "languages/translate/text_plan.h"
#include "languages/translate/words.h"

static const tr_node *at(const tr_writer *w, tr_index n) { return &w->t->nodes[n]; }
static const tr_variable *var(const tr_writer *w, tr_index n) { return &w->t->variables[at(w, n)->variable]; }
static const char *name(const tr_writer *w, tr_index n) { return var(w, n)->name ? var(w, n)->name : "?"; }
static tr_index body_of(const tr_writer *w, tr_index procedure) { return at(w, procedure)->last; }

/* ---- names ---- */

/* Returns the index of the solid variable among the children of the module in which it is used, or -1 if it is not
 * among them. */
static int child_number(const tr_writer *w, tr_index define, tr_index variable) {
  const translation *t = w->t;
  int n = 0;
  tr_index value = define ? at(w, define)->first : 0;
  if (value && at(w, value)->kind == TR_PROCEDURE)
    for (tr_index p = at(w, value)->first; at(w, p)->kind == TR_PARAMETER; p = at(w, p)->next) {
      if (var(w, p)->type != TR_A_SOLID) continue;
      if (at(w, p)->variable == variable) return n;
      n++;
    }
  tr_index b;
  for (uint32_t i = 0; (b = tr_besides(t, define, i)) != 0; i++) {
    if (t->variables[b].type != TR_A_SOLID) continue;
    if (b == variable) return n;
    n++;
  }
  return -1;
}

/* ---- values ---- */

static bool is_boolean(const tr_writer *w, tr_index n) { return at(w, n)->type == TR_A_BOOLEAN; }

static void plan_test(tr_writer *w, tr_index n, int level) {
  uint8_t type = at(w, n)->type;
  if (is_boolean(w, n)) tr_plan_value(w, n, level);
  else if (type == TR_UNKNOWN || type == TR_ANYTHING) tr_plan(w, level > TR_EQUAL ? "(%t != false)" : "%t != false", n);
  else tr_plan(w, "true");
}

/* Plans the arguments of a call, except solids. Arguments after an ABSENT argument are passed by name. */
static void plan_arguments(tr_writer *w, tr_index call, tr_index procedure) {
  bool named = false, any = false;
  tr_index p = procedure ? at(w, procedure)->first : 0;
  for (tr_index a = at(w, at(w, call)->first)->next; a; a = at(w, a)->next) {
    bool solid = p ? var(w, p)->type == TR_A_SOLID : false;
    if (at(w, a)->kind == TR_ABSENT) named = true;
    else if (!solid) {
      if (any) tr_plan(w, ",%_");
      if (named && p) tr_plan(w, "%s = ", name(w, p));
      tr_plan(w, "%v", a);
      any = true;
    }
    if (p) p = at(w, p)->next;
  }
  if (at(w, at(w, call)->first)->kind != TR_NAME) return;
  const tr_variable *v = var(w, at(w, call)->first);
  tr_index b;
  for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++) {
    const tr_variable *f = &w->t->variables[b];
    if (f->type == TR_A_SOLID) continue;
    if (any) tr_plan(w, ",%_");
    if (named) tr_plan(w, "%s = ", f->name);
    tr_plan(w, "%s", f->name);
    any = true;
  }
}

static void no_value(tr_writer *w, tr_index n, const char *what) {
  tr_complain(w->t, n, "%s: OpenSCAD's solids are no values: a program can draw, move and unite them, and pass them to "
              "procedures that do", what);
}

static void plan_name(tr_writer *w, tr_index n) {
  const tr_variable *v = var(w, n);
  if (v->module || v->type == TR_A_SOLID) {
    no_value(w, n, v->text);
    return;
  }
  if (!v->procedure || !(v->global || v->lifted)) {
    tr_plan(w, "%s", v->name ? v->name : "?");
    return;
  }
  tr_plan(w, "(function (");
  for (int round = 0; round < 2; round++) {
    if (round) tr_plan(w, ") %s(", v->name);
    bool any = false;
    for (tr_index p = at(w, v->procedure)->first; at(w, p)->kind == TR_PARAMETER; p = at(w, p)->next) {
      tr_plan(w, any ? ", %s" : "%s", name(w, p));
      any = true;
    }
    tr_index b;
    for (uint32_t i = 0; round && v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++) {
      tr_plan(w, any ? ", %s" : "%s", w->t->variables[b].name);
      any = true;
    }
  }
  tr_plan(w, "))");
}

static void plan_call(tr_writer *w, tr_index n) {
  tr_index callee = at(w, n)->first, procedure = 0;
  if (at(w, callee)->kind == TR_NAME) {
    const tr_variable *v = var(w, callee);
    procedure = v->procedure;
    if (v->module) {
      no_value(w, n, v->text);
      return;
    }
    tr_plan(w, "%s(", name(w, callee));
  } else tr_plan(w, "%t(", callee);
  plan_arguments(w, n, procedure);
  tr_plan(w, ")");
}

static void plan_parameters(tr_writer *w, tr_index procedure, tr_index define) {
  bool any = false;
  for (tr_index p = procedure ? at(w, procedure)->first : 0; p && at(w, p)->kind == TR_PARAMETER; p = at(w, p)->next) {
    if (var(w, p)->type == TR_A_SOLID) {
      if (at(w, p)->first) tr_complain(w->t, p, "a solid as a default cannot be translated to OpenSCAD");
      continue;
    }
    tr_plan(w, any ? ",%_%s" : "%s", name(w, p));
    if (at(w, p)->first) tr_plan(w, " = %v", at(w, p)->first);
    any = true;
  }
  tr_index b;
  for (uint32_t i = 0; define && (b = tr_besides(w->t, define, i)) != 0; i++) {
    if (w->t->variables[b].type == TR_A_SOLID) continue;
    tr_plan(w, any ? ",%_%s" : "%s", w->t->variables[b].name);
    any = true;
  }
}

static bool is_local_value(const tr_writer *w, tr_index n) {
  return at(w, n)->kind == TR_DEFINE && !var(w, n)->lifted && at(w, n)->first;
}

static void plan_value_of(tr_writer *w, tr_index define) {
  tr_plan(w, "%s = %v", name(w, define), at(w, define)->first);
}

static void no_effects(tr_writer *w, tr_index n) {
  if (at(w, n)->draws) tr_complain(w->t, n, "this draws or prints within an expression, which OpenSCAD cannot");
}

static void plan_body(tr_writer *w, tr_index n, int level) {
  bool any = false, brackets = level > TR_LOOSE;
  tr_index last = at(w, n)->last;
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    if (at(w, i)->kind != TR_DEFINE && i != last) no_effects(w, i);
    if (!is_local_value(w, i)) continue;
    if (!any) tr_plan(w, brackets ? "(let (" : "let (");
    else tr_plan(w, ",%_");
    plan_value_of(w, i);
    any = true;
  }
  if (!last || at(w, last)->kind == TR_DEFINE) {
    tr_plan(w, any ? ") undef" : "undef");
    if (any && brackets) tr_plan(w, ")");
  } else if (any) tr_plan(w, brackets ? ")%_%v)" : ")%_%v", last);
  else tr_plan_value(w, last, level);
}

/* Plans the loops and tests of a map, such as "for (...) if (...) ", without its element. */
static void plan_loops(tr_writer *w, tr_index n, bool statement) {
  if (at(w, n)->parallel) {
    tr_index first = at(w, n)->first;
    int number = 0;
    tr_plan(w, "let (rows = [");
    for (tr_index i = first; i && at(w, i)->kind == TR_DEFINE; i = at(w, i)->next)
      tr_plan(w, i == first ? "%v" : ",%_%v", at(w, i)->first);
    tr_plan(w, "]) for (turn = [0 : 1 : shortest(rows) - 1]) let (");
    for (tr_index i = first; i && at(w, i)->kind == TR_DEFINE; i = at(w, i)->next) {
      char text[40];
      int size = snprintf(text, sizeof text, "%srows[%d][turn]", " = ", number++);
      tr_plan(w, i == first ? "%s%s" : ", %s%s", name(w, i), know_text(w->t->k, text, (size_t)size));
    }
    tr_plan(w, ") ");
  }
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    if (at(w, i)->kind == TR_WHEN) {
      tr_plan(w, "if (%b) ", at(w, i)->first);
      continue;
    }
    if (at(w, i)->kind != TR_DEFINE || at(w, n)->parallel) continue;
    tr_index list = at(w, i)->first;
    char text[80];
    snprintf(text, sizeof text, "for %s", at(w, list)->kind == TR_PRIMITIVE ? at(w, list)->text : "");
    uint16_t row = at(w, list)->kind == TR_PRIMITIVE ? tr_word_next(text, 0) : 0;
    if (statement && tr_is_solid(w->t, list))
      tr_complain(w->t, list, "a loop over solids cannot be translated to OpenSCAD");
    tr_plan(w, "for (%s = ", name(w, i));
    uint32_t count = at(w, list)->count;
    while (row && strlen(tr_word_row(w->target, row).arguments) != count) row = tr_word_next(text, row);
    if (row) {
      uint16_t own = at(w, list)->row;
      w->t->nodes[list].row = row;
      tr_plan_row(w, list, TR_LOOSE);
      w->t->nodes[list].row = own;
    } else tr_plan(w, "%v", list);
    tr_plan(w, ") ");
  }
}

static void plan_choice(tr_writer *w, tr_index test, tr_index then, tr_index other, int level) {
  if (level > TR_CHOICE) tr_plan(w, "(");
  tr_plan(w, "%b ?%_", test);
  tr_plan_value(w, then, TR_EITHER);
  tr_plan(w, " :%_");
  if (other) tr_plan_value(w, other, TR_CHOICE);
  else tr_plan(w, "undef");
  if (level > TR_CHOICE) tr_plan(w, ")");
}

/* Plans the text of and, or. If all operands are tests, uses OpenSCAD's operators. Otherwise the value is that of an
 * operand, as in Scheme. */
static void plan_and_or(tr_writer *w, tr_index n, int level) {
  bool and = at(w, n)->kind == TR_AND, tests = true;
  int own = and ? TR_BOTH : TR_EITHER;
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) tests = tests && is_boolean(w, i);
  if (tests && own < level) tr_plan(w, "(");
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    bool last = !at(w, i)->next;
    if (tests) {
      tr_plan_value(w, i, own + 1);
      if (!last) tr_plan(w, and ? " &&%_" : " ||%_");
    } else if (last) tr_plan(w, "%v", i);
    else if (and) tr_plan(w, "%t == false ? false :%_", i);
    else tr_plan(w, "let (it = %v)%_it != false ? it :%_", i);
  }
  if (tests && own < level) tr_plan(w, ")");
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
  case TR_NAME: plan_name(w, n); break;
  case TR_PRIMITIVE:
    if (!strcmp(node->text, "native")) tr_plan(w, "%s", at(w, node->first)->text);
    else if (node->row) {
      tr_word row = tr_word_row(w->target, node->row);
      if (*row.result == 'o' || *row.result == 'v' || tr_row_has_block(row.text))
        no_value(w, n, node->text);
      else tr_plan_row(w, n, level);
    }
    break;
  case TR_CALL: plan_call(w, n); break;
  case TR_PROCEDURE:
    if (tr_is_solid(w->t, body_of(w, n)) || at(w, body_of(w, n))->draws) {
      tr_complain(w->t, n, "a procedure that makes solids cannot be used as a value in OpenSCAD");
      break;
    }
    if (level > TR_LOOSE) tr_plan(w, "(");
    tr_plan(w, "function (");
    plan_parameters(w, n, 0);
    tr_plan(w, ")%_%v", body_of(w, n));
    if (level > TR_LOOSE) tr_plan(w, ")");
    break;
  case TR_BODY: plan_body(w, n, level); break;
  case TR_IF: plan_choice(w, node->first, tr_nth(w->t, n, 1), tr_nth(w->t, n, 2), level); break;
  case TR_AND: case TR_OR: {
    bool whole = !is_boolean(w, n) && level > TR_LOOSE;
    if (whole) tr_plan(w, "(");
    plan_and_or(w, n, whole ? TR_LOOSE : level);
    if (whole) tr_plan(w, ")");
    break;
  }
  case TR_LIST:
    tr_plan(w, "[");
    for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, i == node->first ? "%v" : ",%_%v", i);
    tr_plan(w, "]");
    break;
  case TR_MAP:
    tr_plan(w, "[");
    plan_loops(w, n, false);
    tr_plan(w, "%v]", node->last);
    break;
  case TR_KEYWORD: tr_plan_value(w, node->first, level); break;
  case TR_NOTHING: case TR_ABSENT: case TR_SET: case TR_DEFINE: case TR_PARAMETER: case TR_WHEN:
    tr_plan(w, "undef");
    break;
  }
}

/* ---- solids ---- */

/* Returns true if the primitive only unites its solids. *from is the index of the first of these arguments. */
static bool unites(const tr_writer *w, tr_index n, uint32_t *from) {
  if (at(w, n)->kind == TR_LIST) return *from = 0, true;
  if (at(w, n)->kind != TR_PRIMITIVE || !at(w, n)->row) return false;
  const char *text = tr_word_row(w->target, at(w, n)->row).text;
  if (*text != '@' || text[2] != '+') return false;
  *from = (uint32_t)(text[1] - '1');
  return true;
}

static bool has_values(const tr_writer *w, tr_index body) {
  for (tr_index i = at(w, body)->first; i; i = at(w, i)->next)
    if (is_local_value(w, i)) return true;
  return false;
}

/* Plans the statements of a body as a block of its own. draws: as statements that draw. */
static void plan_block(tr_writer *w, tr_index n, bool draws) {
  if (at(w, n)->kind != TR_BODY) {
    tr_plan(w, draws ? "%d" : "%l", n);
    return;
  }
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    if (is_local_value(w, i)) {
      tr_plan_comments(w, i, TR_PIECE_COMMENTS, false);
      tr_plan(w, "%n");
      plan_value_of(w, i);
      tr_plan(w, ";");
      tr_plan_comments(w, i, TR_PIECE_BEHIND, false);
    } else if (at(w, i)->kind == TR_DEFINE) continue;
    else if (draws) tr_plan(w, "%d", i);
    else if (i == at(w, n)->last) tr_plan(w, "%l", i);
    else no_effects(w, i);
  }
}

static bool is_nothing(const tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (node->kind == TR_LIST) return !node->count;
  return node->kind == TR_NOTHING || (node->kind == TR_PRIMITIVE && !strcmp(node->text, "empty-object"));
}

static void plan_braces(tr_writer *w, tr_index n, bool draws) {
  if (is_nothing(w, n)) {
    tr_plan(w, "{}");
    return;
  }
  tr_plan(w, "{%>");
  plan_block(w, n, draws);
  tr_plan(w, "%<%n}");
}

/* Plans the body of a statement such as `for` or `if`. A body with several objects needs braces. */
static void plan_held(tr_writer *w, tr_index n, bool draws) {
  uint32_t from = 0;
  bool several = unites(w, n, &from) && at(w, n)->count != from + 1;
  if (draws || several || (at(w, n)->kind == TR_BODY && has_values(w, n))) plan_braces(w, n, draws);
  else tr_plan(w, "%o", n);
}

static void plan_if(tr_writer *w, tr_index n, bool draws) {
  tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
  tr_plan(w, "if (%b) ", at(w, n)->first);
  plan_braces(w, then, draws);
  if (!other || (at(w, other)->kind == TR_LIST && !at(w, other)->count)) return;
  tr_plan(w, " else ");
  if (at(w, other)->kind == TR_IF) plan_if(w, other, draws);
  else plan_braces(w, other, draws);
}

/* Plans the solid arguments of a call as the children of the module's call. */
static void plan_children(tr_writer *w, tr_index call, tr_index procedure, const tr_variable *v) {
  tr_index solids[64];
  int count = 0;
  tr_index p = procedure ? at(w, procedure)->first : 0, b;
  for (tr_index a = call ? at(w, at(w, call)->first)->next : 0; a && p; a = at(w, a)->next, p = at(w, p)->next)
    if (var(w, p)->type == TR_A_SOLID && count < 64) solids[count++] = a;
  int plain = count, free_solids = 0;
  for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++)
    free_solids += w->t->variables[b].type == TR_A_SOLID;
  if (plain + free_solids == 0) {
    tr_plan(w, ";");
    return;
  }
  if (plain + free_solids > 1) tr_plan(w, " {%>");
  for (int i = 0; i < plain; i++) tr_plan(w, plain + free_solids > 1 ? "%n%o" : " %o", solids[i]);
  tr_index around = call ? at(w, call)->procedure : 0;
  for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++) {
    if (w->t->variables[b].type != TR_A_SOLID) continue;
    char text[40];
    int n = snprintf(text, sizeof text, "children(%d);", child_number(w, around, b));
    tr_plan(w, plain + free_solids > 1 ? "%n%s" : " %s", know_text(w->t->k, text, (size_t)n));
  }
  if (plain + free_solids > 1) tr_plan(w, "%<%n}");
}

static void plan_solid_call(tr_writer *w, tr_index n) {
  tr_index callee = at(w, n)->first;
  const tr_variable *v = at(w, callee)->kind == TR_NAME ? var(w, callee) : NULL;
  if (!v || !v->module) {
    tr_complain(w->t, n, v && !v->procedure ? "a procedure that makes solids cannot be used as a value in OpenSCAD"
                : "this gives no solid that OpenSCAD could place");
    return;
  }
  tr_plan(w, "%s(", v->name);
  plan_arguments(w, n, v->procedure);
  tr_plan(w, ")");
  plan_children(w, n, v->procedure, v);
}

static void plan_solid_name(tr_writer *w, tr_index n) {
  const tr_variable *v = var(w, n);
  tr_index b;
  if (v->module && !v->procedure) {
    bool any = false;
    tr_plan(w, "%s(", v->name);
    for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++) {
      if (w->t->variables[b].type == TR_A_SOLID) continue;
      tr_plan(w, any ? ", %s" : "%s", w->t->variables[b].name);
      any = true;
    }
    tr_plan(w, ")");
    bool solids = false;
    for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++)
      if (w->t->variables[b].type == TR_A_SOLID) {
        char text[40];
        int size = snprintf(text, sizeof text, "children(%d);", child_number(w, at(w, n)->procedure, b));
        if (!solids) tr_plan(w, " {%>");
        tr_plan(w, "%n%s", know_text(w->t->k, text, (size_t)size));
        solids = true;
      }
    tr_plan(w, solids ? "%<%n}" : ";");
    return;
  }
  int child = child_number(w, at(w, n)->procedure, at(w, n)->variable);
  if (child < 0) {
    tr_complain(w->t, n, "%s: this is no solid that OpenSCAD could place", v->text);
    return;
  }
  char text[40];
  int size = snprintf(text, sizeof text, "children(%d);", child);
  tr_plan(w, "%s", know_text(w->t->k, text, (size_t)size));
}

static void plan_map(tr_writer *w, tr_index n, bool draws) {
  plan_loops(w, n, true);
  plan_held(w, at(w, n)->last, draws);
}

/* Plans a node as a single statement. */
static void plan_single(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  uint32_t from = 0;
  if (unites(w, n, &from)) {
    tr_index i = tr_nth(w->t, n, from);
    if (i && !at(w, i)->next) tr_plan(w, "%o", i);
    else {
      tr_plan(w, "union() {%>");
      for (; i; i = at(w, i)->next) tr_plan(w, "%l", i);
      tr_plan(w, "%<%n}");
    }
    return;
  }
  switch ((tr_node_kind)node->kind) {
  case TR_NAME: plan_solid_name(w, n); break;
  case TR_CALL: plan_solid_call(w, n); break;
  case TR_IF: plan_if(w, n, false); break;
  case TR_MAP: plan_map(w, n, false); break;
  case TR_BODY:
    if (has_values(w, n)) tr_plan(w, "union() "), plan_braces(w, n, false);
    else if (node->last && at(w, node->last)->kind != TR_DEFINE) tr_plan(w, "%o", node->last);
    else tr_plan(w, "union() {}");
    break;
  case TR_PRIMITIVE: {
    tr_word row = tr_word_row(w->target, node->row ? node->row : 1);
    if (!strcmp(node->text, "native")) tr_plan(w, "%s", at(w, node->first)->text);
    else if (!node->row) break; /* for a primitive without a row, a complaint exists already */
    else if ((*row.result != 'o' && !tr_row_has_block(row.text))) {
      tr_complain(w->t, n, "%s: this gives no solid that OpenSCAD could place", node->text);
    } else {
      bool sets = !strncmp(row.text, "intersection() @*", 17);
      for (tr_index i = node->first; sets && i; i = at(w, i)->next)
        if (at(w, i)->kind == TR_MAP || at(w, i)->kind == TR_LIST) {
          tr_complain(w->t, i, "intersect of a list cannot be translated to OpenSCAD: name the solids one by one");
        }
      tr_plan_row(w, n, TR_LOOSE);
      if (!tr_row_has_block(row.text)) tr_plan(w, ";");
    }
    break;
  }
  case TR_LIST: case TR_NOTHING: case TR_ABSENT: tr_plan(w, "union() {}"); break;
  default: tr_complain(w->t, n, "this is no solid that OpenSCAD could place");
  }
}

/* Plans a node as one or several statements, each on its own line. */
static void plan_statements(tr_writer *w, tr_index n) {
  uint32_t from = 0;
  if (is_nothing(w, n)) return;
  if (unites(w, n, &from)) {
    for (tr_index i = tr_nth(w->t, n, from); i; i = at(w, i)->next)
      if (at(w, i)->kind != TR_KEYWORD) tr_plan(w, "%l", i);
  } else if (at(w, n)->kind == TR_BODY && !has_values(w, n) && at(w, n)->last) tr_plan(w, "%l", at(w, n)->last);
  else tr_plan_commented(w, "%n%o", n);
}

/* Plans the objects that a statement adds to the drawing. */
static void plan_draw(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (!node->draws) return;
  switch ((tr_node_kind)node->kind) {
  case TR_PRIMITIVE: {
    tr_word row = tr_word_row(w->target, node->row ? node->row : 1);
    if (!strcmp(node->text, "draw"))
      for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%l", i);
    else if (node->row && *row.result == 'v' && *row.text) {
      tr_plan(w, "%n");
      tr_plan_row(w, n, TR_LOOSE);
      tr_plan(w, ";");
    } else
      for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%d", i);
    break;
  }
  case TR_IF:
    tr_plan(w, "%n");
    plan_if(w, n, true);
    break;
  case TR_MAP:
    tr_plan(w, "%n");
    plan_map(w, n, true);
    break;
  case TR_BODY:
    if (!has_values(w, n)) plan_block(w, n, true);
    else tr_plan(w, "%nunion() "), plan_braces(w, n, true);
    break;
  case TR_CALL:
    if (at(w, at(w, n)->first)->kind == TR_NAME && var(w, at(w, n)->first)->draws) {
      tr_plan(w, "%n");
      plan_solid_call(w, n);
      break;
    } /* fall through */
  default:
    for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%d", i);
  }
}

/* ---- definitions ---- */

static void plan_module(tr_writer *w, tr_index define) {
  tr_index value = at(w, define)->first, procedure = at(w, value)->kind == TR_PROCEDURE ? value : 0;
  bool draws = procedure && at(w, procedure)->draws;
  const tr_variable *v = var(w, define);
  tr_plan(w, "module %s(", name(w, define));
  plan_parameters(w, procedure, define);
  tr_plan(w, ") {%>");
  plan_block(w, procedure ? body_of(w, procedure) : value, draws);
  if (!v->lifted) tr_plan_comments(w, define, TR_PIECE_COMMENTS, true);
  tr_plan(w, "%<%n}");
}

/* Plans a parameter's default, followed by the comment that OpenSCAD's customizer reads. */
static void plan_parameter(tr_writer *w, tr_index define) {
  const knowledge *k = w->t->k;
  know_index n = at(w, define)->source, value[5] = {0};
  static const char *const keys[] = {"min", "max", "step", "choices", "label"};
  for (know_index i = k->nodes[n].first; i; i = k->nodes[i].next) {
    const char *key = k->nodes[i].kind == KNOW_KEYWORD ? k->names[k->nodes[i].name].text : "";
    if (!strncmp(key, "#:", 2)) key += 2;
    for (int j = 0; j < 5; j++)
      if (!strcmp(keys[j], key)) value[j] = k->nodes[i].next;
  }
  if (value[4] && k->nodes[value[4]].kind == KNOW_STRING) {
    size_t length;
    const char *text = know_spelling(k, value[4], &length);
    const char *said = tr_string_text(w->t->k, text, length);
    if (said) tr_plan_comment(w, said), tr_plan(w, "%n");
  }
  plan_value_of(w, define);
  tr_plan(w, ";");
  const char *said[3] = {0};
  for (int j = 0; j < 3; j++)
    if (value[j] && k->nodes[value[j]].kind == KNOW_NUMBER) {
      size_t length;
      const char *text = know_spelling(k, value[j], &length);
      said[j] = know_text(w->t->k, text, length);
    }
  bool whole = at(w, at(w, define)->first)->kind == TR_NUMBER && !strpbrk(at(w, at(w, define)->first)->text, "./e");
  if (said[0] && said[1] && (said[2] || whole)) tr_plan(w, " // [%s:%s:%s]", said[0], said[2] ? said[2] : "1", said[1]);
  else if (said[0] && said[1]) tr_plan(w, " // [%s:%s]", said[0], said[1]);
}

static void plan_define(tr_writer *w, tr_index define) {
  const tr_variable *v = var(w, define);
  tr_index value = at(w, define)->first;
  if (v->module) plan_module(w, define);
  else if (v->model_parameter) plan_parameter(w, define);
  else if (v->procedure) {
    tr_plan(w, "function %s(", v->name);
    plan_parameters(w, value, v->lifted ? define : 0);
    tr_plan(w, ") =%>%n%v;%<", body_of(w, value));
  } else {
    plan_value_of(w, define);
    tr_plan(w, ";");
  }
}

static void emit(tr_writer *w, const tr_piece *p) {
  switch ((tr_piece_kind)p->kind) {
  case TR_PIECE_VALUE: plan_value(w, p->node, p->level); break;
  case TR_PIECE_TEST: plan_test(w, p->node, p->level); break;
  case TR_PIECE_SINGLE: plan_single(w, p->node); break;
  case TR_PIECE_STATEMENTS: plan_statements(w, p->node); break;
  case TR_PIECE_DRAW: plan_draw(w, p->node); break;
  default: break;
  }
}

/* Writes definitions at top level that were moved out of the statement which follows. */
static void write_lifted(tr_writer *w, tr_index from, tr_index to) {
  for (tr_index i = from; i < to; i++) {
    if (at(w, i)->kind != TR_DEFINE || !var(w, i)->lifted || var(w, i)->define != i) continue;
    plan_define(w, i);
    tr_write_planned(w);
    tr_put(w, "\n", 1);
  }
}

static bool within(const tr_writer *w, tr_index n, tr_index top) {
  while (n && at(w, n)->parent != w->t->root) n = at(w, n)->parent;
  return n == top;
}

static void write_lifted_of(tr_writer *w, tr_index top) {
  for (tr_index i = 1; i < w->t->node_count; i++)
    if (at(w, i)->kind == TR_DEFINE && var(w, i)->lifted && var(w, i)->define == i && within(w, i, top))
      write_lifted(w, i, i + 1);
}

void tr_openscad_program(tr_writer *w) {
  w->emit = emit;
  bool lifts = false;
  for (tr_index i = 1; i < w->t->node_count; i++)
    lifts = lifts || (at(w, i)->kind == TR_DEFINE && var(w, i)->lifted);
  char text[60];
  int n = snprintf(text, sizeof text, "$fn = %u; // facets of a full turn\n", w->segments);
  tr_index first = at(w, w->t->root)->first;
  tr_put(w, text, (size_t)n);
  for (tr_index i = first; i && !*w->t->k->trouble; i = at(w, i)->next) {
    bool define = at(w, i)->kind == TR_DEFINE;
    bool shows = w->t->draws ? at(w, i)->draws : tr_is_solid(w->t, i);
    tr_gap_before(w, at(w, i)->source);
    tr_comments_before(w, at(w, i)->source);
    if (lifts) write_lifted_of(w, i);
    size_t before = w->out_count;
    if (define && !var(w, i)->module) {
      tr_comments_inside(w, at(w, i)->source, true);
      if (w->out_count > before) tr_put(w, "\n", 1);
    }
    if (define) {
      plan_define(w, i);
      if (at(w, i)->draws && !var(w, i)->procedure) tr_plan(w, "%n%s();", name(w, i));
    } else if (shows && w->t->draws) tr_plan(w, "%d", i);
    else if (shows) tr_plan(w, "%l", i);
    tr_write_statement(w, before, at(w, i)->source);
  }
}
