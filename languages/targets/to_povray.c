/* Writes programs in POV-Ray's scene language.
 *
 * Procedures become macros. The text of a macro's call is its value, so directives may occur inside expressions: (#if
 * (a) b #else c #end). Solids are objects, points are vectors, lists are arrays of one or more numbers, points, strings
 * or arrays. An array that a macro returns can neither be indexed nor measured directly, nor occur in the braces of
 * another array. The helper macros item and count_of, and statements, replace this. A macro can use only its own
 * variables and those of the file, and macros nest at most a hundred deep. Therefore local procedures move to top
 * level, and procedures that call themselves only at their end become loops. */
#include "languages/targets/to_povray.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "languages/targets/target_colours.h"
#include "languages/translate/lift_procedures.h"
#include "languages/translate/text_plan.h"
#include "languages/translate/value_kinds.h"
#include "languages/translate/words.h"

/* In this file, a piece of kind TR_PIECE_STATEMENTS is a node as an iteration of a loop; TR_PIECE_DRAW is a node as
 * statements that draw. */

static const tr_node *at(const tr_writer *w, tr_index n) { return &w->t->nodes[n]; }
static tr_variable *var(const tr_writer *w, tr_index n) { return &w->t->variables[at(w, n)->variable]; }
static const char *name(const tr_writer *w, tr_index n) { return var(w, n)->name ? var(w, n)->name : "none"; }

static bool is_list(const tr_writer *w, tr_index n) {
  uint8_t type = at(w, n)->type;
  return type >= TR_LIST_OF || type == TR_A_CURVE || type == TR_A_PATH;
}

static void no_macros(tr_writer *w, tr_index n) {
  if (at(w, n)->type >= TR_LIST_OF && at(w, n)->type % TR_LIST_OF == TR_A_PROCEDURE)
    tr_complain(w->t, n, "POV-Ray's macros are no values");
}

/* ---- values ---- */

/* Plans an assignment of the value to a variable. For a number, point or colour it ends in a semicolon. For other
 * values it must not, if an #if makes them. */
static void plan_set(tr_writer *w, const char *before, const char *what, const char *after, tr_index value,
                     bool solid) {
  tr_plan(w, solid ? "%s%s%s = %o" : "%s%s%s = %v", before, what, after, value);
  bool plain = at(w, value)->type != TR_A_STRING && !is_list(w, value);
  if (!solid && (plain || tr_is_colour(w, value))) tr_plan(w, ";");
}

static void plan_value(tr_writer *w, tr_index n, int level);

static void plan_test(tr_writer *w, tr_index n) {
  uint8_t type = at(w, n)->type;
  if (type == TR_A_BOOLEAN || type == TR_UNKNOWN) tr_plan(w, "%v", n);
  else if (type == TR_ANYTHING) tr_complain(w->t, n, "POV-Ray cannot tell a false from another value");
  else tr_plan(w, "true");
}

static tr_index parameter_default(const tr_writer *w, tr_index procedure, uint32_t nth) {
  tr_index p = procedure ? tr_nth(w->t, procedure, nth) : 0;
  return p && at(w, p)->kind == TR_PARAMETER ? at(w, p)->first : 0;
}

/* Returns true if the nth parameter of the procedure is a solid. */
static bool takes_solid(const tr_writer *w, tr_index procedure, uint32_t nth) {
  tr_index p = procedure ? tr_nth(w->t, procedure, nth) : 0;
  return p && at(w, p)->kind == TR_PARAMETER && var(w, p)->type == TR_A_SOLID;
}

static void plan_call(tr_writer *w, tr_index n) {
  tr_index callee = at(w, n)->first, b;
  if (at(w, callee)->kind != TR_NAME || !var(w, callee)->procedure) {
    tr_complain(w->t, n, "POV-Ray's macros are no values: a procedure that is used as a value cannot be called");
    return;
  }
  const tr_variable *v = var(w, callee);
  tr_plan(w, "%s(", name(w, callee));
  uint32_t count = 0, parameters = 0;
  while (at(w, tr_nth(w->t, v->procedure, parameters))->kind == TR_PARAMETER) parameters++;
  tr_index a = at(w, callee)->next;
  for (; count < parameters; count++) {
    tr_index given = a && at(w, a)->kind != TR_ABSENT ? a : parameter_default(w, v->procedure, count);
    if (count) tr_plan(w, ",%_");
    if (given) tr_plan(w, takes_solid(w, v->procedure, count) ? "%o" : "%v", given);
    if (a) a = at(w, a)->next;
  }
  for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, v->define, i)) != 0; i++, count++)
    tr_plan(w, w->t->variables[b].type == TR_A_SOLID ? count ? ",%_object { %s }" : "object { %s }"
               : count ? ",%_%s" : "%s", w->t->variables[b].name);
  tr_plan(w, ")");
}

/* Plans the number of iterations of a map: the length of its lists; `first` is the first list. parallel: the length of
 * the shortest list. */
static void plan_size(tr_writer *w, tr_index first, bool parallel) {
  if (parallel) tr_plan(w, "min(");
  for (tr_index i = first; at(w, i)->kind == TR_DEFINE; i = at(w, i)->next) {
    tr_plan(w, i == first ? "dimension_size(%s__of, 1)" : ", dimension_size(%s__of, 1)", name(w, i));
    if (!parallel) return;
  }
  tr_plan(w, ")");
}

/* If the variable counts from 0 up to a number, returns the node of this number, otherwise 0. */
static tr_index counted(const tr_writer *w, tr_index define) {
  const tr_node *list = at(w, at(w, define)->first);
  return list->kind == TR_PRIMITIVE && !strcmp(list->text, "iota") && list->count == 1 ? list->first : 0;
}

/* Plans the loops of a map, with the variables of each iteration. makes: the elements are stored in an array named
 * x__out. */
static void plan_loop(tr_writer *w, tr_index n, bool makes) {
  tr_index first = at(w, n)->first, last = at(w, n)->last;
  bool parallel = at(w, n)->parallel;
  for (tr_index i = first; i != last; i = at(w, i)->next) {
    tr_index list = at(w, i)->first, number = at(w, i)->kind == TR_DEFINE && !parallel ? counted(w, i) : 0;
    if (at(w, i)->kind == TR_WHEN) {
      tr_plan(w, " #if (%b)", list);
      continue;
    }
    if (tr_is_solid(w->t, list)) tr_complain(w->t, list, "a loop over solids cannot be translated to POV-Ray");
    if (i != first) tr_plan(w, " ");
    if (number) {
      if (makes) tr_plan(w, "#local %s__out = array[%v]; ", name(w, i), number);
      tr_plan(w, "#for (%s, 0, %t - 1)", name(w, i), number);
      continue;
    }
    tr_plan(w, "#local %s__of = %v", name(w, i), list);
    if (parallel && i != first) {
      if (at(w, at(w, i)->next)->kind == TR_DEFINE) continue;
    } else if (parallel && at(w, at(w, i)->next)->kind == TR_DEFINE) continue;
    if (makes) {
      tr_plan(w, " #local %s__out = array[", name(w, first));
      plan_size(w, parallel ? first : i, parallel);
      tr_plan(w, "];");
    }
    tr_plan(w, " #for (%s__at, 0, ", name(w, parallel ? first : i));
    plan_size(w, parallel ? first : i, parallel);
    tr_plan(w, " - 1)");
    for (tr_index v = parallel ? first : i; at(w, v)->kind == TR_DEFINE; v = at(w, v)->next) {
      tr_plan(w, " #local %s = %s__of[%s__at];", name(w, v), name(w, v), name(w, parallel ? first : i));
      if (!parallel) break;
    }
  }
}

static void plan_loop_ends(tr_writer *w, tr_index n) {
  bool first = true;
  for (tr_index i = at(w, n)->first; i != at(w, n)->last; i = at(w, i)->next) {
    if (first || at(w, i)->kind == TR_WHEN || !at(w, n)->parallel) tr_plan(w, " #end");
    first = false;
  }
}

/* Plans a list that is made from another list: an array to which each iteration of a loop adds an element. */
static void plan_map(tr_writer *w, tr_index n) {
  tr_index first = at(w, n)->first, last = at(w, n)->last;
  bool simple = at(w, first)->next == last || at(w, n)->parallel;
  for (tr_index i = first; i != last; i = at(w, i)->next) simple = simple && at(w, i)->kind == TR_DEFINE;
  if (!simple) {
    tr_complain(w->t, n, "a list of a length that is not known before cannot be translated to POV-Ray");
    return;
  }
  const char *x = name(w, first);
  plan_loop(w, n, true);
  tr_plan(w, " #local %s__out[%s%s] = %v;", x, x, !at(w, n)->parallel && counted(w, first) ? "" : "__at", last);
  plan_loop_ends(w, n);
  tr_plan(w, " %s__out", x);
}

static void plan_locals(tr_writer *w, tr_index body) {
  for (tr_index i = at(w, body)->first; i; i = at(w, i)->next) {
    if (at(w, i)->kind == TR_DEFINE && !var(w, i)->lifted)
      plan_set(w, "#local ", name(w, i), "", at(w, i)->first, tr_is_solid(w->t, at(w, i)->first)), tr_plan(w, " ");
  }
}

static void plan_name(tr_writer *w, tr_index n) {
  if (var(w, n)->procedure || at(w, n)->type == TR_A_PROCEDURE)
    tr_complain(w->t, n, "%s: POV-Ray's macros are no values", var(w, n)->text);
  else if (var(w, n)->colour == 1 && !at(w, n)->colour && var(w, n)->type == TR_A_STRING)
    tr_complain(w->t, n, "%s is used as a colour and as text, and POV-Ray's colours are no text", var(w, n)->text);
  else tr_plan(w, "%s", name(w, n));
}

static bool in_brackets(uint8_t type, uint8_t colour) {
  return type == TR_A_NUMBER || type == TR_A_BOOLEAN || type == TR_A_POINT || type == TR_A_MATERIAL ||
         type == TR_UNKNOWN || colour == 1;
}

/* Plans a colour as a vector of red, green, blue and transparency, because a test (#if) cannot select between POV-Ray's
 * own colours where a name is defined. */
static void plan_colour(tr_writer *w, tr_index n) {
  tr_colour c;
  char out[100];
  if (!tr_find_colour(w, n, &c)) return;
  int size = snprintf(out, sizeof out, "<%.4g, %.4g, %.4g, %.4g>", c.r, c.g, c.b, c.transparency);
  tr_plan(w, "%s", know_text(w->t->k, out, (size_t)size));
}

/* Returns the number of bytes at the beginning of the text, whole characters, whose output is short enough for a
 * literal. In the output an ASCII character has at most two bytes, any other character six. */
static size_t short_text(const char *text) {
  enum { MOST = 200 };
  size_t n = 0, written = 0, step = 0;
  for (; text[n] && written <= MOST; n += step) {
    step = 1;
    while (((unsigned char)text[n + step] & 0xc0) == 0x80) step++;
    written += (unsigned char)text[n] < 0x80 ? 1 : 6;
  }
  return written > MOST ? n - step : n;
}

/* Plans a string. POV-Ray accepts only short literals, so a long string becomes a concatenation of literals. */
static void plan_text(tr_writer *w, const char *text) {
  size_t length = strlen(text), n = short_text(text);
  if (n >= length) {
    tr_plan_quoted(w, text);
    return;
  }
  tr_plan(w, "concat(");
  for (size_t from = 0; from < length; from += n) {
    n = short_text(text + from);
    if (from) tr_plan(w, ",%_");
    tr_plan_quoted(w, know_text(w->t->k, text + from, n));
  }
  tr_plan(w, ")");
}

static void plan_or(tr_writer *w, tr_index n, int level) {
  bool and = at(w, n)->kind == TR_AND;
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next)
    if (at(w, i)->type != TR_A_BOOLEAN && at(w, i)->type != TR_UNKNOWN) {
      tr_complain(w->t, i, "and, or of a value that is no test cannot be translated to POV-Ray");
      return;
    }
  (void)level;
  tr_plan(w, "(");
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    tr_plan_value(w, i, TR_TIGHT);
    if (at(w, i)->next) tr_plan(w, and ? " &%_" : " |%_");
  }
  tr_plan(w, ")");
}

/* Returns true if the node can be indexed directly: a name, or an element of a name's value. */
static bool indexable(const tr_writer *w, tr_index n) {
  while (at(w, n)->kind == TR_PRIMITIVE && at(w, n)->row &&
         !strncmp(tr_word_row(w->target, at(w, n)->row).text, "$1[", 3)) n = at(w, n)->first;
  return at(w, n)->kind == TR_NAME;
}

/* Returns true if the node can occur in the braces of an array. */
static bool writable(const tr_writer *w, tr_index n) {
  if (!is_list(w, n) || at(w, n)->kind == TR_NAME) return true;
  if (at(w, n)->kind != TR_LIST) return indexable(w, n);
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next)
    if (is_list(w, i) && !indexable(w, i)) return false;
  return true;
}

/* Plans the children of the node as an array. outlines: each path becomes an array of its points. */
static void plan_array(tr_writer *w, tr_index n, bool outlines) {
  char text[40], name[40];
  bool plain = true;
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next)
    plain = plain && writable(w, i) && !(outlines && at(w, i)->type == TR_A_PATH);
  int size = snprintf(text, sizeof text, "array[%u]", at(w, n)->count);
  int length = snprintf(name, sizeof name, "list__%u", n);
  const char *array = know_text(w->t->k, text, (size_t)size), *list = know_text(w->t->k, name, (size_t)length);
  if (plain) {
    tr_plan(w, "%s {", array);
    for (tr_index i = at(w, n)->first; i; i = at(w, i)->next)
      tr_plan(w, i == at(w, n)->first ? " %v" : ",%_%v", i);
    tr_plan(w, " }");
    return;
  }
  uint32_t nth = 0;
  tr_plan(w, "#local %s = %s;", list, array);
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next, nth++) {
    size = snprintf(text, sizeof text, "%u", nth);
    tr_plan(w, outlines && at(w, i)->type == TR_A_PATH ? "%_#local %s[%s] = points_of(%v);" : "%_#local %s[%s] = %v;",
            list, know_text(w->t->k, text, (size_t)size), i);
  }
  tr_plan(w, " %s", list);
}

/* Plans a primitive. If it is an element or the length of an array that POV-Ray cannot index directly, plans a macro's
 * call; otherwise, by the primitive's row. */
static void plan_primitive(tr_writer *w, tr_index n, int level) {
  const char *text = tr_word_row(w->target, at(w, n)->row).text;
  tr_index list = at(w, n)->first;
  bool element = !strncmp(text, "$1[", 3), length = !strcmp(text, "dimension_size($1, 1)");
  if ((!element && !length) || !list || (element ? indexable(w, list) : at(w, list)->kind == TR_NAME)) {
    tr_plan_row(w, n, level);
    return;
  }
  if (length) tr_plan(w, "count_of(%v)", list);
  else if (text[3] == '$') tr_plan(w, "item(%v, %v)", list, at(w, list)->next);
  else tr_plan(w, "item(%v, %s)", list, know_text(w->t->k, text + 3, strcspn(text + 3, "]")));
}

static void plan_value(tr_writer *w, tr_index n, int level) {
  const tr_node *node = at(w, n);
  if (level == TR_AS_LIST) {
    plan_array(w, n, true);
    return;
  }
  if (tr_is_solid(w->t, n) && node->kind != TR_PRIMITIVE) {
    tr_plan(w, "%o", n);
    return;
  }
  switch ((tr_node_kind)node->kind) {
  case TR_NUMBER: tr_plan(w, strpbrk(node->text, "/-") && level > TR_LOOSE ? "(%s)" : "%s", node->text); break;
  case TR_STRING:
    if (tr_is_colour(w, n)) plan_colour(w, n);
    else plan_text(w, node->text);
    break;
  case TR_BOOLEAN: tr_plan(w, node->yes ? "true" : "false"); break;
  case TR_NAME: plan_name(w, n); break;
  case TR_PRIMITIVE:
    if (!strcmp(node->text, "native")) tr_plan(w, "%o", n);
    else if (node->row) no_macros(w, n), plan_primitive(w, n, level);
    break;
  case TR_CALL: plan_call(w, n); break;
  case TR_PROCEDURE:
    tr_complain(w->t, n, "POV-Ray's macros are no values: a procedure cannot be used as a value");
    break;
  case TR_BODY: {
    bool brackets = in_brackets(node->type, node->colour);
    if (brackets) tr_plan(w, "(");
    plan_locals(w, n);
    if (node->last && at(w, node->last)->kind != TR_DEFINE) tr_plan(w, "%v", node->last);
    else tr_plan(w, "0");
    if (brackets) tr_plan(w, ")");
    break;
  }
  case TR_IF: {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    bool brackets = in_brackets(node->type, node->colour);
    if (brackets) tr_plan(w, "(");
    tr_plan(w, "#if (%b)%_%v%_#else%_", node->first, then);
    if (other) tr_plan(w, "%v%_#end", other);
    else tr_plan(w, "0%_#end");
    if (brackets) tr_plan(w, ")");
    break;
  }
  case TR_AND: case TR_OR: plan_or(w, n, level); break;
  case TR_LIST:
    if (tr_is_colour(w, n)) {
      tr_plan(w, "<");
      for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, i == node->first ? "%v" : ", %v", i);
      tr_plan(w, node->count == 3 ? ", 0>" : ">");
      break;
    }
    no_macros(w, n);
    if (!node->count) tr_complain(w->t, n, "POV-Ray has no empty lists");
    plan_array(w, n, false);
    break;
  case TR_MAP:
    no_macros(w, n);
    plan_map(w, n);
    break;
  case TR_KEYWORD: tr_plan_value(w, node->first, level); break;
  case TR_SET: case TR_NOTHING: case TR_ABSENT: case TR_DEFINE: case TR_PARAMETER: case TR_WHEN:
    tr_complain(w->t, n, "this has no value that POV-Ray could use");
    break;
  }
}

/* ---- solids ---- */

/* Plans the program's text for POV-Ray (native). If the text begins with one of these words, it describes the look of
 * the object after #:otherwise. Any other text is an object. */
static void plan_native(tr_writer *w, tr_index n) {
  static const char *const looks[] = {"texture", "pigment", "normal", "finish", "interior", "material", "photons",
    "no_shadow", "hollow"};
  tr_index other = at(w, at(w, n)->first)->next;
  const char *text = at(w, at(w, n)->first)->text, *begin = text + strspn(text, " \n\t\r");
  size_t word = strspn(begin, "abcdefghijklmnopqrstuvwxyz_");
  bool look = false;
  for (size_t i = 0; i < sizeof looks / sizeof *looks; i++)
    look = look || (strlen(looks[i]) == word && !strncmp(begin, looks[i], word));
  if (look && other) tr_plan(w, "object {%>%n%o%n%s%<%n}", other, text);
  else tr_plan(w, "%s", text);
}

static bool unites(const tr_writer *w, tr_index n) {
  if (at(w, n)->kind == TR_LIST) return true;
  return at(w, n)->kind == TR_PRIMITIVE && at(w, n)->row &&
      !strcmp(tr_word_row(w->target, at(w, n)->row).text, "@1+");
}

static void plan_solid(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (unites(w, n)) {
    if (node->count == 1) tr_plan(w, "%o", node->first);
    else if (!node->count) tr_plan(w, "nothing()");
    else {
      tr_plan(w, "union {%>");
      for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%n%o", i);
      tr_plan(w, "%<%n}");
    }
    return;
  }
  switch ((tr_node_kind)node->kind) {
  case TR_NAME: tr_plan(w, "object { %s }", name(w, n)); break;
  case TR_CALL:
    tr_plan(w, "object { ");
    plan_call(w, n);
    tr_plan(w, " }");
    break;
  case TR_IF: {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    tr_plan(w, "#if (%b)%>%n%o%<%n#else%>%n", node->first, then);
    if (other) tr_plan(w, "%o", other);
    else tr_plan(w, "nothing()");
    tr_plan(w, "%<%n#end");
    break;
  }
  case TR_BODY:
    plan_locals(w, n);
    if (node->last) tr_plan(w, "%o", node->last);
    break;
  case TR_MAP:
    tr_plan(w, "union {%>%n");
    plan_loop(w, n, false);
    tr_plan(w, " %o", node->last);
    plan_loop_ends(w, n);
    tr_plan(w, "%<%n}");
    break;
  case TR_PRIMITIVE:
    if (!strcmp(node->text, "native")) plan_native(w, n);
    else if (node->row) tr_plan_row(w, n, TR_LOOSE);
    break;
  case TR_NOTHING: case TR_ABSENT: tr_plan(w, "nothing()"); break;
  default: tr_complain(w->t, n, "this is no solid that POV-Ray could place");
  }
}

/* Plans the objects that a statement adds to the drawing. */
static void plan_draw(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (!node->draws) return;
  switch ((tr_node_kind)node->kind) {
  case TR_PRIMITIVE:
    if (!strcmp(node->text, "draw"))
      for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%ndraw(%o)", i);
    else if (node->row && *tr_word_row(w->target, node->row).result == 'v') {
      if (!*tr_word_row(w->target, node->row).text) break;
      tr_plan(w, "%n");
      tr_plan_row(w, n, TR_LOOSE);
    } else
      for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%d", i);
    break;
  case TR_IF: {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    tr_plan(w, "%n#if (%b)%>%d%<", node->first, then);
    if (other) tr_plan(w, "%n#else%>%d%<", other);
    tr_plan(w, "%n#end");
    break;
  }
  case TR_MAP:
    tr_plan(w, "%n");
    plan_loop(w, n, false);
    tr_plan(w, "%>%d%<%n", node->last);
    plan_loop_ends(w, n);
    break;
  case TR_BODY:
    for (tr_index i = node->first; i; i = at(w, i)->next) {
      if (at(w, i)->kind != TR_DEFINE) tr_plan(w, "%d", i);
      else if (!var(w, i)->lifted)
        tr_plan(w, "%n"), plan_set(w, "#local ", name(w, i), "", at(w, i)->first,
                                   tr_is_solid(w->t, at(w, i)->first));
    }
    break;
  case TR_CALL:
    tr_plan(w, "%n");
    plan_call(w, n);
    break;
  default:
    for (tr_index i = node->first; i; i = at(w, i)->next) tr_plan(w, "%d", i);
  }
}

/* ---- definitions ---- */

/* Plans the text of a procedure's body, with each local definition on a line of its own. */
static void plan_lines(tr_writer *w, tr_index n) {
  if (at(w, n)->kind != TR_BODY) {
    tr_plan_comments(w, n, TR_PIECE_COMMENTS, false);
    tr_plan(w, "%n%o", n);
    return;
  }
  for (tr_index i = at(w, n)->first; i; i = at(w, i)->next) {
    if (at(w, i)->kind == TR_DEFINE && !var(w, i)->lifted)
      tr_plan(w, "%n"), plan_set(w, "#local ", name(w, i), "", at(w, i)->first,
                                 tr_is_solid(w->t, at(w, i)->first));
    else if (i == at(w, n)->last) tr_plan(w, "%n%o", i);
  }
}

/* Returns true if the node's value is the solid that the surrounding procedure returns. */
static bool solid_result(const tr_writer *w, tr_index n) {
  while (n && at(w, n)->kind != TR_PROCEDURE) n = at(w, n)->parent;
  return n && tr_is_solid(w->t, at(w, n)->last);
}

/* Plans an iteration of a procedure that became a loop: sets its result, or the parameters of the next iteration. */
static void plan_turn(tr_writer *w, tr_index n) {
  const tr_node *node = at(w, n);
  if (node->kind == TR_IF) {
    tr_index then = tr_nth(w->t, n, 1), other = tr_nth(w->t, n, 2);
    tr_plan(w, "%n#if (%b)%>%l%<", node->first, then);
    if (other) tr_plan(w, "%n#else%>%l%<", other);
    tr_plan(w, "%n#end");
  } else if (node->kind == TR_BODY) {
    tr_plan(w, "%n");
    plan_locals(w, n);
    if (node->last) tr_plan(w, "%l", node->last);
  } else if (tr_turns(w->t, n)) {
    tr_index p = at(w, var(w, node->first)->procedure)->first, a = at(w, node->first)->next;
    for (tr_index i = p; a && at(w, i)->kind == TR_PARAMETER; i = at(w, i)->next, a = at(w, a)->next)
      tr_plan(w, "%n"), plan_set(w, "#local ", name(w, i), "__next", a, var(w, i)->type == TR_A_SOLID);
    for (tr_index i = p; at(w, i)->kind == TR_PARAMETER; i = at(w, i)->next)
      tr_plan(w, i == p ? "%n#local %s = %s__next;" : " #local %s = %s__next;", name(w, i), name(w, i));
  } else tr_plan(w, solid_result(w, n) ? "%n#local result = %o #local done = 1;" :
                 "%n#local result = %v; #local done = 1;", n);
}

static void plan_macro(tr_writer *w, tr_index define) {
  const tr_variable *v = var(w, define);
  tr_index procedure = at(w, define)->first, body = at(w, procedure)->last, b;
  uint32_t count = 0;
  tr_plan(w, "#macro %s(", name(w, define));
  for (tr_index p = at(w, procedure)->first; at(w, p)->kind == TR_PARAMETER; p = at(w, p)->next, count++)
    tr_plan(w, v->loops ? count ? ", %s__from" : "%s__from" : count ? ", %s" : "%s", name(w, p));
  for (uint32_t i = 0; v->lifted && (b = tr_besides(w->t, define, i)) != 0; i++, count++)
    tr_plan(w, count ? ", %s" : "%s", w->t->variables[b].name);
  tr_plan(w, ")%>");
  if (v->loops) {
    tr_plan(w, "%n#local done = 0;");
    for (tr_index p = at(w, procedure)->first; at(w, p)->kind == TR_PARAMETER; p = at(w, p)->next)
      tr_plan(w, " #local %s = %s__from;", name(w, p), name(w, p));
    tr_plan(w, "%n#while (done = 0)%>");
    tr_plan(w, "%l%<%n#end", body);
    bool brackets = in_brackets(v->gives, at(w, body)->colour);
    tr_plan(w, v->gives == TR_A_SOLID ? "%nobject { result }" : brackets ? "%n(result)" : "%nresult");
  } else if (at(w, procedure)->draws) tr_plan(w, "%d", body);
  else if (tr_is_solid(w->t, body)) plan_lines(w, body);
  else {
    bool brackets = in_brackets(at(w, body)->type, at(w, body)->colour) && at(w, body)->kind != TR_IF &&
                    at(w, body)->kind != TR_BODY;
    tr_plan(w, brackets ? "%n(%v)" : "%n%v", body);
  }
  tr_plan(w, "%<%n#end");
}

static void plan_define(tr_writer *w, tr_index define) {
  tr_index value = at(w, define)->first;
  if (at(w, value)->kind == TR_PROCEDURE) plan_macro(w, define);
  else plan_set(w, "#declare ", name(w, define), "", value, tr_is_solid(w->t, value));
}

static void emit(tr_writer *w, const tr_piece *p) {
  switch ((tr_piece_kind)p->kind) {
  case TR_PIECE_VALUE: plan_value(w, p->node, p->level); break;
  case TR_PIECE_TEST: plan_test(w, p->node); break;
  case TR_PIECE_SINGLE: plan_solid(w, p->node); break;
  case TR_PIECE_STATEMENTS: plan_turn(w, p->node); break;
  case TR_PIECE_DRAW: plan_draw(w, p->node); break;
  default: break;
  }
}

static tr_index top_of(const tr_writer *w, tr_index n) {
  while (n && at(w, n)->parent != w->t->root) n = at(w, n)->parent;
  return n;
}

static void put(tr_writer *w, const char *text) { tr_put(w, text, strlen(text)); }

void tr_povray_program(tr_writer *w) {
  w->emit = emit;
  put(w, "\n// The program.\n");
  for (tr_index i = at(w, w->t->root)->first; i && !*w->t->k->trouble; i = at(w, i)->next) {
    tr_gap_before(w, at(w, i)->source);
    tr_comments_before(w, at(w, i)->source);
    for (tr_index d = i; d < w->t->node_count; d++) {
      if (at(w, d)->kind != TR_DEFINE || !var(w, d)->lifted || var(w, d)->define != d || top_of(w, d) != i) continue;
      plan_define(w, d);
      tr_write_planned(w);
      put(w, "\n");
    }
    size_t before = w->out_count;
    tr_comments_inside(w, at(w, i)->source, true);
    if (w->out_count > before) put(w, "\n");
    before = w->out_count;
    if (at(w, i)->kind == TR_DEFINE) plan_define(w, i);
    else if (!w->t->draws && tr_is_solid(w->t, i)) tr_plan(w, "draw(%o)", i);
    else tr_plan(w, "%d", i);
    tr_write_statement(w, before, at(w, i)->source);
  }
  put(w, "show()\n");
}
