/* Collects the folders in which the interpreter looks for libraries. */
#include "cli/usage/library_folders.h"

#include <stdlib.h>
#include <string.h>

#include "cli/packages/package_lock.h"

bool cli_add_folders(cli_options *o, const char *folders) {
  size_t have = o->library_path ? strlen(o->library_path) : 0, more = strlen(folders);
  char *path = realloc(o->library_path, have + more + 2);
  if (!path) return fputs("vs: out of memory\n", stderr), false;
  o->library_path = path;
  if (have) path[have++] = ':';
  memcpy(path + have, folders, more + 1);
  return true;
}

bool cli_add_packages(cli_options *o) {
  char path[4200], why[PACKAGE_WHY];
  const char *model = NULL;
  for (size_t i = 0; i < o->source_count && !model; i++)
    if (o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-")) model = o->sources[i].text;
  if (package_path(model, path, sizeof path, why)) return !*path || cli_add_folders(o, path);
  fprintf(stderr, "vs: %s\n", why);
  return false;
}
