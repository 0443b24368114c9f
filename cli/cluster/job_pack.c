/* Packs the model for nodes that share only the folder of the results, and writes the scripts that unpack it.
 *
 * The node's copy has the path of each file below a folder of its own, so that paths from the present folder mean the
 * same, and the folder of the results is a symbolic link. Files that the model names from the root are not packed: the
 * node must have them at the same place with the same contents. */
#define _GNU_SOURCE
#include "cli/cluster/job_pack.h"

#include <errno.h>
#include <fcntl.h>
#include <fts.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/batch/inputs_told.h"
#include "cli/batch/whole_file.h"
#include "cli/cluster/job_bundles.h"
#include "cli/cluster/job_process.h"
#include "cli/packages/package_files.h"
#include "cli/usage/shell_words.h"

typedef struct { const job_record *record; FILE *list, *outside; size_t abroad; } pack;

static bool cannot_write(const char *path) {
  return fprintf(stderr, "vs: cannot write %s: %s\n", path, strerror(errno)), false;
}

/* ---- files ---- */

/* Copies the file into the pack, where `hash` is its name. */
static bool store(const job_record *r, const char *path, const char *hash) {
  char name[100], to[JOB_PATH_ROOM], piece[1 << 14];
  cli_whole_file file;
  snprintf(name, sizeof name, "pack/%s", hash);
  job_record_path(r, name, to);
  if (access(to, F_OK) == 0) return true;
  FILE *in = fopen(path, "rb"), *out = in ? cli_whole_begin(&file, to) : NULL;
  if (!in) return fprintf(stderr, "vs: %s: %s\n", path, strerror(errno)), false;
  for (size_t n; out && (n = fread(piece, 1, sizeof piece, in)) > 0;) fwrite(piece, 1, n, out);
  bool ok = out && cli_whole_end(&file, !ferror(in));
  if (!ok) cannot_write(to);
  fclose(in);
  return ok;
}

/* Packs the file `path`, which the node stores at `as` below the node's own folder. */
static bool pack_as(const pack *p, const char *path, const char *as) {
  char hash[PACKAGE_HASH], why[PACKAGE_WHY];
  if (!package_file_hash(path, hash, why)) return fprintf(stderr, "vs: %s\n", why), false;
  fprintf(p->list, "%s  %s\n", hash, as);
  return store(p->record, path, hash);
}

/* Packs a file. A file with an absolute path is only listed, with a message for the first such file. */
static bool pack_file(pack *p, const char *path) {
  char as[2 * JOB_PATH_ROOM], hash[PACKAGE_HASH], why[PACKAGE_WHY];
  struct stat is;
  if (stat(path, &is) != 0 || !S_ISREG(is.st_mode)) return true;
  snprintf(as, sizeof as, "tree%s/%s", p->record->directory, path);
  if (strpbrk(as, "\n\\"))
    return fprintf(stderr, "vs: --pack: %s: a line break or a backslash in the name\n", path) < 0;
  if (path[0] != '/') return pack_as(p, path, as);
  if (!package_file_hash(path, hash, why)) return fprintf(stderr, "vs: %s\n", why), false;
  fprintf(p->outside, "%s  %s\n", hash, path);
  if (p->abroad++ == 0)
    fprintf(stderr, "vs: --pack: the model names %s from the root: each node must have the same file there\n", path);
  return true;
}

/* Packs a file, or all files of a folder. */
static bool pack_all(pack *p, const char *path) {
  char *roots[] = {(char *)(uintptr_t)path, NULL};
  bool ok = true;
  if (access(path, R_OK) != 0) return fprintf(stderr, "vs: --pack=%s: %s\n", path, strerror(errno)), false;
  FTS *all = fts_open(roots, FTS_LOGICAL | FTS_NOCHDIR, NULL);
  for (FTSENT *f; ok && all && (f = fts_read(all)) != NULL;)
    if (f->fts_info == FTS_F) ok = pack_file(p, f->fts_path);
  if (!all) return fprintf(stderr, "vs: %s: %s\n", path, strerror(errno)), false;
  return fts_close(all), ok;
}

/* Packs the packages that vs add has stored beside the model. */
static bool pack_packages(pack *p, const char *model) {
  char lock[JOB_PATH_ROOM], folder[JOB_PATH_ROOM];
  const char *slash = strrchr(model, '/');
  int n = slash ? (int)(slash - model) + 1 : 0;
  snprintf(lock, sizeof lock, "%.*svs.lock", n, model), snprintf(folder, sizeof folder, "%.*s.vs", n, model);
  return access(lock, R_OK) != 0 || (pack_file(p, lock) && pack_all(p, folder));
}

static bool pack_given(pack *p, const char *names) {
  char *copy = names ? strdup(names) : NULL, *rest = copy, *one;
  bool ok = !names || copy;
  while (ok && rest && (one = strsep(&rest, ",")) != NULL) ok = !*one || pack_all(p, one);
  return free(copy), ok;
}

/* Runs the first part without outputs, and records in s the files that it reads. */
static bool learn_inputs(vs_scheme *s, const cli_options *o, vs_outcome (*here)(const cli_options *o)) {
  cli_options local = *o;
  local.trying = local.quiet = true, local.cluster = (cli_cluster){0}, local.only = "1..1";
  if (local.frames.count) local.frames.from = local.frames.to = 1;
  if (local.tiles.columns) local.tiles.from = local.tiles.to = 1;
  local.pairs.from = local.pairs.to = 1;
  int list = cli_inputs_begin(), told = list >= 0 ? fcntl(list, F_DUPFD_CLOEXEC, 0) : -1; /* the command closes `list`,
                                                                                           * so `told` is a duplicate of
                                                                                           * it */
  vs_outcome outcome = told >= 0 ? here(&local) : VS_OUTCOME_MACHINE;
  cli_inputs_hear(told, s);
  if (told >= 0) close(told);
  return outcome == VS_OUTCOME_DONE;
}

static bool fill(pack *p, const cli_options *o, vs_outcome (*here)(const cli_options *o)) {
  vs_scheme *s = vs_new(&o->interpreter);
  const char *name;
  bool ok = s && learn_inputs(s, o, here) && pack_as(p, "/proc/self/exe", "vs");
  for (size_t i = 0; ok && i < o->source_count; i++) ok = pack_packages(p, o->sources[i].text);
  for (size_t i = 0; ok && (name = vs_input_name(s, i)) != NULL; i++) ok = pack_file(p, name);
  vs_free(s);
  return ok && pack_given(p, o->cluster.packed);
}

bool job_pack_make(job_record *r, const cli_options *o, vs_outcome (*here)(const cli_options *o)) {
  char path[JOB_PATH_ROOM], other[JOB_PATH_ROOM];
  cli_whole_file list, outside;
  pack p = {.record = r};
  job_record_path(r, "pack", path);
  if (!package_remove(path) || mkdir(path, 0777) != 0) return cannot_write(path);
  job_record_path(r, "pack/list", path), job_record_path(r, "pack/outside", other);
  p.list = cli_whole_begin(&list, path), p.outside = cli_whole_begin(&outside, other);
  bool ok = p.list && p.outside;
  if (!ok) cannot_write(path);
  ok = ok && fill(&p, o, here);
  bool written = cli_whole_end(&list, ok), also = cli_whole_end(&outside, ok);
  return ok && ((written && also) || cannot_write(path));
}

/* ---- scripts ---- */

/* Writes commands that make the folders of libraries, whether or not the model reads a file in them. */
static void put_folders(FILE *to, const job_record *r) {
  for (size_t i = 0; i < r->part_count; i++) {
    const char *word = r->part[i], *folders = NULL;
    if (!strcmp(word, "--") && i > 0) return;
    if (!strcmp(word, "-L") || !strcmp(word, "--library")) folders = i + 1 < r->part_count ? r->part[i + 1] : NULL;
    else if (!strncmp(word, "-L", 2)) folders = word + 2;
    else if (!strncmp(word, "--library=", 10)) folders = word + 10;
    for (const char *at = folders; at && *at; at += strspn(at, ":")) {
      size_t n = strcspn(at, ":");
      char *one = *at == '/' ? NULL : strndup(at, n);
      if (one) fputs("mkdir -p ", to), cli_put_quoted(to, one), fputc('\n', to);
      free(one), at += n;
    }
  }
}

static void put_assignment(FILE *to, const char *name, const char *before, const char *value) {
  char *text;
  if (asprintf(&text, "%s%s", before, value) < 0) return;
  fprintf(to, "%s=", name), cli_put_quoted(to, text), fputc('\n', to);
  free(text);
}

static const char unpack[] =
    "node=${SLURMD_NODENAME:-$(uname -n)} pack=$jobs/pack room=${TMPDIR:-/tmp}\n"
    "refuse() {\n"
    "  echo \"vs: node $node is refused: $1\" >&2\n"
    "  echo \"$node\" >> \"$jobs/" JOB_NODES "\"; echo \"$node: $1\" >> \"$jobs/" JOB_REFUSED "\"\n"
    "  [ -z \"$SLURM_ARRAY_JOB_ID\" ] || scontrol update \"JobId=$SLURM_ARRAY_JOB_ID\" \\\n"
    "    \"ExcNodeList=$(sort -u \"$jobs/" JOB_NODES "\" | paste -s -d , -)\" 2> /dev/null\n"
    "  exit 3\n"
    "}\n"
    "# Folders of bundles that were killed: nothing holds their locks.\n"
    "for own in \"$room\"/vs-pack-*; do\n"
    "  [ ! -O \"$own\" ] || [ ! -f \"$own/lock\" ] || (flock -n 9 && rm -rf \"$own\") 9< \"$own/lock\"\n"
    "done 2> /dev/null\n"
    "own=$(mktemp -d \"$room/vs-pack-XXXXXX\") || refuse \"there is no folder in $room\"\n"
    "trap 'cd /; rm -rf \"$own\"' EXIT\n"
    "trap 'exit 130' INT; trap 'exit 143' TERM\n"
    "exec 9> \"$own/new\" && flock 9 && mv \"$own/new\" \"$own/lock\" || refuse \"$room is full\"\n"
    "while IFS= read -r line; do\n"
    "  to=$own/${line#*  }\n"
    "  mkdir -p \"${to%/*}\" && cp \"$pack/${line%%  *}\" \"$to\" || refuse \"the files cannot be copied to $room\"\n"
    "done < \"$pack/list\"\n"
    "(cd \"$own\" && sha256sum --quiet -c \"$pack/list\") >&2 || refuse 'files of the model have other contents here'\n"
    "[ ! -s \"$pack/outside\" ] || sha256sum --quiet -c \"$pack/outside\" >&2 ||\n"
    "  refuse 'a file that the model names from the root is missing or has other contents here'\n"
    "vs=$own/vs; chmod 755 \"$vs\"\n"
    "export " JOB_PACKED "=1\n"
    "mkdir -p \"$own/tree$folder\" && cd \"$own/tree$folder\" && mkdir -p \"${out%/*}\" || refuse \"$room is full\"\n"
    "# The results are those of all nodes.\n"
    "place() { ln -s \"${jobs%/jobs}\" \"$out\" || refuse \"$room is full\"; }\n"
    "# Prints the hashes of the sample part's files, and its numbers.\n"
    "make_sample() {\n"
    "  mkdir -p \"$out\" && run_sample >&2; code=$?\n"
    "  cat \"$out\"/manifest* 2> /dev/null | sed -n 's/.*\"seconds\": \\([0-9.e+-]*\\).*/\\1/p' > \"$own/seconds\"\n"
    "  (cd \"$out\" && find . -type f ! -name 'manifest*' -exec sha256sum {} + | LC_ALL=C sort)\n"
    "  cat \"$out\"/manifest*.jsonl 2> /dev/null | sed -n 's/.*, \"numbers\": //p'\n"
    "  rm -rf \"$out\"; return $code\n"
    "}\n"
    "hash_of() { sha256sum < \"$1\" | cut -c 1-12; }\n"
    "check_node() {\n"
    "  grep -qsx \"$node\" \"$pack/same\" && return\n"
    "  make_sample > \"$own/sample\"\n"
    "  cmp -s \"$own/sample\" \"$pack/sample\" ||\n"
    "    refuse \"its sample part has the hash $(hash_of \"$own/sample\"), not $(hash_of \"$pack/sample\")\"\n"
    "  echo \"$node\" >> \"$pack/same\"\n"
    "}\n";

static void put_unpack(FILE *to, const job_record *r) {
  char jobs[JOB_PATH_ROOM] = "";
  job_record_real_path(r, "", jobs);
  if (*jobs) jobs[strlen(jobs) - 1] = 0;
  fputs("# Written by vs: gives the node copies of the model and of vs, and refuses a node whose sample part has other "
        "bytes.\n", to);
  put_assignment(to, "jobs", "", jobs), put_assignment(to, "folder", "", r->directory);
  put_assignment(to, "out", "./", r->results);
  fprintf(to, "run_sample() { \"$vs\" %s --only 1..1 --keep-going -q", r->command);
  for (size_t i = 0; i < r->part_count; i++) fputc(' ', to), cli_put_quoted(to, r->part[i]);
  fputs("; }\n", to);
  fputs(unpack, to);
  put_folders(to, r);
}

static void put_sample(FILE *to, const job_record *r) {
  fputs("#!/bin/sh\n# Written by vs: makes the sample part from the pack.\n", to);
  job_put_unpack(to, r);
  fputs("make_sample > \"$own/sample\"; code=$?\ncp \"$own/sample\" \"$own/seconds\" \"$pack\" || exit 2\nexit $code\n",
        to);
}

bool job_pack_scripts(const job_record *r) {
  return job_record_put(r, "unpack.sh", put_unpack) && job_record_put(r, "sample.sh", put_sample);
}

/* ---- the sample part ---- */

int job_pack_sample(job_record *r, const volatile sig_atomic_t *ended, job_use *use) {
  char script[JOB_PATH_ROOM], path[JOB_PATH_ROOM];
  job_record_path(r, "sample.sh", script), job_record_path(r, "pack/seconds", path);
  const char *words[] = {"sh", script, NULL};
  int code = job_run(words, ended, NULL, use);
  FILE *f = fopen(path, "rb");
  r->seconds = use->seconds;
  if (f && fscanf(f, "%lf", &r->seconds) != 1) r->seconds = use->seconds;
  if (f) fclose(f);
  return code;
}
