/* Keeps the texts that an editor has open, with their edits and their analysis. */
#define _GNU_SOURCE
#include "cli/lsp/lsp_document.h"

#include <stdlib.h>
#include <string.h>

#include "cli/packages/package_lock.h"
#include "model/characters.h"
#include "model/store/array.h"

/* ---- positions ---- */

static bool ends_line(const char *text, size_t length, size_t i) {
  return text[i] == '\n' || (text[i] == '\r' && (i + 1 == length || text[i + 1] != '\n'));
}

/* Returns the length in bytes of the character at byte i, at least 1, and sets *units to its length in units of
 * UTF-16. */
static size_t character(const char *text, size_t length, size_t i, uint32_t *units) {
  uint32_t code = 0;
  size_t n = vs_character_read(text + i, length - i, &code);
  *units = code > 0xFFFF ? 2 : 1;
  return n ? n : 1;
}

size_t lsp_offset(const char *text, size_t length, lsp_position at) {
  size_t i = 0;
  uint32_t units;
  for (uint32_t line = 0; line < at.line && i < length; i++) line += ends_line(text, length, i);
  for (uint32_t column = 0; column < at.character && i < length && text[i] != '\n' && text[i] != '\r'; column += units)
    i += character(text, length, i, &units);
  return i;
}

void lsp_advance(const char *text, size_t length, size_t *at, size_t to, lsp_position *place) {
  uint32_t units;
  while (*at < to) {
    bool end = ends_line(text, length, *at);
    *at += character(text, length, *at, &units);
    if (end) place->line++, place->character = 0;
    else place->character += units;
  }
}

lsp_position lsp_position_of(const char *text, size_t length, size_t offset) {
  lsp_position place = { 0 };
  size_t at = 0;
  lsp_advance(text, length, &at, offset > length ? length : offset, &place);
  return place;
}

/* Returns the offset in bytes of a line and a column. Columns count characters; lines and columns begin at 1. */
static size_t byte_of(const char *text, size_t length, uint32_t line, uint32_t column) {
  size_t i = 0;
  uint32_t units;
  for (uint32_t n = 1; n < line && i < length; i++) n += ends_line(text, length, i);
  for (uint32_t n = 1; n < column && i < length && text[i] != '\n'; n++) i += character(text, length, i, &units);
  return i;
}

lsp_span lsp_place(const char *text, size_t length, const know_place *at) {
  size_t from = byte_of(text, length, at->line, at->column), to = from;
  if (at->end_line) to = byte_of(text, length, at->end_line, at->end_column);
  uint32_t units;
  if (to <= from) to = from < length ? from + character(text, length, from, &units) : from;
  return (lsp_span){ (uint32_t)from, (uint32_t)to };
}

/* ---- addresses ---- */

static int hexadecimal(char c) {
  static const char digits[] = "0123456789abcdef0123456789ABCDEF";
  const char *found = c ? strchr(digits, c) : NULL;
  return found ? (int)(found - digits) % 16 : -1;
}

char *lsp_path_of(const char *uri) {
  char *path = strdup(strncmp(uri, "file://", 7) ? uri : uri + 7), *to = path;
  for (const char *at = path; at && *at; at++) {
    int high = *at == '%' ? hexadecimal(at[1]) : -1, low = high >= 0 ? hexadecimal(at[2]) : -1;
    *to++ = low >= 0 ? (char)(16 * high + low) : *at;
    if (low >= 0) at += 2;
  }
  if (path) *to = 0;
  return path;
}

void lsp_write_uri(FILE *to, const char *path) {
  fputs(*path == '/' ? "\"file://" : "\"", to);
  for (; *path; path++) {
    char c = *path;
    bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || strchr("/-._~:", c);
    fprintf(to, plain ? "%c" : "%%%02X", (unsigned char)c);
  }
  fputc('"', to);
}

/* ---- documents ---- */

lsp_document *lsp_document_open(const char *uri, const char *text, size_t length) {
  lsp_document *d = vs_zeros(1, sizeof *d);
  if (!d) return NULL;
  *d = (lsp_document){ .uri = strdup(uri), .path = lsp_path_of(uri) };
  d->draft = &d->drafts[0];
  if (d->uri && d->path && lsp_document_edit(d, 0, 0, text, length)) return d;
  lsp_document_free(d);
  return NULL;
}

void lsp_document_free(lsp_document *d) {
  lsp_document_rest(d);
  free(d->libraries);
  free(d->messages);
  free(d->times);
  free(d->uri);
  free(d->path);
  free(d->text);
  free(d);
}

void lsp_document_rest(lsp_document *d) {
  for (size_t i = 0; i < 2; i++) cli_draft_free(&d->drafts[i]);
  d->fresh = false;
}

bool lsp_document_edit(lsp_document *d, size_t from, size_t to, const char *text, size_t length) {
  if (to < from) to = from;
  size_t rest = d->length - to, need = from + length + rest + 1;
  if (!VS_GROW(d->text, d->room, need)) return false;
  memmove(d->text + from + length, d->text + to, rest);
  if (length) memcpy(d->text + from, text, length);
  d->length = from + length + rest;
  d->text[d->length] = 0;
  d->fresh = d->saved = d->slow = false;
  lsp_document_forget(d);
  return true;
}

bool lsp_document_is_file(const lsp_document *d) {
  FILE *file = *d->path == '/' ? fopen(d->path, "rb") : NULL;
  char part[65536];
  size_t at = 0, n = 0;
  if (!file) return false;
  while ((n = fread(part, 1, sizeof part, file)) > 0 && n <= d->length - at && !memcmp(part, d->text + at, n)) at += n;
  fclose(file);
  return n == 0 && at == d->length;
}

void lsp_document_forget(lsp_document *d) {
  d->message_count = d->time_count = 0;
  d->seconds = 0;
}

/* Finds the packages that the text uses, at its first analysis. Ignores packages whose files were changed. */
static void find_libraries(lsp_document *d, const char *folders) {
  char path[4200], why[PACKAGE_WHY];
  if (d->libraries || !package_path(d->path, path, sizeof path, why)) return;
  if (asprintf(&d->libraries, "%s%s%s", path, *path && folders ? ":" : "", folders ? folders : "") < 0)
    d->libraries = NULL;
}

vs_options lsp_document_options(lsp_document *d, const vs_options *interpreter) {
  vs_options o = *interpreter;
  find_libraries(d, o.library_path);
  if (d->libraries) o.library_path = d->libraries;
  return o;
}

/* Analyses the text. lsp_document_knowledge returns the last successful analysis, which is kept until the next. */
bool lsp_document_study(lsp_document *d, const vs_options *interpreter) {
  if (d->fresh) return d->draft->known;
  vs_options o = lsp_document_options(d, interpreter);
  if (d->draft->known) d->draft = &d->drafts[d->draft == &d->drafts[0]];
  cli_draft_free(d->draft);
  d->fresh = cli_draft_read(d->draft, &o, d->path, d->text, d->length);
  return d->draft->known;
}

knowledge *lsp_document_knowledge(lsp_document *d, const vs_options *interpreter) {
  bool known = lsp_document_study(d, interpreter);
  cli_draft *other = &d->drafts[d->draft == &d->drafts[0]];
  return known ? &d->draft->k : other->known ? &other->k : NULL;
}

bool lsp_is_name_of(const knowledge *k, know_index node, know_index symbol) {
  const know_node *n = know_at(k, node);
  bool role = n->role == KNOW_DEFINITION || n->role == KNOW_REFERENCE || n->role == KNOW_ASSIGNMENT;
  return n->kind == KNOW_SYMBOL && !n->made && role && n->symbol && n->symbol == symbol;
}

know_index lsp_symbol_at(const knowledge *k, size_t offset, know_index *node) {
  for (know_index i = 1; i <= k->text_nodes; i++) {
    const know_node *n = know_at(k, i);
    if (n->at.file || n->at.from > offset || n->at.to < offset || !lsp_is_name_of(k, i, n->symbol)) continue;
    *node = i;
    return n->symbol;
  }
  return 0;
}
