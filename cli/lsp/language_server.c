/* Implements `vs lsp`, the server for editors that use the Language Server Protocol: messages by JSON-RPC 2.0, each
 * after a header Content-Length. */
#include "cli/lsp/language_server.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/lsp/lsp_actions.h"
#include "cli/lsp/lsp_colours.h"
#include "cli/lsp/lsp_lens.h"
#include "cli/lsp/lsp_messages.h"
#include "cli/lsp/lsp_runs.h"
#include "cli/lsp/lsp_saved.h"
#include "cli/lsp/lsp_words.h"
#include "languages/analysis/notation.h"
#include "model/store/array.h"

enum { MOST_BYTES = 128 << 20, BAD_JSON = -32700, NO_METHOD = -32601, NOT_INITIALIZED = -32002, REFUSED = -32803 };

typedef struct {
  lsp_server s;
  char *body; size_t room;
  bool initialized, shut, ended;
  unsigned shown; /* number of addresses that the editor was asked to show */
} server;

/* ---- messages ---- */

/* Reads the next message into v->body. Returns false at the end of the input, or if the input is no message. */
static bool receive(server *v, size_t *length) {
  char line[1000];
  long long size = -1;
  while (fgets(line, sizeof line, stdin) && *line != '\r' && *line != '\n')
    if (!strncasecmp(line, "Content-Length:", 15)) size = strtoll(line + 15, NULL, 10);
  if (size < 0 || feof(stdin) || size > MOST_BYTES || !VS_GROW(v->body, v->room, (size_t)size + 1)) return false;
  *length = fread(v->body, 1, (size_t)size, stdin);
  v->body[*length] = 0;
  return *length == (size_t)size;
}

static void send_error(server *v, cli_data id, int code, const char *why) {
  lsp_message m;
  if (!lsp_message_begin(&m)) return;
  fputs("\"id\":", m.to);
  cli_data_echo(&v->s.json, id, m.to);
  fprintf(m.to, ",\"error\":{\"code\":%d,\"message\":", code);
  know_json_text(m.to, why, strlen(why));
  fputc('}', m.to);
  lsp_message_send(&m);
}

/* Asks the editor to show an address, if the answer has set one. */
static void show(server *v) {
  lsp_message m;
  const char *address = v->s.show;
  v->s.show = NULL;
  if (!address || !lsp_message_begin(&m)) return;
  fprintf(m.to, "\"id\":\"show-%u\",\"method\":\"window/showDocument\",\"params\":{\"external\":true,\"uri\":",
          ++v->shown);
  lsp_put(m.to, address);
  fputc('}', m.to);
  lsp_message_send(&m);
}

/* Sends the result of a request, or the reason why there is none. */
static void send_result(server *v, cli_data id, cli_data parameters, lsp_answer *answer) {
  lsp_message m;
  if (!lsp_message_begin(&m)) return;
  fputs("\"id\":", m.to);
  cli_data_echo(&v->s.json, id, m.to);
  fputs(",\"result\":", m.to);
  v->s.to = m.to, v->s.refused = NULL, v->s.id = id, v->s.later = false;
  answer(&v->s, parameters);
  if (v->s.later) {
    lsp_message_drop(&m);
    return;
  }
  if (!v->s.refused) {
    lsp_message_send(&m);
    show(v);
    return;
  }
  lsp_message_drop(&m);
  send_error(v, id, REFUSED, v->s.refused);
}

/* ---- the life of the server ---- */

/* Keeps the abilities of the editor, and its options. */
static void note_editor(lsp_server *s, cli_data parameters) {
  const cli_data_reader *json = &s->json;
  const char *root = cli_data_text(json, parameters, "rootUri", NULL);
  bool wanted;
  s->shows = cli_data_true(json, parameters, "capabilities.window.showDocument.support");
  s->refreshes = cli_data_true(json, parameters, "capabilities.workspace.inlayHint.refreshSupport");
  s->fades = cli_data_at(json, parameters, "capabilities.textDocument.publishDiagnostics.tagSupport") != NULL;
  s->pictures = cli_data_true(json, parameters, "initializationOptions.pictures");
  s->runs_saved = !cli_data_is_truth(cli_data_at(json, parameters, "initializationOptions.run"), &wanted) || wanted;
  free(s->root);
  s->root = root ? lsp_path_of(root) : NULL;
}

static void answer_initialize(lsp_server *s, cli_data parameters) {
  note_editor(s, parameters);
  fputs("{\"capabilities\":{\"positionEncoding\":\"utf-16\","
        "\"textDocumentSync\":{\"openClose\":true,\"change\":2,\"save\":true}", s->to);
#define LSP_REQUEST(method, function, capability) fputs("," capability, s->to);
#include "cli/lsp/lsp_methods.def"
  fputs("},\"serverInfo\":{\"name\":\"vs\",\"version\":\"" VS_VERSION "\"}}", s->to);
}

static void answer_null(lsp_server *s, cli_data parameters) {
  (void)parameters;
  fputs("null", s->to);
}

static void drop(lsp_server *s, lsp_document *d) {
  for (size_t i = 0; i < s->count; i++)
    if (s->documents[i] == d) s->documents[i] = s->documents[--s->count];
  lsp_document_free(d);
}

static void lsp_did_open(lsp_server *s, cli_data parameters) {
  size_t length = 0;
  const char *uri = cli_data_text(&s->json, parameters, "textDocument.uri", NULL);
  const char *text = cli_data_text(&s->json, parameters, "textDocument.text", &length);
  lsp_document *old = lsp_find(s, parameters);
  if (!uri || !text || !VS_GROW(s->documents, s->room, s->count + 1)) return;
  lsp_document *d = lsp_document_open(uri, text, length);
  if (!d) return;
  if (old) drop(s, old);
  s->documents[s->count++] = d;
  d->saved = lsp_document_is_file(d);
  lsp_publish(s, d, false);
}

static void lsp_did_change(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  cli_data changes = cli_data_at(&s->json, parameters, "contentChanges");
  for (size_t i = 0; d && i < cli_data_count(&s->json, changes); i++) {
    cli_data change = cli_data_nth(&s->json, changes, i);
    size_t length = 0, from = 0, to = d->length;
    const char *text = cli_data_text(&s->json, change, "text", &length);
    if (cli_data_at(&s->json, change, "range")) {
      lsp_span span = lsp_range_of(&s->json, d, cli_data_at(&s->json, change, "range"));
      from = span.from, to = span.to;
    }
    if (text) lsp_document_edit(d, from, to, text, length);
  }
  if (d) lsp_publish(s, d, false);
}

static void lsp_did_close(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  if (!d) return;
  lsp_publish(s, d, true);
  drop(s, d);
}

typedef struct { const char *method; lsp_answer *answer; bool notice; } method;
static const method methods[] = {
#define LSP_REQUEST(name, function, capability) { name, function, false },
#define LSP_NOTICE(name, function) { name, function, true },
#include "cli/lsp/lsp_methods.def"
  { "shutdown", answer_null, false },
};

static void handle(server *v, cli_data m) {
  const char *name = cli_data_text(&v->s.json, m, "method", NULL);
  cli_data id = cli_data_at(&v->s.json, m, "id"), parameters = cli_data_at(&v->s.json, m, "params");
  if (!name) return; /* a message without a method is an answer of the editor to the server, which has asked nothing */
  if (!strcmp(name, "exit")) {
    v->ended = true;
    return;
  }
  if (!strcmp(name, "initialize") && id) {
    v->initialized = true;
    send_result(v, id, parameters, answer_initialize);
    return;
  }
  for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
    if (strcmp(methods[i].method, name) || methods[i].notice != !id) continue;
    if (!v->initialized) break;
    if (!strcmp(name, "shutdown")) v->shut = true;
    if (id) send_result(v, id, parameters, methods[i].answer);
    else methods[i].answer(&v->s, parameters);
    return;
  }
  if (id && !v->initialized) send_error(v, id, NOT_INITIALIZED, "the first request is initialize");
  else if (id) send_error(v, id, NO_METHOD, "vs lsp has no such method");
}

/* Ignores messages of the interpreter that only provides the names of the language, because they concern no text. */
static void ignore(void *context, const vs_diagnostic *d) { (void)context, (void)d; }

vs_outcome cli_language_server(const cli_options *o, int (*run)(int argc, char **argv)) {
  server v = { .s.interpreter = &o->interpreter, .s.run = run };
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){ .diagnose = ignore };
  size_t length = 0;
  if (!cli_data_open(&v.s.json)) {
    fprintf(stderr, "vs lsp: %s\n", v.s.json.trouble);
    cli_data_close(&v.s.json);
    return VS_OUTCOME_WORKER;
  }
  v.s.language = vs_new(&interpreter);
  setvbuf(stdin, NULL, _IONBF, 0); /* no message waits in a buffer while lsp_runs_wait looks at the descriptor */
  while (v.s.language && !v.ended && !ferror(stdout)) {
    lsp_runs_wait(&v.s);
    if (!receive(&v, &length)) break;
    cli_data m = cli_data_read(&v.s.json, v.body, length);
    if (m) handle(&v, m);
    else send_error(&v, NULL, BAD_JSON, "this message is no JSON");
    cli_data_free(&v.s.json, m);
  }
  vs_outcome outcome = !v.s.language ? VS_OUTCOME_MACHINE : v.ended && !v.shut ? VS_OUTCOME_MODEL : VS_OUTCOME_DONE;
  if (!v.s.language) fputs("vs: out of memory\n", stderr);
  while (v.s.count) drop(&v.s, v.s.documents[0]);
  vs_free(v.s.language);
  lsp_views_end(&v.s);
  lsp_runs_end(&v.s);
  free(v.s.root);
  free(v.s.documents);
  free(v.body);
  cli_data_close(&v.s.json);
  return outcome;
}
