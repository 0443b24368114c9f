/* Implements `vs mcp`: messages by JSON-RPC 2.0, each on its line. */
#include "cli/mcp/mcp_server.h"

#include <stdlib.h>
#include <string.h>

#include "cli/mcp/mcp_tools.h"
#include "languages/analysis/notation.h"

enum { BAD_JSON = -32700, BAD_REQUEST = -32600, NO_METHOD = -32601, BAD_ARGUMENTS = -32602 };

/* The versions of the protocol that the server speaks, the newest first. */
static const char *const versions[] = { "2025-06-18", "2025-03-26", "2024-11-05" };

static const char instructions[] =
  "VisualScheme makes solid models from programs in Scheme. Z is up, angles are radians, lengths are metres unless the "
  "program says (units 'mm). (draw object) adds to the drawing. Ask help for a name or for words of the trade before "
  "you use it. Give a program once; later calls without program use it again. Messages give line:column, the cause and "
  "the text to write instead: correct the program, then look at picture, measure and section before export.";

typedef struct { cli_data_reader json; mcp_desk desk; } server;

/* A message in memory; message_send sends it as a line. */
typedef struct { FILE *to; char *text; size_t length; } message;

static bool message_begin(message *m, server *v, cli_data id) {
  *m = (message){ 0 };
  m->to = open_memstream(&m->text, &m->length);
  if (!m->to) return false;
  fputs("{\"jsonrpc\":\"2.0\",\"id\":", m->to);
  cli_data_echo(&v->json, id, m->to);
  return true;
}

static void message_send(message *m) {
  fputc('}', m->to);
  if (fclose(m->to) == 0) fwrite(m->text, 1, m->length, stdout);
  fputc('\n', stdout);
  fflush(stdout);
  free(m->text);
}

static void send_error(server *v, cli_data id, int code, const char *why) {
  message m;
  if (!message_begin(&m, v, id)) return;
  fprintf(m.to, ",\"error\":{\"code\":%d,\"message\":", code);
  know_json_text(m.to, why, strlen(why));
  fputc('}', m.to);
  message_send(&m);
}

/* ---- the answers: each writes a result, or returns the reason why there is none ---- */

static const char *answer_initialize(server *v, cli_data parameters, FILE *to) {
  const char *asked = cli_data_text(&v->json, parameters, "protocolVersion", NULL), *version = versions[0];
  for (size_t i = 0; asked && i < sizeof versions / sizeof *versions; i++)
    if (!strcmp(versions[i], asked)) version = versions[i];
  fprintf(to, "{\"protocolVersion\":\"%s\",\"capabilities\":{\"tools\":{}},\"serverInfo\":{\"name\":\"vs\","
              "\"title\":\"VisualScheme\",\"version\":\"" VS_VERSION "\"},\"instructions\":", version);
  know_json_text(to, instructions, strlen(instructions));
  fputc('}', to);
  return NULL;
}

static const char *answer_ping(server *v, cli_data parameters, FILE *to) {
  (void)v, (void)parameters;
  fputs("{}", to);
  return NULL;
}

static const char *answer_list(server *v, cli_data parameters, FILE *to) {
  (void)v, (void)parameters;
  fputs("{\"tools\":[", to);
  mcp_list_tools(to);
  fputs("]}", to);
  return NULL;
}

static const char *answer_call(server *v, cli_data parameters, FILE *to) {
  const char *name = cli_data_text(&v->json, parameters, "name", NULL);
  cli_data arguments = cli_data_at(&v->json, parameters, "arguments");
  bool known = name && mcp_call_tool(&v->desk, name, arguments, to);
  return known ? NULL : "there is no such tool; tools/list has their names";
}

typedef struct { const char *name; const char *(*answer)(server *v, cli_data parameters, FILE *to); } method;
static const method methods[] = {
  { "initialize", answer_initialize }, { "ping", answer_ping }, { "tools/list", answer_list },
  { "tools/call", answer_call },
};

static void handle(server *v, cli_data m) {
  const char *name = cli_data_text(&v->json, m, "method", NULL);
  cli_data id = cli_data_at(&v->json, m, "id");
  message answer;
  if (!name && !cli_data_at(&v->json, m, "result") && !cli_data_at(&v->json, m, "error"))
    send_error(v, id, BAD_REQUEST, "this is no request: it has no method");
  if (!name || !id) return; /* ignores a message without a method (an answer) or without an id (a notice) */
  for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
    if (strcmp(methods[i].name, name) || !message_begin(&answer, v, id)) continue;
    v->desk.process.id = id;
    fputs(",\"result\":", answer.to);
    const char *why = methods[i].answer(v, cli_data_at(&v->json, m, "params"), answer.to);
    if (!why) {
      message_send(&answer);
      return;
    }
    fclose(answer.to);
    free(answer.text);
    send_error(v, id, BAD_ARGUMENTS, why);
    return;
  }
  send_error(v, id, NO_METHOD, "vs mcp has no such method");
}

vs_outcome cli_mcp_server(const cli_options *o, const volatile sig_atomic_t *interrupts,
                          int (*run)(int argc, char **argv)) {
  server v = { .desk.process = { .run = run, .interrupts = interrupts } };
  v.desk.process.json = &v.json;
  vs_outcome outcome = VS_OUTCOME_DONE;
  if (!cli_data_open(&v.json)) {
    fprintf(stderr, "vs mcp: %s\n", v.json.trouble);
    outcome = VS_OUTCOME_WORKER;
  } else if (!mcp_desk_open(&v.desk, o)) outcome = VS_OUTCOME_MACHINE;
  size_t length = 0;
  char *line;
  while (outcome == VS_OUTCOME_DONE && !ferror(stdout) && (line = mcp_next_line(&v.desk.process, &length))) {
    if (strspn(line, " \t\r") == length) continue;
    cli_data m = cli_data_read(&v.json, line, length);
    if (m) handle(&v, m);
    else send_error(&v, NULL, BAD_JSON, "this line is no JSON");
    cli_data_free(&v.json, m);
  }
  mcp_desk_close(&v.desk);
  free(v.desk.process.input);
  cli_data_close(&v.json);
  return outcome != VS_OUTCOME_DONE ? outcome : *interrupts ? VS_OUTCOME_INTERRUPTED : VS_OUTCOME_DONE;
}
