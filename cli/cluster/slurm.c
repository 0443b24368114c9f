/* Calls sbatch, squeue and scancel. */
#define _GNU_SOURCE
#include "cli/cluster/slurm.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cluster/job_process.h"
#include "model/store/array.h"

enum { WORD_ROOM = JOB_PATH_ROOM + 64, MOST_WORDS = 24 };

/* The command line of a call of sbatch. */
typedef struct { char texts[MOST_WORDS][WORD_ROOM]; const char *words[MOST_WORDS]; size_t count; } call;

static void put(call *c, const char *before, const char *value) {
  if (c->count + 1 >= MOST_WORDS) return;
  char *to = c->texts[c->count];
  snprintf(to, WORD_ROOM, "%s%s", before, value);
  c->words[c->count++] = to;
  c->words[c->count] = NULL;
}

static bool missing(const char *program) {
  fprintf(stderr, "vs: Slurm's %s is missing here: run this on a node of the cluster from which jobs are submitted, or "
          "use --on local\n", program);
  return false;
}

/* Submits a script. Returns the number of the job, which lives as long as the record, or NULL after a message. */
static const char *submit(job_record *r, call *c, const char *script, const volatile sig_atomic_t *ended) {
  char path[JOB_PATH_ROOM], work[JOB_PATH_ROOM], *said = NULL;
  if (!job_record_real_path(r, "", work)) return NULL;
  const char *partition = strchr(r->on, ':'), *id = NULL;
  job_record_path(r, script, path);
  if (partition) put(c, "--partition=", partition + 1);
  put(c, "--chdir=", r->packed ? work : r->directory), put(c, "--open-mode=", "append");
  put(c, "", "--requeue"), put(c, "", path);
  int code = job_run(c->words, ended, &said, NULL);
  if (code == JOB_NO_PROGRAM) missing("sbatch");
  else if (code != 0 || !said || !strspn(said, "0123456789"))
    fprintf(stderr, "vs: Slurm refused the job (sbatch ended with %d)\n", code);
  else id = sweep_keep_text(&r->memory, said, strspn(said, "0123456789"));
  free(said);
  return id;
}

static void begin(call *c, const job_record *r, const char *what) {
  c->count = 0;
  const char *slash = strrchr(r->folder, '/');
  put(c, "", "sbatch"), put(c, "", "--parsable");
  char name[256];
  snprintf(name, sizeof name, "vs-%s-%.200s", what, slash ? slash + 1 : r->folder);
  put(c, "--job-name=", name);
}

/* Names the file for the output of a job. A packed job runs in the folder of these files. */
static void put_log(call *c, const job_record *r, const char *name) {
  char path[JOB_PATH_ROOM];
  job_record_path(r, name, path);
  put(c, "--output=", r->packed ? name : path);
}

static void put_limits(call *c, const job_record *r) {
  char number[24];
  if (*r->time) put(c, "--time=", r->time);
  if (*r->memory_limit) put(c, "--mem=", r->memory_limit);
  snprintf(number, sizeof number, "%zu", r->cpus ? r->cpus : 1);
  put(c, "--cpus-per-task=", number);
}

static bool cancel(const char *id, const volatile sig_atomic_t *ended) {
  const char *words[] = {"scancel", id, NULL};
  int code = *id ? job_run(words, ended, NULL, NULL) : 0;
  if (code == JOB_NO_PROGRAM) return missing("scancel");
  return code == 0 || fprintf(stderr, "vs: Slurm did not cancel job %s (scancel ended with %d)\n", id, code) < 0;
}

/* Writes the names of the nodes on which a bundle has failed, with commas between them. */
static void list_nodes(const job_record *r, char *names, size_t room) {
  char path[JOB_PATH_ROOM], *line = NULL, all[JOB_PATH_ROOM] = ",";
  size_t line_room = 0;
  job_record_path(r, JOB_NODES, path);
  FILE *f = fopen(path, "rb");
  while (f && getline(&line, &line_room, f) > 0) {
    char name[300];
    line[strcspn(line, "\n")] = 0;
    if (snprintf(name, sizeof name, ",%.250s,", line) < 3 || strstr(all, name)) continue;
    if (strlen(all) + strlen(name) < sizeof all) strcat(all, name + 1);
  }
  if (f) fclose(f);
  free(line);
  snprintf(names, room, "%.*s", (int)(strlen(all) > 1 ? strlen(all) - 2 : 0), all + 1);
}

/* Submits the bundles, but not to the nodes in `avoid`, a list of names. Sets r->array. */
static bool submit_bundles(job_record *r, call *c, const char *avoid, const volatile sig_atomic_t *ended) {
  char array[64];
  begin(c, r, "parts"), put_limits(c, r);
  snprintf(array, sizeof array, "1-%zu", r->bundle_count);
  put(c, "--array=", array);
  put_log(c, r, "bundle-%a.log");
  if (*r->first) put(c, "--dependency=afterok:", r->first), put(c, "", "--kill-on-invalid-dep=yes");
  if (*avoid) put(c, "--exclude=", avoid);
  const char *id = submit(r, c, "bundles.sh", ended);
  r->array = id ? id : "";
  return id != NULL;
}

bool slurm_submit(job_record *r, const volatile sig_atomic_t *ended) {
  char avoid[JOB_PATH_ROOM], minutes[24];
  call *c = vs_zeros(1, sizeof *c);
  if (!c) return sweep_no_memory();
  r->array = r->join = "";
  list_nodes(r, avoid, sizeof avoid);
  bool ok = !r->bundle_count || submit_bundles(r, c, avoid, ended);
  if (!ok && *avoid) {
    fprintf(stderr, "vs: no other node than %s is there\n", avoid);
    ok = submit_bundles(r, c, "", ended);
  }
  if (ok) {
    begin(c, r, "join");
    snprintf(minutes, sizeof minutes, "%zu", 30 + r->parts / 20);
    put(c, "--time=", minutes), put_log(c, r, "join.log");
    if (*r->array) put(c, "--dependency=afterany:", r->array);
    const char *id = submit(r, c, "join.sh", ended);
    if (!id) cancel(r->array, ended);
    ok = id != NULL;
    if (ok) r->join = id;
  }
  free(c);
  return ok;
}

bool slurm_submit_first(job_record *r, const volatile sig_atomic_t *ended) {
  call *c = vs_zeros(1, sizeof *c);
  if (!c) return sweep_no_memory();
  begin(c, r, "expose"), put_limits(c, r), put(c, "--array=", "1");
  put_log(c, r, "first.log");
  const char *id = submit(r, c, "bundles.sh", ended);
  free(c);
  r->first = id ? id : "";
  return id != NULL;
}

bool slurm_ask(const job_record *r, const volatile sig_atomic_t *ended, slurm_state *out) {
  const char *words[] = { "squeue", "--noheader", "--array", "--me", "--format=%F %T", NULL },
             *own = getenv("SLURM_JOB_ID");
  char *said = NULL, *rest, *line, *state;
  *out = (slurm_state){0};
  int code = job_run(words, ended, &said, NULL);
  if (code == JOB_NO_PROGRAM) missing("squeue");
  else if (code != 0) fprintf(stderr, "vs: Slurm does not answer (squeue ended with %d)\n", code);
  for (line = code == 0 ? strtok_r(said, "\n", &rest) : NULL; line; line = strtok_r(NULL, "\n", &rest)) {
    if (!(state = strchr(line, ' '))) continue;
    *state++ = 0;
    bool ours =
        !strcmp(line, r->first) || !strcmp(line, r->array) || (!strcmp(line, r->join) && !(own && !strcmp(own, line)));
    if (!ours || !strncmp(state, "COMPLETING", 10)) continue;
    if (!strncmp(state, "PENDING", 7) || !strncmp(state, "REQUEUE", 7)) out->waiting++;
    else out->running++;
  }
  free(said);
  return code == 0;
}

bool slurm_cancel(const job_record *r, const volatile sig_atomic_t *ended) {
  bool join = cancel(r->join, ended), array = cancel(r->array, ended);
  return cancel(r->first, ended) && array && join;
}
