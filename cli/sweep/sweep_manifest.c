/* Reads, appends to and joins the manifests of a sweep. Each line is an object in JSON. The member "inputs" alone
 * begins the line of the files that a run read: {"inputs": HASH, "read": {"house.vs": HASH}}, once for each list. The
 * member "part" begins that of a finished part. Others are ignored, such as one that a killed sweep left incomplete. */
#define _GNU_SOURCE
#include "cli/sweep/sweep_manifest.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/batch/part_files.h"
#include "cli/batch/whole_file.h"
#include "cli/json.h"
#include "cli/json_data.h"
#include "model/store/array.h"

enum { PATH_ROOM = 4096 };

/* A file that runs have read, with the hash of the contents that they read. */
typedef struct { const char *path; uint64_t hash; } input;
typedef enum { UNKNOWN, CURRENT, CHANGED } state;
/* The files that one run has read. state: whether the files still have the contents that the run read. */
typedef struct { uint64_t id; const input *at; size_t count; state state; } group;
/* A line about a part. order: its position among all lines. rank: how much the line says of the present part. */
typedef enum { OUTDATED, HAS_FAILED, IS_DONE } rank;
typedef struct { uint64_t key, inputs; size_t order; const char *line; size_t length; bool done; rank rank; } saved;
/* A file whose contents were hashed, with its system state (size, times) at that moment. */
typedef struct { const char *path; uint64_t hash; struct stat is; } hashed;

struct sweep_manifest {
  sweep_table *table;
  const char *folder;
  char path[PATH_ROOM];
  int file, shared;      /* descriptors of the locked manifests, or -1. shared: the whole sweep's manifest, while a
                          * range of it (--only) runs */
  bool is_new;           /* whether the file was empty or missing */
  bool torn, failed;     /* torn: the file does not end in a line end. failed: a message was printed */
  group *groups; size_t group_count, group_room;
  saved *saved; size_t saved_count, saved_room;
  hashed *hashed; size_t hashed_count, hashed_room;
  cli_data_reader reader;
  bool reads;            /* whether the reader is open */
};

const char *sweep_manifest_path(const sweep_manifest *m) { return m->path; }

bool sweep_manifest_is_new(const sweep_manifest *m) { return m->is_new; }

bool sweep_manifest_note_inputs(const sweep_manifest *m, vs_scheme *s) {
  for (size_t i = 0; i < m->group_count; i++)
    for (size_t k = 0; k < m->groups[i].count; k++) vs_note_input(s, m->groups[i].at[k].path);
  return m->group_count > 0;
}

void sweep_manifest_abandon(sweep_manifest *m) {
  if (m->is_new) remove(m->path);
}

static bool cannot_write(sweep_manifest *m, const char *path) {
  if (!m->failed) fprintf(stderr, "vs sweep: cannot write %s: %s\n", path, strerror(errno));
  m->failed = true;
  return false;
}

/* ---- the contents of files ---- */

static bool same_file(const struct stat *a, const struct stat *b) {
  return a->st_ino == b->st_ino && a->st_size == b->st_size && a->st_mtim.tv_sec == b->st_mtim.tv_sec &&
         a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

/* Returns the hash of the file; takes it from the table if the file has not changed. Sets *is to the file's system
 * state. Returns false if the file cannot be read. */
static bool hash_of(sweep_manifest *m, const char *path, uint64_t *out, struct stat *is) {
  size_t i = 0;
  if (stat(path, is) != 0) return false;
  while (i < m->hashed_count && strcmp(m->hashed[i].path, path) != 0) i++;
  if (i < m->hashed_count && same_file(&m->hashed[i].is, is)) return *out = m->hashed[i].hash, true;
  if (!cli_part_hash_file(path, out)) return false;
  if (i == m->hashed_count) {
    const char *kept = sweep_keep_text(m->table->memory, path, strlen(path));
    if (!kept || !VS_GROW(m->hashed, m->hashed_room, i + 1)) return false;
    m->hashed[m->hashed_count++].path = kept;
  }
  m->hashed[i].hash = *out, m->hashed[i].is = *is;
  return true;
}

static group *group_of(const sweep_manifest *m, uint64_t id) {
  for (size_t i = 0; i < m->group_count; i++)
    if (m->groups[i].id == id) return &m->groups[i];
  return NULL;
}

static bool is_current(sweep_manifest *m, uint64_t id) {
  group *g = id ? group_of(m, id) : NULL;
  uint64_t hash;
  struct stat is;
  if (!g) return false;
  for (size_t i = 0; g->state == UNKNOWN && i < g->count; i++)
    if (!hash_of(m, g->at[i].path, &hash, &is) || hash != g->at[i].hash) g->state = CHANGED;
  if (g->state == UNKNOWN) g->state = CURRENT;
  return g->state == CURRENT;
}

/* ---- reading ---- */

static bool read_hash(const sweep_manifest *m, cli_data line, const char *name, uint64_t *out) {
  const char *text = cli_data_text(&m->reader, line, name, NULL);
  return text && sscanf(text, "%" SCNx64, out) == 1;
}

static bool take_group(sweep_manifest *m, uint64_t id, cli_data read) {
  size_t count = 0, k = 0;
  const cli_data_reader *r = &m->reader;
  if (group_of(m, id)) return true;
  for (cli_data_member e = cli_data_first(r, read); e; e = cli_data_next(r, read, e)) count++;
  input *at = sweep_keep(m->table->memory, count ? count : 1, sizeof *at);
  if (!at || !VS_GROW(m->groups, m->group_room, m->group_count + 1)) return false;
  for (cli_data_member e = cli_data_first(r, read); e; e = cli_data_next(r, read, e), k++) {
    const char *name = cli_data_key(r, e);
    at[k].path = sweep_keep_text(m->table->memory, name, strlen(name));
    const char *text = cli_data_text(r, cli_data_value(r, e), "", NULL);
    if (!at[k].path || !text || sscanf(text, "%" SCNx64, &at[k].hash) != 1) return true;
  }
  m->groups[m->group_count++] = (group){.id = id, .at = at, .count = count};
  return true;
}

static bool take_line(sweep_manifest *m, const char *line, size_t length) {
  uint64_t key, inputs;
  const char *outcome;
  bool ok = true;
  cli_data one = cli_data_read(&m->reader, line, length);
  if (read_hash(m, one, "key", &key) && (outcome = cli_data_text(&m->reader, one, "outcome", NULL)) != NULL) {
    if (!read_hash(m, one, "inputs", &inputs)) inputs = 0;
    ok = VS_GROW(m->saved, m->saved_room, m->saved_count + 1);
    if (ok) {
      m->saved[m->saved_count] = (saved){key, inputs, m->saved_count, line, length, !strcmp(outcome, "done"), OUTDATED};
      m->saved_count++;
    }
  } else if (read_hash(m, one, "inputs", &inputs)) ok = take_group(m, inputs, cli_data_at(&m->reader, one, "read"));
  cli_data_free(&m->reader, one);
  return ok || sweep_no_memory();
}

/* Reads the lines of a manifest. Their texts stay in the table's memory. */
static bool read_file(sweep_manifest *m, const char *path, bool own) {
  struct stat is;
  FILE *f = fopen(path, "rb");
  if (!f || fstat(fileno(f), &is) != 0) return !f || fclose(f) == 0;
  size_t room = (size_t)is.st_size, length;
  char *text = sweep_keep(m->table->memory, room + 1, 1);
  bool ok = text != NULL;
  length = ok ? fread(text, 1, room, f) : 0;
  fclose(f);
  if (own) m->is_new = length == 0;
  if (own) m->torn = length > 0 && text[length - 1] != '\n';
  if (length && !m->reads && !(m->reads = cli_data_open(&m->reader)))
    return fprintf(stderr, "vs sweep: %s: %s\n", path, m->reader.trouble), cli_data_close(&m->reader), false;
  for (size_t at = 0; ok && at < length;) {
    const char *end = memchr(text + at, '\n', length - at);
    size_t n = end ? (size_t)(end - text) - at : length - at;
    ok = take_line(m, text + at, n);
    at += n + 1;
  }
  return ok;
}

/* Returns true for the names of manifests of ranges: manifest-1..10.jsonl. */
static bool is_of_range(const char *name) {
  long from, to;
  int used = 0;
  return sscanf(name, "manifest-%ld..%ld.jsonl%n", &from, &to, &used) == 2 && used > 0 && !name[used];
}

/* Calls `each` for the path of each manifest of a range in the folder. */
static bool each_range(sweep_manifest *m, bool (*each)(sweep_manifest *m, const char *path)) {
  char path[PATH_ROOM];
  DIR *folder = opendir(m->folder);
  struct dirent *entry;
  bool ok = true;
  while (ok && folder && (entry = readdir(folder)) != NULL)
    if (is_of_range(entry->d_name) && snprintf(path, sizeof path, "%s/%s", m->folder, entry->d_name) < PATH_ROOM)
      ok = each(m, path);
  if (folder) closedir(folder);
  return ok;
}

static bool read_range(sweep_manifest *m, const char *path) { return read_file(m, path, !strcmp(path, m->path)); }

static int by_key(const void *a, const void *b) {
  const saved *x = a, *y = b;
  if (x->key != y->key) return x->key < y->key ? -1 : 1;
  if (x->rank != y->rank) return x->rank < y->rank ? -1 : 1;
  return x->order < y->order ? -1 : x->order > y->order;
}

/* Sorts the lines by part, and keeps one line of each: the line of a done part if there is one, otherwise that of a
 * failed part, otherwise the last. */
static void index_lines(sweep_manifest *m) {
  size_t kept = 0;
  for (size_t i = 0; i < m->saved_count; i++) {
    saved *s = &m->saved[i];
    bool current = is_current(m, s->inputs);
    s->rank = s->done ? current ? IS_DONE : OUTDATED : current || !s->inputs ? HAS_FAILED : OUTDATED;
  }
  if (m->saved_count) qsort(m->saved, m->saved_count, sizeof *m->saved, by_key);
  for (size_t i = 0; i < m->saved_count; i++)
    if (i + 1 == m->saved_count || m->saved[i + 1].key != m->saved[i].key) m->saved[kept++] = m->saved[i];
  m->saved_count = kept;
}

static const saved *find(const sweep_manifest *m, uint64_t key) {
  size_t low = 0, high = m->saved_count;
  while (low < high) {
    size_t mid = low + (high - low) / 2;
    if (m->saved[mid].key < key) low = mid + 1;
    else high = mid;
  }
  return low < m->saved_count && m->saved[low].key == key ? &m->saved[low] : NULL;
}

/* ---- locking ---- */

static bool taken(const char *path) {
  fprintf(stderr,
          "vs sweep: %s: another vs sweep is writing into this folder; wait until it ends, or name another folder\n",
          path);
  return false;
}

/* Locks the file. Waits half a second, since a process of a killed sweep may hold the lock until it has noticed. */
static bool take_lock(int file, int how) {
  for (int i = 0; flock(file, how | LOCK_NB) != 0; i++) {
    if (errno != EWOULDBLOCK || i == 10) return false;
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
  }
  return true;
}

/* Opens and locks the file. The file that has the lock must still have the name. */
static bool lock_file(sweep_manifest *m, const char *path, int how, int *file) {
  struct stat mine, named;
  *file = open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (*file < 0) return cannot_write(m, path);
  if (!take_lock(*file, how)) return errno == EWOULDBLOCK ? taken(path) : cannot_write(m, path);
  return (fstat(*file, &mine) == 0 && stat(path, &named) == 0 && mine.st_ino == named.st_ino &&
          mine.st_dev == named.st_dev) || taken(path);
}

sweep_manifest *sweep_manifest_open(sweep_table *t, const char *folder, const char *only) {
  char whole[PATH_ROOM];
  sweep_manifest *m = vs_zeros(1, sizeof *m);
  if (!m) return sweep_no_memory(), NULL;
  *m = (sweep_manifest){.table = t, .folder = folder, .file = -1, .shared = -1, .is_new = true};
  snprintf(whole, sizeof whole, "%s/manifest.jsonl", folder);
  int length = only ? snprintf(m->path, PATH_ROOM, "%s/manifest-%s.jsonl", folder, only)
                    : snprintf(m->path, PATH_ROOM, "%s", whole);
  bool ok = length < PATH_ROOM;
  if (!ok) fprintf(stderr, "vs sweep: %s: the name is too long\n", folder);
  ok = ok && (!only || lock_file(m, whole, LOCK_SH, &m->shared)) && lock_file(m, m->path, LOCK_EX, &m->file);
  ok = ok && read_file(m, whole, !only) && each_range(m, read_range);
  index_lines(m);
  if (ok) return m;
  sweep_manifest_close(m);
  return NULL;
}

sweep_manifest *sweep_manifest_read(sweep_table *t, const char *folder) {
  sweep_manifest *m = vs_zeros(1, sizeof *m);
  if (!m) return sweep_no_memory(), NULL;
  *m = (sweep_manifest){.table = t, .folder = folder, .file = -1, .shared = -1};
  snprintf(m->path, PATH_ROOM, "%s/manifest.jsonl", folder);
  bool ok = read_file(m, m->path, false) && each_range(m, read_range);
  index_lines(m);
  if (ok) return m;
  sweep_manifest_close(m);
  return NULL;
}

void sweep_manifest_let_go(const sweep_manifest *m) {
  if (m->file >= 0) close(m->file);
  if (m->shared >= 0) close(m->shared);
}

void sweep_manifest_close(sweep_manifest *m) {
  if (!m) return;
  sweep_manifest_let_go(m);
  if (m->reads) cli_data_close(&m->reader);
  free(m->groups), free(m->saved), free(m->hashed);
  free(m);
}

/* ---- parts that are up to date ---- */

/* Reads the part's outputs and numbers from its line. Returns false if an output has another name or has changed. */
static bool take_results(sweep_manifest *m, sweep_part *p, cli_data line) {
  const cli_data_reader *r = &m->reader;
  cli_data files = cli_data_at(r, line, "files"), numbers = cli_data_at(r, line, "numbers");
  size_t count = 0;
  for (cli_data_member k = cli_data_first(r, files); k; k = cli_data_next(r, files, k), count++) {
    const char *name = cli_data_key(r, k), *text = cli_data_text(r, cli_data_value(r, k), "", NULL);
    uint64_t was, now;
    if (count == p->file_count || strcmp(name, p->files[count].path) != 0) return false;
    if (!text || sscanf(text, "%" SCNx64, &was) != 1 || !cli_part_hash_file(name, &now) || was != now) return false;
    p->files[count].hash = now;
  }
  if (count != p->file_count) return false;
  count = 0;
  for (cli_data_member k = cli_data_first(r, numbers); k; k = cli_data_next(r, numbers, k)) count++;
  sweep_number *at = sweep_keep(m->table->memory, count ? count : 1, sizeof *at);
  size_t i = 0;
  for (cli_data_member k = cli_data_first(r, numbers); at && k; k = cli_data_next(r, numbers, k), i++) {
    const char *name = cli_data_key(r, k);
    at[i].column = sweep_number_column(m->table, name, strlen(name));
    if (at[i].column == SIZE_MAX || !cli_data_is_number(r, cli_data_value(r, k), &at[i].value)) return false;
  }
  cli_data_is_number(r, cli_data_at(r, line, "seconds"), &p->seconds);
  p->numbers = at, p->number_count = count;
  return at != NULL;
}

bool sweep_manifest_stands(sweep_manifest *m, sweep_part *p) {
  const saved *s = find(m, p->key);
  if (!s || s->rank != IS_DONE) return false;
  cli_data line = cli_data_read(&m->reader, s->line, s->length);
  bool ok = line && take_results(m, p, line);
  cli_data_free(&m->reader, line);
  if (ok) p->inputs = s->inputs, p->fate = SWEEP_STANDS;
  return ok;
}

bool sweep_manifest_failed(sweep_manifest *m, sweep_part *p) {
  const saved *s = find(m, p->key);
  if (!s || s->rank != HAS_FAILED) return false;
  cli_data line = cli_data_read(&m->reader, s->line, s->length);
  const char *message = cli_data_text(&m->reader, line, "message", NULL);
  p->fate = SWEEP_FAILED, p->inputs = s->inputs;
  p->code = (int)cli_data_number(&m->reader, line, "code", VS_OUTCOME_MODEL);
  p->message = message ? sweep_keep_text(m->table->memory, message, strlen(message)) : NULL;
  p->seconds = cli_data_real(&m->reader, line, "seconds", 0);
  cli_data_free(&m->reader, line);
  return true;
}

bool sweep_manifest_is_listed(sweep_manifest *m, sweep_part *p) {
  const saved *s = find(m, p->key);
  if (!s || s->rank != IS_DONE) return false;
  cli_data line = cli_data_read(&m->reader, s->line, s->length);
  p->seconds = cli_data_real(&m->reader, line, "seconds", 0);
  cli_data_free(&m->reader, line);
  return true;
}

/* ---- writing ---- */

static void write_group(FILE *to, const group *g) {
  fprintf(to, "{\"inputs\": \"%016" PRIx64 "\", \"read\": {", g->id);
  for (size_t i = 0; i < g->count; i++) {
    if (i) fputs(", ", to);
    cli_json_text(to, g->at[i].path);
    fprintf(to, ": \"%016" PRIx64 "\"", g->at[i].hash);
  }
  fputs("}}\n", to);
}

static void write_part(FILE *to, const sweep_table *t, const sweep_part *p) {
  fputs("{\"part\": ", to);
  cli_json_text(to, p->name);
  fprintf(to, ", \"key\": \"%016" PRIx64 "\", \"inputs\": \"%016" PRIx64 "\", \"outcome\": \"%s\"", p->key, p->inputs,
          p->fate == SWEEP_FAILED ? "failed" : "done");
  if (p->fate == SWEEP_FAILED) fprintf(to, ", \"code\": %d", p->code);
  if (p->message) fputs(", \"message\": ", to), cli_json_text(to, p->message);
  fputs(", \"seconds\": ", to);
  cli_json_number(to, p->seconds);
  fputs(", \"files\": {", to);
  for (size_t i = 0; p->fate != SWEEP_FAILED && i < p->file_count; i++) {
    if (i) fputs(", ", to);
    cli_json_text(to, p->files[i].path);
    fprintf(to, ": \"%016" PRIx64 "\"", p->files[i].hash);
  }
  fputs("}, \"numbers\": {", to);
  for (size_t i = 0; i < p->number_count; i++) {
    if (i) fputs(", ", to);
    cli_json_text(to, t->numbers[p->numbers[i].column]);
    fputs(": ", to);
    cli_json_number(to, p->numbers[i].value);
  }
  fputs("}}\n", to);
}

/* Appends the text to the manifest by one write. If only a part could be written, removes that part again. */
static bool append(sweep_manifest *m, FILE *text, char *const *at, const size_t *length) {
  struct stat is;
  if (fclose(text) != 0) return sweep_no_memory();
  bool known = fstat(m->file, &is) == 0;
  ssize_t n = known ? write(m->file, *at, *length) : -1;
  bool ok = n == (ssize_t)*length;
  int problem = n < 0 ? errno : ENOSPC;
  if (!ok && known && ftruncate(m->file, is.st_size) != 0) m->torn = true;
  free(*at);
  errno = problem;
  return ok || cannot_write(m, m->path);
}

/* Begins a text to append. Returns NULL after a message when memory is out. */
static FILE *text_to_append(sweep_manifest *m, char **at, size_t *length) {
  FILE *to = open_memstream(at, length);
  if (!to) return sweep_no_memory(), NULL;
  if (m->torn) fputc('\n', to), m->torn = false;
  return to;
}

uint64_t sweep_manifest_inputs(sweep_manifest *m, const char *names, size_t length, struct timespec began) {
  uint64_t id = CLI_HASH_BEGIN;
  size_t count = 0, k = 0;
  char *text;
  size_t size;
  for (const char *at = names; at < names + length; at += strlen(at) + 1) count++;
  input *list = sweep_keep(m->table->memory, count ? count : 1, sizeof *list);
  for (const char *at = names; list && at < names + length; at += strlen(at) + 1, k++) {
    struct stat is;
    list[k].path = at;
    if (!hash_of(m, at, &list[k].hash, &is)) return 0;
    if (is.st_mtim.tv_sec > began.tv_sec ||
        (is.st_mtim.tv_sec == began.tv_sec && is.st_mtim.tv_nsec >= began.tv_nsec)) return 0;
    id = cli_part_hash(cli_part_hash(id, at, strlen(at) + 1), &list[k].hash, sizeof list[k].hash);
  }
  if (!list || group_of(m, id)) return list ? id : 0;
  for (k = 0; k < count; k++)
    if (!(list[k].path = sweep_keep_text(m->table->memory, list[k].path, strlen(list[k].path)))) return 0;
  if (!VS_GROW(m->groups, m->group_room, m->group_count + 1)) return 0;
  m->groups[m->group_count++] = (group){.id = id, .at = list, .count = count, .state = CURRENT};
  FILE *to = text_to_append(m, &text, &size);
  if (!to) return 0;
  write_group(to, &m->groups[m->group_count - 1]);
  return append(m, to, &text, &size) ? id : 0;
}

bool sweep_manifest_add(sweep_manifest *m, const sweep_part *p) {
  char *text;
  size_t size;
  FILE *to = text_to_append(m, &text, &size);
  if (!to) return false;
  write_part(to, m->table, p);
  return append(m, to, &text, &size);
}

/* ---- joining ---- */

static bool remove_range(sweep_manifest *m, const char *path) {
  (void)m;
  return remove(path) == 0 || errno == ENOENT;
}

static int by_number(const void *a, const void *b) {
  uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
  return x < y ? -1 : x > y;
}

/* Writes the lines of parts of earlier sweeps that this sweep does not contain, and then the lines of this sweep. */
static bool write_all(sweep_manifest *m, FILE *to) {
  const sweep_table *t = m->table;
  uint64_t *keys;
  if (!VS_FRESH(keys, t->count)) return sweep_no_memory();
  for (size_t i = 0; i < t->count; i++) keys[i] = t->parts[i].key;
  qsort(keys, t->count, sizeof *keys, by_number);
  fprintf(to, "{\"vs\": \"%s\"}\n", vs_version());
  for (size_t i = 0; i < m->group_count; i++)
    if (is_current(m, m->groups[i].id)) write_group(to, &m->groups[i]);
  for (size_t i = 0; i < m->saved_count; i++) {
    const saved *s = &m->saved[i];
    if (s->rank != IS_DONE || bsearch(&s->key, keys, t->count, sizeof *keys, by_number)) continue;
    fwrite(s->line, 1, s->length, to);
    fputc('\n', to);
  }
  for (size_t i = 0; i < t->count; i++)
    if (t->parts[i].fate != SWEEP_NOT_TRIED && t->parts[i].same == i) write_part(to, t, &t->parts[i]);
  free(keys);
  return true;
}

bool sweep_manifest_join(sweep_manifest *m) {
  cli_whole_file whole;
  if (m->failed) return false;
  FILE *to = cli_whole_begin(&whole, m->path);
  if (!to) return cannot_write(m, whole.part);
  int file = fcntl(fileno(to), F_DUPFD_CLOEXEC, 0);
  bool locked = flock(file, LOCK_EX | LOCK_NB) == 0;
  if (!cli_whole_end(&whole, locked && write_all(m, to))) return cannot_write(m, m->path), close(file), false;
  close(m->file);
  m->file = file;
  return each_range(m, remove_range) || cannot_write(m, m->folder);
}
