/* Implements the lowering of scripts: converts JavaScript to the lowered tree, whose kinds of nodes every target
 * language can express.
 *
 * A function of a script is a sequence of statements that ends in a return. Here it becomes an expression. If an arm of
 * an if returns, the statements after the if move into the other arm. A switch becomes ifs, and a counting loop becomes
 * a map. Loops that change variables, objects and exceptions have no counterpart: the translation complains about them.
 *
 * The functions call each other once for each level of the script's tree, whose height languages/javascript/script.h
 * limits. */
#include "languages/script/lower_script.h"

#include <stdlib.h>

#include "languages/translate/literals.h"
#include "languages/translate/lower_definitions.h"
#include "languages/translate/target.h"

/* Consecutive statements: those from `first` to the end of their list, then those of `rest`. */
typedef struct sequence {
  know_index first;
  const struct sequence *rest;
} sequence;

static void value(lowering *l, know_index n, tr_index into);
static void statements(lowering *l, sequence s, tr_index into);
static void effect(lowering *l, know_index n, tr_index body);

static know_index nth(const lowering *l, know_index list, uint32_t n) { return know_nth(l->k, list, n); }

/* Returns the first word of the list at node n, such as "js:if", or "" for a call. */
static const char *word_of(const lowering *l, know_index n) {
  know_index head = first_of(l, n);
  const char *text = is_symbol(l, head) ? l->k->names[l->k->nodes[head].name].text : "";
  return strncmp(text, "js:", 3) ? "" : text;
}

static bool is(const lowering *l, know_index n, const char *word) { return !strcmp(word_of(l, n), word); }

static void cannot(lowering *l, know_index n, const char *what) {
  tr_complain_at(l->t, n, "%s cannot be translated to %s", what, l->t->target->title);
}

/* ---- statements that leave their function ---- */

/* Returns true if the statement contains a return, except inside inner functions. */
static bool returns(const lowering *l, know_index n) {
  if (is(l, n, "js:return")) return true;
  if (is(l, n, "js:lambda") || is(l, n, "js:define") || is(l, n, "js:rec")) return false;
  for (know_index i = first_of(l, n); i; i = next(l, i))
    if (returns(l, i)) return true;
  return false;
}

/* Returns the node of the value of a case, or 0 for the default. In a case, statements are marked as such, and its
 * value is not. */
static know_index case_value(const lowering *l, know_index c) {
  know_index first = nth(l, c, 1);
  return first && !l->k->nodes[first].statement ? first : 0;
}

/* Returns true if control never continues after the statement. */
static bool leaves(const lowering *l, know_index n) {
  if (is(l, n, "js:return") || is(l, n, "js:throw")) return true;
  if (is(l, n, "js:block")) {
    for (know_index i = nth(l, n, 1); i; i = next(l, i))
      if (leaves(l, i)) return true;
    return false;
  }
  if (is(l, n, "js:if")) return nth(l, n, 3) && leaves(l, nth(l, n, 2)) && leaves(l, nth(l, n, 3));
  if (!is(l, n, "js:switch")) return false;
  bool rest = false;
  for (know_index c = nth(l, n, 2); c; c = next(l, c)) {
    bool out = false;
    rest = rest || !case_value(l, c);
    for (know_index i = nth(l, c, 1); i; i = next(l, i)) out = out || leaves(l, i);
    if (!out && (!next(l, c) || nth(l, c, case_value(l, c) ? 2 : 1))) return false;
  }
  return rest;
}

/* ---- expressions ---- */

static bool is_test(const lowering *l, know_index n) {
  static const char *const words[] = {"js:<", "js:>", "js:<=", "js:>=", "js:==", "js:===", "js:!=", "js:!==", "js:!"};
  const char *word = word_of(l, n);
  if (l->k->nodes[n].kind == KNOW_BOOLEAN) return true;
  if (!strcmp(word, "js:&&") || !strcmp(word, "js:||")) return is_test(l, nth(l, n, 1)) && is_test(l, nth(l, n, 2));
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (!strcmp(word, words[i])) return true;
  return false;
}

/* Lowers a condition to a boolean. A number counts as true unless it is 0. */
static void test(lowering *l, know_index n, tr_index into) {
  at(l, into)->source = n;
  if (is_test(l, n)) {
    value(l, n, into);
    return;
  }
  const char *word = word_of(l, n);
  bool both = !strcmp(word, "js:&&"), either = !strcmp(word, "js:||");
  if (both || either) become(l, into, both ? TR_AND : TR_OR, "");
  else become(l, into, TR_PRIMITIVE, "js:true");
  if (!both && !either) value(l, n, add(l, into, TR_NOTHING, n));
  else
    for (uint32_t i = 1; i < 3; i++) test(l, nth(l, n, i), add(l, into, TR_NOTHING, n));
}

static void atom(lowering *l, know_index n, tr_index into) {
  size_t length;
  const char *text = know_spelling(l->k, n, &length);
  switch ((know_kind)l->k->nodes[n].kind) {
  case KNOW_NUMBER:
    become(l, into, TR_NUMBER, tr_number_text(l->k, text, length));
    if (!*at(l, into)->text) cannot(l, n, "this number");
    break;
  case KNOW_STRING:
    if (memchr(text, '\\', length) && (strstr(know_text(l->k, text, length), "\\u") ||
                                       strstr(know_text(l->k, text, length), "\\x"))) cannot(l, n, "this text");
    else if (!(text = tr_string_text(l->k, text, length))) cannot(l, n, "this text");
    become(l, into, TR_STRING, text ? text : "");
    break;
  case KNOW_BOOLEAN:
    become(l, into, TR_BOOLEAN, "");
    at(l, into)->yes = *text == 't';
    break;
  default: cannot(l, n, length < 20 ? know_text(l->k, text, length) : "this");
  }
}

/* Returns the name of a called function or a variable as script_calls.def spells it, or "" for any other expression. */
static const char *said(const lowering *l, know_index n) {
  if (is_symbol(l, n)) return builtin(l, n) ? builtin(l, n) : "";
  if (!is(l, n, "js:get")) return word_of(l, n);
  const char *object = builtin(l, nth(l, n, 1));
  know_index key = nth(l, nth(l, n, 2), 1);
  if (!object || (!same(object, "Math") && !same(object, "console")) || !is_symbol(l, key)) return "";
  char text[80];
  int length = snprintf(text, sizeof text, "%s.%s", object, l->k->names[l->k->nodes[key].name].text);
  return know_text(l->k, text, length > 0 && length < (int)sizeof text ? (size_t)length : 0);
}

static const struct { const char *name, *word, *order; } words[] = {
#define TR_SCRIPT_WORD(name, word, order) {name, word, order},
#include "languages/script/script_calls.def"
};

static uint32_t takes(const char *order) {
  uint32_t most = 0;
  for (; *order; order++)
    if (*order >= '1' && *order <= '9' && (uint32_t)(*order - '0') > most) most = (uint32_t)(*order - '0');
  return most;
}

/* Lowers an argument. mark: the type that the procedure expects. With p, an array of two or three elements becomes a
 * point. With c, an array of such arrays becomes an outline. */
static void argument(lowering *l, know_index n, tr_index parent, char mark) {
  tr_index into = add(l, parent, TR_NOTHING, n);
  bool array = is(l, n, "js:array");
  uint32_t count = array ? l->k->nodes[n].count - 1 : 0;
  if (mark == 'c' && array) {
    become(l, into, TR_PRIMITIVE, "make-polygon");
    tr_index list = add(l, into, TR_LIST, n);
    for (know_index i = nth(l, n, 1); i; i = next(l, i)) argument(l, i, list, 'p');
    return;
  }
  if (mark != 'p' || (count != 2 && count != 3)) {
    value(l, n, into);
    return;
  }
  become(l, into, TR_PRIMITIVE, count == 2 ? "xy" : "xyz");
  for (know_index i = nth(l, n, 1); i; i = next(l, i)) value(l, i, add(l, into, TR_NOTHING, i));
}

/* Lowers a call of a function of script_calls.def, or its name as a value. Returns false if the table does not contain
 * the name. */
static bool known(lowering *l, know_index n, tr_index into, const char *name, know_index first, bool called) {
  uint32_t count = 0;
  for (know_index i = first; i; i = next(l, i)) count++;
  for (size_t r = 0; r < sizeof words / sizeof *words; r++) {
    const char *order = words[r].order;
    if (strcmp(words[r].name, name) || (!*order && called)) continue;
    if (*order && *order != '*' && (!called || takes(order) != count)) continue;
    become(l, into, TR_PRIMITIVE, words[r].word);
    tr_index parent = into;
    if (*order == '*')
      for (know_index i = first; i; i = next(l, i)) argument(l, i, into, 0);
    else
      for (; *order; order++) {
        if (*order == '[') parent = add(l, into, TR_LIST, n);
        if (*order == ']') parent = into;
        if (strchr("pc[]", *order)) continue;
        know_index a = first;
        for (int skip = *order - '1'; skip && a; skip--) a = next(l, a);
        argument(l, a, parent, order[1]);
      }
    return true;
  }
  return false;
}

/* Lowers a.map(function (x) {...}) and a.forEach(...). */
static bool method(lowering *l, know_index n, tr_index into) {
  know_index head = first_of(l, n), f = next(l, head), key = nth(l, nth(l, head, 2), 1);
  if (!is(l, head, "js:get") || !is_symbol(l, key)) return false;
  const char *which = l->k->names[l->k->nodes[key].name].text;
  bool each = same(which, "forEach"), filters = same(which, "filter");
  know_index formals = is(l, f, "js:lambda") ? nth(l, f, 1) : 0, x = first_of(l, formals);
  if ((!each && !filters && !same(which, "map")) || !x || next(l, x) || next(l, f)) return false;
  become(l, into, TR_MAP, "");
  at(l, into)->effect = each;
  tr_index list = define(l, into, x, NULL, f), v = at(l, list)->variable;
  value(l, nth(l, head, 1), add(l, list, TR_NOTHING, head));
  tr_index made = filters ? add(l, add(l, into, TR_WHEN, f), TR_NOTHING, f) : add(l, into, TR_NOTHING, f);
  statements(l, (sequence){next(l, formals), NULL}, made);
  if (filters) name(l, into, v, f);
  return true;
}

static void call(lowering *l, know_index n, tr_index into) {
  know_index head = first_of(l, n);
  const char *name = said(l, head);
  if (*name && strncmp(name, "js:", 3) && known(l, n, into, name, next(l, head), true)) return;
  if (method(l, n, into)) return;
  if (*name && (is_symbol(l, head) || strchr(name, '.'))) {
    cannot(l, head, name);
    return;
  }
  if (is(l, head, "js:get") || is(l, head, "js:at")) {
    cannot(l, head, "the call of a method");
    return;
  }
  become(l, into, TR_CALL, "");
  value(l, head, add(l, into, TR_NOTHING, head));
  for (know_index i = next(l, head); i; i = next(l, i)) value(l, i, add(l, into, TR_NOTHING, i));
}

static void function(lowering *l, know_index formals, know_index first, know_index body, tr_index into) {
  become(l, into, TR_PROCEDURE, "");
  if (l->k->nodes[formals].dotted) cannot(l, formals, "arguments");
  for (know_index i = first; i; i = next(l, i)) bind(l, add(l, into, TR_PARAMETER, i), i, NULL);
  statements(l, (sequence){body, NULL}, add(l, into, TR_NOTHING, body ? body : formals));
}

static void choice(lowering *l, know_index n, tr_index into) {
  become(l, into, TR_IF, "");
  test(l, nth(l, n, 1), add(l, into, TR_NOTHING, n));
  for (uint32_t i = 2; i < 4; i++) value(l, nth(l, n, i), add(l, into, TR_NOTHING, n));
}

static void value(lowering *l, know_index n, tr_index into) {
  if (!n || !into || *l->k->trouble) return;
  at(l, into)->source = n;
  if (is_symbol(l, n)) {
    know_index s = symbol_of(l, n);
    const char *name = builtin(l, n);
    if (name || !s) cannot(l, n, name ? name : l->k->names[l->k->nodes[n].name].text);
    else become(l, into, TR_NAME, ""), at(l, into)->variable = s;
    return;
  }
  if (!is_list(l, n)) {
    atom(l, n, into);
    return;
  }
  const char *word = word_of(l, n);
  know_index second = nth(l, n, 1), third = nth(l, n, 2);
  if (!*word) call(l, n, into);
  else if (!strcmp(word, "js:array")) {
    become(l, into, TR_LIST, "");
    for (know_index i = second; i; i = next(l, i)) value(l, i, add(l, into, TR_NOTHING, i));
  } else if (!strcmp(word, "js:at")) {
    become(l, into, TR_PRIMITIVE, "list-ref");
    value(l, second, add(l, into, TR_NOTHING, n));
    value(l, third, add(l, into, TR_NOTHING, n));
  } else if (!strcmp(word, "js:get") && know_is(l->k, nth(l, third, 1), "length")) {
    become(l, into, TR_PRIMITIVE, "length");
    value(l, second, add(l, into, TR_NOTHING, n));
  } else if (!strcmp(word, "js:if")) choice(l, n, into);
  else if (!strcmp(word, "js:&&") || !strcmp(word, "js:||")) {
    if (!is_test(l, n)) cannot(l, n, "&& or || of a value that is no comparison");
    become(l, into, word[3] == '&' ? TR_AND : TR_OR, "");
    value(l, second, add(l, into, TR_NOTHING, n));
    value(l, third, add(l, into, TR_NOTHING, n));
  } else if (!strcmp(word, "js:!")) {
    become(l, into, TR_PRIMITIVE, "not");
    test(l, second, add(l, into, TR_NOTHING, n));
  } else if (!strcmp(word, "js:lambda")) function(l, second, first_of(l, second), third, into);
  else if (!strcmp(word, "js:set!") || !strcmp(word, "js:put")) cannot(l, n, "an assignment");
  else {
    const char *name = said(l, n);
    char text[60];
    if (*name && known(l, n, into, name, second, strncmp(name, "js:", 3) == 0)) return;
    snprintf(text, sizeof text, "%s", !strcmp(word, "js:get") ? "a property" : !strcmp(word, "js:rec") ?
             "a function expression with a name" : !strcmp(word, "js:native") ? "Scheme code" : word + 3);
    cannot(l, n, text);
  }
}

/* ---- statements ---- */

/* Lowers for (i = a; i < b; i += step) to a counting loop. Returns false for any other loop. */
static bool counts(lowering *l, know_index n, tr_index into) {
  know_index start = nth(l, n, 1), until = nth(l, n, 2), step = nth(l, n, 3), body = nth(l, n, 4);
  if (is(l, start, "js:var") && !nth(l, start, 2)) start = nth(l, start, 1);
  know_index named = nth(l, start, 1), sum = nth(l, step, 2), by = 0;
  if (!body || !is(l, start, "js:set!") || !is(l, step, "js:set!") || !is_symbol(l, named)) return false;
  bool up_to = is(l, until, "js:<="), down = is(l, sum, "js:-") || is(l, sum, "js:step-");
  if (down || !(up_to || is(l, until, "js:<")) || !is_list(l, sum)) return false;
  if (is(l, sum, "js:+")) by = nth(l, sum, 2);
  else if (!is(l, sum, "js:step+")) return false;
  know_index names[3] = {nth(l, until, 1), nth(l, step, 1), nth(l, sum, 1)};
  for (int i = 0; i < 3; i++)
    if (!is_symbol(l, names[i]) || symbol_of(l, names[i]) != symbol_of(l, named)) return false;
  if (by && l->k->nodes[by].kind != KNOW_NUMBER) return false;
  become(l, into, TR_MAP, "");
  at(l, into)->effect = true;
  size_t length;
  const char *from = know_spelling(l->k, nth(l, start, 2), &length);
  bool zero = l->k->nodes[nth(l, start, 2)].kind == KNOW_NUMBER && length == 1 && *from == '0' && !by;
  tr_index range = primitive(l, define(l, into, named, NULL, start), zero ? "iota" : "range", start);
  if (!zero) value(l, nth(l, start, 2), add(l, range, TR_NOTHING, start));
  tr_index end = up_to ? primitive(l, range, "1+", until) : range;
  if (up_to && by) cannot(l, until, "a loop by steps up to its end");
  value(l, nth(l, until, 2), add(l, end, TR_NOTHING, until));
  if (by) value(l, by, add(l, range, TR_NOTHING, by));
  tr_index inside = add(l, into, TR_BODY, body);
  effect(l, body, inside);
  return true;
}

/* Returns true if only the statement around `set` uses the variable that `set` declares and assigns. */
static bool own(const lowering *l, know_index set) {
  know_index s = symbol_of(l, nth(l, set, 1)), block = l->k->nodes[l->k->nodes[set].parent].parent;
  const know_place *within = &l->k->nodes[block].at;
  if (!s || l->k->symbols[s].sets != 1) return false;
  for (know_index u = l->k->symbols[s].first_use; u; u = l->k->uses[u].next) {
    const know_place *place = &l->k->nodes[l->k->uses[u].node].at;
    if (place->from < within->from || place->to > within->to) return false;
  }
  return true;
}

static void definition(lowering *l, know_index n, tr_index body) {
  know_index target = nth(l, n, 1), first = nth(l, n, 2);
  if (is_symbol(l, target)) {
    if (first) value(l, first, add(l, define(l, body, target, NULL, n), TR_NOTHING, first));
    return; /* lowers nothing for a declaration without a value: it belongs to the loop or assignment that follows */
  }
  tr_index d = define(l, body, first_of(l, target), NULL, n);
  function(l, target, next(l, first_of(l, target)), first, add(l, d, TR_NOTHING, n));
}

/* Lowers a statement without a return, whose only effect can be the objects that it draws. */
static void effect(lowering *l, know_index n, tr_index body) {
  if (is(l, n, "js:define")) definition(l, n, body);
  else if (is(l, n, "js:define-parameter")) tr_lower_parameter(l, n, body);
  else if (is(l, n, "js:declared") || is(l, n, "js:empty")) return;
  else if (is(l, n, "js:var")) {
    for (know_index i = nth(l, n, 1); i; i = next(l, i))
      if (own(l, i)) definition(l, i, body);
      else effect(l, i, body);
  } else if (is(l, n, "js:block"))
    for (know_index i = nth(l, n, 1); i; i = next(l, i)) effect(l, i, body);
  else if (is(l, n, "js:if") && l->k->nodes[n].statement) {
    tr_index made = add(l, body, TR_IF, n);
    test(l, nth(l, n, 1), add(l, made, TR_NOTHING, n));
    for (uint32_t i = 2; nth(l, n, i); i++) effect(l, nth(l, n, i), add(l, made, TR_BODY, nth(l, n, i)));
  } else {
    tr_index made = add(l, body, TR_NOTHING, n);
    if (!is(l, n, "js:for")) value(l, n, made);
    else if (!counts(l, n, made)) cannot(l, n, "a loop that does not count up");
  }
}

/* Lowers the statements of a case to a value. As in JavaScript, they continue into the next case until a statement
 * leaves the switch. */
static void case_statements(lowering *l, know_index c, const sequence *rest, tr_index into) {
  enum { MOST = 64 };
  sequence all[MOST + 1] = {{0, NULL}};
  int count = 0;
  know_index cut = 0, kept = 0; /* cut: the break statement of the case. kept: the last statement before this break */
  bool on = true;
  for (; c && on && count < MOST; c = next(l, c)) {
    know_index last = 0, i = nth(l, c, case_value(l, c) ? 2 : 1);
    all[count].first = is(l, i, "js:break") ? 0 : i;
    for (; i && on; i = next(l, i)) {
      if (is(l, i, "js:break")) on = false, cut = last, kept = i;
      else if (leaves(l, i)) on = false;
      last = i;
    }
    count++;
  }
  if (c && on) cannot(l, c, "a switch of so many cases");
  for (int i = 0; i < count; i++) all[i].rest = i + 1 < count ? &all[i + 1] : rest;
  if (cut) l->k->nodes[cut].next = 0;
  statements(l, all[0], into);
  if (cut) l->k->nodes[cut].next = kept;
}

/* Lowers a switch to an if for each case. The statements after the switch (rest) may be repeated in each case, so they
 * must be short. */
static void choose(lowering *l, know_index n, const sequence *rest, tr_index into) {
  know_index chosen = nth(l, n, 1), fallback = 0;
  const sequence *then = rest;
  while (then && !then->first) then = then->rest;
  if (then && !is(l, then->first, "js:return") && !leaves(l, n))
    cannot(l, n, "a switch of which only some cases return, and other statements than a return follow,");
  become(l, into, TR_BODY, "");
  tr_index d = define(l, into, 0, "chosen", n), v = at(l, d)->variable;
  value(l, chosen, add(l, d, TR_NOTHING, chosen));
  into = add(l, into, TR_NOTHING, n);
  for (know_index c = nth(l, n, 2); c; c = next(l, c)) {
    know_index group = c; /* group: the last of several consecutive cases that have the same statements */
    if (!case_value(l, c)) fallback = c;
    if (!case_value(l, c)) continue;
    while (next(l, group) && !nth(l, group, 2) && case_value(l, next(l, group))) group = next(l, group);
    become(l, into, TR_IF, "");
    tr_index any = group == c ? into : add(l, into, TR_OR, c);
    for (know_index i = c;; i = next(l, i)) {
      tr_index p = primitive(l, any, "equal?", i);
      name(l, p, v, i);
      value(l, case_value(l, i), add(l, p, TR_NOTHING, i));
      if (i == group) break;
    }
    case_statements(l, group, rest, add(l, into, TR_NOTHING, c));
    into = add(l, into, TR_NOTHING, n);
    c = group;
  }
  if (fallback) case_statements(l, fallback, rest, into);
  else statements(l, (sequence){0, rest}, into);
}

/* Lowers statements to a value, which is that of their return. */
static void statements(lowering *l, sequence s, tr_index into) {
  become(l, into, TR_BODY, "");
  while (!s.first && s.rest) s = *s.rest;
  while (s.first && !*l->k->trouble) {
    know_index n = s.first;
    sequence rest = {next(l, n), s.rest};
    if (is(l, n, "js:return")) {
      if (nth(l, n, 1)) value(l, nth(l, n, 1), add(l, into, TR_NOTHING, n));
      return;
    }
    if (!returns(l, n)) effect(l, n, into);
    else if (is(l, n, "js:block")) {
      statements(l, (sequence){nth(l, n, 1), &rest}, add(l, into, TR_NOTHING, n));
      return;
    } else if (is(l, n, "js:if")) {
      know_index then = nth(l, n, 2), other = nth(l, n, 3), kept = l->k->nodes[then].next;
      tr_index made = add(l, into, TR_IF, n);
      if (!leaves(l, then) && !(other && leaves(l, other))) cannot(l, n, "an if of which neither branch returns");
      test(l, nth(l, n, 1), add(l, made, TR_NOTHING, n));
      know_index other_next = other ? l->k->nodes[other].next : 0;
      l->k->nodes[then].next = 0; /* lowers each arm of the if separately, followed by the statements after the if */
      if (other) l->k->nodes[other].next = 0;
      statements(l, (sequence){then, leaves(l, then) ? NULL : &rest}, add(l, made, TR_NOTHING, then));
      if (leaves(l, then) || other) statements(l, (sequence){other, leaves(l, then) ? &rest : NULL},
                                               add(l, made, TR_NOTHING, n));
      l->k->nodes[then].next = kept;
      if (other) l->k->nodes[other].next = other_next;
      return;
    } else if (is(l, n, "js:switch")) {
      choose(l, n, &rest, add(l, into, TR_NOTHING, n));
      return;
    } else cannot(l, n, "a return from a loop");
    s = rest;
    while (!s.first && s.rest) s = *s.rest;
  }
}

void tr_lower_script(lowering *l, know_index first, tr_index root) {
  for (know_index i = first; i && !*l->k->trouble; i = next(l, i)) effect(l, i, root);
}
