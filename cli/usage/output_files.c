/* Finds the formats of outputs, and whether their files can be written. */
#include "cli/usage/output_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/nearby.h"

const char *cli_ending_of(const char *path) {
  const char *base = strrchr(path, '/');
  return strcmp(path, "-") == 0 ? NULL : strrchr(base ? base + 1 : path, '.');
}

/* Writes the file name with the ending that other programs read. Returns false if the table of endings lacks this
 * ending. */
static bool advise_ending(const char *path, const char *ending) {
  static const struct { const char *endings, *here, *who; } endings_here[] = {
#define ENDING(endings, here, who) { endings, here, who },
#include "cli/endings.def"
  };
  size_t n = strlen(ending + 1);
  for (size_t i = 0; n && i < sizeof endings_here / sizeof *endings_here; i++)
    for (const char *w = endings_here[i].endings; *w; w += *w == ' ') {
      size_t length = strcspn(w, " ");
      if (length == n && !strncasecmp(w, ending + 1, n)) {
        fprintf(stderr, " write -o %.*s.%s, %s;", (int)(ending - path), path, endings_here[i].here,
                endings_here[i].who);
        return true;
      }
      w += length;
    }
  return false;
}

/* Finds the format of a target among those that the program defines. scheme may be NULL. Returns false after a message
 * on standard error. */
static bool late_format(const cli_options *o, cli_target *t, const vs_scheme *scheme) {
  const char *ending = cli_ending_of(t->path);
  vs_format_info brought;
  if (t->format) return true;
  if (scheme && ending && vs_format_of(scheme, ending, &brought)) return t->format = ending, true;
  if (scheme && o->format && vs_format_of(scheme, o->format, &brought)) return t->format = o->format, true;
  if (o->format) {
    fprintf(stderr, "vs: --format %s: there is no such format;", o->format);
  } else if (strcmp(t->path, "-") == 0) {
    fputs("vs: -o - needs --format;", stderr);
  } else {
    fprintf(stderr, "vs: %s: ", t->path);
    if (ending) fprintf(stderr, "no format has the ending %s;", ending);
    else fputs("the name has no ending that names a format;", stderr);
  }
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  cli_nearby near = cli_nearby_start(o->format ? o->format : ending ? ending + 1 : "");
  for (size_t i = 0; i < count; i++) cli_nearby_offer(&near, formats[i].suffix);
  if (!o->format && ending && advise_ending(t->path, ending)) near.best = NULL;
  if (near.best && *near.wanted && (o->format || near.distance < 2)) fprintf(stderr, " perhaps .%s;", near.best);
  fprintf(stderr, " there are %s\n", vs_format_endings());
  return false;
}

bool cli_find_format(cli_options *o, cli_target *t) {
  const char *ending = cli_ending_of(t->path);
  if (strcmp(t->path, "-") == 0) o->to_stdout = true;
  const vs_format_info *said = o->format ? vs_format_find(o->format) : NULL,
                       *own = ending ? vs_format_find(ending) : NULL;
  if (own && said && strcmp(said->suffix, own->suffix) == 0) own = said; /* if --format names another format with the
                                                                          * file's suffix, that format is used */
  if (!own) own = said;
  if (own) t->format = own->name;
  return own || o->format || (ending && ending[1]) || late_format(o, t, NULL);
}

bool cli_options_late(cli_options *o, const vs_scheme *scheme) {
  for (size_t i = 0; i < o->target_count; i++)
    if (!late_format(o, &o->targets[i], scheme)) return false;
  return true;
}

const char *cli_file_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

char cli_file_letter(char c, bool first) {
  bool bad = (unsigned char)c < ' ' || c == 127 || strchr("/\\:*?\"<>|%", c) || (first && (c == '.' || c == '-'));
  return c && bad ? '-' : c;
}

bool cli_options_is_pattern(const char *path) {
  return *cli_file_name(path) == '%';
}

bool cli_output_reachable(const cli_target *t) {
  if (strcmp(t->path, "-") == 0) return true;
  struct stat status;
  if (stat(t->path, &status) == 0 && S_ISDIR(status.st_mode)) {
    fprintf(stderr, "vs: %s: is a folder, not a file\n", t->path);
    return false;
  }
  const char *slash = strrchr(t->path, '/');
  size_t length = slash ? (size_t)(slash - t->path) : 0;
  char *folder = malloc(length + 2);
  if (!folder) return true; /* if memory is out here, writing the output will report it */
  memcpy(folder, t->path, length);
  strcpy(folder + length, slash ? (length ? "" : "/") : ".");
  bool found = stat(folder, &status) == 0, ok = found && S_ISDIR(status.st_mode) && access(folder, W_OK | X_OK) == 0;
  if (found && !S_ISDIR(status.st_mode)) errno = ENOTDIR;
  if (!ok && errno == ENOENT) fprintf(stderr, "vs: %s: there is no folder %s\n", t->path, folder);
  else if (!ok && errno == ENOTDIR) fprintf(stderr, "vs: %s: %s is no folder\n", t->path, folder);
  else if (!ok) fprintf(stderr, "vs: %s: cannot write into %s: %s\n", t->path, folder, strerror(errno));
  free(folder);
  return ok;
}

bool cli_is_png_or_folder(const char *path) {
  const char *ending = cli_ending_of(path);
  return !ending || strcmp(ending, ".png") == 0 || path[strlen(path) - 1] == '/';
}

bool cli_path_with(const char *path, const char *word, char name[CLI_PATH_ROOM]) {
  const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
  size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - path) : strlen(path);
  int length = snprintf(name, CLI_PATH_ROOM, "%.*s-%s%s", (int)stem, path, word, path + stem);
  if (length > 0 && length < CLI_PATH_ROOM) return true;
  fprintf(stderr, "vs: %s: the name is too long\n", path);
  return false;
}
