/* Contains the arrays of an analysis, and the queries that need only these. */
#include "languages/analysis/analysis.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

struct know_memory { struct know_memory *next; size_t used, room; };
enum { CHUNK = 1 << 16 };

bool know_fail(knowledge *k, const know_place *place, vs_outcome outcome, const char *format, ...) {
  if (*k->trouble) return false;
  char text[300];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  if (place) snprintf(k->trouble, sizeof k->trouble, "%s:%u:%u: %s", k->files[place->file].path, place->line,
      place->column, text);
  else snprintf(k->trouble, sizeof k->trouble, "%s", text);
  k->outcome = outcome;
  return false;
}

static bool no_memory(knowledge *k) { return know_fail(k, NULL, VS_OUTCOME_MACHINE, "out of memory"); }

void *know_alloc(knowledge *k, size_t bytes) {
  bytes = (bytes + 15) & ~(size_t)15;
  struct know_memory *m = k->memory;
  if (!m || m->room - m->used < bytes) {
    size_t room = bytes > CHUNK ? bytes : CHUNK, none = 0;
    char *fresh = NULL;
    if (!vs_room_grow(&fresh, &none, sizeof *m + 16 + room, 1)) return no_memory(k), NULL;
    m = (struct know_memory *)(void *)fresh;
    *m = (struct know_memory){k->memory, 0, room};
    k->memory = m;
  }
  char *at = (char *)m + ((sizeof *m + 15) & ~(size_t)15) + m->used;
  m->used += bytes;
  return memset(at, 0, bytes);
}

const char *know_text(knowledge *k, const char *text, size_t length) {
  char *copy = know_alloc(k, length + 1);
  if (!copy) return "";
  memcpy(copy, text, length);
  return copy;
}

#define NEW(k, array, index)                                                          \
  if (!VS_GROW((k)->array##s, (k)->array##_room, (k)->array##_count + 1)) return no_memory(k), 0; \
  memset(&(k)->array##s[(k)->array##_count], 0, sizeof *(k)->array##s);             \
  know_index index = (know_index)(k)->array##_count++

know_index know_node_new(knowledge *k, know_kind kind) {
  if (k->node_count >= KNOW_MOST_NODES) return know_fail(k, NULL, VS_OUTCOME_MODEL,
      "the program has too many parts to be analysed"), 0;
  NEW(k, node, i);
  k->nodes[i].kind = (uint8_t)kind;
  return i;
}

know_index know_scope_new(knowledge *k, know_index parent, know_scope_kind kind, know_index node) {
  NEW(k, scope, i);
  k->scopes[i] = (know_scope){.parent = parent, .kind = (uint8_t)kind, .node = node,
    .procedure = kind == KNOW_SCOPE_PROCEDURE ? i : parent ? k->scopes[parent].procedure : 0};
  return i;
}

/* ---- names ---- */

static uint32_t hash_of(const char *text, size_t length, know_index base, know_index scope) {
  uint32_t h = 2166136261u ^ base * 2654435761u ^ scope * 40503u;
  for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)text[i]) * 16777619u;
  return h ^ h >> 15;
}

static bool table_grow(knowledge *k, know_index **table, size_t *slots, size_t count,
    uint32_t (*hash)(const knowledge *, know_index)) {
  if (2 * (count + 1) < *slots) return true;
  size_t more = *slots ? 2 * *slots : 1024, none = 0;
  know_index *fresh = NULL;
  if (!vs_room_grow(&fresh, &none, more, sizeof *fresh)) return no_memory(k);
  memset(fresh, 0, more * sizeof *fresh);
  for (size_t i = 0; i < *slots; i++) {
    if (!(*table)[i]) continue;
    size_t at = hash(k, (*table)[i]) & (more - 1);
    while (fresh[at]) at = (at + 1) & (more - 1);
    fresh[at] = (*table)[i];
  }
  free(*table);
  *table = fresh, *slots = more;
  return true;
}

static uint32_t name_hash(const knowledge *k, know_index i) { return k->names[i].hash; }

know_index know_name_of(knowledge *k, const char *text, size_t length, know_index base, know_index scope) {
  if (!table_grow(k, &k->name_table, &k->name_slots, k->name_count, name_hash)) return 0;
  uint32_t h = hash_of(text, length, base, scope);
  size_t at = h & (k->name_slots - 1);
  for (; k->name_table[at]; at = (at + 1) & (k->name_slots - 1)) {
    const know_name *n = &k->names[k->name_table[at]];
    if (n->hash == h && n->base == base && n->scope == scope && strlen(n->text) == length && !memcmp(n->text, text,
        length))
      return k->name_table[at];
  }
  const char *copy = base ? k->names[base].text : know_text(k, text, length);
  NEW(k, name, i);
  k->names[i] = (know_name){copy, base, scope, h};
  k->name_table[at] = i;
  return i;
}

static uint32_t pair_hash(know_index scope, know_index name) {
  uint32_t h = scope * 2654435761u ^ name * 2246822519u;
  return h ^ h >> 15;
}
static uint32_t symbol_hash(const knowledge *k, know_index i) { return pair_hash(k->symbols[i].scope,
    k->symbols[i].name); }

know_index know_bound_in(const knowledge *k, know_index scope, know_index name) {
  if (!k->binding_slots) return 0;
  for (size_t at = pair_hash(scope, name) & (k->binding_slots - 1); k->binding_table[at];
      at = (at + 1) & (k->binding_slots - 1)) {
    const know_symbol *s = &k->symbols[k->binding_table[at]];
    if (s->scope == scope && s->name == name) return k->binding_table[at];
  }
  return 0;
}

know_index know_symbol_new(knowledge *k, know_index scope, know_index name, know_symbol_kind kind) {
  if (!table_grow(k, &k->binding_table, &k->binding_slots, k->binding_count, symbol_hash)) return 0;
  NEW(k, symbol, i);
  k->symbols[i] = (know_symbol){.text = k->names[name].text, .name = name, .scope = scope, .kind = (uint8_t)kind,
    .next_in_scope = k->scopes[scope].first_symbol, .call = "", .keywords = "", .doc = ""};
  k->scopes[scope].first_symbol = i;
  size_t at = pair_hash(scope, name) & (k->binding_slots - 1);
  while (k->binding_table[at]) at = (at + 1) & (k->binding_slots - 1);
  k->binding_table[at] = i;
  k->binding_count++;
  return i;
}

static know_index new_use(knowledge *k) {
  NEW(k, use, i);
  return i;
}

void know_use_add(knowledge *k, know_index symbol, know_index node, know_role role, bool called) {
  know_index i = new_use(k);
  if (!i) return;
  k->uses[i] = (know_use){symbol, node, 0, (uint8_t)role, called};
  know_symbol *s = &k->symbols[symbol];
  if (s->last_use) k->uses[s->last_use].next = i;
  else s->first_use = i;
  s->last_use = i;
  s->definitions += role == KNOW_DEFINITION;
  s->reads += role == KNOW_REFERENCE || role == KNOW_OPAQUE;
  s->sets += role == KNOW_ASSIGNMENT;
  s->calls += called;
}

void know_hear(knowledge *k, const vs_diagnostic *d) {
  bool warning = d->severity == VS_SEVERITY_WARNING;
  if ((*k->heard && (warning || !k->heard_warning)) || d->severity == VS_SEVERITY_NOTE) return;
  snprintf(k->heard, sizeof k->heard, "%s", d->message);
  k->heard_line = d->at.line, k->heard_column = d->at.column, k->heard_warning = warning;
}

/* ---- queries of nodes and symbols ---- */

know_index know_nth(const knowledge *k, know_index list, uint32_t nth) {
  know_index i = list ? k->nodes[list].first : 0;
  while (i && nth--) i = k->nodes[i].next;
  return i;
}

bool know_is(const knowledge *k, know_index node, const char *word) {
  const know_node *n = know_at(k, node);
  if (!node || (n->kind != KNOW_SYMBOL && n->kind != KNOW_KEYWORD)) return false;
  const char *text = k->names[n->name].text;
  /* in a script (JavaScript), the node's word is compared without its prefix js: */
  return !strcmp(k->script && !strncmp(text, "js:", 3) ? text + 3 : text, word);
}

const char *know_spelling(const knowledge *k, know_index node, size_t *length) {
  const know_place *at = &know_at(k, node)->at;
  *length = at->to - at->from;
  return k->files[at->file].text + at->from;
}

const char *know_scope_word(know_scope_kind kind) {
  static const char *const words[] = {"language", "program", "procedure", "let", "loop", "body", "syntax"};
  return words[kind];
}
const char *know_symbol_word(know_symbol_kind kind) {
  static const char *const words[] = {"variable", "function", "parameter", "model-parameter", "local", "loop-variable",
      "loop",
    "field", "rule", "macro", "builtin"};
  return words[kind];
}
const char *know_role_word(know_role role) {
  static const char *const words[] = {"expression", "datum", "syntax", "definition", "reference", "assignment",
      "unbound", "opaque"};
  return words[role];
}
const char *know_kind_word(know_kind kind) {
  static const char *const words[] = {"list", "vector", "symbol", "keyword", "number", "string", "character",
      "boolean", "other"};
  return words[kind];
}

/* ---- the analysis ---- */

bool know_open(knowledge *k) {
  /* element 0 of each array is unused, because index 0 means that there is no element */
  know_index none = know_node_new(k, KNOW_OTHER);
  none |= know_name_of(k, "", 0, 0, 0);
  k->name_table[0] = 0;
  none |= know_scope_new(k, 0, KNOW_SCOPE_LANGUAGE, 0) | new_use(k);
  if (!*k->trouble && VS_GROW(k->symbols, k->symbol_room, 1)) memset(&k->symbols[k->symbol_count++], 0,
      sizeof *k->symbols);
  if (!*k->trouble && VS_GROW(k->comments, k->comment_room, 1)) memset(&k->comments[k->comment_count++], 0,
      sizeof *k->comments);
  if (*k->trouble || none || !k->symbol_count || !k->comment_count) return no_memory(k);
  return true;
}

void know_free(knowledge *k) {
  for (size_t i = 0; i < k->file_count; i++) free((char *)(uintptr_t)k->files[i].text);
  free(k->nodes);
  free(k->names);
  free(k->scopes);
  free(k->symbols);
  free(k->uses);
  free(k->comments);
  free(k->files);
  free(k->name_table);
  free(k->binding_table);
  while (k->memory) {
    struct know_memory *next = k->memory->next;
    free(k->memory);
    k->memory = next;
  }
  *k = (knowledge){0};
}
