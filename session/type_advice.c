/* Implements the advice for a value that a procedure does not accept. The table advice.def contains the advice. */
#include "session/type_advice.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bind/call/take.h"
#include "bind/objects.h"
#include "bind/records.h"
#include "vm/machine/fail.h"
#include "vm/numbers/number.h"
#include "vm/values/printer.h"

enum { SHOWN = 60 /* greatest length in bytes of a value's text in the advice */ };

/* Kinds of values, as bits, in the rows of advice.def. A value may have several kinds: an empty list is EMPTY and
 * LIST. */
enum {
  NUMBER = 1,
  WHOLE = 2, /* real number without a fractional part, such as 1.0 */
  FRACTION = 4, TEXT = 8,
  NUMBER_TEXT = 16, /* text that contains a number, such as "3" */
  SYMBOL = 32, LIST = 64,
  PAIR = 128, /* pair that is no proper list, such as (1 2 . 3) */
  EMPTY = 256, VECTOR = 512, POINT = 1024, GVECTOR = 2048, OBJECT = 4096,
  NEGATIVE = 8192, FALSE = 16384, ANY = 32768
};

typedef struct { const char *procedures; int kind; const char *words, *advice; } row;

static const row rows[] = {
#define ADVICE(procedures, kind, words, advice) { procedures, kind, words, advice },
#include "session/advice.def"
#undef ADVICE
};

static bool is_number_text(vs_scheme *vm, vs_value v) {
  vs_text t;
  vs_text_open(vm, &t, 100);
  bool number = vs_text_string(&t, v) && vs_text_end(&t) && t.count && strspn(t.at, "0123456789.-+") == t.count &&
                strpbrk(t.at, "0123456789");
  vs_text_close(&t);
  return number;
}

static int kinds_of(vs_scheme *vm, vs_value v) {
  double number;
  if (vs_is_string(v)) return ANY | TEXT | (is_number_text(vm, v) ? NUMBER_TEXT : 0);
  if (vs_is_symbol(v)) return ANY | SYMBOL;
  if (v == VS_FALSE) return ANY | FALSE;
  if (v == VS_NIL) return ANY | EMPTY | LIST;
  if (vs_is_pair(v)) return ANY | (vs_list_length(v) < 0 ? PAIR : LIST);
  if (vs_is_vector(v)) return ANY | VECTOR;
  if (vs_is_flat(v, VS_FLAT_POINT)) return ANY | POINT;
  if (vs_is_flat(v, VS_FLAT_VECTOR)) return ANY | GVECTOR;
  if (vs_is_double(v))
    return ANY | NUMBER | (vs_double(v) < 0 ? NEGATIVE : 0) |
           (!isfinite(vs_double(v))               ? 0
            : vs_double(v) == floor(vs_double(v)) ? WHOLE
                                                  : FRACTION);
  if (vs_bind_take_number(vm, v, &number))
    return ANY | NUMBER | (number < 0 ? NEGATIVE : 0) | (vs_is_fixnum(v) ? 0 : FRACTION);
  return ANY | (vs_bind_take_ref(v).node ? OBJECT : 0);
}

/* Returns the kinds of a value of which only the text in the error message is known, as in errors of procedures written
 * in Scheme. */
static int kinds_of_text(const char *shown) {
  size_t digits = strspn(shown, "0123456789.-+/");
  if (*shown == '"')
    return ANY | TEXT | (strspn(shown + 1, "0123456789.-+") == strcspn(shown + 1, "\"") ? NUMBER_TEXT : 0);
  if (!strncmp(shown, "#(", 2)) return ANY | VECTOR;
  if (!strncmp(shown, "(xyz ", 5)) return ANY | POINT;
  if (!strncmp(shown, "(vxyz ", 6)) return ANY | GVECTOR;
  if (!strncmp(shown, "(make-", 6) || !strncmp(shown, "(do-", 4)) return ANY | OBJECT;
  if (*shown == '(') return ANY | LIST | (shown[1] == ')' ? EMPTY : 0);
  if (digits && digits == strlen(shown)) return ANY | NUMBER | (*shown == '-' ? NEGATIVE : 0);
  if (!strcmp(shown, "#f")) return ANY | FALSE;
  return ANY | (*shown != '#' ? SYMBOL : 0);
}

static bool is_word_of(const char *words, const char *word, size_t n) {
  for (const char *w = words; *w; w += *w == ' ') {
    size_t length = strcspn(w, " ");
    if (length == n && !memcmp(w, word, n)) return true;
    w += length;
  }
  return !*words;
}

/* Writes the value v. If `text` is not NULL, the value itself is unknown, and `text` is its form in the error. */
static bool put_value(vs_scheme *vm, vs_value v, const char *text, vs_print_mode how, vs_text *t) {
  vs_text shown;
  bool bare = text && *text == '"' && how == VS_PRINT_DISPLAY;
  if (text) return vs_text_put(t, text + bare, strlen(text) - (bare && strlen(text) > 1 ? 2 : 0));
  vs_text_open(vm, &shown, SHOWN);
  bool ok = vs_print(vm, v, how, &shown) && vs_text_put(t, shown.at ? shown.at : "", shown.count) &&
            (!shown.cut || vs_text_puts(t, "..."));
  vs_text_close(&shown);
  return ok;
}

/* Writes the advice. %f becomes the name of the procedure, the part of the error before the first colon; %v and %t
 * become texts of the value. */
static bool put_advice(vs_scheme *vm, const char *advice, vs_value got, const char *text, size_t name, vs_text *t) {
  char procedure[80];
  memcpy(procedure, t->at, name);
  procedure[name] = 0;
  if (!vs_text_puts(t, "; ")) return false;
  for (const char *c = advice; *c; c++) {
    bool mark = *c == '%' && (c[1] == 'f' || c[1] == 'v' || c[1] == 't');
    bool ok = !mark          ? vs_text_put(t, c, 1)
              : c[1] == 'f' ? vs_text_puts(t, procedure)
                            : put_value(vm, got, text, c[1] == 'v' ? VS_PRINT_WRITE : VS_PRINT_DISPLAY, t);
    if (!ok) return false;
    c += mark;
  }
  return true;
}

/* Finds the kind of value that the error requires, such as "a point". Sets *kind to the kind's place in the error, and
 * returns its length. Returns 0 if the text there is neither the noun of a contract nor a type of the language. */
static size_t wanted_kind(const char *error, const char **kind) {
  static const char *const nouns[] = {
#define VS_CONTRACT(name, noun, condition, convert) noun,
#include "bind/call/contracts.def"
#undef VS_CONTRACT
    "a list", "a vector", "a procedure", "an integer", "a surface", "a solid or a surface",
  };
  const char *must = strstr(error, " must be "), *expected = strstr(error, "expected ");
  const char *place = strstr(error + 2, ": "); /* an error "NAME: FILE:LINE: ..." is about the text of a file */
  if (place && place < (must ? must : expected ? expected : error)) return 0;
  *kind = must ? must + 9 : expected ? expected + 9 : error;
  const char *end = strstr(*kind, ", got");
  size_t n = end ? (size_t)(end - *kind) : 0;
  for (size_t i = 0; n && i < sizeof nouns / sizeof *nouns; i++)
    if (strlen(nouns[i]) == n && !memcmp(nouns[i], *kind, n)) return n;
  return 0;
}

/* Returns true if the row's words occur in the error. If the row applies to any procedure, the words must occur in the
 * kind of value that the error requires. */
static bool fits(const char *error, const row *r) {
  const char *found = strstr(error, r->words), *kind;
  if (!found || *r->procedures || strstr(r->words, "literal") || strstr(r->words, "got")) return found != NULL;
  size_t n = wanted_kind(error, &kind);
  bool whole = *r->words == 'a' || *r->words == '#'; /* row words that begin with `a` or `#` must be at the start of the
                                                      * required kind */
  found = n ? strstr(kind, r->words) : NULL;
  return found && (whole ? found == kind : found < kind + n) && !strstr(error, "; call the lambda") &&
         !strstr(error, "; call it: ");
}

bool vs_session_advise_value(vs_scheme *vm, const vs_condition *c, vs_text *t) {
  if (!vs_text_end(t) || !t->at) return true;
  VS_ROOTS(vm, r, 1);
  r[0] = vs_is_pair(c->irritants) ? vs_car(c->irritants) : VS_UNSPECIFIC;
  const char *colon = strstr(t->at, ": ");
  size_t name = colon ? (size_t)(colon - t->at) : 0;
  if (!name || name > 60 || strpbrk(t->at, " (") < colon) return true;
  const char *got = vs_is_pair(c->irritants) ? NULL : strstr(t->at, ", got ");
  char text[SHOWN + 1] = "";
  if (got) snprintf(text, sizeof text, "%s", got + 6);
  int kinds = got ? kinds_of_text(text) : kinds_of(vm, r[0]);
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    if ((rows[i].kind & kinds) && is_word_of(rows[i].procedures, t->at, name) && fits(colon, &rows[i]))
      return put_advice(vm, rows[i].advice, r[0], got ? text : NULL, name, t);
  return true;
}
