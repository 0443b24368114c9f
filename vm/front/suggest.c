/* Owns the advice for names that are not defined: words of other languages (foreign.def) and near names. */
#include "vm/machine/program.h"
#include "vm/machine/native.h"

#include <ctype.h>
#include <strings.h>

static const struct { const char *word, *name, *form; } foreign[] = {
#define FOREIGN(word, name, form) {word, name, form},
#include "vm/front/foreign.def"
#undef FOREIGN
};

enum { LONGEST = 48 };

/* Edit distance ignoring case, a swap of neighbours counting one; more than `limit` is limit + 1. */
static int distance(const char *a, size_t n, const char *b, size_t m, int limit) {
  int row[3][LONGEST + 1];
  if (n > LONGEST || m > LONGEST || (n > m ? n - m : m - n) > (size_t)limit) return limit + 1;
  for (size_t j = 0; j <= m; j++) row[0][j] = (int)j;
  for (size_t i = 1; i <= n; i++) {
    int *now = row[i % 3], *up = row[(i - 1) % 3], *up2 = row[(i + 1) % 3], least = now[0] = (int)i;
    for (size_t j = 1; j <= m; j++) {
      int ca = tolower((unsigned char)a[i - 1]), cb = tolower((unsigned char)b[j - 1]);
      int d = up[j - 1] + (ca != cb);
      if (up[j] + 1 < d) d = up[j] + 1;
      if (now[j - 1] + 1 < d) d = now[j - 1] + 1;
      if (i > 1 && j > 1 && ca == tolower((unsigned char)b[j - 2]) && cb == tolower((unsigned char)a[i - 2]) && up2[j - 2] + 1 < d) d = up2[j - 2] + 1;
      now[j] = d;
      if (d < least) least = d;
    }
    if (least > limit) return limit + 1;
  }
  return row[n % 3][m];
}

typedef struct { const vs_symbol *wanted, *best; int distance; bool own; vs_value core /* environment of the library */; } search;

static bool consider(void *context, vs_value symbol, vs_value binding) {
  search *s = context;
  (void)binding;
  const vs_symbol *name = vs_as_symbol(symbol);
  int d = distance(s->wanted->name, s->wanted->length, name->name, name->length, s->distance);
  bool own = vs_idtable_get(vs_as_environment(s->core)->table, symbol) == VS_VACANT;
  if (d > s->distance) return true;
  /* ties: the program's names go first; then the name that sorts first, so that the advice does not depend on the order of a table */
  if (d == s->distance && s->best && (own != s->own ? s->own : strcmp(name->name, s->best->name) >= 0)) return true;
  s->best = name;
  s->own = own;
  s->distance = d;
  return true;
}

static int tolerance(size_t length) { return length <= 3 ? 1 : length <= 7 ? 2 : 3; }

const char *vs_nearest_word(const char *wanted, const char *(*nth)(size_t)) {
  const char *best = NULL;
  size_t length = strlen(wanted);
  int least = tolerance(length) + 1;
  for (size_t i = 0; nth(i); i++) {
    int d = distance(wanted, length, nth(i), strlen(nth(i)), least);
    if (d < least) least = d, best = nth(i);
  }
  return best;
}

static int foreign_word(const char *name) {
  for (int i = 0; i < (int)(sizeof foreign / sizeof *foreign); i++)
    if (!strcasecmp(foreign[i].word, name)) return i;
  return -1;
}

bool vs_is_foreign_word(vs_value symbol) { return vs_is_symbol(symbol) && foreign_word(vs_as_symbol(symbol)->name) >= 0; }

static bool remember(vs *vm, vs_value symbol, vs_value near) {
  VS_ROOTS(vm, r, 1);
  if (!vs_is_vector(vm->at.nearby) && !vs_idtable_new(vm, &vm->at.nearby)) return false;
  r[0] = vm->at.nearby;
  if (!vs_idtable_put(vm, &r[0], symbol, near)) return false;     /* symbols do not move */
  vm->at.nearby = r[0];
  return true;
}

bool vs_suggest_local(vs *vm, vs_value env, vs_value symbol) {
  if (!vs_is_symbol(symbol) || vs_as_symbol(symbol)->length < 2) return true;
  search s = {.core = vm->at.core, .wanted = vs_as_symbol(symbol), .distance = tolerance(vs_as_symbol(symbol)->length)};
  vs_value key, value;
  for (; !vs_is_top(env); env = vs_as_environment(env)->parent)
    for (size_t i = 0; vs_idtable_slot(vs_as_environment(env)->table, i, &key, &value); i++)
      if (key != VS_VACANT && vs_is_symbol(key)) consider(&s, key, value);
  if (!s.best) return true;
  return remember(vm, symbol, vs_from_object(s.best));
}

bool vs_suggest_let_star(vs *vm, vs_value symbol) { return remember(vm, symbol, symbol); }

bool vs_suggest(vs *vm, vs_value env, vs_value symbol, vs_text *t) {
  if (!vs_is_symbol(symbol)) return true;
  const vs_symbol *wanted = vs_as_symbol(symbol);
  vs_value local = vs_is_vector(vm->at.nearby) ? vs_idtable_get(vm->at.nearby, symbol) : VS_VACANT;
  if (local == symbol) return vs_text_puts(t, " here: let names it for its body alone; write let* where a value that follows uses it");
  int i = foreign_word(wanted->name);
  if (i >= 0)
    return foreign[i].name[0] ? vs_text_puts(t, "; ") && vs_text_puts(t, foreign[i].name) && vs_text_puts(t, " is the name here: ") && vs_text_puts(t, foreign[i].form)
                              : vs_text_puts(t, "; write ") && vs_text_puts(t, foreign[i].form);
  size_t sign = strcspn(wanted->name, "+*/<>=");          /* i+1, n*2, a<b: one name, because no blanks are in it */
  const char *name = wanted->name;
  if (sign && sign + 1 < wanted->length && (name[sign + 1] == '=' ? sign + 2 < wanted->length : true) && isalnum((unsigned char)name[sign - 1])) {
    size_t width = name[sign + 1] == '=' ? 2 : 1;
    if (isalnum((unsigned char)name[sign + width]) && strcspn(name + sign + width, "+*/<>=") == wanted->length - sign - width)
      return vs_text_puts(t, "; it is one name; write (") && vs_text_put(t, name + sign, width) && vs_text_puts(t, " ") && vs_text_put(t, name, sign) &&
             vs_text_puts(t, " ") && vs_text_puts(t, name + sign + width) && vs_text_puts(t, ")");
  }
  size_t before = t->count;
  if (!vs_library_advice(vm, symbol, t)) return false;
  if (t->count > before || !vs_is(env, VS_T_ENVIRONMENT) || wanted->length < 2) return true;
  search s = {.core = vm->at.core, .wanted = wanted, .distance = tolerance(wanted->length)};
  if (local != VS_VACANT) {                       /* nearer by than what is only as like */
    consider(&s, local, VS_FALSE);
    s.distance--;
  }
  vs_environment_each(env, consider, &s);
  return !s.best || (vs_text_puts(t, "; did you mean ") && vs_text_put(t, s.best->name, s.best->length) && vs_text_puts(t, "?"));
}
