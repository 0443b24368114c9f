/* Implements advice that is computed from the program's text around the place of an error. The text is not parsed as a
 * program; after a wrong guess, advice is only missing or useless. */
#include "session/text_advice.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "session/names.h"
#include "session/source_outline.h"
#include "vm/front/environment.h"
#include "vm/front/suggest.h"
#include "vm/values/printer.h"

enum { LONGEST_WORD = 60, LONGEST_FORM = 90 };

typedef struct { const char *at; size_t n; } word;

static bool is(word w, const char *text) { return w.n == strlen(text) && !memcmp(w.at, text, w.n); }
static bool same(word a, word b) { return a.n == b.n && !memcmp(a.at, b.at, a.n); }
static bool is_among(word w, const char *words) {
  for (const char *at = words; w.n && *at; at += *at == ' ') {
    size_t n = strcspn(at, " ");
    if (n == w.n && !memcmp(at, w.at, n)) return true;
    at += n;
  }
  return false;
}

static const char *skip_blanks(const char *at, const char *end) {
  uint32_t unused = 0;
  return vs_outline_blanks(at, end, &unused);
}
static const char *skip_datum(const char *at, const char *end) {
  uint32_t unused = 0;
  return vs_outline_datum(at, end, &unused);
}
static bool opens(const char *at, const char *end) { return at < end && (*at == '(' || *at == '['); }
static bool closes(const char *at, const char *end) { return at >= end || *at == ')' || *at == ']' || *at == '}'; }
static word word_at(const char *at, const char *end) { return (word){ at, vs_outline_word(at, end) }; }

/* Returns the first word within the parentheses at `at`; the word is empty if there is none. */
static word head_of(const char *at, const char *end) {
  if (!opens(at, end)) return (word){ at, 0 };
  return word_at(skip_blanks(at + 1, end), end);
}
/* Returns the element that follows the element at `at`; if there is none, returns the closing parenthesis. */
static const char *next_of(const char *at, const char *end) { return skip_blanks(skip_datum(at, end), end); }
static const char *first_of(const char *at, const char *end) { return skip_blanks(at + 1, end); }

/* Returns the top-level form that contains p. */
static const char *top_form(vs_text_place p) {
  const char *at = skip_blanks(p.start, p.end);
  while (at < p.at) {
    const char *end = skip_datum(at, p.end);
    if (end > p.at || end <= at) return at;
    at = skip_blanks(end, p.end);
  }
  return at;
}

static unsigned line_of(vs_text_place p, const char *at) {
  unsigned line = p.first_line;
  for (const char *c = p.start; c < at; c++) line += *c == '\n';
  return line;
}

/* ---- names that hide procedures, and lists of all arguments ---- */

static bool has_parameter(const char *list, const char *end, word name) {
  for (const char *at = first_of(list, end); !closes(at, end); at = next_of(at, end)) {
    word parameter = opens(at, end) ? head_of(at, end) : word_at(at, end);
    if (same(parameter, name)) return true;
  }
  return false;
}

bool vs_text_advise_hidden(vs_text_place p, vs_text *t) {
  const char *form = top_form(p), *owner = first_of(form, p.end);
  word name = head_of(p.at, p.end);
  if (!name.n || name.n > LONGEST_WORD) return true;
  const char *second = next_of(owner, p.end);
  word procedure = head_of(second, p.end);
  static const char why[] = "no procedure: give it another name, and (%.*s ...) calls the procedure again";
  char rest[200];
  snprintf(rest, sizeof rest, why, (int)name.n, name.at);
  if (is(head_of(form, p.end), "define") && procedure.n && procedure.n < LONGEST_WORD) {
    const char *parameters = next_of(first_of(second, p.end), p.end);
    for (const char *at = parameters; !closes(at, p.end); at = next_of(at, p.end))
      if (same(opens(at, p.end) ? head_of(at, p.end) : word_at(at, p.end), name)) {
        t->count = 0;
        return vs_text_printf(t, "%.*s is the parameter of %.*s here, %s", (int)name.n, name.at, (int)procedure.n,
                              procedure.at, rest);
      }
  }
  for (const char *at = form; at < p.at; at++) {
    if (!opens(at, p.at)) continue;
    word head = head_of(at, p.end);
    const char *list = next_of(skip_blanks(head.at, p.end), p.end);
    bool parameter = is_among(head, "lambda") && opens(list, p.end) && has_parameter(list, p.end, name);
    const char *before = at; /* before: end of the text before the name. In a binding, a parenthesis or another binding
                              * precedes the name */
    while (before > form && strchr(" \t\r\n", before[-1])) before--;
    bool clause = same(head, name) && before > form && strchr("([)]", before[-1]) && skip_datum(at, p.end) <= p.at;
    if (!parameter && !clause) continue;
    t->count = 0;
    return vs_text_printf(t, "%.*s is a %s here, %s", (int)name.n, name.at, parameter ? "parameter" : "variable", rest);
  }
  return true;
}

static bool has_operand(vs_text_place p, word name) {
  for (const char *at = next_of(first_of(p.at, p.end), p.end); !closes(at, p.end); at = next_of(at, p.end))
    if (same(word_at(at, p.end), name)) return true;
  return false;
}

bool vs_text_advise_rest(vs_text_place p, vs_text *t) {
  for (const char *at = top_form(p); at < p.at; at++) {
    word head = opens(at, p.at) ? head_of(at, p.end) : (word){ at, 0 };
    if (!is(head, "lambda") && !is(head, "\316\273")) continue;
    word name = word_at(skip_blanks(head.at + head.n, p.end), p.end);
    if (name.n && name.n < LONGEST_WORD && has_operand(p, name))
      return vs_text_printf(t, "; %.*s is the list of all arguments here: (lambda (%.*s) ...) names one", (int)name.n,
                            name.at, (int)name.n, name.at);
  }
  return true;
}

/* ---- operators ---- */

bool vs_text_advise_operator(vs_text_place p, vs_text *t) {
  static const struct { const char *sign, *form; } operators[] = {
    { "**", "(expt %.*s %.*s)" },      { "^", "(expt %.*s %.*s)" },       { "%", "(modulo %.*s %.*s)" },
    { "mod", "(modulo %.*s %.*s)" },   { "//", "(quotient %.*s %.*s)" },  { "==", "(equal? %.*s %.*s)" },
    { "===", "(equal? %.*s %.*s)" },   { "!=", "(not (equal? %.*s %.*s))" }, { "!==", "(not (equal? %.*s %.*s))" },
    { "&&", "(and %.*s %.*s)" },       { "||", "(or %.*s %.*s)" },        { "in", "(member %.*s %.*s)" },
    { "+=", "(set! x (+ %.*s %.*s))" }, { "-=", "(set! x (- %.*s %.*s))" }, { "*=", "(set! x (* %.*s %.*s))" },
    { "\303\227", "(* %.*s %.*s)" },     { "\342\211\244", "(<= %.*s %.*s)" },    { "\342\211\245", "(>= %.*s %.*s)" },
    { "?", "(if %.*s %.*s other), without ?" },
  };
  word sign = word_at(p.at, p.end);
  const char *first = p.at;
  while (first > p.start && strchr(" \t\r\n", first[-1])) first--;
  const char *end = first;
  while (first > p.start && !strchr(" \t\r\n()[]\"';", first[-1])) first--;
  const char *second = skip_blanks(p.at + sign.n, p.end), *after = skip_datum(second, p.end);
  if (first == p.start || !strchr("([", first[-1]) || end == first || closes(second, p.end) ||
      end - first > LONGEST_WORD || after - second > LONGEST_WORD) return true;
  if (is((word){ first, (size_t)(end - first) }, "not") && is(sign, "in")) {
    t->count = 0;
    return vs_text_printf(t, "there is no `not in`: (not (member x list))");
  }
  for (size_t i = 0; i < sizeof operators / sizeof *operators; i++) {
    if (!is(sign, operators[i].sign)) continue;
    char text[300], form[80];
    bool sets = strstr(operators[i].form, "(set! x") != NULL; /* sets: whether the advised form assigns to x, the first
                                                               * operand */
    if (sets)
      snprintf(form, sizeof form, "(set! %.*s %s", (int)(end - first > 30 ? 30 : end - first), first,
               operators[i].form + 8);
    else snprintf(form, sizeof form, "%s", operators[i].form);
    const char *before = strstr(form, "%.*s"), *between = before ? before + 4 : form, *last = strstr(between, "%.*s");
    if (!before || !last) return true;
    snprintf(text, sizeof text, "%.*s%.*s%.*s%.*s%s", (int)(before - form), form, (int)(end - first), first,
             (int)(last - between), between, (int)(after - second), second, last + 4);
    t->count = 0;
    return vs_text_printf(t, "the operator comes first: %s", text);
  }
  return true;
}

/* ---- quoted lists, chains of comparisons, tables ---- */

bool vs_text_advise_quoted(vs_text_place p, const char *wanted, vs_text *t) {
  const word name = { wanted, strlen(wanted) };
  const char *stop = skip_datum(p.at, p.end);
  for (const char *at = p.at; at + 1 < stop; at++) {
    if (*at == '"') at = skip_datum(at, stop) - 1;
    if (*at != '\'' || !opens(at + 1, stop)) continue;
    const char *list = at + 1, *end = skip_datum(list, stop);
    bool found = false;
    for (const char *e = first_of(list, stop); !closes(e, end) && !found; e = next_of(e, stop))
      found = same(word_at(e, stop), name);
    int shown = (int)(end - list - 2);
    if (!found || shown > LONGEST_FORM) continue;
    return vs_text_printf(t, "; a ' before a list makes its names mere words: (list %.*s) holds their values", shown,
                          list + 1);
  }
  return true;
}

bool vs_text_advise_chain(vs_text_place p, vs_text *t) {
  static const char signs[] = "< > <= >= =";
  word head = head_of(p.at, p.end);
  if (!is_among(head, signs)) return true;
  bool chain = false, equal = true;
  for (const char *at = next_of(head.at, p.end); !closes(at, p.end); at = next_of(at, p.end))
    if (is_among(word_at(at, p.end), signs)) chain = true, equal = equal && same(word_at(at, p.end), head);
  if (!chain || skip_datum(p.at, p.end) - p.at > LONGEST_FORM) return true;
  if (!equal) return vs_text_printf(t, "; each sign is a call of its own: (and (< a b) (<= b c))");
  bool ok = vs_text_printf(t, "; one sign compares all: (%.*s", (int)head.n, head.at);
  for (const char *at = next_of(head.at, p.end); ok && !closes(at, p.end); at = next_of(at, p.end))
    if (!is_among(word_at(at, p.end), signs)) ok = vs_text_printf(t, " %.*s", (int)(skip_datum(at, p.end) - at), at);
  return ok && vs_text_puts(t, ")");
}

/* Writes the keys of a table in the text, '((key . value) ...) or (list (cons key value) ...). Returns their number. */
static int put_keys(const char *table, const char *end, vs_text *t) {
  int count = 0;
  if (*table == '\'') table = skip_blanks(table + 1, end);
  /* if the table is a value from a check, its text begins with (quote instead of a quotation mark */
  if (is(head_of(table, end), "quote")) table = next_of(first_of(table, end), end);
  for (const char *at = first_of(table, end); opens(table, end) && !closes(at, end) && count < 12;
       at = next_of(at, end)) {
    const char *key = opens(at, end) ? first_of(at, end) : NULL;
    if (key && is_among(word_at(key, end), "cons list")) key = next_of(key, end);
    if (!key || opens(key, end)) continue;
    if (*key == '\'') key++;
    if (!vs_text_printf(t, "%s%.*s", count ? ", " : "", (int)(skip_datum(key, end) - key), key)) return 0;
    count++;
  }
  return count;
}

/* Writes the keys of an association list. Returns their number. */
static int put_value_keys(vs_scheme *vm, vs_value table, vs_text *t) {
  int count = 0;
  for (; vs_is_pair(table) && count < 12; table = vs_cdr(table)) {
    if (!vs_is_pair(vs_car(table))) continue;
    if ((count && !vs_text_puts(t, ", ")) || !vs_print(vm, vs_car(vs_car(table)), VS_PRINT_WRITE, t)) return 0;
    count++;
  }
  return count;
}

bool vs_text_advise_missing_key(vs_scheme *vm, vs_text_place p, vs_text *t) {
  const char *inner = next_of(first_of(p.at, p.end), p.end);
  if (!is_among(head_of(p.at, p.end), "car cdr cadr cddr first second") ||
      !is_among(head_of(inner, p.end), "assq assv assoc")) return true;
  const char *key = next_of(first_of(inner, p.end), p.end), *table = next_of(key, p.end);
  size_t before = t->count;
  if (closes(key, p.end) || closes(table, p.end)) return true;
  if (!vs_text_printf(t, "; there is no %.*s in the table; its keys: ", (int)(skip_datum(key, p.end) - key), key))
    return false;
  word name = word_at(table, p.end);
  VS_ROOTS(vm, r, 1);
  vs_meaning m = { 0 };
  if (name.n && !vs_intern(vm, name.at, name.n, &r[0])) return false;
  if (name.n) m = vs_environment_find(vm->at.program, r[0]);
  bool bound = name.n && m.kind == VS_MEANS_CELL;
  if (bound) r[0] = vs_as_cell(m.value)->value;
  if (bound ? !put_value_keys(vm, r[0], t) : !put_keys(table, p.end, t)) {
    t->count = before;
    return vs_text_printf(
        t, "; (assq key table) is #f where the table has no such key: (let ([e (assq key table)]) (if e (cdr e) 0))");
  }
  return true;
}

/* ---- statements of other languages ---- */

/* Returns the word directly before the parenthesis at p. If there is none, returns the first word of the line, which is
 * empty if the line does not begin with a word. */
static word statement_of(vs_text_place p) {
  const char *word_start = p.at; /* word_start: beginning of the word directly before the parenthesis, as in f(x) */
  while (p.at < p.end && *p.at == '(' && word_start > p.start && !strchr(" \t\r\n()[]{}\"';,", word_start[-1]))
    word_start--;
  if (word_start < p.at) return (word){ word_start, (size_t)(p.at - word_start) };
  const char *at = p.at < p.end ? p.at : p.end;
  while (at > p.start && at[-1] != '\n') at--;
  while (at < p.end && (*at == ' ' || *at == '\t' || *at == '%' || *at == '*' || *at == '}')) at++;
  return word_at(at, p.end);
}

bool vs_text_advise_statement(vs_scheme *vm, vs_text_place p, vs_text *t) {
  word w = statement_of(p);
  char name[LONGEST_WORD + 1];
  if (!w.n || w.n > LONGEST_WORD || !(isalpha((unsigned char)*w.at) || *w.at == '$')) return true;
  memcpy(name, w.at, w.n);
  name[w.n] = 0;
  const char *behind = w.at + w.n;
  bool called = behind < p.end && (*behind == '(' || *behind == '[');
  while (behind < p.end && (*behind == ' ' || *behind == '\t')) behind++;
  bool alone = vs_text_end(t) && t->at && strstr(t->at, "is syntax and has no value") != NULL;
  if (vs_is_foreign_name(name)) {
    vs_text advice; /* receives the advice, which begins with a semicolon and a blank */
    vs_text_open(vm, &advice, 600);
    bool ok =
        vs_foreign_advice(name, &advice) && vs_text_end(&advice) && vs_text_printf(t, "; %s: %s", name, advice.at + 2);
    vs_text_close(&advice);
    return ok;
  }
  word variable = word_at(behind, p.end);
  const char *sign = skip_blanks(variable.at + variable.n, p.end);
  bool declares = is_among(w, "let const var") && variable.n && sign + 1 < p.end && *sign == '=' && sign[1] != '=';
  word assigned = word_at(behind, p.end);
  if (is(assigned, "=") || declares) {
    const char *value = skip_blanks(declares ? sign + 1 : behind + 1, p.end);
    size_t n = strcspn(value, ";\n");
    if (value + n > p.end) n = (size_t)(p.end - value);
    const char *target = declares ? variable.at : w.at;
    int length = (int)(declares ? variable.n : w.n);
    if (*value == '[') return vs_text_printf(t, "; (define %.*s (list 1 2 3)) names a list", length, target);
    return n && n < 60 && !memchr(value, '{', n) &&
           vs_text_printf(t, "; (define %.*s %.*s) names a value", length, target, (int)n, value);
  }
  vs_name_info info;
  bool control = *behind == '(' && is_among(w, "if for while when unless cond case");
  if ((!called && !alone && !control) || !vs_name_get(vm, name, &info) || !*info.call) return true;
  if (alone && strstr(t->at, "it is written")) return true;
  if (alone) return vs_text_printf(t, ": %.*s", (int)strcspn(info.call, "\n"), info.call);
  return vs_text_printf(t, "; the parenthesis comes before the name: %.*s", (int)strcspn(info.call, "\n"), info.call);
}

/* ---- parts without a value ---- */

static const struct { const char *word; int parts; const char *why; } valueless[] = {
  { "if", 3, "this `if` has no value where its test is false: (if test object (empty-object))" },
  { "when", 0, "`when` has no value where its test is false: (if test object (empty-object))" },
  { "unless", 0, "`unless` has no value where its test is true: (if test (empty-object) object)" },
  { "cond", 0, "this `cond` has no value where no test is true: [else (empty-object)]" },
  { "for", 0, "`for` gives no list: for/list does" },
  { "for*", 0, "`for*` gives no list: for*/list does" },
  { "for-each", 0, "`for-each` gives no list: map does" },
  { "do", 0, "a `do` loop returns the value of the expressions after its test" },
  { "display", 0, "`display` prints and has no value" },
  { "displayln", 0, "`displayln` prints and has no value" },
  { "define", 0, "a definition has no value" },
  { "set!", 0, "`set!` has no value" },
};

static const char *why_valueless(const char *at, const char *end) {
  word head = head_of(at, end);
  for (size_t i = 0; i < sizeof valueless / sizeof *valueless; i++) {
    if (!is(head, valueless[i].word)) continue;
    int parts = -1;
    bool has_else = false;
    for (const char *q = head.at; !closes(q, end); q = next_of(q, end), parts++)
      has_else = is(head_of(q, end), "else");
    if ((valueless[i].parts && parts >= valueless[i].parts) || (is(head, "cond") && has_else)) return NULL;
    return valueless[i].why;
  }
  return NULL;
}

typedef struct { word wanted; const char *found; bool procedure; } definition;

static bool match(void *context, const vs_outline_item *item) {
  definition *d = context;
  if (!same((word){ item->name, item->length }, d->wanted)) return true;
  return d->found = item->name, d->procedure = item->procedure, false;
}

/* Returns the last element of the list whose elements begin at `at`. */
static const char *last_from(const char *at, const char *end) {
  const char *last = NULL;
  for (; !closes(at, end); at = next_of(at, end)) last = at;
  return last;
}

/* Returns the expression whose value a procedure returns. at: the text of the procedure, which is a lambda expression
 * or a name that the program defines. */
static const char *value_of(vs_text_place p, const char *at) {
  if (is_among(head_of(at, p.end), "lambda \316\273"))
    return last_from(next_of(next_of(first_of(at, p.end), p.end), p.end), p.end);
  definition d = { .wanted = word_at(at, p.end) };
  if (!d.wanted.n) return NULL;
  vs_outline_each(p.start, (size_t)(p.end - p.start), match, &d);
  if (!d.found || !d.procedure) return NULL;
  const char *behind = next_of(d.found, p.end);
  if (is_among(head_of(behind, p.end), "lambda \316\273"))
    return last_from(next_of(next_of(first_of(behind, p.end), p.end), p.end), p.end);
  while (!closes(behind, p.end)) behind = next_of(behind, p.end);
  return behind < p.end ? last_from(skip_blanks(behind + 1, p.end), p.end) : NULL;
}

bool vs_text_advise_valueless(vs_text_place p, vs_text *t) {
  enum { MOST = 32 };
  const char *open[MOST];
  int count = 0;
  if (!opens(p.at, p.end)) return true;
  for (const char *at = next_of(first_of(p.at, p.end), p.end); !closes(at, p.end) && count < MOST / 2;
       at = next_of(at, p.end))
    open[count++] = at;
  for (int i = 0; i < count; i++) {
    const char *at = open[i], *why = why_valueless(at, p.end);
    if (why) return vs_text_printf(t, "; line %u: %s", line_of(p, at), why);
    word head = head_of(at, p.end);
    if (!head.n || count + 2 > MOST) continue;
    const char *second = next_of(head.at, p.end), *more = NULL;
    if (is_among(head, "map append-map map-division")) more = value_of(p, second);
    else if (is_among(head, "for/list for*/list let let* letrec begin parameterize")) more = last_from(second, p.end);
    else if (is(head, "if")) more = next_of(second, p.end), open[count++] = last_from(second, p.end);
    else if (is_among(head, "list unite append"))
      for (const char *e = second; !closes(e, p.end) && count < MOST; e = next_of(e, p.end)) open[count++] = e;
    else more = value_of(p, head.at);
    if (more && count < MOST) open[count++] = more;
  }
  return true;
}
