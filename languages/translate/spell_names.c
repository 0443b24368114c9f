/* Chooses names for the program's variables in the target: valid words, each with a single meaning in its scope. */
#include "languages/translate/spell_names.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/translate/words.h"
#include "model/store/array.h"

enum { MOST_NAME = 100 };

static const struct { const char *character, *word; } characters[] = {
#define NAME_CHARACTER(character, word) {character, word},
#include "languages/translate/name_characters.def"
};

typedef struct { char text[MOST_NAME + 20]; size_t length; bool gap; } spelling;

static void append(spelling *s, const char *text, size_t length) {
  if (s->length + length + 1 >= MOST_NAME) return;
  if (s->gap && s->length) s->text[s->length++] = '_';
  s->gap = false;
  memcpy(s->text + s->length, text, length);
  s->text[s->length += length] = 0;
}

/* Copies the letters and digits of a name. Replaces all other characters by words between underscores. */
static void spell(const char *text, spelling *s) {
  *s = (spelling){.length = 0};
  while (*text) {
    if ((unsigned char)*text < 0x80 && isalnum((unsigned char)*text)) {
      append(s, text++, 1);
      continue;
    }
    size_t best = 0, row = 0, bytes = 1;
    for (size_t i = 0; i < sizeof characters / sizeof *characters; i++) {
      size_t n = strlen(characters[i].character);
      if (n > best && !strncmp(text, characters[i].character, n)) best = n, row = i;
    }
    s->gap = true;
    if (best) {
      const char *word = characters[row].word;
      /* a letter with an accent is part of the word around it */
      bool letter = (unsigned char)*text == 0xC3;
      if (letter) s->gap = false;
      if (*word) append(s, word, strlen(word));
      s->gap = !letter;
      text += best;
      continue;
    }
    uint32_t code = (unsigned char)*text;
    if (code >= 0xC0) {
      bytes = code >= 0xF0 ? 4 : code >= 0xE0 ? 3 : 2;
      code &= 0xFFu >> (bytes + 1);
      for (size_t i = 1; i < bytes && text[i]; i++) code = code << 6 | ((unsigned char)text[i] & 63);
    }
    char hex[16];
    int n = snprintf(hex, sizeof hex, "u%X", code);
    append(s, hex, (size_t)n);
    s->gap = true;
    for (size_t i = 0; i < bytes && *text; i++) text++;
  }
  if (!s->length) append(s, "it", 2);
  if (isdigit((unsigned char)*s->text)) {
    memmove(s->text + 1, s->text, s->length + 1);
    s->text[0] = 'n';
    s->length++;
  }
}

static bool is_reserved(const tr_target *target, const char *name) {
  size_t length = strlen(name);
  for (const char *at = target->reserved; (at = strstr(at, name)) != NULL; at += length)
    if (at > target->reserved && at[-1] == ' ' && at[length] == ' ') return true;
  for (size_t i = 0; tr_helper_name(target, i); i++)
    if (!strcmp(tr_helper_name(target, i), name)) return true;
  return false;
}

typedef struct { translation *t; uint8_t *taken; size_t room; } namer;

/* Marks top-level names by number. Returns false on failure. */
static bool mark(namer *n, know_index name, bool set) {
  size_t had = n->room;
  if (!VS_GROW(n->taken, n->room, (size_t)name + 1))
    return know_fail(n->t->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  if (n->room > had) memset(n->taken + had, 0, n->room - had);
  if (set) n->taken[name] = 1;
  return n->taken[name] != 0;
}

/* Returns true if a variable with this name in the target is visible at the definition or parameter. */
static bool in_sight(const translation *t, tr_index define, const char *name) {
  for (tr_index up = t->nodes[define].parent; up && up != t->root; up = t->nodes[up].parent) {
    tr_node_kind kind = (tr_node_kind)t->nodes[up].kind;
    if (kind != TR_BODY && kind != TR_PROCEDURE && kind != TR_MAP) continue;
    for (tr_index i = t->nodes[up].first; i; i = t->nodes[i].next) {
      if (t->nodes[i].kind != TR_DEFINE && t->nodes[i].kind != TR_PARAMETER) continue;
      const char *other = t->variables[t->nodes[i].variable].name;
      if (i != define && other && !strcmp(other, name)) return true;
    }
  }
  return false;
}

static void give_name(namer *n, tr_index v, bool top) {
  translation *t = n->t;
  tr_variable *y = &t->variables[v];
  spelling s;
  spell(y->text, &s);
  if (t->target->capitals) *s.text = (char)toupper((unsigned char)*s.text);
  if (is_reserved(t->target, s.text)) s.text[s.length++] = '_', s.text[s.length] = 0;
  size_t base = s.length;
  for (unsigned count = 2; !*t->k->trouble; count++) {
    know_index name = know_name_of(t->k, s.text, s.length, 0, 0);
    if (name && !mark(n, name, false) && !*t->k->trouble && (top || !in_sight(t, y->define, s.text))) {
      if (top) mark(n, name, true);
      y->name = t->k->names[name].text;
      return;
    }
    int more = snprintf(s.text + base, sizeof s.text - base, "%s%u", s.text[base - 1] == '_' ? "" : "_", count);
    s.length = base + (size_t)more;
  }
}

bool tr_spell_names(translation *t) {
  namer n = {.t = t};
  for (int top = 1; top >= 0; top--)
    for (tr_index i = 1; i < t->node_count && !*t->k->trouble; i++) {
      if (t->nodes[i].kind != TR_DEFINE && t->nodes[i].kind != TR_PARAMETER) continue;
      tr_variable *v = &t->variables[t->nodes[i].variable];
      bool is_top = v->global || v->lifted;
      if (v->name || is_top != (top == 1)) continue;
      v->define = v->define ? v->define : i;
      give_name(&n, t->nodes[i].variable, is_top);
    }
  free(n.taken);
  return !*t->k->trouble;
}
