/* Implements `vs sweep`: runs the model for each set of parameters in a process, as many at a time as --jobs says.
 *
 * The process of a part is a copy of this one, which saves the start of a program. It sends the numbers that the model
 * reported through a pipe, whose end shows that the process has ended. Two files without a name receive the names of
 * the files that it read, and its messages. A part that fails or is killed affects no other. */
#define _GNU_SOURCE
#include "cli/sweep/sweep_command.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/batch/inputs_told.h"
#include "cli/batch/part_files.h"
#include "cli/batch/part_states.h"
#include "cli/batch/whole_file.h"
#include "cli/sweep/row_choice.h"
#include "cli/sweep/sweep_manifest.h"
#include "cli/sweep/sweep_plan.h"
#include "cli/sweep/sweep_results.h"
#include "model/store/array.h"

enum { PATH_ROOM = 4096, WAIT = 200 /* greatest milliseconds until a signal is noticed that arrives just before a
                                     * wait */ };
enum { THUMB_WIDTH = 480, THUMB_HEIGHT = 360 }; /* size of a picture without --size */

/* A process that runs a part. */
typedef struct {
  sweep_part *part;
  pid_t process;
  int numbers;                 /* reading end of the pipe that brings the part's numbers */
  int read, messages;          /* descriptors of the files for the names of files read and for messages, or -1 */
  struct timespec began, clock; /* time of day and monotonic clock at the start of the process */
  char *text; size_t length, room; /* text received so far from the pipe: name, NUL, value, NUL, ... */
} runner;

typedef struct {
  sweep_plan plan;
  const cli_options *options;
  const volatile sig_atomic_t *ended;
  int (*run)(cli_options *o);
  sweep_manifest *manifest;    /* NULL if the sweep has no folder for outputs */
  vs_scheme *inputs;           /* an interpreter that records the files read, which no output may replace */
  FILE *told;                  /* the stream for the lines about parts */
  runner *runners; size_t jobs, running;
  struct pollfd *polled;
  uint64_t *messages; size_t message_count, message_room; /* hashes of the messages printed so far */
  bool unknown;                /* whether the model lacks a parameter of the sets */
  bool made;                   /* whether a part succeeded, so that the external worker is known to work */
  bool unwritten;              /* whether the manifest could not be written */
  bool trying;                 /* whether parts run without outputs, only to learn which files they read */
} sweep;

/* ---- in the process of a part ---- */

static void send_text(int to, const char *text, size_t length) {
  while (length > 0) {
    ssize_t n = write(to, text, length);
    if (n < 0 && errno != EINTR) return;
    if (n > 0) text += n, length -= (size_t)n;
  }
}

void cli_sweep_tell(int to, const vs_scheme *s) {
  const char *name;
  char number[40];
  double value;
  for (size_t i = 0; (name = vs_report_get(s, i, &value)) != NULL; i++) {
    snprintf(number, sizeof number, "%.17g", value);
    send_text(to, name, strlen(name) + 1);
    send_text(to, number, strlen(number) + 1);
  }
}

void cli_sweep_tell_unknown(int to) { send_text(to, "\0?", 3); }

static bool was_passed(const cli_options *o, const char *option) {
  for (size_t i = 0; i < o->passed_count; i++)
    if (!strncmp(o->passed[i], option, strlen(option))) return true;
  return false;
}

/* Changes the options to those of the part: its parameters, and its files as outputs. */
static bool set_options(sweep *w, const sweep_part *p, cli_options *o) {
  sweep_memory *m = &w->plan.memory;
  char **defines = sweep_keep(m, o->define_count + p->set.count + 1, sizeof *defines);
  cli_target *targets = sweep_keep(m, p->file_count + 1, sizeof *targets);
  bool picture = false;
  if (!defines || !targets) return false;
  memcpy(defines, o->defines, o->define_count * sizeof *defines);
  for (size_t i = 0; i < p->set.count; i++) {
    const sweep_setting *s = &p->set.at[i];
    size_t room = strlen(s->name) + strlen(s->value) + 2;
    char *text = defines[o->define_count + i] = sweep_keep(m, room, 1);
    if (!text) return false;
    snprintf(text, room, "%s=%s", s->name, s->value);
  }
  for (size_t i = 0; i < p->file_count; i++) {
    const vs_format_info *f = vs_format_find(w->plan.outputs[i].format);
    targets[i] = (cli_target){p->files[i].path, w->plan.outputs[i].format};
    picture = picture || (f && f->worker);
  }
  o->defines = defines, o->define_count += p->set.count;
  o->targets = targets, o->target_count = w->trying ? 0 : p->file_count;
  if (picture && !o->output.width && !o->output.height) o->output.width = THUMB_WIDTH, o->output.height = THUMB_HEIGHT;
  if (picture && !was_passed(o, "--quality")) o->output.quality = VS_QUALITY_DRAFT;
  if (!o->output.threads && w->jobs > 1) {
    long each = sysconf(_SC_NPROCESSORS_ONLN) / (long)w->jobs;
    o->output.threads = each > 1 ? (unsigned)each : 1;
  }
  o->quiet = true;
  return true;
}

/* Names the options that set the parameters, for messages: "n=1,x=2". */
static void say_set(const sweep_part *p) {
  char set[PATH_ROOM];
  size_t used = 0;
  *set = 0;
  for (size_t i = 0; i < p->set.count && used < sizeof set; i++)
    used += (size_t)snprintf(set + used, sizeof set - used, "%s%s=%s", i ? "," : "", p->set.at[i].name,
                             p->set.at[i].value);
  cli_inputs_say_typed(set, NULL);
}

/* Runs the part in its process, and ends the process. */
static void run_here(sweep *w, const runner *r, int numbers, pid_t parent) {
  cli_options o = *w->options;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(VS_OUTCOME_INTERRUPTED);
  if (w->manifest) sweep_manifest_let_go(w->manifest);
  int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
  if (r->messages >= 0) dup2(r->messages, STDERR_FILENO);
  say_set(r->part);
  o.results = numbers;
  exit(set_options(w, r->part, &o) ? w->run(&o) : VS_OUTCOME_MACHINE);
}

/* ---- starting and ending parts ---- */

/* Returns true if no more parts are to start. */
static bool stops(const sweep *w) { return *w->ended || w->unknown || w->unwritten; }

static bool start(sweep *w, sweep_part *p) {
  int ends[2];
  pid_t parent = getpid();
  if (pipe2(ends, O_CLOEXEC) != 0) return false;
  runner r = {.part = p, .numbers = ends[0], .read = cli_inputs_begin(),
              .messages = memfd_create("visualscheme-messages", MFD_CLOEXEC)};
  if (r.read >= 0) fcntl(r.read, F_SETFD, FD_CLOEXEC);
  clock_gettime(CLOCK_REALTIME, &r.began);
  clock_gettime(CLOCK_MONOTONIC, &r.clock);
  fflush(NULL);
  r.process = fork();
  if (r.process == 0) run_here(w, &r, ends[1], parent);
  close(ends[1]);
  if (r.process > 0) return w->runners[w->running++] = r, true;
  close(ends[0]);
  if (r.read >= 0) close(r.read);
  if (r.messages >= 0) close(r.messages);
  return false;
}

/* Returns the contents of the unnamed file, which the caller frees, or NULL if it is empty. Closes the file. */
static char *take_file(int file, size_t *length) {
  struct stat is;
  char *text = NULL;
  *length = 0;
  if (file < 0) return NULL;
  if (fstat(file, &is) == 0 && is.st_size > 0 && VS_FRESH(text, (size_t)is.st_size + 1)) {
    ssize_t n = pread(file, text, (size_t)is.st_size, 0);
    *length = n > 0 ? (size_t)n : 0;
    text[*length] = 0;
  }
  close(file);
  return text;
}

/* Prints the messages of a part, unless another part has printed the same. */
static void print_messages(sweep *w, const char *text, size_t length) {
  uint64_t hash = cli_part_hash(CLI_HASH_BEGIN, text, length);
  for (size_t i = 0; i < w->message_count; i++)
    if (w->messages[i] == hash) return;
  fwrite(text, 1, length, stderr);
  if (VS_GROW(w->messages, w->message_room, w->message_count + 1)) w->messages[w->message_count++] = hash;
}

/* Reads the numbers that the process sent. */
static void take_numbers(sweep *w, runner *r) {
  sweep_part *p = r->part;
  size_t count = 0;
  for (size_t i = 0; i < r->length; i++) count += r->text[i] == 0;
  sweep_number *at = sweep_keep(&w->plan.memory, count / 2 + 1, sizeof *at);
  /* skips a number whose name is a parameter of the sweep, since the table already has that column */
  for (const char *name = r->text, *end = r->text + r->length; at && name < end;) {
    const char *value = memchr(name, 0, (size_t)(end - name));
    const char *last = value ? memchr(value + 1, 0, (size_t)(end - value - 1)) : NULL;
    if (!last) break;
    if (!*name) w->unknown = true;
    size_t column = *name && !sweep_value(p, name) ? sweep_number_column(&w->plan.table, name, strlen(name)) : SIZE_MAX;
    if (column != SIZE_MAX) at[p->number_count++] = (sweep_number){column, strtod(value + 1, NULL)};
    name = last + 1;
  }
  p->numbers = at;
  free(r->text);
}

static void keep_message(sweep *w, sweep_part *p, const char *text) {
  if (text && *text) p->message = sweep_keep_text(&w->plan.memory, text, strcspn(text, "\n"));
}

/* Prints the result of a part. */
static void tell(const sweep *w, const sweep_part *p) {
  if (w->options->quiet) return;
  if (p->fate == SWEEP_FAILED) fprintf(w->told, "%s: failed\n", p->name);
  else if (p->fate == SWEEP_STANDS) fprintf(w->told, "%s: up to date\n", p->name);
  else fprintf(w->told, "%s: made in %.1f s\n", p->name, p->seconds);
  fflush(w->told);
}

/* Records the result of a part in the manifest, and prints it. */
static void record(sweep *w, const sweep_part *p) {
  if (w->manifest && p->fate != SWEEP_STANDS && !w->unwritten) {
    const char *path = sweep_manifest_path(w->manifest);
    bool input = vs_is_input(w->inputs, path);
    if (input) fprintf(stderr, "vs sweep: %s: the model reads this file, and the sweep writes it\n", path);
    w->unwritten = input || !sweep_manifest_add(w->manifest, p);
  }
  tell(w, p);
}

/* Clears the results of the part, for another run. */
static void clear(sweep_part *p) {
  *p = (sweep_part){.set = p->set, .name = p->name, .same = p->same, .key = p->key, .files = p->files,
                    .file_count = p->file_count, .repeats = p->repeats};
}

/* Starts the part again if its run was killed, or if a worker that has worked before failed. Another run after an error
 * of the model or a limit would fail in the same way. */
static bool repeat(sweep *w, sweep_part *p, bool killed) {
  bool chance = killed || (p->code == VS_OUTCOME_WORKER && w->made);
  if (!chance || p->repeats >= w->options->retries || stops(w)) return false;
  p->repeats++;
  clear(p);
  return start(w, p);
}

/* Takes the results of a process that has closed its pipe. */
static void finish(sweep *w, runner *r) {
  sweep_part *p = r->part;
  int status = 0;
  size_t length;
  struct timespec now;
  while (waitpid(r->process, &status, 0) < 0 && errno == EINTR) continue;
  clock_gettime(CLOCK_MONOTONIC, &now);
  close(r->numbers);
  take_numbers(w, r);
  p->seconds = (double)(now.tv_sec - r->clock.tv_sec) + 1e-9 * (double)(now.tv_nsec - r->clock.tv_nsec);
  p->code = WIFEXITED(status) ? WEXITSTATUS(status) : *w->ended ? VS_OUTCOME_INTERRUPTED : SWEEP_KILLED;
  p->fate = p->code == VS_OUTCOME_DONE ? SWEEP_MADE : SWEEP_FAILED;
  char *names = take_file(r->read, &length);
  for (const char *at = names; at && at < names + length; at += strlen(at) + 1) vs_note_input(w->inputs, at);
  if (w->manifest && !w->trying)
    p->inputs = names ? sweep_manifest_inputs(w->manifest, names, length, r->began) : 0;
  free(names);
  if (w->trying) {
    clear(p);
    free(take_file(r->messages, &length));
    return;
  }
  for (size_t i = 0; p->fate == SWEEP_MADE && i < p->file_count; i++)
    if (!cli_part_hash_file(p->files[i].path, &p->files[i].hash)) p->inputs = 0;
  bool interrupted = p->code == VS_OUTCOME_INTERRUPTED;
  if (interrupted) p->fate = SWEEP_NOT_TRIED;
  w->made = w->made || p->fate == SWEEP_MADE;
  char *text = take_file(r->messages, &length);
  if (p->fate == SWEEP_FAILED && repeat(w, p, !WIFEXITED(status))) {
    free(text);
    return;
  }
  if (!WIFEXITED(status) && !interrupted) {
    fprintf(stderr, "vs sweep: %s: the run was killed by signal %d\n", p->name, WTERMSIG(status));
    keep_message(w, p, "the run was killed");
  } else if (p->fate == SWEEP_FAILED) keep_message(w, p, text);
  if (!interrupted) record(w, p);
  if (text && !interrupted) print_messages(w, text, length);
  free(text);
}

/* Reads the numbers that have arrived through the pipe. Returns true if the process has closed its pipe. */
static bool hear(runner *r) {
  if (!VS_GROW(r->text, r->room, r->length + 4096)) return true;
  ssize_t n = read(r->numbers, r->text + r->length, r->room - r->length);
  if (n > 0) r->length += (size_t)n;
  return n == 0 || (n < 0 && errno != EINTR);
}

/* Waits until a process sends something, and takes the results of those that have ended. */
static void await(sweep *w, bool *asked) {
  for (size_t i = 0; *w->ended && !*asked && i < w->running; i++) kill(w->runners[i].process, SIGTERM);
  *asked = *w->ended;
  for (size_t i = 0; i < w->running; i++) w->polled[i] = (struct pollfd){.fd = w->runners[i].numbers, .events = POLLIN};
  if (poll(w->polled, w->running, WAIT) <= 0) return;
  for (size_t i = w->running; i-- > 0;) {
    if (!w->polled[i].revents || !hear(&w->runners[i])) continue;
    runner done = w->runners[i];
    w->runners[i] = w->runners[--w->running];
    finish(w, &done);
  }
}

static void copy_result(sweep_table *t, sweep_part *p) {
  const sweep_part *from = &t->parts[p->same];
  p->fate = from->fate == SWEEP_MADE ? SWEEP_STANDS : from->fate, p->code = from->code, p->message = from->message;
  p->numbers = from->numbers, p->number_count = from->number_count, p->inputs = from->inputs;
}

/* Returns true if an earlier run of the part has failed, and is not to be repeated. The part then has its results. */
static bool keeps_failed(const sweep *w, sweep_part *p) {
  const cli_options *o = w->options;
  if (!w->manifest || !(o->keep_failed || o->join) || !sweep_manifest_failed(w->manifest, p)) return false;
  if (o->join || cli_part_state_of(p->code) == PART_FAILED) return true;
  clear(p);
  return false;
}

static void run_all(sweep *w) {
  sweep_table *t = &w->plan.table;
  bool asked = false;
  for (size_t next = w->plan.from; w->running > 0 || (next < w->plan.to && !stops(w));) {
    if (next == w->plan.to || w->running == w->jobs || stops(w)) {
      await(w, &asked);
      continue;
    }
    sweep_part *p = &t->parts[next++];
    if (p->same >= w->plan.from && t->parts + p->same != p) continue;
    if (!w->trying && w->manifest && sweep_manifest_stands(w->manifest, p)) record(w, p);
    else if (!w->trying && keeps_failed(w, p)) tell(w, p);
    else if (w->options->join) continue;
    else if (!start(w, p) && !w->trying) {
      p->fate = SWEEP_FAILED, p->code = VS_OUTCOME_MACHINE;
      keep_message(w, p, "no process could be started");
      record(w, p);
    }
  }
  for (size_t i = w->plan.from; i < w->plan.to; i++)
    if (t->parts[i].same >= w->plan.from && t->parts[i].same != i) copy_result(t, &t->parts[i]);
}

/* ---- results ---- */

/* Returns true if the model reads no file at this path. Otherwise prints a message. */
static bool may_write(const sweep *w, const char *path) {
  if (!vs_is_input(w->inputs, path)) return true;
  fprintf(stderr, "vs sweep: %s: the sweep or its model reads this file, and no output may replace it\n", path);
  return false;
}

/* Writes the table or the sheet, which replaces no input and gets its name only when it is complete. */
static bool write_file(const sweep *w, const char *path, const size_t *rows, size_t count) {
  cli_whole_file file;
  FILE *to = cli_whole_begin(&file, path);
  if (to && path == w->plan.sheet_path) sweep_write_sheet(to, &w->plan.table, rows, count, path);
  else if (to) sweep_write_table(to, &w->plan.table, rows, count);
  if (cli_whole_end(&file, true)) return true;
  return fprintf(stderr, "vs sweep: cannot write %s: %s\n", path, strerror(errno)), false;
}

/* Writes the table and the contact sheet of the chosen rows. Writes neither for a range of parts (--only) with a
 * folder. */
static bool write_results(sweep *w) {
  const cli_options *o = w->options;
  const sweep_plan *p = &w->plan;
  size_t *rows, count;
  if (p->only && p->folder) return true;
  if ((p->table_path && !may_write(w, p->table_path)) || (p->sheet_path && !may_write(w, p->sheet_path))) return false;
  if (!VS_FRESH(rows, p->table.count)) return sweep_no_memory();
  bool ok = sweep_choose_rows(&p->table, o->where, o->sort, rows, &count);
  if (p->table_path) ok = write_file(w, p->table_path, rows, count) && ok;
  else sweep_write_table(stdout, &p->table, rows, count);
  if (p->sheet_path) ok = write_file(w, p->sheet_path, rows, count) && ok;
  if (ok && (o->where || o->sort) && !o->quiet) sweep_write_best(w->told, &p->table, rows, count);
  free(rows);
  return ok;
}

/* Prints how many parts were made, are up to date, failed or were not tried. Returns the outcome of the first part that
 * failed. */
static vs_outcome sum_up(const sweep *w, bool *complete) {
  const sweep_table *t = &w->plan.table;
  size_t of[SWEEP_FAILED + 1] = {0};
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t i = w->plan.to; i-- > w->plan.from;) {
    of[t->parts[i].fate]++;
    int code = t->parts[i].code == SWEEP_KILLED ? VS_OUTCOME_MACHINE : t->parts[i].code;
    if (t->parts[i].fate == SWEEP_FAILED) outcome = (vs_outcome)code;
  }
  *complete = of[SWEEP_NOT_TRIED] == 0;
  if (!*complete && w->options->join && outcome == VS_OUTCOME_DONE) outcome = VS_OUTCOME_WORKER;
  if (w->options->quiet) return outcome;
  fprintf(w->told, "%s: %zu sets, %zu made, %zu up to date, %zu failed", w->options->sources[0].text,
          w->plan.to - w->plan.from, of[SWEEP_MADE], of[SWEEP_STANDS], of[SWEEP_FAILED]);
  fprintf(w->told, *complete ? "\n" : ", %zu not tried\n", of[SWEEP_NOT_TRIED]);
  return outcome;
}

/* Returns true if no output is a file that a run is known to have read. Otherwise prints a message. */
static bool may_write_all(const sweep *w) {
  const sweep_plan *p = &w->plan;
  bool ok = (!p->table_path || may_write(w, p->table_path)) && (!p->sheet_path || may_write(w, p->sheet_path));
  ok = ok && (!w->manifest || may_write(w, sweep_manifest_path(w->manifest)));
  for (size_t i = p->from; ok && i < p->to; i++)
    for (size_t k = 0; ok && k < p->table.parts[i].file_count; k++) ok = may_write(w, p->table.parts[i].files[k].path);
  return ok;
}

static bool exists(const char *path) { return path && access(path, F_OK) == 0; }

/* Called if outputs would replace files that no earlier sweep made. First runs all parts without outputs, since a part
 * may read the output of another part. Returns false, after a message, if an output is an input. */
static bool try_parts(sweep *w) {
  const sweep_plan *p = &w->plan;
  bool any = exists(p->table_path) || exists(p->sheet_path) || !sweep_manifest_is_new(w->manifest);
  for (size_t i = p->from; i < p->to; i++)
    for (size_t k = 0; k < p->table.parts[i].file_count; k++) any = any || exists(p->table.parts[i].files[k].path);
  if (!any || sweep_manifest_note_inputs(w->manifest, w->inputs) || w->options->join) return may_write_all(w);
  w->trying = true;
  run_all(w);
  w->trying = w->unknown = false;
  return may_write_all(w);
}

static vs_outcome run_sweep(sweep *w) {
  const sweep_plan *p = &w->plan;
  bool complete;
  w->trying = w->options->trying;
  if (w->trying) return run_all(w), VS_OUTCOME_DONE;
  if (!may_write_all(w)) return VS_OUTCOME_USAGE;
  if (p->folder && !(w->manifest = sweep_manifest_open(&w->plan.table, p->folder, p->only))) return VS_OUTCOME_USAGE;
  if (p->folder && !try_parts(w)) return sweep_manifest_abandon(w->manifest), VS_OUTCOME_USAGE;
  run_all(w);
  vs_outcome outcome = sum_up(w, &complete); /* when a sweep only joins parts, parts may be missing */
  if (*w->ended) return VS_OUTCOME_INTERRUPTED;
  if (w->unknown) return VS_OUTCOME_USAGE;
  bool ok = !w->unwritten && write_results(w);
  if (ok && complete && w->manifest && !p->only) ok = sweep_manifest_join(w->manifest);
  return ok || outcome != VS_OUTCOME_DONE ? outcome : VS_OUTCOME_USAGE;
}

vs_outcome cli_sweep_command(const cli_options *o, const volatile sig_atomic_t *ended, int (*run)(cli_options *o)) {
  sweep w = {.options = o, .ended = ended, .run = run, .inputs = vs_new(&o->interpreter)};
  vs_outcome outcome = VS_OUTCOME_USAGE;
  int watches = cli_inputs_find();
  long processors = sysconf(_SC_NPROCESSORS_ONLN);
  w.jobs = o->jobs ? o->jobs : processors > 1 ? (size_t)processors : 1;
  bool ok = w.inputs && VS_FRESH(w.runners, w.jobs) && VS_FRESH(w.polled, w.jobs);
  if (!ok) sweep_no_memory(), outcome = VS_OUTCOME_MACHINE;
  if (ok && access(o->sources[0].text, R_OK) != 0)
    ok = fprintf(stderr, "vs sweep: %s: %s\n", o->sources[0].text, strerror(errno)) < 0;
  ok = ok && (!o->where || sweep_where_reads(o->where)) && sweep_plan_make(&w.plan, o);
  if (ok) {
    w.told = w.plan.table_path ? stdout : stderr;
    vs_note_input(w.inputs, o->sources[0].text);
    for (size_t i = 0; i < o->set_count; i++)
      if (!strchr(o->sets[i], '=')) vs_note_input(w.inputs, o->sets[i]);
    outcome = run_sweep(&w);
  }
  if (w.manifest && w.inputs && watches >= 0) sweep_manifest_note_inputs(w.manifest, w.inputs);
  if (w.inputs) cli_inputs_tell(watches, w.inputs);
  if (watches >= 0) close(watches);
  sweep_manifest_close(w.manifest);
  sweep_plan_free(&w.plan);
  vs_free(w.inputs);
  free(w.runners), free(w.polled), free(w.messages);
  return outcome;
}
