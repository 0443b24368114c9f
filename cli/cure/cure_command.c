/* Finds values of parameters with which a model meets its rules, and prints them as a change of the source.
 *
 * Each round tries the values of each free parameter, from the lowest on, and keeps the change that breaks the fewest
 * rules; of equal ones that with the least shortfall, then the nearest. A real number that has met a rule then moves
 * back towards the present value by bisection, and is rounded. The rounds end when no rule is broken, or no change
 * helps. At the end each number that an earlier round has changed moves back as far as the later changes permit. */
#define _GNU_SOURCE
#include "cli/cure/cure_command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cure/broken_rules.h"
#include "cli/cure/source_edit.h"
#include "cli/usage/output_files.h"
#include "cli/usage/shell_words.h"
#include "model/store/array.h"

enum {
  ROUNDS = 3,  /* most parameters that are changed together */
  STEPS = 32,  /* values of a number that a round tries */
  HALVINGS = 10,
  VALUE = 64   /* room of the text of a value */
};

/* A parameter that may change. was: its value without a cure; value: its present one. */
typedef struct {
  vs_parameter_type type;
  char *name, was[VALUE], value[VALUE];
  char (*choices)[VALUE];
  size_t choice_count;
  double min, max, step;
  cure_place at;
  bool ranged, changed;
} slider;

/* The result of a run: broken rules, the sum of their shortfalls, and the distance of the tried value from the present
 * one. */
typedef struct { size_t broken; double shortfall, distance; } score;

typedef struct {
  cli_session *c;
  cure_write *write;
  slider *sliders;
  size_t count, room;
  vs_outcome outcome; /* of the last run */
  unsigned runs;
} cure;

static bool better(score a, score b) {
  if (a.broken != b.broken) return a.broken < b.broken;
  if (a.broken && a.shortfall != b.shortfall) return a.shortfall < b.shortfall;
  return a.distance < b.distance;
}

/* ---- runs of the model ---- */

/* Runs the model with the present values. Returns a score of SIZE_MAX broken rules if it fails. */
static score run(cure *u, bool muted) {
  cli_session *c = u->c;
  score worst = { SIZE_MAX, INFINITY, 0 };
  u->outcome = u->runs ? vs_restart(c->scheme) : VS_OUTCOME_DONE;
  for (size_t i = 0; u->outcome == VS_OUTCOME_DONE && i < u->count; i++) {
    const slider *p = &u->sliders[i];
    if (p->changed && !vs_parameter_set(c->scheme, p->name, p->value)) u->outcome = VS_OUTCOME_MACHINE;
    if (!p->changed && u->runs) vs_parameter_set(c->scheme, p->name, p->was);
  }
  if (u->outcome != VS_OUTCOME_DONE) return worst;
  c->muted = muted;
  cli_watch_begin(&c->watch, true);
  u->outcome = vs_eval_file(c->scheme, c->options->sources[0].text, VS_EVAL_CHECK_LATER);
  cli_watch_end(&c->watch);
  c->muted = false;
  u->runs++;
  if (u->outcome != VS_OUTCOME_DONE) return worst;
  cli_broken_rules broken = cli_rules_broken(c->scheme);
  return (score){ broken.count, broken.shortfall, 0 };
}

static bool going(const cure *u) { return u->outcome != VS_OUTCOME_INTERRUPTED && !*u->c->ended; }

static score try_value(cure *u, slider *p, const char *value) {
  char kept[VALUE];
  bool was_changed = p->changed;
  memcpy(kept, p->value, VALUE);
  snprintf(p->value, VALUE, "%s", value);
  p->changed = true;
  score s = run(u, true);
  s.distance = fabs(strtod(value, NULL) - strtod(kept, NULL)) / fmax(p->max - p->min, 1e-300);
  memcpy(p->value, kept, VALUE);
  p->changed = was_changed;
  return s;
}

/* ---- values of one parameter ---- */

/* Writes the number nearest to x that the parameter allows, with this many decimals. */
static void number_text(const slider *p, double x, int decimals, char out[VALUE]) {
  if (p->step > 0) x = p->min + p->step * round((x - p->min) / p->step);
  x = fmin(fmax(x, p->min), p->max);
  if (p->type == VS_PARAMETER_INTEGER) {
    snprintf(out, VALUE, "%.0f", x);
    return;
  }
  snprintf(out, VALUE, "%.*f", decimals, x);
  size_t n = strlen(out);
  while (n > 3 && out[n - 1] == '0' && out[n - 2] != '.') out[--n] = 0;
}

/* Returns the decimals that tell values a thousandth of the range apart. */
static int fine_decimals(const slider *p) {
  int d = (int)ceil(3 - log10(fmax(p->max - p->min, 1e-12)));
  return d < 1 ? 1 : d > 15 ? 15 : d;
}

typedef struct { score score; char value[VALUE]; } found;

static void consider(cure *u, slider *p, const char *value, found *best) {
  if (!going(u) || !strcmp(value, p->value) || !strcmp(value, best->value)) return;
  score s = try_value(u, p, value);
  if (s.broken == SIZE_MAX || !better(s, best->score)) return;
  best->score = s;
  snprintf(best->value, VALUE, "%s", value);
}

/* Moves a found number towards the value `from` while the score keeps its broken rules, and rounds it. */
static void refine(cure *u, slider *p, const char *from, found *best) {
  double good = strtod(best->value, NULL), bad = strtod(from, NULL);
  int fine = fine_decimals(p);
  char text[VALUE];
  for (int i = 0; i < HALVINGS && going(u); i++) {
    number_text(p, (good + bad) / 2, fine + 1, text);
    double middle = strtod(text, NULL);
    if (middle == good || middle == bad) break;
    if (try_value(u, p, text).broken <= best->score.broken) good = middle;
    else bad = middle;
  }
  for (int i = 0; i < 2 * (fine + 1) && going(u); i++) {
    const int decimals = 1 + i / 2;
    const double unit = pow(10, -decimals), low = floor(good / unit + 1e-6), high = ceil(good / unit - 1e-6);
    if (i % 2 && low == high) continue;
    number_text(p, ((good > bad) == (i % 2 == 0) ? low : high) * unit, decimals, text); /* the nearer one first */
    score s = try_value(u, p, text);
    if (s.broken > best->score.broken) continue;
    best->score = s;
    snprintf(best->value, VALUE, "%s", text);
    return;
  }
}

/* Returns the distance of neighbouring values that the parameter allows; 0 if any number is allowed. */
static double least_step(const slider *p) {
  return p->step > 0 ? p->step : p->type == VS_PARAMETER_INTEGER ? 1 : 0;
}

/* Tries values from low to high, each once. */
static void scan(cure *u, slider *p, double low, double high, found *best) {
  char text[VALUE], last[VALUE] = "";
  const double apart = fmax((high - low) / STEPS, least_step(p));
  const int steps = apart > 0 ? (int)ceil((high - low) / apart - 1e-9) : 0;
  for (int i = 0; i <= steps; i++) {
    number_text(p, low + (high - low) * i / fmax(steps, 1), fine_decimals(p), text);
    if (strcmp(text, last) != 0) consider(u, p, text, best);
    memcpy(last, text, VALUE);
  }
}

/* Returns true if values between those of a scan are allowed, and a number found by it may move between them. */
static bool refinable(const slider *p) { return p->ranged && least_step(p) == 0; }

/* Finds the best value of one parameter, if one is better than *best. A second scan, about the best value, also
 * finds values that meet the rules between two steps of the first. While as many rules are broken as before, the least
 * shortfall is best, however far the value is. */
static void search(cure *u, slider *p, found *best) {
  score before = best->score;
  for (size_t i = 0; i < p->choice_count; i++) consider(u, p, p->choices[i], best);
  if (p->type == VS_PARAMETER_BOOLEAN) consider(u, p, strcmp(p->value, "#t") ? "#t" : "#f", best);
  if (!p->ranged) return;
  const double step = (p->max - p->min) / STEPS;
  scan(u, p, p->min, p->max, best);
  if (*best->value && best->score.broken && step > least_step(p)) {
    double at = strtod(best->value, NULL);
    scan(u, p, fmax(p->min, at - step), fmin(p->max, at + step), best);
  }
  if (refinable(p) && best->score.broken < before.broken) refine(u, p, p->value, best);
}

/* ---- the parameters ---- */

static bool text_of(char out[VALUE], const char *value) {
  return snprintf(out, VALUE, "%s", value) < VALUE;
}

/* Stores a parameter that has a range, choices, or two values. Returns false when memory is out. */
static bool keep(cure *u, const vs_parameter_info *p) {
  bool number = p->type == VS_PARAMETER_INTEGER || p->type == VS_PARAMETER_REAL;
  slider s = { .type = p->type, .min = p->min, .max = p->max, .step = p->step,
               .ranged = number && p->has_range && !p->choices };
  if (!s.ranged && !p->choices && p->type != VS_PARAMETER_BOOLEAN) return true;
  if (!text_of(s.was, p->value) || !text_of(s.value, p->value)) return true;
  if (p->choices && !VS_FRESH(s.choices, p->choice_count)) return false;
  for (size_t i = 0; p->choices && i < p->choice_count; i++)
    if (text_of(s.choices[s.choice_count], p->choices[i])) s.choice_count++;
  s.name = strdup(p->name);
  bool ok = s.name && cure_place_keep(&s.at, &p->at) && VS_GROW(u->sliders, u->room, u->count + 1);
  if (ok) u->sliders[u->count++] = s;
  else cure_place_free(&s.at), free(s.name), free(s.choices);
  return ok;
}

static bool set_by_option(const cli_options *o, const char *name) {
  size_t n = strlen(name);
  for (size_t i = 0; i < o->define_count; i++)
    if (!strncmp(o->defines[i], name, n) && o->defines[i][n] == '=') return true;
  return false;
}

/* Stores the parameters that -D does not set. */
static bool take_parameters(cure *u) {
  vs_parameter_info p;
  for (size_t i = 0; i < vs_parameter_count(u->c->scheme); i++)
    if (vs_parameter_get(u->c->scheme, i, &p) && !set_by_option(u->c->options, p.name) && !keep(u, &p)) return false;
  return true;
}

static void free_cure(cure *u) {
  for (size_t i = 0; i < u->count; i++) {
    cure_place_free(&u->sliders[i].at);
    free(u->sliders[i].name), free(u->sliders[i].choices);
  }
  free(u->sliders);
}

/* ---- output ---- */

/* Prints the option -D with the three texts as one word of a shell. */
static void put_define(const char *name, const char *equals, const char *value) {
  char *word;
  if (asprintf(&word, "%s%s%s", name, equals, value) < 0) return;
  fputs(" -D ", stdout), cli_put_word(stdout, word);
  free(word);
}

static void print_changes(const cure *u, const char *file) {
  for (size_t i = 0; i < u->count; i++)
    if (u->sliders[i].changed)
      printf("  %s: from %s to %s\n", u->sliders[i].name, u->sliders[i].was, u->sliders[i].value);
  for (size_t i = 0; i < u->count; i++)
    if (u->sliders[i].changed) cure_print_edit(&u->sliders[i].at, u->sliders[i].name, u->sliders[i].value);
  fputs("vs ", stdout), cli_put_word(stdout, file);
  for (size_t i = 0; i < u->c->options->define_count; i++) put_define(u->c->options->defines[i], "", "");
  for (size_t i = 0; i < u->count; i++)
    if (u->sliders[i].changed) put_define(u->sliders[i].name, "=", u->sliders[i].value);
  putchar('\n');
}

/* Writes the outputs of -o, with `which` before the suffix of each file. */
static vs_outcome write_outputs(const cure *u, const char *which) {
  cli_session *c = u->c;
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t i = 0; i < c->options->target_count && outcome == VS_OUTCOME_DONE; i++) {
    const cli_target *t = &c->options->targets[i];
    char path[CLI_PATH_ROOM];
    if (!cli_path_with(t->path, which, path)) return VS_OUTCOME_USAGE;
    outcome = u->write(c, &(cli_target){ path, t->format });
  }
  return outcome;
}

/* Returns VS_OUTCOME_USAGE, after a message, if the model reads a file that an output would replace. */
static vs_outcome may_write(const cure *u) {
  const cli_options *o = u->c->options;
  for (size_t i = 0; i < 2 * o->target_count; i++) {
    char path[CLI_PATH_ROOM];
    if (!cli_path_with(o->targets[i / 2].path, i % 2 ? "after" : "before", path)) return VS_OUTCOME_USAGE;
    if (!vs_is_input(u->c->scheme, path)) continue;
    fprintf(stderr, "vs cure: %s: the model reads this file, and no output may replace it; name another file by -o\n",
            path);
    return VS_OUTCOME_USAGE;
  }
  return VS_OUTCOME_DONE;
}

/* Finds the best change of a single parameter and makes it. Returns its score, or `now` if no change helps. */
static score improve(cure *u, score now) {
  slider *chosen = NULL;
  found best = { now, "" };
  bool first = true; /* whether no parameter has changed yet, so that one alone is a cure */
  for (size_t i = 0; i < u->count; i++) first &= !u->sliders[i].changed;
  for (size_t i = 0; i < u->count && going(u); i++) {
    found own = { now, "" };
    slider *p = &u->sliders[i];
    search(u, p, &own);
    if (!*own.value) continue;
    if (now.broken == own.score.broken && own.score.shortfall >= now.shortfall) continue;
    if (own.score.broken == 0 && first)
      printf("%s cures %s: from %s to %s\n", p->name, now.broken == 1 ? "the rule" : "all rules", p->value, own.value);
    if (!chosen || better(own.score, best.score)) best = own, chosen = p;
  }
  if (!chosen) return now;
  memcpy(chosen->value, best.value, VALUE);
  chosen->changed = true;
  return best.score;
}

/* Moves each changed number back towards its value without a cure, as far as all rules stay met. */
static void tighten(cure *u, score now) {
  for (size_t i = 0; i < u->count && going(u); i++) {
    slider *p = &u->sliders[i];
    if (!p->changed || !refinable(p)) continue;
    found best = { now, "" };
    memcpy(best.value, p->value, VALUE);
    refine(u, p, p->was, &best);
    memcpy(p->value, best.value, VALUE);
  }
}

static vs_outcome find_cure(cure *u, score first) {
  const char *file = u->c->options->sources[0].text;
  score now = first;
  int rounds = 0;
  while (rounds < ROUNDS && now.broken && going(u)) {
    score next = improve(u, now);
    if (next.broken == now.broken && next.shortfall >= now.shortfall) break;
    now = next;
    rounds++;
  }
  if (!now.broken && rounds > 1) tighten(u, now);
  if (!going(u)) return VS_OUTCOME_INTERRUPTED;
  if (now.broken) {
    printf("%s: none of the tried values of its parameters meets all rules; the best values break %zu\n", file,
           now.broken);
    return VS_OUTCOME_MODEL;
  }
  printf("%s: %u runs; the nearest cure:\n", file, u->runs);
  print_changes(u, file);
  run(u, true);
  return u->outcome == VS_OUTCOME_DONE ? write_outputs(u, "after") : u->outcome;
}

vs_outcome cli_cure(cli_session *c, cure_write *write) {
  cure u = { .c = c, .write = write };
  vs_rule_info r;
  c->watch.name = c->options->sources[0].text;
  score first = run(&u, false);
  vs_outcome outcome = u.outcome;
  if (outcome == VS_OUTCOME_DONE && !vs_rule_get(c->scheme, 0, &r)) {
    fprintf(stderr, "vs cure: %s has no rules; (require-that \"name\" condition) makes one\n", c->watch.name);
    outcome = VS_OUTCOME_USAGE;
  } else if (outcome == VS_OUTCOME_DONE && !first.broken) {
    printf("%s: all rules are met\n", c->watch.name);
  } else if (outcome == VS_OUTCOME_DONE) {
    outcome = may_write(&u);
    if (outcome == VS_OUTCOME_DONE && !take_parameters(&u)) outcome = VS_OUTCOME_MACHINE;
    if (outcome == VS_OUTCOME_DONE) outcome = write_outputs(&u, "before");
    if (outcome == VS_OUTCOME_DONE) outcome = find_cure(&u, first);
  }
  free_cure(&u);
  return outcome;
}
