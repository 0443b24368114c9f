/* Owns the prompt: reads lines until they are whole data, evaluates them, prints their values; an error does not end it.
 *
 * On a terminal libedit edits the lines: history from one session to the next, completion by tab. Without one (a pipe) lines are read as they
 * come and no prompt is shown. A line that begins with a comma is a command to the prompt itself. */
#include <errno.h>
#include <histedit.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/nearby.h"
#include "cli/command.h"

enum { HISTORY_LINES = 2000 };

struct cli_editor {
  cli_session *session;
  EditLine *line;
  History *history;
  char *history_path;   /* NULL: none could be found or made */
  const char *prompt;
};

/* ---- a growing text ---- */

typedef struct { char *at; size_t length, room; } text;

static bool text_add(text *t, const char *more, size_t length) {
  if (t->room - t->length <= length) {
    size_t room = (t->length + length + 1) * 2;
    char *grown = realloc(t->at, room);
    if (!grown) return false;
    t->at = grown;
    t->room = room;
  }
  memcpy(t->at + t->length, more, length);
  t->length += length;
  t->at[t->length] = 0;
  return true;
}

/* ---- history ---- */

/* $XDG_STATE_HOME/visualscheme/history, its folders made; allocated, or NULL. */
static char *history_path(void) {
  const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
  const char *const tail = "/visualscheme/history";
  bool own = state && *state == '/';
  if (!own && (!home || *home != '/')) return NULL;
  const char *base = own ? state : home, *middle = own ? "" : "/.local/state";
  size_t room = strlen(base) + strlen(middle) + strlen(tail) + 1;
  char *path = malloc(room);
  if (!path) return NULL;
  snprintf(path, room, "%s%s%s", base, middle, tail);
  for (char *slash = path; (slash = strchr(slash + 1, '/')) != NULL;) {
    *slash = 0;
    bool ok = mkdir(path, 0700) == 0 || errno == EEXIST;
    *slash = '/';
    if (!ok) {
      free(path);
      return NULL;
    }
  }
  return path;
}

/* ---- completion ---- */

typedef struct { char **at; size_t count, room; bool failed; } names;

static bool collect(void *context, const char *name) {
  names *n = context;
  if (n->count == n->room) {
    size_t room = n->room ? n->room * 2 : 64;
    char **grown = realloc(n->at, room * sizeof *grown);
    if (!grown) return !(n->failed = true);
    n->at = grown;
    n->room = room;
  }
  n->at[n->count] = strdup(name);
  n->failed = !n->at[n->count];
  if (!n->failed) n->count++;
  return !n->failed;
}

static void print_names(const names *n) {
  enum { SCREEN = 80, MOST = 200 };
  size_t widest = 0, shown = n->count < MOST ? n->count : MOST;
  for (size_t i = 0; i < shown; i++)
    if (strlen(n->at[i]) > widest) widest = strlen(n->at[i]);
  size_t across = SCREEN / (widest + 2) ? SCREEN / (widest + 2) : 1;
  putchar('\n');
  for (size_t i = 0; i < shown; i++) printf("%-*s%s", (int)widest + 2, n->at[i], (i + 1) % across == 0 || i + 1 == shown ? "\n" : "");
  if (shown < n->count) printf("... and %zu more\n", n->count - shown);
}

static unsigned char complete(EditLine *line, int key) {
  (void)key;
  struct cli_editor *e;
  if (el_get(line, EL_CLIENTDATA, &e) != 0) return CC_ERROR;
  const LineInfo *info = el_line(line);
  const char *start = info->cursor;
  while (start > info->buffer && !strchr(" \t\n()[]'`,;\"", start[-1])) start--;
  size_t length = (size_t)(info->cursor - start);
  char *prefix = malloc(length + 1);
  if (!prefix) return CC_ERROR;
  memcpy(prefix, start, length);
  prefix[length] = 0;
  names n = {0};
  if (length) vs_complete(e->session->scheme, prefix, collect, &n);
  free(prefix);
  size_t common = n.count ? strlen(n.at[0]) : 0;
  for (size_t i = 1; i < n.count; i++) {
    size_t same = 0;
    while (same < common && n.at[i][same] == n.at[0][same]) same++;
    common = same;
  }
  while (common > length && ((unsigned char)n.at[0][common] & 0xC0) == 0x80) common--; /* whole characters only */
  unsigned char result = CC_ERROR;
  if (common > length || n.count == 1) {
    n.at[0][common] = 0;
    bool ok = common == length || el_insertstr(line, n.at[0] + length) == 0;
    if (ok && n.count == 1) ok = el_insertstr(line, " ") == 0;
    result = ok ? CC_REFRESH : CC_ERROR;
  } else if (n.count) {
    print_names(&n);
    result = CC_REDISPLAY;
  }
  for (size_t i = 0; i < n.count; i++) free(n.at[i]);
  free(n.at);
  return result;
}

/* ---- the editor ---- */

static char *prompt_text(EditLine *line) {
  struct cli_editor *e;
  return (char *)(el_get(line, EL_CLIENTDATA, &e) == 0 ? e->prompt : "");
}

static void editor_close(struct cli_editor *e) {
  HistEvent event;
  if (e->history && e->history_path && history(e->history, &event, H_SAVE, e->history_path) >= 0) chmod(e->history_path, 0600);
  if (e->line) el_end(e->line);
  if (e->history) history_end(e->history);
  free(e->history_path);
}

static bool editor_open(struct cli_editor *e, cli_session *c) {
  HistEvent event;
  *e = (struct cli_editor){.session = c, .prompt = "> "};
  setlocale(LC_CTYPE, "");
  e->line = el_init("vs", stdin, stdout, stderr);
  e->history = history_init();
  if (!e->line || !e->history) {
    editor_close(e);
    return false;
  }
  history(e->history, &event, H_SETSIZE, HISTORY_LINES);
  history(e->history, &event, H_SETUNIQUE, 1);
  e->history_path = history_path();
  if (e->history_path) history(e->history, &event, H_LOAD, e->history_path);
  el_set(e->line, EL_CLIENTDATA, e);
  el_set(e->line, EL_PROMPT, prompt_text);
  el_set(e->line, EL_EDITOR, "emacs");
  el_set(e->line, EL_HIST, history, e->history);
  el_set(e->line, EL_ADDFN, "vs-complete", "complete the name before the cursor", complete);
  el_set(e->line, EL_BIND, "^I", "vs-complete", NULL);
  el_set(e->line, EL_BIND, "^R", "em-inc-search-prev", NULL);
  return true;
}

/* The next line with its newline, or NULL: the end, or an interrupt (errno EINTR). */
static const char *next_line(cli_session *c, const char *prompt, size_t *length) {
  errno = 0;
  if (!c->editor) {
    ssize_t got = getline(&c->line, &c->line_room, stdin);
    if (got < 0) return NULL;
    *length = (size_t)got;
    return c->line;
  }
  c->editor->prompt = prompt;
  int count = 0;
  const char *line = el_gets(c->editor->line, &count);
  if (!line || count <= 0) return NULL;
  *length = (size_t)count;
  HistEvent event;
  if (strspn(line, " \t\r\n") < *length) history(c->editor->history, &event, H_ENTER, line);
  return line;
}

const char *cli_repl_line(cli_session *c, size_t *length) { return next_line(c, "", length); }

/* ---- commands ---- */

static void command_help(void);

static void write_file(cli_session *c, const char *path) {
  vs_format_info format;
  cli_target target = {path, *path && vs_format_of(c->scheme, path, &format) ? format.name : NULL};
  if (!*path) {
    fputs(",write needs a file name, as in ,write house.png\n", stderr);
  } else if (!target.format) {
    fprintf(stderr, "%s: the ending says no format; there are %s\n", path, vs_format_endings());
  } else if (cli_session_write(c, &target) == VS_OUTCOME_DONE) {
    printf("; wrote %s\n", path);
  }
}

/* FILE, or what was run last, from the start. */
static vs_outcome run_model(cli_session *c, const char *path) {
  const cli_options *o = c->options;
  if (*path && access(path, R_OK) != 0) {
    fprintf(stderr, "%s: %s\n", path, strerror(errno));
    return VS_OUTCOME_USAGE;
  }
  if (*path) {
    char *copy = strdup(path);
    if (!copy) {
      fputs("vs: out of memory\n", stderr);
      return VS_OUTCOME_MACHINE;
    }
    free(c->model);
    c->model = copy;
  } else if (!c->model && !o->source_count) {
    fputs(",run needs a file, as in ,run house.vs; after that ,run alone does\n", stderr);
    return VS_OUTCOME_USAGE;
  }
  for (size_t i = 0; !c->model && i < o->source_count; i++)
    if (o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") == 0) {
      fputs("standard input cannot be read again; ,run needs a file\n", stderr);
      return VS_OUTCOME_USAGE;
    }
  vs_outcome outcome = cli_session_run(c);
  vs_interrupt_clear(c->scheme);
  return outcome;
}

/* NAME VALUE: a parameter of the model, which then runs again. */
static void set_parameter(cli_session *c, char *rest) {
  size_t length = strcspn(rest, " \t"), count = vs_parameter_count(c->scheme);
  char *value = rest + length + strspn(rest + length, " \t");
  vs_parameter_info p;
  if (!length || !*value) {
    fputs(",set needs a parameter and a value, as in ,set floors 12; ,parameters lists them\n", stderr);
    return;
  }
  rest[length] = 0;
  cli_nearby near = cli_nearby_start(rest);
  bool known = false;
  char *was = NULL;
  for (size_t i = 0; i < count && vs_parameter_get(c->scheme, i, &p); i++) {
    cli_nearby_offer(&near, p.name);
    if (strcmp(p.name, rest) != 0) continue;
    known = true;
    was = strdup(p.value);
  }
  if (!known) {
    fprintf(stderr, "there is no parameter %s", rest);
    if (near.best) fprintf(stderr, "; perhaps %s", near.best);
    fputs("; ,parameters lists them\n", stderr);
  } else if (!c->model && !c->options->source_count) {
    fprintf(stderr, "%s was defined at the prompt; do that again: (define-parameter %s %s)\n", rest, rest, value);
  } else if (vs_parameter_set(c->scheme, rest, value) && run_model(c, "") == VS_OUTCOME_USAGE && was && vs_parameter_set(c->scheme, rest, was)) { /* refused: as before */
    printf("; %s stays %s\n", rest, was);
    run_model(c, "");
  }
  free(was);
}

/* A line each: name, value, what it may be, label. */
static void list_parameters(cli_session *c) {
  size_t count = vs_parameter_count(c->scheme);
  vs_parameter_info p;
  for (size_t i = 0; i < count && vs_parameter_get(c->scheme, i, &p); i++) {
    printf("  %-16s %-10s", p.name, p.value);
    if (p.choices) {
      for (size_t k = 0; k < p.choice_count; k++) printf("%s%s", k ? " " : "one of ", p.choices[k]);
    } else if (p.has_range) {
      printf("%.6g to %.6g", p.min, p.max);
    }
    if (strcmp(p.label, p.name) != 0) printf("  (%s)", p.label);
    putchar('\n');
  }
  if (!count) puts("; there are no parameters; (define-parameter name default) makes one");
}

static void show_drawing(cli_session *c) {
  vs_summary summary;
  if (vs_drawing_summary(c->scheme, &summary) == VS_OUTCOME_DONE) cli_report_summary("drawing", &summary);
}

/* COMMAND(name, argument, help, what to do with c and rest) */
#define COMMANDS(COMMAND)                                                                                 \
  COMMAND(quit, "", "end (so does the end of input, ctrl-D)", *going = false)                              \
  COMMAND(write, " FILE", "write the drawing, by the file's ending", write_file(c, rest))                   \
  COMMAND(drawing, "", "count the drawing's objects and measure it", show_drawing(c))                       \
  COMMAND(clear, "", "empty the drawing", vs_drawing_clear(c->scheme))                                      \
  COMMAND(run, " FILE", "run a file from the start; alone: the same again, as it is now", run_model(c, rest)) \
  COMMAND(parameters, "", "list the model's parameters", list_parameters(c))                               \
  COMMAND(set, " NAME VALUE", "set a parameter and run the model again", set_parameter(c, rest))            \
  COMMAND(stats, " json", "tell what was done so far, in tables or as JSON", cli_report_statistics(c->scheme, strcmp(rest, "json") == 0)) \
  COMMAND(help, "", "this", command_help())

static void command_help(void) {
#define COMMAND(name, argument, help, action) printf("  ,%-16s %s\n", #name argument, help);
  COMMANDS(COMMAND)
#undef COMMAND
  puts("Anything else is a program: (draw (make-sphere (xyz 0 0 0) 1)). Tab completes names.");
}

/* line: what follows the comma, ends in no newline. A unique beginning of a command will do. */
static void run_command(cli_session *c, char *line, bool *going) {
  size_t length = strcspn(line, " \t");
  char *rest = line + length + strspn(line + length, " \t");
  line[length] = 0;
  cli_nearby near = cli_nearby_start(line);
#define COMMAND(name, argument, help, action)            \
  if (length && strncmp(line, #name, length) == 0) {     \
    action;                                              \
    return;                                              \
  }                                                      \
  cli_nearby_offer(&near, #name);
  COMMANDS(COMMAND)
#undef COMMAND
  fprintf(stderr, "there is no command ,%s", line);
  if (near.best) fprintf(stderr, "; perhaps ,%s", near.best);
  fputs("; ,help lists them\n", stderr);
}

/* ---- the loop ---- */

vs_outcome cli_repl(cli_session *c) {
  struct cli_editor editor;
  bool terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO);
  if (terminal && editor_open(&editor, c)) c->editor = &editor;
  if (c->editor && !c->options->quiet) printf("VisualScheme %s. ,help lists commands, ,quit ends.\n", vs_version());
  text pending = {0};
  unsigned line_number = 1, first_line = 1; /* of all that was typed; of what is pending */
  bool going = true;
  int code;
  vs_outcome outcome = VS_OUTCOME_DONE;
  while (going && !*c->ended && !vs_exit_requested(c->scheme, &code)) {
    fflush(stdout);
    size_t length = 0;
    if (c->editor && c->midline) putchar('\n'); /* the prompt begins a line */
    c->midline = false;
    const char *line = next_line(c, pending.length ? ". " : "> ", &length);
    if (!line && *c->ended) break;
    if (!line && errno == EINTR && c->editor) { /* ctrl-C drops what was typed */
      vs_interrupt_clear(c->scheme);
      putchar('\n');
      pending.length = 0;
      continue;
    }
    if (!pending.length) first_line = line_number;
    if (line) {
      line_number++;
      if (!text_add(&pending, line, length)) {
        outcome = VS_OUTCOME_MACHINE;
        fputs("vs: out of memory\n", stderr);
        break;
      }
    } else {
      going = false;
      if (c->editor) putchar('\n');
    }
    size_t blanks = pending.length && pending.length == length ? strspn(pending.at, " \t") : 0;
    if (pending.length && pending.length == length && pending.at[blanks] == ',') {
      while (length && strchr("\r\n \t", pending.at[length - 1])) pending.at[--length] = 0;
      run_command(c, pending.at + blanks + 1, &going);
      pending.length = 0;
      continue;
    }
    vs_read_status status = vs_read_check(c->scheme, pending.at ? pending.at : "", pending.length);
    if (status.state == VS_READ_INCOMPLETE && going) continue;
    /* Text that can never be read is evaluated too, because the error says what is wrong with it. */
    if (status.state != VS_READ_EMPTY && pending.length) {
      vs_outcome one = cli_session_eval(c, "prompt", first_line, pending.at, pending.length, VS_EVAL_PRINT);
      cli_report_settle(&c->reporter);
      vs_interrupt_clear(c->scheme);
      if (one == VS_OUTCOME_INTERRUPTED && !c->editor) {
        outcome = one;
        going = false;
      }
    }
    pending.length = 0;
  }
  free(pending.at);
  if (c->editor) editor_close(c->editor);
  c->editor = NULL;
  return outcome;
}
