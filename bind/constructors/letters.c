/* Implements text: chooses the font, creates objects of letters, and creates native text for a target program. */

#include <stdio.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/origins.h"
#include "bind/warnings.h"
#include "geometry/text/typeset.h"
#include "vm/front/source.h"
#include "vm/library/port.h"
#include "vm/machine/activation.h"

/* Reads a font file through the host. Its name is relative to the folder of the program's file. */
static vs_status font_file(vs_args *f, const vs_arg *font, const char **out) {
  vs_scheme *vm = f->vm;
  vs_text path;
  vs_error e = { 0 };
  VS_ROOTS(vm, r, 1);
  vs_text_open(vm, &path, 0);
  bool ok = vs_source_path(vm, font->value, vs_pos_file(vs_call_place(vm)), &path) && vs_text_end(&path);
  if (ok && !(*out = vs_store_text(f->store, path.at, path.count))) ok = vs_fail_memory(vm);
  if (ok && !vs_font_known(f->store, *out)) {
    ok = vs_io_read_file(vm, *out, &r[0]);
    if (ok && !vs_font_add(f->store, *out, vs_as_bytes(r[0])->at, (size_t)vs_as_bytes(r[0])->length, &e))
      ok = vs_bind_error(f->vm, &e);
  }
  vs_text_close(&path);
  return ok ? VS_OK : VS_ERROR;
}

static vs_status font_of(vs_args *f, const vs_arg *font, const char **out) {
  vs_error e = { 0 };
  if (font->given && vs_font_is_path(font->text.at)) return font_file(f, font, out);
  *out = vs_store_text(f->store, font->given ? font->text.at : "", font->given ? font->text.length : 0);
  if (!*out) return vs_fail_memory(f->vm);
  return vs_font_get(f->store, *out, &e) ? VS_OK : vs_bind_error(f->vm, &e);
}

/* Returns the element of `words` that equals argument a, or the first element if a is absent. If none equals a, sets
 * the error and returns NULL. */
static const char *word_of(vs_args *f, const char *param, const vs_arg *a, const char *const *words,
                           const char *expected) {
  if (!a->given) return words[0];
  for (; *words; words++)
    if (!strcmp(*words, a->text.at)) return *words;
  vs_bind_refuse(f, param, expected, a->value);
  return NULL;
}

/* Replaces the spelling "centre" of *word by "center", and interns the word in the store, as nodes require. */
static bool kept_word(vs_args *f, const char **word) {
  if (!strcmp(*word, "centre")) *word = "center";
  *word = vs_store_text(f->store, *word, strlen(*word));
  return *word || vs_fail_memory(f->vm);
}

static void tell_missing(vs_args *f, uint32_t c) {
  char shown[8] = { 0 };
  if (c < 0x80) shown[0] = (char)c;
  else if (c < 0x800) shown[0] = (char)(0xC0 | c >> 6), shown[1] = (char)(0x80 | (c & 63));
  else if (c < 0x10000)
    shown[0] = (char)(0xE0 | c >> 12), shown[1] = (char)(0x80 | (c >> 6 & 63)), shown[2] = (char)(0x80 | (c & 63));
  else
    shown[0] = (char)(0xF0 | c >> 18), shown[1] = (char)(0x80 | (c >> 12 & 63)),
    shown[2] = (char)(0x80 | (c >> 6 & 63)), shown[3] = (char)(0x80 | (c & 63));
  vs_bind_warn(f->bind, "glyph",
               "make-text: the font has no letter %s (U+%04X): it is shown as the font's sign for that", shown,
               (unsigned)c);
}

vs_status vs_p_make_text(vs_args *f, vs_value *out) {
  static const char *const aligns[] = { "left", "center", "centre", "right", NULL };
  static const char *const valigns[] = { "baseline", "top", "center", "centre", "bottom", NULL };
  struct vs_letters t = { .p = f->arg[0].point,
                          .size = f->arg[1].real,
                          .spacing = f->key[3].given ? f->key[3].real : 1 };
  vs_error e = { 0 };
  vs_text_plan plan;
  t.string = vs_store_text(f->store, f->arg[2].text.at, f->arg[2].text.length);
  if (!t.string) return vs_fail_memory(f->vm);
  t.align = word_of(f, "align", &f->key[1], aligns, "one of 'left 'center 'right");
  if (!t.align || !kept_word(f, &t.align)) return VS_ERROR;
  t.valign = word_of(f, "valign", &f->key[2], valigns, "one of 'baseline 'top 'center 'bottom");
  if (!t.valign || !kept_word(f, &t.valign)) return VS_ERROR;
  if (!font_of(f, &f->key[0], &t.font)) return VS_ERROR;
  if (t.size == 0) return vs_bind_empty(f, "the size is 0", out);
  if (!vs_text_lay(f->store, &t, &plan, &e)) return vs_bind_error(f->vm, &e);
  bool ink = plan.count > 0;
  if (plan.missing) tell_missing(f, plan.missing);
  vs_text_plan_free(&plan);
  if (!ink) return vs_bind_empty(f, "the text has no letters", out);
  return vs_bind_make(f, VS_TEXT, &t, NULL, 0, out);
}

vs_status vs_p_text_width(vs_args *f, vs_value *out) {
  struct vs_letters t = {
    .size = f->arg[0].real, .align = "left", .valign = "baseline", .spacing = f->key[1].given ? f->key[1].real : 1
  };
  vs_error e = { 0 };
  vs_text_plan plan;
  t.string = vs_store_text(f->store, f->arg[1].text.at, f->arg[1].text.length);
  if (!t.string) return vs_fail_memory(f->vm);
  if (!font_of(f, &f->key[0], &t.font)) return VS_ERROR;
  if (!vs_text_lay(f->store, &t, &plan, &e)) return vs_bind_error(f->vm, &e);
  double width = plan.width;
  vs_text_plan_free(&plan);
  return vs_bind_give_real(f, width, out);
}

/* ---- native: text that the user writes for a target program. Its braces, strings and comments must be closed, so that
 * they do not affect the text around it ---- */

typedef struct { const char *name, *comment; bool directives; } native_target;
static const native_target targets[] = {
#define VS_TARGET(id, name, comment, directives) { name, comment, directives },
#include "model/targets.def"
};

enum { DEPTH_MAX = 256 };

/* Returns true if the directive `word`, which follows a #, must be closed by an #end. */
static bool opens(const char *word, size_t length) {
  static const char *const words[] = { "if", "ifdef", "ifndef", "while", "for", "switch", "macro" };
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (strlen(words[i]) == length && !memcmp(words[i], word, length)) return true;
  return false;
}

static size_t word_length(const char *at) {
  size_t n = 0;
  while ((at[n] >= 'a' && at[n] <= 'z') || (at[n] >= 'A' && at[n] <= 'Z') || at[n] == '_') n++;
  return n;
}

/* Returns a fault of the text, such as an open brace, in words for a message, or NULL if there is none. */
static const char *trouble(const native_target *t, const char *text) {
  char open[DEPTH_MAX];
  size_t depth = 0, directives = 0, comment = strlen(t->comment);
  for (const char *at = text; *at; at++) {
    if (!strncmp(at, t->comment, comment)) {
      while (at[1] && at[1] != '\n') at++;
      if (!at[1]) return "whose last line is no comment";
    } else if (at[0] == '/' && at[1] == '*') {
      const char *end = strstr(at + 2, "*/");
      if (!end) return "whose comments end";
      at = end + 1;
    } else if (at[0] == '*' && at[1] == '/') {
      return "whose comments begin";
    } else if (*at == '"') {
      for (at++; *at && *at != '"'; at++)
        if (*at == '\\' && at[1]) at++;
      if (!*at) return "whose strings end";
    } else if (strchr("({[", *at)) {
      if (depth == DEPTH_MAX) return "whose brackets nest less deeply";
      open[depth++] = *at;
    } else if (strchr(")}]", *at)) {
      char want = *at == ')' ? '(' : *at == '}' ? '{' : '[';
      if (!depth || open[--depth] != want) return "whose brackets match";
    } else if (t->directives && *at == '#') {
      const char *word = at + 1;
      while (*word == ' ') word++;
      size_t length = word_length(word);
      if (length == 3 && !memcmp(word, "end", 3)) {
        if (!directives) return "whose #if and #end match";
        directives--;
      } else {
        directives += opens(word, length);
      }
    }
  }
  return depth ? "whose brackets match" : directives ? "whose #if and #end match" : NULL;
}

vs_status vs_p_native(vs_args *f, vs_value *out) {
  vs_store *s = f->store;
  const native_target *target = NULL;
  for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
    if (!strcmp(targets[i].name, f->arg[0].text.at)) target = &targets[i];
  if (!target) return vs_bind_refuse(f, "target", "one of 'povray 'openscad", f->arg[0].value);
  const char *bad = strlen(f->arg[1].text.at) != f->arg[1].text.length ? "without NUL characters"
                                                                       : trouble(target, f->arg[1].text.at);
  if (bad) {
    char expected[80];
    snprintf(expected, sizeof expected, "text for %s %s", target->name, bad);
    return vs_bind_refuse(f, "text", expected, f->arg[1].value);
  }
  struct vs_native d = { vs_store_text(s, target->name, strlen(target->name)),
                         vs_store_text(s, f->arg[1].text.at, f->arg[1].text.length), 0 };
  if (!d.target || !d.code) return vs_fail_memory(f->vm);
  vs_ref child =
      f->key[0].given ? f->key[0].ref : (vs_ref){ vs_node_new(s, VS_EMPTY, NULL, NULL, 0), vs_bind_origin(f->bind) };
  if (!f->key[0].given && !vs_bind_keep(f, child.node)) return VS_ERROR;
  return vs_bind_make(f, VS_NATIVE, &d, &child, 1, out);
}
