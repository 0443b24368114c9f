/* Implements the arrays of a script's tree. */
#include "languages/javascript/script.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool vs_script_fail(vs_script *s, vs_script_place at, const char *format, ...) {
  if (*s->trouble || s->no_memory) return false;
  va_list list;
  va_start(list, format);
  vsnprintf(s->trouble, sizeof s->trouble, format, list);
  va_end(list);
  s->trouble_at = at;
  return false;
}

/* Grows an array to at least `count` items of `size` bytes. array: address of the pointer to the array. */
bool vs_script_room(vs_script *s, void *array, size_t *room, size_t count, size_t size) {
  if (count <= *room) return true;
  size_t more = *room ? *room : 64;
  while (more < count) more *= 2;
  void *at;
  memcpy(&at, array, sizeof at);
  void *fresh = more < SIZE_MAX / size ? s->resize(s->context, at, *room * size, more * size) : NULL;
  if (!fresh) return s->no_memory = true, false;
  memcpy(array, &fresh, sizeof fresh);
  *room = more;
  return true;
}

static void drop(vs_script *s, void *at, size_t used) {
  if (at) s->resize(s->context, at, used, 0);
}

void vs_script_close(vs_script *s) {
  drop(s, s->nodes, s->node_room * sizeof *s->nodes);
  drop(s, s->names, s->name_room * sizeof *s->names);
  drop(s, s->name_table, s->name_slots * sizeof *s->name_table);
  drop(s, s->texts, s->text_room);
  drop(s, s->comments, s->comment_room * sizeof *s->comments);
  s->nodes = NULL, s->names = NULL, s->name_table = NULL, s->texts = NULL, s->comments = NULL;
}

uint32_t vs_script_node_new(vs_script *s, vs_script_kind kind, vs_script_place at) {
  if (s->node_count >= UINT32_MAX - 1 ||
      !vs_script_room(s, &s->nodes, &s->node_room, s->node_count + 1, sizeof *s->nodes))
    return 0;
  s->nodes[s->node_count] = (vs_script_node){ .kind = (uint8_t)kind, .height = 1, .at = at };
  return (uint32_t)s->node_count++;
}

static bool table_grow(vs_script *s) {
  if (2 * (s->name_count + 1) < s->name_slots) return true;
  size_t more = s->name_slots ? 2 * s->name_slots : 256;
  uint32_t *fresh = s->resize(s->context, NULL, 0, more * sizeof *fresh);
  if (!fresh) return s->no_memory = true, false;
  memset(fresh, 0, more * sizeof *fresh);
  for (size_t i = 0; i < s->name_slots; i++) {
    if (!s->name_table[i]) continue;
    size_t at = s->names[s->name_table[i]].hash & (more - 1);
    while (fresh[at]) at = (at + 1) & (more - 1);
    fresh[at] = s->name_table[i];
  }
  drop(s, s->name_table, s->name_slots * sizeof *s->name_table);
  s->name_table = fresh, s->name_slots = more;
  return true;
}

bool vs_script_text(vs_script *s, const char *text, size_t length) {
  if (!vs_script_room(s, &s->texts, &s->text_room, s->text_count + length + 1, 1)) return false;
  memcpy(s->texts + s->text_count, text, length);
  s->text_count += length;
  return true;
}

static uint32_t hash_of(const char *text, size_t length) {
  uint32_t h = 2166136261u;
  for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)text[i]) * 16777619u;
  return h ^ h >> 15;
}

uint32_t vs_script_name_known(const vs_script *s, const char *text, size_t length) {
  uint32_t h = hash_of(text, length);
  if (!s->name_slots) return 0;
  for (size_t at = h & (s->name_slots - 1); s->name_table[at]; at = (at + 1) & (s->name_slots - 1)) {
    const vs_script_name *n = &s->names[s->name_table[at]];
    if (n->hash == h && n->length == length && !memcmp(s->texts + n->text, text, length)) return s->name_table[at];
  }
  return 0;
}

uint32_t vs_script_name_of(vs_script *s, const char *text, size_t length) {
  uint32_t known = vs_script_name_known(s, text, length), h = hash_of(text, length);
  if (known || !table_grow(s)) return known;
  if (!s->name_count) s->name_count = 1; /* index 0 means that there is no name */
  if (!vs_script_room(s, &s->names, &s->name_room, s->name_count + 1, sizeof *s->names)) return 0;
  uint32_t start = (uint32_t)s->text_count;
  if (!vs_script_text(s, text, length)) return 0;
  size_t at = h & (s->name_slots - 1);
  while (s->name_table[at]) at = (at + 1) & (s->name_slots - 1);
  s->names[s->name_count] = (vs_script_name){ start, (uint32_t)length, h };
  s->name_table[at] = (uint32_t)s->name_count;
  return (uint32_t)s->name_count++;
}

const char *vs_script_spelling(const vs_script *s, uint32_t name, size_t *length) {
  *length = s->names[name].length;
  return s->texts + s->names[name].text;
}

bool vs_script_is(const vs_script *s, uint32_t name, const char *word) {
  size_t n;
  if (!name) return false;
  const char *text = vs_script_spelling(s, name, &n);
  return n == strlen(word) && !memcmp(text, word, n);
}

const char *vs_script_kind_word(vs_script_kind kind) {
  static const char *const words[] = {
#define VS_SCRIPT_NODE(name, holds) #name,
#include "languages/javascript/script_nodes.def"
#undef VS_SCRIPT_NODE
  };
  return words[kind];
}

const char *vs_script_operator_word(vs_script_operator op) {
  static const char *const words[] = {
#define VS_SCRIPT_OPERATOR(name, text, binds) text,
#include "languages/javascript/script_operators.def"
#undef VS_SCRIPT_OPERATOR
  };
  return words[op];
}
