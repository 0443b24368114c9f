/* Determines the type of each expression of a lowered tree, and its row of translated_words.def.
 *
 * A type only changes from unknown to a certain type, and from there to "anything". Loops downwards over the nodes,
 * children first, pass the types that the text shows on to variables until nothing changes. A value that is still
 * unknown then gets the type that its primitive requires, and the loops continue. */
#include "languages/translate/value_kinds.h"

#include <string.h>

#include "languages/translate/words.h"

enum { MOST_ROUNDS = 200 };

typedef struct { translation *t; bool changed; } finder;

static uint8_t base_of(uint8_t type) { return type % TR_LIST_OF; }
static uint8_t depth_of(uint8_t type) { return type / TR_LIST_OF; }

static uint8_t list_of(uint8_t type) {
  if (type == TR_A_SOLID) return type;
  return depth_of(type) < TR_DEEPEST ? (uint8_t)(type + TR_LIST_OF) : type;
}

static uint8_t element(uint8_t type) {
  if (type == TR_A_SOLID || type == TR_UNKNOWN) return type;
  if (type == TR_A_POINT) return TR_A_NUMBER;
  if (type == TR_A_CURVE) return TR_A_POINT;
  return depth_of(type) ? (uint8_t)(type - TR_LIST_OF) : TR_ANYTHING;
}

static uint8_t join(uint8_t a, uint8_t b) {
  uint8_t da = depth_of(a), db = depth_of(b);
  if (a == b) return a;
  if (base_of(a) == TR_UNKNOWN && (db >= da || b == TR_A_SOLID)) return b;
  if (base_of(b) == TR_UNKNOWN && (da >= db || a == TR_A_SOLID)) return a;
  return (uint8_t)((da < db ? da : db) * TR_LIST_OF + TR_ANYTHING);
}

static void into_variable(finder *f, tr_index v, uint8_t type) {
  uint8_t all = join(f->t->variables[v].type, type);
  if (all != f->t->variables[v].type) f->t->variables[v].type = all, f->changed = true;
}
static void into_gives(finder *f, tr_index v, uint8_t type) {
  uint8_t all = join(f->t->variables[v].gives, type);
  if (all != f->t->variables[v].gives) f->t->variables[v].gives = all, f->changed = true;
}

/* Returns true if this primitive makes the value of node n, as far as variables and calls can be followed. */
static bool made_by(const translation *t, tr_index n, const char *primitive) {
  enum { MOST_STEPS = 100 };
  for (int steps = 0; n && steps < MOST_STEPS; steps++) {
    const tr_node *node = &t->nodes[n];
    const tr_variable *v = node->kind == TR_NAME ? &t->variables[node->variable] : NULL;
    if (node->kind == TR_PRIMITIVE) return !strcmp(node->text, primitive);
    if (node->kind == TR_BODY) n = node->last;
    else if (node->kind == TR_CALL) {
      const tr_node *callee = &t->nodes[node->first];
      tr_index procedure = callee->kind == TR_NAME ? t->variables[callee->variable].procedure : 0;
      n = procedure ? t->nodes[procedure].last : 0;
    } else if (v && !v->set && v->define && t->nodes[v->define].kind == TR_DEFINE && !v->procedure &&
               t->nodes[t->nodes[v->define].parent].kind != TR_MAP) n = t->nodes[v->define].first;
    else n = 0;
  }
  return false;
}

bool tr_kind_fits(const translation *t, tr_index argument, char letter) {
  const tr_node *n = &t->nodes[argument];
  uint8_t type = n->type;
  bool open = base_of(type) == TR_UNKNOWN || base_of(type) == TR_ANYTHING;
  switch (letter) {
  case '#': return type == TR_A_NUMBER;
  case 'S': return type == TR_A_STRING;
  case 'Z': return n->kind == TR_STRING && !strcmp(n->text, "z");
  case 'A': return n->kind == TR_STRING ? strlen(n->text) == 1 && strchr("xyz", *n->text) : type == TR_A_POINT || open;
  case 'L':
    return n->kind == TR_STRING ? !strcmp(n->text, "xy") || !strcmp(n->text, "xz") || !strcmp(n->text, "yz")
                                : type == TR_A_POINT || open;
  case 'o': return type == TR_A_SOLID || type == TR_UNKNOWN || (open && depth_of(type) && base_of(type) == TR_UNKNOWN);
  case 'a': return type != TR_A_SOLID;
  case 'l': return type != TR_A_SOLID && (depth_of(type) || open || type == TR_A_CURVE);
  case 'n': return type == TR_A_NUMBER || (open && !depth_of(type));
  case 'b': return type == TR_A_BOOLEAN || (open && !depth_of(type));
  case 's': return type == TR_A_STRING || (open && !depth_of(type));
  case 'p': return type == TR_A_POINT || open || type == TR_LIST_OF + TR_A_NUMBER;
  case 'V': return type == TR_LIST_OF + TR_A_NUMBER;
  case 'P': return type == TR_LIST_OF + TR_A_POINT || type == TR_A_CURVE || (open && depth_of(type) < 2);
  case 'c': return type == TR_A_CURVE || (open && !depth_of(type));
  case 'w': return type == TR_A_PATH || (open && !depth_of(type));
  case 'O': return type == TR_A_CURVE && made_by(t, argument, "make-line");
  case 'R': return type == TR_A_CURVE && made_by(t, argument, "make-region");
  case 'q': return type == TR_A_PATH || type == TR_UNKNOWN || (type == TR_A_CURVE && made_by(t, argument, "make-line"));
  case 'C': return type == TR_LIST_OF + TR_A_CURVE || open;
  case 'f': return type == TR_A_PROCEDURE || (open && !depth_of(type));
  case 'm': return type == TR_A_MATERIAL || type == TR_A_STRING || open || type == TR_LIST_OF + TR_A_NUMBER;
  default: return false;
  }
}

/* ---- the type of a primitive's value ---- */

static uint8_t all_arguments(const translation *t, tr_index primitive) {
  uint8_t type = TR_UNKNOWN;
  for (tr_index i = t->nodes[primitive].first; i; i = t->nodes[i].next)
    if (t->nodes[i].kind != TR_KEYWORD) type = join(type, t->nodes[i].type);
  return type;
}

/* Returns the type of a sum: number if the operands are numbers, otherwise the type of the point or vector among
 * them. */
static uint8_t arithmetic(const translation *t, tr_index primitive) {
  uint8_t type = TR_A_NUMBER;
  for (tr_index i = t->nodes[primitive].first; i; i = t->nodes[i].next) {
    if (t->nodes[i].type == TR_A_POINT) return TR_A_POINT;
    if (t->nodes[i].type != TR_A_NUMBER) type = TR_UNKNOWN;
  }
  return type;
}

static uint8_t result_of(const translation *t, tr_index primitive, const char *result) {
  static const char letters[] = "nbspcofmw";
  static const uint8_t types[] = {TR_A_NUMBER, TR_A_BOOLEAN, TR_A_STRING, TR_A_POINT, TR_A_CURVE, TR_A_SOLID,
    TR_A_PROCEDURE, TR_A_MATERIAL, TR_A_PATH};
  tr_index first = t->nodes[primitive].first;
  const char *plain = strchr(letters, *result);
  if (!*result) return TR_UNKNOWN;
  if (plain) return types[plain - letters];
  if (*result == 'N' || *result == 'P' || *result == 'C')
    return (uint8_t)(TR_LIST_OF + (*result == 'N' ? TR_A_NUMBER : *result == 'P' ? TR_A_POINT : TR_A_CURVE));
  if (*result == '1' || *result == '2') {
    tr_index n = tr_nth(t, primitive, (uint32_t)(*result - '1'));
    return n ? t->nodes[n].type : TR_UNKNOWN;
  }
  if (*result == 'e') return first ? element(t->nodes[first].type) : TR_UNKNOWN;
  if (*result == '+') return arithmetic(t, primitive);
  if (*result == 'E') return list_of(all_arguments(t, primitive));
  if (*result == 'J') return all_arguments(t, primitive);
  if (*result == 'K') { /* computes the type of a row whose result is K: that of a list with one more element, as for
                         * cons */
    uint8_t made = first ? list_of(t->nodes[first].type) : TR_UNKNOWN;
    return first && t->nodes[first].next ? join(made, t->nodes[t->nodes[first].next].type) : made;
  }
  return TR_UNKNOWN;
}

static uint8_t primitive_type(finder *f, tr_index n) {
  translation *t = f->t;
  const char *result = NULL;
  bool open = false, fixed = true;
  for (tr_index i = t->nodes[n].first; i; i = t->nodes[i].next)
    if (t->nodes[i].kind != TR_KEYWORD && base_of(t->nodes[i].type) == TR_UNKNOWN) open = true;
  for (uint16_t each = 0; open && (each = tr_word_find(t, n, each)) != 0;) {
    tr_word w = tr_word_row(t->target, each);
    if (result && strcmp(result, w.result)) fixed = false;
    result = w.result;
  }
  uint16_t row = tr_word_find(t, n, 0);
  t->nodes[n].row = row;
  if (!row) return TR_UNKNOWN;
  result = tr_word_row(t->target, row).result;
  if (open && !strchr("KEJ+", *result) && (!fixed || strchr("12e", *result))) return TR_UNKNOWN;
  if (*result == 'v') t->nodes[n].draws = true;
  return result_of(t, n, result);
}

/* ---- calls ---- */

static void give(finder *f, tr_index parameter, tr_index argument) {
  translation *t = f->t;
  if (t->nodes[argument].kind == TR_ABSENT) return;
  tr_index v = t->nodes[parameter].variable, procedure = 0;
  if (t->nodes[argument].kind == TR_PROCEDURE) procedure = argument;
  if (t->nodes[argument].kind == TR_NAME) {
    tr_index named = t->nodes[argument].variable;
    procedure = t->variables[named].procedure;
    into_gives(f, v, t->variables[named].gives);
  }
  if (procedure) into_gives(f, v, t->nodes[t->nodes[procedure].last].type);
  if (procedure && !t->variables[v].procedure && !t->variables[v].define) t->variables[v].define = parameter;
  into_variable(f, v, t->nodes[argument].type);
}

static uint8_t call_type(finder *f, tr_index n) {
  translation *t = f->t;
  tr_index callee = t->nodes[n].first, v = t->nodes[callee].variable, procedure = 0;
  if (t->nodes[callee].kind == TR_PROCEDURE) procedure = callee;
  else if (t->nodes[callee].kind == TR_NAME) procedure = t->variables[v].procedure;
  if (!procedure) return t->nodes[callee].kind == TR_NAME ? t->variables[v].gives : TR_UNKNOWN;
  tr_index argument = t->nodes[callee].next, p = t->nodes[procedure].first;
  for (; argument && p && t->nodes[p].kind == TR_PARAMETER; argument = t->nodes[argument].next, p = t->nodes[p].next)
    give(f, p, argument);
  if (t->nodes[procedure].draws && !t->nodes[n].draws) t->nodes[n].draws = f->changed = true;
  return t->nodes[t->nodes[procedure].last].type;
}

/* ---- the type of a node ---- */

static uint8_t type_of(finder *f, tr_index i) {
  translation *t = f->t;
  const tr_node *n = &t->nodes[i];
  tr_index first = n->first, last = n->last;
  switch ((tr_node_kind)n->kind) {
  case TR_NUMBER: return TR_A_NUMBER;
  case TR_STRING: return TR_A_STRING;
  case TR_BOOLEAN: return TR_A_BOOLEAN;
  case TR_PROCEDURE: return TR_A_PROCEDURE;
  case TR_NAME: return t->variables[n->variable].procedure ? TR_A_PROCEDURE : t->variables[n->variable].type;
  case TR_LIST: return list_of(all_arguments(t, i));
  case TR_PRIMITIVE: return primitive_type(f, i);
  case TR_CALL: return call_type(f, i);
  case TR_BODY: return last && t->nodes[last].kind != TR_DEFINE ? t->nodes[last].type : TR_UNKNOWN;
  case TR_WHEN: case TR_KEYWORD: return first ? t->nodes[first].type : TR_UNKNOWN;
  case TR_OR: return all_arguments(t, i);
  case TR_AND:
    if (all_arguments(t, i) == TR_A_BOOLEAN) return TR_A_BOOLEAN;
    return t->nodes[last].type == TR_A_BOOLEAN ? TR_A_BOOLEAN : t->nodes[last].type;
  case TR_IF: {
    tr_index then = first ? t->nodes[first].next : 0, other = then ? t->nodes[then].next : 0;
    return !then ? TR_UNKNOWN : other ? join(t->nodes[then].type, t->nodes[other].type) : t->nodes[then].type;
  }
  case TR_MAP: return last && !n->effect ? list_of(t->nodes[last].type) : TR_UNKNOWN;
  case TR_SET:
    if (first) into_variable(f, n->variable, t->nodes[first].type);
    return TR_UNKNOWN;
  case TR_DEFINE:
    if (!first) return TR_UNKNOWN;
    if (t->nodes[n->parent].kind == TR_MAP) {
      uint8_t inner = t->nodes[first].type;
      into_variable(f, n->variable, inner == TR_A_NUMBER ? TR_A_NUMBER : element(inner));
    } else if (t->nodes[first].kind == TR_PROCEDURE) {
      into_gives(f, n->variable, t->nodes[t->nodes[first].last].type);
    } else into_variable(f, n->variable, t->nodes[first].type);
    return TR_UNKNOWN;
  case TR_PARAMETER:
    if (first) into_variable(f, n->variable, t->nodes[first].type);
    if (n->rest) into_variable(f, n->variable, TR_LIST_OF);
    return TR_UNKNOWN;
  case TR_NOTHING: case TR_ABSENT: break;
  }
  return TR_UNKNOWN;
}

static void climb(finder *f) {
  translation *t = f->t;
  for (int rounds = 0; rounds < MOST_ROUNDS; rounds++) {
    f->changed = false;
    for (tr_index i = (tr_index)t->node_count; --i > 0;) {
      uint8_t type = join(t->nodes[i].type, type_of(f, i));
      if (t->nodes[i].kind == TR_PRIMITIVE) type = type_of(f, i);
      if (type != t->nodes[i].type) t->nodes[i].type = type, f->changed = true;
      bool draws = t->nodes[i].draws || (t->nodes[i].kind == TR_PRIMITIVE && !strcmp(t->nodes[i].text, "draw"));
      tr_index parent = t->nodes[i].parent;
      if (draws && !t->nodes[i].draws) t->nodes[i].draws = f->changed = true;
      if (!draws || !parent || t->nodes[parent].draws || t->nodes[i].kind == TR_PROCEDURE) continue;
      t->nodes[parent].draws = f->changed = true;
    }
    if (!f->changed) return;
  }
}

/* Gives each value of unknown type the type that its primitive's first possible row requires. */
static bool ask_primitives(finder *f) {
  translation *t = f->t;
  bool any = false;
  for (tr_index i = 1; i < t->node_count; i++) {
    if (t->nodes[i].kind != TR_PRIMITIVE || !t->nodes[i].row) continue;
    tr_word w = tr_word_row(t->target, t->nodes[i].row);
    uint32_t n = 0;
    for (tr_index a = t->nodes[i].first; a; a = t->nodes[a].next) {
      char letter = t->nodes[a].kind == TR_KEYWORD ? 0 : tr_word_letter(w.arguments, n++);
      uint8_t type = letter == 'o' ? TR_A_SOLID : letter == 'c' ? TR_A_CURVE : letter == 'p' ? TR_A_POINT
                     : letter == 'w' ? TR_A_PATH : 0;
      tr_index v = t->nodes[a].variable;
      bool open = t->nodes[a].kind == TR_NAME && t->variables[v].type == TR_UNKNOWN && !t->variables[v].procedure;
      if (!type || !open) continue;
      t->variables[v].type = type;
      any = true;
    }
  }
  return any;
}

/* ---- putting the arguments of calls in the order of the parameters ---- */

static const char *key_text(const char *text) { return strncmp(text, "#:", 2) ? text : text + 2; }

static void arrange(translation *t, tr_index call) {
  tr_index callee = t->nodes[call].first, procedure = 0, argument = t->nodes[callee].next, next, kept = callee;
  if (t->nodes[callee].kind == TR_NAME) procedure = t->variables[t->nodes[callee].variable].procedure;
  if (!procedure) {
    for (tr_index i = argument; i; i = t->nodes[i].next)
      if (t->nodes[i].kind == TR_KEYWORD)
        tr_complain(t, i, "a keyword for a procedure that is not known here cannot be translated");
    return;
  }
  t->nodes[callee].next = 0;
  t->nodes[call].last = callee, t->nodes[call].count = 1;
  tr_index keys = 0, keys_last = 0, places = 0, places_last = 0;
  for (; argument; argument = next) { /* divides the arguments into two lists: positional arguments and keyword
                                       * arguments */
    next = t->nodes[argument].next;
    t->nodes[argument].next = 0;
    tr_index *first = t->nodes[argument].kind == TR_KEYWORD ? &keys : &places;
    tr_index *last = t->nodes[argument].kind == TR_KEYWORD ? &keys_last : &places_last;
    if (*last) t->nodes[*last].next = argument;
    else *first = argument;
    *last = argument;
  }
  for (tr_index p = t->nodes[procedure].first; p && t->nodes[p].kind == TR_PARAMETER; p = t->nodes[p].next) {
    tr_index taken = 0;
    if (t->nodes[p].rest) {
      taken = tr_node_new(t, 0, TR_LIST, t->nodes[call].source);
      t->nodes[taken].first = places, t->nodes[taken].last = places_last;
      for (tr_index i = places; i; i = t->nodes[i].next) t->nodes[i].parent = taken, t->nodes[taken].count++;
      places = 0;
    } else if (*t->nodes[p].text) {
      for (tr_index i = keys; i && !taken; i = t->nodes[i].next)
        if (!strcmp(key_text(t->nodes[i].text), key_text(t->nodes[p].text))) taken = t->nodes[i].first;
    } else if (places) {
      taken = places;
      places = t->nodes[places].next;
    }
    if (!taken) taken = tr_node_new(t, 0, TR_ABSENT, t->nodes[call].source);
    t->nodes[taken].next = 0, t->nodes[taken].parent = call;
    t->nodes[kept].next = taken;
    t->nodes[call].last = kept = taken;
    t->nodes[call].count++;
  }
  while (kept != callee && t->nodes[kept].kind == TR_ABSENT) { /* omits absent arguments at the end */
    tr_index before = callee;
    while (t->nodes[before].next != kept) before = t->nodes[before].next;
    t->nodes[before].next = 0;
    t->nodes[call].last = kept = before;
    t->nodes[call].count--;
  }
}

/* If a loop counts up to a number, replaces the number by the list of the numbers below it, as for other loops. */
static bool count_loops(translation *t) {
  size_t count = t->node_count;
  for (tr_index i = 1; i < count; i++) {
    tr_index number = t->nodes[i].first;
    if (t->nodes[i].kind != TR_DEFINE || !number || t->nodes[t->nodes[i].parent].kind != TR_MAP) continue;
    if (t->nodes[number].type != TR_A_NUMBER) continue;
    tr_index moved = tr_node_new(t, 0, TR_NOTHING, t->nodes[number].source);
    if (!moved) return false;
    tr_move(t, number, moved);
    tr_node *list = &t->nodes[number];
    t->nodes[moved].parent = number, t->nodes[moved].next = 0;
    list->parent = i, list->source = t->nodes[moved].source;
    list->kind = TR_PRIMITIVE, list->text = "iota", list->type = TR_LIST_OF + TR_A_NUMBER;
    list->first = list->last = moved, list->count = 1;
    list->row = tr_word_find(t, number, 0);
  }
  return true;
}

/* ---- the program ---- */

static void complain_of(translation *t) {
  for (tr_index i = 1; i < t->node_count; i++) {
    tr_node n = t->nodes[i];
    if (n.kind == TR_SET && !t->target->assigns)
      tr_complain(t, i, "set! cannot be translated to %s", t->target->title);
    if (n.kind == TR_NAME && !t->variables[n.variable].define) /* the definition was omitted from the tree, although a
                                                                * form uses its name */
      tr_complain(t, i, "%s cannot be translated to %s", t->variables[n.variable].text, t->target->title);
    if (n.kind != TR_PRIMITIVE || n.row) continue;
    bool known = false;
    for (uint16_t row = 0; !known && (row = tr_word_next(n.text, row)) != 0;)
      known = tr_word_row(t->target, row).text != NULL;
    const char *plain = strncmp(n.text, "apply ", 6) ? n.text : n.text + 6;
    if (known) tr_complain(t, i, "%s: these arguments cannot be translated to %s", plain, t->target->title);
    else tr_complain(t, i, "%s cannot be translated to %s", plain, t->target->title);
  }
  for (size_t v = 1; v < t->variable_count; v++) {
    const tr_variable *y = &t->variables[v];
    if (y->set && y->define && !t->target->assigns && t->k->symbols[v].definitions > 1)
      tr_complain(t, y->define, "%s is defined twice", y->text);
  }
}

bool tr_find_kinds(translation *t) {
  finder f = {.t = t};
  for (tr_index i = 1; i < t->node_count; i++) {
    tr_node *n = &t->nodes[i];
    if (n->kind == TR_KEYWORD) n->text = key_text(n->text);
    if (n->kind != TR_DEFINE || !n->first || t->nodes[n->parent].kind == TR_MAP) continue;
    t->variables[n->variable].global = n->parent == t->root;
    if (t->nodes[n->first].kind == TR_PROCEDURE) t->variables[n->variable].procedure = n->first;
  }
  size_t count = t->node_count;
  for (tr_index i = 1; i < count && !*t->k->trouble; i++)
    if (t->nodes[i].kind == TR_CALL) arrange(t, i);
  if (*t->k->trouble) return false;
  do climb(&f);
  while (ask_primitives(&f));
  if (!count_loops(t)) return false;
  for (tr_index i = 1; i < t->node_count; i++) t->draws = t->draws ||
      (t->nodes[i].kind == TR_PRIMITIVE && !strcmp(t->nodes[i].text, "draw"));
  for (size_t v = 1; v < t->variable_count; v++) {
    tr_index p = t->variables[v].procedure;
    t->variables[v].draws = p && t->nodes[p].draws;
  }
  complain_of(t);
  return !*t->k->trouble;
}
