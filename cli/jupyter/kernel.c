/* Runs the cells of a notebook: one program, in one interpreter. A cell that changes the drawing shows the page's
 * viewer. */
#include "cli/jupyter/kernel.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/jupyter/kernel_wire.h"
#include "cli/prompt/source_text.h"
#include "languages/analysis/notation.h"

typedef struct {
  kernel_wire wire;
  vs_scheme *scheme;
  const cli_options *options;
  const volatile sig_atomic_t *interrupts;
  sig_atomic_t seen;          /* number of the user's interrupts before the running cell */
  pid_t parent;               /* the process that started the kernel and ends it, or 0 */
  const wire_message *cell;   /* the message that is being answered, or NULL */
  unsigned count;             /* number of the cell */
  char *value;                /* the last value of the cell, which is its result */
  char error[600];            /* the first error of the cell; "": none */
  bool silent, over;
} kernel;

/* ---- messages in memory ---- */

typedef struct { FILE *to; char *text; size_t length; } content;

static bool begin(content *c) {
  *c = (content){ 0 };
  c->to = open_memstream(&c->text, &c->length);
  return c->to != NULL;
}

static void put(content *c, const char *key, const char *text, size_t length) {
  fputs(key, c->to);
  know_json_text(c->to, text, length);
}

static void publish(kernel *k, content *c, const char *type) {
  if (fclose(c->to) == 0) wire_publish(&k->wire, k->cell, type, c->text);
  free(c->text);
}

static void reply(kernel *k, content *c, const char *type) {
  if (fclose(c->to) == 0) wire_reply(&k->wire, k->cell, type, c->text);
  free(c->text);
}

static void status(kernel *k, const char *state) {
  content c;
  if (!begin(&c)) return;
  fprintf(c.to, "{\"execution_state\":\"%s\"}", state);
  publish(k, &c, "status");
}

/* ---- output and messages of the running cell ---- */

static void stream(kernel *k, const char *name, const char *text, size_t length) {
  content c;
  if (k->silent || !k->cell || !begin(&c)) return;
  fprintf(c.to, "{\"name\":\"%s\"", name);
  put(&c, ",\"text\":", text, length);
  fputc('}', c.to);
  publish(k, &c, "stream");
}

static bool print(void *context, const char *text, size_t length) {
  stream(context, "stdout", text, length);
  return true;
}

/* Receives a value of the cell. The last value is kept as the cell's result; the values before it are printed. */
static void take_value(void *context, const char *text, size_t length) {
  kernel *k = context;
  content line;
  if (k->value && begin(&line)) {
    fprintf(line.to, "%s\n", k->value);
    if (fclose(line.to) == 0) stream(k, "stdout", line.text, line.length);
    free(line.text);
  }
  free(k->value);
  k->value = strndup(text, length);
}

static void diagnose(void *context, const vs_diagnostic *d) {
  kernel *k = context;
  static const char *const words[] = { [VS_SEVERITY_ERROR] = "", [VS_SEVERITY_WARNING] = "warning: ",
                                       [VS_SEVERITY_NOTE] = "note: " };
  content c;
  if (!k->cell || !begin(&c)) return;
  if (d->at.file) fprintf(c.to, "%s:%u:%u: ", d->at.file, (unsigned)d->at.line, (unsigned)d->at.column);
  fprintf(c.to, "%s%s\n", words[d->severity], d->message);
  if (d->source_line && d->at.line) fprintf(c.to, "%5u | %s\n", (unsigned)d->at.line, d->source_line);
  for (size_t i = 0; i < d->note_count; i++) {
    const vs_diagnostic_note *n = &d->notes[i];
    if (n->at.file) fprintf(c.to, "%s:%u:%u: ", n->at.file, (unsigned)n->at.line, (unsigned)n->at.column);
    fprintf(c.to, "%s\n", n->message);
  }
  if (fclose(c.to) == 0) {
    if (d->severity == VS_SEVERITY_ERROR && !*k->error) snprintf(k->error, sizeof k->error, "%s", c.text);
    else stream(k, "stderr", c.text, c.length);
  }
  free(c.text);
}

/* Returns true if the process that started the kernel has ended, so that nobody can end the kernel. */
static bool is_orphan(const kernel *k) { return k->parent && getppid() != k->parent; }

static bool is_interrupted(void *context) {
  const kernel *k = context;
  return *k->interrupts != k->seen || is_orphan(k);
}

/* ---- cells ---- */

static bool add_text(void *context, const void *text, size_t length) {
  return fwrite(text, 1, length, (FILE *)context) == length;
}

/* Shows the drawing in the page's viewer. */
static void show(kernel *k) {
  content page, frame, c;
  vs_output_options o = k->options->output;
  if (!begin(&page)) return;
  bool ok = vs_write_drawing_to(k->scheme, "html", &o, add_text, page.to) == VS_OUTCOME_DONE;
  ok = fclose(page.to) == 0 && ok && begin(&frame);
  if (ok) {
    fputs("<iframe style=\"width:100%;height:420px;border:0\" sandbox=\"allow-scripts\" srcdoc=\"", frame.to);
    know_xml_text(frame.to, page.text, page.length);
    fputs("\"></iframe>", frame.to);
    ok = fclose(frame.to) == 0;
    if (ok && begin(&c)) {
      put(&c, "{\"data\":{\"text/html\":", frame.text, frame.length);
      fputs(",\"text/plain\":\"the drawing\"},\"metadata\":{},\"transient\":{}}", c.to);
      publish(k, &c, "display_data");
    }
    free(frame.text);
  }
  free(page.text);
}

static bool is_same_drawing(const vs_summary *a, const vs_summary *b) {
  return a->objects == b->objects && a->has_bounds == b->has_bounds && !memcmp(a->min, b->min, sizeof a->min) &&
         !memcmp(a->max, b->max, sizeof a->max);
}

static void put_error(kernel *k, content *c) {
  size_t n = strlen(k->error);
  while (n && k->error[n - 1] == '\n') n--;
  put(c, "\"ename\":\"error\",\"evalue\":", k->error, strcspn(k->error, "\n"));
  put(c, ",\"traceback\":[", k->error, n);
  fputc(']', c->to);
}

static void end_cell(kernel *k, bool failed, bool counted) {
  content c;
  if (!failed && k->value && !k->silent && begin(&c)) {
    fprintf(c.to, "{\"execution_count\":%u,\"metadata\":{}", k->count);
    put(&c, ",\"data\":{\"text/plain\":", k->value, strlen(k->value));
    fputs("}}", c.to);
    publish(k, &c, "execute_result");
  }
  if (failed && begin(&c)) {
    fputc('{', c.to);
    put_error(k, &c);
    fputc('}', c.to);
    publish(k, &c, "error");
  }
  free(k->value);
  k->value = NULL;
  if (!begin(&c)) return;
  fprintf(c.to, "{\"status\":\"%s\",\"execution_count\":%u", failed ? "error" : "ok", counted ? k->count : 0);
  if (failed) fputc(',', c.to), put_error(k, &c);
  else fputs(",\"payload\":[],\"user_expressions\":{}", c.to);
  fputc('}', c.to);
  reply(k, &c, "execute_reply");
}

static void answer_execute(kernel *k) {
  size_t length = 0;
  const char *code = cli_data_text(&k->wire.json, k->cell->content, "code", &length);
  char name[40];
  content c;
  vs_summary before = { 0 }, after = { 0 };
  k->silent = cli_data_true(&k->wire.json, k->cell->content, "silent");
  if (!code) code = "", length = 0;
  if (!k->silent) k->count++;
  snprintf(name, sizeof name, "In [%u]", k->count);
  if (!k->silent && begin(&c)) {
    fprintf(c.to, "{\"execution_count\":%u", k->count);
    put(&c, ",\"code\":", code, length);
    fputc('}', c.to);
    publish(k, &c, "execute_input");
  }
  *k->error = 0, k->seen = *k->interrupts;
  vs_drawing_summary(k->scheme, &before);
  vs_outcome outcome = vs_eval_text(k->scheme, name, 1, code, length, VS_EVAL_PRINT);
  bool failed = outcome != VS_OUTCOME_DONE;
  int ignored;
  if (failed && !*k->error) snprintf(k->error, sizeof k->error, "the cell was ended");
  if (!failed && vs_exit_requested(k->scheme, &ignored)) k->over = true;
  if (!failed && !k->silent && vs_drawing_summary(k->scheme, &after) == VS_OUTCOME_DONE && after.objects &&
      !is_same_drawing(&before, &after)) show(k);
  end_cell(k, failed, !k->silent);
}

/* ---- help with the text ---- */

/* Returns the number of bytes of the first `characters` code points of the text, since Jupyter counts in code
 * points. */
static size_t bytes_of(const char *text, size_t length, long long characters) {
  size_t n = 0;
  for (; n < length; n++)
    if ((text[n] & 0xC0) != 0x80 && characters-- == 0) break;
  return n;
}

static size_t characters_of(const char *text, size_t bytes) {
  size_t n = 0;
  for (size_t i = 0; i < bytes; i++) n += (text[i] & 0xC0) != 0x80;
  return n;
}

static bool is_of_name(char c) { return !strchr(" \t\r\n()[]{}\"';`,", c); }

/* Sets code to the cell's text, and *from and *to to the word at the cursor. Without `whole`, the word ends at the
 * cursor. */
static const char *word_at(kernel *k, bool whole, size_t *from, size_t *to) {
  size_t length = 0;
  const char *code = cli_data_text(&k->wire.json, k->cell->content, "code", &length);
  if (!code) code = "", length = 0;
  *to = *from = bytes_of(code, length, cli_data_number(&k->wire.json, k->cell->content, "cursor_pos", 0));
  while (*from && is_of_name(code[*from - 1])) (*from)--;
  while (whole && *to < length && is_of_name(code[*to])) (*to)++;
  return code;
}

typedef struct { content *c; const char *comma; } names;

static bool add_name(void *context, const char *name) {
  names *n = context;
  put(n->c, n->comma, name, strlen(name));
  n->comma = ",";
  return true;
}

static void answer_complete(kernel *k) {
  size_t from, to;
  const char *code = word_at(k, false, &from, &to);
  char prefix[200];
  content c;
  if (!begin(&c)) return;
  names n = { &c, "" };
  snprintf(prefix, sizeof prefix, "%.*s", (int)(to - from), code + from);
  fputs("{\"status\":\"ok\",\"matches\":[", c.to);
  vs_complete(k->scheme, prefix, add_name, &n);
  fprintf(c.to, "],\"cursor_start\":%zu,\"cursor_end\":%zu,\"metadata\":{}}", characters_of(code, from),
          characters_of(code, to));
  reply(k, &c, "complete_reply");
}

static void answer_inspect(kernel *k) {
  size_t from, to;
  const char *code = word_at(k, true, &from, &to);
  char name[200];
  vs_name_info info;
  content c, text;
  snprintf(name, sizeof name, "%.*s", (int)(to - from), code + from);
  bool found = *name && vs_name_get(k->scheme, name, &info);
  if (!begin(&c)) return;
  if (found && begin(&text)) {
    fprintf(text.to, "%s\n%s\n%s", *info.call ? info.call : name, info.keywords, *info.doc ? info.doc : info.value);
    fputs("{\"status\":\"ok\",\"found\":true,\"metadata\":{}", c.to);
    if (fclose(text.to) == 0) put(&c, ",\"data\":{\"text/plain\":", text.text, text.length);
    fputs("}}", c.to);
    free(text.text);
  } else fputs("{\"status\":\"ok\",\"found\":false,\"data\":{},\"metadata\":{}}", c.to);
  reply(k, &c, "inspect_reply");
}

static void answer_is_complete(kernel *k) {
  size_t length = 0;
  const char *code = cli_data_text(&k->wire.json, k->cell->content, "code", &length);
  vs_read_status s = vs_read_check(k->scheme, code ? code : "", length);
  const char *word = s.state == VS_READ_INCOMPLETE ? "incomplete" : s.state == VS_READ_BAD ? "invalid" : "complete";
  content c;
  if (!begin(&c)) return;
  fprintf(c.to, "{\"status\":\"%s\",\"indent\":\"%s\"}", word, s.state == VS_READ_INCOMPLETE ? "  " : "");
  reply(k, &c, "is_complete_reply");
}

/* ---- the kernel ---- */

static void answer_information(kernel *k) {
  wire_reply(&k->wire, k->cell, "kernel_info_reply",
             "{\"status\":\"ok\",\"protocol_version\":\"5.3\",\"implementation\":\"vs\",\"implementation_version\":\""
             VS_VERSION "\",\"language_info\":{\"name\":\"scheme\",\"version\":\"R7RS\",\"mimetype\":\"text/x-scheme\","
             "\"file_extension\":\".vs\",\"pygments_lexer\":\"scheme\",\"codemirror_mode\":\"scheme\"},"
             "\"banner\":\"VisualScheme " VS_VERSION "\",\"help_links\":[]}");
}

static void answer_shutdown(kernel *k) {
  bool again = cli_data_true(&k->wire.json, k->cell->content, "restart");
  wire_reply(&k->wire, k->cell, "shutdown_reply",
             again ? "{\"status\":\"ok\",\"restart\":true}" : "{\"status\":\"ok\",\"restart\":false}");
  k->over = true;
}

static void answer_history(kernel *k) {
  wire_reply(&k->wire, k->cell, "history_reply", "{\"status\":\"ok\",\"history\":[]}");
}

static void answer_comms(kernel *k) {
  wire_reply(&k->wire, k->cell, "comm_info_reply", "{\"status\":\"ok\",\"comms\":{}}");
}

static const struct { const char *type; void (*answer)(kernel *k); } answers[] = {
  { "kernel_info_request", answer_information }, { "execute_request", answer_execute },
  { "complete_request", answer_complete },       { "inspect_request", answer_inspect },
  { "is_complete_request", answer_is_complete }, { "shutdown_request", answer_shutdown },
  { "history_request", answer_history },         { "comm_info_request", answer_comms },
};

static void handle(kernel *k, const wire_message *m) {
  const char *type = cli_data_text(&k->wire.json, m->head, "msg_type", NULL);
  k->cell = m;
  status(k, "busy");
  for (size_t i = 0; i < sizeof answers / sizeof *answers; i++)
    if (!strcmp(answers[i].type, type)) answers[i].answer(k);
  status(k, "idle");
  k->cell = NULL;
}

vs_outcome kernel_run(const cli_options *o, const char *connection_file, const volatile sig_atomic_t *interrupts,
                      const volatile sig_atomic_t *ended) {
  kernel k = { .options = o, .interrupts = interrupts };
  const char *owner = getenv("JPY_PARENT_PID"); /* the number of the process with which the kernel is to end; Jupyter
                                                 * sets it */
  if (owner && strtol(owner, NULL, 10) == (long)getppid()) k.parent = getppid();
  bool missing = false;
  if (!wire_open(&k.wire, connection_file, &missing)) {
    wire_close(&k.wire);
    return missing ? VS_OUTCOME_WORKER : VS_OUTCOME_USAGE;
  }
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){ .context = &k, .output = print, .diagnose = diagnose, .value = take_value,
                                .poll = is_interrupted };
  k.scheme = vs_new(&interpreter);
  if (!k.scheme) fputs("vs: out of memory\n", stderr);
  while (k.scheme && !k.over && !*ended && !is_orphan(&k)) {
    wire_message m;
    if (!wire_receive(&k.wire, &m, 500)) continue;
    handle(&k, &m);
    wire_message_free(&k.wire, &m);
  }
  vs_outcome outcome = k.scheme ? VS_OUTCOME_DONE : VS_OUTCOME_MACHINE;
  vs_free(k.scheme);
  wire_close(&k.wire);
  return outcome;
}
