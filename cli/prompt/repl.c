/* Implements the prompt. It reads lines until they form a complete expression, evaluates it and prints its value. An
 * error does not end the prompt.
 *
 * On a terminal, editor.c edits the lines. If standard input is a pipe, lines are read without editing and no prompt is
 * shown. A line that begins with a comma is a command of the prompt, even within an unfinished expression. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/main.h"
#include "cli/prompt/editor.h"
#include "cli/prompt/line_buffer.h"
#include "cli/prompt/repl.h"
#include "cli/prompt/prompt_commands.h"
#include "cli/prompt/source_text.h"
#include "cli/prompt/standard_output.h"
#include "live/live.h"

/* Returns the next line with its newline. Returns NULL at the end of input, or, with errno EINTR, at an interrupt. */
static const char *next_line(cli_session *c, const char *prompt, const char *open, size_t *length, bool *whole) {
  *whole = false;
  errno = 0;
  if (c->editor) return cli_editor_line(c->editor, prompt, open, length, whole);
  ssize_t got = getline(&c->line, &c->line_room, stdin);
  if (got < 0) return NULL;
  *length = (size_t)got;
  return c->line;
}

const char *cli_repl_line(cli_session *c, size_t *length) {
  bool whole;
  return next_line(c, "", "", length, &whole);
}

/* ---- evaluating typed text ---- */

static bool has_room(cli_entry **entries, size_t count, size_t *room) {
  if (count < *room) return true;
  size_t more = *room ? 2 * *room : 32;
  cli_entry *grown = realloc(*entries, more * sizeof *grown);
  if (grown) *entries = grown, *room = more;
  return grown != NULL;
}

bool cli_is_definition(const char *text) {
  text += strspn(text, " \t\r\n");
  return !strncmp(text, "(define", 7);
}

static bool is_number_of_value(cli_session *c, unsigned n) {
  char name[24];
  vs_name_info info;
  snprintf(name, sizeof name, "$%u", n);
  return vs_name_get(c->scheme, name, &info);
}

unsigned cli_prompt_results(cli_session *c, cli_prompt *p) {
  while (p->results && !is_number_of_value(c, p->results)) p->results--;
  while (is_number_of_value(c, p->results + 1)) p->results++;
  return p->results;
}

static bool remember(cli_session *c, cli_prompt *p, const char *text, size_t length, unsigned first_line) {
  for (size_t i = p->count; i < p->known; i++) free(p->entries[i].text); /* deletes the entries that have been undone:
                                                                          * they can no longer be redone */
  p->known = p->count;
  if (!has_room(&p->entries, p->count, &p->room)) return false;
  char *copy = malloc(length + 1);
  if (!copy) return false;
  memcpy(copy, text, length);
  copy[length] = 0;
  unsigned before = p->results, now = cli_prompt_results(c, p);
  p->entries[p->count++] = (cli_entry){copy, first_line, before + 1, now > before ? now - before : 0};
  p->known = p->count;
  return true;
}

void cli_prompt_free(cli_prompt *p) {
  for (size_t i = 0; i < p->known; i++) free(p->entries[i].text);
  for (size_t i = 0; i < p->stopped_count; i++) free(p->stopped[i].text);
  free(p->stopped);
  free(p->entries);
  free(p->loaded);
}

/* For a line such as 3 + 4, explains that it consists of three separate values. Returns false for other lines. */
static bool advise_infix(const char *line) {
  char a[40], sign[3], b[40], rest[2];
  if (sscanf(line, "%39[^ ()\"'] %2[-+*/<>=^%%] %39[^ ()\"']%1s", a, sign, b, rest) != 3) return false;
  if (sign[0] == '=' && !sign[1]) return false; /* for x = 5, the error message has already explained this */
  fprintf(stderr, "; the operator comes first: (%s %s %s)\n", strcmp(sign, "^") == 0 ? "expt" : strcmp(sign,
      "==") == 0 ? "=" : sign, a, b);
  return true;
}

/* Advises on a line that is typed as in a shell, such as `load "x.vs"` or `show`. */
static void advise_bare_call(cli_session *c, const char *line, bool failed) {
  char name[40];
  size_t length = strcspn(line, " ");
  if (!length || length >= sizeof name || strchr("()[]'`,\"#;", *line)) return;
  memcpy(name, line, length);
  name[length] = 0;
  vs_name_info info;
  if (vs_name_get(c->scheme, name, &info)) {
    if (!*info.call || !line[length]) return;
    fprintf(stderr, "; a call is in parentheses: (%s)\n", line);
  } else {
    char command[sizeof name + 1];
    snprintf(command, sizeof command, ",%s", name);
    if (!failed || strstr(vs_name_advice(c->scheme, name), command)) return; /* the error message already contains this
                                                                              * advice */
  }
  cli_command_advise(name, stderr);
}

/* Advises on an evaluated line that has no parentheses around it. */
static void advise(cli_session *c, const char *text, size_t length, bool failed) {
  char line[120];
  while (length && strchr(" \t\r\n", text[length - 1])) length--;
  while (length && strchr(" \t\r\n", *text)) text++, length--;
  if (!length || length >= sizeof line || memchr(text, '\n', length) || memchr(text, ';', length)) return;
  memcpy(line, text, length);
  line[length] = 0;
  if (failed || !advise_infix(line)) advise_bare_call(c, line, failed);
}

/* ---- paused programs ---- */

/* Calls vs_resume, while the time limit is watched (limits.h). */
static vs_outcome resume(cli_session *c, vs_resume_way way) {
  c->drawn = true;
  cli_watch_begin(&c->watch, true);
  vs_outcome outcome = vs_resume(c->scheme, way);
  cli_watch_end(&c->watch);
  return outcome;
}

void cli_prompt_drop(cli_session *c, cli_prompt *p) {
  free(p->stopped[--p->stopped_count].text);
  vs_stop_drop(c->scheme);
}

void cli_prompt_forget_stopped(cli_prompt *p) {
  while (p->stopped_count) free(p->stopped[--p->stopped_count].text);
}

vs_outcome cli_prompt_stopped(cli_session *c, cli_prompt *p, cli_entry entry) {
  if (!has_room(&p->stopped, p->stopped_count, &p->stopped_room)) {
    fputs("vs: out of memory\n", stderr);
    vs_stop_drop(c->scheme);
    free(entry.text);
    return VS_OUTCOME_MACHINE;
  }
  vs_outcome outcome = VS_OUTCOME_STOPPED;
  vs_stop_info stop;
  while (outcome == VS_OUTCOME_STOPPED && vs_stop_get(c->scheme, &stop)) {
    cli_report_stop(&c->reporter, c->scheme, &stop);
    if (stop.kind != VS_STOPPED_VALUE) break;
    outcome = resume(c, VS_RESUME_SAME);
  }
  if (outcome == VS_OUTCOME_STOPPED) {
    p->stopped[p->stopped_count++] = entry;
    if (!p->told_stops)
      fputs("; ,step enters the call, ,over finishes the call, ,out leaves the procedure, ,continue runs on; "
            ",quit ends the program\n",
            stderr);
    p->told_stops = true;
    return outcome;
  }
  cli_report_settle(&c->reporter);
  if (outcome == VS_OUTCOME_DONE && entry.text && !remember(c, p, entry.text, strlen(entry.text), entry.first_line))
    fputs("vs: out of memory\n", stderr);
  free(entry.text);
  return outcome;
}

void cli_prompt_resume(cli_session *c, cli_prompt *p, vs_resume_way way) {
  if (!p->stopped_count) {
    fputs("; no program is stopped; ,step EXPR runs an expression call by call, (break) stops a program\n", stderr);
    return;
  }
  p->again = way == VS_RESUME_CONTINUE ? 0 : 1 + (int)way;
  cli_entry entry = p->stopped[--p->stopped_count];
  vs_outcome outcome = resume(c, way);
  if (outcome == VS_OUTCOME_STOPPED) outcome = cli_prompt_stopped(c, p, entry);
  else {
    cli_report_settle(&c->reporter);
    if (outcome == VS_OUTCOME_DONE && entry.text && !remember(c, p, entry.text, strlen(entry.text), entry.first_line))
      fputs("vs: out of memory\n", stderr);
    free(entry.text);
  }
  cli_output_flush(c);
  vs_interrupt_clear(c->scheme);
}

vs_outcome cli_prompt_evaluate_with(cli_session *c, cli_prompt *p, const char *text, size_t length,
    unsigned first_line, unsigned extra) {
  cli_prompt_results(c, p);
  vs_outcome outcome = cli_session_eval(c, "prompt", first_line, text, length,
      VS_EVAL_PRINT | VS_EVAL_NUMBER | VS_EVAL_STOP | VS_EVAL_WITHIN | extra);
  cli_report_settle(&c->reporter);
  cli_output_flush(c);
  vs_interrupt_clear(c->scheme);
  vs_call_info call;
  if (outcome == VS_OUTCOME_STOPPED) {
    line_buffer copy = {0};
    cli_line_buffer_add(&copy, text, length);
    p->again = extra & VS_EVAL_STEP ? 1 + VS_RESUME_ENTER : 0;
    outcome = cli_prompt_stopped(c, p, (cli_entry){copy.at, first_line, 0, 0});
  } else if (outcome == VS_OUTCOME_DONE) {
    advise(c, text, length, false);
    /* An expression that only inspects a paused program does not become an entry. */
    if ((!p->stopped_count || cli_is_definition(text)) && !remember(c, p, text, length,
        first_line)) fputs("vs: out of memory\n", stderr);
  } else if (outcome == VS_OUTCOME_MODEL) {
    advise(c, text, length, true);
    if (c->editor && vs_call_get(c->scheme, 1, &call))
      fputs("; ,backtrace shows the calls, ,locals 1 the arguments of the first\n", stderr);
  }
  return outcome;
}

vs_outcome cli_prompt_evaluate(cli_session *c, cli_prompt *p, const char *text, size_t length, unsigned first_line) {
  return cli_prompt_evaluate_with(c, p, text, length, first_line, 0);
}

/* ---- the live view ---- */

static bool view_asked(void *context) {
  cli_prompt *p = context;
  p->asked = live_follow_asked(p->session->view);
  return p->asked.kind != LIVE_NOTHING;
}

/* Performs the request of a window of the live view, as if it had been typed. */
static void view_act(void *context) {
  cli_prompt *p = context;
  cli_session *c = p->session;
  const char *name = p->asked.name, *value = p->asked.value;
  live_follow_begin(c->view);
  if (p->asked.kind == LIVE_ASKED_PROMPT) {
    printf("; from the window: %s\n", value);
    cli_prompt_evaluate(c, p, value, strlen(value), p->line++);
  } else {
    line_buffer rest = {0};
    if (cli_line_buffer_add(&rest, name, strlen(name)) && cli_line_buffer_add(&rest, " ", 1) &&
        cli_line_buffer_add(&rest, value, strlen(value))) {
      printf("; from the window: ,set %s\n", rest.at);
      cli_prompt_set(c, rest.at);
    }
    free(rest.at);
  }
  live_asked_free(&p->asked);
  live_follow_show(c->view);
  c->drawn = false;
}

void cli_prompt_view(cli_session *c, cli_prompt *p) {
  if (c->view) {
    live_follow_tell(c->view);
    return;
  }
  live_options o = {.interpreter = c->options->interpreter, .output = c->options->output, .open_browser = true,
      .told = stdout};
  c->view = live_follow(&o, c->scheme);
  c->drawn = false;
  if (!c->view) return;
  p->session = c;
  if (c->editor) cli_editor_idle(c->editor, (cli_idle){view_asked, view_act, p});
  puts("; the page follows the drawing until this prompt ends");
}

/* Shows the drawing after the last line in the live view. */
static void show_view(cli_session *c) {
  if (!c->view) return;
  if (c->drawn) live_follow_show(c->view);
  c->drawn = false;
}

/* ---- the loop of the prompt ---- */

/* Returns the prompt for a further line of an unfinished expression, such as "2 open, from line 1> ": the number of
 * open parentheses, and the line of the innermost. */
static const char *continuation(const vs_read_status *status, char *room, size_t size) {
  if (status->depth) snprintf(room, size, "%u open, from line %u> ", status->depth, status->line);
  else snprintf(room, size, "open from line %u> ", status->line);
  return room;
}

/* Prints where the abandoned expression probably lacks a bracket. */
static void tell_given_up(vs_scheme *scheme, const char *text, const vs_read_status *status) {
  unsigned line = cli_text_lacks_bracket(scheme, text);
  if (line) printf("; given up: a ) is missing, probably at the end of line %u\n", line);
  else printf("; given up: the parenthesis of line %u, column %u is not closed\n", status->line, status->column);
}

/* Returns the prompt for a new expression: "> ", or "break> " if a program is paused, or "2 break> " if two programs
 * are. */
static const char *top_prompt(const cli_prompt *p, char *room, size_t size) {
  if (!p->stopped_count) return "> ";
  const char *how = p->again ? "step" : "break";
  if (p->stopped_count == 1) snprintf(room, size, "%s> ", how);
  else snprintf(room, size, "%zu %s> ", p->stopped_count, how);
  return room;
}

vs_outcome cli_repl(cli_session *c) {
  cli_prompt p = {.going = true, .line = 1};
  c->editor = cli_editor_open(c->scheme, cli_command_names);
  if (c->editor && !c->options->quiet) printf("VisualScheme %s. ,help lists commands, ,quit ends.\n", vs_version());
  line_buffer pending = {0};
  unsigned first_line = 1; /* number of the line at which the unfinished expression begins */
  int code;
  vs_outcome outcome = VS_OUTCOME_DONE;
  vs_read_status status = {0};
  c->stops = VS_EVAL_STOP;
  /* handles a program of the command line that has paused */
  if (vs_stop_depth(c->scheme)) cli_prompt_stopped(c, &p, (cli_entry){NULL, 0, 0, 0});
  while (p.going && !*c->ended && !vs_exit_requested(c->scheme, &code)) {
    cli_output_flush(c);
    *c->interrupts = 0;
    size_t length = 0;
    char room[64];
    bool whole;
    if (c->editor && c->midline) putchar('\n'); /* the prompt must begin a line */
    c->midline = false;
    show_view(c);
    const char *line = next_line(c, pending.length ? continuation(&status, room, sizeof room) : top_prompt(&p, room,
        sizeof room), pending.length
        ? pending.at : "", &length, &whole);
    if (line && c->view) live_follow_begin(c->view);
    if (!line && *c->ended) break;
    if (!line && errno == EINTR && c->editor) { /* Ctrl-C deletes the typed text */
      vs_interrupt_clear(c->scheme);
      putchar('\n');
      pending.length = 0;
      continue;
    }
    if (!line && c->editor && p.stopped_count && !pending.length) { /* Ctrl-D ends a paused program */
      puts(" given up");
      cli_prompt_drop(c, &p);
      continue;
    }
    if (line && whole) pending.length = 0; /* after editing, `line` also contains the lines of the unfinished
                                            * expression */
    if (!pending.length) first_line = p.line;
    size_t blanks = line ? strspn(line, " \t") : 0;
    if (line && line[blanks] == ',' && (!pending.length || c->editor)) {
      p.line++;
      char *command = malloc(length + 1);
      if (!command) {
        outcome = VS_OUTCOME_MACHINE;
        break;
      }
      memcpy(command, line, length);
      command[length] = 0;
      while (length && strchr("\r\n \t", command[length - 1])) command[--length] = 0;
      if (c->editor) cli_editor_remember(c->editor, command, length);
      cli_prompt_command(c, &p, command + blanks + 1);
      free(command);
      if (pending.length &&
          p.going) printf("; the expression above is still open, %u deep; an empty line gives it up\n", status.depth);
      continue;
    }
    if (line && c->editor && p.stopped_count && p.again && !pending.length && blanks + 1 >= length) {
      p.line++;
      cli_prompt_resume(c, &p, (vs_resume_way)(p.again - 1));
      continue;
    }
    /* an empty line ends the input of an unfinished expression, which is abandoned */
    if (line && c->editor && pending.length && blanks + 1 >= length && !cli_editor_has_more(c->editor)) {
      tell_given_up(c->scheme, pending.at, &status);
      p.line++;
      pending.length = 0;
      continue;
    }
    if (line) {
      for (size_t i = 0; i < length; i++) p.line += line[i] == '\n';
      if (!cli_line_buffer_add(&pending, line, length)) {
        outcome = VS_OUTCOME_MACHINE;
        fputs("vs: out of memory\n", stderr);
        break;
      }
    } else {
      p.going = false;
      if (c->editor) putchar('\n');
    }
    status = vs_read_check(c->scheme, pending.at ? pending.at : "", pending.length);
    if (status.state == VS_READ_INCOMPLETE && p.going) continue;
    if (status.state != VS_READ_EMPTY && pending.length) {
      if (c->editor) cli_editor_remember(c->editor, pending.at, pending.length);
      /* Invalid text is evaluated, too: the reader then reports the fault. */
      vs_outcome one = cli_prompt_evaluate(c, &p, pending.at, pending.length, first_line);
      /* Without a terminal nobody may see an error: the first failed expression decides the exit status. */
      if (!c->editor && outcome == VS_OUTCOME_DONE && one != VS_OUTCOME_STOPPED) outcome = one;
      if (one == VS_OUTCOME_INTERRUPTED && !c->editor) {
        outcome = one;
        p.going = false;
      }
    }
    pending.length = 0;
  }
  if (vs_exit_requested(c->scheme, &code)) outcome = VS_OUTCOME_DONE; /* after (exit n), the exit status is n */
  free(pending.at);
  live_follow_close(c->view);
  c->view = NULL;
  cli_editor_close(c->editor);
  c->editor = NULL;
  cli_prompt_free(&p);
  return outcome;
}
