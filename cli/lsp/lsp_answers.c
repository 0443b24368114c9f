/* Answers the requests of an editor about the texts that it has open. */
#include "cli/lsp/lsp_answers.h"

#include <stdlib.h>
#include <string.h>

#include "cli/lsp/lsp_libraries.h"
#include "cli/lsp/lsp_pictures.h"
#include "cli/lsp/lsp_project.h"
#include "cli/lsp/lsp_words.h"
#include "cli/prompt/source_text.h"
#include "languages/analysis/notation.h"
#include "languages/format/format_program.h"

/* ---- common parts ---- */

lsp_document *lsp_find_uri(const lsp_server *s, const char *uri) {
  for (size_t i = 0; uri && i < s->count; i++)
    if (!strcmp(s->documents[i]->uri, uri)) return s->documents[i];
  return NULL;
}

lsp_document *lsp_find(const lsp_server *s, cli_data parameters) {
  return lsp_find_uri(s, cli_data_text(&s->json, parameters, "textDocument.uri", NULL));
}

static size_t offset_of(const lsp_server *s, const lsp_document *d, cli_data parameters) {
  long long line = cli_data_number(&s->json, parameters, "position.line", 0);
  long long character = cli_data_number(&s->json, parameters, "position.character", 0);
  return lsp_offset(d->text, d->length, (lsp_position){ (uint32_t)line, (uint32_t)character });
}

/* Returns the symbol (a name with its definition) at the position of the request, or 0. Sets *node to the name's node,
 * and *k to the analysis of the text. */
static know_index asked(lsp_server *s, cli_data parameters, knowledge **k, know_index *node) {
  lsp_document *d = lsp_find(s, parameters);
  if (!d || !lsp_document_study(d, s->interpreter)) return 0;
  *k = &d->draft->k;
  return lsp_symbol_at(*k, offset_of(s, d, parameters), node);
}

/* ---- the texts of a name ---- */

/* Returns the node that shows how the symbol is used: the list (name parameter ...) of its definition, or its name. */
static know_index signature_of(const knowledge *k, const know_symbol *s) {
  know_index parent = s->definition ? know_at(k, s->definition)->parent : 0;
  return s->kind == KNOW_FUNCTION && parent && parent != s->form ? parent : s->definition;
}

static void add_comments(FILE *to, const knowledge *k, const know_symbol *s) {
  for (know_index i = s->comment; i < s->comment_end; i++) {
    const know_comment *c = &k->comments[i];
    const char *text = k->files[c->file].text + c->from, *end = k->files[c->file].text + c->to;
    while (text < end && (*text == ';' || *text == ' ')) text++;
    fprintf(to, "%.*s\n", (int)(end - text), text);
  }
}

static void add_builtin(FILE *to, const char *call, const char *keywords, const char *doc) {
  if (*call) fprintf(to, "```scheme\n%s\n```\n", call);
  if (*keywords) fprintf(to, "%s\n\n", keywords);
  fputs(doc, to);
}

static void add_symbol(FILE *to, knowledge *k, know_index symbol) {
  const know_symbol *s = &k->symbols[symbol];
  size_t n = 0;
  vs_name_info info;
  if (lsp_is_imported(k, symbol, &info)) {
    add_builtin(to, *info.call ? info.call : s->text, info.keywords, "");
    lsp_add_imported_comment(to, k, s->text, &info.at);
    return;
  }
  if (s->kind == KNOW_BUILTIN || !s->definition) {
    add_builtin(to, s->call ? s->call : "", s->keywords ? s->keywords : "", s->doc ? s->doc : "");
    return;
  }
  const char *text = know_spelling(k, signature_of(k, s), &n);
  fprintf(to, "```scheme\n%.*s\n```\n%s\n\n", (int)n, text, know_symbol_word((know_symbol_kind)s->kind));
  add_comments(to, k, s);
  if (!s->doc_string) return;
  text = know_spelling(k, s->doc_string, &n);
  if (n > 2) fprintf(to, "%.*s", (int)n - 2, text + 1);
}

void lsp_hover(lsp_server *s, cli_data parameters) {
  knowledge *k = NULL;
  know_index node = 0, symbol = asked(s, parameters, &k, &node);
  char *text = NULL;
  size_t length = 0;
  FILE *to = symbol ? open_memstream(&text, &length) : NULL;
  if (to) add_symbol(to, k, symbol);
  if (to) fclose(to);
  s->later = length && lsp_picture_start(s, lsp_find(s, parameters), node, text);
  if (s->later) {}
  else if (length) {
    fputs("{\"contents\":{\"kind\":\"markdown\",\"value\":", s->to);
    know_json_text(s->to, text, length);
    fputs("},", s->to);
    lsp_put_node_range(s->to, "range", k, node);
    fputc('}', s->to);
  } else fputs("null", s->to);
  free(text);
}

/* ---- completion ---- */

/* The state of a completion. k: the newest analysis of the text, or NULL; scheme: the interpreter whose names are
 * offered. */
typedef struct {
  lsp_server *s;
  const char *comma;
  char range[160]; /* place of the prefix, as all items have it */
  knowledge *k;
  vs_scheme *scheme;
} completion;
enum { KIND_FUNCTION = 3, KIND_VARIABLE = 6, KIND_FORM = 14 };

static void put_item(completion *c, const char *name, int kind, const char *detail, const char *doc) {
  FILE *to = c->s->to;
  fprintf(to, "%s{\"label\":", c->comma);
  lsp_put(to, name);
  fprintf(to, ",\"kind\":%d,\"detail\":", kind);
  lsp_put(to, detail);
  fputs(",\"documentation\":", to);
  lsp_put(to, doc);
  fprintf(to, ",\"textEdit\":{%s,\"newText\":", c->range);
  lsp_put(to, name);
  fputs("}}", to);
  c->comma = ",";
}

/* Returns true if the analysis has a definition of the name, which complete_symbols offers. */
static bool is_defined(const knowledge *k, const char *name) {
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (y->kind != KNOW_BUILTIN && !y->made && y->definition && !strcmp(y->text, name)) return true;
  }
  return false;
}

static bool complete_name(void *context, const char *name) {
  completion *c = context;
  vs_name_info info;
  if (!vs_name_get(c->scheme, name, &info) || (info.own && c->k && is_defined(c->k, name))) return true;
  int kind = !strcmp(info.kind, "procedure") ? KIND_FUNCTION : !strcmp(info.kind, "form") ? KIND_FORM : KIND_VARIABLE;
  put_item(c, name, kind, info.call, info.doc);
  return true;
}

static void complete_symbols(completion *c, const char *prefix) {
  knowledge *k = c->k;
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (y->kind == KNOW_BUILTIN || y->made || !y->definition || strncmp(y->text, prefix, strlen(prefix))) continue;
    bool again = false; /* whether an earlier symbol has the same name */
    for (know_index j = 1; j < i && !again; j++)
      again = k->symbols[j].kind != KNOW_BUILTIN && !k->symbols[j].made && k->symbols[j].definition &&
              !strcmp(k->symbols[j].text, y->text);
    size_t n = 0;
    const char *text = know_spelling(k, signature_of(k, y), &n);
    if (!again) put_item(c, y->text, y->kind == KNOW_FUNCTION ? KIND_FUNCTION : KIND_VARIABLE,
                         know_text(k, text, n), know_symbol_word((know_symbol_kind)y->kind));
  }
}

void lsp_completion(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  if (!d) {
    fputs("[]", s->to);
    return;
  }
  size_t to = offset_of(s, d, parameters), from = to;
  while (from && !lsp_ends_word(d->text[from - 1])) from--;
  char prefix[200];
  snprintf(prefix, sizeof prefix, "%.*s", (int)(to - from), d->text + from);
  completion c = { .s = s, .comma = "", .k = lsp_document_knowledge(d, s->interpreter), .scheme = s->language };
  FILE *range = fmemopen(c.range, sizeof c.range, "w");
  if (range) {
    lsp_put_range(range, "range", d->text, d->length, (lsp_span){ (uint32_t)from, (uint32_t)to });
    fclose(range);
  }
  fputs("[", s->to);
  if (c.k) complete_symbols(&c, prefix);
  if (c.k) c.scheme = c.k->scheme; /* the analysis has an interpreter with the names of imported libraries */
  vs_complete(c.scheme, prefix, complete_name, &c);
  fputs("]", s->to);
}

/* ---- calls ---- */

/* Writes a call such as (make-box c l w) as a signature of the protocol: each word after the name is a parameter. */
static void put_signature(FILE *to, const char *call, size_t length, const char *doc) {
  const char *comma = "";
  fputs("{\"label\":", to);
  know_json_text(to, call, length);
  fputs(",\"documentation\":", to);
  lsp_put(to, doc);
  fputs(",\"parameters\":[", to);
  size_t i = 0;
  while (i < length && call[i] != ' ' && call[i] != '\n') i++;
  while (i < length) {
    while (i < length && strchr(" \n)", call[i])) i++;
    size_t from = i;
    for (int depth = 0; i < length && (depth || !strchr(" \n)", call[i])); i++)
      depth += (call[i] == '(' || call[i] == '[') - (call[i] == ')' || call[i] == ']');
    if (i == from) break;
    lsp_position a = lsp_position_of(call, length, from), b = lsp_position_of(call, length, i);
    if (!a.line && !b.line) fprintf(to, "%s{\"label\":[%u,%u]}", comma, (unsigned)a.character, (unsigned)b.character);
    if (!a.line && !b.line) comma = ",";
  }
  fputs("]}", to);
}

void lsp_signature(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  size_t offset = d ? offset_of(s, d, parameters) : 0;
  cli_call call = { .argument = -1 };
  bool found = false;
  if (d) {
    char kept = d->text[offset];
    d->text[offset] = 0;
    found = cli_text_call(d->text, &call);
    d->text[offset] = kept;
  }
  vs_name_info info;
  const knowledge *k = d ? lsp_document_knowledge(d, s->interpreter) : NULL;
  FILE *to = s->to;
  fprintf(to, "{\"activeParameter\":%d,\"signatures\":[", call.argument > 0 ? call.argument : 0);
  for (know_index i = 1; found && k && i < k->symbol_count; i++) {
    if (k->symbols[i].kind != KNOW_FUNCTION || strcmp(k->symbols[i].text, call.name)) continue;
    size_t n = 0;
    const char *text = know_spelling(k, signature_of(k, &k->symbols[i]), &n);
    put_signature(to, text, n, "");
    found = false;
  }
  if (found && vs_name_get(k ? k->scheme : s->language, call.name, &info))
    for (const char *at = info.call, *comma = ""; *at; comma = ",") {
      size_t n = strcspn(at, "\n");
      fputs(comma, to);
      put_signature(to, at, n, info.doc);
      at += n + (at[n] == '\n');
    }
  fputs("]}", to);
}

/* ---- places of a name ---- */

void lsp_definition(lsp_server *s, cli_data parameters) {
  knowledge *k = NULL;
  know_index node = 0, symbol = asked(s, parameters, &k, &node);
  vs_name_info info;
  if (symbol && k->symbols[symbol].definition) lsp_put_location(s->to, k, k->symbols[symbol].definition);
  else if (symbol && lsp_is_imported(k, symbol, &info)) lsp_put_imported(s->to, k, k->symbols[symbol].text, &info.at);
  else fputs("null", s->to);
}

/* Writes the address of the text at a place: the editor's own, if it has the text open. */
static void put_address(FILE *to, const lsp_project *p, const lsp_name_place *at) {
  if (p->files[at->file].owned) lsp_write_uri(to, p->files[at->file].path);
  else lsp_put(to, p->files[at->file].open->uri);
}

static void put_place(FILE *to, const lsp_project *p, const lsp_name_place *at) {
  const lsp_document *d = lsp_project_text(p, at);
  fputs("{\"uri\":", to);
  put_address(to, p, at);
  fputc(',', to);
  lsp_put_range(to, "range", d->text, d->length, (lsp_span){ at->from, at->to });
  fputc('}', to);
}

void lsp_references(lsp_server *s, cli_data parameters) {
  knowledge *k = NULL;
  know_index node = 0, symbol = asked(s, parameters, &k, &node);
  const char *comma = "";
  lsp_project p = { 0 };
  bool everywhere = symbol && lsp_project_find(&p, s, lsp_find(s, parameters), symbol, NULL) && p.place_count;
  fputc('[', s->to);
  for (size_t i = 0; everywhere && i < p.place_count; i++) {
    fputs(i ? "," : "", s->to);
    put_place(s->to, &p, &p.places[i]);
  }
  lsp_project_free(&p);
  for (know_index i = 1; symbol && !everywhere && i <= k->text_nodes; i++) {
    if (!lsp_is_name_of(k, i, symbol)) continue;
    fputs(comma, s->to);
    lsp_put_location(s->to, k, i);
    comma = ",";
  }
  fputc(']', s->to);
}

/* Returns the text in which the symbol's name is replaced by `name`; the caller frees it. Returns NULL when memory is
 * out. */
static char *renamed(const knowledge *k, know_index symbol, const char *name, size_t *length) {
  char *text = NULL;
  size_t from = 0;
  FILE *to = open_memstream(&text, length);
  if (!to) return NULL;
  for (know_index i = 1; i <= k->text_nodes; i++) {
    const know_place *at = &know_at(k, i)->at;
    if (!lsp_is_name_of(k, i, symbol) || at->from < from) continue;
    fwrite(k->files[0].text + from, 1, at->from - from, to);
    fputs(name, to);
    from = at->to;
  }
  fwrite(k->files[0].text + from, 1, k->files[0].size - from, to);
  if (fclose(to) == 0) return text;
  free(text);
  return NULL;
}

/* Returns true if the definition of every name is the same in both analyses. */
static bool same_meaning(const cli_draft *a, const cli_draft *b) {
  if (!b->known || a->k.text_nodes != b->k.text_nodes || a->found.count != b->found.count) return false;
  for (know_index i = 1; i < a->k.text_nodes; i++) {
    const know_node *x = know_at(&a->k, i), *y = know_at(&b->k, i);
    if (x->kind != y->kind || x->role != y->role) return false;
    if (a->k.symbols[x->symbol].definition != b->k.symbols[y->symbol].definition) return false;
  }
  return true;
}

/* Returns whether the text is a name that a program can define. */
static bool is_name(const lsp_server *s, const char *name) {
  char text[300];
  cli_draft d = { 0 };
  int n = snprintf(text, sizeof text, "(define %s 1)", name);
  bool ok = n < (int)sizeof text && lsp_word(name, name + strlen(name)) == strlen(name) &&
            cli_draft_read(&d, s->interpreter, "name.vs", text, (size_t)n) && d.known && d.k.symbol_count > 1;
  bool found = false;
  for (know_index i = 1; ok && i < d.k.symbol_count; i++)
    found |= d.k.symbols[i].definition && !strcmp(d.k.symbols[i].text, name);
  cli_draft_free(&d);
  return found;
}

/* Returns the reason why the project's files cannot be edited, or NULL. */
static const char *obstacle(lsp_server *s, const lsp_project *p, const char *name) {
  if (!p->whole) return "the project has more files than vs lsp searches; rename the name by hand";
  if (!is_name(s, name)) return "the new name is no name of the language";
  for (size_t i = 0; i < p->place_count; i++) {
    const lsp_project_file *f = &p->files[p->places[i].file];
    const char *why = strstr(f->path, "/.")                 ? "belongs to a package"
                      : !f->owned && !lsp_document_is_file(f->open) ? "is not saved"
                      : !f->fresh                           ? "has the new name already"
                      : p->places[i].other && f->prefixed    ? "has the name with a prefix; rename it by hand"
                                                            : NULL;
    if (!why) continue;
    snprintf(s->why, sizeof s->why, "%.300s %s", f->path, why);
    return s->why;
  }
  return NULL;
}

/* Renames a symbol in all files of the project. */
static void rename_everywhere(lsp_server *s, const lsp_project *p, const char *name) {
  size_t last = SIZE_MAX;
  s->refused = obstacle(s, p, name);
  if (s->refused) return;
  fputs("{\"changes\":{", s->to);
  for (size_t i = 0; i < p->place_count; i++) {
    const lsp_name_place *at = &p->places[i];
    const lsp_document *d = lsp_project_text(p, at);
    if (at->other) continue;
    if (at->file == last) fputc(',', s->to);
    else {
      if (last != SIZE_MAX) fputs("],", s->to);
      put_address(s->to, p, at);
      fputs(":[", s->to);
    }
    last = at->file;
    fputc('{', s->to);
    lsp_put_range(s->to, "range", d->text, d->length, (lsp_span){ at->from, at->to });
    fputs(",\"newText\":", s->to);
    lsp_put(s->to, name);
    fputc('}', s->to);
  }
  fputs(last == SIZE_MAX ? "}}" : "]}}", s->to);
}

/* Renames a symbol, if an analysis of the new text still finds the same definition for every name. */
void lsp_rename(lsp_server *s, cli_data parameters) {
  knowledge *k = NULL;
  know_index node = 0, symbol = asked(s, parameters, &k, &node);
  const char *name = cli_data_text(&s->json, parameters, "newName", NULL);
  lsp_document *d = lsp_find(s, parameters);
  s->refused = "there is no name of the program here";
  if (!symbol || !name) return;
  lsp_project p = { 0 };
  bool elsewhere = lsp_project_find(&p, s, d, symbol, name) && p.place_count && !p.here;
  if (elsewhere) rename_everywhere(s, &p, name);
  lsp_project_free(&p);
  if (elsewhere || !k->symbols[symbol].definition) return;
  s->refused = "another file has the name; rename it there by hand";
  for (know_index i = 1; i < k->node_count; i++)
    if (lsp_is_name_of(k, i, symbol) && know_at(k, i)->at.file) return;
  size_t length = 0;
  char *text = renamed(k, symbol, name, &length);
  cli_draft after = { 0 };
  vs_options o = lsp_document_options(d, s->interpreter);
  bool same = text && cli_draft_read(&after, &o, d->path, text, length) && same_meaning(d->draft, &after);
  cli_draft_free(&after);
  free(text);
  s->refused = "the new name would change the meaning of the program";
  if (!same) return;
  s->refused = NULL;
  const char *comma = "";
  fputs("{\"changes\":{", s->to);
  lsp_put(s->to, d->uri);
  fputs(":[", s->to);
  for (know_index i = 1; i <= k->text_nodes; i++) {
    if (!lsp_is_name_of(k, i, symbol)) continue;
    fprintf(s->to, "%s{", comma);
    lsp_put_node_range(s->to, "range", k, i);
    fputs(",\"newText\":", s->to);
    lsp_put(s->to, name);
    fputc('}', s->to);
    comma = ",";
  }
  fputs("]}}", s->to);
}

/* ---- the whole text ---- */

void lsp_outline(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  const knowledge *k = d && lsp_document_study(d, s->interpreter) ? &d->draft->k : NULL;
  const char *comma = "";
  fputc('[', s->to);
  for (know_index i = 1; k && i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (!y->definition || y->made || !y->form || know_at(k, y->definition)->at.file ||
        !lsp_is_top(k, y)) continue;
    fprintf(s->to, "%s{\"name\":", comma);
    lsp_put(s->to, y->text);
    fprintf(s->to, ",\"kind\":%d,\"detail\":", y->kind == KNOW_FUNCTION || y->kind == KNOW_MACRO ? 12 : 13);
    lsp_put(s->to, know_symbol_word((know_symbol_kind)y->kind));
    fputc(',', s->to);
    lsp_put_node_range(s->to, "range", k, y->form);
    fputc(',', s->to);
    lsp_put_node_range(s->to, "selectionRange", k, y->definition);
    fputc('}', s->to);
    comma = ",";
  }
  fputc(']', s->to);
}

void lsp_formatting(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  if (!d || vs_language_of(d->path) || !lsp_document_study(d, s->interpreter)) {
    fputs("[]", s->to);
    return;
  }
  size_t length = 0;
  char *text = format_program(d->text, d->length, &length);
  bool changes = text && (length != d->length || memcmp(text, d->text, length));
  fputc('[', s->to);
  if (changes) {
    fputc('{', s->to);
    lsp_put_range(s->to, "range", d->text, d->length, (lsp_span){ 0, (uint32_t)d->length });
    fputs(",\"newText\":", s->to);
    know_json_text(s->to, text, length);
    fputc('}', s->to);
  }
  fputc(']', s->to);
  free(text);
}

void lsp_text(lsp_server *s, cli_data parameters) {
  const lsp_document *d = lsp_find(s, parameters);
  if (d) know_json_text(s->to, d->text, d->length);
  else fputs("null", s->to);
}
