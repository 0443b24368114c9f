/* Implements `vs jobs`. The words of the command line are an optional verb, such as cancel, and folders of results. */
#define _GNU_SOURCE
#include "cli/cluster/jobs_command.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/batch/part_states.h"
#include "cli/cluster/cluster_command.h"
#include "cli/cluster/job_bundles.h"
#include "cli/cluster/job_pack.h"
#include "cli/cluster/job_process.h"
#include "cli/cluster/slurm.h"
#include "cli/json.h"
#include "model/store/array.h"

enum { SECONDS_TO_ASK = 2 };

/* A batch with its present state. */
typedef struct {
  job_record record;
  cli_part_states states;
  slurm_state jobs;          /* the batch's jobs in Slurm; with --on local or parallel, its process counts as one
                              * running job */
  size_t done, failed, left; /* numbers of parts; left: parts that are missing or were killed */
  bool live;                 /* whether a job of the batch runs or waits */
} batch;

typedef struct {
  const cli_options *options;
  const volatile sig_atomic_t *ended;
  char here[JOB_PATH_ROOM];  /* the folder in which `vs jobs` began */
  bool first;                /* whether no folder was shown yet */
} run;

/* Reads the state of the batch in the folder, and changes to the folder of its command. Returns false after a
 * message. */
static bool learn(const run *w, const char *folder, batch *b) {
  bool found;
  *b = (batch){0};
  if (chdir(w->here) != 0 || !job_record_read(&b->record, folder, &found)) return false;
  if (!found)
    return fprintf(stderr, "vs jobs: %s: no parts were run here with --on (there is no jobs/jobs.json)\n", folder),
           false;
  job_record *r = &b->record;
  r->quiet = w->options->quiet;
  if (!job_record_enter(r) || !job_states(r, &b->states)) return false;
  if (job_is_on_slurm(r) && !r->joined && !slurm_ask(r, w->ended, &b->jobs)) return false;
  if (!job_is_on_slurm(r) && job_record_is_locked(r)) b->jobs.running = 1;
  b->live = b->jobs.running + b->jobs.waiting > 0;
  b->done = cli_part_states_count(&b->states, PART_DONE);
  b->failed = cli_part_states_count(&b->states, PART_FAILED);
  b->left = b->states.count - b->done - b->failed;
  return true;
}

static void forget(batch *b) {
  free(b->states.at);
  job_record_free(&b->record);
}

/* Returns the estimated seconds until all parts are done, or -1 if unknown. */
static double seconds_left(const batch *b) {
  double each = b->states.seconds > 0 ? b->states.seconds : b->record.seconds;
  size_t at_once = b->jobs.running ? b->jobs.running : 1;
  if (!b->live || each <= 0) return -1;
  if (!strcmp(b->record.on, "local")) return -1;
  return each * (double)b->left / (double)at_once;
}

/* ---- showing ---- */

static void show_time(double seconds) {
  if (seconds < 90) printf(", about %.0f s left", seconds);
  else if (seconds < 90 * 60) printf(", about %.0f min left", seconds / 60);
  else printf(", about %.1f h left", seconds / 3600);
}

/* Prints each node that was refused, with the reason: its sample part had other bytes, or it could not unpack the
 * model. */
static void show_refused(const job_record *r) {
  char path[JOB_PATH_ROOM], *line = NULL, *all = NULL;
  size_t room = 0, size = 0;
  job_record_path(r, JOB_REFUSED, path);
  FILE *f = r->packed ? fopen(path, "rb") : NULL, *seen = f ? open_memstream(&all, &size) : NULL;
  while (seen && getline(&line, &room, f) > 0) {
    bool again = fflush(seen) == 0 && strstr(all, line) != NULL;
    if (!again) printf("  refused: %s", line), fputs(line, seen);
  }
  if (seen) fclose(seen);
  if (f) fclose(f);
  free(line), free(all);
}

/* Returns the name of the files of Slurm with the messages of parts that failed or are missing, or of a join that
 * failed; NULL if nothing has failed. */
static const char *messages_of(const batch *b) {
  const job_record *r = &b->record;
  if (!job_is_on_slurm(r)) return NULL;
  if (b->failed || (b->left && !b->live)) return "bundle-*.log";
  return !b->live && r->joined && r->code != VS_OUTCOME_DONE ? "join.log" : NULL;
}

static void show(const char *folder, const batch *b) {
  const job_record *r = &b->record;
  printf("%s: vs %s --on %s: %zu of %zu parts done", folder, r->command, r->on, b->done, b->states.count);
  if (b->failed) printf(", %zu failed", b->failed);
  if (b->live && job_is_on_slurm(r)) printf(", %zu jobs run, %zu wait", b->jobs.running, b->jobs.waiting);
  if (b->live && !job_is_on_slurm(r)) printf(", runs on %s", r->host);
  double left = seconds_left(b);
  if (b->live && left >= 0) show_time(left);
  if (!b->live && b->left) printf(", %zu left: vs jobs retry %s", b->left, folder);
  else if (!b->live && r->joined) printf(", ended with exit code %d", r->code);
  else if (!b->live) printf(", not joined: vs jobs join %s", folder);
  putchar('\n');
  const char *log = messages_of(b);
  if (log) printf("  messages: %s/jobs/%s\n", folder, log);
  show_refused(r);
  fflush(stdout);
}

static void show_json(const char *folder, const batch *b) {
  const job_record *r = &b->record;
  fputs("{\"folder\": ", stdout), cli_json_text(stdout, folder);
  printf(", \"command\": \"%s\", \"on\": ", r->command), cli_json_text(stdout, r->on);
  printf(", \"parts\": %zu, \"done\": %zu, \"failed\": %zu, \"left\": %zu, \"running\": %zu, \"waiting\": %zu",
         b->states.count, b->done, b->failed, b->left, b->jobs.running, b->jobs.waiting);
  fputs(", \"seconds_left\": ", stdout);
  double left = seconds_left(b);
  if (left < 0) fputs("null", stdout);
  else cli_json_number(stdout, left);
  if (r->joined && !b->live) printf(", \"code\": %d}", r->code);
  else fputs(", \"code\": null}", stdout);
}

/* ---- the verbs: each is called in the folder of the batch's command ---- */

typedef vs_outcome verb(run *w, const char *folder, batch *b);

static vs_outcome list(run *w, const char *folder, batch *b) {
  if (!w->options->json) return show(folder, b), VS_OUTCOME_DONE;
  fputs(w->first ? "[" : ",\n ", stdout);
  w->first = false;
  return show_json(folder, b), VS_OUTCOME_DONE;
}

static vs_outcome cancel(run *w, const char *folder, batch *b) {
  const job_record *r = &b->record;
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  if (!b->live) return printf("%s: nothing runs\n", folder), VS_OUTCOME_DONE;
  if (job_is_on_slurm(r)) {
    if (!slurm_cancel(r, w->ended)) return VS_OUTCOME_WORKER;
  } else if (strcmp(host, r->host) != 0)
    return fprintf(stderr, "vs jobs: %s: process %ld runs on %s; cancel it there\n", folder, r->process, r->host),
           VS_OUTCOME_USAGE;
  else if (kill((pid_t)r->process, SIGTERM) != 0)
    return fprintf(stderr, "vs jobs: %s: process %ld: %s\n", folder, r->process, strerror(errno)), VS_OUTCOME_USAGE;
  printf("%s: cancelled; %zu of %zu parts are done, vs jobs retry %s makes the others\n", folder, b->done,
         b->states.count, folder);
  return VS_OUTCOME_DONE;
}

static vs_outcome retry(run *w, const char *folder, batch *b) {
  job_record *r = &b->record;
  if (b->live) return fprintf(stderr, "vs jobs: %s: its parts run; vs jobs cancel %s ends them\n", folder, folder),
                      VS_OUTCOME_USAGE;
  if (!b->left && r->joined) return printf("%s: no part is left to make\n", folder), VS_OUTCOME_DONE;
  r->attempt = 0;
  if (job_is_on_slurm(r)) {
    int lock = job_record_lock(r);
    if (lock >= 0) job_record_forget_nodes(r);
    bool ok = lock >= 0 && job_submit_rest(r, w->ended);
    if (lock >= 0) close(lock);
    return ok ? VS_OUTCOME_DONE : VS_OUTCOME_USAGE;
  }
  const char **words = job_words_of_all(r, "--on", r->on);
  int code = words ? job_run(words, w->ended, NULL, NULL) : VS_OUTCOME_MACHINE;
  free(words);
  return code >= JOB_NO_PROGRAM ? VS_OUTCOME_MACHINE : (vs_outcome)code;
}

static vs_outcome join(run *w, const char *folder, batch *b) {
  job_record *r = &b->record;
  if (b->live) return fprintf(stderr, "vs jobs: %s: its parts run; vs jobs cancel %s ends them\n", folder, folder),
                      VS_OUTCOME_USAGE;
  int lock = job_record_lock(r);
  vs_outcome outcome = lock >= 0 && job_record_own(r) ? job_join(r, w->ended) : VS_OUTCOME_USAGE;
  if (lock >= 0) close(lock);
  return outcome;
}

/* Waits until no job of the batch runs. Returns the exit code of the batch's join. */
static vs_outcome await(run *w, const char *folder, batch *b) {
  size_t shown = SIZE_MAX;
  bool known = true;
  while (known && b->live && !*w->ended) {
    if (b->done + b->failed != shown && !w->options->quiet) show(folder, b);
    shown = b->done + b->failed;
    nanosleep(&(struct timespec){.tv_sec = SECONDS_TO_ASK}, NULL);
    forget(b);
    known = learn(w, folder, b);
  }
  if (*w->ended) return VS_OUTCOME_INTERRUPTED;
  if (known && !w->options->quiet) show(folder, b);
  return !known || !b->record.joined ? VS_OUTCOME_WORKER : (vs_outcome)b->record.code;
}

static vs_outcome act(run *w, const char *folder, verb *what) {
  batch b;
  vs_outcome outcome = learn(w, folder, &b) ? what(w, folder, &b) : VS_OUTCOME_USAGE;
  forget(&b);
  return outcome;
}

/* ---- the command ---- */

static const struct { const char *name; verb *what; } verbs[] = {
  {"cancel", cancel}, {"retry", retry}, {"join", join}, {"wait", await}};

static verb *verb_of(const char *word) {
  for (size_t i = 0; i < sizeof verbs / sizeof *verbs; i++)
    if (!strcmp(word, verbs[i].name)) return verbs[i].what;
  return NULL;
}

static int by_text(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* Finds the folders in the current folder that have a record of a batch. Returns their number; the caller frees the
 * names and the array. */
static size_t find_folders(char ***folders) {
  size_t count = 0, room = 0;
  char path[JOB_PATH_ROOM];
  struct dirent *entry;
  DIR *in = opendir(".");
  *folders = NULL;
  while (in && (entry = readdir(in)) != NULL) {
    if (entry->d_name[0] == '.' && entry->d_name[1]) continue;
    snprintf(path, sizeof path, "%s/jobs/jobs.json", entry->d_name);
    if (access(path, R_OK) != 0 || !VS_GROW(*folders, room, count + 1)) continue;
    if (((*folders)[count] = strdup(entry->d_name)) != NULL) count++;
  }
  if (in) closedir(in);
  if (count) qsort(*folders, count, sizeof **folders, by_text);
  return count;
}

static vs_outcome act_on_all(run *w, char *const *folders, size_t count, verb *what) {
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t i = 0; i < count && !*w->ended; i++) {
    vs_outcome one = act(w, folders[i], what);
    if (outcome == VS_OUTCOME_DONE) outcome = one;
  }
  return outcome;
}

vs_outcome cli_jobs_command(const cli_options *o, const volatile sig_atomic_t *ended) {
  run w = {.options = o, .ended = ended, .first = true};
  verb *what = o->source_count ? verb_of(o->sources[0].text) : NULL;
  size_t from = what ? 1 : 0, count = o->source_count - from;
  char **folders = NULL, *given[1];
  vs_outcome outcome = VS_OUTCOME_DONE;
  if (!getcwd(w.here, sizeof w.here)) return fprintf(stderr, "vs jobs: %s\n", strerror(errno)), VS_OUTCOME_USAGE;
  if (o->json && what) return fputs("vs jobs: --json is for the list alone\n", stderr), VS_OUTCOME_USAGE;
  for (size_t i = 0; i < count && !*ended; i++) {
    char name[JOB_PATH_ROOM];
    snprintf(name, sizeof name, "%s", o->sources[from + i].text);
    for (size_t n = strlen(name); n > 1 && name[n - 1] == '/';) name[--n] = 0;
    given[0] = name;
    vs_outcome one = act_on_all(&w, given, 1, what ? what : list);
    if (outcome == VS_OUTCOME_DONE) outcome = one;
  }
  if (count == 0) {
    count = find_folders(&folders);
    if (count > 1 && what && what != await)
      outcome = (fprintf(stderr, "vs jobs: %zu folders have jobs here: name one of them\n", count), VS_OUTCOME_USAGE);
    else if (count == 0 && what)
      outcome = (fputs("vs jobs: no folder here has jobs\n", stderr), VS_OUTCOME_USAGE);
    else outcome = act_on_all(&w, folders, count, what ? what : list);
    for (size_t i = 0; i < count; i++) free(folders[i]);
    free(folders);
  }
  if (o->json) fputs(w.first ? "[]\n" : "]\n", stdout);
  return outcome;
}
