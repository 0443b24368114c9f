/* Implements `vs diff A B`: prints the differences of two models, as lines or as JSON. */
#include "cli/difference.h"

#include <stdlib.h>
#include <string.h>

#include "cli/json.h"
#include "cli/main.h"
#include "cli/usage/output_files.h"

/* ---- data about the first model, kept while the second model runs ---- */

typedef struct { const char *name, *value, *range; /* permitted values: "0 to 10 by 1", "a b c" or "" */ } parameter;
typedef struct {
  char *parameters; size_t parameter_bytes; /* name, value and range of each parameter, each ending in NUL */
  char *unused; size_t unused_bytes;        /* names of options -D that the model did not use, each ending in NUL */
  vs_summary summary;                       /* summary of the drawing, without the members units and advice */
} model;

/* Writes the range of the parameter. Omits a limit that the program does not set, which is computed from the default
 * value. */
static void put_range(FILE *to, const vs_parameter_info *p) {
  if (p->has_range) {
    if (p->has_min && p->has_max) fprintf(to, "%.15g to %.15g", p->min, p->max);
    else if (p->has_min) fprintf(to, "%.15g and more", p->min);
    else if (p->has_max) fprintf(to, "to %.15g", p->max);
    if (p->step > 0) fprintf(to, "%sby %.15g", p->has_min || p->has_max ? " " : "", p->step);
  }
  for (size_t i = 0; i < p->choice_count; i++) fprintf(to, "%s%s", i ? " " : "", p->choices[i]);
  fputc(0, to);
}

static void put_text(FILE *to, const char *text) { fwrite(text, 1, strlen(text) + 1, to); }

/* Copies the data about the model that has run. Returns false when memory is out. */
static bool model_take(model *m, vs_scheme *s) {
  vs_parameter_info p;
  const char *name;
  FILE *parameters = open_memstream(&m->parameters, &m->parameter_bytes);
  FILE *unused = open_memstream(&m->unused, &m->unused_bytes);
  for (size_t i = 0; parameters && vs_parameter_get(s, i, &p); i++) {
    put_text(parameters, p.name);
    put_text(parameters, p.value);
    put_range(parameters, &p);
  }
  for (size_t i = 0; unused && (name = vs_parameter_unused(s, i)) != NULL; i++) put_text(unused, name);
  bool ok = parameters && fclose(parameters) == 0;
  return unused && fclose(unused) == 0 && ok;
}

static void model_free(model *m) {
  free(m->parameters);
  free(m->unused);
}

/* Returns the text that follows this text, after its NUL. */
static const char *next_text(const char *text) { return text + strlen(text) + 1; }

/* Sets *out to the parameter whose texts begin at *at, and moves *at past them. Returns false if there are no more. */
static bool next_parameter(const model *m, const char **at, parameter *out) {
  if (!*at) *at = m->parameters;
  if ((size_t)(*at - m->parameters) >= m->parameter_bytes) return false;
  out->name = *at;
  out->value = next_text(out->name);
  out->range = next_text(out->value);
  *at = next_text(out->range);
  return true;
}

static bool parameter_named(const model *m, const char *name, parameter *out) {
  for (const char *at = NULL; next_parameter(m, &at, out);)
    if (!strcmp(out->name, name)) return true;
  return false;
}

/* ---- the report of the differences ---- */

enum { LISTED = 40 /* LISTED: greatest number of parts that the printed lines name; JSON lists all parts */ };
typedef struct {
  bool json, any;       /* json: whether the report is JSON; any: whether it contains a parameter */
  bool begun;           /* whether the text that precedes the parts was already written */
  const model *before, *after;
  vs_comparison found;
  const char *gap;      /* text to write before the next item of a JSON list: a comma, or nothing before the first
                         * item */
  size_t told, passed;  /* told: number of parts that the report names; passed: number of parts that it omits */
} report;

static const char *const words[] = {
    [VS_PART_WAS_ADDED] = "added", [VS_PART_WAS_REMOVED] = "removed", [VS_PART_WAS_CHANGED] = "changed",
    [VS_PART_WAS_MOVED] = "moved", [VS_PART_WAS_REPAINTED] = "repainted"};

static void json_member(const char *before, const char *name, const char *text) {
  printf("%s\"%s\": ", before, name);
  cli_json_text(stdout, text);
}

/* Writes how a parameter has changed. old or new is NULL if only one model has the parameter. */
static void tell_parameter(report *r, const parameter *old, const parameter *new) {
  bool value = !old || !new || strcmp(old->value, new->value) != 0;
  bool range = old && new && strcmp(old->range, new->range) != 0;
  const char *word = !old ? "added" : !new ? "removed" : "changed";
  if (!value && !range) return;
  if (r->json) {
    printf("%s\n    {\"change\": \"%s\"", r->gap, word);
    json_member(", ", "name", (new ? new : old)->name);
    if (old) json_member(", ", "before", old->value), json_member(", ", "range_before", old->range);
    if (new) json_member(", ", "after", new->value), json_member(", ", "range_after", new->range);
    putchar('}');
  } else {
    if (!r->any) puts("parameters:");
    printf("  %-9s %s", word, (new ? new : old)->name);
    if (value) printf(": %s%s%s", old ? old->value : "", old && new ? " -> " : "", new ? new->value : "");
    if (range) printf("%s %s -> %s", value ? "; range" : ": range",
                      *old->range ? old->range : "any", *new->range ? new->range : "any");
    putchar('\n');
  }
  r->gap = ",";
  r->any = true;
}

static void tell_parameters(report *r, const model *a, const model *b) {
  parameter p, other;
  for (const char *at = NULL; next_parameter(a, &at, &p);)
    tell_parameter(r, &p, parameter_named(b, p.name, &other) ? &other : NULL);
  for (const char *at = NULL; next_parameter(b, &at, &p);)
    if (!parameter_named(a, p.name, &other)) tell_parameter(r, NULL, &p);
}

static void json_part(const char *name, const vs_part_info *p) {
  printf(", \"%s\": {", name);
  json_member("", "text", p->text);
  json_member(", ", "layer", p->layer);
  json_member(", ", "material", p->material);
  if (p->at.file) {
    json_member(", ", "file", p->at.file);
    printf(", \"line\": %u, \"column\": %u", (unsigned)p->at.line, (unsigned)p->at.column);
  }
  putchar('}');
}

static void print_place(const vs_part_info *p) {
  if (p->at.file) printf("%s:%u:%u: ", p->at.file, (unsigned)p->at.line, (unsigned)p->at.column);
}

static void print_counts(const vs_comparison *found) {
  const struct { size_t count; const char *word; } counts[] = {
      {found->same, "the same"}, {found->repainted, "repainted"}, {found->moved, "moved"},
      {found->changed, "changed"}, {found->added, "added"}, {found->removed, "removed"}};
  bool any = false;
  for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
    if (!counts[i].count) continue;
    printf("%s%zu %s", any ? ", " : "parts: ", counts[i].count, counts[i].word);
    any = true;
  }
  puts(any ? "" : "parts: none");
}

/* Writes the text before the parts. Called only when the comparison of the parts has succeeded. */
static void begin(report *r) {
  const vs_comparison *f = &r->found;
  if (r->begun) return;
  r->begun = true;
  if (r->json) fputs("{\n  \"schema\": 1,\n  \"parameters\": [", stdout);
  tell_parameters(r, r->before, r->after);
  if (r->json) printf("%s],\n  \"parts\": [", r->any ? "\n  " : "");
  else if (f->repainted + f->moved + f->changed + f->added + f->removed) print_counts(f);
  r->gap = "";
}

void cli_difference_print(vs_part_difference what, const vs_part_info *before, const vs_part_info *after) {
  const vs_part_info *p = after ? after : before;
  printf("  %-9s ", words[what]);
  print_place(p);
  const char *layer = *p->layer ? p->layer : NULL;
  if (what == VS_PART_WAS_REPAINTED) {
    const char *old = strcmp(before->layer, after->layer) ? before->layer : before->material;
    const char *new = strcmp(before->layer, after->layer) ? after->layer : after->material;
    printf("%s: %s -> %s", p->text, *old ? old : "none", *new ? new : "none");
    layer = NULL;
  } else if (before && after) printf("%s -> %s", before->text, after->text);
  else fputs(p->text, stdout);
  if (layer) printf(", layer %s", layer);
  putchar('\n');
}

static bool tell_part(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after) {
  report *r = context;
  begin(r);
  if (r->json) {
    printf("%s\n    {\"change\": \"%s\"", r->gap, words[what]);
    if (before) json_part("before", before);
    if (after) json_part("after", after);
    putchar('}');
    r->gap = ",";
    return true;
  }
  if (r->told == LISTED) return r->passed++, true;
  r->told++;
  cli_difference_print(what, before, after);
  return true;
}

static void json_triple(const char *name, const double *p) {
  printf("\"%s\": [", name);
  for (int i = 0; i < 3; i++) {
    if (i) fputs(", ", stdout);
    cli_json_number(stdout, p[i] + 0.0);
  }
  putchar(']');
}

static void json_bounds(const char *name, const vs_summary *s) {
  printf(",\n  \"%s\": ", name);
  if (!s->has_bounds) {
    fputs("null", stdout);
    return;
  }
  putchar('{');
  json_triple("min", s->min);
  fputs(", ", stdout);
  json_triple("max", s->max);
  putchar('}');
}

static void json_volume(const char *before, const char *name, double v) {
  printf("%s\"%s\": ", before, name);
  cli_json_number(stdout, v);
}

static void print_box(const vs_summary *s) {
  if (!s->has_bounds) fputs("none", stdout);
  else printf("(%.6g %.6g %.6g) (%.6g %.6g %.6g)", s->min[0] + 0.0, s->min[1] + 0.0, s->min[2] + 0.0, s->max[0] + 0.0,
              s->max[1] + 0.0, s->max[2] + 0.0);
}

/* Returns true if a and b are equal except for rounding errors, which depend on the order of summation. */
static bool near(double a, double b) {
  double size = a < 0 ? -a : a, off = a < b ? b - a : a - b;
  return off <= 1e-12 * size || off <= 1e-300;
}

static bool same_bounds(const vs_summary *a, const vs_summary *b) {
  if (a->has_bounds != b->has_bounds) return false;
  for (int i = 0; a->has_bounds && i < 3; i++)
    if (!near(a->min[i], b->min[i]) || !near(a->max[i], b->max[i])) return false;
  return true;
}

/* Writes the rest of the report, which follows the list of parts. */
static void finish(report *r, bool parts, bool bounds, bool same) {
  const vs_comparison *f = &r->found;
  if (!r->json) {
    if (r->passed) printf("  and %zu more; --json names all\n", r->passed);
    if (parts) printf("volume: %.9g -> %.9g: %.9g added, %.9g removed\n", f->volume_before, f->volume_after,
                      f->volume_added, f->volume_removed);
    if (bounds) fputs("bounds: ", stdout), print_box(&r->before->summary), fputs(" -> ", stdout),
        print_box(&r->after->summary), putchar('\n');
    if (same) puts("no difference");
    return;
  }
  printf("%s],\n  \"counts\": {\"same\": %zu, \"repainted\": %zu, \"moved\": %zu, \"changed\": %zu, "
         "\"added\": %zu, \"removed\": %zu},\n  \"volume\": {", parts ? "\n  " : "", f->same, f->repainted,
         f->moved, f->changed, f->added, f->removed);
  json_volume("", "before", f->volume_before);
  json_volume(", ", "after", f->volume_after);
  json_volume(", ", "added", f->volume_added);
  json_volume(", ", "removed", f->volume_removed);
  putchar('}');
  json_bounds("bounds_before", &r->before->summary);
  json_bounds("bounds_after", &r->after->summary);
  printf(",\n  \"same\": %s\n}\n", same ? "true" : "false");
}

/* Compares the second model, which has just run, with the first, and writes the report. Sets *same to true if there is
 * no difference. */
static vs_outcome tell(cli_session *c, const model *before, const model *after, bool *same) {
  report r = {.json = c->options->json, .gap = "", .before = before, .after = after};
  vs_outcome outcome = vs_drawing_compare(c->scheme, &r.found, tell_part, &r);
  if (outcome != VS_OUTCOME_DONE) return outcome;
  begin(&r);
  const vs_comparison *f = &r.found;
  bool parts = f->repainted + f->moved + f->changed + f->added + f->removed > 0;
  bool bounds = !same_bounds(&before->summary, &after->summary);
  *same = !r.any && !parts && !bounds;
  finish(&r, parts, bounds, *same);
  return outcome;
}

/* Returns true unless a name of -D is a parameter of neither model. Reports such a name as a mistake of the command
 * line. */
static bool all_used(const model *a, const model *b) {
  for (const char *i = a->unused; i < a->unused + a->unused_bytes; i = next_text(i))
    for (const char *k = b->unused; k < b->unused + b->unused_bytes; k = next_text(k))
      if (!strcmp(i, k)) {
        fprintf(stderr, "vs: -D %s: neither model has such a parameter\n", i);
        return false;
      }
  return true;
}

/* Runs the model that is number `which` on the command line, and copies its data to m. */
static vs_outcome run(cli_session *c, size_t which, model *m) {
  free(c->model);
  c->model = strdup(c->options->sources[which].text);
  if (!c->model) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  vs_outcome outcome = cli_session_run(c);
  if (outcome == VS_OUTCOME_DONE) outcome = vs_drawing_summary(c->scheme, &m->summary);
  if (outcome != VS_OUTCOME_DONE || model_take(m, c->scheme)) return outcome;
  return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
}

vs_outcome cli_difference(cli_session *c) {
  model before = {0}, after = {0};
  bool same = true, quiet = c->options->quiet;
  c->options->quiet = true; /* the command prints only differences, not a summary of each model */
  vs_outcome outcome = run(c, 0, &before);
  if (outcome == VS_OUTCOME_DONE) outcome = vs_drawing_keep(c->scheme);
  if (outcome == VS_OUTCOME_DONE) outcome = run(c, 1, &after);
  if (outcome == VS_OUTCOME_DONE && !all_used(&before, &after)) outcome = VS_OUTCOME_USAGE;
  if (outcome == VS_OUTCOME_DONE && !cli_options_late(c->options, c->scheme)) outcome = VS_OUTCOME_USAGE;
  if (outcome == VS_OUTCOME_DONE) outcome = tell(c, &before, &after, &same);
  c->options->quiet = quiet;
  c->options->output.change = true;
  c->exit_code = same ? 0 : 1;
  model_free(&before);
  model_free(&after);
  return outcome;
}
