/* Implements the lowering of definitions and bodies: their conversion to the lowered tree (core_tree.h). A record
 * becomes a list, which begins with the type's name if the program tests the type. A procedure of several clauses
 * becomes a procedure for each clause. for/fold becomes a procedure that calls itself. */
#include "languages/translate/lower_definitions.h"

#include <stdlib.h>

#include "languages/translate/literals.h"

/* ---- records ---- */

static tr_index list_element(lowering *l, tr_index parent, tr_index list, uint32_t nth, know_index source) {
  char text[16];
  int length = snprintf(text, sizeof text, "%u", nth);
  tr_index p = primitive(l, parent, "list-ref", source);
  name(l, p, list, source);
  number(l, p, know_text(l->k, text, (size_t)length), source);
  return p;
}

static bool used(const lowering *l, know_index named) {
  const know_symbol *s = &l->k->symbols[symbol_of(l, named)];
  return s->reads || s->calls;
}

static know_index field_name(const lowering *l, know_index field) {
  return is_list(l, field) ? first_of(l, field) : field;
}

static bool one_name(const lowering *l, know_index a, know_index b) {
  return same(l->k->names[l->k->nodes[a].name].text, l->k->names[l->k->nodes[b].name].text);
}

static const char *type_name(const lowering *l, know_index n) {
  return l->k->names[l->k->nodes[know_nth(l->k, n, 1)].name].text;
}

/* Lowers the constructor of a record. Its arguments may have another order than the fields; the list has the order of
 * the fields. tagged: whether the list begins with the type's name. */
static void constructor(lowering *l, know_index n, know_index made, know_index fields, tr_index parent, bool tagged) {
  enum { MOST = 64 };
  tr_index variables[MOST], count = 0;
  know_index first = is_list(l, made) ? next(l, first_of(l, made)) : fields;
  tr_index d = define(l, parent, field_name(l, made), NULL, n), p = add(l, d, TR_PROCEDURE, n);
  for (know_index i = first; i && count < MOST; i = next(l, i))
    variables[count++] = bind(l, add(l, p, TR_PARAMETER, i), 0, l->k->names[l->k->nodes[field_name(l, i)].name].text);
  tr_index list = add(l, p, TR_LIST, n);
  if (tagged) become(l, add(l, list, TR_NOTHING, n), TR_STRING, type_name(l, n));
  for (know_index field = fields; field; field = next(l, field)) {
    tr_index at_field = 0, nth = 0;
    for (know_index i = first; i && nth < MOST && !at_field; i = next(l, i), nth++)
      if (one_name(l, field_name(l, i), field_name(l, field))) at_field = variables[nth];
    if (at_field) name(l, list, at_field, field);
    else unable(l, field, "a field that the constructor does not set");
  }
}

/* Lowers the modifier of a record's field, which sets an element of the list. Only a target with mutable lists can
 * express it. */
static void modifier(lowering *l, know_index named, uint32_t nth, tr_index parent) {
  char text[16];
  int length = snprintf(text, sizeof text, "%u", nth);
  tr_index p = add(l, define(l, parent, named, NULL, named), TR_PROCEDURE, named);
  tr_index r = bind(l, add(l, p, TR_PARAMETER, named), 0, "r"), v = bind(l, add(l, p, TR_PARAMETER, named), 0, "value");
  tr_index set = primitive(l, p, "a record's modifier", named);
  name(l, set, r, named);
  number(l, set, know_text(l->k, text, (size_t)length), named);
  name(l, set, v, named);
}

static void record(lowering *l, know_index n, tr_index parent) {
  know_index made = know_nth(l->k, n, 2), asked = know_nth(l->k, n, 3), fields = asked ? next(l, asked) : 0;
  if (!asked || is_list(l, know_nth(l->k, n, 1)) || l->k->nodes[made].kind == KNOW_BOOLEAN) {
    unable(l, n, "this record type");
    return;
  }
  bool tagged = is_symbol(l, asked) && used(l, asked);
  constructor(l, n, made, fields, parent, tagged);
  if (tagged) {
    tr_index p = add(l, define(l, parent, asked, NULL, asked), TR_PROCEDURE, asked);
    tr_index r = bind(l, add(l, p, TR_PARAMETER, asked), 0, "r");
    tr_index is = primitive(l, p, "a record's predicate", asked);
    name(l, is, r, asked);
    become(l, add(l, is, TR_NOTHING, asked), TR_STRING, type_name(l, n));
  }
  uint32_t nth = tagged;
  for (know_index field = fields; field; field = next(l, field), nth++) {
    know_index get = next(l, field_name(l, field)), set = get ? next(l, get) : 0;
    if (!is_list(l, field) || !get) continue;
    tr_index p = add(l, define(l, parent, get, NULL, field), TR_PROCEDURE, field);
    list_element(l, p, bind(l, add(l, p, TR_PARAMETER, field), 0, "r"), nth, field);
    if (set && used(l, set)) modifier(l, set, nth, parent);
  }
}

/* ---- procedures of several clauses ---- */

static void clauses_of(lowering *l, know_index n, know_index named, know_index form, tr_index parent) {
  know_index symbol = symbol_of(l, named);
  for (know_index i = know_nth(l->k, form, 1); i; i = next(l, i)) {
    know_index formals = first_of(l, i);
    case_clause c = {symbol, 0, 0, is_symbol(l, formals) || l->k->nodes[formals].dotted};
    for (know_index p = first_of(l, formals); p; p = next(l, p)) c.arguments++;
    if (c.more && c.arguments) c.arguments--; /* the rest parameter, after the dot, does not count as a required
                                               * argument */
    bool first = i == know_nth(l->k, form, 1);
    tr_index d = define(l, parent, first ? named : 0, l->k->symbols[symbol].text, n);
    c.variable = at(l, d)->variable;
    if (!VS_GROW(l->clauses, l->clause_room, l->clause_count + 1)) {
      know_fail(l->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
      return;
    }
    l->clauses[l->clause_count++] = c;
    tr_lower_procedure(l, add(l, d, TR_NOTHING, i), formals, first_of(l, formals), next(l, formals));
  }
}

bool tr_clause_of(const lowering *l, know_index symbol, uint32_t arguments, tr_index *variable) {
  bool found = false;
  *variable = 0;
  for (size_t i = 0; i < l->clause_count; i++) {
    const case_clause *c = &l->clauses[i];
    if (c->symbol != symbol) continue;
    found = true;
    if (!*variable && (c->arguments == arguments || (c->more && c->arguments < arguments))) *variable = c->variable;
  }
  return found;
}

/* ---- procedures and bodies ---- */

void tr_lower_procedure(lowering *l, tr_index into, know_index list, know_index first, know_index forms) {
  become(l, into, TR_PROCEDURE, "");
  const char *keyword = "";
  bool lone = is_symbol(l, list);
  for (know_index i = lone ? list : first; i; i = lone ? 0 : next(l, i)) {
    if (l->k->nodes[i].kind == KNOW_KEYWORD) {
      keyword = l->k->names[l->k->nodes[i].name].text;
      continue;
    }
    tr_index p = add(l, into, TR_PARAMETER, i);
    know_index named = is_list(l, i) ? first_of(l, i) : i, fallback = is_list(l, i) ? know_nth(l->k, i, 2) : 0;
    at(l, p)->text = keyword;
    at(l, p)->rest = lone || (list && l->k->nodes[list].dotted && !next(l, i));
    keyword = "";
    bind(l, p, named, NULL);
    if (fallback) part(l, p, fallback);
  }
  tr_lower_body(l, forms, add(l, into, TR_NOTHING, forms));
}

static void value_of_define(lowering *l, know_index n, tr_index parent) {
  know_index target = know_nth(l->k, n, 1), forms = know_nth(l->k, n, 2), list = target, named = first_of(l, target);
  if (is_symbol(l, target)) {
    know_index value = forms ? settled(l, forms) : 0;
    if (value && same(form_word(l, value), "case-lambda")) clauses_of(l, n, target, value, parent);
    else part(l, define(l, parent, target, NULL, n), forms);
    return;
  }
  while (is_list(l, named)) list = named, named = first_of(l, named); /* the curried form ((f a) b) defines a procedure
                                                                       * that returns a procedure */
  if (!is_symbol(l, named)) return;
  tr_index d = define(l, parent, named, NULL, n), into = add(l, d, TR_NOTHING, n);
  for (; list != target; list = l->k->nodes[list].parent) {
    become(l, into, TR_PROCEDURE, "");
    for (know_index i = next(l, first_of(l, list)); i; i = next(l, i))
      bind(l, add(l, into, TR_PARAMETER, i), is_list(l, i) ? first_of(l, i) : i, NULL);
    into = add(l, into, TR_NOTHING, n);
  }
  tr_lower_procedure(l, into, target, next(l, first_of(l, target)), forms);
}

void tr_lower_values(lowering *l, tr_index parent, know_index names, know_index value, know_index source) {
  tr_index whole = define(l, parent, 0, "values", source), v = at(l, whole)->variable;
  part(l, whole, value);
  int nth = 0;
  for (know_index i = is_list(l, names) ? first_of(l, names) : names; i; i = is_list(l, names) ? next(l, i) : 0) {
    tr_index p = primitive(l, define(l, parent, i, NULL, i), "list-ref", i);
    char text[16];
    int n = snprintf(text, sizeof text, "%d", nth++);
    name(l, p, v, i);
    number(l, p, know_text(l->k, text, (size_t)n), i);
  }
}

/* Returns the number that follows the keyword in the form. In a script, returns the number at its position among the
 * arguments. Returns `missing` if there is none. */
static double bound(const lowering *l, know_index n, const char *keyword, double missing) {
  know_index given = l->k->script ? know_nth(l->k, n, same(keyword, "min") ? 3 : 4) : 0;
  if (given && l->k->nodes[given].kind == KNOW_NUMBER) {
    size_t length;
    const char *text = know_spelling(l->k, given, &length);
    return strtod(know_text(l->k, text, length), NULL);
  }
  for (know_index i = l->k->nodes[n].first; i; i = next(l, i)) {
    const char *key = l->k->nodes[i].kind == KNOW_KEYWORD ? l->k->names[l->k->nodes[i].name].text : "";
    know_index value = next(l, i);
    size_t length;
    if (strcmp(strncmp(key, "#:", 2) ? key : key + 2, keyword) || !value || l->k->nodes[value].kind != KNOW_NUMBER)
      continue;
    const char *text = know_spelling(l->k, value, &length);
    return strtod(know_text(l->k, text, length), NULL);
  }
  return missing;
}

/* Lowers the value that the user has set for the parameter, instead of its default. */
static void setting(lowering *l, know_index n, tr_index define, const know_setting *s) {
  know_index fallback = know_nth(l->k, n, 2);
  tr_index made = add(l, define, TR_NOTHING, fallback);
  know_kind kind = (know_kind)l->k->nodes[fallback].kind;
  if (kind == KNOW_STRING) become(l, made, TR_STRING, know_text(l->k, s->value, strlen(s->value)));
  else if (kind == KNOW_BOOLEAN && (same(s->value, "#t") || same(s->value, "#f"))) {
    become(l, made, TR_BOOLEAN, "");
    at(l, made)->yes = s->value[1] == 't';
  } else if (kind == KNOW_NUMBER || kind == KNOW_LIST) {
    size_t length = strlen(s->value);
    const char *text = tr_number_text(l->k, s->value, length);
    double value = strtod(s->value, NULL);
    bool whole = kind == KNOW_NUMBER;
    if (whole) {
      size_t size;
      const char *said = know_spelling(l->k, fallback, &size);
      whole = !strpbrk(know_text(l->k, said, size), "./e");
    }
    become(l, made, TR_NUMBER, text);
    if (!strspn(s->value, "+-.0123456789") || !*text || (whole && strpbrk(s->value, "./e")))
      tr_complain_at(l->t, n, "parameter %s must be %s, got %s", s->name, whole ? "a whole number" : "a number",
                     s->value);
    else if (value < bound(l, n, "min", value) || value > bound(l, n, "max", value))
      tr_complain_at(l->t, n, "parameter %s must lie within its bounds, got %s", s->name, s->value);
  } else tr_complain_at(l->t, n, "parameter %s cannot be %s", s->name, s->value);
}

static const know_setting *setting_of(const lowering *l, const char *name) {
  const know_setting *found = NULL; /* if the user has set several values, the last is used */
  for (size_t i = 0; i < l->t->setting_count; i++)
    if (same(l->t->settings[i].name, name)) found = &l->t->settings[i];
  return found;
}

void tr_lower_settings(lowering *l) {
  for (size_t i = 0; i < l->t->setting_count && !*l->k->trouble; i++) {
    bool used = false;
    for (size_t v = 1; v < l->t->variable_count && !used; v++)
      used = l->t->variables[v].model_parameter && same(l->t->variables[v].text, l->t->settings[i].name);
    if (!used) know_fail(l->k, NULL, VS_OUTCOME_USAGE, "the model has no parameter %s", l->t->settings[i].name);
  }
}

void tr_lower_parameter(lowering *l, know_index n, tr_index parent) {
  tr_index d = define(l, parent, know_nth(l->k, n, 1), NULL, n), v = at(l, d)->variable;
  l->t->variables[v].model_parameter = true;
  const know_setting *set = setting_of(l, l->t->variables[v].text);
  if (set && know_nth(l->k, n, 2)) setting(l, n, d, set);
  else part(l, d, know_nth(l->k, n, 2));
}

/* Lowers a form that defines names in its own scope, such as define. Returns false for any other form. */
static bool definition(lowering *l, know_index n, tr_index parent) {
  const char *word = form_word(l, n);
  if (!word) return false;
  if (same(word, "define")) value_of_define(l, n, parent);
  else if (same(word, "define-parameter")) tr_lower_parameter(l, n, parent);
  else if (same(word, "define-record-type")) record(l, n, parent);
  else if (same(word, "define-primitive") && is_list(l, know_nth(l->k, n, 1))) value_of_define(l, n, parent);
  else if (same(word, "define-values")) tr_lower_values(l, parent, know_nth(l->k, n, 1), know_nth(l->k, n, 2), n);
  else if (!same(word, "define-syntax") && !same(word, "define-syntax-rule") && !same(word, "provide") &&
      !same(word, "import")) {
    if (strncmp(word, "define-", 7) && !same(word, "struct")) return false;
    unable(l, n, word);
  }
  return true;
}

static know_index loaded(const lowering *l, know_index string) {
  know_index w = written(l, string);
  for (know_index i = 0; i < l->k->file_count; i++)
    if (l->k->files[i].loaded_by == w) return l->k->nodes[l->k->files[i].root].first;
  return 0;
}

/* Returns true if the form n, which is not the last of its body, has no effect. */
static bool idle(const lowering *l, know_index n) { return l->k->nodes[n].kind != KNOW_LIST; }

void tr_lower_sequence(lowering *l, know_index first, tr_index into) {
  know_index *stack = NULL;
  size_t count = 0, room = 0;
  if (first && VS_GROW(stack, room, 1)) stack[count++] = first;
  while (count && !*l->k->trouble) {
    know_index n = stack[count - 1], inside = 0;
    if (!n) {
      count--;
      continue;
    }
    stack[count - 1] = next(l, n);
    n = settled(l, n);
    const char *word = form_word(l, n);
    know_index second = know_nth(l->k, n, 1);
    bool brings = same(word, "include") || same(word, "require") || same(word, "include-ci") ||
        (is_list(l, n) && same(builtin(l, first_of(l, n)), "load") && second &&
        l->k->nodes[second].kind == KNOW_STRING);
    if (same(word, "begin")) inside = second;
    else if (brings) inside = second && l->k->nodes[second].kind == KNOW_STRING ? loaded(l, second) : 0;
    else if (definition(l, n, into)) continue;
    else {
      if (!idle(l, n) || !stack[count - 1]) part(l, into, n);
      continue;
    }
    if (inside && !VS_GROW(stack, room, count + 1)) know_fail(l->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
    else if (inside) stack[count++] = inside;
  }
  free(stack);
}

void tr_lower_body(lowering *l, know_index first, tr_index into) {
  if (first && !next(l, first)) {
    know_index n = settled(l, first);
    const char *word = form_word(l, n);
    if (!same(word, "begin") && (!word || strncmp(word, "define", 6))) {
      push(l, n, into, AS_EXPRESSION);
      return;
    }
  }
  become(l, into, TR_BODY, "");
  tr_lower_sequence(l, first, into);
}

/* ---- for/fold ---- */

/* A sequence of a loop. Its elements are those of the list. list 0: the element is the number of the iteration. */
typedef struct { know_index clause; tr_index list; } sequence;

/* If the sequence consists of the numbers from 0 on, as (i 5), (i (iota n)) or (i (in-range n)), returns the node of
 * its length. Otherwise returns 0. */
static know_index counted(const lowering *l, know_index value) {
  if (l->k->nodes[value].kind == KNOW_NUMBER) return value;
  const char *word = is_list(l, value) ? builtin(l, first_of(l, value)) : NULL;
  know_index count = know_nth(l->k, value, 1);
  bool plain = (same(word, "iota") || same(word, "in-range") || same(word, "range")) && count && !next(l, count);
  return plain ? count : 0;
}

/* Makes a node for the number of iterations, which is the length of the shortest sequence. */
static tr_index turns(lowering *l, know_index clauses, tr_index into, sequence *sequences, size_t most) {
  size_t count = 0;
  know_index other = 0;
  for (know_index i = clauses; i && !other && l->k->nodes[i].kind != KNOW_KEYWORD; i = next(l, i)) {
    if (!is_symbol(l, first_of(l, i)) || count == most) other = i;
    else sequences[count++].clause = i;
  }
  if (other || !count) {
    unable(l, other ? other : clauses, "this clause of for/fold");
    return 0;
  }
  for (size_t i = 0; i < count; i++) {
    know_index value = next(l, first_of(l, sequences[i].clause));
    if (counted(l, value)) continue;
    tr_index d = define(l, into, 0, "list", value);
    sequences[i].list = at(l, d)->variable;
    part(l, d, value);
  }
  tr_index many = define(l, into, 0, "count", clauses), least = count > 1 ? primitive(l, many, "min", clauses) : many;
  for (size_t i = 0; i < count; i++) {
    know_index value = next(l, first_of(l, sequences[i].clause));
    if (sequences[i].list) name(l, primitive(l, least, "length", value), sequences[i].list, value);
    else part(l, least, counted(l, value));
  }
  return at(l, many)->variable;
}

/* Returns the node for the body of an iteration. If the clauses have #:when or #:unless, this is an arm of an IF with
 * these tests, otherwise parent. */
static tr_index guarded(lowering *l, know_index clauses, tr_index parent, know_index source) {
  tr_index test = 0;
  for (know_index i = clauses; i; i = next(l, i)) {
    if (l->k->nodes[i].kind != KNOW_KEYWORD) continue;
    const char *word = l->k->names[l->k->nodes[i].name].text;
    if (!next(l, i)) return parent;
    if (!test) test = add(l, add(l, parent, TR_IF, source), TR_AND, source);
    know_index asked = next(l, i);
    if (next(l, asked) && l->k->nodes[next(l, asked)].kind != KNOW_KEYWORD)
      unable(l, next(l, asked), "a clause of for/fold behind a test");
    part(l, strstr(word, "unless") ? primitive(l, test, "not", asked) : test, asked);
    i = asked;
  }
  if (!test) return parent;
  tr_index choice = at(l, test)->parent;
  if (at(l, test)->count == 1) { /* a single test needs no AND around it */
    tr_index only = at(l, test)->first;
    at(l, choice)->first = at(l, choice)->last = only;
    at(l, only)->parent = choice;
  }
  return choice;
}

/* Fills the other arm of the IF that `guarded` has made: the values do not change. */
static void unguarded(lowering *l, tr_index choice, tr_index parent, const tr_index *values, tr_index count,
                      know_index source) {
  if (choice == parent) return;
  tr_index stay = count == 1 ? choice : add(l, choice, TR_LIST, source);
  for (tr_index i = 0; i < count; i++) name(l, stay, values[i], source);
}

void tr_lower_fold(lowering *l, know_index n, tr_index into) {
  enum { MOST = 16 };
  know_index names = know_nth(l->k, n, 1), clauses = know_nth(l->k, n, 2), forms = know_nth(l->k, n, 3);
  sequence sequences[MOST] = {{0, 0}};
  become(l, into, TR_BODY, "");
  tr_index many = turns(l, first_of(l, clauses), into, sequences, MOST), values[MOST], count = 0;
  if (!many) return;
  tr_index d = define(l, into, 0, "loop", n), loop = at(l, d)->variable, p = add(l, d, TR_PROCEDURE, n);
  tr_index turn = bind(l, add(l, p, TR_PARAMETER, n), 0, "nth");
  for (know_index i = first_of(l, names); i && count < MOST; i = next(l, i))
    values[count++] = bind(l, add(l, p, TR_PARAMETER, i), first_of(l, i), NULL);
  tr_index test = add(l, p, TR_IF, n), done = primitive(l, test, ">=", n);
  name(l, done, turn, n);
  name(l, done, many, n);
  tr_index result = count == 1 ? test : add(l, test, TR_LIST, names);
  for (tr_index i = 0; i < count; i++) name(l, result, values[i], names);
  tr_index again = add(l, test, TR_BODY, n);
  for (size_t i = 0; i < MOST && sequences[i].clause; i++) {
    tr_index element = define(l, again, first_of(l, sequences[i].clause), NULL, sequences[i].clause);
    if (!sequences[i].list) {
      name(l, element, turn, sequences[i].clause);
      continue;
    }
    tr_index taken = primitive(l, element, "list-ref", sequences[i].clause);
    name(l, taken, sequences[i].list, sequences[i].clause);
    name(l, taken, turn, sequences[i].clause);
  }
  tr_index several = 0;
  if (count != 1) {
    tr_index made = define(l, again, 0, "values", forms);
    several = at(l, made)->variable;
    tr_index kept = guarded(l, first_of(l, clauses), made, forms);
    tr_lower_body(l, forms, add(l, kept, TR_NOTHING, forms));
    unguarded(l, kept, made, values, count, forms);
  }
  tr_index call = add(l, again, TR_CALL, n), following = 0;
  name(l, call, loop, n);
  following = primitive(l, call, "1+", n);
  name(l, following, turn, n);
  if (count == 1) {
    tr_index kept = guarded(l, first_of(l, clauses), call, forms);
    tr_lower_body(l, forms, add(l, kept, TR_NOTHING, forms));
    unguarded(l, kept, call, values, count, forms);
  }
  for (tr_index i = 0; i < count && several; i++) list_element(l, call, several, i, forms);
  tr_index begin = add(l, into, TR_CALL, n);
  name(l, begin, loop, n);
  number(l, begin, "0", n);
  for (know_index i = first_of(l, names); i; i = next(l, i)) part(l, begin, next(l, first_of(l, i)));
}
