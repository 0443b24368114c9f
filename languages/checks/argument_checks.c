/* Implements the checks of calls: the number and types of arguments, and the language's own errors for calls with
 * constants. */
#include "languages/checks/argument_checks.h"
#include "languages/checks/constant_calls.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { MOST_ANSWERS = 3000, MOST_DEPTH = 60 };

static const struct { const char *name; know_type type; } plain[] = {
#define KNOW_PLAIN(name, type) {name, KNOW_TYPE_##type},
#include "languages/checks/plain_calls.def"
};

const char *know_type_word(know_type type) {
  static const char *const words[] = {"something", "a number", "a string", "a boolean", "a character", "a symbol",
    "a list", "a vector", "a procedure", "a point", "a gvector", "an object", "nothing"};
  return words[type];
}

int know_plain_row(const knowledge *k, know_index symbol) {
  if (!symbol || k->symbols[symbol].kind != KNOW_BUILTIN) return -1;
  for (int i = 0; i < (int)(sizeof plain / sizeof *plain); i++)
    if (!strcmp(plain[i].name, k->symbols[symbol].text)) return i;
  return -1;
}

know_type know_plain_type(int row) { return row < 0 ? KNOW_TYPE_UNKNOWN : plain[row].type; }

/* Returns the node of the value of a variable that is defined once and never set. */
know_index know_constant_value(const knowledge *k, know_index node) {
  const know_node *n = &k->nodes[node];
  if (n->kind != KNOW_SYMBOL || n->role != KNOW_REFERENCE || !n->symbol) return 0;
  const know_symbol *s = &k->symbols[n->symbol];
  know_index clauses = k->nodes[s->form].parent, form = k->nodes[clauses].parent;
  if (form && know_is(k, k->nodes[form].first, "and-let*")) return 0; /* and-let* ends at a clause whose value is #f, so
                                                                       * its variables have no certain value */
  bool fixed = s->definitions == 1 && !s->sets && !s->made && !s->owner && (s->kind == KNOW_VARIABLE ||
      s->kind == KNOW_LOCAL);
  return fixed ? s->value : 0;
}

/* Returns true for an expression that returns no value: a loop, or a call that prints. */
static bool is_valueless(const knowledge *k, know_index node) {
  static const char *const words[] = {"for", "for*", "for-each", "display", "displayln", "newline", "printf"};
  know_index head = k->nodes[node].first;
  const know_symbol *s = k->nodes[head].symbol ? &k->symbols[k->nodes[head].symbol] : NULL;
  if (!s || s->definition || (k->nodes[head].role != KNOW_REFERENCE && k->nodes[head].role != KNOW_SYNTAX))
    return false;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (know_is(k, head, words[i])) return true;
  return false;
}

static bool is_builtin_procedure(const knowledge *k, know_index node) {
  const know_node *n = &k->nodes[node];
  return n->kind == KNOW_SYMBOL && n->role == KNOW_REFERENCE && n->symbol &&
         k->symbols[n->symbol].kind == KNOW_BUILTIN && *k->symbols[n->symbol].call;
}

know_type know_type_of(const knowledge *k, know_index node) {
  for (int steps = 0; node && steps < MOST_DEPTH; steps++) {
    const know_node *n = &k->nodes[node];
    switch (n->kind) {
    case KNOW_NUMBER: return KNOW_TYPE_NUMBER;
    case KNOW_STRING: return KNOW_TYPE_STRING;
    case KNOW_BOOLEAN: return KNOW_TYPE_BOOLEAN;
    case KNOW_CHARACTER: return KNOW_TYPE_CHARACTER;
    case KNOW_VECTOR: return KNOW_TYPE_VECTOR;
    case KNOW_SYMBOL: {
      know_index value = know_constant_value(k, node);
      if (is_builtin_procedure(k, node)) return KNOW_TYPE_PROCEDURE;
      if (!value) return KNOW_TYPE_UNKNOWN;
      node = value;
      continue;
    }
    case KNOW_LIST: {
      know_index head = n->first, second = know_nth(k, node, 1);
      if (!head || !n->walked) return KNOW_TYPE_UNKNOWN;
      if (n->form && (know_is(k, head, "lambda") || know_is(k, head, "\316\273") || know_is(k, head, "case-lambda")))
        return KNOW_TYPE_PROCEDURE;
      if (n->form && know_is(k, head, "quote") && second) {
        know_kind kind = (know_kind)k->nodes[second].kind;
        return kind == KNOW_SYMBOL ? KNOW_TYPE_SYMBOL : kind == KNOW_LIST ? KNOW_TYPE_LIST : kind == KNOW_NUMBER
            ? KNOW_TYPE_NUMBER
          : kind == KNOW_STRING ? KNOW_TYPE_STRING : KNOW_TYPE_UNKNOWN;
      }
      if (!k->script && is_valueless(k, node)) return KNOW_TYPE_NOTHING;
      const know_symbol *own = k->nodes[head].role == KNOW_REFERENCE ? &k->symbols[k->nodes[head].symbol] : NULL;
      if (!k->script && own && own->kind == KNOW_FUNCTION && own->definitions == 1 && !own->sets && !own->made &&
          own->body && !n->dotted) {
        for (node = own->body; k->nodes[node].next;) node = k->nodes[node].next; /* the value of a procedure is the
                                                                                  * value of its last expression */
        continue;
      }
      int row = n->form ? -1 : know_plain_row(k, k->nodes[head].symbol);
      /* With a single operand, `subtract` returns a procedure instead of an object, so the type is unknown. */
      if (row < 0 || (n->count == 2 && know_is(k, head, "subtract"))) return KNOW_TYPE_UNKNOWN;
      if (plain[row].type || row > 3) return plain[row].type;
      /* a sum of literal numbers is a number; operands of other kinds are not examined */
      for (know_index i = k->nodes[head].next; i; i = k->nodes[i].next)
        if (k->nodes[i].kind != KNOW_NUMBER) return KNOW_TYPE_UNKNOWN;
      return KNOW_TYPE_NUMBER;
    }
    default: return KNOW_TYPE_UNKNOWN;
    }
  }
  return KNOW_TYPE_UNKNOWN;
}

/* ---- numbers of arguments ---- */

typedef struct { uint32_t least, most; } range;

/* Reads the numbers of arguments from the text of a call such as "(make-box c dx dy dz)". Brackets enclose optional
 * arguments, and ... follows an argument that may be repeated. */
static const char *read_call(const char *at, range *r) {
  *r = (range){0, 0};
  int depth = 0;
  at += strcspn(at, " )\n");
  uint32_t last_least = 0;
  while (*at && *at != '\n' && *at != ')') {
    at += strspn(at, " ");
    if (*at == '[') depth++, at++;
    size_t n = strcspn(at, " )]\n");
    if (n == 3 && !strncmp(at, "...", 3)) r->most = UINT32_MAX, r->least = last_least;
    else if (n && *at != '#') {
      last_least = r->least;
      if (!depth) r->least++;
      if (r->most != UINT32_MAX) r->most++;
    }
    at += n;
    while (*at == ']') depth--, at++;
  }
  at += strcspn(at, "\n");
  return *at ? at + 1 : NULL;
}

static bool has_keyword(const char *keywords, const char *name) {
  size_t n = strlen(name);
  for (const char *at = keywords; (at = strstr(at, name)) != NULL; at += n)
    if (at[n] == 0 || at[n] == ' ') return true;
  return false;
}

static bool takes_keyword(const knowledge *k, know_index list, know_index keyword) {
  for (know_index i = list ? k->nodes[list].first : 0; i; i = k->nodes[i].next)
    if (k->nodes[i].kind == KNOW_KEYWORD && !strcmp(k->names[k->nodes[i].name].text,
        k->names[k->nodes[keyword].name].text)) return true;
  return false;
}

static void plural(char *room, size_t size, uint32_t least, uint32_t most) {
  if (least == most) snprintf(room, size, "%u argument%s", least, least == 1 ? "" : "s");
  else if (most == UINT32_MAX) snprintf(room, size, "%u or more arguments", least);
  else snprintf(room, size, "%u to %u arguments", least, most);
}

static bool count_fits(know_findings *f, know_index node, know_index symbol) {
  const knowledge *k = f->k;
  const know_symbol *s = &k->symbols[symbol];
  uint32_t count = 0;
  bool own = s->definition != 0, ok = true;
  for (know_index i = know_nth(k, node, 1); i; i = k->nodes[i].next) {
    if (k->nodes[i].kind != KNOW_KEYWORD) {
      count++;
      continue;
    }
    const char *name = k->names[k->nodes[i].name].text;
    bool known = own ? takes_keyword(k, s->arity.keywords, i) : has_keyword(s->keywords, name);
    bool keyless = !own && !strcmp(s->text, "draw"); /* keyless: draw accepts no keywords; other procedures without
                                                      * keywords may pass keywords to further procedures */
    if ((own ? s->arity.any_keyword : keyless || *s->keywords != 0) && !known) {
      know_found(f, KNOW_CHECK_ARGUMENTS, i, "%s takes no %s", s->text, name);
      ok = false;
    } else if (own && !s->arity.any_keyword && s->arity.most != UINT32_MAX) {
      know_found(f, KNOW_CHECK_ARGUMENTS, i, "%s has no keyword %s", s->text, name);
      return false;
    } else if (own && !s->arity.any_keyword) return ok; /* a rest parameter may receive the keyword */
    i = k->nodes[i].next;
    if (!i) return ok;
  }
  char wants[80];
  if (own) {
    if (count >= s->arity.least && count <= s->arity.most) return ok;
    plural(wants, sizeof wants, s->arity.least, s->arity.most);
    size_t n = 0;
    const char *list = s->arity.keywords ? know_spelling(k, s->arity.keywords, &n) : "";
    bool slash = false; /* whether the parameter list has a slash, as AutoLISP writes before local names */
    for (know_index i = s->arity.keywords ? k->nodes[s->arity.keywords].first : 0; i; i = k->nodes[i].next)
      slash = slash || know_is(k, i, "/");
    bool curried = n > 1 && *list == '('; /* curried: in (define (f x) ...), the first element of the list is the
                                           * procedure's name */
    know_found(f, KNOW_CHECK_ARGUMENTS, node, "%s takes %s and is given %u%s%.*s%s", s->text, wants, count,
               curried && n < 100 ? ": " : "", curried && n < 100 ? (int)n : 0, list,
               slash ? "; names behind / are not local here: (let ([y 0]) ...) in the body makes one" : "");
    return false;
  }
  range r = {0, 0};
  uint32_t forms = 0;
  for (const char *call = s->call; call && *call;) {
    call = read_call(call, &r);
    forms++;
    if (count >= r.least && count <= r.most) return ok;
  }
  if (!forms) return ok;
  if (forms > 1) snprintf(wants, sizeof wants, "other numbers of arguments");
  else plural(wants, sizeof wants, r.least, r.most);
  char calls[200];
  snprintf(calls, sizeof calls, "%s", s->call);
  for (char *c = strchr(calls, '\n'); c; c = strchr(c, '\n')) *c = ','; /* the forms of a call are on separate lines; a
                                                                         * comma replaces each newline */
  know_found(f, KNOW_CHECK_ARGUMENTS, node, "%s takes %s and is given %u: %s", s->text, wants, count, calls);
  return false;
}

/* ---- arguments that are wrong for every value of the call's other arguments ---- */

static bool among(const char *word, size_t n, const char *const *words) {
  for (; *words; words++)
    if (strlen(*words) == n && !memcmp(*words, word, n)) return true;
  return false;
}

/* Returns true if an argument of this type is wrong for a parameter of the language's procedures with this name. */
static bool wrong_for(const char *name, size_t n, know_type type, const char *call, bool known) {
  static const char *const strings[] = {"string", "string1", "string2", "strings", NULL};
  static const char *const vectors[] = {"vector", NULL}, *const procedures[] = {"f", "procedure", "pred", "predicate",
      "less?", NULL};
  static const char *const lists[] = {"list", "list1", "list2", "lists", NULL};
  static const char *const lengths[] = {"r", "r1", "r2", "h", "c", "c1", "c2", "p", "q", "dx", "dy", "dz", "n", "rho",
    "phi",
    "psi", "angle", "amount", "factor", "numbers", "index", "o", NULL};
  static const char *const objects[] = {"objects", "cutters", NULL};
  bool simple = type == KNOW_TYPE_NUMBER || type == KNOW_TYPE_BOOLEAN || type == KNOW_TYPE_CHARACTER;
  bool takes_objects = among(name, n, objects) || (n == 1 && *name == 'o');
  if (type == KNOW_TYPE_NOTHING)
    return takes_objects || among(name, n, lengths) || among(name, n, lists) || (n > 1 && among(name, n, procedures)) ||
           (among(name, n, procedures) && strstr(call, " f list"));
  if (among(name, n, strings)) return simple;
  if (among(name, n, vectors)) return simple || type == KNOW_TYPE_STRING || type == KNOW_TYPE_LIST;
  if (among(name, n, procedures))
    return (n > 1 || strstr(call, " f list")) && (simple || type == KNOW_TYPE_STRING);
  if (among(name, n, lists)) return simple;
  if (among(name, n, lengths))
    return type == KNOW_TYPE_STRING || type == KNOW_TYPE_CHARACTER ||
           (known && type == KNOW_TYPE_BOOLEAN && strncmp(call, "(do-resize ", 11) != 0);
  if (among(name, n, objects)) return simple || type == KNOW_TYPE_STRING || type == KNOW_TYPE_POINT;
  return false;
}

/* Reports an argument whose expression has no value. */
static void wrong_nothing(know_findings *f, know_index node, const know_symbol *s, const char *name, size_t n) {
  const knowledge *k = f->k;
  know_index head = k->nodes[node].first;
  const char *instead = know_is(k, head, "for")       ? "; `for` gives no list: for/list does"
                        : know_is(k, head, "for*")    ? "; `for*` gives no list: for*/list does"
                        : know_is(k, head, "for-each") ? "; `for-each` gives no list: map does"
                                                       : "";
  bool procedure = n == 1 && *name == 'f';
  know_found(f, KNOW_CHECK_CONTRACT, node, "%s: this gives no value%s%s", s->text, instead,
             procedure ? "; the procedure itself is wanted, named without parentheses, or (lambda (x) ...)" : "");
}

static void types_fit(know_findings *f, know_index node, const know_symbol *s) {
  const knowledge *k = f->k;
  bool known = know_plain_row(k, k->nodes[k->nodes[node].first].symbol) >= 0;
  bool several = strchr(s->call, '\n') && strncmp(s->call, "(map ", 5) != 0 && strncmp(s->call, "(for-each ", 10) != 0;
  if (!*s->call || several || (!known && strchr(s->call, '['))) return;
  const char *at = s->call + strcspn(s->call, " )"), *name = "";
  size_t n = 0;
  for (know_index i = know_nth(k, node, 1); i; i = k->nodes[i].next) {
    if (k->nodes[i].kind == KNOW_KEYWORD) {
      i = k->nodes[i].next;
      if (!i) return;
      continue;
    }
    const char *next = at + strspn(at, " [");
    size_t m = strcspn(next, " )]\n");
    if (m && strncmp(next, "...", 3) != 0) name = next, n = m, at = next + m;
    know_type type = know_type_of(k, i);
    if (!type || !wrong_for(name, n, type, s->call, known)) continue;
    if (type == KNOW_TYPE_NOTHING) {
      wrong_nothing(f, i, s, name, n);
      return;
    }
    know_found(f, KNOW_CHECK_CONTRACT, i, "%s: %.*s cannot be %s", s->text, (int)n, name, know_type_word(type));
    return;
  }
}

/* Checks a call of the program's own procedure with constants, if the contracts of the procedure use only the
 * language. */
static void own_contracts(know_findings *f, know_index node, const know_symbol *s) {
  knowledge *k = f->k;
  know_index p = s->parameters ? k->nodes[s->parameters].first : 0, a = know_nth(k, node, 1);
  if (p && s->kind == KNOW_FUNCTION && k->nodes[s->parameters].parent && k->nodes[p].symbol &&
      !strcmp(k->symbols[k->nodes[p].symbol].text, s->text))
    p = k->nodes[p].next;
  for (; p && a; p = k->nodes[p].next, a = k->nodes[a].next) {
    if (k->nodes[p].kind == KNOW_KEYWORD || k->nodes[a].kind == KNOW_KEYWORD) return;
    know_index contract = k->nodes[p].kind == KNOW_LIST ? know_nth(k, p, 1) : 0;
    if (!contract) continue;
    bool plain_contract = true;
    for (know_index i = contract; i && plain_contract; i = i == contract ? k->nodes[contract].first : k->nodes[i].next)
        {
      if (k->nodes[i].kind == KNOW_SYMBOL) plain_contract = k->nodes[i].symbol &&
          !k->symbols[k->nodes[i].symbol].definition;
      else if (i != contract) plain_contract = false;
    }
    if (!plain_contract) continue;
    know_expression t = {0};
    size_t length;
    const char *spelling = know_spelling(k, p, &length);
    know_put(&t, "(let () (define (", 17);
    know_put(&t, s->text, strlen(s->text));
    know_put(&t, spelling, length);
    know_put(&t, ") #t) (", 7);
    know_put(&t, s->text, strlen(s->text));
    know_put_constant(k, a, &t);
    know_put(&t, "))", 2);
    const char *why = t.failed ? "" : know_objection(k, a, t.at, t.count);
    free(t.at);
    if (*why && !know_guarded(k, node)) know_found(f, KNOW_CHECK_CONTRACT, a, "%s", why);
  }
}

/* Reports a call of a value that is no procedure. The message is that of a run for a literal, or for a name that hides
 * a procedure. */
static void calls_value(know_findings *f, know_index node, know_type type) {
  knowledge *k = f->k;
  know_index head = k->nodes[node].first;
  char message[300];
  size_t n;
  const char *spelling = know_spelling(k, head, &n);
  snprintf(message, sizeof message, "this calls %s", know_type_word(type));
  vs_name_info info;
  if (k->nodes[head].kind == KNOW_SYMBOL && k->symbols[k->nodes[head].symbol].scope > 2 && !k->script &&
      vs_name_get(k->scheme, k->names[k->nodes[head].name].text, &info) && !strcmp(info.kind, "procedure")) {
    know_found(f, KNOW_CHECK_NOT_A_PROCEDURE, node, "%s", know_advised(k, VS_ADVICE_CALL, node, message));
    return;
  }
  if (k->nodes[head].kind == KNOW_SYMBOL)
    snprintf(message, sizeof message, "%.60s is %s here, no procedure; its value is %.60s, without parentheses",
             k->names[k->nodes[head].name].text, know_type_word(type), k->names[k->nodes[head].name].text);
  else if (k->nodes[head].kind == KNOW_LIST)
    snprintf(message, sizeof message, "this is %s, no procedure: one parenthesis too many around it",
             know_type_word(type));
  else if (n < 100) {
    char call[140];
    int length = snprintf(call, sizeof call, "(%.*s%s)", (int)n, spelling, k->nodes[node].count > 1 ? " 1" : "");
    const char *why = know_objection(k, node, call, (size_t)length);
    if (*why) snprintf(message, sizeof message, "%s", why);
  }
  know_found(f, KNOW_CHECK_NOT_A_PROCEDURE, node, "%s",
             k->script ? message : know_advised(k, VS_ADVICE_CALL, node, message));
}

/* Reports a call of a parameter whose name hides a procedure of the language, if the program passes values to the
 * parameter that are no procedures. */
static void calls_parameter(know_findings *f, know_index node) {
  knowledge *k = f->k;
  const know_symbol *s = &k->symbols[k->nodes[k->nodes[node].first].symbol], *owner = &k->symbols[s->owner];
  vs_name_info info;
  if (s->kind != KNOW_PARAMETER || !s->owner || owner->kind != KNOW_FUNCTION || k->script || s->sets) return;
  if (!vs_name_get(k->scheme, s->text, &info) || strcmp(info.kind, "procedure") != 0) return;
  uint32_t nth = 0; /* position of the argument in the call, from 0 */
  know_index p = owner->parameters ? k->nodes[owner->parameters].first : 0;
  for (; p && k->nodes[p].symbol != (know_index)(s - k->symbols); p = k->nodes[p].next, nth++) {}
  if (!p) return;
  for (know_index u = owner->first_use; u; u = k->uses[u].next) {
    know_index call = k->nodes[k->uses[u].node].parent;
    know_type type = k->uses[u].called && call ? know_type_of(k, know_nth(k, call, nth)) : KNOW_TYPE_UNKNOWN;
    if (!type || type == KNOW_TYPE_PROCEDURE) continue;
    know_found(f, KNOW_CHECK_NOT_A_PROCEDURE, node, "%s", know_advised(k, VS_ADVICE_CALL, node, ""));
    return;
  }
}

/* Reports (map (lambda x ...) list): x is a list of all arguments of a call, which has only one element here. */
static void maps_rest(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  know_index head = k->nodes[node].first, procedure = know_nth(k, node, 1), name = know_nth(k, procedure, 1);
  bool maps = know_is(k, head, "map") || know_is(k, head, "for-each") || know_is(k, head, "filter");
  if (!maps || k->nodes[node].count != 3 || k->nodes[procedure].kind != KNOW_LIST || !k->nodes[procedure].form) return;
  if (!know_is(k, k->nodes[procedure].first, "lambda") || k->nodes[name].kind != KNOW_SYMBOL) return;
  const char *shown = k->names[k->nodes[name].name].text;
  know_found(f, KNOW_CHECK_CONTRACT, name, "%s is the list of all arguments here: (lambda (%s) ...) names one", shown,
             shown);
}

/* Reports a chain of comparisons such as (< 1 x < 3). */
static bool has_sign_inside(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  static const char *const signs[] = {"<", ">", "<=", ">=", "="};
  bool compares = false, inside = false;
  for (size_t i = 0; i < sizeof signs / sizeof *signs; i++) {
    compares = compares || know_is(k, k->nodes[node].first, signs[i]);
    for (know_index a = know_nth(k, node, 1); a; a = k->nodes[a].next) inside = inside || know_is(k, a, signs[i]);
  }
  if (!compares || !inside) return false;
  know_found(f, KNOW_CHECK_CONTRACT, node, "%s",
             know_advised(k, VS_ADVICE_CHAIN, node, "a sign of a comparison is no number"));
  return true;
}

/* Reports (do-move o v) as a statement after o was drawn: it makes a moved copy, which the program does not draw. */
static void moves_drawn(know_findings *f, know_index node) {
  const knowledge *k = f->k;
  static const char *const moves[] = {"do-move", "do-rotate", "do-scale", "do-mirror", "do-transform", "move", "rotate",
                                      "scale", "translate", "color", "with-material", "layer"};
  bool moving = false;
  for (size_t i = 0; i < sizeof moves / sizeof *moves; i++)
    moving = moving || know_is(k, k->nodes[node].first, moves[i]);
  if (!moving || !k->nodes[node].statement || k->nodes[node].parent != k->files[k->nodes[node].at.file].root) return;
  for (know_index a = know_nth(k, node, 1); a; a = k->nodes[a].next) {
    know_index symbol = k->nodes[a].kind == KNOW_SYMBOL ? k->nodes[a].symbol : 0;
    for (know_index u = symbol ? k->symbols[symbol].first_use : 0; u; u = k->uses[u].next) {
      know_index at = k->uses[u].node, call = k->nodes[at].parent;
      if (at >= node || !call || !know_is(k, k->nodes[call].first, "draw")) continue;
      size_t n;
      const char *shown = know_spelling(k, node, &n);
      know_found(f, KNOW_CHECK_NO_EFFECT, node,
                 "this is not drawn: %s is drawn as it was, and does not change; (draw %.*s) draws the new object",
                 k->symbols[symbol].text, (int)(n > 90 ? 90 : n), shown);
      return;
    }
  }
}

void know_check_calls(know_findings *f) {
  knowledge *k = f->k;
  size_t answers = 0;
  uint8_t *wrong = know_alloc(k, k->node_count);
  if (!wrong) return;
  /* visits inner calls before outer calls, which precede them in the text, so that the innermost fault is reported */
  for (know_index i = (know_index)k->node_count; i-- > 1 && !*k->trouble;) {
    if (!know_is_call(k, i) || k->nodes[i].form) continue;
    know_index head = k->nodes[i].first;
    know_type type = know_type_of(k, head);
    if (type && type != KNOW_TYPE_PROCEDURE) {
      calls_value(f, i, type);
      continue;
    }
    if (k->nodes[head].kind != KNOW_SYMBOL || k->nodes[head].role != KNOW_REFERENCE || !k->nodes[head].symbol) continue;
    know_index symbol = k->nodes[head].symbol;
    const know_symbol *s = &k->symbols[symbol];
    bool spliced = k->nodes[i].dotted;
    if (spliced) continue;
    if (s->kind == KNOW_PARAMETER) calls_parameter(f, i);
    if (s->kind == KNOW_BUILTIN) {
      if (k->library) continue;
      if (!k->script && has_sign_inside(f, i)) {
        wrong[i] = 1;
        continue;
      }
      if (!k->script) maps_rest(f, i), moves_drawn(f, i);
      size_t before = f->count;
      bool plain_call = know_plain_row(k, symbol) >= 0 && answers++ < MOST_ANSWERS;
      size_t found = f->count;
      if ((!plain_call || know_check_constants(f, i, wrong)) && !wrong[i] && !count_fits(f, i, symbol)) wrong[i] = 1;
      know_type result = plain_call ? know_plain_type(know_plain_row(k, symbol)) : KNOW_TYPE_UNKNOWN;
      bool shape = result == KNOW_TYPE_OBJECT || result == KNOW_TYPE_POINT || result == KNOW_TYPE_GVECTOR;
      if (shape && !k->script && f->count == found && !wrong[i] && (answers += 4) < MOST_ANSWERS)
        know_check_with_unknown(f, i, wrong);
      if (f->count == before && !wrong[i]) types_fit(f, i, s);
    } else if (s->arity.known && s->definitions == 1 && !s->sets && !s->made) {
      if (!count_fits(f, i, symbol)) wrong[i] = 1;
      else if (s->kind == KNOW_FUNCTION && answers++ < MOST_ANSWERS) own_contracts(f, i, s);
    }
  }
}
