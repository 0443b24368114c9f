/* Reads the states of the parts of `vs render` from its manifests, which have one line for each picture. */
#define _GNU_SOURCE
#include "cli/batch/part_states.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { PATH_ROOM = 4096 };

cli_part_state cli_part_state_of(int code) {
  bool same = code == VS_OUTCOME_MODEL || code == VS_OUTCOME_MACHINE; /* an error of the model or the machine: another
                                                                       * run would fail in the same way */
  return code == VS_OUTCOME_DONE ? PART_DONE : same ? PART_FAILED : PART_KILLED;
}

size_t cli_part_states_count(const cli_part_states *p, cli_part_state state) {
  size_t n = 0;
  for (size_t i = 0; i < p->count; i++) n += p->at[i] == state;
  return n;
}

/* Returns the length of the folder that the output names, or 0: out/, out, or the out of out/%.stl. */
static size_t folder_of(const char *path) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  size_t length = strlen(path);
  if (strchr(path, '%')) length = slash ? (size_t)(slash - path) : 0;
  else if (*name && strchr(name, '.')) length = 0;
  while (length > 1 && path[length - 1] == '/') length--;
  return length;
}

bool cli_part_folder(const cli_options *o, char *out, size_t room) {
  for (size_t i = 0; i < o->target_count; i++) {
    size_t length = folder_of(o->targets[i].path);
    if (length > 0 && length < room) return snprintf(out, room, "%.*s", (int)length, o->targets[i].path) > 0;
  }
  return fputs("vs: --on needs a folder for the results, as in -o out/\n", stderr) < 0;
}

/* ---- the manifests of vs render ---- */

/* The lines about a part in one manifest. any: whether there is a line; missing: whether a picture is missing; code:
 * the exit code of a picture that failed, or 0. */
typedef struct { bool any, missing; int code; } seen;

typedef struct {
  cli_part_states *out;
  seen *at;            /* for each part, its lines in the manifest that is being read */
  size_t made;         /* number of pictures whose seconds are in out->seconds */
} reading;

/* Returns the whole number after the name in the line, or `otherwise` if there is none. */
static long number_after(const char *line, const char *name, long otherwise) {
  const char *at = strstr(line, name);
  return at ? strtol(at + strlen(name), NULL, 10) : otherwise;
}

/* Reads a line of a manifest: {"file": ..., "part": 7, ..., "seconds": 1.5, "outcome": "made"}. */
static void take_line(reading *r, const char *line) {
  static const char before[] = ", \"outcome\": \"", time[] = ", \"seconds\": ";
  long part = number_after(line, ", \"part\": ", 0);
  const char *outcome = strstr(line, before), *seconds = strstr(line, time);
  if (part < 1 || (size_t)part > r->out->count || !outcome) return;
  seen *s = &r->at[part - 1];
  outcome += strlen(before);
  s->any = true;
  if (!strncmp(outcome, "not tried", 9)) s->missing = true;
  if (!strncmp(outcome, "failed", 6) && cli_part_state_of(s->code) != PART_FAILED)
    s->code = (int)number_after(line, ", \"code\": ", VS_OUTCOME_MODEL);
  if (!strncmp(outcome, "made", 4) && seconds)
    r->out->seconds += strtod(seconds + strlen(time), NULL), r->made++;
}

/* Reads a manifest. A part that one manifest lists as done is done, even if another manifest lists it as missing or
 * failed. */
static void take_file(reading *r, const char *path) {
  cli_part_states *out = r->out;
  FILE *f = fopen(path, "rb");
  char *line = NULL;
  size_t room = 0;
  memset(r->at, 0, out->count * sizeof *r->at);
  while (f && getline(&line, &room, f) > 0) take_line(r, line);
  if (f) fclose(f);
  free(line);
  for (size_t i = 0; i < out->count; i++) {
    const seen *s = &r->at[i];
    if (!s->any || out->at[i] == PART_DONE || (s->missing && !s->code)) continue;
    out->at[i] = cli_part_state_of(s->code);
    if (s->code && !out->code) out->code = s->code;
  }
}

/* Reads the manifests of ranges (--only) in the folder. If there are none, reads the manifest of all pictures. */
static void take_folder(reading *r, const char *folder) {
  char path[PATH_ROOM];
  long from, to;
  bool any = false;
  DIR *in = opendir(folder);
  struct dirent *entry;
  while (in && (entry = readdir(in)) != NULL) {
    int used = 0;
    if (sscanf(entry->d_name, "manifest-%ld..%ld.json%n", &from, &to, &used) != 2 || !used || entry->d_name[used] ||
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) >= PATH_ROOM) continue;
    any = true;
    take_file(r, path);
  }
  if (in) closedir(in);
  if (!any && snprintf(path, sizeof path, "%s/manifest.json", folder) < PATH_ROOM) take_file(r, path);
}

bool cli_part_states_read(const cli_options *o, const char *folder, cli_part_states *out) {
  reading r = {.out = out};
  *out = (cli_part_states){.count = (size_t)cli_options_parts(o)};
  out->at = vs_zeros(out->count, sizeof *out->at);
  r.at = vs_zeros(out->count, sizeof *r.at);
  bool ok = out->at && r.at;
  if (ok) take_folder(&r, folder);
  else fputs("vs render: out of memory\n", stderr);
  if (r.made) out->seconds /= (double)r.made;
  free(r.at);
  return ok;
}
