/* Answers with the meaning of each word of a text, for an editor's colours. The protocol requires five numbers a word,
 * in the order of the text: lines and UTF-16 units after the previous word, length, meaning, marks. */
#include "cli/lsp/lsp_colours.h"

#include <stdlib.h>

#include "cli/lsp/lsp_words.h"
#include "model/store/array.h"

#define MEANING(name) MEANS_##name,
typedef enum { MEANS_nothing, LSP_MEANINGS(MEANING) } meaning;
#define MARK(name) MARK_##name,
enum { MARK_definition, LSP_MARKS(MARK) };

typedef struct { lsp_span at; meaning meaning; unsigned marks; } word;

static meaning meaning_of_symbol(const know_symbol *s, unsigned *marks) {
  if (!s->definition) *marks |= 1u << MARK_defaultLibrary;
  switch ((know_symbol_kind)s->kind) {
  case KNOW_FUNCTION:
  case KNOW_LOOP:
  case KNOW_FIELD:
  case KNOW_RULE: return MEANS_function;
  case KNOW_PARAMETER: return MEANS_parameter;
  case KNOW_MACRO: return s->definition ? MEANS_macro : MEANS_keyword;
  case KNOW_BUILTIN: return s->call && *s->call ? MEANS_function : MEANS_variable;
  case KNOW_VARIABLE:
  case KNOW_MODEL_PARAMETER:
  case KNOW_LOCAL:
  case KNOW_LOOP_VARIABLE: break;
  }
  return MEANS_variable;
}

static meaning meaning_of_name(const knowledge *k, const know_node *n, unsigned *marks) {
  switch ((know_role)n->role) {
  case KNOW_SYNTAX: return MEANS_keyword;
  case KNOW_DATUM: return MEANS_enumMember;
  case KNOW_DEFINITION: *marks |= 1u << MARK_declaration; break;
  case KNOW_ASSIGNMENT: *marks |= 1u << MARK_modification; break;
  case KNOW_REFERENCE: break;
  case KNOW_EXPRESSION:
  case KNOW_UNBOUND:
  case KNOW_OPAQUE: return MEANS_nothing;
  }
  return n->symbol ? meaning_of_symbol(&k->symbols[n->symbol], marks) : MEANS_nothing;
}

static word word_of(const knowledge *k, const know_node *n) {
  word w = { .at = { n->at.from, n->at.to } };
  switch ((know_kind)n->kind) {
  case KNOW_SYMBOL:
    if (!lsp_ends_word(k->files[0].text[n->at.from])) w.meaning = meaning_of_name(k, n, &w.marks);
    break;
  case KNOW_KEYWORD: w.meaning = MEANS_property; break;
  case KNOW_NUMBER:
  case KNOW_BOOLEAN: w.meaning = MEANS_number; break;
  case KNOW_STRING:
  case KNOW_CHARACTER: w.meaning = MEANS_string; break;
  case KNOW_LIST:
  case KNOW_VECTOR:
  case KNOW_OTHER: break;
  }
  return w;
}

/* ---- words in the order of the text ---- */

typedef struct { word *at; size_t count, room; bool failed; } words;

static void add(words *w, word found) {
  if (VS_GROW(w->at, w->room, w->count + 1)) w->at[w->count++] = found;
  else w->failed = true;
}

/* Collects the words of the program's own file. The nodes of a script are not in the order of its text. */
static void collect(words *w, const knowledge *k) {
  for (know_index i = 1; i <= k->text_nodes; i++) {
    const know_node *n = know_at(k, i);
    if (n->at.file || n->made || n->at.to <= n->at.from) continue;
    word found = word_of(k, n);
    bool called = k->script && n->parent && know_at(k, n->parent)->first == i;
    if (called && found.meaning == MEANS_variable) found.meaning = MEANS_function;
    if (found.meaning != MEANS_nothing) add(w, found);
  }
  for (know_index i = k->files[0].first_comment; i < k->files[0].comment_end; i++)
    add(w, (word){ { k->comments[i].from, k->comments[i].to }, MEANS_comment, 0 });
}

static int in_order(const void *a, const void *b) {
  const word *one = a, *two = b;
  return one->at.from < two->at.from ? -1 : one->at.from > two->at.from;
}

/* The words written so far: the text up to byte `at`, which is at `place`; the last word began at `last`. */
typedef struct { FILE *to; const know_file *file; size_t at; lsp_position place, last; const char *comma; } writer;

/* Writes the word; a word that covers several lines becomes one word on each line. */
static void put_word(writer *w, const word *found) {
  const char *text = w->file->text;
  size_t from = found->at.from;
  while (from < found->at.to) {
    size_t to = from;
    while (to < found->at.to && text[to] != '\n' && text[to] != '\r') to++;
    lsp_advance(text, w->file->size, &w->at, from, &w->place);
    lsp_position start = w->place;
    lsp_advance(text, w->file->size, &w->at, to, &w->place);
    uint32_t lines = start.line - w->last.line, units = start.character - (lines ? 0 : w->last.character);
    if (to > from)
      fprintf(w->to, "%s%u,%u,%u,%d,%u", w->comma, (unsigned)lines, (unsigned)units,
              (unsigned)(w->place.character - start.character), (int)found->meaning, found->marks);
    if (to > from) w->last = start, w->comma = ",";
    for (from = to; from < found->at.to && (text[from] == '\n' || text[from] == '\r'); from++) {}
  }
}

static void put_words(lsp_server *s, const knowledge *k) {
  words all = { 0 };
  collect(&all, k);
  if (all.failed) s->refused = "out of memory";
  else if (all.count) qsort(all.at, all.count, sizeof *all.at, in_order);
  writer w = { .to = s->to, .file = &k->files[0], .comma = "" };
  for (size_t i = 0, end = 0; i < all.count && !all.failed; i++) {
    if (all.at[i].at.from < end) continue; /* a form's short spelling, such as x in a script's x++, has two nodes */
    put_word(&w, &all.at[i]);
    end = all.at[i].at.to;
  }
  free(all.at);
}

void lsp_colours(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  bool known = d && know_reads(d->path) && lsp_document_study(d, s->interpreter);
  if (d && know_reads(d->path) && !known) { /* without an analysis the editor keeps its old colours */
    s->refused = "the text cannot be read";
    return;
  }
  fputs("{\"data\":[", s->to);
  if (known) put_words(s, &d->draft->k);
  fputs("]}", s->to);
}
