/* Puts parts into bundles, and writes the scripts that make and join them. */
#define _GNU_SOURCE
#include "cli/cluster/job_bundles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cluster/job_pack.h"
#include "cli/usage/shell_words.h"
#include "model/store/array.h"

enum { MOST = 1000 /* greatest number of bundles, since Slurm accepts arrays of at most 1001 jobs by default */ };
enum { SHORTEST = 60, LONGEST = 600, SHORTEST_HERE = 2, LONGEST_HERE = 60 /* shortest and longest duration of a bundle
                                                                           * in seconds, on a cluster and on this
                                                                           * machine */ };

size_t job_bundle_size(double seconds, size_t parts, bool cluster) {
  double each = seconds > 0.001 ? seconds : 0.001;
  double least = ceil((cluster ? SHORTEST : SHORTEST_HERE) / each),
         most = ceil((cluster ? LONGEST : LONGEST_HERE) / each);
  double size = ceil((double)parts / 32);
  if (size < least) size = least;
  if (size > most) size = most;
  return size < (double)parts ? (size_t)size : parts;
}

static bool is_to_make(const cli_part_state *states, size_t i) {
  return !states || states[i] == PART_MISSING || states[i] == PART_KILLED;
}

/* Sets r->bundles, which has room for all parts, to ranges of the parts to make. A range may contain up to `gap`
 * consecutive parts that are already made. */
static void fill(job_record *r, const cli_part_state *states, size_t first, size_t most, size_t gap) {
  r->bundle_count = 0;
  for (size_t i = first; i < r->parts; i++) {
    job_range *last = r->bundle_count ? &r->bundles[r->bundle_count - 1] : NULL;
    if (!is_to_make(states, i)) continue;
    if (last && i + 1 - (size_t)last->to <= gap + 1 && i + 2 - (size_t)last->from <= most) last->to = (long)i + 1;
    else r->bundles[r->bundle_count++] = (job_range){(long)i + 1, (long)i + 1};
  }
}

bool job_bundles_make(job_record *r, const cli_part_state *states, size_t first) {
  size_t most = r->bundle ? r->bundle : 1, gap = 0;
  r->bundles = sweep_keep(&r->memory, r->parts + 1, sizeof *r->bundles);
  if (!r->bundles) return false;
  for (fill(r, states, first, most, gap); r->bundle_count > MOST; fill(r, states, first, most, gap))
    most = most + most / 4 + 1, gap = gap + gap / 4 + 1;
  return true;
}

/* ---- words ---- */

/* Returns the path of vs. A process that runs in a node's copy of the model uses its own program, because the node may
 * lack the record's program. */
static const char *program_of(const job_record *r) { return job_is_unpacked() ? "/proc/self/exe" : r->program; }

const char **job_words_of(const job_record *r, const char *range) {
  size_t n = 0;
  const char **w;
  if (!VS_FRESH(w, r->part_count + 8)) return fputs("vs: out of memory\n", stderr), NULL;
  w[n++] = program_of(r), w[n++] = r->command, w[n++] = "--only", w[n++] = range, w[n++] = "--keep-going";
  if (r->quiet) w[n++] = "-q";
  for (size_t i = 0; i < r->part_count; i++) w[n++] = r->part[i];
  w[n] = NULL;
  return w;
}

const char **job_words_of_all(const job_record *r, const char *option, const char *value) {
  size_t n = 0;
  const char **w;
  if (!VS_FRESH(w, r->whole_count + 8)) return fputs("vs: out of memory\n", stderr), NULL;
  w[n++] = program_of(r), w[n++] = r->command, w[n++] = option;
  if (value) w[n++] = value, w[n++] = "--keep-failed";
  if (r->quiet) w[n++] = "-q";
  for (size_t i = 0; i < r->whole_count; i++) w[n++] = r->whole[i];
  w[n] = NULL;
  return w;
}

/* ---- scripts ---- */

static void put_quoted(FILE *to, const char *word) { fputc(' ', to), cli_put_quoted(to, word); }

void job_put_unpack(FILE *to, const job_record *r) {
  char path[JOB_PATH_ROOM];
  if (!job_record_real_path(r, "unpack.sh", path)) return;
  fputc('.', to), put_quoted(to, path), fputc('\n', to);
}

/* Begins a script with the change to the folder of the command, or to the node's copy of that folder. */
static void put_folder(FILE *to, const job_record *r) {
  if (r->packed) {
    job_put_unpack(to, r);
    return;
  }
  fputs("cd", to), put_quoted(to, r->directory), fputs(" || exit 4\n", to);
}

static void put_program(FILE *to, const job_record *r) {
  if (r->packed) fputs("\"$vs\"", to);
  else cli_put_quoted(to, r->program);
}

/* A run that Slurm has started again keeps failures of the model, which would come again. The script records a node on
 * which a worker or a disk has failed. */
static void put_bundles(FILE *to, const job_record *r) {
  fprintf(to, "#!/bin/sh\n# Written by vs: makes the parts of one bundle.\ncase ${1:-$SLURM_ARRAY_TASK_ID} in\n");
  for (size_t i = 0; i < r->bundle_count; i++)
    fprintf(to, "%zu) only=%ld..%ld ;;\n", i + 1, r->bundles[i].from, r->bundles[i].to);
  fputs("esac\nagain=\n[ \"${SLURM_RESTART_COUNT:-0}\" = 0 ] || again=--keep-failed\n", to);
  put_folder(to, r);
  if (r->packed) fputs("check_node\nplace\n", to);
  put_program(to, r);
  size_t cpus = r->cpus ? r->cpus : 1;
  bool sweeps = !strcmp(r->command, "sweep");
  fprintf(to, " %s --only \"$only\" --keep-going $again --jobs %zu --threads %zu", r->command, sweeps ? cpus : 1,
          sweeps ? 1 : cpus);
  for (size_t i = 0; i < r->part_count; i++) put_quoted(to, r->part[i]);
  char path[JOB_PATH_ROOM];
  job_record_path(r, JOB_NODES, path);
  fputs("\ncode=$?\ncase $code in\n2|3) [ -z \"${SLURMD_NODENAME:-}\" ] || echo \"$SLURMD_NODENAME\" >>", to);
  if (r->packed) fputs(" \"$jobs/" JOB_NODES "\"", to);
  else put_quoted(to, path);
  fputs(" ;;\nesac\nexit $code\n", to);
}

static void put_join(FILE *to, const job_record *r) {
  fputs("#!/bin/sh\n# Written by vs: joins all parts.\n", to);
  put_folder(to, r);
  if (r->packed) fputs("place\n", to); /* no exec here, since the shell removes the node's copy at the end */
  else fputs("exec ", to);
  put_program(to, r);
  fputs(" jobs join", to);
  put_quoted(to, r->folder);
  fputc('\n', to);
}

bool job_scripts_write(const job_record *r) {
  if (r->packed && !job_pack_scripts(r)) return false;
  return job_record_put(r, "bundles.sh", put_bundles) && job_record_put(r, "join.sh", put_join);
}
