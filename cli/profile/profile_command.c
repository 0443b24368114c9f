/* Implements `vs profile FILE`: the time, the memory and the count of each line of a program. */
#include "cli/profile/profile_command.h"

#include <errno.h>
#include <string.h>

#include "cli/batch/whole_file.h"
#include "cli/json.h"
#include "cli/profile/coverage_report.h"
#include "cli/profile/flame_graph.h"

enum { MOST_LINES = 30, TEXT = 60 };
static const double LEAST_SHARE = 0.002; /* smallest share of the total time with which a line is listed in the table */

static void print_table(const profile_tree *t) {
  printf("    own  total    memory  line\n");
  for (size_t i = 0; i < t->line_count && i < MOST_LINES; i++) {
    const profile_line *l = &t->lines[i];
    char text[TEXT + 1], place[80];
    if (l->own < LEAST_SHARE * t->seconds && i) break;
    profile_line_text(l->file, l->line, 1, text, sizeof text);
    snprintf(place, sizeof place, "%.60s:%u", l->file, (unsigned)l->line);
    printf("%5.1f %% %4.0f %% %6.1f MB  %-20s  %s\n", 100 * l->own / t->seconds, 100 * l->whole / t->seconds,
           l->bytes / 1048576, place, text);
  }
  printf("%.3g s, %.1f MB, %zu samples; own: the line itself, total: with the calls that it makes\n", t->seconds,
         t->bytes / 1048576, t->looks);
}

static void print_place(const char *file, uint32_t line) {
  fputs("\"file\":", stdout);
  cli_json_text(stdout, file ? file : "");
  printf(",\"line\":%u", (unsigned)line);
}

static void print_measure(const char *key, double value) {
  printf(",\"%s\":", key);
  cli_json_number(stdout, value);
}

static void print_json(const profile_tree *t, const coverage *forms) {
  printf("{\"schema\":1,\"samples\":%zu", t->looks);
  print_measure("seconds", t->seconds);
  print_measure("bytes", t->bytes);
  fputs(",\"lines\":[", stdout);
  for (size_t i = 0; i < t->line_count; i++) {
    const profile_line *l = &t->lines[i];
    fputs(i ? ",\n{" : "\n{", stdout);
    print_place(l->file, l->line);
    print_measure("own", l->own);
    print_measure("total", l->whole);
    print_measure("bytes", l->bytes);
    fputc('}', stdout);
  }
  fputs("],\"calls\":[", stdout);
  for (size_t i = 0; i < t->count; i++) {
    const vs_profile_call_info *c = &t->calls[i];
    printf("%s\n{\"caller\":%zu,\"procedure\":", i ? "," : "", c->caller);
    cli_json_text(stdout, c->procedure);
    fputc(',', stdout);
    print_place(c->at.file, c->at.line);
    print_measure("own", c->seconds);
    print_measure("total", t->whole[i]);
    fputc('}', stdout);
  }
  fputc(']', stdout);
  if (forms) {
    fputs(",\"forms\":", stdout);
    coverage_print_json(forms, stdout);
  }
  puts("}");
}

/* Writes the file, which appears only when it is complete. */
static vs_outcome write_flames(const profile_tree *t, const cli_session *c) {
  const char *path = c->options->targets[0].path, *title = c->options->sources[0].text;
  cli_whole_file file;
  if (!strcmp(path, "-")) return profile_write_flames(t, title, stdout) ? VS_OUTCOME_DONE : VS_OUTCOME_MACHINE;
  FILE *to = cli_whole_begin(&file, path);
  if (cli_whole_end(&file, to && profile_write_flames(t, title, to))) return VS_OUTCOME_DONE;
  fprintf(stderr, "vs profile: %s: %s\n", path, strerror(errno));
  return VS_OUTCOME_USAGE;
}

void cli_profile_begin(cli_session *c) {
  vs_profile(c->scheme, true);
  if (c->options->coverage) vs_coverage(c->scheme, true);
}

vs_outcome cli_profile(cli_session *c, bool whole) {
  const cli_options *o = c->options;
  profile_tree t;
  coverage forms;
  vs_profile(c->scheme, false);
  vs_outcome outcome = VS_OUTCOME_DONE;
  bool read = coverage_read(&forms, c->scheme);
  if (!profile_tree_read(&t, c->scheme) || !read) {
    fputs("vs: out of memory\n", stderr);
    outcome = VS_OUTCOME_MACHINE;
  } else if (o->target_count && vs_is_input(c->scheme, o->targets[0].path)) {
    fprintf(stderr, "vs profile: %s: it was read by this run; -o names another file\n", o->targets[0].path);
    outcome = VS_OUTCOME_USAGE;
  } else {
    if (o->target_count) outcome = write_flames(&t, c);
    if (o->json) print_json(&t, o->coverage ? &forms : NULL);
    else if (o->to_stdout) {}
    else if (o->coverage) coverage_print(&forms, whole, stdout);
    else if (!t.looks) puts("no sample fell into the program: its run is too short");
    else print_table(&t);
  }
  profile_tree_free(&t);
  coverage_free(&forms);
  return outcome;
}
