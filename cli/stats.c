/* Prints the statistics of --stats: tables for readers, one line of JSON for programs.
 *
 * Tables and JSON are computed from the library's keys. A key memory.NAME.peak belongs to a phase, time.stage.NAME to a
 * stage, time.mesh.NAME to a step, and cache.NAME.hits to a kind of cached result. The passes are those of
 * vs_pass_list. New phases and passes therefore appear without a change in this file. The row of the program is the
 * total minus the outputs. */
#include "cli/stats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/json.h"
#include "cli/messages.h"

enum { ROOM = 256, NAMES = 32, KEY = 64, WIDE = 10 };

typedef struct { vs_statistic at[ROOM]; size_t count; vs_output_info info; } table;

static bool output_of(vs_scheme *s, size_t index, table *t) {
  if (!vs_output_statistics(s, index, &t->info, t->at, ROOM, &t->count)) return false;
  if (t->count > ROOM) t->count = ROOM;
  return true;
}

static double get(const table *t, const char *before, const char *name, const char *after) {
  size_t first = strlen(before), second = strlen(name);
  for (size_t i = 0; i < t->count; i++) {
    const char *key = t->at[i].key;
    if (strncmp(key, before, first) == 0 && strncmp(key + first, name, second) == 0 &&
        strcmp(key + first + second, after) == 0)
      return t->at[i].value;
  }
  return NAN;
}

/* Copies the part NAME of each key that consists of prefix, NAME and suffix to names, in order. Returns their
 * number. */
static size_t names_of(const table *t, const char *prefix, const char *suffix, char names[NAMES][KEY]) {
  size_t n = 0, before = strlen(prefix), after = strlen(suffix);
  for (size_t i = 0; i < t->count && n < NAMES; i++) {
    size_t length = strlen(t->at[i].key);
    if (length <= before + after || length - before - after >= KEY || strncmp(t->at[i].key, prefix, before) ||
        strcmp(t->at[i].key + length - after, suffix))
      continue;
    memcpy(names[n], t->at[i].key + before, length - before - after);
    names[n++][length - before - after] = 0;
  }
  return n;
}

/* ---- output as JSON ---- */

static void json_members(const table *t, bool first) {
  for (size_t i = 0; i < t->count; i++) {
    fputs(first && i == 0 ? "" : ", ", stderr);
    cli_json_text(stderr, t->at[i].key);
    fputs(": ", stderr);
    double v = t->at[i].value; /* rounds times to nanoseconds */
    cli_json_number(stderr, strcmp(t->at[i].unit, "s") == 0 ? round(v * 1e9) / 1e9 : v);
  }
}

static void print_json(vs_scheme *s, const table *all) {
  table one;
  fputs("{\"outputs\": [", stderr);
  for (size_t i = 0; output_of(s, i, &one); i++) {
    fputs(i ? ", {\"file\": " : "{\"file\": ", stderr);
    cli_json_text(stderr, one.info.path);
    fputs(", \"format\": ", stderr);
    cli_json_text(stderr, one.info.format);
    fprintf(stderr, ", \"done\": %s", one.info.done ? "true" : "false");
    json_members(&one, false);
    fputc('}', stderr);
  }
  fputs("], ", stderr);
  json_members(all, true);
  fputs("}\n", stderr);
}

/* ---- output as tables ---- */

static void cell(double v, int decimals) {
  if (isnan(v)) fprintf(stderr, "%*s", WIDE, "-");
  else fprintf(stderr, "%*.*f", WIDE, decimals, v);
}

static void row(const char *name) {
  size_t length = strlen(name);
  if (length > 20) fprintf(stderr, "  ...%-17s", name + length - 17);
  else fprintf(stderr, "  %-20s", name);
}

static const char *name_of(const table *t) { return t->info.path[0] ? t->info.path : t->info.format; }

static void heads(const char *title, char names[NAMES][KEY], size_t count, const char *last) {
  fprintf(stderr, "%-22s", title);
  for (size_t i = 0; i < count; i++) fprintf(stderr, "%*s", WIDE, names[i]);
  fprintf(stderr, last ? "%*s\n" : "\n", WIDE, last);
}

static void times(vs_scheme *s, const table *all) {
  char phases[NAMES][KEY];
  size_t count = names_of(all, "memory.", ".peak", phases);
  double rest[NAMES] = { 0 }, sum = 0;
  table one;
  heads("time, ms", phases, count, "all");
  for (size_t i = 0; i < count; i++) rest[i] = get(all, "time.", phases[i], "");
  for (size_t k = 0; output_of(s, k, &one); k++)
    for (size_t i = 0; i < count; i++) rest[i] -= get(&one, "time.", phases[i], "");
  row("program");
  for (size_t i = 0; i < count; i++) cell(fmax(rest[i], 0) * 1000, 2), sum += fmax(rest[i], 0);
  cell(sum * 1000, 2);
  fputc('\n', stderr);
  for (size_t k = 0; output_of(s, k, &one); k++) {
    row(name_of(&one));
    for (size_t i = 0; i < count; i++) cell(get(&one, "time.", phases[i], "") * 1000, 2);
    cell(get(&one, "time.total", "", "") * 1000, 2);
    fputs(one.info.done ? "\n" : "  failed\n", stderr);
  }
  row("all");
  for (size_t i = 0; i < count; i++) cell(get(all, "time.", phases[i], "") * 1000, 2);
  cell(get(all, "time.total", "", "") * 1000, 2);
  fputc('\n', stderr);
  heads("memory, KB", phases, count, NULL);
  row("most held");
  for (size_t i = 0; i < count; i++) cell(get(all, "memory.", phases[i], ".peak") / 1024, 0);
  fputc('\n', stderr);
  row("grown by");
  for (size_t i = 0; i < count; i++) cell(get(all, "memory.", phases[i], ".growth") / 1024, 0);
  fputc('\n', stderr);
}

/* Prints a row for each key that begins with the prefix, with a column for each output. Such keys are the stages, and
 * the steps of meshing. */
static void parts(vs_scheme *s, const table *all, const char *title, const char *prefix) {
  char names[NAMES][KEY];
  size_t count = names_of(all, prefix, "", names);
  table one;
  fprintf(stderr, "%-22s", title);
  for (size_t k = 0; output_of(s, k, &one); k++) {
    size_t length = strlen(name_of(&one));
    fprintf(stderr, "%*s", WIDE, name_of(&one) + (length < WIDE ? 0 : length - WIDE + 1));
  }
  fprintf(stderr, "%*s\n", WIDE, "all");
  for (size_t i = 0; i < count; i++) {
    row(names[i]);
    for (size_t k = 0; output_of(s, k, &one); k++) cell(get(&one, prefix, names[i], "") * 1000, 2);
    cell(get(all, prefix, names[i], "") * 1000, 2);
    fputc('\n', stderr);
  }
}

static void drawings(vs_scheme *s) {
  static const char *const keys[] = { "nodes",          "nodes.distinct", "commands.before",
                                      "commands.after", "triangles",      "bytes" };
  static const char *const shown[] = { "nodes", "distinct", "commands", "optimised", "triangles", "bytes" };
  size_t count, columns = sizeof keys / sizeof *keys;
  const char *const *passes = vs_pass_list(&count);
  table one, last = { .count = 0 };
  fprintf(stderr, "%-22s", "drawing");
  for (size_t i = 0; i < columns; i++) fprintf(stderr, "%*s", WIDE, shown[i]);
  fputc('\n', stderr);
  for (size_t k = 0; output_of(s, k, &one); k++) {
    row(name_of(&one));
    for (size_t i = 0; i < columns; i++) cell(get(&one, keys[i], "", ""), 0);
    fputc('\n', stderr);
    last = one;
  }
  if (!last.count) return;
  fprintf(stderr, "%-22s%*s%*s%*s\n", "passes, commands", WIDE, "alone", WIDE, "without", WIDE, "rewrote");
  for (size_t i = 0; i < count; i++) {
    row(passes[i]);
    cell(get(&last, "commands.alone.", passes[i], ""), 0);
    cell(get(&last, "commands.without.", passes[i], ""), 0);
    cell(get(&last, "passes.", passes[i], ""), 0);
    fputc('\n', stderr);
  }
}

static void kept(const table *all) {
  char kinds[NAMES][KEY];
  size_t count = names_of(all, "cache.", ".hits", kinds);
  fprintf(stderr, "%-22s%*s%*s\n", "kept before", WIDE, "found", WIDE, "made");
  for (size_t i = 0; i < count; i++) {
    row(kinds[i]);
    cell(get(all, "cache.", kinds[i], ".hits"), 0);
    cell(get(all, "cache.", kinds[i], ".misses"), 0);
    fputc('\n', stderr);
  }
}

/* Returns true if the key appears in a table. */
static bool tabled(const char *key) {
  static const char *const prefixes[] = { "commands.", "passes.", "nodes", "time.", "triangles", "bytes" };
  size_t length = strlen(key);
  if (strncmp(key, "memory.", 7) == 0) return strchr(key + 7, '.') != NULL;
  if (strncmp(key, "cache.", 6) == 0) return strchr(key + 6, '.') != NULL;
  if (strcmp(key, "time.evaluate") == 0 || strcmp(key, "time.write") == 0) return false;
  for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; i++)
    if (length >= strlen(prefixes[i]) && strncmp(key, prefixes[i], strlen(prefixes[i])) == 0) return true;
  return false;
}

void cli_report_statistics(vs_scheme *s, bool json) {
  table all;
  all.count = vs_statistics(s, all.at, ROOM);
  if (all.count > ROOM) all.count = ROOM;
  if (json) {
    print_json(s, &all);
    return;
  }
  times(s, &all);
  parts(s, &all, "stages, ms", "time.stage.");
  parts(s, &all, "mesh, ms", "time.mesh.");
  drawings(s);
  kept(&all);
  fputs("besides\n", stderr);
  for (size_t i = 0; i < all.count; i++) {
    const vs_statistic *v = &all.at[i];
    if (tabled(v->key)) continue;
    if (strcmp(v->unit, "s") == 0) fprintf(stderr, "  %-20s%*.2f ms\n", v->key, WIDE, v->value * 1000);
    else fprintf(stderr, "  %-20s%*.0f %s\n", v->key, WIDE, v->value, v->unit);
  }
}
