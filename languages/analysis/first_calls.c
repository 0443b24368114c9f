/* Writes the instrumented text of a program, which records the result of each procedure's first call (first_calls.h).
 *
 * After the top-level form that defines a procedure, or that loads its file, the text redefines the procedure's name as
 * a replacement. At the first call, the replacement restores the original, calls it, and records the result. */
#include "languages/analysis/first_calls.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

typedef struct { char *text; size_t count, room; bool ok; } builder;

static void put(builder *b, const char *text, size_t n) {
  if (!b->ok || !VS_GROW(b->text, b->room, b->count + n + 1)) {
    b->ok = false;
    return;
  }
  memcpy(b->text + b->count, text, n);
  b->count += n;
}

void know_first_result(know_index symbol, char *expression) {
  snprintf(expression, KNOW_FIRST_ROOM, "%%first-result-%u", (unsigned)symbol);
}

/* No replacement is made for a procedure with keywords, since a list of arguments cannot contain keywords, and for a
 * name that may not be a procedure in a run. */
bool know_remembers(const knowledge *k, know_index symbol) {
  const know_symbol *y = &k->symbols[symbol];
  if (k->script || y->kind != KNOW_FUNCTION || y->made || !y->definition || !y->form || !y->parameters || y->sets ||
      y->arity.any_keyword || y->definitions > 1 || k->scopes[y->scope].kind != KNOW_SCOPE_PROGRAM ||
      !know_is(k, k->nodes[y->form].first, "define")) return false;
  return true;
}

/* Returns the top-level form of the program's own file that contains the node, or that loads the node's file. Returns 0
 * if there is none. */
static know_index brought_by(const knowledge *k, know_index node) {
  while (node && k->nodes[node].at.file) node = k->files[k->nodes[node].at.file].loaded_by;
  while (node && k->nodes[node].parent && k->nodes[node].parent != k->files[0].root) node = k->nodes[node].parent;
  return node;
}

/* Writes the text of `form`, in which `kept` replaces each %s and the name replaces each %n. */
static void put_words(builder *b, const char *form, const char *kept, const char *name, size_t n) {
  for (const char *p = form; *p;) {
    size_t plain = strcspn(p, "%");
    put(b, p, plain);
    p += plain;
    if (!*p) break;
    if (p[1] == 's') put(b, kept, strlen(kept));
    else put(b, name, n);
    p += 2;
  }
}

static void put_memory(builder *b, const knowledge *k, know_index symbol) {
  char kept[KNOW_FIRST_ROOM];
  size_t n;
  const char *name = know_spelling(k, k->symbols[symbol].definition, &n);
  know_first_result(symbol, kept);
  put_words(b, " (define %s #f) (set! %n (let ([own %n]) (lambda all (set! %n own) (call-with-values "
               "(lambda () (apply own all)) (lambda them (set! %s (and (pair? them) (car them))) "
               "(apply values them))))))", kept, name, n);
}

typedef struct { know_index form, symbol; } memory;

static int by_form(const void *a, const void *b) {
  const memory *p = a, *q = b;
  return p->form != q->form ? (p->form < q->form ? -1 : 1) : p->symbol < q->symbol ? -1 : p->symbol > q->symbol;
}

char *know_remembering(const knowledge *k, size_t *length) {
  builder b = {.ok = true};
  memory *all = NULL;
  size_t room = 0, count = 0, next = 0, at = 0;
  if (k->script || !k->file_count || !VS_GROW(all, room, k->symbol_count)) return NULL;
  for (know_index i = 1; i < k->symbol_count; i++)
    if (know_remembers(k, i)) all[count++] = (memory){brought_by(k, k->symbols[i].form), i};
  if (count) qsort(all, count, sizeof *all, by_form);
  for (know_index form = k->nodes[k->files[0].root].first; form; form = k->nodes[form].next) {
    put(&b, k->files[0].text + at, k->nodes[form].at.to - at);
    at = k->nodes[form].at.to;
    while (next < count && all[next].form < form) next++;
    for (; next < count && all[next].form == form; next++) put_memory(&b, k, all[next].symbol);
  }
  put(&b, k->files[0].text + at, k->files[0].size - at);
  free(all);
  if (!b.ok) free(b.text), b.text = NULL;
  *length = b.count;
  return b.text;
}
