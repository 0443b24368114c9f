/* Contains the tables of words: for each name of the language, its equivalent in each target language. */
#include "languages/translate/words.h"

#include <string.h>

#include "languages/translate/value_kinds.h"

typedef struct { const char *name, *arguments, *result, *keys, *texts[3]; } row;
static const row rows[] = {
#define TR_WORD(name, arguments, result, keys, openscad, javascript, povray) \
  {name, arguments, result, keys, {openscad, javascript, povray}},
#define TR_NONE(names)
#include "languages/translate/translated_words.def"
};
enum { ROWS = sizeof rows / sizeof *rows };

tr_word tr_word_row(const tr_target *target, uint16_t at) {
  const row *r = &rows[at - 1];
  return (tr_word){r->name, r->arguments, r->result, r->keys, r->texts[target->column]};
}

uint16_t tr_word_next(const char *name, uint16_t at) {
  for (uint16_t i = at; i < ROWS; i++)
    if (!strcmp(rows[i].name, name)) return (uint16_t)(i + 1);
  return 0;
}

char tr_word_letter(const char *arguments, uint32_t nth) {
  for (uint32_t i = 0; *arguments; arguments++) {
    bool again = arguments[1] == '*';
    if (i == nth || again) return *arguments;
    i++;
  }
  return 0;
}

static bool enough(const char *arguments, uint32_t count) {
  uint32_t least = 0;
  for (const char *a = arguments; *a; a++)
    if (a[1] != '*' && *a != '*') least++;
  return count >= least;
}

static bool takes_key(const char *keys, const char *key) {
  size_t length = strlen(key);
  for (const char *at = keys; (at = strstr(at, key)) != NULL; at += length)
    if ((at == keys || at[-1] == ' ') && (at[length] == '=' || !at[length] || at[length] == ' ')) return true;
  return false;
}

static bool fits(const translation *t, tr_index primitive, const row *r) {
  uint32_t n = 0;
  if (!strcmp(r->arguments, "=")) return t->nodes[primitive].count == 0;
  for (tr_index i = t->nodes[primitive].first; i; i = t->nodes[i].next) {
    if (t->nodes[i].kind == TR_KEYWORD) {
      if (!takes_key(r->keys, t->nodes[i].text)) return false;
      continue;
    }
    char letter = tr_word_letter(r->arguments, n++);
    if (!letter || !tr_kind_fits(t, i, letter)) return false;
  }
  return enough(r->arguments, n);
}

uint16_t tr_word_find(const translation *t, tr_index primitive, uint16_t at) {
  while ((at = tr_word_next(t->nodes[primitive].text, at)) != 0)
    if (rows[at - 1].texts[t->target->column] && fits(t, primitive, &rows[at - 1])) return at;
  return 0;
}

int tr_word_arguments(const tr_target *target, const char *name) {
  for (uint16_t at = 0; (at = tr_word_next(name, at)) != 0;) {
    const row *r = &rows[at - 1];
    if (!r->texts[target->column]) continue;
    if (!strcmp(r->arguments, "=")) return -1;
    int count = 0;
    for (const char *a = r->arguments; *a; a++)
      if (*a != '*') count++;
    return count == 1 && strchr(r->arguments, '*') ? 2 : count;
  }
  return -1;
}

/* ---- helpers ---- */

static const struct { const char *target, *name, *text; } helpers[] = {
#define TR_HELPER(target, name, text) {#target, #name, text},
#include "languages/targets/openscad_helpers.def"
#define TR_HELPER(target, name, text) {#target, #name, text},
#include "languages/targets/javascript_helpers.def"
#define TR_HELPER(target, name, text) {#target, #name, text},
#include "languages/targets/povray_helpers.def"
};
enum { HELPERS = sizeof helpers / sizeof *helpers };

static size_t helper(const tr_target *target, size_t nth) {
  for (size_t i = 0; i < HELPERS; i++)
    if (!strcmp(helpers[i].target, target->name) && !nth--) return i;
  return HELPERS;
}
const char *tr_helper_name(const tr_target *target, size_t nth) {
  size_t i = helper(target, nth);
  return i < HELPERS ? helpers[i].name : NULL;
}
const char *tr_helper_text(const tr_target *target, size_t nth) {
  size_t i = helper(target, nth);
  return i < HELPERS ? helpers[i].text : NULL;
}
