/* Reads, writes and checks the file vs.lock. */
#define _GNU_SOURCE
#include "cli/packages/package_lock.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/batch/whole_file.h"
#include "cli/json.h"
#include "model/store/array.h"

enum { LOCK_PATH = PATH_MAX + 20, MOST_LOCK = 8 << 20 };

static bool fail(char why[PACKAGE_WHY], const char *path, const char *reason) {
  snprintf(why, PACKAGE_WHY, "%.150s: %.130s", path, reason);
  return false;
}

/* ---- reading and writing ---- */

bool package_is_name(const char *name) {
  static const char *const ours[] = { "scheme", "srfi", "visualscheme", "match", "gml", "prefabs", "javascript" };
  size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-");
  for (size_t i = 0; i < sizeof ours / sizeof *ours; i++)
    if (!strcmp(name, ours[i])) return false;
  return n && n < 64 && !name[n] && *name >= 'a' && *name <= 'z';
}

package *package_lock_find(const package_lock *l, const char *name) {
  for (size_t i = 0; i < l->count; i++)
    if (!strcmp(l->at[i].name, name)) return &l->at[i];
  return NULL;
}

package *package_lock_put(package_lock *l, const char *name) {
  package *old = package_lock_find(l, name);
  if (old) return old;
  if (!VS_GROW(l->at, l->room, l->count + 1)) return NULL;
  l->at[l->count] = (package){ .name = strdup(name), .source = strdup(""), .commit = strdup("") };
  return l->at[l->count].name ? &l->at[l->count++] : NULL;
}

void package_lock_free(package_lock *l) {
  for (size_t i = 0; i < l->count; i++) {
    free(l->at[i].name);
    free(l->at[i].source);
    free(l->at[i].commit);
  }
  free(l->at);
  cli_data_close(&l->json);
  *l = (package_lock){ 0 };
}

static bool take(package_lock *l, cli_data row) {
  const char *name = cli_data_text(&l->json, row, "name", NULL), *source = cli_data_text(&l->json, row, "source", NULL);
  const char *commit = cli_data_text(&l->json, row, "commit", NULL), *hash = cli_data_text(&l->json, row, "hash", NULL);
  if (!name || !package_is_name(name) || !source || !commit || !hash || strlen(hash) != PACKAGE_HASH - 1) return false;
  package *p = package_lock_put(l, name);
  if (!p) return false;
  free(p->source);
  free(p->commit);
  p->source = strdup(source), p->commit = strdup(commit);
  p->direct = cli_data_true(&l->json, row, "direct");
  snprintf(p->hash, sizeof p->hash, "%s", hash);
  return p->source && p->commit;
}

bool package_lock_read(package_lock *l, const char *folder, char why[PACKAGE_WHY]) {
  char path[LOCK_PATH], *text = NULL;
  size_t room = 0, length = 0;
  *l = (package_lock){ 0 };
  if (!cli_data_open(&l->json)) return fail(why, "vs.lock", l->json.trouble);
  snprintf(path, sizeof path, "%s/vs.lock", folder);
  FILE *from = fopen(path, "rb");
  if (!from) return errno == ENOENT || fail(why, path, strerror(errno));
  bool ok = VS_GROW(text, room, MOST_LOCK);
  if (ok) length = fread(text, 1, MOST_LOCK, from);
  fclose(from);
  cli_data all = ok ? cli_data_read(&l->json, text, length) : NULL;
  cli_data rows = cli_data_at(&l->json, all, "packages");
  ok = cli_data_number(&l->json, all, "schema", 0) == 1 && rows;
  for (size_t i = 0; ok && i < cli_data_count(&l->json, rows); i++) ok = take(l, cli_data_nth(&l->json, rows, i));
  cli_data_free(&l->json, all);
  free(text);
  return ok || fail(why, path, "it is no lock of vs add");
}

bool package_lock_write(const package_lock *l, const char *folder) {
  char path[LOCK_PATH];
  cli_whole_file file;
  snprintf(path, sizeof path, "%s/vs.lock", folder);
  FILE *to = cli_whole_begin(&file, path);
  if (!to) return false;
  fputs("{\"schema\": 1, \"packages\": [", to);
  for (size_t i = 0; i < l->count; i++) {
    const package *p = &l->at[i];
    const char *const keys[] = { "name", "source", "commit", "hash" };
    const char *const values[] = { p->name, p->source, p->commit, p->hash };
    fputs(i ? ",\n  {" : "\n  {", to);
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
      fprintf(to, "\"%s\": ", keys[k]);
      cli_json_text(to, values[k]);
      fputs(", ", to);
    }
    fprintf(to, "\"direct\": %s}", p->direct ? "true" : "false");
  }
  fputs("\n]}\n", to);
  return cli_whole_end(&file, true);
}

/* ---- comparing with the folder ---- */

static bool has_others(const package_lock *l, const char *folder, char why[PACKAGE_WHY]) {
  char path[LOCK_PATH];
  snprintf(path, sizeof path, "%s/.vs", folder);
  DIR *all = opendir(path);
  bool found = false;
  for (const struct dirent *d; all && !found && (d = readdir(all));) {
    if (!strcmp(d->d_name, ".") || !strcmp(d->d_name, "..") || package_lock_find(l, d->d_name)) continue;
    snprintf(why, PACKAGE_WHY, "%.100s/%.100s is not in vs.lock: remove it, or add it by vs add", path, d->d_name);
    found = true;
  }
  if (all) closedir(all);
  return found;
}

bool package_lock_agrees(const package_lock *l, const char *folder, char why[PACKAGE_WHY]) {
  for (size_t i = 0; i < l->count; i++) {
    char path[LOCK_PATH + 80], hash[PACKAGE_HASH];
    snprintf(path, sizeof path, "%s/.vs/%s", folder, l->at[i].name);
    if (access(path, F_OK) != 0) {
      snprintf(why, PACKAGE_WHY, "the package %s of vs.lock is not in %.150s/.vs: vs add fetches it", l->at[i].name,
               folder);
      return false;
    }
    if (!package_hash(path, hash, why)) return false;
    if (!strcmp(hash, l->at[i].hash)) continue;
    snprintf(why, PACKAGE_WHY, "the package %s has changed since it was added: vs add fetches it again", l->at[i].name);
    return false;
  }
  return !has_others(l, folder, why);
}

/* Returns true if the folder has a lock that belongs to the user, as the folder does. */
static bool has_lock(const char *folder) {
  char path[LOCK_PATH];
  struct stat lock, around;
  snprintf(path, sizeof path, "%s/vs.lock", folder);
  return stat(path, &lock) == 0 && stat(folder, &around) == 0 && lock.st_uid == geteuid() && around.st_uid == geteuid();
}

/* Sets folder to the folder of the model, or to the nearest folder around it, that has a lock. */
static bool find_lock(const char *model, char folder[PATH_MAX]) {
  const char *slash = model ? strrchr(model, '/') : NULL;
  char near[PATH_MAX];
  snprintf(near, sizeof near, "%.*s", slash ? (int)(slash - model) + (slash == model) : 1, slash ? model : ".");
  if (has_lock(near)) return snprintf(folder, PATH_MAX, "%s", near) > 0;
  if (!realpath(near, folder)) return false;
  for (char *end; (end = strrchr(folder, '/')) && end > folder;) {
    *end = 0;
    if (has_lock(folder)) return true;
  }
  return false;
}

bool package_path(const char *model, char *path, size_t size, char why[PACKAGE_WHY]) {
  char folder[PATH_MAX];
  package_lock l;
  *path = 0;
  if (!find_lock(model, folder)) return true;
  bool ok = package_lock_read(&l, folder, why) && package_lock_agrees(&l, folder, why);
  package_lock_free(&l);
  if (ok) snprintf(path, size, "%s%s.vs", strcmp(folder, ".") ? folder : "", strcmp(folder, ".") ? "/" : "");
  return ok;
}
