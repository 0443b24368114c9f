/* Prints the results of `vs fit`: parameters with their intervals, the place of the scan, distances and their
 * histogram. */
#include "cli/fit/fit_command.h"

#include <math.h>
#include <string.h>

#include "cli/json.h"

enum { BINS = 16, BAR = 40 };
#define REACH 4. /* half the width of the histogram of distances, in multiples of their spread */

typedef struct {
  double edge[BINS + 1];
  size_t count[BINS], below, above;
} histogram;

/* The names of the states of a parameter: `word` in JSON, `remark` at the end of its line. */
static const struct {
  const char *word, *remark;
} states[] = { [VS_FIT_FITTED] = { "fitted", "" },
               [VS_FIT_HELD] = { "held", "held" },
               [VS_FIT_NO_NUMBER] = { "no number", "not fitted: its default is no inexact number" },
               [VS_FIT_AT_BOUND] = { "at bound", "at its bound" },
               [VS_FIT_UNDETERMINED] = { "undetermined", "not determined by the scan" } };

static void fill(histogram *h, const vs_scheme *s, double spread) {
  size_t n;
  const double *d = vs_fit_distances(s, &n);
  double reach = spread > 0 ? REACH * spread : 1e-9;
  *h = (histogram){ .below = 0 };
  for (int i = 0; i <= BINS; i++) h->edge[i] = reach * (2. * i / BINS - 1);
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(d[i])) continue;
    if (d[i] < -reach)
      h->below++;
    else if (d[i] >= reach)
      h->above++;
    else {
      int bin = (int)((d[i] + reach) / (2 * reach) * BINS);
      h->count[bin < BINS ? bin : BINS - 1]++;
    }
  }
}

/* Sets axis to the unit axis of a rotation, and returns its angle in degrees. */
static double turn_of(const vs_fit_result *r, double axis[3]) {
  const double(*m)[4] = r->place;
  double s[3] = { m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1] };
  double sine = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / 2, cosine = (m[0][0] + m[1][1] + m[2][2] - 1) / 2;
  if (sine > 1e-6) {
    for (int i = 0; i < 3; i++) axis[i] = s[i] / (2 * sine);
  } else { /* for an angle of 0 or 180 degrees: the axis is the longest column of the matrix plus the unit matrix */
    int k = 0;
    for (int i = 1; i < 3; i++)
      if (m[i][i] > m[k][k]) k = i;
    double length = 0;
    for (int i = 0; i < 3; i++) axis[i] = (m[i][k] + (i == k)), length += axis[i] * axis[i];
    for (int i = 0; i < 3; i++) axis[i] = length > 0 ? axis[i] / sqrt(length) : i == 2;
  }
  return atan2(sine, cosine) * 180 / acos(-1);
}

static void print_bar(const char *left, const char *right, size_t count, size_t most) {
  int width = most ? (int)lrint((double)count / (double)most * BAR) : 0;
  printf("  %10s %-10s %8zu %.*s\n", left, right, count, width, "########################################");
}

static void print_histogram(const histogram *h) {
  size_t most = h->below > h->above ? h->below : h->above;
  char left[32], right[32];
  for (int i = 0; i < BINS; i++) most = h->count[i] > most ? h->count[i] : most;
  snprintf(left, sizeof left, "%.3g", h->edge[0]);
  print_bar("below", left, h->below, most);
  for (int i = 0; i < BINS; i++) {
    snprintf(left, sizeof left, "%.3g", h->edge[i] + 0.);
    snprintf(right, sizeof right, "%.3g", h->edge[i + 1] + 0.);
    print_bar(left, right, h->count[i], most);
  }
  snprintf(right, sizeof right, "%.3g", h->edge[BINS]);
  print_bar("above", right, h->above, most);
}

/* Writes the parameter's value with two digits more than its uncertainty justifies. */
static void value_text(char text[40], const vs_fit_parameter *p) {
  int digits = 9;
  if (p->error > 0 && isfinite(p->error) && p->value != 0) digits = (int)ceil(log10(fabs(p->value) / p->error)) + 2;
  snprintf(text, 40, "%.*g", digits < 4 ? 4 : digits > 12 ? 12 : digits, p->value);
}

static void print_parameters(cli_session *c, const vs_fit_options *o) {
  vs_fit_parameter p;
  int wide = 4;
  bool any = false;
  for (size_t i = 0; vs_fit_parameter_get(c->scheme, i, &p); i++)
    wide = (int)strlen(p.name) > wide ? (int)strlen(p.name) : wide;
  for (size_t i = 0; vs_fit_parameter_get(c->scheme, i, &p); i++) {
    char value[40];
    value_text(value, &p);
    bool known = p.state == VS_FIT_FITTED || p.state == VS_FIT_AT_BOUND;
    printf("  %-*s ", wide, p.name);
    if (p.state == VS_FIT_NO_NUMBER) {
      printf("%s\n", states[p.state].remark);
      continue;
    }
    printf("%-12s", value);
    if (known && isfinite(p.error)) printf(" +- %-9.2g", p.high - p.value), any = true;
    if (p.state != VS_FIT_HELD) printf(" from %.6g", p.start);
    printf("%s%s\n", *states[p.state].remark ? p.state == VS_FIT_HELD ? " " : "; " : "", states[p.state].remark);
  }
  if (any) printf("  (+-: %.4g %% intervals, by Huber's covariance of an M-estimate)\n", 100 * o->confidence);
}

/* Prints the command by which vs draws the model with the fitted values. */
static void print_call(cli_session *c) {
  vs_fit_parameter p;
  printf("vs %s", c->options->sources[0].text);
  for (size_t i = 0; vs_fit_parameter_get(c->scheme, i, &p); i++) {
    char value[40];
    if (p.state == VS_FIT_NO_NUMBER || (p.state == VS_FIT_HELD && p.value == p.start)) continue;
    value_text(value, &p);
    printf(" -D %s=%s", p.name, value);
  }
  putchar('\n');
}

static void print_text(cli_session *c, const vs_fit_result *r, const vs_fit_options *o, const histogram *h) {
  double axis[3], turn = turn_of(r, axis);
  printf("%s: %zu points, %zu used, %u runs of the model\n", c->options->sources[1].text, r->points - r->nowhere,
         r->used, r->runs);
  puts("parameters:");
  print_parameters(c, o);
  if (!o->placed)
    printf("place of the model in the scan: turned by %.4g degrees about (%.4g %.4g %.4g), then moved by (%.6g %.6g "
           "%.6g)\n",
           turn, axis[0] + 0., axis[1] + 0., axis[2] + 0., r->place[0][3] + 0., r->place[1][3] + 0.,
           r->place[2][3] + 0.);
  printf("distances: median %.3g %s, spread %.3g, root mean square %.3g; %zu of %zu (%.2g %%) are outliers\n",
         r->median, r->units, r->spread, r->root_mean_square, r->outliers, r->samples,
         100. * (double)r->outliers / (double)r->samples);
  print_histogram(h);
  print_call(c);
}

static void json_number(const char *name, double v) {
  printf(", \"%s\": ", name);
  cli_json_number(stdout, v);
}

static void print_json(cli_session *c, const vs_fit_result *r, const vs_fit_options *o, const histogram *h,
                       vs_outcome outcome) {
  vs_fit_parameter p;
  printf("{\n  \"schema\": 1,\n  \"fits\": %s, \"doubt\": \"%s\", \"converged\": %s, \"stopped\": %s,\n"
         "  \"parameters\": [",
         outcome == VS_OUTCOME_DONE ? "true" : "false", r->doubt, r->converged ? "true" : "false",
         outcome == VS_OUTCOME_INTERRUPTED || outcome == VS_OUTCOME_MACHINE ? "true" : "false");
  for (size_t i = 0; vs_fit_parameter_get(c->scheme, i, &p); i++) {
    printf("%s\n    {\"name\": ", i ? "," : "");
    cli_json_text(stdout, p.name);
    printf(", \"state\": \"%s\"", states[p.state].word);
    if (p.state != VS_FIT_NO_NUMBER) {
      json_number("start", p.start);
      json_number("value", p.value);
      json_number("error", p.error);
      json_number("low", p.low);
      json_number("high", p.high);
    }
    putchar('}');
  }
  printf("\n  ],\n  \"confidence\": ");
  cli_json_number(stdout, o->confidence);
  printf(",\n  \"place\": [");
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 4; k++) {
      fputs(k ? ", " : i ? "], [" : "[", stdout);
      cli_json_number(stdout, r->place[i][k] + 0.);
    }
  printf("]],\n  \"scan\": {\"points\": %zu, \"nowhere\": %zu, \"samples\": %zu, \"used\": %zu, \"outliers\": %zu",
         r->points, r->nowhere, r->samples, r->used, r->outliers);
  json_number("size", r->size);
  printf("},\n  \"distances\": {\"median\": ");
  cli_json_number(stdout, r->median);
  json_number("spread", r->spread);
  json_number("root_mean_square", r->root_mean_square);
  json_number("correlation", r->correlation);
  printf(", \"units\": ");
  cli_json_text(stdout, r->units);
  printf("},\n  \"histogram\": {\"from\": ");
  cli_json_number(stdout, h->edge[0]);
  json_number("to", h->edge[BINS]);
  printf(", \"below\": %zu, \"above\": %zu, \"counts\": [", h->below, h->above);
  for (int i = 0; i < BINS; i++) printf("%s%zu", i ? ", " : "", h->count[i]);
  printf("]},\n  \"iterations\": %u, \"runs\": %u\n}\n", r->iterations, r->runs);
}

vs_outcome cli_fit(cli_session *c) {
  const cli_options *o = c->options;
  vs_fit_options options = vs_fit_options_default();
  vs_fit_result result;
  histogram h;
  options.placed = o->placed, options.near = o->near, options.any_pose = o->any_pose;
  options.held = o->held, options.held_count = o->held_count;
  if (o->points) options.points = o->points;
  c->watch.name = o->sources[0].text;
  cli_watch_begin(&c->watch, false);
  vs_outcome outcome = vs_fit(c->scheme, o->sources[0].text, o->sources[1].text, &options, &result);
  cli_watch_end(&c->watch);
  cli_report_settle(&c->reporter);
  if (!result.samples) return outcome;
  fill(&h, c->scheme, result.spread);
  if (o->json)
    print_json(c, &result, &options, &h, outcome);
  else
    print_text(c, &result, &options, &h);
  for (size_t i = 0; i < o->target_count; i++) {
    double range;
    vs_outcome one = vs_fit_map(c->scheme, o->targets[i].path, 0, &range);
    if (one == VS_OUTCOME_DONE && !o->quiet)
      fprintf(stderr, "%s: distances from blue at %.3g %s (inside the model) over grey at 0 to red at %.3g\n",
              o->targets[i].path, -range, result.units, range);
    if (outcome == VS_OUTCOME_DONE) outcome = one;
  }
  return outcome;
}
