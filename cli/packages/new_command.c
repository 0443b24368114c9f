/* Implements `vs new NAME`: writes the files that new_files.def lists, with NAME in their texts. */
#include "cli/packages/new_command.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/packages/package_lock.h"

static const struct { const char *path, *text; } files[] = {
#define NEW_FILE(path, text) { path, text },
#include "cli/packages/new_files.def"
};

static void put(FILE *to, const char *text, const char *name) {
  for (; *text; text++)
    if (*text == '@') fputs(name, to);
    else fputc(*text, to);
}

static bool write_file(size_t i, const char *name) {
  char path[PATH_MAX] = "";
  size_t length = (size_t)snprintf(path, sizeof path, "%s/", name);
  FILE *text = fmemopen(path + length, sizeof path - length, "w");
  if (!text) return false;
  put(text, files[i].path, name);
  fclose(text);
  char *slash = strrchr(path + length, '/');
  if (slash) {
    *slash = 0;
    if (mkdir(path, 0777) != 0 && errno != EEXIST) return false;
    *slash = '/';
  }
  FILE *to = fopen(path, "wx");
  if (!to) return false;
  put(to, files[i].text, name);
  bool ok = !ferror(to);
  ok = fclose(to) == 0 && ok;
  if (ok) puts(path);
  return ok;
}

static const char FIRST_MODEL[] = "; Save this file, and the picture follows. vs help box explains make-box.\n"
                                  "(define-parameter height 3.0 #:min 1 #:max 9)\n"
                                  "\n"
                                  "(draw (make-box (xyz 0 0 0) (xyz 4 3 height)))\n";

void cli_new_model(const char *path) {
  size_t length = strlen(path);
  struct stat there;
  if (length < 4 || strcmp(path + length - 3, ".vs") != 0 || path[length - 4] == '/') return;
  if (lstat(path, &there) == 0 || errno != ENOENT) return;
  FILE *to = fopen(path, "wx");
  if (!to) return;
  bool ok = fputs(FIRST_MODEL, to) >= 0;
  if (fclose(to) == 0 && ok) fprintf(stderr, "vs view: made %s\n", path);
  else unlink(path);
}

vs_outcome cli_new_command(const cli_options *o) {
  const char *name = o->sources[0].text;
  if (!package_is_name(name)) {
    fprintf(stderr, "vs new: %s: a name has small letters, digits and hyphens, and is no name of ours, as in vs new "
                    "tower\n", name);
    return VS_OUTCOME_USAGE;
  }
  bool made = mkdir(name, 0777) == 0, ok = made;
  for (size_t i = 0; ok && i < sizeof files / sizeof *files; i++) ok = write_file(i, name);
  if (ok) return VS_OUTCOME_DONE;
  fprintf(stderr, "vs new: %s: %s\n", name, strerror(errno));
  if (made) package_remove(name);
  return VS_OUTCOME_USAGE;
}
