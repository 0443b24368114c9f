/* Reads the arguments and prints the results of `vs sunstudy`. vs_sun_study of the library computes them. */
#include "cli/light/sun_command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool bad(const char *option, const char *value, const char *wanted) {
  if (value) fprintf(stderr, "vs sunstudy: %s %s: expected %s\n", option, value, wanted);
  else fprintf(stderr, "vs sunstudy: %s is missing: %s\n", option, wanted);
  return false;
}

/* Reads a number of hours: "8", "8.5" or "8:30". Returns false for other texts. */
static bool read_hours(const char *text, double *out) {
  char *end;
  *out = strtod(text, &end);
  if (end == text || !isfinite(*out) || *out < 0) return false;
  if (*end == ':' && *out == floor(*out)) {
    char *last;
    long minutes = strtol(end + 1, &last, 10);
    if (last == end + 1 || minutes < 0 || minutes > 59) return false;
    *out += (double)minutes / 60;
    end = last;
  }
  return *end == 0;
}

bool cli_sun_options(const cli_options *o, vs_sun_span *out) {
  char *end = NULL, rest;
  *out = (vs_sun_span){.from = 0, .to = 24, .step = 1};
  if (o->place) out->latitude = strtod(o->place, &end);
  bool place = o->place && end != o->place && *end == ',';
  if (place) {
    const char *second = end + 1;
    out->longitude = strtod(second, &end);
    place = end != second && *end == 0 && fabs(out->latitude) <= 90 && fabs(out->longitude) <= 180;
  }
  if (!place) return bad("--place", o->place, "latitude and longitude in degrees, as in 38.77,-9.10");
  if (!o->date || sscanf(o->date, "%4d-%2d-%2d%c", &out->year, &out->month, &out->day, &rest) != 3)
    return bad("--date", o->date, "a day, as in 2026-06-21");
  if (o->from && !read_hours(o->from, &out->from)) return bad("--from", o->from, "an hour, as in 8 or 8:30");
  if (o->language && !read_hours(o->language, &out->to)) return bad("--to", o->language, "an hour, as in 18 or 18:30");
  if (o->step && (!read_hours(o->step, &out->step) || out->step <= 0))
    return bad("--step", o->step, "hours, as in 1 or 0:15");
  return true;
}

vs_outcome cli_sun_command(cli_session *c) {
  const cli_options *o = c->options;
  vs_sun_span span;
  vs_sun_summary told;
  if (!cli_sun_options(o, &span)) return VS_OUTCOME_USAGE;
  vs_outcome outcome = vs_sun_study(c->scheme, &span, o->targets[0].path, &o->output, &told);
  cli_report_settle(&c->reporter);
  if (outcome == VS_OUTCOME_DONE && !o->quiet) {
    printf("%s: %zu faces, %zu pictures", o->targets[0].path, told.faces, told.pictures);
    if (told.dark) printf(", %zu steps without the sun", told.dark);
    putchar('\n');
  }
  return outcome;
}
