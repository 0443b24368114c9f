/* Implements ranges of --only and their manifests. */
#define _GNU_SOURCE
#include "cli/batch/ranges.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

enum { PATH_ROOM = 4096 };

bool cli_range_read(const char *text, long most, long *from, long *to) {
  char *end;
  *from = *to = strtol(text, &end, 10);
  bool ok = end != text && (!*end || !strncmp(end, "..", 2));
  if (ok && *end) {
    const char *second = end + 2;
    *to = strtol(second, &end, 10);
    ok = end != second && !*end;
  }
  ok = ok && *from >= 1 && *from <= most && *to >= *from;
  if (*to > most) *to = most;
  return ok;
}

/* Returns the length of the path of a manifest without its ending .json, if it has one. */
static size_t stem_of(const char *manifest) {
  size_t n = strlen(manifest), ending = strlen(".json");
  return n > ending && !strcmp(manifest + n - ending, ".json") ? n - ending : n;
}

bool cli_range_manifest(const char *manifest, long from, long to, char *out, size_t room) {
  size_t stem = stem_of(manifest);
  int n = snprintf(out, room, "%.*s-%ld..%ld%s", (int)stem, manifest, from, to, manifest + stem);
  return n > 0 && (size_t)n < room;
}

/* Calls `each` for the path of each manifest of a range, until a call returns false. Returns false if a call did. */
static bool each_range(const char *manifest, bool (*each)(void *context, const char *path), void *context) {
  const char *slash = strrchr(manifest, '/'), *name = slash ? slash + 1 : manifest;
  size_t stem = stem_of(name);
  char folder[PATH_ROOM], path[PATH_ROOM];
  snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - manifest + 1) : 2, slash ? manifest : "./");
  DIR *in = opendir(folder);
  struct dirent *entry;
  bool ok = true;
  while (ok && in && (entry = readdir(in)) != NULL) {
    const char *own = entry->d_name;
    long from, to;
    int used = 0;
    if (strncmp(own, name, stem) != 0 || sscanf(own + stem, "-%ld..%ld%n", &from, &to, &used) != 2 || !used ||
        strcmp(own + stem + used, name + stem) != 0) continue;
    int n = snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - manifest + 1) : 0, manifest, own);
    if (n > 0 && n < PATH_ROOM) ok = each(context, path);
  }
  if (in) closedir(in);
  return ok;
}

typedef struct { char **text; bool *idle; } texts;

static bool append(void *context, const char *path) {
  texts *t = context;
  FILE *f = fopen(path, "rb");
  char *own = NULL, *both = NULL;
  size_t room = 0;
  if (!f) return true;
  if (t->idle && flock(fileno(f), LOCK_SH | LOCK_NB) != 0) *t->idle = false;
  bool any = getdelim(&own, &room, 0, f) > 0;
  fclose(f);
  bool ok = !any || asprintf(&both, "%s%s", *t->text ? *t->text : "", own) >= 0;
  free(own);
  if (!any || !ok) return ok;
  free(*t->text);
  *t->text = both;
  return true;
}

bool cli_range_texts(const char *manifest, char **text, bool *idle) {
  if (idle) *idle = true;
  return each_range(manifest, append, &(texts){text, idle});
}

static bool remove_one(void *context, const char *path) {
  (void)context;
  remove(path);
  return true;
}

void cli_range_remove(const char *manifest) { each_range(manifest, remove_one, NULL); }
