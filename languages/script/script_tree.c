/* Makes the nodes of an analysis from the tree of a script (a program in JavaScript).
 *
 * It calls itself once for each level of the tree, whose height languages/javascript/script.h limits. A word that the
 * text does not contain, such as js:get for a dot, has the place of the construct, with a length of 0. */
#include "languages/script/script_tree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/javascript/parser.h"
#include "languages/analysis/form_table.h"
#include "model/store/array.h"

typedef struct enclosing {
  struct enclosing *up;
  uint32_t function;
} enclosing;

typedef struct {
  knowledge *k;
  vs_script s;
  uint32_t file;
  enclosing *functions;
} maker;

static void *resize(void *context, void *at, size_t used, size_t fresh) {
  (void)context;
  size_t room = used;
  if (!fresh) return free(at), NULL;
  return vs_room_grow(&at, &room, fresh, 1) ? at : NULL;
}

static const vs_script_node *node(const maker *m, uint32_t i) { return vs_script_at(&m->s, i); }

static know_place place(const maker *m, vs_script_place at) {
  return (know_place){ m->file, at.from, at.to, at.line, at.column, at.end_line, at.end_column };
}

/* ---- nodes ---- */

static know_index leaf(maker *m, know_kind kind, vs_script_place at) {
  know_index i = know_node_new(m->k, kind);
  if (i) m->k->nodes[i].at = place(m, at);
  return i;
}

static void add(maker *m, know_index list, know_index part) {
  knowledge *k = m->k;
  if (!list || !part) return;
  know_index last = k->nodes[list].first;
  k->nodes[part].parent = list;
  k->nodes[list].count++;
  if (!last) {
    k->nodes[list].first = k->nodes[list].scope = part; /* appends the part to the list; until the tree is complete,
                                                         * `scope` stores the last part of a list */
    return;
  }
  k->nodes[k->nodes[list].scope].next = part;
  k->nodes[list].scope = part;
}

static know_index symbol(maker *m, const char *text, size_t length, vs_script_place at) {
  know_index name = know_name_of(m->k, text, length, 0, 0), i = leaf(m, KNOW_SYMBOL, at);
  if (i) m->k->nodes[i].name = name;
  return i;
}

static know_index name(maker *m, uint32_t i) {
  size_t length;
  const char *text = vs_script_spelling(&m->s, node(m, i)->name, &length);
  return symbol(m, text, length, node(m, i)->at);
}

/* makes a list node that begins with the word `word` */
static know_index list(maker *m, const char *word, vs_script_place at) {
  know_index i = leaf(m, KNOW_LIST, at);
  vs_script_place start = at;
  start.to = at.from, start.end_line = at.line, start.end_column = at.column;
  add(m, i, symbol(m, word, strlen(word), start));
  return i;
}

/* ---- declared names ---- */

typedef bool visit_fn(maker *m, uint32_t declaration, bool direct, void *context);

/* Calls visit for each DECLARATOR and function declaration in the statement i, but not in inner functions. direct:
 * whether i is a statement of the function itself, not part of another statement. */
static bool declarations(maker *m, uint32_t i, bool direct, visit_fn *visit, void *context) {
  for (; i; i = node(m, i)->next) {
    const vs_script_node *n = node(m, i);
    uint32_t parts[4] = { 0 };
    switch ((vs_script_kind)n->kind) {
    case VS_SCRIPT_VAR:
      for (uint32_t d = n->a; d; d = node(m, d)->next)
        if (!visit(m, d, direct, context)) return false;
      break;
    case VS_SCRIPT_FUNCTION:
      if (n->flag && !visit(m, i, direct, context)) return false;
      break;
    case VS_SCRIPT_BLOCK: parts[0] = n->a; break;
    case VS_SCRIPT_IF: parts[0] = n->b, parts[1] = n->c; break;
    case VS_SCRIPT_FOR:
    case VS_SCRIPT_FOR_IN: parts[0] = n->a, parts[1] = n->d; break;
    case VS_SCRIPT_WHILE:
    case VS_SCRIPT_DO: parts[0] = n->d; break;
    case VS_SCRIPT_SWITCH:
    case VS_SCRIPT_CASE:
    case VS_SCRIPT_LABEL: parts[0] = n->b; break;
    case VS_SCRIPT_TRY: parts[0] = n->a, parts[1] = n->c, parts[2] = n->d; break;
    default: break;
    }
    for (int p = 0; p < 4; p++)
      if (parts[p] && !declarations(m, parts[p], false, visit, context)) return false;
  }
  return true;
}

typedef struct {
  uint32_t name;
  bool found;
} sought;

static bool is_sought(maker *m, uint32_t d, bool direct, void *context) {
  (void)direct;
  sought *s = context;
  const vs_script_node *n = node(m, d);
  uint32_t own = n->kind == VS_SCRIPT_FUNCTION ? n->c : n->a;
  return !(s->found = node(m, own)->name == s->name);
}

/* Returns true if the name is a variable of a surrounding function, or of the program. */
static bool declared(maker *m, uint32_t name_index) {
  for (enclosing *e = m->functions; e; e = e->up) {
    const vs_script_node *f = node(m, e->function);
    sought s = { name_index, false };
    if (f->kind == VS_SCRIPT_FUNCTION)
      for (uint32_t p = f->a; p; p = node(m, p)->next)
        if (node(m, p)->name == name_index) return true;
    declarations(m, f->kind == VS_SCRIPT_FUNCTION ? f->b : f->a, true, is_sought, &s);
    if (s.found) return true;
  }
  return false;
}

/* ---- expressions ---- */

static know_index make(maker *m, uint32_t i);

static void add_all(maker *m, know_index to, uint32_t i) {
  for (; i; i = node(m, i)->next) add(m, to, make(m, i));
}

static know_index key(maker *m, uint32_t i) {
  know_index q = list(m, "js:quote", node(m, i)->at);
  const vs_script_node *n = node(m, i);
  add(m, q,
      n->kind == VS_SCRIPT_NAME ? name(m, i) : leaf(m, n->kind == VS_SCRIPT_NUMBER ? KNOW_NUMBER : KNOW_STRING, n->at));
  return q;
}

static bool uses_arguments(maker *m, uint32_t i) {
  if (!i) return false;
  const vs_script_node *n = node(m, i);
  if (n->kind == VS_SCRIPT_FUNCTION) return false;
  if (n->kind == VS_SCRIPT_NAME) return vs_script_is(&m->s, n->name, "arguments");
  uint32_t parts[4] = { n->a, n->kind == VS_SCRIPT_MEMBER ? 0 : n->b, n->c, n->d };
  for (int p = 0; p < 4; p++)
    for (uint32_t at = parts[p]; at; at = node(m, at)->next)
      if (uses_arguments(m, at)) return true;
  return false;
}

/* Adds the parameters of function i to the list `to`. If the function uses `arguments`, also adds `arguments` as the
 * rest parameter. */
static void parameters(maker *m, know_index to, uint32_t i) {
  const vs_script_node *n = node(m, i);
  for (uint32_t p = n->a; p; p = node(m, p)->next) add(m, to, name(m, p));
  bool all = false;
  for (uint32_t b = n->b; b && !all; b = node(m, b)->next) all = uses_arguments(m, b);
  if (!all) return;
  vs_script_place at = n->at;
  at.to = at.from, at.end_line = at.line, at.end_column = at.column;
  add(m, to, symbol(m, "arguments", 9, at));
  m->k->nodes[to].dotted = true;
}

static know_index statement(maker *m, uint32_t i);
static know_index definition(maker *m, uint32_t i);

static bool is_parameter(maker *m, uint32_t owner, uint32_t name_index) {
  if (node(m, owner)->kind != VS_SCRIPT_FUNCTION) return false;
  for (uint32_t p = node(m, owner)->a; p; p = node(m, p)->next)
    if (node(m, p)->name == name_index) return true;
  return false;
}

/* Moves a declaration inside another statement to the beginning of the function: of a variable without its value, of a
 * function with its whole definition. */
static bool hoist(maker *m, uint32_t d, bool direct, void *context) {
  if (direct) return true; /* a definition that is a statement of the function itself is not moved */
  uint32_t own = node(m, d)->kind == VS_SCRIPT_FUNCTION ? node(m, d)->c : node(m, d)->a;
  if (is_parameter(m, m->functions->function, node(m, own)->name)) return true;
  know_index def;
  if (node(m, d)->kind == VS_SCRIPT_FUNCTION)
    def = definition(m, d);
  else {
    def = list(m, "js:define", node(m, node(m, d)->a)->at);
    add(m, def, name(m, node(m, d)->a));
  }
  add(m, *(know_index *)context, def);
  return !*m->k->trouble;
}

/* Returns true if the value is a call at top level that declares a parameter of the model, such as gui_number. */
static bool is_model_parameter(maker *m, uint32_t owner, uint32_t value) {
  const vs_script_node *n = node(m, value);
  if (node(m, owner)->kind == VS_SCRIPT_FUNCTION || !value || n->kind != VS_SCRIPT_CALL) return false;
  uint32_t called = node(m, n->a)->kind == VS_SCRIPT_NAME ? node(m, n->a)->name : 0;
  return vs_script_is(&m->s, called, "gui_number") || vs_script_is(&m->s, called, "gui_choice") ||
         vs_script_is(&m->s, called, "gui_text");
}

/* Makes the nodes of var x = value, a statement of the function or program itself. If x is a parameter of the function,
 * it remains the parameter. */
static know_index variable(maker *m, uint32_t owner, uint32_t d) {
  const vs_script_node *n = node(m, d);
  bool again = is_parameter(m, owner, node(m, n->a)->name), model = is_model_parameter(m, owner, n->b);
  if (again && !n->b) return 0;
  know_index out = list(m, again ? "js:set!" : model ? "js:define-parameter" : "js:define", n->at);
  add(m, out, name(m, n->a));
  if (model)
    add_all(m, out, node(m, n->b)->b);
  else if (n->b)
    add(m, out, make(m, n->b));
  return out;
}

/* Makes the statements of a function or of the program. */
static void body(maker *m, know_index to, uint32_t owner) {
  const vs_script_node *n = node(m, owner);
  uint32_t first = n->kind == VS_SCRIPT_FUNCTION ? n->b : n->a;
  enclosing here = { m->functions, owner };
  m->functions = &here;
  declarations(m, first, true, hoist, &to);
  for (uint32_t i = first; i; i = node(m, i)->next) {
    if (node(m, i)->kind != VS_SCRIPT_VAR) {
      add(m, to, node(m, i)->kind == VS_SCRIPT_FUNCTION && node(m, i)->flag ? definition(m, i) : statement(m, i));
      continue;
    }
    for (uint32_t d = node(m, i)->a; d; d = node(m, d)->next) add(m, to, variable(m, owner, d));
  }
  m->functions = here.up;
}

static know_index definition(maker *m, uint32_t i) {
  const vs_script_node *n = node(m, i);
  know_index def = list(m, "js:define", n->at), head = leaf(m, KNOW_LIST, node(m, n->c)->at);
  add(m, def, head);
  add(m, head, name(m, n->c));
  parameters(m, head, i);
  body(m, def, i);
  return def;
}

static know_index function(maker *m, uint32_t i) {
  const vs_script_node *n = node(m, i);
  know_index lambda = list(m, "js:lambda", n->at), formals = leaf(m, KNOW_LIST, n->at);
  add(m, lambda, formals);
  parameters(m, formals, i);
  body(m, lambda, i);
  if (!n->c) return lambda;
  know_index rec = list(m, "js:rec", n->at);
  add(m, rec, name(m, n->c));
  add(m, rec, lambda);
  return rec;
}

/* makes a list node that begins with a word such as js:+, at the node's place */
static know_index operation_of(maker *m, const char *before, const vs_script_node *n) {
  char word[40];
  snprintf(word, sizeof word, "js:%s%s", before, vs_script_operator_word((vs_script_operator)n->op));
  return list(m, word, n->at);
}

static know_index assigned(maker *m, const vs_script_node *n, const char *before, know_index value) {
  const vs_script_node *target = node(m, n->a);
  know_index out = list(m, target->kind == VS_SCRIPT_NAME ? "js:set!" : "js:put", n->at);
  add(m, out, make(m, n->a));
  if (before) {
    know_index operation = operation_of(m, before, n);
    add(m, operation, make(m, n->a));
    add(m, operation, value);
    value = operation;
  }
  add(m, out, value);
  return out;
}

/* Makes name nodes for the script's variables that a native text (Scheme in a comment) uses. */
static know_index native(maker *m, const vs_script_node *n) {
  know_index out = list(m, "js:native", n->at);
  const char *text = m->s.texts + n->text;
  for (uint32_t i = 0; i < n->length;) {
    uint32_t length = 0;
    while (i + length < n->length && !strchr(" \t\r\n()[]{}\";'`,", text[i + length])) length++;
    uint32_t known = length ? vs_script_name_known(&m->s, text + i, length) : 0;
    if (known && declared(m, known)) add(m, out, symbol(m, text + i, length, n->at));
    i += length ? length : 1;
  }
  return out;
}

static know_index parts(maker *m, const char *word, const vs_script_node *n) {
  know_index out = list(m, word, n->at);
  uint32_t all[4] = { n->a, n->b, n->c, n->d };
  for (int p = 0; p < 4; p++) add_all(m, out, all[p]);
  return out;
}

static know_index make(maker *m, uint32_t i) {
  if (!i || *m->k->trouble) return 0;
  const vs_script_node *n = node(m, i);
  know_index out;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_NUMBER: return leaf(m, KNOW_NUMBER, n->at);
  case VS_SCRIPT_STRING: return leaf(m, KNOW_STRING, n->at);
  case VS_SCRIPT_TRUE:
  case VS_SCRIPT_FALSE: return leaf(m, KNOW_BOOLEAN, n->at);
  case VS_SCRIPT_NULL:
  case VS_SCRIPT_THIS:
  case VS_SCRIPT_HOLE: return leaf(m, KNOW_OTHER, n->at);
  case VS_SCRIPT_NAME: return name(m, i);
  case VS_SCRIPT_ARRAY: return parts(m, "js:array", n);
  case VS_SCRIPT_OBJECT: return parts(m, "js:object", n);
  case VS_SCRIPT_PROPERTY:
  case VS_SCRIPT_MEMBER: {
    bool member = n->kind == VS_SCRIPT_MEMBER;
    out = list(m, member ? "js:get" : "js:property", n->at);
    add(m, out, member ? make(m, n->a) : key(m, n->a));
    add(m, out, member ? key(m, n->b) : make(m, n->b));
    return out;
  }
  case VS_SCRIPT_FUNCTION: return n->flag ? statement(m, i) : function(m, i);
  case VS_SCRIPT_CALL:
    out = leaf(m, KNOW_LIST, n->at);
    add(m, out, make(m, n->a));
    add_all(m, out, n->b);
    return out;
  case VS_SCRIPT_NEW: return parts(m, "js:new", n);
  case VS_SCRIPT_INDEX: return parts(m, "js:at", n);
  case VS_SCRIPT_UPDATE: return assigned(m, n, "step", 0);
  case VS_SCRIPT_ASSIGN: return assigned(m, n, n->op == VS_OPERATOR_NONE ? NULL : "", make(m, n->b));
  case VS_SCRIPT_CONDITIONAL: return parts(m, "js:if", n);
  case VS_SCRIPT_SEQUENCE: return parts(m, "js:sequence", n);
  case VS_SCRIPT_UNARY:
  case VS_SCRIPT_BINARY:
  case VS_SCRIPT_LOGICAL:
    out = operation_of(m, "", n);
    if (n->op == VS_OPERATOR_TYPE_OF && node(m, n->a)->kind == VS_SCRIPT_NAME && !declared(m, node(m, n->a)->name))
      return out; /* typeof may be applied to an undeclared variable, so it is no fault */
    add(m, out, make(m, n->a));
    add(m, out, make(m, n->b));
    return out;
  default: return statement(m, i);
  }
}

/* Makes the nodes of for (x in o). The values of x are strings that are not in the text. */
static know_index for_in(maker *m, const vs_script_node *n) {
  know_index out = list(m, "js:for-in", n->at);
  uint32_t target = node(m, n->a)->kind == VS_SCRIPT_VAR ? node(m, node(m, n->a)->a)->a : n->a;
  know_index set = list(m, node(m, target)->kind == VS_SCRIPT_NAME ? "js:set!" : "js:put", node(m, target)->at);
  add(m, set, make(m, target));
  add(m, out, set);
  add(m, out, make(m, n->b));
  add(m, out, statement(m, n->d));
  return out;
}

static know_index one_statement(maker *m, uint32_t i) {
  const vs_script_node *n = node(m, i);
  know_index out;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_VAR: /* a var inside another statement: its variables are defined at the beginning of the function */
    out = list(m, "js:var", n->at);
    for (uint32_t d = n->a; d; d = node(m, d)->next) {
      if (!node(m, d)->b) continue;
      know_index set = list(m, "js:set!", node(m, d)->at);
      add(m, set, name(m, node(m, d)->a));
      add(m, set, make(m, node(m, d)->b));
      add(m, out, set);
    }
    return out;
  /* a function declaration inside another statement: its definition is at the beginning of the function */
  case VS_SCRIPT_FUNCTION: return list(m, "js:declared", n->at);
  case VS_SCRIPT_BLOCK: return parts(m, "js:block", n);
  case VS_SCRIPT_IF: return parts(m, "js:if", n);
  case VS_SCRIPT_FOR: return parts(m, "js:for", n);
  case VS_SCRIPT_FOR_IN: return for_in(m, n);
  case VS_SCRIPT_WHILE: return parts(m, "js:while", n);
  case VS_SCRIPT_DO: return parts(m, "js:do", n);
  case VS_SCRIPT_CONTINUE: return list(m, "js:continue", n->at);
  case VS_SCRIPT_BREAK: return list(m, "js:break", n->at);
  case VS_SCRIPT_RETURN: return parts(m, "js:return", n);
  case VS_SCRIPT_THROW: return parts(m, "js:throw", n);
  case VS_SCRIPT_SWITCH: return parts(m, "js:switch", n);
  case VS_SCRIPT_CASE: return parts(m, "js:case", n);
  case VS_SCRIPT_TRY:
    out = list(m, "js:try", n->at);
    add(m, out, make(m, n->a));
    if (n->c) {
      know_index lambda = list(m, "js:lambda", node(m, n->c)->at), formals = leaf(m, KNOW_LIST, node(m, n->b)->at);
      add(m, lambda, formals);
      add(m, formals, name(m, n->b));
      add(m, lambda, make(m, n->c));
      add(m, out, lambda);
    }
    add(m, out, make(m, n->d));
    return out;
  case VS_SCRIPT_LABEL:
    out = list(m, "js:label", n->at);
    add(m, out, statement(m, n->b));
    return out;
  case VS_SCRIPT_NATIVE: return native(m, n);
  case VS_SCRIPT_EMPTY: return list(m, "js:empty", n->at);
  case VS_SCRIPT_EXPRESSION: return make(m, n->a);
  default: return 0;
  }
}

static know_index statement(maker *m, uint32_t i) {
  know_index out = i ? one_statement(m, i) : 0;
  if (out && node(m, i)->kind >= VS_SCRIPT_BLOCK) m->k->nodes[out].statement = true;
  return out;
}

/* ---- the script ---- */

bool know_script_word(const char *name, uint16_t *row) {
  static const char *const same[] = { "define", "define-parameter", "lambda", "set!", "rec", "quote" };
  if (strncmp(name, "js:", 3) != 0) return false;
  *row = know_form_row("and"); /* lists that begin with this word are walked like (and ...): all other elements are
                                * expressions */
  for (size_t i = 0; i < sizeof same / sizeof *same; i++)
    if (!strcmp(name + 3, same[i])) *row = know_form_row(same[i]);
  return true;
}

static bool comments(maker *m) {
  knowledge *k = m->k;
  for (size_t i = 0; i < m->s.comment_count; i++) {
    const vs_script_comment *c = &m->s.comments[i];
    if (!VS_GROW(k->comments, k->comment_room, k->comment_count + 1))
      return know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
    k->comments[k->comment_count++] =
        (know_comment){ m->file, c->at.from, c->at.to, c->at.line, c->at.end_line, c->alone };
  }
  return true;
}

bool know_read_script(knowledge *k, uint32_t file, know_index *root) {
  maker m = { .k = k, .file = file };
  bool ok = vs_script_parse(&m.s, k->files[file].text, k->files[file].size, resize, NULL);
  if (!ok && m.s.no_memory)
    know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  else if (!ok) {
    know_place at = place(&m, m.s.trouble_at);
    know_fail(k, &at, VS_OUTCOME_MODEL, "%s", m.s.trouble);
  } else {
    size_t from = k->node_count;
    *root = leaf(&m, KNOW_LIST, node(&m, m.s.root)->at);
    body(&m, *root, m.s.root);
    for (size_t i = from; i < k->node_count; i++) k->nodes[i].scope = 0;
    ok = comments(&m) && !*k->trouble;
  }
  vs_script_close(&m.s);
  return ok;
}
