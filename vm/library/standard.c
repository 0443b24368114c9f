/* Implements the built-in libraries of libraries.def, such as (scheme base) and (srfi 1). Each is an environment with
 * some cells and macros of the complete library, created when it is first used. (visualscheme) is the complete library
 * itself. */
#include "vm/library/standard.h"

#include "vm/front/source.h"
#include "vm/library/library.h"
#include "vm/front/suggest.h"
#include "vm/front/environment.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"
#include "vm/values/text.h"

#include <stdio.h>

static const struct { const char *name, *exports; } libraries[] = {
#define VS_LIBRARY(name, exports) {name, exports},
#define VS_LIBRARY_ALIAS(second, number)
#include "vm/library/libraries.def"
#undef VS_LIBRARY
#undef VS_LIBRARY_ALIAS
};
enum { LIBRARIES = sizeof libraries / sizeof *libraries };

static const struct { const char *second; int number; } aliases[] = {
#define VS_LIBRARY(name, exports)
#define VS_LIBRARY_ALIAS(second, number) {second, number},
#include "vm/library/libraries.def"
#undef VS_LIBRARY
#undef VS_LIBRARY_ALIAS
};

/* ---- names of libraries ---- */
static bool starts(const char *s, const char *with) { return !strncmp(s, with, strlen(with)); }

/* Returns the row in libraries.def of the library with this name, or -1. Accepts (scheme base), (srfi 1), (srfi 1
 * lists), (srfi :1 lists), and srfi/1 of PLT Scheme. */
static int row_of(vs_value name) {
  char text[64];
  if (vs_is_symbol(name)) {
    const char *s = vs_as_symbol(name)->name;
    if (!starts(s, "srfi/")) return -1;
    snprintf(text, sizeof text, "srfi %.20s", s + 5);
  } else {
    if (!vs_is_pair(name) || !vs_is_symbol(vs_car(name)) || !vs_is_pair(vs_cdr(name))) return -1;
    const char *first = vs_as_symbol(vs_car(name))->name;
    vs_value second = vs_car(vs_cdr(name)), rest = vs_cdr(vs_cdr(name));
    bool srfi = !strcmp(first, "srfi");
    if (!srfi && rest != VS_NIL) return -1;
    if (vs_is_fixnum(second)) snprintf(text, sizeof text, "%.20s %lld", first, (long long)vs_fixnum(second));
    else if (!vs_is_symbol(second)) return -1;
    else
      snprintf(text, sizeof text, "%.20s %.40s", first,
               vs_as_symbol(second)->name + (srfi && *vs_as_symbol(second)->name == ':'));
  }
  for (int i = 0; i < LIBRARIES; i++) if (!strcmp(text, libraries[i].name)) return i;
  return -1;
}

/* Returns true if `name` means the complete library: (visualscheme), or the name of a language in PLT Scheme that the
 * library replaces. */
static bool is_whole(vs_value name) {
  if (vs_is_pair(name))
    return vs_is_symbol(vs_car(name)) && !strcmp(vs_as_symbol(vs_car(name))->name, "visualscheme") &&
           vs_cdr(name) == VS_NIL;
  if (!vs_is_symbol(name)) return false;
  const char *s = vs_as_symbol(name)->name;
  return !strcmp(s, "visualscheme") || !strcmp(s, "scheme") || !strcmp(s, "racket") || starts(s, "scheme/") ||
         starts(s, "racket/") || starts(s, "mzlib/");
}

bool vs_library_own_name(vs_scheme *vm, vs_value name, vs_value *out) {
  *out = name;
  if (vs_list_length(name) != 2 || !vs_is_symbol(vs_car(name)) || !vs_is_symbol(vs_car(vs_cdr(name)))) return true;
  if (strcmp(vs_as_symbol(vs_car(name))->name, "scheme") != 0) return true;
  const char *second = vs_as_symbol(vs_car(vs_cdr(name)))->name;
  for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++) {
    if (strcmp(second, aliases[i].second) != 0) continue;
    VS_ROOTS(vm, r, 2);
    return vs_intern_c(vm, "srfi", &r[0]) && vs_cons(vm, vs_fix(aliases[i].number), VS_NIL, &r[1]) &&
           vs_cons(vm, r[0], r[1], out);
  }
  return true;
}

/* Returns the next word of the list of exports at *s, and sets *length. At the end of the list, *length is 0. *inside:
 * the name that the word has inside the library. */
static const char *next_word(const char **s, size_t *length, const char **inside, size_t *inside_length) {
  const char *word = *s + strspn(*s, " "), *end = word + strcspn(word, " "),
             *equals = word;
  *s = end;
  *length = *inside_length = (size_t)(end - word);
  *inside = word;
  while (equals < end && !starts(equals, "=%")) equals++;       /* the name itself may contain =, as fx<=? does */
  if (equals > word && equals < end) {
    *length = (size_t)(equals - word);
    *inside = equals + 1;
    *inside_length = (size_t)(end - *inside);
  }
  return word;
}

/* ---- environments of libraries ---- */
static bool fill(vs_scheme *vm, vs_value env, const char *exports) {
  VS_ROOTS(vm, r, 3);
  r[0] = env;
  size_t n, m;
  for (const char *inside, *word; word = next_word(&exports, &n, &inside, &m), n;) {
    if (!vs_intern(vm, word, n, &r[1]) || !vs_intern(vm, inside, m, &r[2])) return false;
    vs_value binding = vs_idtable_get(vs_as_environment(vm->at.core)->table, r[2]);
    if (binding == VS_VACANT) return vs_fail(vm, vm->sym.internal, "the library has no %s", vs_as_symbol(r[2])->name);
    if (!vs_environment_bind(vm, r[0], r[1], binding)) return false;
  }
  return true;
}

bool vs_library_built_in(vs_scheme *vm, vs_value name, vs_value *env) {
  *env = VS_FALSE;
  if (is_whole(name)) { *env = vm->at.core; return true; }
  int row = row_of(name);
  if (row < 0) return true;
  VS_ROOTS(vm, r, 3);
  /* Searches for the short name of the library, such as (srfi 1), among the libraries that were already created. */
  if (!vs_intern_c(vm, libraries[row].name, &r[0])) return false;
  for (vs_value l = vm->at.libraries; vs_is_pair(l); l = vs_cdr(l))
    if (vs_car(vs_car(l)) == r[0]) { *env = vs_cdr(vs_car(l)); return true; }
  if (!vs_environment_new(vm, r[0], &r[1]) || !fill(vm, r[1], libraries[row].exports) ||
      !vs_library_register(vm, r[0], r[1]))
    return false;
  *env = r[1];
  return true;
}

bool vs_library_is_built_in(vs_value name) { return is_whole(name) || row_of(name) >= 0; }

/* ---- finding the libraries that export a name ---- */

/* Returns true if the library with the text from `at` to `end` has the name in its (export ...). Skips comments. */
static bool exports_name(const char *at, const char *end, const vs_symbol *name) {
  static const char form[] = "(export";
  while (at < end && !((size_t)(end - at) > sizeof form && !memcmp(at, form, sizeof form - 1))) {
    if (*at == ';') while (at < end && *at != '\n') at++;
    at++;
  }
  int depth = 0;
  while (at < end) {
    if (*at == ';') {
      while (at < end && *at != '\n') at++;
    } else if (*at == '(') {
      depth++, at++;
    } else if (*at == ')') {
      if (--depth == 0) return false;
      at++;
    } else if (*at == ' ' || *at == '\n') {
      at++;
    } else {
      const char *word = at;
      while (at < end && !strchr(" \n();", *at)) at++;
      if ((size_t)(at - word) == name->length && !memcmp(word, name->name, name->length)) return true;
    }
  }
  return false;
}

/* Returns true if the file f, which the program vs contains, defines the name as syntax: (define-syntax name ...). */
static bool defines_syntax(const vs_shipped *f, const vs_symbol *name) {
  static const char form[] = "(define-syntax ";
  size_t head = sizeof form - 1, whole = head + name->length + 1;
  for (const char *at = f->text; (size_t)(f->end - at) >= whole; at++) {
    at = memchr(at, '(', (size_t)(f->end - at) - whole + 1);
    if (!at) break;
    bool named = !memcmp(at, form, head) && !memcmp(at + head, name->name, name->length);
    if (named && strchr(" \n(", at[whole - 1])) return true;
  }
  return false;
}

/* Returns true if a shipped library, one that the program vs contains, defines the name as syntax. `library` is the
 * file that exports the name; the files that it includes are in the folder of the same name. */
static bool exports_syntax(vs_scheme *vm, const vs_shipped *library, const vs_symbol *name) {
  size_t stem = (size_t)(strstr(library->name, ".sld") - library->name);
  for (const vs_shipped *part = vm->config.shipped; part->name; part++)
    if (!strncmp(part->name, library->name, stem) && strchr("./", part->name[stem]) && defines_syntax(part, name))
      return true;
  return false;
}

/* Writes the name of a library from that of its file: (srfi 115) for "srfi/115.sld". */
static bool put_shipped_name(const char *file, vs_text *t) {
  size_t n = strcspn(file, "."), part = strcspn(file, "/");
  return part >= n ? vs_text_put(t, file, n) :
      vs_text_put(t, file, part) && vs_text_puts(t, " ") && vs_text_put(t, file + part + 1, n - part - 1);
}
bool vs_library_advice(vs_scheme *vm, vs_value symbol, bool syntax, vs_text *t) {
  if (!vs_is_symbol(symbol)) return true;
  const vs_symbol *name = vs_as_symbol(symbol);
  for (int i = 0; !syntax && i < LIBRARIES; i++) {
    const char *exports = libraries[i].exports, *inside, *word;
    if (strstr(libraries[i].name, " core")) continue;  /* only shipped libraries import these */
    for (size_t n, m; word = next_word(&exports, &n, &inside, &m), n;)
      if (n == name->length && !memcmp(word, name->name, n))
        return vs_text_puts(t, "; (import (") && vs_text_puts(t, libraries[i].name) &&
               vs_text_puts(t, ")) brings it, (import (visualscheme)) the whole language");
  }
  bool ours = name->name[0] != '%' && vs_idtable_get(vs_as_environment(vm->at.core)->table, symbol) != VS_VACANT;
  for (const vs_shipped *f = vm->config.shipped; !ours && f && f->name; f++)
    /* skips the runtime library of JavaScript, whose names a Scheme program never intends */
    if (strstr(f->name, ".sld") && !strstr(f->name, "javascript") && exports_name(f->text, f->end, name) &&
        (!syntax || exports_syntax(vm, f, name)))
      return vs_text_puts(t, "; (import (visualscheme) (") && put_shipped_name(f->name, t) &&
             vs_text_puts(t, ")) brings it");
  if (!ours) return true;
  return vs_text_puts(t, "; (import (visualscheme)) brings it");
}

bool vs_library_each_srfi(vs_scheme *vm, bool (*each)(vs_scheme *vm, void *context, int number), void *context) {
  for (int i = 0; i < LIBRARIES; i++) {
    int number;
    if (sscanf(libraries[i].name, "srfi %d", &number) == 1 && !each(vm, context, number)) return false;
  }
  for (const vs_shipped *s = vm->config.shipped; s && s->name; s++) {
    int number, end = 0;
    if (sscanf(s->name, "srfi/%d.sld%n", &number, &end) == 1 && end && !each(vm, context, number)) return false;
  }
  return true;
}
