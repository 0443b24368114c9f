/* Implements --on: measures the first part, puts the others into bundles, and runs or submits them.
 *
 * With Slurm the chain is: the first part, whose time and memory set the limits of the others and which meters a film's
 * exposure; an array of bundles; the join. The join submits parts that are missing once more, and itself after them. */
#define _GNU_SOURCE
#include "cli/cluster/cluster_command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/batch/part_states.h"
#include "cli/cluster/job_bundles.h"
#include "cli/cluster/job_pack.h"
#include "cli/cluster/job_process.h"
#include "cli/cluster/slurm.h"
#include "cli/sweep/sweep_states.h"
#include "model/store/array.h"

static bool is_parallel(const job_record *r) { return !strcmp(r->on, "parallel"); }

/* ---- states ---- */

bool job_states(const job_record *r, cli_part_states *out) {
  cli_options o;
  char **words;
  *out = (cli_part_states){0};
  if (!VS_FRESH(words, r->whole_count + 3)) return fputs("vs: out of memory\n", stderr), false;
  size_t n = 0;
  words[n++] = (char *)(uintptr_t)"vs", words[n++] = (char *)(uintptr_t)r->command;
  for (size_t i = 0; i < r->whole_count; i++) words[n++] = (char *)(uintptr_t)r->whole[i];
  words[n] = NULL;
  bool ok = cli_options_parse(&o, (int)n, words) == CLI_GO;
  ok = ok && (o.command == CLI_COMMAND_sweep ? cli_sweep_states : cli_part_states_read)(&o, r->folder, out);
  cli_options_free(&o);
  free(words);
  return ok;
}

/* ---- the first part ---- */

static bool set_text(job_record *r, const char **to, const char *format, double value) {
  char text[40];
  snprintf(text, sizeof text, format, value);
  return (*to = sweep_keep_text(&r->memory, text, strlen(text))) != NULL;
}

/* Sets the limits that the user has not given. Time: three times that of a bundle, plus five minutes. Memory: 1.5 times
 * that of the measured part, for each part that runs at a time, plus 256 MB. */
static bool set_limits(job_record *r, const job_use *use) {
  bool sweeps = !strcmp(r->command, "sweep");
  double busy = use->seconds > 0 ? use->processor / use->seconds : 1;
  if (!r->cpus) r->cpus = busy > 1.5 ? (size_t)floor(busy + 0.5) : 1;
  double at_once = sweeps ? (double)r->cpus : 1, size = (double)(r->bundle ? r->bundle : 1);
  bool ok = *r->time || set_text(r, &r->time, "%.0f", ceil(3 * r->seconds * size / 60) + 5);
  return ok && (*r->memory_limit || set_text(r, &r->memory_limit, "%.0f", ceil(1.5 * use->memory * at_once + 256)));
}

/* Makes the first part of the batch in this process, measures its time and memory, and sets the record's limits.
 * Returns false, with the outcome in *code, if the command must end. */
static bool measure(job_record *r, const cli_options *o, const volatile sig_atomic_t *ended, int *code) {
  job_use use;
  cli_part_states states;
  const char **words = r->packed ? NULL : job_words_of(r, "1..1");
  *code = r->packed ? job_pack_sample(r, ended, &use) : words ? job_run(words, ended, NULL, &use) : VS_OUTCOME_MACHINE;
  free(words);
  if (*ended) *code = VS_OUTCOME_INTERRUPTED;
  bool shared = o->frames.count || o->tiles.columns; /* frames share the exposure of the first frame, and tiles share
                                                      * one model */
  if (*code == VS_OUTCOME_USAGE || *code == VS_OUTCOME_INTERRUPTED) return false;
  if (*code != VS_OUTCOME_DONE && shared) return false;
  if (!r->packed) {
    if (!job_states(r, &states)) return *code = VS_OUTCOME_USAGE, false;
    r->seconds = states.seconds > 0 ? states.seconds : use.seconds;
    free(states.at);
  }
  if (!r->bundle) r->bundle = job_bundle_size(r->seconds, r->parts, job_is_on_slurm(r));
  if (set_limits(r, &use)) return true;
  return *code = VS_OUTCOME_MACHINE, false;
}

/* ---- GNU parallel ---- */

static vs_outcome run_parallel(job_record *r, const volatile sig_atomic_t *ended) {
  char script[JOB_PATH_ROOM], log[JOB_PATH_ROOM], jobs[24], range[64];
  long processors = sysconf(_SC_NPROCESSORS_ONLN), each = r->cpus ? (long)r->cpus : 1;
  job_record_path(r, "bundles.sh", script), job_record_path(r, "parallel.log", log);
  snprintf(jobs, sizeof jobs, "%ld", processors > each ? processors / each : 1);
  snprintf(range, sizeof range, "%zu", r->bundle_count);
  /* exec replaces the shell by GNU parallel, which then receives the signal that ends the batch */
  const char *words[] = {"sh", "-c", "n=$1; shift; exec \"$@\" << END\n$(seq \"$n\")\nEND\n", "sh", range,
                         "parallel", "--will-cite", "--quote", "--jobs", jobs, "--joblog", log, "--termseq",
                         "TERM,5000,KILL", "sh", script, NULL};
  if (!r->bundle_count) return VS_OUTCOME_DONE;
  const char *known[] = {"parallel", "--version", NULL};
  char *said = NULL;
  int code = job_run(known, ended, &said, NULL);
  free(said), said = NULL;
  if (code == JOB_NO_PROGRAM)
    return fputs("vs: --on parallel needs GNU parallel: install the package parallel, or use --on local\n", stderr),
           VS_OUTCOME_WORKER;
  job_run(words, ended, r->quiet ? &said : NULL, NULL); /* the exit code of GNU parallel is the number of bundles that
                                                         * failed */
  free(said);
  return *ended ? VS_OUTCOME_INTERRUPTED : VS_OUTCOME_DONE;
}

/* ---- joining the parts, and repeating missing parts ---- */

static bool bundle_rest(job_record *r, size_t *rest) {
  cli_part_states states;
  if (!job_states(r, &states)) return false;
  r->parts = states.count;
  *rest = cli_part_states_count(&states, PART_MISSING) + cli_part_states_count(&states, PART_KILLED);
  bool ok = job_bundles_make(r, states.at, 0) && job_scripts_write(r);
  free(states.at);
  return ok;
}

bool job_submit_rest(job_record *r, const volatile sig_atomic_t *ended) {
  size_t rest;
  r->first = "", r->joined = false;
  if (!bundle_rest(r, &rest) || !slurm_submit(r, ended) || !job_record_write(r)) return false;
  if (!r->quiet)
    printf("%s: %zu parts in %zu bundles submitted again as job %s\n", r->folder, rest, r->bundle_count,
           *r->array ? r->array : r->join);
  return true;
}

/* Joins the parts that were made into the result. Returns the outcome. */
static vs_outcome join_once(job_record *r, const volatile sig_atomic_t *ended) {
  const char **words = job_words_of_all(r, "--join", NULL);
  int code = words ? job_run(words, ended, NULL, NULL) : VS_OUTCOME_MACHINE;
  free(words);
  return *ended ? VS_OUTCOME_INTERRUPTED : code >= JOB_NO_PROGRAM ? VS_OUTCOME_MACHINE : (vs_outcome)code;
}

vs_outcome job_join(job_record *r, const volatile sig_atomic_t *ended) {
  for (;;) {
    size_t rest = 0;
    vs_outcome outcome = join_once(r, ended);
    if (outcome == VS_OUTCOME_INTERRUPTED) return outcome;
    bool again = outcome != VS_OUTCOME_DONE && r->attempt < r->retries && bundle_rest(r, &rest) && rest > 0;
    if (!again) return r->joined = true, r->code = outcome, job_record_write(r) ? outcome : VS_OUTCOME_USAGE;
    r->attempt++;
    if (job_is_on_slurm(r)) return job_submit_rest(r, ended) ? outcome : VS_OUTCOME_WORKER;
    if (!job_record_write(r) || run_parallel(r, ended) != VS_OUTCOME_DONE) return VS_OUTCOME_INTERRUPTED;
  }
}

/* ---- the command ---- */

static vs_outcome run_here(job_record *r, const cli_options *o, vs_outcome (*here)(const cli_options *o)) {
  cli_options local = *o;
  local.keep_going = true;
  if (!job_record_write(r)) return VS_OUTCOME_USAGE;
  vs_outcome outcome = here(&local);
  r->joined = outcome != VS_OUTCOME_INTERRUPTED, r->code = outcome;
  return job_record_write(r) || outcome != VS_OUTCOME_DONE ? outcome : VS_OUTCOME_USAGE;
}

/* Prints a limit, with the unit that Slurm gives to a bare number. */
static void print_limit(const char *limit, const char *unit) {
  if (*limit) printf(", %s", limit);
  if (*limit && !limit[strspn(limit, "0123456789")]) printf(" %s", unit);
}

/* Returns true if the exposure of all frames follows from the first. */
static bool is_metered(const cli_options *o) {
  return o->command == CLI_COMMAND_render && o->frames.count && !o->output.development.fixed;
}

/* Makes a bundle of the first part alone. Returns false after a message. */
static bool bundle_first(job_record *r) {
  r->bundles = sweep_keep(&r->memory, 1, sizeof *r->bundles);
  if (!r->bundles) return false;
  r->bundles[0] = (job_range){1, 1}, r->bundle_count = 1;
  return job_scripts_write(r);
}

static vs_outcome submit(job_record *r, const cli_options *o, const volatile sig_atomic_t *ended) {
  bool given = o->cluster.time && o->cluster.memory;
  int code = VS_OUTCOME_DONE;
  size_t first = given || r->packed ? 0 : 1;
  if (!(given && !r->packed) && !measure(r, o, ended, &code)) return (vs_outcome)code;
  if (!r->bundle) r->bundle = job_bundle_size(0, r->parts, true);
  if (first == 0 && is_metered(o)) {
    if (!bundle_first(r) || !slurm_submit_first(r, ended)) return VS_OUTCOME_WORKER;
    first = 1;
  }
  if (!job_bundles_make(r, NULL, first) || !job_scripts_write(r) || !job_record_write(r)) return VS_OUTCOME_USAGE;
  if (!slurm_submit(r, ended)) return slurm_cancel(r, ended), VS_OUTCOME_WORKER;
  if (!job_record_write(r)) return slurm_cancel(r, ended), VS_OUTCOME_USAGE;
  if (o->quiet) return VS_OUTCOME_DONE;
  printf("%s: %zu parts in %zu bundles submitted as job %s, and the join as job %s\n", r->folder, r->parts,
         r->bundle_count, *r->array ? r->array : "-", r->join);
  size_t cpus = r->cpus ? r->cpus : 1;
  printf("each bundle: %zu parts, %zu processor%s", r->bundle, cpus, cpus == 1 ? "" : "s");
  print_limit(r->time, "minutes"), print_limit(r->memory_limit, "MB");
  printf("\nvs jobs %s shows them\n", r->folder);
  return VS_OUTCOME_DONE;
}

static vs_outcome run_bundles(job_record *r, const cli_options *o, const volatile sig_atomic_t *ended) {
  int code;
  size_t first = r->packed ? 0 : 1;
  if (!job_record_write(r)) return VS_OUTCOME_USAGE;
  if (!measure(r, o, ended, &code)) return (vs_outcome)code;
  if (r->packed && is_metered(o)) {
    if (!bundle_first(r)) return VS_OUTCOME_USAGE;
    if (run_parallel(r, ended) == VS_OUTCOME_INTERRUPTED) return VS_OUTCOME_INTERRUPTED;
    first = 1;
  }
  if (!job_bundles_make(r, NULL, first) || !job_scripts_write(r) || !job_record_write(r)) return VS_OUTCOME_USAGE;
  vs_outcome outcome = run_parallel(r, ended);
  return outcome == VS_OUTCOME_DONE ? job_join(r, ended) : outcome;
}

/* Runs the second frame of a film without its picture, because its parameter is the first between whole numbers.
 * Returns false, after the model's message, if the model refuses the parameter: all frames of the batch would fail. */
static bool takes_frames(const cli_options *o, vs_outcome (*here)(const cli_options *o)) {
  cli_options second = *o;
  if (o->frames.count < 2 || !strcmp(o->cluster.on, "local")) return true;
  second.trying = second.quiet = true, second.cluster = (cli_cluster){0}, second.only = "2..2";
  second.frames.from = second.frames.to = 2;
  return here(&second) != VS_OUTCOME_USAGE;
}

/* Returns true if jobs of an earlier submission are not done yet, after a message. */
static bool is_submitted(const char *folder, const volatile sig_atomic_t *ended) {
  job_record before;
  slurm_state state = {0};
  bool found, busy = !job_record_read(&before, folder, &found);
  if (!busy && found && job_is_on_slurm(&before) && !before.joined) {
    busy = !slurm_ask(&before, ended, &state);
    if (state.running + state.waiting > 0)
      busy = fprintf(stderr,
                     "vs: %s: the parts of this folder are jobs of Slurm already; vs jobs %s shows them, and vs jobs "
                     "cancel %s ends them\n",
                     folder, folder, folder) > 0;
  }
  job_record_free(&before);
  return busy;
}

vs_outcome cli_cluster_command(const cli_options *o, const volatile sig_atomic_t *ended,
                               vs_outcome (*here)(const cli_options *o)) {
  char folder[JOB_PATH_ROOM];
  cli_part_states states;
  job_record r;
  if (!cli_part_folder(o, folder, sizeof folder)) return VS_OUTCOME_USAGE;
  vs_outcome outcome = VS_OUTCOME_USAGE;
  if (!job_record_make(&r, o, folder)) return job_record_free(&r), VS_OUTCOME_MACHINE;
  int lock = job_record_lock(&r);
  if (lock >= 0 && !is_submitted(folder, ended) && takes_frames(o, here) && job_states(&r, &states)) {
    r.parts = states.count;
    free(states.at);
    job_record_forget_nodes(&r);
    if (r.packed && !(job_pack_make(&r, o, here) && job_pack_scripts(&r))) outcome = VS_OUTCOME_USAGE;
    else if (job_is_on_slurm(&r)) outcome = submit(&r, o, ended);
    else outcome = is_parallel(&r) ? run_bundles(&r, o, ended) : run_here(&r, o, here);
  }
  if (lock >= 0) close(lock);
  job_record_free(&r);
  return outcome;
}
