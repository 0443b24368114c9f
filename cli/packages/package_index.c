/* Reads an index of packages: {"schema": 1, "packages": [{"name": ..., "address": ..., "description": ...,
 * "version": ...}]}. */
#define _GNU_SOURCE
#include "cli/packages/package_index.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "model/store/array.h"

static const char FILE_NAME[] = "vs-index.json";
enum { MOST_INDEX = 16 << 20 };

static bool fail(char why[PACKAGE_WHY], const char *source, const char *reason) {
  snprintf(why, PACKAGE_WHY, "%.150s: %.140s", source, reason);
  return false;
}

const char *package_index_source(const char *given) {
  const char *set = getenv("VS_PACKAGE_INDEX");
  return given ? given : set && *set ? set : NULL;
}

const package_entry *package_index_find(const package_index *x, const char *name) {
  for (size_t i = 0; i < x->count; i++)
    if (!strcmp(x->at[i].name, name)) return &x->at[i];
  return NULL;
}

void package_index_free(package_index *x) {
  for (size_t i = 0; i < x->count; i++) free(x->at[i].address);
  free(x->at);
  if (x->json.functions) cli_data_free(&x->json, x->all);
  cli_data_close(&x->json);
  *x = (package_index){ 0 };
}

/* ---- the rows ---- */

static int by_name(const void *a, const void *b) {
  return strcmp(((const package_entry *)a)->name, ((const package_entry *)b)->name);
}

/* Returns the address as a source for vs add, which the caller frees. A relative path begins at the index's folder.
 * Returns NULL when memory is out. */
static char *address_of(const char *address, const char *folder) {
  char *made = NULL;
  if (is_git_address(address) || *address == '/' || !*folder) return strdup(address);
  return asprintf(&made, "%s/%s", folder, address) < 0 ? NULL : made;
}

/* Adds a row of the index. folder: the folder of the index, or NULL if the index came by git. Returns NULL on success,
 * otherwise the fault of the row. */
static const char *take(package_index *x, cli_data row, const char *folder) {
  const cli_data_reader *r = &x->json;
  const char *name = cli_data_text(r, row, "name", NULL), *address = cli_data_text(r, row, "address", NULL);
  const char *description = cli_data_text(r, row, "description", NULL);
  const char *version = cli_data_text(r, row, "version", NULL);
  if (!name || !package_is_name(name)) return "it has no name that a package may have";
  if (!address || !*address) return "it has no address";
  if (!folder && !is_git_address(address)) return "an index by git has only packages by git";
  if (!VS_GROW(x->at, x->room, x->count + 1)) return "out of memory";
  char *source = address_of(address, folder ? folder : "");
  if (!source) return "out of memory";
  x->at[x->count++] = (package_entry){ name, description ? description : "", version ? version : "", source };
  return NULL;
}

/* Reads the rows of the text, sorted by name. */
static bool take_rows(package_index *x, const char *source, const char *folder, char why[PACKAGE_WHY]) {
  char reason[200];
  cli_data rows = cli_data_at(&x->json, x->all, "packages");
  if (!rows || cli_data_number(&x->json, x->all, "schema", 0) != 1)
    return fail(why, source, "it is no index of packages");
  for (size_t i = 0; i < cli_data_count(&x->json, rows); i++) {
    const char *fault = take(x, cli_data_nth(&x->json, rows, i), folder);
    if (!fault) continue;
    snprintf(reason, sizeof reason, "package %zu of the index: %s", i + 1, fault);
    return fail(why, source, reason);
  }
  if (x->count) qsort(x->at, x->count, sizeof *x->at, by_name);
  for (size_t i = 1; i < x->count; i++)
    if (!by_name(&x->at[i - 1], &x->at[i])) {
      snprintf(reason, sizeof reason, "the index has the package %.63s twice", x->at[i].name);
      return fail(why, source, reason);
    }
  return true;
}

/* ---- the file ---- */

static bool read_file(package_index *x, const char *path, const char *source, char why[PACKAGE_WHY]) {
  char *text = NULL;
  size_t room = 0;
  FILE *from = fopen(path, "rb");
  if (!from) return fail(why, source, errno == ENOENT ? "there is no such index" : strerror(errno));
  bool ok = VS_GROW(text, room, MOST_INDEX + 1) || fail(why, source, "out of memory");
  size_t length = ok ? fread(text, 1, MOST_INDEX + 1, from) : 0;
  if (ok && ferror(from)) ok = fail(why, source, strerror(errno));
  if (ok && length > MOST_INDEX) ok = fail(why, source, "an index has at most 16 MB");
  fclose(from);
  if (ok) x->all = cli_data_read(&x->json, text, length);
  free(text);
  return ok && (x->all || fail(why, source, "it is no JSON"));
}

static fetch_outcome read_by_git(package_index *x, const char *source, char why[PACKAGE_WHY]) {
  const char *around = getenv("TMPDIR");
  char folder[PATH_MAX], to[PATH_MAX + 10], path[PATH_MAX + 40], commit[80] = "";
  snprintf(folder, sizeof folder, "%s/vs-index-XXXXXX", around && *around ? around : "/tmp");
  if (!mkdtemp(folder)) return fail(why, folder, strerror(errno)), NOT_FETCHED;
  snprintf(to, sizeof to, "%s/index", folder);
  snprintf(path, sizeof path, "%s/%s", to, FILE_NAME);
  fetch_outcome got = package_fetch(source, to, commit, why);
  bool ok = got == FETCHED && read_file(x, path, source, why) && take_rows(x, source, NULL, why);
  package_remove(folder);
  return got == FETCHED && !ok ? NOT_FETCHED : got;
}

fetch_outcome package_index_read(package_index *x, const char *source, char why[PACKAGE_WHY]) {
  struct stat is;
  char path[PATH_MAX];
  *x = (package_index){ 0 };
  if (!cli_data_open(&x->json)) return fail(why, source, x->json.trouble), NOT_FETCHED;
  if (is_git_address(source)) return read_by_git(x, source, why);
  bool folder = stat(source, &is) == 0 && S_ISDIR(is.st_mode);
  if (snprintf(path, sizeof path, "%s%s%s", source, folder ? "/" : "", folder ? FILE_NAME : "") >= (int)sizeof path)
    return fail(why, source, "the path is too long"), NOT_FETCHED;
  if (!read_file(x, path, source, why)) return NOT_FETCHED;
  char *slash = strrchr(path, '/');
  if (slash) slash[slash == path] = 0;
  return take_rows(x, source, slash ? path : "", why) ? FETCHED : NOT_FETCHED;
}
