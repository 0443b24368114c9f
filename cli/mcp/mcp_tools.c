/* Implements the tools of an assistant: each runs a command of vs on the program, and answers with the command's text
 * and picture. */
#include "cli/mcp/mcp_tools.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "languages/analysis/notation.h"
#include "model/store/array.h"

enum { PATH_ROOM = 4200, MOST_SETTINGS = 40, MOST_NUMBERS = 6 };

/* ---- the private folder ---- */

static const char PROGRAM_FILE[] = "model.vs", PICTURE_FILE[] = "picture.png";

bool mcp_desk_open(mcp_desk *d, const cli_options *o) {
  const char *temporary = getenv("TMPDIR");
  char path[PATH_ROOM - 20];
  d->options = o;
  int n = snprintf(path, sizeof path, "%s/visualscheme-XXXXXX", temporary && *temporary == '/' ? temporary : "/tmp");
  if (n < (int)sizeof path && mkdtemp(path)) d->folder = strdup(path);
  if (!d->folder) fprintf(stderr, "vs mcp: a private folder: %s\n", strerror(errno));
  return d->folder != NULL;
}

static void path_in(const mcp_desk *d, const char *name, char path[PATH_ROOM]) {
  snprintf(path, PATH_ROOM, "%s/%s", d->folder, name);
}

void mcp_desk_close(mcp_desk *d) {
  char path[PATH_ROOM];
  if (d->folder) {
    path_in(d, PROGRAM_FILE, path);
    remove(path);
    path_in(d, PICTURE_FILE, path);
    remove(path);
    rmdir(d->folder);
  }
  free(d->folder);
  free(d->model);
  d->folder = d->model = NULL;
}

/* ---- the parts of a call ---- */

enum {
#define MCP_ARGUMENT(id, name, schema, description) ARGUMENT_##id,
#include "cli/mcp/mcp_arguments.def"
  ARGUMENTS
};
static const struct { const char *name, *schema, *description; } argument_rows[] = {
#define MCP_ARGUMENT(id, name, schema, description) { name, schema, description },
#include "cli/mcp/mcp_arguments.def"
};

typedef struct {
  mcp_desk *desk;
  cli_data arguments;
  mcp_command command;
  const char *fault;      /* the reason why the call of the tool is refused, or NULL */
  char *texts[MOST_SETTINGS]; size_t text_count; /* words of the command, which the call owns */
  char numbers[MOST_NUMBERS][32]; size_t number_count;
  char path[PATH_ROOM];   /* path of the command's output file */
  bool picture;           /* whether the output file is a picture that belongs to the answer */
} call;

static const char *argument(const call *c, int id) {
  return cli_data_text(c->desk->process.json, c->arguments, argument_rows[id].name, NULL);
}

static void fault(call *c, const char *why) {
  if (!c->fault) c->fault = why;
}

static void option(call *c, const char *name, const char *value) {
  if (!value) return;
  mcp_word(&c->command, name);
  mcp_word(&c->command, value);
}

/* Begins a word that the call owns. end_word ends it, and returns the word, or NULL after a fault. */
static FILE *begin_word(call *c, size_t *length) {
  FILE *to = c->text_count < MOST_SETTINGS ? open_memstream(&c->texts[c->text_count], length) : NULL;
  if (!to) fault(c, c->text_count < MOST_SETTINGS ? "out of memory" : "there are too many parameters");
  return to;
}

static const char *end_word(call *c, FILE *to) {
  if (to && fclose(to) == 0) return c->texts[c->text_count++];
  fault(c, "out of memory");
  return NULL;
}

/* Returns true for a relative path that does not leave its folder. */
static bool is_below(const char *path) {
  if (!*path || *path == '/' || *path == '-' || strlen(path) > 2000) return false;
  while (true) {
    size_t n = strcspn(path, "/");
    if (!n || (n <= 2 && !strncmp(path, "..", n))) return false;
    if (!path[n]) return true;
    path += n + 1;
  }
}

/* ---- the program of a call ---- */

static void keep_program(call *c, const char *text, size_t length) {
  mcp_desk *d = c->desk;
  char path[PATH_ROOM];
  path_in(d, PROGRAM_FILE, path);
  FILE *to = fopen(path, "wb");
  bool ok = to && fwrite(text, 1, length, to) == length;
  if (to) ok = fclose(to) == 0 && ok;
  free(d->model);
  d->model = ok ? strdup(PROGRAM_FILE) : NULL, d->own = true;
  if (!d->model) fault(c, "the program could not be kept in a file");
}

/* Finds the program of the call: the text or the file in its arguments, otherwise the program of the last call. */
static void take_model(call *c) {
  mcp_desk *d = c->desk;
  size_t length = 0;
  const char *text = cli_data_text(d->process.json, c->arguments, argument_rows[ARGUMENT_PROGRAM].name, &length);
  const char *file = argument(c, ARGUMENT_FILE);
  if (text && file) fault(c, "give program or file, not both");
  else if (text) keep_program(c, text, length);
  else if (file && !is_below(file)) fault(c, "file is a path in the folder of vs mcp or below it, without ..");
  else if (file) {
    free(d->model);
    d->model = strdup(file), d->own = false;
  }
  if (!d->model) fault(c, "there is no program yet: give program or file");
  else c->command.folder = d->own ? d->folder : NULL;
}

static void limit(call *c, const char *name, double value) {
  if (value <= 0 || c->number_count == MOST_NUMBERS) return;
  char *text = c->numbers[c->number_count++];
  snprintf(text, sizeof *c->numbers, "%.15g", value);
  option(c, name, text);
}

/* Passes the values of the program's parameters to the command. A text is the value itself if the parameter's default
 * is a text, otherwise a datum. */
static void take_parameters(call *c) {
  const cli_data_reader *json = c->desk->process.json;
  cli_data all = cli_data_at(json, c->arguments, argument_rows[ARGUMENT_PARAMETERS].name);
  for (cli_data_member m = cli_data_first(json, all); m && !c->fault; m = cli_data_next(json, all, m)) {
    size_t length = 0;
    const char *text = cli_data_text(json, cli_data_value(json, m), "", NULL);
    FILE *to = begin_word(c, &length);
    if (!to) return;
    fprintf(to, "%s=%s", cli_data_key(json, m), text ? text : "");
    if (!text && !cli_data_put_datum(json, cli_data_value(json, m), to))
      fault(c, "the value of a parameter is a number, a text, true or false");
    option(c, "-D", end_word(c, to));
  }
}

/* Begins the words of a command that runs the program, confined and with limits. */
static void begin_run(call *c) {
  const vs_options *o = &c->desk->options->interpreter;
  mcp_word(&c->command, "vs");
  mcp_word(&c->command, "--untrusted");
  limit(c, "--limit-time", o->limit_time);
  limit(c, "--limit-memory", (double)o->limit_memory / 1048576);
  limit(c, "--limit-steps", (double)o->limit_steps);
  limit(c, "--limit-output", (double)o->limit_output / 1048576);
  limit(c, "--limit-triangles", (double)o->limit_triangles);
  limit(c, "--limit-worker", o->limit_worker);
  take_model(c);
  take_parameters(c);
  if (c->desk->model) mcp_word(&c->command, c->desk->model);
}

static void take_picture(call *c) {
  path_in(c->desk, PICTURE_FILE, c->path);
  remove(c->path);
  c->picture = true;
  const char *size = argument(c, ARGUMENT_SIZE);
  option(c, "--size", size ? size : "640x480");
  option(c, "-o", c->path);
}

/* ---- the tools ---- */

#define MCP_PROGRAM(name, text) static const char program_##name[] = text;
#include "cli/mcp/mcp_programs.def"

typedef void mcp_tool(call *c);

static void mcp_help(call *c) {
  const char *word = argument(c, ARGUMENT_WORD);
  mcp_word(&c->command, "vs");
  mcp_word(&c->command, "help");
  if (word && *word && *word != '-') mcp_word(&c->command, word);
  else fault(c, "word is a name of the language, or words of the trade");
}

static void mcp_check(call *c) {
  mcp_word(&c->command, "vs");
  mcp_word(&c->command, "check");
  take_model(c);
  if (c->desk->model) mcp_word(&c->command, c->desk->model);
  c->command.reads_only = true;
}

static void mcp_run(call *c) { begin_run(c); }

static void mcp_picture(call *c) {
  static const char *const views[] = { "iso", "top", "bottom", "front", "back", "left", "right" };
  const char *view = argument(c, ARGUMENT_VIEW), *camera = argument(c, ARGUMENT_CAMERA);
  size_t length = 0;
  bool known = false;
  begin_run(c);
  for (size_t i = 0; view && i < sizeof views / sizeof *views; i++) known = known || !strcmp(view, views[i]);
  if (known) {
    FILE *to = begin_word(c, &length);
    if (to) fprintf(to, "(eval '(view-from '%s) (environment '(visualscheme)))", view);
    option(c, "-e", end_word(c, to));
  } else option(c, "--view", view);
  option(c, "--camera", camera);
  take_picture(c);
}

static void mcp_measure(call *c) {
  size_t length = 0;
  begin_run(c);
  FILE *to = begin_word(c, &length);
  if (to) fprintf(to, "(eval '(let ()\n%s%s", program_common, program_measures);
  option(c, "-e", end_word(c, to));
}

static void mcp_section(call *c) {
  const char *plane = argument(c, ARGUMENT_PLANE);
  size_t length = 0;
  if (!plane) plane = "xy";
  if (strcmp(plane, "xy") && strcmp(plane, "xz") && strcmp(plane, "yz")) fault(c, "plane is xy, xz or yz");
  begin_run(c);
  FILE *to = begin_word(c, &length);
  double at = cli_data_real(c->desk->process.json, c->arguments, argument_rows[ARGUMENT_AT].name, 0);
  if (to && !c->fault)
    fprintf(to, "(eval '(let ([plane '%s] [at %.17g])\n%s%s", plane, at, program_common, program_cut);
  option(c, "-e", end_word(c, to));
  take_picture(c);
}

static void mcp_export(call *c) {
  const char *path = argument(c, ARGUMENT_PATH);
  char here[PATH_ROOM / 2];
  begin_run(c);
  if (!path || !is_below(path)) fault(c, "path is a file in the folder of vs mcp or below it, without ..");
  else if (!getcwd(here, sizeof here)) fault(c, "the folder of vs mcp is not known");
  else snprintf(c->path, sizeof c->path, "%s%s%s", c->desk->own ? here : "", c->desk->own ? "/" : "", path);
  option(c, "-o", c->path);
}

/* ---- the answer ---- */

/* Writes the file as base64. Returns false if it cannot be read. */
static bool put_file(const char *path, FILE *to) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  FILE *from = fopen(path, "rb");
  unsigned char b[3];
  size_t n;
  if (!from) return false;
  while ((n = fread(b, 1, 3, from)) > 0) {
    for (size_t i = n; i < 3; i++) b[i] = 0;
    char four[5] = { digits[b[0] >> 2], digits[(b[0] & 3) << 4 | b[1] >> 4],
                     n > 1 ? digits[(b[1] & 15) << 2 | b[2] >> 6] : '=', n > 2 ? digits[b[2] & 63] : '=', 0 };
    fputs(four, to);
  }
  return fclose(from) == 0;
}

static const char *reason(int code) {
  switch (code) {
  case VS_OUTCOME_DONE: return "";
  case VS_OUTCOME_MODEL: return "The program is at fault.\n";
  case VS_OUTCOME_USAGE: return "The call is at fault, or a file cannot be read or written.\n";
  case VS_OUTCOME_WORKER: return "A worker program is missing or failed.\n";
  case VS_OUTCOME_MACHINE: return "The program reached a limit, or the machine failed.\n";
  case MCP_CANCELLED: return "The request was cancelled.\n";
  case MCP_NO_PROCESS: return "No process could be started.\n";
  case MCP_TOO_LONG: return "The command took too long.\n";
  default: return "The command ended early.\n";
  }
}

static void put_text(FILE *to, const char *text, size_t length) {
  fputs("{\"type\":\"text\",\"text\":", to);
  know_json_text(to, text, length);
  fputc('}', to);
}

static void put_answer(call *c, int code, bool findings, FILE *to) {
  char *text = NULL;
  size_t length = 0;
  FILE *said = open_memstream(&text, &length);
  if (said) {
    if (c->command.said) fwrite(c->command.said, 1, c->command.said_count, said);
    if (c->fault) fprintf(said, "%s\n", c->fault);
    else if (!findings) fputs(reason(code), said);
    else if (!code) fputs("no likely mistake\n", said);
    fclose(said);
  }
  fputs("{\"content\":[", to);
  put_text(to, length ? text : "done\n", length ? length : 5);
  if (c->picture && !c->fault && access(c->path, R_OK) == 0) {
    fputs(",{\"type\":\"image\",\"mimeType\":\"image/png\",\"data\":\"", to);
    put_file(c->path, to);
    fputs("\"}", to);
  }
  bool failed = c->fault || (code && !(findings && code == VS_OUTCOME_MODEL));
  fprintf(to, "],\"isError\":%s}", failed ? "true" : "false");
  free(text);
}

/* ---- the table of the tools ---- */

#define TAKES(id) (1u << ARGUMENT_##id)
#define MODEL (TAKES(PROGRAM) | TAKES(FILE))
static const struct { const char *name, *description; mcp_tool *tool; unsigned takes, needs; } tools[] = {
#define MCP_TOOL(name, function, takes, needs, description) { #name, description, function, takes, needs },
#include "cli/mcp/mcp_tools.def"
};

void mcp_list_tools(FILE *to) {
  for (size_t i = 0; i < sizeof tools / sizeof *tools; i++) {
    fprintf(to, "%s{\"name\":\"%s\",\"description\":", i ? "," : "", tools[i].name);
    know_json_text(to, tools[i].description, strlen(tools[i].description));
    fputs(",\"inputSchema\":{\"type\":\"object\",\"properties\":{", to);
    const char *comma = "";
    for (int k = 0; k < ARGUMENTS; k++) {
      if (!(tools[i].takes >> k & 1)) continue;
      fprintf(to, "%s\"%s\":{%s,\"description\":", comma, argument_rows[k].name, argument_rows[k].schema);
      know_json_text(to, argument_rows[k].description, strlen(argument_rows[k].description));
      fputc('}', to);
      comma = ",";
    }
    fputs("},\"required\":[", to);
    comma = "";
    for (int k = 0; k < ARGUMENTS; k++)
      if (tools[i].needs >> k & 1) fprintf(to, "%s\"%s\"", comma, argument_rows[k].name), comma = ",";
    fputs("]}}", to);
  }
}

bool mcp_call_tool(mcp_desk *d, const char *name, cli_data arguments, FILE *to) {
  size_t i = 0;
  while (i < sizeof tools / sizeof *tools && strcmp(tools[i].name, name)) i++;
  if (i == sizeof tools / sizeof *tools) return false;
  call *c = vs_zeros(1, sizeof *c);
  if (!c) return false;
  c->desk = d, c->arguments = arguments;
  tools[i].tool(c);
  int code = c->fault ? VS_OUTCOME_USAGE : mcp_run_command(&d->process, &c->command);
  put_answer(c, code, tools[i].tool == mcp_check, to);
  mcp_command_free(&c->command);
  for (size_t k = 0; k < c->text_count; k++) free(c->texts[k]);
  free(c);
  return true;
}
