/* Converts the trees of the program's text to the lowered tree (core_tree.h).
 *
 * A stack contains tasks: lower this node of the text to that empty node of the lowered tree. A task fills its node,
 * appends empty children, and adds a task for each child. */
#include "languages/translate/lower_forms.h"

#include <stdlib.h>

#include "languages/translate/literals.h"
#include "languages/translate/lower_definitions.h"
#include "languages/script/lower_script.h"
#include "languages/translate/words.h"

/* ---- forms ---- */

typedef struct { lowering *l; know_index node, second, third; tr_index into; const char *word; } form;

static void lower_quote(form *f) { push(f->l, f->second, f->into, AS_DATUM); }
static void lower_quasiquote(form *f) { push(f->l, f->second, f->into, AS_TEMPLATE); }
static void lower_lambda(form *f) { tr_lower_procedure(f->l, f->into, f->second, first_of(f->l, f->second), f->third); }
static void lower_begin(form *f) { tr_lower_body(f->l, f->second, f->into); }
static void lower_if(form *f) {
  become(f->l, f->into, TR_IF, "");
  parts(f->l, f->into, f->second);
}
static void lower_when(form *f) {
  lowering *l = f->l;
  become(l, f->into, TR_IF, "");
  if (same(f->word, "unless")) part(l, primitive(l, f->into, "not", f->node), f->second);
  else part(l, f->into, f->second);
  tr_lower_body(l, f->third, add(l, f->into, TR_NOTHING, f->third));
}
static void lower_and(form *f) {
  bool and = same(f->word, "and");
  if (!f->second) {
    become(f->l, f->into, TR_BOOLEAN, "");
    at(f->l, f->into)->yes = and;
  } else if (!f->third) push(f->l, f->second, f->into, AS_EXPRESSION);
  else {
    become(f->l, f->into, and ? TR_AND : TR_OR, "");
    parts(f->l, f->into, f->second);
  }
}
static void lower_set(form *f) {
  know_index s = is_symbol(f->l, f->second) ? symbol_of(f->l, f->second) : 0;
  become(f->l, f->into, TR_SET, "");
  at(f->l, f->into)->variable = s;
  f->l->t->variables[s].set = true;
  part(f->l, f->into, f->third);
}
static void lower_let(form *f) { /* also lowers let*, letrec, letrec* */
  lowering *l = f->l;
  become(l, f->into, TR_BODY, "");
  if (!is_symbol(l, f->second)) {
    for (know_index i = first_of(l, f->second); i; i = next(l, i))
      if (first_of(l, i)) part(l, define(l, f->into, first_of(l, i), NULL, i), next(l, first_of(l, i)));
    tr_lower_sequence(l, f->third, f->into);
    return;
  }
  tr_index d = define(l, f->into, f->second, NULL, f->node), p = add(l, d, TR_PROCEDURE, f->node);
  for (know_index i = first_of(l, f->third); i; i = next(l, i))
    bind(l, add(l, p, TR_PARAMETER, i), first_of(l, i), NULL);
  tr_lower_body(l, next(l, f->third), add(l, p, TR_NOTHING, next(l, f->third)));
  tr_index call = add(l, f->into, TR_CALL, f->node);
  name(l, call, at(l, d)->variable, f->node);
  for (know_index i = first_of(l, f->third); i; i = next(l, i)) part(l, call, next(l, first_of(l, i)));
}
static void lower_let_values(form *f) {
  become(f->l, f->into, TR_BODY, "");
  for (know_index i = first_of(f->l, f->second); i; i = next(f->l, i))
    tr_lower_values(f->l, f->into, first_of(f->l, i), next(f->l, first_of(f->l, i)), i);
  tr_lower_sequence(f->l, f->third, f->into);
}
static void lower_receive(form *f) {
  become(f->l, f->into, TR_BODY, "");
  tr_lower_values(f->l, f->into, f->second, f->third, f->node);
  tr_lower_sequence(f->l, next(f->l, f->third), f->into);
}

/* Lowers (do ([i a (+ i step)]) ((= i b)) ...) to a counting loop. Returns false for any other form of do, which
 * becomes a procedure that calls itself. */
static bool counts(form *f, know_index clause, know_index ending) {
  lowering *l = f->l;
  know_index named = first_of(l, clause), step = know_nth(l->k, clause, 2), test = first_of(l, ending);
  know_index a = know_nth(l->k, step, 1), by = know_nth(l->k, step, 2), b = know_nth(l->k, test, 1);
  if (next(l, clause) || next(l, test) || !is_list(l, step) || !is_list(l, test)) return false;
  const char *plus = builtin(l, first_of(l, step)), *equal = builtin(l, first_of(l, test));
  if (!same(plus, "+") || !(same(equal, "=") || same(equal, ">=")) || !is_symbol(l, a) || !is_symbol(l, b))
    return false;
  if (symbol_of(l, a) != symbol_of(l, named) || symbol_of(l, b) != symbol_of(l, named)) return false;
  if (!by || l->k->nodes[by].kind != KNOW_NUMBER || next(l, by) || !next(l, b)) return false;
  become(l, f->into, TR_MAP, "");
  at(l, f->into)->effect = true;
  tr_index range = primitive(l, define(l, f->into, named, NULL, clause), "range", clause);
  part(l, range, next(l, named));
  part(l, range, next(l, b));
  part(l, range, by);
  tr_lower_body(l, next(l, f->third), add(l, f->into, TR_NOTHING, f->node));
  return true;
}
static void lower_do(form *f) {
  lowering *l = f->l;
  know_index list = first_of(l, f->second), ending = f->third;
  if (list && counts(f, list, ending)) return;
  become(l, f->into, TR_BODY, "");
  tr_index d = define(l, f->into, 0, "loop", f->node), v = at(l, d)->variable, p = add(l, d, TR_PROCEDURE, f->node);
  for (know_index i = list; i; i = next(l, i)) bind(l, add(l, p, TR_PARAMETER, i), first_of(l, i), NULL);
  tr_index test = add(l, p, TR_IF, f->node);
  part(l, test, first_of(l, ending));
  tr_lower_body(l, next(l, first_of(l, ending)), add(l, test, TR_NOTHING, ending));
  tr_index turn = add(l, test, TR_BODY, f->node);
  parts(l, turn, next(l, ending));
  tr_index again = add(l, turn, TR_CALL, f->node), call = add(l, f->into, TR_CALL, f->node);
  name(l, again, v, f->node);
  name(l, call, v, f->node);
  for (know_index i = list; i; i = next(l, i)) {
    know_index step = know_nth(l->k, i, 2);
    if (step) part(l, again, step);
    else name(l, again, symbol_of(l, first_of(l, i)), i);
    part(l, call, next(l, first_of(l, i)));
  }
}

static void lower_cond(form *f) {
  lowering *l = f->l;
  tr_index into = f->into;
  for (know_index i = f->second; i; i = next(l, i)) {
    know_index test = first_of(l, i), value = next(l, test);
    if (!test) continue;
    if (know_is(l->k, test, "else")) {
      tr_lower_body(l, value, into);
      return;
    }
    if (value && know_is(l->k, value, "=>")) {
      become(l, into, TR_BODY, "");
      tr_index d = define(l, into, 0, "found", i), v = at(l, d)->variable;
      part(l, d, test);
      tr_index chosen = add(l, into, TR_IF, i);
      name(l, chosen, v, i);
      tr_index call = add(l, chosen, TR_CALL, i);
      part(l, call, next(l, value));
      name(l, call, v, i);
      into = chosen;
    } else {
      become(l, into, value ? TR_IF : TR_OR, "");
      part(l, into, test);
      if (value) tr_lower_body(l, value, add(l, into, TR_NOTHING, value));
    }
    if (next(l, i)) into = add(l, into, TR_NOTHING, next(l, i));
  }
}

static void lower_case(form *f) {
  lowering *l = f->l;
  tr_index into = f->into, v = is_symbol(l, f->second) ? symbol_of(l, f->second) : 0;
  if (!v) {
    become(l, into, TR_BODY, "");
    tr_index d = define(l, into, 0, "key", f->node);
    v = at(l, d)->variable;
    part(l, d, f->second);
    into = add(l, into, TR_NOTHING, f->node);
  }
  for (know_index i = f->third; i; i = next(l, i)) {
    know_index data = first_of(l, i), value = next(l, data);
    if (know_is(l->k, value, "=>")) unable(l, value, "=> in a case");
    if (know_is(l->k, data, "else")) {
      tr_lower_body(l, value, into);
      return;
    }
    become(l, into, TR_IF, "");
    tr_index any = first_of(l, data) && !next(l, first_of(l, data)) ? into : add(l, into, TR_OR, i);
    for (know_index d = first_of(l, data); d; d = next(l, d)) {
      tr_index p = primitive(l, any, "equal?", d);
      name(l, p, v, f->second);
      push(l, d, add(l, p, TR_NOTHING, d), AS_DATUM);
    }
    tr_lower_body(l, value, add(l, into, TR_NOTHING, value));
    if (next(l, i)) into = add(l, into, TR_NOTHING, next(l, i));
  }
}

static void lower_for(form *f) { /* also lowers for*, for/list, for/sum and similar forms */
  lowering *l = f->l;
  tr_index into = f->into;
  if (strstr(f->word, "/sum")) {
    become(l, into, TR_PRIMITIVE, "apply +");
    into = add(l, into, TR_NOTHING, f->node);
  }
  become(l, into, TR_MAP, "");
  at(l, into)->effect = !strchr(f->word, '/');
  uint32_t lists = 0;
  const char *guard = NULL;
  for (know_index i = first_of(l, f->second); i; i = next(l, i)) {
    if (l->k->nodes[i].kind == KNOW_KEYWORD) {
      guard = l->k->names[l->k->nodes[i].name].text;
      continue;
    }
    if (guard || !is_list(l, i)) {
      tr_index w = add(l, into, TR_WHEN, i);
      if (guard && strstr(guard, "unless")) w = primitive(l, w, "not", i);
      part(l, w, i);
      guard = NULL;
      continue;
    }
    lists++;
    if (!is_symbol(l, first_of(l, i))) unable(l, i, "a loop over several values at once");
    tr_index d = define(l, into, first_of(l, i), NULL, i);
    know_index list = next(l, first_of(l, i));
    if (list && l->k->nodes[list].kind == KNOW_NUMBER) part(l, primitive(l, d, "iota", i), list);
    else part(l, d, list);
  }
  at(l, into)->parallel = lists > 1 && !strchr(f->word, '*');
  tr_lower_body(l, f->third, add(l, into, TR_NOTHING, f->third));
}

static void lower_fold(form *f) { tr_lower_fold(f->l, f->node, f->into); }

static const struct { const char *word; void (*lower)(form *f); } handlers[] = {
  {"quote", lower_quote}, {"quasiquote", lower_quasiquote}, {"lambda", lower_lambda}, {"\316\273", lower_lambda},
  {"begin", lower_begin}, {"if", lower_if}, {"when", lower_when}, {"unless", lower_when}, {"and", lower_and},
  {"or", lower_and}, {"set!", lower_set}, {"let", lower_let}, {"let*", lower_let}, {"letrec", lower_let},
  {"letrec*", lower_let}, {"let-values", lower_let_values}, {"let*-values", lower_let_values},
  {"receive", lower_receive}, {"do", lower_do}, {"cond", lower_cond}, {"case", lower_case}, {"for", lower_for},
  {"for*", lower_for}, {"for/list", lower_for}, {"for*/list", lower_for}, {"for/sum", lower_for},
  {"for*/sum", lower_for}, {"for/fold", lower_fold}
};

/* ---- calls ---- */

static void arguments(lowering *l, tr_index into, know_index first) {
  for (know_index i = first; i; i = next(l, i)) {
    if (l->k->nodes[i].kind != KNOW_KEYWORD) {
      part(l, into, i);
      continue;
    }
    tr_index key = add(l, into, TR_KEYWORD, i);
    at(l, key)->text = l->k->names[l->k->nodes[i].name].text;
    if ((i = next(l, i)) == 0) return;
    part(l, key, i);
  }
}

/* Lowers a call of the procedure `callee`; the arguments are the variables of the DEFINE children of the MAP node
 * `map`. */
static void call_each(lowering *l, tr_index map, know_index callee) {
  const char *word = builtin(l, callee);
  tr_index call = word ? primitive(l, map, word, callee) : add(l, map, TR_CALL, callee);
  if (!word) part(l, call, callee);
  for (tr_index i = at(l, map)->first; i && at(l, i)->kind == TR_DEFINE; i = at(l, i)->next)
    name(l, call, at(l, i)->variable, callee);
}

/* Lowers map, for-each and filter, as in (map f list ...). If f is a lambda, its parameters become the loop's
 * variables. */
static void map_call(lowering *l, know_index n, tr_index into, const char *word) {
  know_index f = settled(l, know_nth(l->k, n, 1)), first = know_nth(l->k, n, 2);
  const char *inner = form_word(l, f);
  know_index list = (same(inner, "lambda") || same(inner, "\316\273")) ? know_nth(l->k, f, 1) : 0;
  uint32_t lists = 0, names = 0;
  for (know_index i = first; i; i = next(l, i)) lists++;
  bool plain = is_list(l, list) && !l->k->nodes[list].dotted;
  for (know_index i = plain ? first_of(l, list) : 0; i; i = next(l, i), names++)
    if (!is_symbol(l, is_list(l, i) ? first_of(l, i) : i)) plain = false;
  plain = plain && names == lists;
  bool filters = same(word, "filter") || same(word, "remove");
  become(l, into, TR_MAP, "");
  at(l, into)->parallel = lists > 1;
  at(l, into)->effect = same(word, "for-each");
  know_index p = plain ? first_of(l, list) : 0;
  for (know_index i = first; i; i = next(l, i), p = next(l, p))
    part(l, define(l, into, p ? (is_list(l, p) ? first_of(l, p) : p) : 0, "x", i), i);
  tr_index test = filters ? add(l, into, TR_WHEN, n) : 0, made = test;
  if (same(word, "remove")) made = primitive(l, test, "not", n);
  if (plain) tr_lower_body(l, next(l, list), add(l, filters ? made : into, TR_NOTHING, f));
  else if (filters) {
    tr_index v = at(l, at(l, into)->first)->variable;
    const char *said = builtin(l, f);
    tr_index call = said ? primitive(l, made, said, f) : add(l, made, TR_CALL, f);
    if (!said) part(l, call, f);
    name(l, call, v, n);
  } else call_each(l, into, f);
  if (filters) name(l, into, at(l, at(l, into)->first)->variable, n);
}

/* lowers (apply f a ... list) */
static void apply_call(lowering *l, know_index n, tr_index into) {
  know_index f = settled(l, know_nth(l->k, n, 1)), first = know_nth(l->k, n, 2), last = first;
  const char *word = builtin(l, f);
  uint32_t count = 0;
  for (know_index i = first; i; i = next(l, i)) last = i, count++;
  char text[80];
  if (word && (same(word, "unite") || same(word, "intersect") || same(word, "subtract") || same(word, "draw"))) {
    become(l, into, TR_PRIMITIVE, word);
    parts(l, into, first);
  } else if (word && count == 1) {
    int size = snprintf(text, sizeof text, "apply %s", word);
    become(l, into, TR_PRIMITIVE, know_text(l->k, text, size > 0 && size < (int)sizeof text ? (size_t)size : 0));
    part(l, into, first);
  } else {
    know_index s = is_symbol(l, f) ? symbol_of(l, f) : 0;
    know_arity a = s ? l->k->symbols[s].arity : (know_arity){0};
    if (!a.known || a.least != a.most || a.any_keyword || !count || a.least + 1 < count) {
      unable(l, n, "apply of a procedure whose number of arguments is not plain");
      return;
    }
    become(l, into, TR_BODY, "");
    tr_index d = define(l, into, 0, "arguments", n), v = at(l, d)->variable, call = add(l, into, TR_CALL, n);
    part(l, d, last);
    part(l, call, f);
    for (know_index i = first; i != last; i = next(l, i)) part(l, call, i);
    for (uint32_t i = 0; i + count - 1 < a.least; i++) {
      tr_index p = primitive(l, call, "list-ref", n);
      int size = snprintf(text, sizeof text, "%u", i);
      name(l, p, v, n);
      number(l, p, know_text(l->k, text, (size_t)size), n);
    }
  }
}

/* Returns the node of the string at the node n. If n is a variable whose value is always one string, returns that
 * string's node. Returns 0 for any other node. */
static know_index plain_text(const lowering *l, know_index n) {
  know_index s = is_symbol(l, n) ? symbol_of(l, n) : 0;
  if (s && l->k->symbols[s].definitions == 1 && !l->k->symbols[s].sets) n = l->k->symbols[s].value;
  return n && l->k->nodes[n].kind == KNOW_STRING ? n : 0;
}

/* Lowers (native 'target "text" #:otherwise o). If this translation is for that target, keeps the text and the object,
 * otherwise only the object. */
static void native_call(lowering *l, know_index n, tr_index into) {
  know_index target = know_nth(l->k, know_nth(l->k, n, 1), 1), text = know_nth(l->k, n, 2), other = 0;
  for (know_index i = text; i; i = next(l, i))
    if (l->k->nodes[i].kind == KNOW_KEYWORD) other = next(l, i);
  if (target && know_is(l->k, target, l->t->target->name)) {
    if (!plain_text(l, text)) {
      unable(l, text, "native text that is not written as text");
      return;
    }
    become(l, into, TR_PRIMITIVE, "native");
    part(l, into, plain_text(l, text));
    if (other) part(l, into, other);
  } else if (other) push(l, other, into, AS_EXPRESSION);
  else become(l, into, TR_PRIMITIVE, "empty-object");
}

/* Lowers (distribute-in-space f p q nx ny nz) to a loop over all cells, with the body of the lambda f. */
static void distribute_call(lowering *l, know_index n, tr_index into) {
  know_index f = settled(l, know_nth(l->k, n, 1)), count = know_nth(l->k, n, 4);
  const char *inner = form_word(l, f);
  know_index list = (same(inner, "lambda") || same(inner, "\316\273")) ? know_nth(l->k, f, 1) : 0;
  bool plain = is_list(l, list) && is_symbol(l, first_of(l, list)) && !next(l, first_of(l, list));
  tr_index at_cell[3], made = into;
  become(l, into, TR_MAP, "");
  static const char *const names[] = {"i", "j", "k"};
  for (int i = 0; i < 3; i++, count = next(l, count)) {
    tr_index d = define(l, into, 0, names[i], n);
    at_cell[i] = at(l, d)->variable;
    part(l, primitive(l, d, "iota", n), count);
  }
  if (plain) {
    made = add(l, into, TR_BODY, n);
    tr_index d = define(l, made, first_of(l, list), NULL, list);
    tr_lower_body(l, next(l, list), add(l, made, TR_NOTHING, f));
    made = d;
  } else {
    made = add(l, into, TR_CALL, n);
    part(l, made, f);
  }
  tr_index cell = primitive(l, made, "distribute-in-space cell", n);
  part(l, cell, know_nth(l->k, n, 2));
  part(l, cell, know_nth(l->k, n, 3));
  for (int i = 0; i < 3; i++) name(l, cell, at_cell[i], n);
}

/* Lowers a procedure of the language that is used as a value to a PROCEDURE node that calls it. */
static void as_value(lowering *l, know_index n, tr_index into, const char *word) {
  int arguments_count = tr_word_arguments(l->t->target, word);
  become(l, into, arguments_count < 0 ? TR_PRIMITIVE : TR_PROCEDURE, arguments_count < 0 ? word : "");
  if (arguments_count < 0) return;
  static const char *const names[] = {"a", "b", "c", "d", "e", "f", "g", "h"};
  tr_index variables[8], count = 0;
  for (; count < (tr_index)arguments_count && count < 8; count++)
    variables[count] = bind(l, add(l, into, TR_PARAMETER, n), 0, names[count]);
  tr_index p = primitive(l, into, word, n);
  for (tr_index i = 0; i < count; i++) name(l, p, variables[i], n);
}

static void call(lowering *l, know_index n, tr_index into) {
  know_index head = l->k->nodes[n].first;
  const char *word = builtin(l, head);
  if (!head) return;
  if (word && strchr("mfr", *word) &&
      (same(word, "map") || same(word, "for-each") || same(word, "filter") || same(word, "remove"))) {
    map_call(l, n, into, word);
  } else if (same(word, "apply")) apply_call(l, n, into);
  else if (same(word, "native")) native_call(l, n, into);
  else if (same(word, "distribute-in-space")) distribute_call(l, n, into);
  else if (same(word, "list") || same(word, "values") || same(word, "vector")) {
    become(l, into, TR_LIST, "");
    parts(l, into, next(l, head));
  } else if (same(word, "append-map")) {
    become(l, into, TR_PRIMITIVE, "apply append");
    map_call(l, n, add(l, into, TR_NOTHING, n), "map");
  } else if (word) {
    become(l, into, TR_PRIMITIVE, word);
    arguments(l, into, next(l, head));
  } else {
    uint32_t count = 0;
    for (know_index i = next(l, head); i; i = next(l, i)) count++;
    tr_index clause;
    become(l, into, TR_CALL, "");
    if (!is_symbol(l, head) || !tr_clause_of(l, symbol_of(l, head), count, &clause)) part(l, into, head);
    else if (clause) name(l, into, clause, head);
    else unable(l, n, "a call that no clause of the case-lambda takes");
    arguments(l, into, next(l, head));
  }
}

/* ---- data: numbers, texts and other atoms ---- */

static void atom(lowering *l, know_index n, tr_index into) {
  know_index w = written(l, n);
  size_t length;
  const char *text = know_spelling(l->k, w, &length);
  switch ((know_kind)l->k->nodes[n].kind) {
  case KNOW_NUMBER:
    become(l, into, TR_NUMBER, tr_number_text(l->k, text, length));
    if (!*at(l, into)->text) unable(l, n, "this number");
    break;
  case KNOW_STRING:
    if (!(text = tr_string_text(l->k, text, length))) unable(l, n, "a text with a character of code 0");
    become(l, into, TR_STRING, text ? text : "");
    break;
  case KNOW_BOOLEAN:
    become(l, into, TR_BOOLEAN, "");
    at(l, into)->yes = length > 1 && text[1] == 't';
    break;
  default: unable(l, n, l->k->nodes[n].kind == KNOW_CHARACTER ? "a character" : "this datum");
  }
}

static void datum(lowering *l, know_index n, tr_index into, bool template) {
  know_kind kind = (know_kind)l->k->nodes[n].kind;
  if (kind == KNOW_SYMBOL) become(l, into, TR_STRING, l->k->names[l->k->nodes[n].name].text);
  else if (kind == KNOW_LIST || kind == KNOW_VECTOR) {
    if (template && know_is(l->k, l->k->nodes[n].first, "unquote")) {
      push(l, know_nth(l->k, n, 1), into, AS_EXPRESSION);
      return;
    }
    if (l->k->nodes[n].dotted) unable(l, n, "a dotted list");
    bool spliced = false;
    for (know_index i = l->k->nodes[n].first; template && i; i = next(l, i))
      spliced = spliced || (is_list(l, i) && know_is(l->k, l->k->nodes[i].first, "unquote-splicing"));
    become(l, into, spliced ? TR_PRIMITIVE : TR_LIST, spliced ? "append" : "");
    for (know_index i = l->k->nodes[n].first; i; i = next(l, i)) {
      if (spliced && is_list(l, i) && know_is(l->k, l->k->nodes[i].first, "unquote-splicing")) {
        part(l, into, know_nth(l->k, i, 1));
        continue;
      }
      tr_index list = spliced ? add(l, into, TR_LIST, i) : into;
      push(l, i, add(l, list, TR_NOTHING, i), template ? AS_TEMPLATE : AS_DATUM);
    }
  } else atom(l, n, into);
}

/* ---- the program ---- */

static void expression(lowering *l, know_index n, tr_index into) {
  n = settled(l, n);
  at(l, into)->source = n;
  const know_node *node = &l->k->nodes[n];
  if (node->kind == KNOW_SYMBOL) {
    know_index s = symbol_of(l, n);
    const char *word = builtin(l, n);
    tr_index clause;
    if (word) as_value(l, n, into, word);
    else if (s && tr_clause_of(l, s, 0, &clause)) unable(l, n, "a case-lambda that is used as a value");
    else if (s) become(l, into, TR_NAME, ""), at(l, into)->variable = s;
    else unable(l, n, l->k->names[node->name].text);
    return;
  }
  if (node->kind == KNOW_VECTOR) {
    datum(l, n, into, false);
    return;
  }
  if (node->kind != KNOW_LIST) {
    atom(l, n, into);
    return;
  }
  form f = {l, n, know_nth(l->k, n, 1), know_nth(l->k, n, 2), into, form_word(l, n)};
  if (!f.word) {
    call(l, n, into);
    return;
  }
  for (size_t i = 0; i < sizeof handlers / sizeof *handlers; i++)
    if (!strcmp(handlers[i].word, f.word)) {
      handlers[i].lower(&f);
      return;
    }
  unable(l, n, f.word);
}

bool tr_lower_nothing(translation *t) {
  tr_node_new(t, 0, TR_NOTHING, 0); /* node 0 is unused, because index 0 means that there is no node */
  for (size_t i = 0; i < t->k->symbol_count && !*t->k->trouble; i++) {
    const know_symbol *s = &t->k->symbols[i];
    tr_variable_new(t, s->text ? s->text : "");
    if (*t->k->trouble) break;
    t->variables[i].symbol = (know_index)i;
    t->variables[i].set = i && s->kind != KNOW_BUILTIN && s->kind != KNOW_MACRO && s->definitions > 1;
  }
  t->root = *t->k->trouble ? 0 : tr_node_new(t, 0, TR_BODY, t->k->files[0].root);
  if (t->root) t->nodes[t->root].plain = true;
  return t->root != 0;
}

bool tr_lower(translation *t) {
  lowering l = {.t = t, .k = t->k};
  if (tr_lower_nothing(t)) {
    know_index first = t->k->nodes[t->k->files[0].root].first;
    if (t->k->script) tr_lower_script(&l, first, t->root);
    else tr_lower_sequence(&l, first, t->root);
  }
  while (l.count && !*t->k->trouble) {
    task next_task = l.tasks[--l.count];
    t->nodes[next_task.into].source = next_task.node;
    if (next_task.kind == AS_EXPRESSION) expression(&l, next_task.node, next_task.into);
    else datum(&l, next_task.node, next_task.into, next_task.kind == AS_TEMPLATE);
  }
  free(l.tasks);
  free(l.clauses);
  tr_lower_settings(&l);
  return !*t->k->trouble;
}
