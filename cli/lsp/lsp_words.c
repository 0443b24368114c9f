/* Writes texts, places and diagnostics of the language server, and finds words. */
#include "cli/lsp/lsp_words.h"

#include <string.h>

#include "languages/analysis/notation.h"

/* ---- words ---- */

bool lsp_ends_word(char c) { return strchr(" \t\r\n()[]{}\"';`,", c) != NULL; }

size_t lsp_word(const char *at, const char *end) {
  size_t n = 0;
  while (at + n < end && !lsp_ends_word(at[n])) n++;
  return n;
}

/* ---- places ---- */

void lsp_put(FILE *to, const char *text) { know_json_text(to, text, strlen(text)); }

void lsp_put_range(FILE *to, const char *key, const char *text, size_t length, lsp_span span) {
  lsp_position a = lsp_position_of(text, length, span.from), b = lsp_position_of(text, length, span.to);
  fprintf(to, "\"%s\":{\"start\":{\"line\":%u,\"character\":%u},\"end\":{\"line\":%u,\"character\":%u}}", key,
          (unsigned)a.line, (unsigned)a.character, (unsigned)b.line, (unsigned)b.character);
}

void lsp_put_next_range(FILE *to, const char *key, const lsp_document *d, lsp_span span, lsp_counted *c) {
  if (span.from < c->at) *c = (lsp_counted){ 0 };
  lsp_advance(d->text, d->length, &c->at, span.from > d->length ? d->length : span.from, &c->place);
  lsp_counted end = *c;
  lsp_advance(d->text, d->length, &end.at, span.to > d->length ? d->length : span.to, &end.place);
  fprintf(to, "\"%s\":{\"start\":{\"line\":%u,\"character\":%u},\"end\":{\"line\":%u,\"character\":%u}}", key,
          (unsigned)c->place.line, (unsigned)c->place.character, (unsigned)end.place.line,
          (unsigned)end.place.character);
}

void lsp_put_node_range(FILE *to, const char *key, const knowledge *k, know_index node) {
  const know_place *at = &know_at(k, node)->at;
  lsp_put_range(to, key, k->files[at->file].text, k->files[at->file].size, (lsp_span){ at->from, at->to });
}

void lsp_put_location(FILE *to, const knowledge *k, know_index node) {
  fputs("{\"uri\":", to);
  lsp_write_uri(to, k->files[know_at(k, node)->at.file].path);
  fputc(',', to);
  lsp_put_node_range(to, "range", k, node);
  fputc('}', to);
}

static lsp_position position_at(const cli_data_reader *json, cli_data position) {
  return (lsp_position){ (uint32_t)cli_data_number(json, position, "line", 0),
                         (uint32_t)cli_data_number(json, position, "character", 0) };
}

lsp_span lsp_range_of(const cli_data_reader *json, const lsp_document *d, cli_data range) {
  lsp_position from = position_at(json, cli_data_at(json, range, "start"));
  lsp_position to = position_at(json, cli_data_at(json, range, "end"));
  return (lsp_span){ (uint32_t)lsp_offset(d->text, d->length, from), (uint32_t)lsp_offset(d->text, d->length, to) };
}

/* ---- diagnostics ---- */

static const char *const check_names[] = {
#define KNOW_CHECK(id, name, meaning) name,
#include "languages/checks/checks.def"
};

const char *lsp_check_name(unsigned check) { return check_names[check]; }

lsp_span lsp_finding_span(const lsp_document *d, const know_finding *f) {
  return f->at.to > f->at.from ? (lsp_span){ f->at.from, f->at.to } : lsp_place(d->text, d->length, &f->at);
}

void lsp_write_diagnostic(FILE *to, const lsp_document *d, const know_finding *f, lsp_counted *c) {
  fputc('{', to);
  lsp_put_next_range(to, "range", d, f ? lsp_finding_span(d, f) : lsp_place(d->text, d->length, &d->draft->at), c);
  fprintf(to, ",\"severity\":%d,\"source\":\"vs\",\"code\":", f ? 2 : 1);
  lsp_put(to, f ? check_names[f->check] : "unreadable");
  fputs(",\"message\":", to);
  lsp_put(to, f ? f->details : d->draft->message);
  fputc('}', to);
}

/* Returns the form that begins at the place, or 0. *from: the node at which the search begins, and then that at which
 * it ended: a later place needs no earlier node. */
static know_index form_at(const knowledge *k, know_index *from, uint32_t line, uint32_t column) {
  for (; *from <= k->text_nodes; ++*from) {
    const know_place *at = &know_at(k, *from)->at;
    if (at->file || know_at(k, *from)->made) continue;
    if (at->line == line && at->column == column) return *from;
    if (at->line > line || (at->line == line && at->column > column)) return 0;
  }
  return 0;
}

/* Returns the bytes of the form, or of the place if the form is 0; at most to the end of the line if `line` is set. */
static lsp_span run_span(const lsp_document *d, const lsp_run_message *m, know_index form, bool line) {
  know_place place = { .line = m->line, .column = m->column };
  lsp_span span = form ? (lsp_span){ know_at(&d->draft->k, form)->at.from, know_at(&d->draft->k, form)->at.to }
                       : lsp_place(d->text, d->length, &place);
  uint32_t end = span.from + (uint32_t)strcspn(d->text + span.from, "\r\n");
  if (line && span.to > end && end > span.from) span.to = end;
  return span;
}

/* Returns true if the analysis reports something at the place of the message. */
static bool is_found(const lsp_document *d, const lsp_run_message *m) {
  for (size_t i = 0; d->draft->known && i < d->draft->found.count; i++) {
    const know_place *at = &d->draft->found.at[i].at;
    if (!at->file && at->line == m->line && at->column == m->column) return true;
  }
  return false;
}

/* Writes the messages of the run after the last save. Of nested forms that the run did not reach, writes the
 * outermost. */
static void write_run(FILE *to, const lsp_document *d, const char *comma) {
  lsp_counted counted = { 0 };
  uint32_t faded = 0;  /* end of the last form that the run did not reach */
  know_index next = 1; /* forms that the run did not reach come last, in the order of the text */
  for (size_t i = 0; i < d->message_count; i++) {
    const lsp_run_message *m = &d->messages[i];
    bool unreached = m->severity == LSP_UNREACHED;
    know_index first = 1, form = form_at(&d->draft->k, unreached ? &next : &first, m->line, m->column);
    lsp_span span = run_span(d, m, form, !unreached);
    if (unreached ? span.to <= faded : is_found(d, m)) continue;
    if (unreached) faded = span.to;
    fprintf(to, "%s{", comma);
    lsp_put_next_range(to, "range", d, span, &counted);
    fprintf(to, ",\"severity\":%d,\"source\":\"vs\",\"code\":\"%s\",%s\"message\":", m->severity,
            unreached ? "did-not-run" : "run", unreached ? "\"tags\":[1]," : "");
    lsp_put(to, m->text);
    fputc('}', to);
    comma = ",";
  }
}

void lsp_write_diagnostics(FILE *to, lsp_document *d, const vs_options *interpreter) {
  const char *comma = "";
  lsp_counted counted = { 0 };
  fputc('[', to);
  bool known = !know_reads(d->path) || lsp_document_study(d, interpreter);
  if (!known) lsp_write_diagnostic(to, d, NULL, &counted);
  for (size_t i = 0; known && i < d->draft->found.count; i++) {
    const know_finding *f = &d->draft->found.at[i];
    if (f->at.file) continue;
    fputs(comma, to);
    lsp_write_diagnostic(to, d, f, &counted);
    comma = ",";
  }
  if (known) write_run(to, d, comma);
  fputc(']', to);
}
