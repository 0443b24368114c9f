/* Reads and writes the record of a batch with --on. */
#define _GNU_SOURCE
#include "cli/cluster/job_record.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cli/batch/whole_file.h"
#include "cli/cluster/job_pack.h"
#include "cli/json.h"
#include "cli/json_data.h"

enum { TRIES = 20 /* times to try a lock, for a second: a small join may start before its submission has ended */ };

/* ---- making ---- */

static const char **copy_words(sweep_memory *m, const char *const *words, size_t count) {
  const char **to = sweep_keep(m, count + 1, sizeof *to);
  for (size_t i = 0; to && i < count; i++)
    if (!(to[i] = sweep_keep_text(m, words[i], strlen(words[i])))) return NULL;
  return to;
}

static const char *keep(sweep_memory *m, const char *text) {
  return sweep_keep_text(m, text ? text : "", text ? strlen(text) : 0);
}

bool job_record_own(job_record *r) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  r->process = getpid();
  return (r->host = keep(&r->memory, host)) != NULL;
}

bool job_record_make(job_record *r, const cli_options *o, const char *folder) {
  char program[JOB_PATH_ROOM], *here = getcwd(NULL, 0);
  ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
  *r = (job_record){.cpus = o->cluster.cpus, .bundle = o->cluster.bundle, .retries = o->retries, .quiet = o->quiet,
                      .packed = o->cluster.pack};
  snprintf(r->folder, sizeof r->folder, "%s", folder);
  if (length <= 0 || !here) return free(here), fputs("vs: the path of the vs program cannot be found\n", stderr) < 0;
  program[length] = 0;
  sweep_memory *m = &r->memory;
  r->on = keep(m, o->cluster.on), r->directory = keep(m, here), r->program = keep(m, program);
  r->command = o->command == CLI_COMMAND_sweep ? "sweep" : "render";
  r->time = keep(m, o->cluster.time), r->memory_limit = keep(m, o->cluster.memory);
  r->first = r->array = r->join = "", r->results = keep(m, folder);
  r->whole = copy_words(m, o->whole, r->whole_count = o->whole_count);
  r->part = copy_words(m, o->part, r->part_count = o->part_count);
  free(here);
  return r->results && r->on && r->directory && r->program && r->time && r->memory_limit && r->whole && r->part &&
         job_record_own(r);
}

bool job_is_on_slurm(const job_record *r) { return !strncmp(r->on, "slurm", 5); }

void job_record_free(job_record *r) { sweep_memory_free(&r->memory); }

bool job_is_unpacked(void) { return getenv(JOB_PACKED) != NULL; }

bool job_record_enter(job_record *r) {
  if (!job_is_unpacked() && chdir(r->directory) != 0)
    return fprintf(stderr, "vs: %s: %s\n", r->directory, strerror(errno)), false;
  snprintf(r->folder, sizeof r->folder, "%s", r->results);
  return true;
}

void job_record_path(const job_record *r, const char *name, char path[JOB_PATH_ROOM]) {
  snprintf(path, JOB_PATH_ROOM, "%s/jobs/%s", r->folder, name);
}

bool job_record_real_path(const job_record *r, const char *name, char path[JOB_PATH_ROOM]) {
  char *folder = realpath(r->folder, NULL);
  bool ok = folder && snprintf(path, JOB_PATH_ROOM, "%s/jobs/%s", folder, name) < JOB_PATH_ROOM;
  if (!ok) fprintf(stderr, "vs: %s: %s\n", r->folder, folder ? "the name is too long" : strerror(errno));
  free(folder);
  return ok;
}

void job_record_forget_nodes(const job_record *r) {
  char path[JOB_PATH_ROOM];
  job_record_path(r, JOB_NODES, path), remove(path);
  job_record_path(r, JOB_REFUSED, path), remove(path);
}

/* ---- writing ---- */

static void put_text(FILE *to, const char *name, const char *text) {
  fprintf(to, ",\n \"%s\": ", name);
  cli_json_text(to, text);
}

static void put_words(FILE *to, const char *name, const char *const *words, size_t count) {
  fprintf(to, ",\n \"%s\": [", name);
  for (size_t i = 0; i < count; i++) fputs(i ? ", " : "", to), cli_json_text(to, words[i]);
  fputc(']', to);
}

static void put_record(FILE *to, const job_record *r) {
  fprintf(to, "{\"vs\": \"%s\"", vs_version());
  put_text(to, "on", r->on), put_text(to, "directory", r->directory);
  put_text(to, "program", r->program), put_text(to, "command", r->command);
  put_words(to, "whole", r->whole, r->whole_count), put_words(to, "part", r->part, r->part_count);
  put_text(to, "results", r->results), put_text(to, "host", r->host), put_text(to, "first", r->first);
  put_text(to, "array", r->array), put_text(to, "join", r->join);
  put_text(to, "time", r->time), put_text(to, "memory", r->memory_limit);
  fprintf(to,
          ",\n \"process\": %ld, \"cpus\": %zu, \"bundle\": %zu, \"parts\": %zu, \"attempt\": %zu, \"retries\": %zu",
          r->process, r->cpus, r->bundle, r->parts, r->attempt, r->retries);
  fputs(",\n \"seconds\": ", to), cli_json_number(to, r->seconds);
  fprintf(to, ", \"packed\": %s, \"joined\": %s, \"code\": %d,\n \"bundles\": [", r->packed ? "true" : "false",
          r->joined ? "true" : "false", r->code);
  for (size_t i = 0; i < r->bundle_count; i++)
    fprintf(to, "%s[%ld, %ld]", i ? ", " : "", r->bundles[i].from, r->bundles[i].to);
  fputs("]}\n", to);
}

bool job_record_put(const job_record *r, const char *name, void (*put)(FILE *to, const job_record *r)) {
  char path[JOB_PATH_ROOM];
  cli_whole_file file;
  job_record_path(r, name, path);
  FILE *to = cli_whole_begin(&file, path);
  if (to) put(to, r);
  if (cli_whole_end(&file, true)) return true;
  return fprintf(stderr, "vs: cannot write %s: %s\n", path, strerror(errno)), false;
}

bool job_record_write(const job_record *r) { return job_record_put(r, "jobs.json", put_record); }

/* ---- reading ---- */

static const char **read_words(job_record *r, const cli_data_reader *d, cli_data list, size_t *count) {
  *count = cli_data_count(d, list);
  const char **to = sweep_keep(&r->memory, *count + 1, sizeof *to);
  for (size_t i = 0; to && i < *count; i++)
    if (!(to[i] = keep(&r->memory, cli_data_text(d, cli_data_nth(d, list, i), "", NULL)))) return NULL;
  return to;
}

static bool read_bundles(job_record *r, const cli_data_reader *d, cli_data list) {
  r->bundle_count = cli_data_count(d, list);
  r->bundles = sweep_keep(&r->memory, r->bundle_count + 1, sizeof *r->bundles);
  for (size_t i = 0; r->bundles && i < r->bundle_count; i++) {
    cli_data pair = cli_data_nth(d, list, i);
    if (cli_data_count(d, pair) != 2) return false;
    r->bundles[i].from = (long)cli_data_number(d, cli_data_nth(d, pair, 0), "", 0);
    r->bundles[i].to = (long)cli_data_number(d, cli_data_nth(d, pair, 1), "", 0);
  }
  return r->bundles != NULL;
}

static size_t size_at(const cli_data_reader *d, cli_data record, const char *name) {
  long long n = cli_data_number(d, record, name, 0);
  return n > 0 ? (size_t)n : 0;
}

static bool take_record(job_record *r, const cli_data_reader *d, cli_data t) {
  struct { const char *name, **to;
  } texts[] = { { "on", &r->on },           { "directory", &r->directory }, { "program", &r->program },
                { "command", &r->command }, { "results", &r->results },     { "host", &r->host },
                { "first", &r->first },     { "array", &r->array },         { "join", &r->join },
                { "time", &r->time },       { "memory", &r->memory_limit } };
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    if (!(*texts[i].to = keep(&r->memory, cli_data_text(d, t, texts[i].name, NULL)))) return false;
  r->whole = read_words(r, d, cli_data_at(d, t, "whole"), &r->whole_count);
  r->part = read_words(r, d, cli_data_at(d, t, "part"), &r->part_count);
  r->process = (long)cli_data_number(d, t, "process", 0);
  r->cpus = size_at(d, t, "cpus"), r->bundle = size_at(d, t, "bundle"), r->parts = size_at(d, t, "parts");
  r->attempt = size_at(d, t, "attempt"), r->retries = size_at(d, t, "retries");
  r->seconds = cli_data_real(d, t, "seconds", 0);
  r->packed = cli_data_true(d, t, "packed");
  r->joined = cli_data_true(d, t, "joined"), r->code = (int)cli_data_number(d, t, "code", 0);
  return r->whole && r->part && read_bundles(r, d, cli_data_at(d, t, "bundles")) && *r->on && *r->command &&
         r->process > 0; /* kill with 0 or a negative number would send the signal to several processes */
}

bool job_record_read(job_record *r, const char *folder, bool *found) {
  char path[JOB_PATH_ROOM], *text = NULL;
  size_t room = 0;
  cli_data_reader d;
  *r = (job_record){0};
  snprintf(r->folder, sizeof r->folder, "%s", folder);
  job_record_path(r, "jobs.json", path);
  FILE *f = fopen(path, "rb");
  *found = f != NULL;
  if (!f) return true;
  ssize_t length = getdelim(&text, &room, 0, f);
  fclose(f);
  bool opened = cli_data_open(&d);
  cli_data whole = opened && length > 0 ? cli_data_read(&d, text, (size_t)length) : NULL;
  bool ok = whole && take_record(r, &d, whole);
  if (!opened) fprintf(stderr, "vs: %s: %s\n", path, d.trouble);
  else if (!ok) fprintf(stderr, "vs: %s: the file is no record of vs: remove it\n", path);
  if (whole) cli_data_free(&d, whole);
  cli_data_close(&d);
  free(text);
  return ok;
}

/* ---- locking ---- */

int job_record_lock(const job_record *r) {
  char path[JOB_PATH_ROOM];
  snprintf(path, sizeof path, "%s/jobs", r->folder);
  mkdir(r->folder, 0777), mkdir(path, 0777);
  job_record_path(r, "lock", path);
  int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return fprintf(stderr, "vs: cannot write %s: %s\n", path, strerror(errno)), -1;
  for (int i = 0; i < TRIES; i++) {
    if (flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    if (errno != EWOULDBLOCK) break;
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
  }
  if (errno == EWOULDBLOCK)
    fprintf(stderr, "vs: %s: another vs submits or runs the parts of this folder; vs jobs %s shows them\n", r->folder,
            r->folder);
  else fprintf(stderr, "vs: cannot lock %s: %s\n", path, strerror(errno));
  return close(file), -1;
}

bool job_record_is_locked(const job_record *r) {
  char path[JOB_PATH_ROOM];
  job_record_path(r, "lock", path);
  int file = open(path, O_RDWR | O_CLOEXEC);
  bool locked = file >= 0 && flock(file, LOCK_SH | LOCK_NB) != 0;
  if (file >= 0) close(file);
  return locked;
}
