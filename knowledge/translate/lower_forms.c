/* Owns the way from the text's trees to the lowered tree.
 *
 * Plan. A stack of tasks, each "this node of the text belongs into that node of the lowered tree", which is there
 * already and empty. A task fills its node, appends empty children and leaves tasks for those. */
#include "knowledge/translate/lower_forms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "knowledge/translate/literals.h"
#include "knowledge/translate/words.h"
#include "model/store/array.h"

typedef enum { AS_EXPRESSION, AS_DATUM, AS_TEMPLATE } task_kind;
typedef struct { know_index node; tr_index into; uint8_t kind; } task;
typedef struct { translation *t; knowledge *k; task *tasks; size_t count, room; } lowering;

/* ---- the text's trees ---- */

static know_index next(const lowering *l, know_index n) { return n ? l->k->nodes[n].next : 0; }
static bool is_list(const lowering *l, know_index n) { return n && l->k->nodes[n].kind == KNOW_LIST; }
static bool is_symbol(const lowering *l, know_index n) { return n && l->k->nodes[n].kind == KNOW_SYMBOL; }
static know_index first_of(const lowering *l, know_index n) { return is_list(l, n) ? l->k->nodes[n].first : 0; }

static know_index written(const lowering *l, know_index n) {
  while (l->k->nodes[n].origin && !l->k->nodes[n].made) n = l->k->nodes[n].origin;
  return n;
}

/* The form at the node once macros are expanded. Of what a macro uses twice, the first copy was looked at. */
static know_index settled(const lowering *l, know_index n) {
  for (;;) {
    know_index w = written(l, n);
    if (!l->k->nodes[n].walked && l->k->nodes[w].walked) n = w;
    if (!l->k->nodes[n].expansion) return n;
    n = l->k->nodes[n].expansion;
  }
}

static know_index symbol_of(const lowering *l, know_index n) {
  know_index s = l->k->nodes[n].symbol;
  return s ? s : l->k->nodes[written(l, n)].symbol;
}

/* The word of the language's form at the node; NULL: it is none. */
static const char *form_word(const lowering *l, know_index n) {
  if (!is_list(l, n) || !(l->k->nodes[n].form || l->k->nodes[written(l, n)].form)) return NULL;
  know_index s = symbol_of(l, l->k->nodes[n].first);
  return s ? l->k->symbols[s].text : l->k->names[l->k->nodes[l->k->nodes[n].first].name].text;
}

/* The language's procedure that the node names; NULL: it names none. */
static const char *builtin(const lowering *l, know_index n) {
  know_index s = is_symbol(l, n) ? symbol_of(l, n) : 0;
  return s && l->k->symbols[s].kind == KNOW_BUILTIN ? l->k->symbols[s].text : NULL;
}

static bool same(const char *a, const char *b) { return a && !strcmp(a, b); }

/* ---- nodes ---- */

static void push(lowering *l, know_index n, tr_index into, task_kind kind) {
  if (!into || *l->k->trouble) return;
  if (!n) return;
  if (!VS_GROW(l->tasks, l->room, l->count + 1)) know_fail(l->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  else l->tasks[l->count++] = (task){n, into, (uint8_t)kind};
}
static tr_index add(lowering *l, tr_index parent, tr_node_kind kind, know_index source) {
  return tr_node_new(l->t, parent, kind, source);
}
static tr_index part(lowering *l, tr_index parent, know_index n) {
  tr_index made = add(l, parent, TR_NOTHING, n);
  push(l, n, made, AS_EXPRESSION);
  return made;
}
static void parts(lowering *l, tr_index parent, know_index first) {
  for (know_index i = first; i; i = next(l, i)) part(l, parent, i);
}
static tr_node *at(lowering *l, tr_index n) { return &l->t->nodes[n]; }
static void become(lowering *l, tr_index into, tr_node_kind kind, const char *text) {
  at(l, into)->kind = (uint8_t)kind, at(l, into)->text = text;
}
static tr_index primitive(lowering *l, tr_index parent, const char *name, know_index source) {
  tr_index made = add(l, parent, TR_PRIMITIVE, source);
  at(l, made)->text = name;
  return made;
}
static tr_index name(lowering *l, tr_index parent, tr_index variable, know_index source) {
  tr_index made = add(l, parent, TR_NAME, source);
  at(l, made)->variable = variable;
  return made;
}
static tr_index number(lowering *l, tr_index parent, const char *text, know_index source) {
  tr_index made = add(l, parent, TR_NUMBER, source);
  at(l, made)->text = text;
  return made;
}
/* Binds the variable of the symbol at the node, or a new one. */
static tr_index bind(lowering *l, tr_index node, know_index named, const char *fresh) {
  know_index s = named && is_symbol(l, named) ? symbol_of(l, named) : 0;
  tr_index v = s ? s : tr_variable_new(l->t, fresh ? fresh : named ? l->k->names[l->k->nodes[named].name].text : "x");
  at(l, node)->variable = v;
  if (!l->t->variables[v].define) l->t->variables[v].define = node;
  return v;
}
static tr_index define(lowering *l, tr_index parent, know_index named, const char *fresh, know_index source) {
  tr_index d = add(l, parent, TR_DEFINE, source);
  bind(l, d, named, fresh);
  return d;
}
static void unable(lowering *l, know_index n, const char *what) { tr_complain_at(l->t, n,
    "%s cannot be translated", what); }

/* ---- procedures and bodies ---- */

static void body(lowering *l, know_index first, tr_index into);

/* A parameter list of elements from `first` on, or a lone name that takes all, and the forms behind it. */
static void procedure(lowering *l, tr_index into, know_index list, know_index first, know_index forms) {
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
  body(l, forms, add(l, into, TR_NOTHING, forms));
}

static void value_of_define(lowering *l, know_index n, tr_index parent) {
  know_index target = know_nth(l->k, n, 1), forms = know_nth(l->k, n, 2), list = target, named = first_of(l, target);
  if (is_symbol(l, target)) {
    part(l, define(l, parent, target, NULL, n), forms);
    return;
  }
  while (is_list(l, named)) list = named, named = first_of(l, named); /* ((f a) b): a procedure that gives one */
  if (!is_symbol(l, named)) return;
  tr_index d = define(l, parent, named, NULL, n), into = add(l, d, TR_NOTHING, n);
  for (; list != target; list = l->k->nodes[list].parent) {
    become(l, into, TR_PROCEDURE, "");
    for (know_index i = next(l, first_of(l, list)); i; i = next(l, i))
      bind(l, add(l, into, TR_PARAMETER, i), is_list(l, i) ? first_of(l, i) : i, NULL);
    into = add(l, into, TR_NOTHING, n);
  }
  procedure(l, into, target, next(l, first_of(l, target)), forms);
}

/* Names that stand for the elements of a list, one each. */
static void take_apart(lowering *l, tr_index parent, know_index names, know_index value, know_index source) {
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

/* The number that stands behind the keyword in the form; missing: there is none. */
static double bound(const lowering *l, know_index n, const char *keyword, double missing) {
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

/* The value that the user gives the parameter, in place of its default. */
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
      tr_complain_at(l->t, n, "parameter %s must be %s, got %s", s->name, whole ? "a whole number" : "a number", s->value);
    else if (value < bound(l, n, "min", value) || value > bound(l, n, "max", value))
      tr_complain_at(l->t, n, "parameter %s must lie within its bounds, got %s", s->name, s->value);
  } else tr_complain_at(l->t, n, "parameter %s cannot be %s", s->name, s->value);
}

static const know_setting *setting_of(const lowering *l, const char *name) {
  const know_setting *found = NULL; /* the last of several counts */
  for (size_t i = 0; i < l->t->setting_count; i++)
    if (same(l->t->settings[i].name, name)) found = &l->t->settings[i];
  return found;
}

static void settings_used(lowering *l) {
  for (size_t i = 0; i < l->t->setting_count && !*l->k->trouble; i++) {
    bool used = false;
    for (size_t v = 1; v < l->t->variable_count && !used; v++)
      used = l->t->variables[v].model_parameter && same(l->t->variables[v].text, l->t->settings[i].name);
    if (!used) know_fail(l->k, NULL, VS_OUTCOME_USAGE, "the model has no parameter %s", l->t->settings[i].name);
  }
}

static void parameter_form(lowering *l, know_index n, tr_index parent) {
  tr_index d = define(l, parent, know_nth(l->k, n, 1), NULL, n), v = at(l, d)->variable;
  l->t->variables[v].model_parameter = true;
  const know_setting *set = setting_of(l, l->t->variables[v].text);
  if (set && know_nth(l->k, n, 2)) setting(l, n, d, set);
  else part(l, d, know_nth(l->k, n, 2));
}

/* A form that defines names where it stands. False: it is none. */
static bool definition(lowering *l, know_index n, tr_index parent) {
  const char *word = form_word(l, n);
  if (!word) return false;
  if (same(word, "define")) value_of_define(l, n, parent);
  else if (same(word, "define-parameter")) parameter_form(l, n, parent);
  else if (same(word, "define-values")) take_apart(l, parent, know_nth(l->k, n, 1), know_nth(l->k, n, 2), n);
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

/* Does the value of the form, which is not its body's last, matter to nobody? */
static bool idle(const lowering *l, know_index n) { return l->k->nodes[n].kind != KNOW_LIST; }

/* The forms from `first` on, with what `begin` and files bring in among them. */
static void forms_into(lowering *l, know_index first, tr_index into) {
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

static void body(lowering *l, know_index first, tr_index into) {
  if (first && !next(l, first)) {
    know_index n = settled(l, first);
    const char *word = form_word(l, n);
    if (!same(word, "begin") && (!word || strncmp(word, "define", 6))) {
      push(l, n, into, AS_EXPRESSION);
      return;
    }
  }
  become(l, into, TR_BODY, "");
  forms_into(l, first, into);
}

/* ---- forms ---- */

typedef struct { lowering *l; know_index node, second, third; tr_index into; const char *word; } form;

static void lower_quote(form *f) { push(f->l, f->second, f->into, AS_DATUM); }
static void lower_quasiquote(form *f) { push(f->l, f->second, f->into, AS_TEMPLATE); }
static void lower_lambda(form *f) { procedure(f->l, f->into, f->second, first_of(f->l, f->second), f->third); }
static void lower_begin(form *f) { body(f->l, f->second, f->into); }
static void lower_if(form *f) {
  become(f->l, f->into, TR_IF, "");
  parts(f->l, f->into, f->second);
}
static void lower_when(form *f) {
  lowering *l = f->l;
  become(l, f->into, TR_IF, "");
  if (same(f->word, "unless")) part(l, primitive(l, f->into, "not", f->node), f->second);
  else part(l, f->into, f->second);
  body(l, f->third, add(l, f->into, TR_NOTHING, f->third));
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
static void lower_let(form *f) { /* and let*, letrec, letrec* */
  lowering *l = f->l;
  become(l, f->into, TR_BODY, "");
  if (!is_symbol(l, f->second)) {
    for (know_index i = first_of(l, f->second); i; i = next(l, i))
      if (first_of(l, i)) part(l, define(l, f->into, first_of(l, i), NULL, i), next(l, first_of(l, i)));
    forms_into(l, f->third, f->into);
    return;
  }
  tr_index d = define(l, f->into, f->second, NULL, f->node), p = add(l, d, TR_PROCEDURE, f->node);
  for (know_index i = first_of(l, f->third); i; i = next(l, i))
    bind(l, add(l, p, TR_PARAMETER, i), first_of(l, i), NULL);
  body(l, next(l, f->third), add(l, p, TR_NOTHING, next(l, f->third)));
  tr_index call = add(l, f->into, TR_CALL, f->node);
  name(l, call, at(l, d)->variable, f->node);
  for (know_index i = first_of(l, f->third); i; i = next(l, i)) part(l, call, next(l, first_of(l, i)));
}
static void lower_let_values(form *f) {
  become(f->l, f->into, TR_BODY, "");
  for (know_index i = first_of(f->l, f->second); i; i = next(f->l, i))
    take_apart(f->l, f->into, first_of(f->l, i), next(f->l, first_of(f->l, i)), i);
  forms_into(f->l, f->third, f->into);
}
static void lower_receive(form *f) {
  become(f->l, f->into, TR_BODY, "");
  take_apart(f->l, f->into, f->second, f->third, f->node);
  forms_into(f->l, next(f->l, f->third), f->into);
}

/* (do ([i a (+ i step)]) ((= i b)) ...) counts; every other do is a loop that calls itself. */
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
  body(l, next(l, f->third), add(l, f->into, TR_NOTHING, f->node));
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
  body(l, next(l, first_of(l, ending)), add(l, test, TR_NOTHING, ending));
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
      body(l, value, into);
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
      if (value) body(l, value, add(l, into, TR_NOTHING, value));
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
      body(l, value, into);
      return;
    }
    become(l, into, TR_IF, "");
    tr_index any = first_of(l, data) && !next(l, first_of(l, data)) ? into : add(l, into, TR_OR, i);
    for (know_index d = first_of(l, data); d; d = next(l, d)) {
      tr_index p = primitive(l, any, "equal?", d);
      name(l, p, v, f->second);
      push(l, d, add(l, p, TR_NOTHING, d), AS_DATUM);
    }
    body(l, value, add(l, into, TR_NOTHING, value));
    if (next(l, i)) into = add(l, into, TR_NOTHING, next(l, i));
  }
}

static void lower_for(form *f) { /* and for*, for/list, for*'s, for/sum */
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
  body(l, f->third, add(l, into, TR_NOTHING, f->third));
}

static const struct { const char *word; void (*lower)(form *f); } handlers[] = {
  {"quote", lower_quote}, {"quasiquote", lower_quasiquote}, {"lambda", lower_lambda}, {"\316\273", lower_lambda},
  {"begin", lower_begin}, {"if", lower_if}, {"when", lower_when}, {"unless", lower_when}, {"and", lower_and},
  {"or", lower_and}, {"set!", lower_set}, {"let", lower_let}, {"let*", lower_let}, {"letrec", lower_let},
  {"letrec*", lower_let}, {"let-values", lower_let_values}, {"let*-values", lower_let_values},
  {"receive", lower_receive}, {"do", lower_do}, {"cond", lower_cond}, {"case", lower_case}, {"for", lower_for},
  {"for*", lower_for}, {"for/list", lower_for}, {"for*/list", lower_for}, {"for/sum", lower_for},
  {"for*/sum", lower_for}
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

/* The call of what `callee` names with the variables of the DEFINE children of `map`. */
static void call_each(lowering *l, tr_index map, know_index callee) {
  const char *word = builtin(l, callee);
  tr_index call = word ? primitive(l, map, word, callee) : add(l, map, TR_CALL, callee);
  if (!word) part(l, call, callee);
  for (tr_index i = at(l, map)->first; i && at(l, i)->kind == TR_DEFINE; i = at(l, i)->next)
    name(l, call, at(l, i)->variable, callee);
}

/* (map f list ...), for-each, filter: a lambda's parameters are the loop's variables. */
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
  if (plain) body(l, next(l, list), add(l, filters ? made : into, TR_NOTHING, f));
  else if (filters) {
    tr_index v = at(l, at(l, into)->first)->variable;
    const char *said = builtin(l, f);
    tr_index call = said ? primitive(l, made, said, f) : add(l, made, TR_CALL, f);
    if (!said) part(l, call, f);
    name(l, call, v, n);
  } else call_each(l, into, f);
  if (filters) name(l, into, at(l, at(l, into)->first)->variable, n);
}

/* (apply f a ... list) */
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

/* (native 'target "text" #:otherwise o): the text where it is meant, else the object. */
static void native_call(lowering *l, know_index n, tr_index into) {
  know_index target = know_nth(l->k, know_nth(l->k, n, 1), 1), text = know_nth(l->k, n, 2), other = 0;
  for (know_index i = text; i; i = next(l, i))
    if (l->k->nodes[i].kind == KNOW_KEYWORD) other = next(l, i);
  if (target && know_is(l->k, target, tr_target_native(l->t->target))) {
    become(l, into, TR_PRIMITIVE, "native");
    part(l, into, text);
  } else if (other) push(l, other, into, AS_EXPRESSION);
  else become(l, into, TR_PRIMITIVE, "empty-object");
}

/* (distribute-in-space f p q nx ny nz): a loop over the cells, with a lambda's body in it. */
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
    body(l, next(l, list), add(l, made, TR_NOTHING, f));
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

/* A procedure of the language as a value: one of ours that calls it. */
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
    become(l, into, TR_CALL, "");
    part(l, into, head);
    arguments(l, into, next(l, head));
  }
}

/* ---- data ---- */

static void atom(lowering *l, know_index n, tr_index into) {
  know_index w = written(l, n);
  size_t length;
  const char *text = know_spelling(l->k, w, &length);
  switch ((know_kind)l->k->nodes[n].kind) {
  case KNOW_NUMBER:
    become(l, into, TR_NUMBER, tr_number_text(l->k, text, length));
    if (!*at(l, into)->text) unable(l, n, "this number");
    break;
  case KNOW_STRING: become(l, into, TR_STRING, tr_string_text(l->k, text, length)); break;
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

/* ---- the whole ---- */

static void expression(lowering *l, know_index n, tr_index into) {
  n = settled(l, n);
  at(l, into)->source = n;
  const know_node *node = &l->k->nodes[n];
  if (node->kind == KNOW_SYMBOL) {
    know_index s = symbol_of(l, n);
    const char *word = builtin(l, n);
    if (word) as_value(l, n, into, word);
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

bool tr_lower(translation *t) {
  lowering l = {.t = t, .k = t->k};
  tr_node_new(t, 0, TR_NOTHING, 0); /* element 0 is nobody */
  for (size_t i = 0; i < t->k->symbol_count && !*t->k->trouble; i++) {
    const know_symbol *s = &t->k->symbols[i];
    tr_variable_new(t, s->text ? s->text : "");
    if (*t->k->trouble) break;
    t->variables[i].symbol = (know_index)i;
    t->variables[i].set = i && s->kind != KNOW_BUILTIN && s->kind != KNOW_MACRO && s->definitions > 1;
  }
  t->root = *t->k->trouble ? 0 : tr_node_new(t, 0, TR_BODY, t->k->files[0].root);
  if (t->root) {
    t->nodes[t->root].plain = true;
    forms_into(&l, t->k->nodes[t->k->files[0].root].first, t->root);
  }
  while (l.count && !*t->k->trouble) {
    task next_task = l.tasks[--l.count];
    t->nodes[next_task.into].source = next_task.node;
    if (next_task.kind == AS_EXPRESSION) expression(&l, next_task.node, next_task.into);
    else datum(&l, next_task.node, next_task.into, next_task.kind == AS_TEMPLATE);
  }
  free(l.tasks);
  settings_used(&l);
  return !*t->k->trouble;
}
