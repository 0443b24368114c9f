/* Owns `native`: text of the user's that a target program gets as it is. To make sure that it cannot swallow or end
 * what stands round it, its braces, strings and comments must be whole. */
#include "bind/build.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/objects.h"

#include <stdio.h>

typedef struct { const char *name, *comment; bool directives; } native_target;
static const native_target targets[] = {
#define VS_TARGET(id, name, comment, directives) { name, comment, directives },
#include "model/targets.def"
};

enum { DEPTH_MAX = 256 };

/* Words behind a # that ask for an #end; NULL ends them. */
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

/* NULL: the text is whole; else what is wrong with it. */
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
