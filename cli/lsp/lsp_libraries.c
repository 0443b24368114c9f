/* Finds the definitions of names that a text imports from libraries in other files. */
#define _GNU_SOURCE
#include "cli/lsp/lsp_libraries.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "cli/lsp/lsp_words.h"

bool lsp_is_imported(const knowledge *k, know_index symbol, vs_name_info *info) {
  const know_symbol *s = &k->symbols[symbol];
  return !s->definition && vs_name_get(k->scheme, s->text, info) && info->own && info->at.file && info->at.line;
}

/* Returns the bytes of the name in its definition. The interpreter's place is in the body: the last (define (name ...
 * before it is the definition. Without one, returns the place. */
static lsp_span definition_of(const char *text, size_t length, const char *name, const vs_span *at) {
  know_place place = { .line = at->line, .column = at->column };
  lsp_span found = lsp_place(text, length, &place);
  char head[300];
  size_t n = (size_t)snprintf(head, sizeof head, "(define (%s", name);
  for (size_t i = found.from; n < sizeof head && i-- > 0;)
    if (!strncmp(text + i, head, n) && lsp_ends_word(text[i + n]))
      return (lsp_span){ (uint32_t)(i + n - strlen(name)), (uint32_t)(i + n) };
  return found;
}

void lsp_put_imported(FILE *to, knowledge *k, const char *name, const vs_span *at) {
  char path[PATH_MAX];
  size_t length = 0;
  char *text = realpath(at->file, path) ? know_file_text(k, path, &length) : NULL;
  if (text) {
    fputs("{\"uri\":", to);
    lsp_write_uri(to, path);
    fputc(',', to);
    lsp_put_range(to, "range", text, length, definition_of(text, length, name, at));
    fputc('}', to);
  } else fputs("null", to);
  free(text);
}

/* Returns the offset of the line before the one at `from`. */
static size_t line_before(const char *text, size_t from) {
  size_t i = from - 1;
  while (i && text[i - 1] != '\n') i--;
  return i;
}

static bool is_comment(const char *line) { return line[strspn(line, " \t")] == ';'; }

void lsp_add_imported_comment(FILE *to, knowledge *k, const char *name, const vs_span *at) {
  size_t length = 0, begin = 0;
  char *text = know_file_text(k, at->file, &length);
  if (!text) return;
  size_t end = definition_of(text, length, name, at).from;
  while (end && text[end - 1] != '\n') end--;
  for (begin = end; begin && is_comment(text + line_before(text, begin));) begin = line_before(text, begin);
  while (begin < end) {
    size_t n = strcspn(text + begin, "\n"), skipped = strspn(text + begin, " \t;");
    if (skipped > n) skipped = n;
    fprintf(to, "%.*s\n", (int)(n - skipped), text + begin + skipped);
    begin += n + 1;
  }
  free(text);
}
