/* Implements the commands of the prompt, which prompt_commands.def lists. */
#include "cli/prompt/prompt_commands.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cli/main.h"
#include "cli/prompt/editor.h"
#include "cli/help_command.h"
#include "cli/prompt/manual.h"
#include "cli/nearby.h"
#include "cli/prompt/line_buffer.h"
#include "cli/prompt/repl.h"
#include "cli/prompt/show.h"
#include "cli/stats.h"

/* ---- running and loading files ---- */

/* Returns the file name without its quotes, which are optional. */
static char *unquoted(char *name) {
  size_t n = strlen(name);
  if (n < 2 || name[0] != '"' || name[n - 1] != '"') return name;
  name[n - 1] = 0;
  return name + 1;
}

static void write_file(cli_session *c, const char *path, const char *command) {
  vs_format_info format;
  cli_target target = {path, *path && vs_format_of(c->scheme, path, &format) ? format.name : NULL};
  if (!*path) {
    fprintf(stderr, ",%s needs a file name, as in ,%s house.png\n", command, command);
  } else if (!target.format) {
    fprintf(stderr, "%s: no format has this ending; the formats are %s\n", path, vs_format_endings());
  } else if (cli_session_write(c, &target) == VS_OUTCOME_DONE) {
    printf("; wrote %s\n", path);
  }
}

/* Runs the file from the start; with "", runs the last file again. */
static vs_outcome run_model(cli_session *c, const char *path) {
  const cli_options *o = c->options;
  if (*path && access(path, R_OK) != 0) {
    int error = errno;
    char near[1200];
    if (error == ENOENT && cli_nearby_program(path, near, sizeof near))
      fprintf(stderr, "%s: no such file; perhaps %s\n", path, near);
    else fprintf(stderr, "%s: %s\n", path, error == ENOENT ? "no such file" : strerror(error));
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
    fputs(",run needs a file, as in ,run house.vs; after that, ,run alone runs the file again\n", stderr);
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

static void run_file(cli_session *c, cli_prompt *p, const char *path) {
  vs_outcome outcome = run_model(c, path);
  if (outcome == VS_OUTCOME_USAGE) return;
  cli_prompt_forget_stopped(p);
  if (outcome == VS_OUTCOME_STOPPED) cli_prompt_stopped(c, p, (cli_entry){NULL, 0, 0, 0});
  for (size_t i = 0; i < p->known; i++) free(p->entries[i].text); /* typed entries are deleted, since the interpreter
                                                                   * was restarted */
  p->count = p->known = 0;
}

/* Evaluates (load "FILE"), which becomes an entry that ,undo and ,save include. With "", loads the last file again. */
static void load_file(cli_session *c, cli_prompt *p, const char *path) {
  if (*path) {
    char *copy = strdup(path);
    free(p->loaded);
    p->loaded = copy;
  }
  if (!p->loaded) {
    fputs(",load needs a file, as in ,load parts.vs; after that ,reload loads it again\n", stderr);
    return;
  }
  char text[1200];
  if (strpbrk(p->loaded, "\"\\") || snprintf(text, sizeof text, "(load \"%s\")\n", p->loaded) >= (int)sizeof text) {
    fprintf(stderr, "%s: ,load does not accept this file name\n", p->loaded);
    return;
  }
  cli_prompt_evaluate(c, p, text, strlen(text), p->line++);
}

/* ---- setting and listing parameters ---- */

void cli_prompt_set(cli_session *c, char *rest) {
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
    fprintf(stderr, "%s was defined at the prompt; define it again: (define-parameter %s %s)\n", rest, rest, value);
  /* the new value was refused: sets the parameter to its old value */
  } else if (vs_parameter_set(c->scheme, rest, value) && run_model(c, "") == VS_OUTCOME_USAGE && was &&
      vs_parameter_set(c->scheme, rest, was)) {
    printf("; %s stays %s\n", rest, was);
    run_model(c, "");
  }
  free(was);
}

/* Prints a line for each parameter: name, value, range and label. */
static void list_parameters(cli_session *c) {
  size_t count = vs_parameter_count(c->scheme);
  vs_parameter_info p;
  for (size_t i = 0; i < count && vs_parameter_get(c->scheme, i, &p); i++) {
    printf("  %-16s %-10s", p.name, p.value);
    if (p.choices) {
      for (size_t k = 0; k < p.choice_count; k++) printf("%s%s", k ? " " : "one of ", p.choices[k]);
    } else if (p.has_range) {
      printf("%.6g to %.6g%s%s", p.min, p.max, *p.unit ? " " : "", p.unit);
    }
    if (strcmp(p.label, p.name) != 0) printf("  (%s)", p.label);
    putchar('\n');
  }
  if (!count) puts("; there are no parameters; (define-parameter name default) makes one");
}

static void clear(cli_session *c) {
  vs_drawing_clear(c->scheme);
  c->drawn = true;
}

static void show_drawing(cli_session *c) {
  vs_summary summary;
  if (vs_drawing_summary(c->scheme, &summary) == VS_OUTCOME_DONE) cli_report_summary("drawing", &summary);
}

/* ---- help on commands and names ---- */

static void list_commands(void) {
#define COMMAND(name, argument, help, action) printf("  ,%-18s %s\n", #name argument, help);
#include "cli/prompt/prompt_commands.def"
  puts("Anything else is a program: (draw (make-sphere (xyz 0 0 0) 1)). Tab completes names, Alt-? shows how the "
       "procedure you are in is called.");
}

static void help(cli_session *c, const char *name) {
  vs_name_info info;
  if (!*name) {
    list_commands();
    return;
  }
#define COMMAND(command, argument, help, action)                        \
  if (*name == ',' && strcmp(name + 1, #command) == 0) {                 \
    printf("  ,%s  %s\n", #command argument, help);                      \
    return;                                                              \
  }
#include "cli/prompt/prompt_commands.def"
  if (!vs_name_get(c->scheme, name, &info)) {
    if (cli_help_word(c->scheme, name, ",help")) return;
    const char *advice = vs_name_advice(c->scheme, name);
    printf("%s is not defined%s%s; ,apropos %s lists the names that contain it\n", name, *advice ? "; " : "", advice,
           name);
    return;
  }
  if (info.at.file) printf("%s is defined in %s, line %u\n", name, info.at.file, (unsigned)info.at.line);
  if (!info.own && cli_manual_print(name, ",help", stdout)) return;
  for (const char *at = info.call; *at;) {
    size_t n = strcspn(at, "\n");
    printf("  %.*s%s%s\n", (int)n, at, *info.keywords ? " " : "", info.keywords);
    at += n + (at[n] == '\n');
  }
  if (*info.doc) printf("  %s\n", info.doc);
  if (*info.value) printf("  %s is %s\n", name, info.value);
}

/* Returns true if the text contains the word; upper and lower case count as equal. */
static bool has(const char *text, const char *word) {
  size_t n = strlen(word);
  for (; *text; text++) {
    size_t i = 0;
    while (i < n && text[i] && tolower((unsigned char)text[i]) == tolower((unsigned char)word[i])) i++;
    if (i == n) return true;
  }
  return false;
}

typedef struct { char **at; size_t count, room; } name_list;
static bool add_name(void *context, const char *name) {
  name_list *l = context;
  if (l->count == l->room) {
    size_t room = l->room ? 2 * l->room : 1024;
    char **grown = realloc(l->at, room * sizeof *grown);
    if (!grown) return false;
    l->at = grown, l->room = room;
  }
  l->at[l->count] = strdup(name);
  return l->at[l->count] ? (l->count++, true) : false;
}

static void apropos(cli_session *c, const char *word) {
  if (!*word) {
    fputs(",apropos needs a word, as in ,apropos sphere\n", stderr);
    return;
  }
  name_list all = {0};
  size_t found = 0;
  vs_name_info info;
  vs_complete(c->scheme, "", add_name, &all);
  for (size_t i = 0; i < all.count; i++) {
    if (vs_name_get(c->scheme, all.at[i], &info) && (has(all.at[i], word) || has(info.doc, word))) {
      size_t n = strcspn(info.call, "\n");
      printf("  %-24s %.*s%s%s\n", all.at[i], (int)n, info.call, *info.doc && n ? "  " : "", info.doc);
      found++;
    }
    free(all.at[i]);
  }
  free(all.at);
  const char *advice = vs_name_advice(c->scheme, word);
  if (!found) printf("no name has %s in it%s%s\n", word, *advice ? "; " : "", advice);
  cli_manual_mentions(word, stdout);
}

/* Evaluates the text `before`, followed by expression and `after`. */
static void ask(cli_session *c, const char *before, const char *expression, const char *after) {
  size_t n = strlen(before) + strlen(expression) + strlen(after) + 1;
  char *text = malloc(n);
  if (!text) return;
  snprintf(text, n, "%s%s%s", before, expression, after);
  cli_session_eval(c, "prompt", 1, text, strlen(text), VS_EVAL_WITHIN);
  vs_interrupt_clear(c->scheme);
  free(text);
}

static void describe(cli_session *c, const char *expression) {
  if (*expression) ask(c, "(describe ", expression, "\n)");
  else fputs(",describe needs an expression, as in ,describe $1\n", stderr);
}

static void expand(cli_session *c, const char *form) {
  if (*form) ask(c, "(begin (write (macroexpand '", form, "\n)) (newline))");
  else fputs(",expand needs a form, as in ,expand (for/list ([i 3]) i)\n", stderr);
}

/* ---- undoing and saving entries ---- */

/* Restarts the interpreter, and runs all files and all entries that have not been undone, without printing values. */
static vs_outcome replay(cli_session *c, cli_prompt *p) {
  FILE *output = c->output;
  bool quiet = c->options->quiet;
  FILE *nowhere = fopen("/dev/null", "w");
  if (nowhere) c->output = nowhere;
  c->options->quiet = true;
  cli_prompt_forget_stopped(p);
  c->stops = VS_EVAL_PASS;
  vs_outcome outcome = cli_session_run(c);
  for (size_t i = 0; i < p->count && outcome == VS_OUTCOME_DONE; i++) {
    cli_entry *e = &p->entries[i];
    unsigned before = cli_prompt_results(c, p);
    outcome = cli_session_eval(c, "prompt", e->first_line, e->text, strlen(e->text),
                               VS_EVAL_PRINT | VS_EVAL_NUMBER | VS_EVAL_PASS);
    e->result = before + 1, e->results = cli_prompt_results(c, p) > before ? p->results - before : 0;
  }
  vs_interrupt_clear(c->scheme);
  c->output = output;
  c->options->quiet = quiet;
  c->stops = VS_EVAL_STOP;
  if (nowhere) fclose(nowhere);
  return outcome;
}

static void tell_entry(const char *what, const cli_entry *e) {
  size_t n = strcspn(e->text, "\n");
  printf("; %s: %.*s%s\n", what, (int)(n < 60 ? n : 60), e->text, n > 60 || e->text[n + (e->text[n] == '\n')]
      ? " ..." : "");
}

static void undo(cli_session *c, cli_prompt *p) {
  if (!p->count) {
    puts("; there is nothing to undo");
    return;
  }
  p->count--;
  tell_entry("taken back", &p->entries[p->count]);
  replay(c, p);
}

static void redo(cli_session *c, cli_prompt *p) {
  if (p->count == p->known) {
    puts("; there is nothing to redo");
    return;
  }
  tell_entry("done again", &p->entries[p->count]);
  p->count++;
  replay(c, p);
}

/* Returns the number n if a later entry uses a value $n of this entry, otherwise 0. */
static unsigned named_later(const cli_prompt *p, size_t entry) {
  const cli_entry *e = &p->entries[entry];
  for (size_t i = entry + 1; e->results && i < p->count; i++)
    for (const char *at = p->entries[i].text; (at = strchr(at, '$')) != NULL; at++) {
      unsigned long n = isdigit((unsigned char)at[1]) ? strtoul(at + 1, NULL, 10) : 0;
      if (n >= e->result && n - e->result < e->results) return (unsigned)n;
    }
  return 0;
}

/* Returns true if the text is a single expression in parentheses, or a single word. */
static bool is_one(cli_session *c, const char *text, size_t n) {
  if (*text != '(' && *text != '[') return memchr(text, ' ', n) == NULL && memchr(text, '\n', n) == NULL;
  for (size_t k = 2; k < n; k++)
    if (strchr(")]", text[k - 1]) && vs_read_check(c->scheme, text, k).state == VS_READ_COMPLETE)
      return vs_read_check(c->scheme, text + k, n - k).state == VS_READ_EMPTY;
  return true;
}

/* Writes an entry as a line of a program. If a later entry uses its value, the line defines a name for the value. */
static void save_entry(cli_session *c, const cli_prompt *p, size_t entry, FILE *f) {
  const char *text = p->entries[entry].text;
  text += strspn(text, " \t\r\n");
  size_t n = strlen(text);
  while (n && strchr(" \t\r\n", text[n - 1])) n--;
  unsigned named = named_later(p, entry);
  bool whole = named && p->entries[entry].results == 1 && is_one(c, text, n);
  if (whole)
    fprintf(f, "(define $%u %.*s%s)\n", named, (int)n, text, memchr(text, ';', n) ? "\n" : "");
  else fprintf(f, "%.*s\n", (int)n, text);
  if (named && !whole)
    fprintf(stderr, "; $%u is not in the program: it is the value of one of several expressions in a line\n", named);
}

/* Returns true if the entry only begins or ends tracing: (trace f) or (untrace f). */
static bool only_watches(const char *text) {
  text += strspn(text, " \t\r\n");
  return strncmp(text, "(trace ", 7) == 0 || strncmp(text, "(untrace ", 9) == 0;
}

/* Writes the model's files and all entries as one program. */
static void save(cli_session *c, cli_prompt *p, const char *path) {
  if (!*path) {
    fputs(",save needs a file name, as in ,save house.vs\n", stderr);
    return;
  }
  FILE *exists = fopen(path, "r");
  if (exists) {
    fclose(exists);
    fprintf(stderr, "%s exists already, and ,save writes only new files: give another name\n", path);
    return;
  }
  FILE *f = fopen(path, "w");
  if (!f) {
    fprintf(stderr, "%s: %s\n", path, strerror(errno));
    return;
  }
  size_t definitions = 0, written = 0;
  if (c->model) fprintf(f, "(load \"%s\")\n", c->model);
  for (size_t i = 0; !c->model && i < c->options->source_count; i++) {
    const cli_source *s = &c->options->sources[i];
    if (s->kind == CLI_SOURCE_EXPRESSION) fprintf(f, "%s\n", s->text);
    else if (strcmp(s->text, "-") != 0) fprintf(f, "(load \"%s\")\n", s->text);
  }
  for (size_t i = 0; i < p->count; i++) {
    if (only_watches(p->entries[i].text)) continue;
    written++;
    definitions += cli_is_definition(p->entries[i].text);
    save_entry(c, p, i, f);
  }
  bool ok = !ferror(f);
  if (fclose(f) != 0 || !ok) fprintf(stderr, "%s: %s\n", path, strerror(errno));
  else
    printf("; wrote %s: %zu expression%s, %zu of them definitions\n", path, written, written == 1 ? "" : "s",
           definitions);
}

/* ---- tracing and timing ---- */

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void print_profile(cli_session *c) {
  vs_profile_info row;
  size_t looks;
  for (size_t i = 0; i < 12 && vs_profile_get(c->scheme, i, &row, &looks); i++) {
    if (!i) printf("  itself  with its calls, of %zu samples\n", looks);
    printf("  %5.1f%%  %5.1f%%  %s", 100 * row.own, 100 * row.whole, row.procedure);
    if (row.at.file) printf("  (%s:%u)", row.at.file, (unsigned)row.at.line);
    putchar('\n');
  }
  if (!vs_profile_get(c->scheme, 0, &row,
      &looks)) puts("; the run was too short: the profiler takes a sample every few milliseconds");
}

static void time_expression(cli_session *c, cli_prompt *p, const char *expression, bool profile) {
  if (!*expression) {
    fprintf(stderr, ",%s needs an expression\n", profile ? "profile" : "time");
    return;
  }
  size_t n = strlen(expression);
  char *text = malloc(n + 2);
  if (!text) return;
  memcpy(text, expression, n);
  memcpy(text + n, "\n", 2);
  double before = seconds();
  if (profile) vs_profile(c->scheme, true);
  vs_outcome outcome = cli_prompt_evaluate(c, p, text, n + 1, p->line++);
  if (profile) vs_profile(c->scheme, false);
  double took = seconds() - before;
  if (outcome == VS_OUTCOME_DONE) printf("; %.3g %s\n", took < .1 ? took * 1000 : took, took < .1 ? "ms" : "s");
  if (profile) print_profile(c);
  free(text);
}

static void step(cli_session *c, cli_prompt *p, const char *expression) {
  if (!*expression && p->stopped_count) {
    cli_prompt_resume(c, p, VS_RESUME_ENTER);
    return;
  }
  if (!*expression) {
    fputs(",step needs an expression, as in ,step (tower 3)\n", stderr);
    return;
  }
  line_buffer text = {0};
  if (cli_line_buffer_add(&text, expression, strlen(expression)) && cli_line_buffer_add(&text, "\n", 1))
    cli_prompt_evaluate_with(c, p, text.at, text.length, p->line++, VS_EVAL_STEP);
  free(text.at);
}

static void quit(cli_session *c, cli_prompt *p) {
  if (!p->stopped_count) {
    p->going = false;
    return;
  }
  cli_prompt_drop(c, p);
  puts(p->stopped_count ? "; given up" : "; the stopped program has been ended; ,quit once more ends the prompt");
}

static void trace(cli_session *c, cli_prompt *p, const char *name, bool on) {
  char text[300];
  if (!*name || strpbrk(name, " \t()[]\"'`,;") || strlen(name) > 100) {
    fprintf(stderr, ",%s needs the name of a procedure\n", on ? "trace" : "untrace");
    return;
  }
  vs_name_info info;
  if (!vs_name_get(c->scheme, name, &info) || strcmp(info.kind, "procedure") != 0) {
    fprintf(stderr, "%s is no procedure\n", name);
    return;
  }
  snprintf(text, sizeof text, "(%s %s)\n", on ? "trace" : "untrace", name);
  cli_prompt_evaluate(c, p, text, strlen(text), p->line++);
}

static void backtrace(cli_session *c) {
  if (!cli_report_calls(c->scheme, stdout)) puts("; there was no error");
}

static void locals(cli_session *c, const char *number) {
  vs_call_info f;
  long n = *number ? strtol(number, NULL, 10) : 1;
  if (n < 1 || !vs_call_get(c->scheme, (size_t)n - 1, &f)) {
    puts("; there is no such call; ,backtrace lists them");
    return;
  }
  if (!*f.variables) puts("; this call has no variables");
  for (const char *at = f.variables; *at;) {
    const char *end = at;
    int depth = 0;
    bool string = false;
    for (; *end; end++) { /* end: position of the comma before the next name, or of the text's end */
      if (*end == '"') string = !string;
      if (!string && *end == '(') depth++;
      if (!string && *end == ')') depth--;
      if (!string && depth <= 0 && end[0] == ',' && end[1] == ' ') break;
    }
    printf("  %.*s\n", (int)(end - at), at);
    at = *end ? end + 2 : end;
  }
}

static bool print_line(void *context, const char *line) {
  (void)context;
  puts(line);
  return true;
}

static void disassemble(cli_session *c, const char *name) {
  if (!vs_disassemble(c->scheme, name, print_line, NULL)) fprintf(stderr, "%s is no procedure of Scheme code\n",
      *name ? name : "nothing");
}

/* ---- the table of commands ---- */

void cli_command_names(void (*each)(void *context, const char *name), void *context) {
#define COMMAND(name, argument, help, action) each(context, #name);
#include "cli/prompt/prompt_commands.def"
}

void cli_command_advise(const char *name, FILE *to) {
#define COMMAND(command, argument, help, action) \
  if (strcmp(name, #command) == 0) fprintf(to, "; ,%s: %s\n", #command argument, help);
#include "cli/prompt/prompt_commands.def"
}

void cli_prompt_command(cli_session *c, cli_prompt *p, char *line) {
  size_t length = strcspn(line, " \t");
  char *rest = line + length + strspn(line + length, " \t");
  line[length] = 0;
  cli_nearby near = cli_nearby_start(line);
#define COMMAND(name, argument, help, action) \
  if (length && strcmp(line, #name) == 0) {   \
    action;                                   \
    return;                                   \
  }
#include "cli/prompt/prompt_commands.def"
#define COMMAND(name, argument, help, action)            \
  if (length && strncmp(line, #name, length) == 0) {     \
    action;                                              \
    return;                                              \
  }                                                      \
  cli_nearby_offer(&near, #name);
#include "cli/prompt/prompt_commands.def"
  fprintf(stderr, "there is no command ,%s", line);
  if (near.best) fprintf(stderr, "; perhaps ,%s", near.best);
  fputs("; ,help lists them\n", stderr);
}
