/* Computes advice for names that are not defined: numbers with units, words of other programs (foreign.def), a known
 * name with another prefix, similar names. */
#include "vm/front/suggest.h"
#include "vm/front/environment.h"
#include "vm/library/standard.h"
#include "vm/machine/native.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

static const struct { const char *words, *name, *form; } foreign[] = {
#define FOREIGN(words, name, form) {words, name, form},
#define ABSENT(words, instead) {words, NULL, instead},
#define KEYWORD(words, instead)
#include "vm/front/foreign.def"
#undef FOREIGN
#undef ABSENT
#undef KEYWORD
};

static const struct { const char *words, *instead; } keywords[] = {
#define FOREIGN(words, name, form)
#define ABSENT(words, instead)
#define KEYWORD(words, instead) {words, instead},
#include "vm/front/foreign.def"
#undef FOREIGN
#undef ABSENT
#undef KEYWORD
};

/* ---- the distance between two names ---- */

enum { LONGEST = 48, SLIP = 1, EDIT = 2 };

/* Returns true if the two keys are neighbours on a QWERTY keyboard. Each row of keys is half a key further right than
 * the row above. */
static bool neighbours(int a, int b) {
  static const char *const rows[] = {"1234567890-", "qwertyuiop", "asdfghjkl;", "zxcvbnm,./"};
  int at[2][2] = {{-9, -9}, {-99, -99}};
  for (int r = 0; r < 4; r++) {
    const char *x = strchr(rows[r], a), *y = strchr(rows[r], b);
    if (a && x) at[0][0] = r, at[0][1] = (int)(x - rows[r]);
    if (b && y) at[1][0] = r, at[1][1] = (int)(y - rows[r]);
  }
  int down = at[1][0] - at[0][0], right = at[1][1] - at[0][1];
  return (down == 0 && (right == 1 || right == -1)) || (down == 1 && (right == 0 || right == -1)) || (down == -1 &&
      (right == 0 || right == 1));
}

/* Returns the edit distance of two names; upper and lower case count as equal. A typing slip, such as a neighbouring
 * key or two exchanged letters, costs half of an edit. Returns limit + 1 if the distance exceeds limit. */
static int distance(const char *a, size_t n, const char *b, size_t m, int limit) {
  int change = n <= 4 ? EDIT + SLIP : EDIT; /* in a short word, replacing a letter costs more, since the result is often
                                             * another word: set and sec */
  int row[3][LONGEST + 1];
  if (n > LONGEST || m > LONGEST || (int)(n > m ? n - m : m - n) > limit) return limit + 1;
  row[0][0] = 0;
  for (size_t j = 1; j <= m; j++) row[0][j] = row[0][j - 1] + (b[j - 1] == '-' ? SLIP : EDIT);
  for (size_t i = 1; i <= n; i++) {
    int *now = row[i % 3], *up = row[(i - 1) % 3], *up2 = row[(i + 1) % 3];
    int ca = tolower((unsigned char)a[i - 1]), before = i > 1 ? tolower((unsigned char)a[i - 2]) : 0;
    int drop = ca == '-' || ca == before ? SLIP : EDIT, least = now[0] = up[0] + drop;
    for (size_t j = 1; j <= m; j++) {
      int cb = tolower((unsigned char)b[j - 1]), last = j > 1 ? tolower((unsigned char)b[j - 2]) : 0;
      int d = up[j - 1] + (ca == cb                                                        ? 0
                           : neighbours(ca, cb) || ((ca == '_' || ca == '.') && cb == '-') ? SLIP
                                                                                           : change);
      int add = now[j - 1] + (cb == '-' || cb == last ? SLIP : EDIT);
      if (up[j] + drop < d) d = up[j] + drop;
      if (add < d) d = add;
      if (i > 1 && j > 1 && ca == last && cb == before && up2[j - 2] + SLIP < d) d = up2[j - 2] + SLIP;
      now[j] = d;
      if (d < least) least = d;
    }
    if (least > limit + SLIP) return limit + 1;
  }
  return row[n % 3][m];
}

/* Returns the greatest permitted distance for a name of this length: about a third of its letters, or one typing slip
 * if the name is very short. */
static int tolerance(size_t length) { return length <= 2 ? SLIP : length <= 4 ? EDIT : length <= 6 ? EDIT + SLIP
    : length <= 9 ? 2 * EDIT : 3 * EDIT; }

/* ---- prefixes of names ---- */

/* Returns the part of the name after a prefix such as "make-" or "do-", or the whole name if it has no such prefix. */
static const char *stem(const char *name) {
  static const char *const prefixes[] = {"make-", "do-", "create-", "add-", "draw-", "new-", "get-", "build-", "gen-"};
  for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; i++) {
    size_t n = strlen(prefixes[i]);
    if (!strncasecmp(name, prefixes[i], n) && name[n]) return name + n;
  }
  return name;
}

/* Returns the part of the name after a misspelt prefix, as in creat-box, or the whole name if it has no such prefix. */
static const char *near_stem(const char *name) {
  static const char *const words[] = {"make", "create", "draw", "build"};
  size_t n = strcspn(name, "-");
  for (size_t i = 0; n > 2 && name[n] && name[n + 1] && i < sizeof words / sizeof *words; i++)
    if (distance(name, n, words[i], strlen(words[i]), EDIT) <= EDIT) return name + n + 1;
  return name;
}

/* Converts makeBox, MakeBox, make_box and rs.MakeBox to make-box. Returns false if the name is too long. */
static bool plain_name(const char *name, char out[LONGEST + 1]) {
  const char *dot = strrchr(name, '.');
  if (dot && dot > name && dot[1] && isalpha((unsigned char)*name) && isalpha((unsigned char)dot[1])) name = dot + 1;
  size_t n = 0;
  for (const char *c = name; *c; c++) {
    if (n + 2 > LONGEST) return false;
    if (isupper((unsigned char)*c) && c > name && islower((unsigned char)c[-1])) out[n++] = '-';
    out[n++] = (char)(*c == '_' ? '-' : tolower((unsigned char)*c));
  }
  out[n] = 0;
  return true;
}

typedef struct {
  const vs_symbol *wanted, *best;
  int distance;
  bool own;
  vs_value core /* core: environment of the language's library */;
} search;

static bool consider(void *context, vs_value symbol, vs_value binding) {
  search *s = context;
  (void)binding;
  const vs_symbol *name = vs_as_symbol(symbol), *w = s->wanted;
  size_t same = 0; /* same: number of letters with which both names begin, after a common "make-" */
  if (stem(w->name) - w->name == stem(name->name) - name->name) same = (size_t)(stem(w->name) - w->name);
  if (same && strncasecmp(w->name, name->name, same)) same = 0;
  int limit = tolerance(same && name->length > w->length ? name->length - same : w->length - same);
  /* A typing slip at the start of a word is rare, so a smaller distance is permitted there. */
  if (limit > SLIP && tolower((unsigned char)w->name[same]) != tolower((unsigned char)name->name[same])) limit -= SLIP;
  if (limit > s->distance) limit = s->distance;
  int d = distance(w->name, w->length, name->name, name->length, limit);
  bool own = vs_idtable_get(vs_as_environment(s->core)->table, symbol) == VS_VACANT;
  if (d > limit) return true;
  /* Of equally similar names, a name that the program defines is preferred, then the first in alphabetical order. The
   * advice therefore does not depend on the order of a table. */
  if (d == s->distance && s->best && (own != s->own ? s->own : strcmp(name->name, s->best->name) >= 0)) return true;
  s->best = name;
  s->own = own;
  s->distance = d;
  return true;
}

/* A search for a name with the same stem (the name without its prefix) and another prefix. A name with a prefix is
 * preferred, then the first in alphabetical order. */
typedef struct { const char *stem; const vs_symbol *best; } stem_search;

static bool consider_stem(void *context, vs_value symbol, vs_value binding) {
  stem_search *s = context;
  (void)binding;
  const vs_symbol *name = vs_as_symbol(symbol);
  const char *own = stem(name->name);
  if (strcmp(own, s->stem)) return true;
  bool prefixed = own != name->name, before = s->best && stem(s->best->name) != s->best->name;
  if (!s->best || (prefixed && !before) || (prefixed == before && strcmp(name->name, s->best->name) < 0)) s->best =
      name;
  return true;
}

const char *vs_nearest_word(const char *wanted, const char *(*nth)(size_t)) {
  const char *best = NULL;
  size_t length = strlen(wanted);
  int most = tolerance(length), least = most + 1;
  for (size_t i = 0; nth(i); i++) {
    int d = distance(wanted, length, nth(i), strlen(nth(i)), most);
    if (d < least) least = d, best = nth(i);
  }
  return best;
}

static bool has_word(const char *words, const char *word) {
  size_t n = strlen(word);
  for (const char *w = words; n && *w; w += w[0] == ' ') {
    size_t length = strcspn(w, " ");
    if (length == n && !strncasecmp(w, word, n)) return true;
    w += length;
  }
  return false;
}

/* Returns the row of foreign.def (words of other programs) that contains the word, or -1. */
static int foreign_word(const char *name) {
  for (int i = 0; i < (int)(sizeof foreign / sizeof *foreign); i++)
    if (has_word(foreign[i].words, name)) return i;
  return -1;
}

bool vs_keyword_advice(const char *word, vs_text *t) {
  for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++)
    if (has_word(keywords[i].words, word)) return vs_text_puts(t, "; ") && vs_text_puts(t, keywords[i].instead);
  return true;
}

bool vs_is_foreign_name(const char *name) { return foreign_word(name) >= 0; }

bool vs_is_foreign_word(vs_value symbol) {
  return vs_is_symbol(symbol) && foreign_word(vs_as_symbol(symbol)->name) >= 0;
}

static bool remember(vs_scheme *vm, vs_value symbol, vs_value near) {
  VS_ROOTS(vm, r, 1);
  if (!vs_is_vector(vm->at.nearby) && !vs_idtable_new(vm, &vm->at.nearby)) return false;
  r[0] = vm->at.nearby;
  if (!vs_idtable_put(vm, &r[0], symbol, near)) return false;     /* stores the symbol `near`, which does not move in
                                                                   * memory */
  vm->at.nearby = r[0];
  return true;
}

bool vs_suggest_local(vs_scheme *vm, vs_value env, vs_value symbol) {
  if (!vs_is_symbol(symbol) || vs_as_symbol(symbol)->length < 2) return true;
  search s = {.core = vm->at.core, .wanted = vs_as_symbol(symbol), .distance = 3 * EDIT};
  vs_value key, value;
  for (; !vs_is_top(env); env = vs_as_environment(env)->parent)
    for (size_t i = 0; vs_idtable_slot(vs_as_environment(env)->table, i, &key, &value); i++)
      if (key != VS_VACANT && vs_is_symbol(key)) consider(&s, key, value);
  if (!s.best) return true;
  return remember(vm, symbol, vs_from_object(s.best));
}

bool vs_suggest_let_star(vs_scheme *vm, vs_value symbol) { return remember(vm, symbol, symbol); }

/* ---- guessing the intended name ---- */

/* Advises on a multiple of pi that is written as one word: 3pi/4, 0.5pi. */
static bool advise_angle(const char *name, vs_text *t) {
  char text[200];
  size_t n = strspn(name, "+-.0123456789/"), digits = strspn(name, "+-0123456789");
  const char *rest = name + n + (name[n] == '*');
  if (!n || n > 20 || strncasecmp(rest, "pi", 2) || strlen(rest) > 20) return true;
  rest += 2;
  size_t d = *rest == '/' ? strspn(rest + 1, "0123456789") : 0;
  if (rest[0] && (!d || rest[1 + d])) return true;
  if (!d) snprintf(text, sizeof text, "; write (* %.*s pi)", (int)n, name);
  else if (digits == n) snprintf(text, sizeof text, "; write (* %.*s/%s pi)", (int)n, name, rest + 1);
  else snprintf(text, sizeof text, "; write (/ (* %.*s pi) %s)", (int)n, name, rest + 1);
  return vs_text_puts(t, text);
}

/* Advises on a number with a unit, or with a sign that is not ASCII: 3m, 45°, –1. */
static bool advise_number(const char *name, vs_text *t) {
  char number[LONGEST + 1], text[200];
  static const char *const dashes[] = {"\xE2\x80\x93", "\xE2\x80\x94", "\xE2\x88\x92", "\xE2\x80\x90"};
  for (size_t i = 0; i < sizeof dashes / sizeof *dashes; i++)
    if (!strncmp(name, dashes[i], 3)) {
      if (strlen(name) > LONGEST) return true;
      snprintf(text, sizeof text, "; %s is a dash, not a minus sign: write -%s", dashes[i], name + 3);
      return vs_text_puts(t, text);
    }
  size_t n = strspn(name, "+-.0123456789"), digits = strcspn(name, "0123456789");
  if (!n || n > LONGEST || digits >= n || !name[n]) return true;
  memcpy(number, name, n);
  number[n] = 0;
  const char *unit = name + n;
  if (!strcmp(unit, "\xC2\xB0") || !strcasecmp(unit, "deg") || !strcasecmp(unit, "degrees"))
    snprintf(text, sizeof text, "; angles are radians: write (degrees->radians %s)", number);
  else if (!strcasecmp(unit, "rad")) snprintf(text, sizeof text, "; angles are radians already: write %s", number);
  else if (!strcmp(unit, "%")) snprintf(text, sizeof text, "; write (/ %s 100)", number);
  else if (!strcmp(unit, "f") || !strcmp(unit, "d")) snprintf(text, sizeof text, "; write %s", number);
  else {
    static const char *const lengths[] = {"m", "mm", "cm", "dm", "km", "in", "ft", "inch", "\"", "'", "px"};
    size_t i = 0;
    while (i < sizeof lengths / sizeof *lengths && strcmp(unit, lengths[i])) i++;
    if (i == sizeof lengths / sizeof *lengths) return true;
    snprintf(text, sizeof text,
             "; numbers have no units, a length is in model units: write %s; (units 'm), 'mm, 'cm, 'in or 'ft gives "
              "the unit of all numbers",
             number);
  }
  return vs_text_puts(t, text);
}

/* Suggests a spelling for a complex number such as 3+4i, for 1_000 and for 3² (or 3³). */
static bool advise_sign(const char *name, vs_text *t) {
  char text[200], digits[LONGEST + 1];
  size_t n = strlen(name), real = strspn(name, "+-.0123456789e");
  if (n > LONGEST || !n) return true;
  size_t sign = n - 1; /* index of the last sign of "3+4i" */
  while (sign && name[sign] != '+' && name[sign] != '-') sign--;
  if (name[n - 1] == 'i' && real == n - 1 && strpbrk(name, "0123456789")) {
    int from = (int)sign;
    snprintf(text, sizeof text, "; there are no complex numbers here; (xy %.*s %.*s) is a point of the plane",
             from ? from : 1, from ? name : "0", (int)(n - 1 - sign - (name[sign] == '+')),
             name + sign + (name[sign] == '+'));
    return vs_text_puts(t, text);
  }
  bool squared = n > 2 && !strcmp(name + n - 2, "\xC2\xB2"), cubed = n > 2 && !strcmp(name + n - 2, "\xC2\xB3");
  if (squared || cubed) {
    snprintf(text, sizeof text, "; write (expt %.*s %d)", (int)(n - 2), name, squared ? 2 : 3);
    return vs_text_puts(t, text);
  }
  size_t left = strspn(name, "0123456789"), right = name[left] == ':' ? strspn(name + left + 1, "0123456789") : 0;
  if (left && right && left + 1 + right == n && left < 9 && right < 9) {
    snprintf(text, sizeof text, "; (range %.*s %d) counts from %.*s to %s", (int)left, name, atoi(name + left + 1) + 1,
             (int)left, name, name + left + 1);
    return vs_text_puts(t, text);
  }
  size_t number = strspn(name, "-.0123456789e"), points = 0;
  for (const char *c = name; *c; c++) points += *c == '.';
  if (!strncasecmp(name, "0x", 2) && n > 2 && strspn(name + 2, "0123456789abcdefABCDEF") == n - 2)
    return vs_text_puts(t, "; a number in hexadecimal digits is written #x") && vs_text_puts(t, name + 2);
  if (number == n && strpbrk(name, "0123456789") && (points > 1 || name[n - 1] == 'e'))
    return vs_text_puts(t, "; a number has one point, 1.25, and perhaps a power of ten, 1e6");
  if (*name == '-' && isalpha((unsigned char)name[1]))
    return vs_text_puts(t, "; write (- ") && vs_text_puts(t, name + 1) && vs_text_puts(t, ")");
  size_t used = 0;
  if (strspn(name, "0123456789_.") < n || !strchr(name, '_') || *name == '_') return true;
  for (const char *c = name; *c; c++)
    if (*c != '_') digits[used++] = *c;
  digits[used] = 0;
  return vs_text_puts(t, "; digits are written without signs between them: ") && vs_text_puts(t, digits);
}

/* Advises on operators that other languages write next to their operand: i++, !x, and the marks of OpenSCAD. */
static bool advise_beside(const char *name, vs_text *t) {
  char text[200];
  size_t n = strlen(name);
  if (n < 2 || n > LONGEST) return true;
  bool more = !strcmp(name + n - 2, "++"), less = !strcmp(name + n - 2, "--");
  *text = 0;
  if (n > 2 && (more || less))
    snprintf(text, sizeof text, "; write (set! %.*s (%c %.*s 1))", (int)n - 2, name, more ? '+' : '-', (int)n - 2,
             name);
  else if (*name == '!' && name[1] != '=') snprintf(text, sizeof text, "; write (not %s)", name + 1);
  else if (*name == '%' && foreign_word(name + 1) >= 0)
    snprintf(text, sizeof text, "; (ghost object) shows an object as %% does in OpenSCAD");
  return vs_text_puts(t, text);
}

/* Advises on a method call as other languages write it: points.length. */
static bool advise_method(vs_scheme *vm, const char *name, vs_text *t) {
  static const char *const modules[] = {"math", "np", "numpy", "random", "rs", "rg", "os", "sys", "json", "console",
                                        "cq", "gh", "string", "plt", "js", NULL};
  char module[LONGEST + 1];
  const char *dot = strchr(name, '.');
  size_t n = dot ? (size_t)(dot - name) : 0;
  if (!n || n > LONGEST || !islower((unsigned char)*name) || !isalpha((unsigned char)dot[1]) || strchr(dot + 1, '.'))
    return true;
  memcpy(module, name, n);
  module[n] = 0;
  for (size_t i = 0; modules[i]; i++)
    if (!strcmp(modules[i], module)) return true;
  int i = foreign_word(dot + 1);
  vs_value symbol;
  if (!vs_intern(vm, dot + 1, strlen(dot + 1), &symbol)) return false;
  if (i < 0 && vs_idtable_get(vs_as_environment(vm->at.core)->table, symbol) == VS_VACANT)
    return vs_text_puts(t,
                        "; no value has parts behind a point: (object-arguments object), (cx p), (hash-ref table key) "
                        "and the like give them");
  const char *procedure = i >= 0 && foreign[i].name && foreign[i].name[0] ? foreign[i].name : dot + 1;
  return vs_text_puts(t, "; the procedure comes first: (") && vs_text_puts(t, procedure) && vs_text_puts(t, " ") &&
         vs_text_puts(t, module) &&
         vs_text_puts(t, !strcmp(dot + 1, "length") || !strcmp(dot + 1, "size") ? ")" : " ...)");
}

/* Advises on keywords as other languages write them (azimuth: or :azimuth), and on file names without quotes. */
static bool advise_spelling(const char *name, vs_text *t) {
  static const char *const endings[] = {"vs",   "js",  "gml", "stl", "obj",  "off", "ply", "png", "jpg", "jpeg",
                                        "exr",  "hdr", "csv", "json", "mtl", "ies", "txt", "ttf", "otf"};
  size_t n = strlen(name);
  const char *dot = strrchr(name, '.'), *word = name;
  bool last = n > 1 && name[n - 1] == ':' && isalpha((unsigned char)*name);
  if (last || (*name == ':' && isalpha((unsigned char)name[1]))) {
    if (last) n--;
    else word++, n--;
    return vs_text_puts(t, "; a keyword is written #:") && vs_text_put(t, word, n);
  }
  for (size_t i = 0; dot > name && i < sizeof endings / sizeof *endings; i++)
    if (!strcasecmp(dot + 1, endings[i]))
      return vs_text_puts(t, "; the name of a file is a text: \"") && vs_text_puts(t, name) && vs_text_puts(t, "\"");
  return true;
}

static bool put_foreign(int i, vs_text *t) {
  if (!foreign[i].name) return vs_text_puts(t, "; there is no such thing here yet: ") && vs_text_puts(t,
      foreign[i].form);
  if (!foreign[i].name[0]) return vs_text_puts(t, "; write ") && vs_text_puts(t, foreign[i].form);
  return vs_text_puts(t, "; ") && vs_text_puts(t, foreign[i].name) && vs_text_puts(t, " is the name here: ") &&
      vs_text_puts(t, foreign[i].form);
}

static bool did_you_mean(const vs_symbol *name, vs_text *t) {
  if (name->length && name->name[name->length - 1] == '?')
    return vs_text_puts(t, "; perhaps ") && vs_text_put(t, name->name, name->length);
  return vs_text_puts(t, "; did you mean ") && vs_text_put(t, name->name, name->length) && vs_text_puts(t, "?");
}

bool vs_foreign_advice(const char *word, vs_text *t) {
  int i = foreign_word(word);
  return i < 0 || put_foreign(i, t);
}

bool vs_suggest(vs_scheme *vm, vs_value env, vs_value symbol, vs_text *t) {
  if (!vs_is_symbol(symbol)) return true;
  const vs_symbol *wanted = vs_as_symbol(symbol);
  vs_value local = vs_is_vector(vm->at.nearby) ? vs_idtable_get(vm->at.nearby, symbol) : VS_VACANT;
  if (local == symbol)
    return vs_text_puts(t, " here: let names it for its body alone; write let* where a value that follows uses it");
  size_t before = t->count;
  /* ours: whether the language's library has the name, so that the program only lacks an import */
  bool ours = vs_idtable_get(vs_as_environment(vm->at.core)->table, symbol) != VS_VACANT;
  int i = ours ? -1 : foreign_word(wanted->name);
  if (i >= 0) return put_foreign(i, t);
  if (!advise_angle(wanted->name, t)) return false;
  if (t->count == before && !advise_number(wanted->name, t)) return false;
  if (t->count == before && !advise_spelling(wanted->name, t)) return false;
  if (t->count == before && !advise_sign(wanted->name, t)) return false;
  if (t->count == before && !advise_beside(wanted->name, t)) return false;
  if (t->count == before && !advise_method(vm, wanted->name, t)) return false;
  if (t->count > before) return true;
  size_t sign = strcspn(wanted->name, "+*/<>=");          /* an expression without blanks, which is read as one name:
                                                           * i+1, n*2, a<b */
  const char *name = wanted->name;
  if (sign && sign + 1 < wanted->length && (name[sign + 1] == '=' ? sign + 2 < wanted->length : true) &&
      isalnum((unsigned char)name[sign - 1])) {
    size_t width = name[sign + 1] == '=' ? 2 : 1;
    if (isalnum((unsigned char)name[sign + width]) &&
        strcspn(name + sign + width, "+*/<>=") == wanted->length - sign - width)
      return vs_text_puts(t, "; it is one name; write (") && vs_text_put(t, name + sign, width) &&
             vs_text_puts(t, " ") && vs_text_put(t, name, sign) && vs_text_puts(t, " ") &&
             vs_text_puts(t, name + sign + width) && vs_text_puts(t, ")") &&
             (width > 1 || name[sign] != '=' || !isalpha((unsigned char)*name) ||
              (vs_text_puts(t, " to compare; a keyword is written #:") && vs_text_put(t, name, sign) &&
               vs_text_puts(t, " ") && vs_text_puts(t, name + sign + 1)));
  }
  if (!vs_library_advice(vm, symbol, false, t)) return false;
  if (t->count > before || !vs_is(env, VS_T_ENVIRONMENT) || wanted->length < 2) return true;
  char plain[LONGEST + 1];
  if (plain_name(name, plain)) {
    stem_search same = {.stem = stem(plain)};
    if (strlen(same.stem) > 1) vs_environment_each(env, consider_stem, &same);
    if (!same.best && same.stem == plain && *(same.stem = near_stem(plain)) && same.stem != plain)
      vs_environment_each(env, consider_stem, &same);
    if (same.best) return did_you_mean(same.best, t);
    if ((i = foreign_word(plain)) >= 0 || (i = foreign_word(same.stem)) >= 0) return put_foreign(i, t);
  }
  search s = {.core = vm->at.core, .wanted = wanted, .distance = 3 * EDIT};
  if (local != VS_VACANT) {                       /* of equally similar names, a local name is preferred */
    consider(&s, local, VS_FALSE);
    if (s.best) s.distance--;
  }
  vs_environment_each(env, consider, &s);
  return !s.best || did_you_mean(s.best, t);
}
