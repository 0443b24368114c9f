/* Implements `vs add`. All packages are fetched into .vs.new first; if one fails, .vs and vs.lock stay as they are. */
#include "cli/packages/add_command.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/packages/fetch_package.h"
#include "cli/packages/package_index.h"
#include "model/store/array.h"

static const char STAGE[] = ".vs.new", HOME[] = ".vs", MANIFEST[] = "vs-package.json";
enum { MOST_MANIFEST = 1 << 20, MOST_WANTED = 1000 };

/* A package to fetch. name, commit and hash: those of vs.lock, or "" for a new package. by: the package that needs it,
 * or "". */
typedef struct { char *source, *name, *commit, *hash, *by; bool placed; } want;

typedef struct {
  package_lock lock;
  want *wants; size_t count, room;
  char why[PACKAGE_WHY];
} adding;

static bool fail(adding *a, const char *source, const char *reason) {
  snprintf(a->why, sizeof a->why, "%.150s: %.140s", source, reason);
  return false;
}

static bool add_want(adding *a, want w) {
  if (a->count == MOST_WANTED) return fail(a, w.source, "there are too many packages");
  if (!VS_GROW(a->wants, a->room, a->count + 1)) return fail(a, w.source, "out of memory");
  want copy = { strdup(w.source), strdup(w.name), strdup(w.commit), strdup(w.hash), strdup(w.by), false };
  a->wants[a->count++] = copy;
  return copy.source && copy.name && copy.commit && copy.hash && copy.by;
}

/* Sets name to the last part of the source: towers for https://place/towers.git#v2. */
static void name_of(const char *source, char name[64]) {
  size_t n = strcspn(source, "#");
  while (n && source[n - 1] == '/') n--;
  if (n > 4 && !strncmp(source + n - 4, ".git", 4)) n -= 4;
  size_t from = n;
  while (from && !strchr("/:", source[from - 1])) from--;
  snprintf(name, 64, "%.*s", (int)(n - from), source + from);
}

/* ---- the description that a package may have: {"name": "towers", "needs": {"bricks": "https://..."}} ---- */

static cli_data read_manifest(adding *a, const char *folder) {
  char path[PATH_MAX + 40], *text = NULL;
  size_t room = 0;
  snprintf(path, sizeof path, "%s/%s", folder, MANIFEST);
  FILE *from = fopen(path, "rb");
  if (!from) return NULL;
  size_t length = VS_GROW(text, room, MOST_MANIFEST) ? fread(text, 1, MOST_MANIFEST, from) : 0;
  fclose(from);
  cli_data all = cli_data_read(&a->lock.json, text ? text : "", length);
  if (!all) fail(a, path, "it is no JSON");
  free(text);
  return all;
}

/* Adds the packages that a package needs. A package from a folder may need other folders, by paths relative to it. A
 * package from git may need only addresses of git. */
static bool add_needs(adding *a, cli_data manifest, const want *w, const char *name) {
  cli_data needs = cli_data_at(&a->lock.json, manifest, "needs");
  char source[PATH_MAX], by[64];
  snprintf(by, sizeof by, "%s", name);
  bool git = is_git_address(w->source), ok = true;
  char *own = strdup(w->source); /* add_want may move *w */
  for (cli_data_member m = cli_data_first(&a->lock.json, needs); m && ok; m = cli_data_next(&a->lock.json, needs, m)) {
    const char *need = cli_data_key(&a->lock.json, m);
    const char *from = cli_data_text(&a->lock.json, cli_data_value(&a->lock.json, m), "", NULL);
    if (!package_is_name(need) || !from) ok = fail(a, name, "its needs have a name and a source each");
    else if (git && !is_git_address(from)) ok = fail(a, name, "a package by git needs only packages by git");
    else {
      bool below = !is_git_address(from) && *from != '/';
      snprintf(source, sizeof source, "%s%s%s", below ? own : "", below ? "/" : "", from);
      ok = add_want(a, (want){ .source = source, .name = (char *)(size_t)need, .commit = "", .hash = "", .by = by });
    }
  }
  free(own);
  return ok;
}

/* ---- fetching ---- */

/* Returns true if vs.lock already has the package from this source. Fails if vs.lock has it from another source. */
static bool is_there(adding *a, const want *w, const char *name, bool *conflict) {
  const package *p = package_lock_find(&a->lock, name);
  *conflict = false;
  if (!p || !*w->by) return false;
  *conflict = strcmp(p->source, w->source) != 0;
  if (*conflict)
    snprintf(a->why, sizeof a->why, "%.60s needs %.60s from %.60s, and vs.lock has it from %.60s", w->by, name,
             w->source, p->source);
  return true;
}

static bool record(adding *a, const want *w, const char *name, const char *commit, const char *hash) {
  package *p = package_lock_put(&a->lock, name);
  char *source = strdup(w->source), *taken = strdup(commit);
  if (!p || !source || !taken) {
    free(source);
    free(taken);
    return fail(a, name, "out of memory");
  }
  free(p->source);
  free(p->commit);
  p->source = source, p->commit = taken;
  if (!*w->hash) p->direct = !*w->by;
  snprintf(p->hash, sizeof p->hash, "%s", hash);
  return true;
}

/* Fetches one package into the temporary folder .vs.new, and records it in the lock. */
static vs_outcome fetch(adding *a, size_t i) {
  char to[PATH_MAX], named[PATH_MAX], commit[80], hash[PACKAGE_HASH], name[64];
  const want *w = &a->wants[i];
  bool conflict = false;
  bool there = *w->name && !*w->hash && is_there(a, w, w->name, &conflict);
  if (there) return conflict ? VS_OUTCOME_USAGE : VS_OUTCOME_DONE;
  snprintf(to, sizeof to, "%s/+%zu", STAGE, i);
  snprintf(commit, sizeof commit, "%s", w->commit);
  fetch_outcome got = package_fetch(w->source, to, commit, a->why);
  if (got != FETCHED) return got == NO_GIT ? VS_OUTCOME_WORKER : VS_OUTCOME_USAGE;
  *a->why = 0;
  cli_data manifest = read_manifest(a, to);
  const char *own = cli_data_text(&a->lock.json, manifest, "name", NULL);
  if (own) snprintf(name, sizeof name, "%s", own);
  else name_of(*w->name ? w->name : w->source, name);
  bool ok = !*a->why;
  if (ok && !package_is_name(name))
    ok = fail(a, name, "a name has small letters, digits and hyphens, and is no name of ours");
  if (ok && *w->name && strcmp(w->name, name)) ok = fail(a, w->source, "the package there has another name");
  if (ok) ok = package_hash(to, hash, a->why);
  if (ok && *w->hash && strcmp(hash, w->hash)) ok = fail(a, w->source, "the package there is not the one of vs.lock");
  snprintf(named, sizeof named, "%s/%s", STAGE, name);
  if (ok && (!package_remove(named) || rename(to, named) != 0)) ok = fail(a, named, strerror(errno));
  if (ok) ok = record(a, w, name, commit, hash);
  if (ok && !*w->hash) ok = add_needs(a, manifest, w, name);
  if (ok) printf("%s%s%.12s from %s\n", name, *commit ? " " : "", commit, a->wants[i].source);
  cli_data_free(&a->lock.json, manifest);
  return ok ? VS_OUTCOME_DONE : VS_OUTCOME_USAGE;
}

/* Moves the packages from .vs.new to their places. */
static bool settle(adding *a) {
  for (size_t i = 0; i < a->lock.count; i++) {
    char from[PATH_MAX], to[PATH_MAX];
    snprintf(from, sizeof from, "%s/%s", STAGE, a->lock.at[i].name);
    snprintf(to, sizeof to, "%s/%s", HOME, a->lock.at[i].name);
    if (access(from, F_OK) != 0) continue;
    if (!package_remove(to) || rename(from, to) != 0) return fail(a, to, strerror(errno));
  }
  return package_lock_write(&a->lock, ".") || fail(a, "vs.lock", strerror(errno));
}

/* Adds the packages of vs.lock that are missing or have changed to the list of packages to fetch. */
static bool want_missing(adding *a) {
  for (size_t i = 0; i < a->lock.count; i++) {
    const package *p = &a->lock.at[i];
    char path[PATH_MAX], hash[PACKAGE_HASH] = "", why[PACKAGE_WHY];
    snprintf(path, sizeof path, "%s/%s", HOME, p->name);
    if (access(path, F_OK) == 0 && package_hash(path, hash, why) && !strcmp(hash, p->hash)) continue;
    if (!add_want(a, (want){ p->source, p->name, p->commit, (char *)(size_t)p->hash, "", false })) return false;
  }
  return true;
}

/* ---- names of an index ---- */

/* Returns true if the word is neither an address of git nor an existing folder; it is then a name in the index. */
static bool is_for_index(const char *source) {
  struct stat is;
  return package_is_name(source) && !is_git_address(source) && (stat(source, &is) != 0 || !S_ISDIR(is.st_mode));
}

/* Adds the packages of the command line to the list of packages to fetch. Reads the index of packages when the first
 * name needs it. */
static vs_outcome want_given(adding *a, const cli_options *o) {
  package_index x = { 0 };
  bool read = false, ok = true;
  const char *index = package_index_source(o->index);
  fetch_outcome got = FETCHED;
  for (size_t i = 0; ok && i < o->source_count; i++) {
    const char *source = o->sources[i].text, *name = "";
    if (index && is_for_index(source)) {
      if (!read) got = package_index_read(&x, index, a->why), read = true;
      const package_entry *e = got == FETCHED ? package_index_find(&x, source) : NULL;
      if (got == FETCHED && !e) fail(a, source, "there is no such folder, and the index has no such package");
      ok = e != NULL;
      name = source, source = e ? e->address : source;
    }
    ok = ok && add_want(a, (want){ (char *)(size_t)source, (char *)(size_t)name, "", "", "", false });
  }
  if (read) package_index_free(&x);
  return ok ? VS_OUTCOME_DONE : got == NO_GIT ? VS_OUTCOME_WORKER : VS_OUTCOME_USAGE;
}

static bool is_folder(adding *a, const char *path) {
  return mkdir(path, 0777) == 0 || errno == EEXIST || fail(a, path, strerror(errno));
}

vs_outcome cli_add_command(const cli_options *o) {
  adding a = { 0 };
  bool ok = package_lock_read(&a.lock, ".", a.why);
  vs_outcome outcome = ok ? want_given(&a, o) : VS_OUTCOME_USAGE;
  ok = outcome == VS_OUTCOME_DONE;
  if (ok && !o->source_count) ok = want_missing(&a);
  ok = ok && (package_remove(STAGE) || fail(&a, STAGE, strerror(errno)));
  ok = ok && is_folder(&a, HOME) && is_folder(&a, STAGE);
  if (!ok && outcome == VS_OUTCOME_DONE) outcome = VS_OUTCOME_USAGE;
  for (size_t i = 0; outcome == VS_OUTCOME_DONE && i < a.count; i++) outcome = fetch(&a, i);
  if (outcome == VS_OUTCOME_DONE && a.count && !settle(&a)) outcome = VS_OUTCOME_USAGE;
  package_remove(STAGE);
  rmdir(HOME); /* rmdir removes the folder only if it is empty */
  if (outcome != VS_OUTCOME_DONE) fprintf(stderr, "vs add: %s\n", a.why);
  else if (!a.count) puts("all packages of vs.lock are there");
  for (size_t i = 0; i < a.count; i++) {
    free(a.wants[i].source);
    free(a.wants[i].name);
    free(a.wants[i].commit);
    free(a.wants[i].hash);
    free(a.wants[i].by);
  }
  free(a.wants);
  package_lock_free(&a.lock);
  return outcome;
}
