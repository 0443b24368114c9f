/* Implements the command `vs`: runs the programs of the command line, then writes the outputs. Its exit codes are the
 * numbers of vs_outcome. */
#include "cli/main.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/large_blocks.h"
#include "cli/prompt/editor.h"
#include "cli/format_command.h"
#include "cli/help_command.h"
#include "cli/prompt/repl.h"
#include "cli/jupyter/jupyter_command.h"
#include "cli/lsp/language_server.h"
#include "cli/mcp/mcp_server.h"
#include "cli/packages/add_command.h"
#include "cli/packages/new_command.h"
#include "cli/packages/search_command.h"
#include "cli/profile/profile_command.h"
#include "cli/limits.h"
#include "cli/nearby.h"
#include "cli/prompt/standard_output.h"
#include "cli/batch/inputs_told.h"
#include "cli/batch/render_command.h"
#include "cli/batch/watch.h"
#include "cli/cluster/cluster_command.h"
#include "cli/cluster/jobs_command.h"
#include "cli/command.h"
#include "cli/dependencies.h"
#include "cli/difference.h"
#include "cli/light/exr_commands.h"
#include "cli/cure/broken_rules.h"
#include "cli/cure/cure_command.h"
#include "cli/fit/fit_command.h"
#include "cli/light/sun_command.h"
#include "cli/stats.h"
#include "cli/study.h"
#include "cli/sweep/sweep_command.h"
#include "cli/test_command.h"
#include "cli/usage/output_files.h"
#include "live/live.h"
#include "model/store/array.h"

/* The interpreter to interrupt, and the numbers of signals so far: the only global variables, because a signal handler
 * has no context. SIGINT ends the current run; SIGTERM and SIGHUP also end the prompt. No signal ends the process at
 * once, so that incomplete files are removed and POV-Ray is ended. */
static vs_scheme *volatile interrupted_by_signal;
static volatile sig_atomic_t interrupts, ended;

static void on_interrupt(int signal_number) {
  if (signal_number != SIGINT) ended = 1;
  if (++interrupts > 3) _exit(VS_OUTCOME_INTERRUPTED); /* ends the process after more than three signals, since it does
                                                        * not seem to react */
  if (interrupted_by_signal) vs_interrupt(interrupted_by_signal);
}

/* ---- callbacks of the interpreter ---- */

static bool print_output(void *context, const char *text, size_t length) {
  cli_session *c = context;
  if (c->muted) return true;
  cli_report_settle(&c->reporter);
  if (length) c->midline = text[length - 1] != '\n';
  if (c->view) live_follow_output(c->view, text, length);
  if (fwrite(text, 1, length, c->output) == length) return true;
  cli_output_fails(c);
  return false;
}

static const char *read_input(void *context, size_t *length) {
  cli_session *c = context;
  fflush(stdout); /* prints the program's question before its answer is read */
  if (c->editor) return cli_repl_line(c, length);
  ssize_t got = getline(&c->line, &c->line_room, stdin);
  if (got < 0) return NULL;
  *length = (size_t)got;
  return c->line;
}

static void print_value(void *context, const char *text, size_t length) {
  cli_session *c = context;
  char name[24];
  c->results++;
  struct live_follower *view = c->view;
  c->view = NULL; /* print_output must not copy this value to the live view, which prints values itself */
  if (c->editor) print_output(c, name, (size_t)snprintf(name, sizeof name, cli_colours(1) ? "\033[2m$%u =\033[0m "
      : "$%u = ", c->results));
  print_output(c, text, length);
  print_output(c, "\n", 1);
  c->view = view;
  if (view) live_follow_value(view, text, length);
}

static void print_diagnostic(void *context, const vs_diagnostic *d) {
  cli_session *c = context;
  if (c->muted) return;
  if (d->severity == VS_SEVERITY_ERROR && d->outcome == VS_OUTCOME_MACHINE) atomic_store(&c->watch.told, true);
  cli_report_diagnostic(&c->reporter, d);
  if (c->view) live_follow_diagnose(c->view, d);
}
static bool read_untrusted(void *context, const char *path, char **text, size_t *length, const char **why) {
  return cli_untrusted_read(&((cli_session *)context)->untrusted, path, text, length, why);
}
static bool list_untrusted(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                           void *to, const char **why) {
  return cli_untrusted_list(&((cli_session *)context)->untrusted, path, take, to, why);
}
static bool poll_limits(void *context) {
  cli_watch_poll(&((cli_session *)context)->watch);
  return false;
}
static void print_progress(void *context, const vs_progress *p) {
  cli_report_progress(&((cli_session *)context)->reporter, p);
}

/* ---- running programs ---- */

/* Returns all text of the stream, which the caller frees. If reading fails, returns NULL and sets errno. */
static char *read_all(FILE *from, size_t *length) {
  size_t room = 65536, used = 0;
  char *text = malloc(room);
  while (text) {
    used += fread(text + used, 1, room - used, from);
    if (used < room) break;
    char *more = room > SIZE_MAX / 2 ? NULL : realloc(text, room *= 2);
    if (!more) free(text);
    text = more;
  }
  if (text && ferror(from)) {
    free(text);
    text = NULL;
  }
  *length = used;
  return text;
}

vs_outcome cli_session_eval(cli_session *c, const char *name, unsigned first_line, const char *text, size_t length,
                            unsigned flags) {
  c->drawn = true;
  cli_watch_begin(&c->watch, true);
  vs_outcome outcome = vs_eval_text(c->scheme, name, first_line, text, length, flags);
  cli_watch_end(&c->watch);
  return outcome;
}

static vs_outcome run_file(cli_session *c, const char *path, unsigned flags) {
  c->drawn = true;
  cli_watch_begin(&c->watch, true);
  vs_outcome outcome = vs_eval_file(c->scheme, path, flags);
  cli_watch_end(&c->watch);
  return outcome;
}

static vs_outcome run_source(cli_session *c, const cli_source *source) {
  c->watch.name = source->kind == CLI_SOURCE_EXPRESSION ? "-e" : source->text;
  if (source->kind == CLI_SOURCE_EXPRESSION) return cli_session_eval(c, "-e", 1, source->text, strlen(source->text),
      c->stops);
  if (strcmp(source->text, "-") != 0) return run_file(c, source->text, c->stops);
  size_t length;
  char *text = read_all(stdin, &length);
  if (!text && errno == EINTR) {
    fputs("vs: interrupted\n", stderr);
    return VS_OUTCOME_INTERRUPTED;
  }
  if (!text) {
    fprintf(stderr, "vs: standard input: %s\n", strerror(errno));
    return VS_OUTCOME_USAGE;
  }
  vs_outcome outcome = cli_session_eval(c, "standard-input", 1, text, length, VS_EVAL_PROGRAM);
  free(text);
  return outcome;
}

static bool set_parameters(cli_session *c) {
  for (size_t i = 0; i < c->options->define_count; i++) {
    char *equals = strchr(c->options->defines[i], '=');
    *equals = 0;
    bool ok = vs_parameter_set(c->scheme, c->options->defines[i], equals + 1);
    *equals = '=';
    if (!ok) return false;
  }
  return true;
}

static const char *title(const cli_options *o) {
  for (size_t i = o->source_count; i-- > 0;)
    if (o->sources[i].kind == CLI_SOURCE_FILE)
      return strcmp(o->sources[i].text, "-") == 0 ? "standard input" : o->sources[i].text;
  return "-e";
}

/* Returns true if the model has used all parameters that options -D set. Otherwise reports the unused ones as mistakes
 * of the command line. */
static bool all_parameters_used(cli_session *c) {
  const char *name;
  vs_parameter_info p;
  size_t i = 0;
  for (; (name = vs_parameter_unused(c->scheme, i)) != NULL; i++) {
    cli_nearby near = cli_nearby_start(name);
    size_t count = vs_parameter_count(c->scheme);
    for (size_t k = 0; k < count && vs_parameter_get(c->scheme, k, &p); k++) cli_nearby_offer(&near, p.name);
    char typed[400];
    cli_inputs_typed(name, typed, sizeof typed);
    fprintf(stderr, "vs: %s: %s: the model has no such parameter", title(c->options), typed);
    if (strncmp(typed, "-D ", 3) != 0) fprintf(stderr, " %s", name);
    if (near.best) fprintf(stderr, "; perhaps %s", near.best);
    else if (count) fputs("; it has", stderr);
    for (size_t k = 0; !near.best && k < count && vs_parameter_get(c->scheme, k, &p); k++)
      fprintf(stderr, "%s %s", k ? "," : "", p.name);
    fputc('\n', stderr);
  }
  if (i > 0 && c->options->command == CLI_COMMAND_sweep) cli_sweep_tell_unknown(c->options->results);
  return i == 0;
}

static bool write_standard_output(void *context, const void *bytes, size_t count) {
  (void)context;
  return fwrite(bytes, 1, count, stdout) == count;
}

vs_outcome cli_session_write(cli_session *c, const cli_target *t) {
  vs_outcome outcome;
  bool more = c->frame && c->frame < c->options->frames.count; /* a later frame may read the file */
  if (more && !cli_replaced_keep(&c->replaced, t->path)) {
    fprintf(stderr, "vs: %s: the file as it was cannot be kept until the last frame: %s\n", t->path, strerror(errno));
    return VS_OUTCOME_USAGE;
  }
  cli_watch_begin(&c->watch, false);
  if (strcmp(t->path, "-") == 0)
    outcome = vs_write_drawing_to(c->scheme, t->format, &c->options->output, write_standard_output, c);
  else outcome = vs_write_drawing(c->scheme, t->path, t->format, &c->options->output);
  cli_watch_end(&c->watch);
  cli_report_settle(&c->reporter);
  return outcome;
}

/* Returns true if the target is a picture of one view, made by an external program. */
static bool is_picture(const cli_target *t) {
  const vs_format_info *f = t->format ? vs_format_find(t->format) : NULL;
  return f && f->worker && strcmp(t->path, "-") != 0;
}

/* A function that is called for each output file: cli_session_write or may_write. */
typedef vs_outcome write_fn(cli_session *c, const cli_target *t);

/* Returns VS_OUTCOME_DONE if the model has not read the output file. Otherwise reports that the file is an input. */
static vs_outcome may_write(cli_session *c, const cli_target *t) {
  if (t->path != c->options->dependencies && !cli_dependencies_add(c, t->path)) return VS_OUTCOME_MACHINE;
  if (strcmp(t->path, "-") == 0 || !vs_is_input(c->scheme, t->path)) return VS_OUTCOME_DONE;
  cli_report_settle(&c->reporter);
  fprintf(stderr, "vs: %s: the model reads this file, and no output may replace it; name another file by -o\n",
          t->path);
  return VS_OUTCOME_USAGE;
}

/* Calls `write` for a picture of each of the model's views. */
static vs_outcome write_views(cli_session *c, const cli_target *t, write_fn *write) {
  vs_outcome outcome = VS_OUTCOME_DONE;
  const char *view;
  for (size_t i = 0; outcome != VS_OUTCOME_INTERRUPTED && (view = vs_view_name(c->scheme, i)) != NULL; i++) {
    char path[CLI_PATH_ROOM];
    if (!cli_path_with(t->path, view, path)) return VS_OUTCOME_USAGE;
    c->options->output.view = view;
    vs_outcome one = write(c, &(cli_target){path, t->format});
    if (one == VS_OUTCOME_INTERRUPTED || outcome == VS_OUTCOME_DONE) outcome = one;
  }
  c->options->output.view = NULL;
  return outcome;
}

/* Returns the length of the text up to the %p in the path's file name, or SIZE_MAX if it has none. */
static size_t place_of_part(const char *path) {
  const char *name = cli_file_name(path), *at = strstr(name, "%p");
  return at ? (size_t)(at - path) : SIZE_MAX;
}

/* Writes the path with names[at] for its %p. A character that a file name should not have becomes a hyphen; the second
 * part whose name becomes the same gets the number 2. Returns false, after a message, if the path is too long. */
static bool part_path(const char *path, const char *const *names, size_t at, char out[CLI_PATH_ROOM]) {
  size_t before = place_of_part(path), same = 1, length = strlen(names[at]);
  char number[24] = "", spelled[CLI_PATH_ROOM];
  if (length < CLI_PATH_ROOM) {
    for (size_t i = 0; i <= length; i++) spelled[i] = cli_file_letter(names[at][i], i == 0);
    for (size_t k = 0; k < at; k++) {
      size_t i = 0;
      while (i <= length && names[k][i] && cli_file_letter(names[k][i], i == 0) == spelled[i]) i++;
      same += i == length && names[k][i] == '\0';
    }
    if (same > 1) snprintf(number, sizeof number, "-%zu", same);
    int written = snprintf(out, CLI_PATH_ROOM, "%.*s%s%s%s", (int)before, path, spelled, number, path + before + 2);
    if (written > 0 && written < CLI_PATH_ROOM) return true;
  }
  fprintf(stderr, "vs: %s: the name of part \"%.60s\" is too long\n", path, names[at]);
  return false;
}

/* Calls `write` for a file of each of the model's parts. */
static vs_outcome write_parts(cli_session *c, const cli_target *t, write_fn *write) {
  size_t count = 0, again = 0;
  vs_outcome outcome = vs_part_names(c->scheme, NULL, 0, &count);
  if (outcome == VS_OUTCOME_DONE && count == 0) {
    cli_report_settle(&c->reporter);
    fprintf(stderr, "vs: -o %s: the model has no part: (part \"name\" object) makes one\n", t->path);
    return VS_OUTCOME_MODEL;
  }
  const char **names = outcome == VS_OUTCOME_DONE ? vs_fresh(count, sizeof *names) : NULL;
  if (!names) return outcome == VS_OUTCOME_DONE ? VS_OUTCOME_MACHINE : outcome;
  outcome = vs_part_names(c->scheme, names, count, &again);
  for (size_t i = 0; outcome != VS_OUTCOME_INTERRUPTED && i < count && i < again; i++) {
    char path[CLI_PATH_ROOM];
    vs_outcome one = VS_OUTCOME_USAGE;
    c->options->output.part = names[i];
    if (part_path(t->path, names, i, path)) one = write(c, &(cli_target){path, t->format});
    if (one == VS_OUTCOME_INTERRUPTED || outcome == VS_OUTCOME_DONE) outcome = one;
  }
  c->options->output.part = NULL;
  free(names);
  return outcome;
}

/* writes the name OUT-007.png for the file OUT.png and frame 7 */
static bool frame_path(const char *path, const cli_frames *f, long frame, char name[CLI_PATH_ROOM]) {
  char number[CLI_FRAME_ROOM];
  cli_frame_number(f, frame, number);
  return cli_path_with(path, number, name);
}

static vs_outcome write_target(cli_session *c, const cli_target *t, write_fn *write) {
  char path[CLI_PATH_ROOM];
  cli_target numbered = {path, t->format};
  if (c->frame) {
    if (!frame_path(t->path, &c->options->frames, c->frame, path)) return VS_OUTCOME_USAGE;
    t = &numbered;
  }
  if (place_of_part(t->path) != SIZE_MAX) return write_parts(c, t, write);
  if (!c->options->all_views) return write(c, t);
  if (is_picture(t) && vs_view_name(c->scheme, 0)) return write_views(c, t, write);
  c->options->output.view = "*";
  vs_outcome outcome = write(c, t);
  c->options->output.view = NULL;
  return outcome;
}

/* Writes all outputs, or none if an output would replace an input. Continues after a failure; the first failure is the
 * outcome. */
static vs_outcome write_all(cli_session *c) {
  vs_outcome outcome = VS_OUTCOME_DONE;
  cli_inputs_tell(c->told, c->scheme);
  for (size_t i = 0; i < c->options->target_count && outcome == VS_OUTCOME_DONE; i++)
    outcome = write_target(c, &c->options->targets[i], may_write);
  if (c->options->dependencies && outcome == VS_OUTCOME_DONE)
    outcome = may_write(c, &(cli_target){c->options->dependencies, NULL});
  if (outcome != VS_OUTCOME_DONE) return outcome;
  for (size_t i = 0; i < c->options->target_count && outcome != VS_OUTCOME_INTERRUPTED; i++) {
    c->options->output.last = i + 1 == c->options->target_count && !c->options->interactive &&
                              c->frame == c->options->frames.to;
    vs_outcome one = write_target(c, &c->options->targets[i], cli_session_write);
    if (one == VS_OUTCOME_INTERRUPTED || outcome == VS_OUTCOME_DONE) outcome = one;
  }
  return outcome;
}

/* Runs all sources, and prints a line about their drawing. again: whether the prompt repeats the run. */
static vs_outcome run_sources(cli_session *c, bool again) {
  cli_options *o = c->options;
  cli_source model = {CLI_SOURCE_FILE, c->model};
  const cli_source *sources = c->model ? &model : o->sources;
  size_t count = c->model ? 1 : o->source_count;
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t i = 0; i < count && outcome == VS_OUTCOME_DONE && !vs_exit_requested(c->scheme, &c->exit_code); i++)
    outcome = run_source(c, &sources[i]);
  cli_report_settle(&c->reporter);
  /* When the prompt runs another model, the values of -D may be meant for the first model, so unused values are no
   * mistake. */
  if (outcome == VS_OUTCOME_DONE && !again && !all_parameters_used(c)) outcome = VS_OUTCOME_USAGE;
  bool files = o->command != CLI_COMMAND_sunstudy; /* files: whether the outputs are files; the output of sunstudy is a
                                                    * folder */
  if (outcome == VS_OUTCOME_DONE && !again && files && !cli_options_late(o, c->scheme)) outcome = VS_OUTCOME_USAGE;
  if (outcome == VS_OUTCOME_DONE && !o->quiet && count) {
    vs_summary summary;
    cli_watch_begin(&c->watch, false);
    outcome = vs_drawing_summary(c->scheme, &summary);
    cli_watch_end(&c->watch);
    if (outcome == VS_OUTCOME_DONE) {
      char name[CLI_PATH_ROOM];
      snprintf(name, sizeof name, c->frame ? "%s, frame %ld of %ld" : "%s", c->model ? c->model : title(o), c->frame,
               o->frames.count);
      cli_output_flush(c);
      cli_report_summary(name, &summary);
    }
  }
  return outcome;
}

vs_outcome cli_session_run(cli_session *c) {
  vs_outcome outcome = vs_restart(c->scheme);
  c->results = 0;
  return outcome == VS_OUTCOME_DONE ? run_sources(c, true) : outcome;
}

/* ---- running frames ---- */

/* Returns true if every output file of the frame is newer than the model's files, so that the frame need not be made.
 * Returns false if there are several views. */
static bool frame_stands(const cli_session *c, long frame) {
  const cli_options *o = c->options;
  struct stat made, source;
  char path[CLI_PATH_ROOM];
  for (size_t i = 0; i < o->target_count; i++) {
    if (o->all_views || !frame_path(o->targets[i].path, &o->frames, frame, path)) return false;
    if (stat(path, &made) != 0) return false;
    for (size_t k = 0; k < o->source_count; k++)
      if (o->sources[k].kind == CLI_SOURCE_FILE &&
          (stat(o->sources[k].text, &source) != 0 || source.st_mtime > made.st_mtime)) return false;
  }
  return true;
}

static bool set_frame(cli_session *c, const cli_frames *f) {
  char value[CLI_FRAME_ROOM];
  cli_frame_value(f, c->frame, value);
  return vs_parameter_set(c->scheme, f->parameter, value);
}

static bool frame_parameter_used(cli_session *c, const cli_frames *f) {
  const char *name;
  for (size_t i = 0; (name = vs_parameter_unused(c->scheme, i)) != NULL; i++)
    if (strcmp(name, f->parameter) == 0) {
      fprintf(stderr, "vs: --frames: the model has no parameter %s; (define-parameter %s %.1f) makes one\n", name, name,
              f->from_value);
      return false;
    }
  return true;
}

/* Runs the model once for each frame; meshes are cached between frames. Ends at the first failure, since the next frame
 * would fail, too. */
static vs_outcome run_frames(cli_session *c) {
  const cli_frames *f = &c->options->frames;
  vs_outcome outcome = VS_OUTCOME_DONE;
  bool fresh = true;
  for (c->frame = f->from; outcome == VS_OUTCOME_DONE && !ended && c->frame <= f->to; c->frame++) {
    if (f->resume && frame_stands(c, c->frame)) continue;
    if (!fresh) outcome = vs_restart(c->scheme);
    fresh = false;
    if (outcome == VS_OUTCOME_DONE && (!set_parameters(c) || !set_frame(c, f))) outcome = VS_OUTCOME_USAGE;
    if (outcome == VS_OUTCOME_DONE) outcome = run_sources(c, true);
    bool used = outcome != VS_OUTCOME_DONE || (frame_parameter_used(c, f) && all_parameters_used(c));
    if (!used) outcome = VS_OUTCOME_USAGE;
    if (outcome == VS_OUTCOME_DONE && !cli_options_late(c->options, c->scheme)) outcome = VS_OUTCOME_USAGE;
    if (outcome == VS_OUTCOME_DONE && c->options->output.strict) outcome = cli_rules_hold(c->scheme);
    if (outcome == VS_OUTCOME_DONE && c->options->parameters) cli_report_parameters(stdout, c->scheme);
    bool unread = cli_replaced_unread(&c->replaced, c->scheme, c->frame);
    if (outcome == VS_OUTCOME_DONE && unread) outcome = write_all(c);
    unread = unread && cli_replaced_unread(&c->replaced, c->scheme, c->frame); /* writing reads pictures and fonts */
    if (!unread) outcome = VS_OUTCOME_USAGE;
    if (vs_exit_requested(c->scheme, &c->exit_code)) break;
  }
  cli_replaced_end(&c->replaced);
  return outcome;
}

static vs_outcome run_batch(cli_session *c) {
  cli_options *o = c->options;
  vs_outcome outcome;
  if (o->frames.count) {
    outcome = run_frames(c);
    c->frame = 0;
  } else {
    if (!set_parameters(c)) return VS_OUTCOME_USAGE;
    vs_sun_span span;
    if (o->command == CLI_COMMAND_sunstudy && !cli_sun_options(o, &span)) return VS_OUTCOME_USAGE;
    if (o->command == CLI_COMMAND_profile) cli_profile_begin(c);
    outcome = o->command == CLI_COMMAND_diff ? cli_difference(c)
        : o->command == CLI_COMMAND_fit ? cli_fit(c)
        : o->command == CLI_COMMAND_cure ? cli_cure(c, cli_session_write)
        : o->command == CLI_COMMAND_test ? cli_test_run(c, run_file) : run_sources(c, false);
    if (outcome == VS_OUTCOME_DONE && o->parameters) cli_report_parameters(stdout, c->scheme);
    if (o->command == CLI_COMMAND_sweep && outcome == VS_OUTCOME_DONE) cli_sweep_tell(o->results, c->scheme);
    if (o->command == CLI_COMMAND_profile && outcome != VS_OUTCOME_USAGE) { /* prints the profile of a run that was
                                                                             * ended early, too */
      vs_outcome told = cli_profile(c, outcome == VS_OUTCOME_DONE);
      if (outcome == VS_OUTCOME_DONE) outcome = told;
    }
    if (outcome == VS_OUTCOME_DONE && o->output.strict) outcome = cli_rules_hold(c->scheme);
    if (outcome == VS_OUTCOME_DONE && o->command != CLI_COMMAND_fit && o->command != CLI_COMMAND_cure &&
        o->command != CLI_COMMAND_profile)
      outcome = o->command == CLI_COMMAND_sunstudy ? cli_sun_command(c) : write_all(c);
  }
  if (outcome == VS_OUTCOME_DONE && !cli_dependencies_write(c)) outcome = VS_OUTCOME_USAGE;
  if (o->stats) cli_report_statistics(c->scheme, o->stats_json);
  return outcome;
}

/* The process ends without freeing its memory, since the system frees it at once. Only with a leak checker is the
 * memory freed. exit() writes files that the program left open. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define TIDY 1
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define TIDY 1
#endif
#ifndef TIDY
#define TIDY 0
#endif

/* Opens each standard stream that is closed, in such a way that reading or writing it fails. Otherwise the next file
 * that is opened would get its number, and receive the program's text. */
static void hold_standard_streams(void) {
  for (int i = 0; i <= STDERR_FILENO; i++)
    if (fcntl(i, F_GETFD) == -1 && errno == EBADF && open("/dev/null", i == STDIN_FILENO ? O_WRONLY : O_RDONLY) != i)
      _exit(VS_OUTCOME_USAGE);
}

static void running_in_view(vs_scheme *scheme) { interrupted_by_signal = scheme; }

static void hear_signals(void) {
  struct sigaction action = {.sa_handler = on_interrupt};
  sigemptyset(&action.sa_mask);
  static const int heard[] = {SIGINT, SIGTERM, SIGHUP};
  for (size_t i = 0; i < sizeof heard / sizeof *heard; i++) {
    struct sigaction old; /* a signal that is ignored (nohup, background jobs) stays ignored */
    if (sigaction(heard[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(heard[i], &action, NULL);
  }
}

static bool confine_view(void *context, vs_options *interpreter) {
  cli_session *c = context;
  if (!cli_untrusted_begin(&c->untrusted, c->options)) return false;
  *interpreter = c->options->interpreter;
  return true;
}

/* Runs `vs view`. Ctrl-C ends the whole command, not only the current run of the model. */
static vs_outcome view_model(cli_options *o) {
  cli_session stranger = { .untrusted = { .folder = -1, .alive = -1 }, .options = o };
  live_options live = { .model = o->sources[0].text,
                        .interpreter = o->interpreter,
                        .output = o->output,
                        .parameters = (const char *const *)o->defines,
                        .parameter_count = o->define_count,
                        .open_browser = !o->quiet,
                        .told = stdout,
                        .ended = &interrupts,
                        .running = running_in_view,
                        .check = cli_study_check_text };
  if (o->untrusted) {
    live.read_only = true;
    live.check = NULL;
    live.confined = (live_confinement){
      .context = &stranger, .read_file = read_untrusted, .list_folder = list_untrusted, .confine = confine_view };
  }
  else cli_new_model(o->sources[0].text);
  hear_signals();
  vs_outcome outcome = live_view(&live);
  if (o->untrusted) cli_untrusted_end(&stranger.untrusted);
  return outcome;
}

/* Prints that memory is out, where the library could not report it. The message is the library's. */
static void tell_no_memory(const vs_options *o) {
  if (!o->limit_memory) fputs("vs: out of memory\n", stderr);
  else fprintf(stderr, "vs: out of memory: stopped at %.12g MB, the limit\n", (double)o->limit_memory / 1048576);
}

/* Runs the files and texts of the command line in an interpreter, then the prompt if requested. Returns the exit code.
 * Sets *told if a failure of standard output was reported. */
static int run_session(cli_options *o, bool *told) {
  bool own_output = o->to_stdout || o->command == CLI_COMMAND_params || o->command == CLI_COMMAND_diff ||
                    o->command == CLI_COMMAND_fit || o->command == CLI_COMMAND_cure ||
                    o->command == CLI_COMMAND_test ||
                    o->command == CLI_COMMAND_profile;
  FILE *output = own_output ? stderr : stdout;
  cli_session session = { .options = o, .told = cli_inputs_find(), .output = output,
                          .interrupts = &interrupts, .ended = &ended };
  cli_watch_open(&session.watch);
  if (o->untrusted && !cli_untrusted_begin(&session.untrusted, o)) return VS_OUTCOME_USAGE;
  if (o->interactive && !o->untrusted) session.stops = VS_EVAL_STOP;
  session.reporter.progress = !o->quiet && isatty(STDERR_FILENO);
  session.reporter.quiet = o->quiet;
  o->interpreter.host = (vs_host){ .context = &session,
                              .output = print_output,
                              .input = read_input,
                              .diagnose = print_diagnostic,
                              .progress = print_progress,
                              .poll = o->interpreter.limit_time > 0 ? poll_limits : NULL,
                              .value = print_value };
  if (o->untrusted) o->interpreter.host.read_file = read_untrusted;
  if (o->untrusted) o->interpreter.host.list_folder = list_untrusted;
  if (!TIDY) o->interpreter.alloc = cli_memory;
  o->interpreter.keep_calls = o->verbose || o->interactive || o->source_count == 0;
  o->interpreter.ends_after_interrupt =
      !TIDY && o->command == CLI_COMMAND_NONE && !o->interactive && o->source_count > 0;
  if (o->interpreter.limit_memory) cli_limits_memory(o->interpreter.limit_memory);
  session.watch.limit = o->interpreter.limit_time;
  session.watch.prompt = o->interactive || o->source_count == 0;
  /* If the watching thread cannot be started, only the library's own polls limit the time. */
  if (session.watch.limit > 0 && !cli_limits_watch(&session.watch)) session.watch.limit = 0;
  session.scheme = vs_new(&o->interpreter);
  vs_outcome outcome = VS_OUTCOME_MACHINE;
  if (!session.scheme) {
    tell_no_memory(&o->interpreter);
  } else {
    interrupted_by_signal = session.scheme;
    hear_signals();
    outcome = run_batch(&session);
    cli_inputs_tell(session.told, session.scheme);
    if (o->verbose && outcome == VS_OUTCOME_MODEL) cli_report_calls(session.scheme, stderr);
    int code;
    if (vs_exit_requested(session.scheme, &code)) {
      if (outcome == VS_OUTCOME_DONE) session.exit_code = code;
    } else if (!ended && !o->untrusted && (o->interactive || o->source_count == 0)) {
      outcome = cli_repl(&session);
      vs_exit_requested(session.scheme, &session.exit_code);
    }
    if (ended) outcome = VS_OUTCOME_INTERRUPTED;
    /* If memory ran out before the library could report an error, prints this message. */
    if (outcome == VS_OUTCOME_MACHINE && session.reporter.errors == 0) tell_no_memory(&o->interpreter);
    interrupted_by_signal = NULL;
    if (TIDY) vs_free(session.scheme);
  }
  cli_watch_close(&session.watch);
  if (o->untrusted) cli_untrusted_end(&session.untrusted);
  free(session.line);
  free(session.model);
  cli_dependencies_free(&session);
  *told = session.output_failed;
  if (session.output_failed && outcome == VS_OUTCOME_DONE) outcome = VS_OUTCOME_USAGE;
  return outcome == VS_OUTCOME_DONE ? session.exit_code : (int)outcome;
}

/* Runs the session in a separate process, for vs test and vs sweep. A failure of standard output is reported by the
 * parent process. */
static int run_alone(cli_options *o) {
  bool told = false;
  int code = run_session(o, &told);
  return fflush(stdout) == 0 && !ferror(stdout) ? code : VS_OUTCOME_USAGE;
}

/* Runs `vs render` or `vs sweep` in this process. */
static vs_outcome run_parts(const cli_options *o) {
  return o->command == CLI_COMMAND_sweep ? cli_sweep_command(o, &interrupts, run_alone)
                                         : cli_render_command(o, &interrupts);
}

static int run_words(int argc, char **argv);

/* Runs the command. Returns the exit code. Sets *told if a failure of standard output was reported. */
static int run_command(int argc, char **argv, bool *told) {
  if (argc >= 3 && strcmp(argv[1], "help") == 0) return cli_help_command(argc - 2, argv + 2);
  cli_options options;
  cli_verdict verdict = cli_options_parse(&options, argc, argv);
  if (verdict != CLI_GO) {
    cli_options_free(&options);
    return verdict == CLI_STOP ? VS_OUTCOME_DONE : VS_OUTCOME_USAGE;
  }
  if (options.command == CLI_COMMAND_view) {
    vs_outcome outcome = view_model(&options);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.watch) {
    hear_signals();
    int last = 0;
    for (int i = 0; i < argc; i++)
      if (strcmp(argv[i], "--watch") != 0) argv[last++] = argv[i];
    argv[last] = NULL;
    int code = cli_watch_files(&options, &interrupts, argv, run_words);
    cli_options_free(&options);
    return code;
  }
  if (options.command == CLI_COMMAND_render || options.command == CLI_COMMAND_sweep) {
    hear_signals();
    vs_outcome outcome =
        options.cluster.on ? cli_cluster_command(&options, &interrupts, run_parts) : run_parts(&options);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_jobs) {
    hear_signals();
    vs_outcome outcome = cli_jobs_command(&options, &interrupts);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_test) {
    hear_signals();
    int code = cli_test_command(&options, &interrupts, run_alone);
    cli_options_free(&options);
    return code;
  }
  if (options.command == CLI_COMMAND_lsp) {
    vs_outcome outcome = cli_language_server(&options, run_words);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_jupyter) {
    hear_signals();
    vs_outcome outcome = cli_jupyter_command(&options, &interrupts, &ended);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_mcp) {
    hear_signals();
    vs_outcome outcome = cli_mcp_server(&options, &interrupts, run_words);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_add || options.command == CLI_COMMAND_new ||
      options.command == CLI_COMMAND_search) {
    vs_outcome outcome = options.command == CLI_COMMAND_add   ? cli_add_command(&options)
                         : options.command == CLI_COMMAND_new ? cli_new_command(&options)
                                                              : cli_search_command(&options);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_format) {
    vs_outcome outcome = cli_format_command(&options);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command == CLI_COMMAND_ast || options.command == CLI_COMMAND_check ||
      options.command == CLI_COMMAND_doc || options.command == CLI_COMMAND_translate) {
    vs_outcome outcome = cli_study(&options);
    cli_options_free(&options);
    return (int)outcome;
  }
  if (options.command >= CLI_COMMAND_tone && options.command <= CLI_COMMAND_denoise) {
    vs_outcome outcome = cli_exr_command(&options);
    cli_options_free(&options);
    return (int)outcome;
  }
  int code = run_session(&options, told);
  cli_options_free(&options);
  return code;
}

/* Runs the command, and ends standard output. Returns the exit code. */
static int run_words(int argc, char **argv) {
  bool told = false;
  int code = run_command(argc, argv, &told);
  return cli_output_end(code, told);
}

int main(int argc, char **argv) {
  hold_standard_streams();
  /* Ignores signals, so that a write to a pipe without a reader, or beyond the largest permitted file size, fails
   * instead of ending the process. Outputs are then completed or removed, and the exit code shows the failure. */
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  return run_words(argc, argv);
}
