/* Implements the checks of calls: the number and types of arguments, and the language's own errors for calls with
 * constants. */
#include "languages/checks/argument_checks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { MOST_ANSWERS = 3000, MOST_TEXT = 2000, MOST_DEPTH = 60 };

static const struct { const char *name; know_type type; } plain[] = {
#define KNOW_PLAIN(name, type) {name, KNOW_TYPE_##type},
#include "languages/checks/plain_calls.def"
};

const char *know_type_word(know_type type) {
  static const char *const words[] = {"something", "a number", "a string", "a boolean", "a character", "a symbol",
    "a list", "a vector", "a procedure", "a point", "a gvector", "an object"};
  return words[type];
}

static int plain_row(const knowledge *k, know_index symbol) {
  if (!symbol || k->symbols[symbol].kind != KNOW_BUILTIN) return -1;
  for (int i = 0; i < (int)(sizeof plain / sizeof *plain); i++)
    if (!strcmp(plain[i].name, k->symbols[symbol].text)) return i;
  return -1;
}

/* Returns the value of a variable that is defined once and never set. */
static know_index constant_value(const knowledge *k, know_index node) {
  const know_node *n = &k->nodes[node];
  if (n->kind != KNOW_SYMBOL || n->role != KNOW_REFERENCE || !n->symbol) return 0;
  const know_symbol *s = &k->symbols[n->symbol];
  bool fixed = s->definitions == 1 && !s->sets && !s->made && !s->owner && (s->kind == KNOW_VARIABLE ||
      s->kind == KNOW_LOCAL);
  return fixed ? s->value : 0;
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
      know_index value = constant_value(k, node);
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
      int row = n->form ? -1 : plain_row(k, k->nodes[head].symbol);
      if (row < 0 || (n->count == 2 && know_is(k, head, "subtract"))) return KNOW_TYPE_UNKNOWN; /* such a call returns a
                                                                                                 * procedure that waits
                                                                                                 * for the other
                                                                                                 * operands */
      if (plain[row].type || row > 3) return plain[row].type;
      for (know_index i = k->nodes[head].next; i; i = k->nodes[i].next) /* + - * / of numbers: one level of operands is
                                                                         * sufficient */
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

/* Reads the range from a text such as "(make-box c dx dy dz)". Brackets enclose optional arguments, and ... follows an
 * argument that may be repeated. */
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
    if ((own ? s->arity.any_keyword : *s->keywords != 0) && !known) {
      know_found(f, KNOW_CHECK_ARGUMENTS, i, "%s takes no %s", s->text, name);
      ok = false;
    } else if (own && !s->arity.any_keyword && s->arity.most != UINT32_MAX) {
      know_found(f, KNOW_CHECK_ARGUMENTS, i, "%s has no keyword %s", s->text, name);
      return false;
    } else if (own && !s->arity.any_keyword) return ok; /* the rest argument may contain the keyword */
    i = k->nodes[i].next;
    if (!i) return ok;
  }
  char wants[80];
  if (own) {
    if (count >= s->arity.least && count <= s->arity.most) return ok;
    plural(wants, sizeof wants, s->arity.least, s->arity.most);
    know_found(f, KNOW_CHECK_ARGUMENTS, node, "%s takes %s and is given %u", s->text, wants, count);
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
  know_found(f, KNOW_CHECK_ARGUMENTS, node, "%s takes %s and is given %u", s->text, wants, count);
  return false;
}

/* ---- types that are wrong for every value of the other arguments ---- */

static bool among(const char *word, size_t n, const char *const *words) {
  for (; *words; words++)
    if (strlen(*words) == n && !memcmp(*words, word, n)) return true;
  return false;
}

/* Returns true if the type is wrong for a parameter of the language with this name. */
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
  if (among(name, n, strings)) return simple;
  if (among(name, n, vectors)) return simple || type == KNOW_TYPE_STRING || type == KNOW_TYPE_LIST;
  if (among(name, n, procedures))
    return (n > 1 || strstr(call, " f list")) && (simple || type == KNOW_TYPE_STRING);
  if (among(name, n, lists)) return simple;
  if (among(name, n, lengths)) 
    return type == KNOW_TYPE_STRING || type == KNOW_TYPE_CHARACTER || (known && type == KNOW_TYPE_BOOLEAN);
  if (among(name, n, objects)) return simple || type == KNOW_TYPE_STRING || type == KNOW_TYPE_POINT;
  return false;
}

static void types_fit(know_findings *f, know_index node, const know_symbol *s) {
  const knowledge *k = f->k;
  bool known = plain_row(k, k->nodes[k->nodes[node].first].symbol) >= 0;
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
    know_found(f, KNOW_CHECK_CONTRACT, i, "%s: %.*s cannot be %s", s->text, (int)n, name, know_type_word(type));
    return;
  }
}

/* ---- calls of constants ---- */

typedef struct { char *at; size_t count, room; bool failed; int depth; } text;

static void put(text *t, const char *s, size_t n) {
  if (t->count + n + 2 > MOST_TEXT) t->failed = true;
  if (t->failed || !VS_GROW(t->at, t->room, t->count + n + 2)) {
    t->failed = true;
    return;
  }
  memcpy(t->at + t->count, s, n);
  t->count += n;
  t->at[t->count++] = ' ';
}

/* Writes the expression with the values of its variables. Sets failed if the expression is not constant. */
static void constant(const knowledge *k, know_index node, text *t) {
  const know_node *n = &k->nodes[node];
  size_t length;
  const char *s = know_spelling(k, node, &length);
  if (t->failed || ++t->depth > MOST_DEPTH) {
    t->failed = true;
    return;
  }
  know_index head = n->first, value;
  if (n->kind == KNOW_NUMBER || n->kind == KNOW_STRING || n->kind == KNOW_BOOLEAN || n->kind == KNOW_CHARACTER ||
      n->kind == KNOW_KEYWORD)
    put(t, s, length);
  else if (n->kind == KNOW_LIST && n->walked && n->form && know_is(k, head, "quote")) put(t, s, length);
  else if (n->kind == KNOW_LIST && n->walked && !n->form && !n->expansion && plain_row(k,
      head ? k->nodes[head].symbol : 0) >= 0) {
    put(t, "(", 1);
    for (know_index i = head; i; i = k->nodes[i].next)
      if (i == head) put(t, k->symbols[k->nodes[head].symbol].text, strlen(k->symbols[k->nodes[head].symbol].text));
      else constant(k, i, t);
    put(t, ")", 1);
  } else if (n->kind == KNOW_SYMBOL && n->role == KNOW_REFERENCE && k->symbols[n->symbol].kind == KNOW_BUILTIN &&
      !*k->symbols[n->symbol].call &&
             *k->symbols[n->symbol].text != '%')
    put(t, k->symbols[n->symbol].text, strlen(k->symbols[n->symbol].text)); /* a constant of the language, such as pi,
                                                                             * origin or ux */
  else if ((value = constant_value(k, node)) != 0) constant(k, value, t);
  else t->failed = true;
  t->depth--;
}

/* Returns the interpreter's error for the text, or "" if there is none. */
static const char *objection(knowledge *k, const char *program, size_t length) {
  *k->heard = 0;
  k->muted = true;
  vs_outcome outcome = vs_eval_text(k->scheme, "constant", 1, program, length, 0);
  k->muted = false;
  return outcome == VS_OUTCOME_MODEL ? k->heard : "";
}

static bool guarded(const knowledge *k, know_index node) {
  for (; node; node = k->nodes[node].parent)
    if (know_is(k, k->nodes[node].first, "guard") || know_is(k, k->nodes[node].first,
        "with-exception-handler")) return true;
  return false;
}

static bool of_constants(know_findings *f, know_index node, uint8_t *wrong) {
  knowledge *k = f->k;
  for (know_index i = know_nth(k, node, 1); i; i = k->nodes[i].next)
    if (wrong[i]) return wrong[node] = 1, false; /* the error is already reported for the inner call */
  text t = {0};
  constant(k, node, &t);
  const char *why = t.failed ? "" : objection(k, t.at, t.count);
  free(t.at);
  if (*why && !guarded(k, node)) know_found(f, KNOW_CHECK_CONTRACT, node, "%s", why);
  wrong[node] = *why != 0;
  return !*why;
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
    text t = {0};
    size_t length;
    const char *spelling = know_spelling(k, p, &length);
    put(&t, "(let () (define (", 17);
    put(&t, s->text, strlen(s->text));
    put(&t, spelling, length);
    put(&t, ") #t) (", 7);
    put(&t, s->text, strlen(s->text));
    constant(k, a, &t);
    put(&t, "))", 2);
    const char *why = t.failed ? "" : objection(k, t.at, t.count);
    free(t.at);
    if (*why && !guarded(k, node)) know_found(f, KNOW_CHECK_CONTRACT, a, "%s", why);
  }
}

void know_check_calls(know_findings *f) {
  knowledge *k = f->k;
  size_t answers = 0;
  uint8_t *wrong = know_alloc(k, k->node_count);
  if (!wrong) return;
  /* inner calls follow outer calls in the text, so the loop reports the innermost fault */
  for (know_index i = (know_index)k->node_count; i-- > 1 && !*k->trouble;) {
    if (!know_is_call(k, i) || k->nodes[i].form) continue;
    know_index head = k->nodes[i].first;
    know_type type = know_type_of(k, head);
    if (type && type != KNOW_TYPE_PROCEDURE) {
      know_found(f, KNOW_CHECK_NOT_A_PROCEDURE, i, "this calls %s", know_type_word(type));
      continue;
    }
    if (k->nodes[head].kind != KNOW_SYMBOL || k->nodes[head].role != KNOW_REFERENCE || !k->nodes[head].symbol) continue;
    know_index symbol = k->nodes[head].symbol;
    const know_symbol *s = &k->symbols[symbol];
    bool spliced = k->nodes[i].dotted;
    if (spliced) continue;
    if (s->kind == KNOW_BUILTIN) {
      if (k->library) continue;
      size_t before = f->count;
      if (!count_fits(f, i, symbol)) wrong[i] = 1;
      else if (plain_row(k, symbol) >= 0 && answers++ < MOST_ANSWERS) of_constants(f, i, wrong);
      if (f->count == before && !wrong[i]) types_fit(f, i, s);
    } else if (s->arity.known && s->definitions == 1 && !s->sets && !s->made) {
      if (!count_fits(f, i, symbol)) wrong[i] = 1;
      else if (s->kind == KNOW_FUNCTION && answers++ < MOST_ANSWERS) own_contracts(f, i, s);
    }
  }
}
