/* Prints all messages of a run, and determines their layout.
 *
 * A diagnostic is `file:line:col: message`, then the source line with carets below the marked part, then its notes:
 *
 *   house.vs:12:3: make-sphere: r must be positive, got -2
 *     12 | (make-sphere (xyz 0 0 0) -2)
 *        | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
 *   house.vs:20:1: called from (tower 5) */
#include "cli/messages.h"
#include "cli/json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <time.h>

enum { WINDOW = 120, BEFORE = 60 }; /* WINDOW: greatest number of characters of a source line that are shown; BEFORE:
                                     * number of these before the caret */

void cli_report_settle(cli_reporter *r) {
  if (r->shown) fputs("\r\033[K", stderr);
  r->shown = false;
}

/* ---- errors and warnings ---- */

static const char *next_character(const char *at) {
  if (*at) at++;
  while (((unsigned char)*at & 0xC0) == 0x80) at++;
  return at;
}

/* Returns the length in bytes of the well-formed UTF-8 character at c, or 0. */
static int well_formed(const char *c) {
  unsigned char first = (unsigned char)*c;
  int length = first < 0x80                    ? 1
               : first >= 0xC2 && first < 0xE0 ? 2
               : (first & 0xF0) == 0xE0        ? 3
               : first >= 0xF0 && first < 0xF5 ? 4
                                               : 0;
  for (int i = 1; i < length; i++)
    if (((unsigned char)c[i] & 0xC0) != 0x80) return 0;
  return length;
}

/* Prints a source text, which may contain any byte. Control characters become blanks or question marks. */
static void print_safely(const char *from, const char *to) {
  while (from < to) {
    int length = well_formed(from);
    if (length == 0) fputc('?', stderr), from++;
    else if (length == 1)
      fputc((unsigned char)*from < ' ' && *from != '\t' ? ' ' : *from == 127 ? '?' : *from, stderr), from++;
    else
      for (; length; length--) fputc(*from++, stderr);
  }
}

static void print_place(const vs_span *at) {
  if (!at->file) return;
  fputs(at->file, stderr);
  if (at->line) fprintf(stderr, ":%" PRIu32, at->line);
  if (at->line && at->column) fprintf(stderr, ":%" PRIu32, at->column);
  fputs(": ", stderr);
}

/* Prints the source line with carets below the marked part. behind: a text to print after the carets, or NULL. */
static void print_source(const vs_diagnostic *d, const char *behind) {
  uint32_t first = 1, width = d->at.end_line == d->at.line && d->at.end_column > d->at.column
                                  ? d->at.end_column - d->at.column
                                  : 1;
  const char *line = d->source_line, *end = line;
  if (d->at.column > WINDOW - 20)
    for (; first + BEFORE < d->at.column && *line; first++) line = next_character(line);
  uint32_t shown = 0;
  for (end = line; *end && *end != '\n' && *end != '\r' && shown < WINDOW; shown++) end = next_character(end);
  bool rest = *end && *end != '\n' && *end != '\r';
  fprintf(stderr, "%5" PRIu32 " | %s", d->at.line, first > 1 ? "..." : "");
  print_safely(line, end);
  fputs(rest ? "...\n" : "\n", stderr);
  if (!d->at.column) return;
  fputs("      | ", stderr);
  if (first > 1) fputs("   ", stderr);
  for (uint32_t i = first; i < d->at.column && *line && *line != '\n'; i++, line = next_character(line))
    fputc(*line == '\t' ? '\t' : ' ', stderr);
  uint32_t column = d->at.column - first;
  for (uint32_t i = 0; i == 0 || (i < width && column + i < shown); i++) fputc('^', stderr);
  if (behind) fprintf(stderr, "  %s", behind);
  fputc('\n', stderr);
}

void cli_report_diagnostic(cli_reporter *r, const vs_diagnostic *d) {
  if (r->quiet && d->severity == VS_SEVERITY_NOTE) return;
  fflush(stdout); /* first writes earlier output of the program, so that the order is right */
  cli_report_settle(r);
  if (d->severity == VS_SEVERITY_ERROR) r->errors++;
  if (d->severity == VS_SEVERITY_WARNING) r->warnings++;
  if (d->at.file) print_place(&d->at);
  else fputs("vs: ", stderr);
  if (d->severity == VS_SEVERITY_WARNING) fputs("warning: ", stderr);
  if (d->severity == VS_SEVERITY_NOTE) fputs("note: ", stderr);
  fprintf(stderr, "%s\n", d->message);
  if (d->source_line && d->at.line) print_source(d, NULL);
  for (size_t i = 0; i < d->note_count; i++) {
    print_place(&d->notes[i].at);
    fprintf(stderr, "%s\n", d->notes[i].message);
  }
}

/* Prints the expression at which the program has stopped; cuts a long expression. */
static void print_expression(const vs_stop_info *stop) {
  enum { MOST = 50 };
  const char *at = stop->source_line, *end;
  for (uint32_t i = 1; i < stop->at.column && *at; i++) at = next_character(at);
  end = at;
  uint32_t width = stop->at.end_column - stop->at.column, n = 0;
  for (; n < width && n < MOST && *end; n++) end = next_character(end);
  print_safely(at, end);
  if (n < width) fputs(" ...", stderr);
}

void cli_report_stop(cli_reporter *r, vs_scheme *scheme, const vs_stop_info *stop) {
  fflush(stdout);
  cli_report_settle(r);
  if (stop->kind == VS_STOPPED_VALUE) {
    fputs("  ", stderr);
    if (stop->source_line) print_expression(stop), fputc(' ', stderr);
    fprintf(stderr, "=> %s\n", stop->text);
    return;
  }
  vs_call_info call;
  vs_diagnostic d = {.at = stop->at, .source_line = stop->source_line};
  print_place(&stop->at);
  fprintf(stderr, "%s", stop->kind == VS_STOPPED_BREAK ? "stopped" : "next");
  if (*stop->procedure) fprintf(stderr, ", in %s", stop->procedure);
  if (vs_call_get(scheme, 0, &call) && *call.variables) fprintf(stderr, ": %s", call.variables);
  fputc('\n', stderr);
  if (d.source_line && d.at.line) print_source(&d, *stop->text ? stop->text : NULL);
}

bool cli_report_calls(vs_scheme *scheme, FILE *to) {
  vs_call_info f;
  size_t i = 0;
  for (; vs_call_get(scheme, i, &f); i++) {
    fprintf(to, "  %zu  %s", i + 1, *f.procedure ? f.procedure : "(no name)");
    if (f.at.file) fprintf(to, ", %s:%u:%u", f.at.file, (unsigned)f.at.line, (unsigned)f.at.column);
    fprintf(to, "%s%s\n", *f.variables ? ": " : "", f.variables);
  }
  return i > 0;
}

/* Returns monotonic time in seconds. */
static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Writes the estimated time until the phase ends, at its present speed. Writes an empty text if the time cannot be
 * estimated yet. */
static void time_left(cli_reporter *r, const vs_progress *p, char *text, size_t room) {
  double at = now();
  *text = 0;
  if (!r->shown || strncmp(r->phase, p->phase, sizeof r->phase - 1) != 0) {
    snprintf(r->phase, sizeof r->phase, "%s", p->phase);
    r->begun = at;
  }
  double gone = at - r->begun;
  if (p->fraction < 0.02 || p->fraction >= 1 || gone < 2) return;
  double left = gone * (1 - p->fraction) / p->fraction;
  if (left < 90) snprintf(text, room, ", %.0f s left", ceil(left));
  else if (left < 5400) snprintf(text, room, ", %.0f min left", ceil(left / 60));
  else snprintf(text, room, ", %.1f h left", left / 3600);
}

void cli_report_progress(cli_reporter *r, const vs_progress *p) {
  if (!r->progress) return;
  char line[sizeof r->line], percent[16] = "", left[32];
  time_left(r, p, left, sizeof left);
  if (p->fraction >= 0) snprintf(percent, sizeof percent, " %.0f%%", floor(p->fraction * 100));
  snprintf(line, sizeof line, "%.120s%s%s%s%s", p->subject ? p->subject : "", p->subject ? ": " : "", p->phase,
           percent, left);
  if (r->shown && strcmp(line, r->line) == 0) return;
  memcpy(r->line, line, sizeof line);
  fprintf(stderr, "\r\033[K%s", line);
  fflush(stderr);
  r->shown = true;
}

/* ---- the summary ---- */

static void count_of(size_t n, const char *one, const char *many, bool *any) {
  if (!n) return;
  fprintf(stderr, "%s%zu %s", *any ? ", " : "", n, n == 1 ? one : many);
  *any = true;
}

#define LARGEST_BUILDING 4000 /* largest size of a building in metres: a larger object is a landscape, or is drawn in
                               * other units */

void cli_report_summary(const char *title, const vs_summary *s) {
  bool any = false;
  fprintf(stderr, "%s: ", title);
  if (s->objects == 0) {
    fprintf(stderr, "no objects%s%s\n", s->advice ? "; " : "", s->advice ? s->advice : "");
    return;
  }
  count_of(s->objects, "object", "objects", &any);
  if (s->objects != s->solids) { /* if all objects are solids, only the number of solids is printed */
    bool inner = false;
    fputs(" (", stderr);
    count_of(s->solids, "solid", "solids", &inner);
    count_of(s->surfaces, "surface", "surfaces", &inner);
    count_of(s->regions, "region", "regions", &inner);
    count_of(s->curves, "curve", "curves", &inner);
    if (!inner) fputs("native text", stderr);
    fputc(')', stderr);
  }
  if (s->has_bounds) {
    if (s->bounds_at_most) fputs(", at most", stderr);
    fprintf(stderr, "%s%.5g x %.5g x %.5g %s", s->bounds_at_most ? " " : ", ", s->max[0] - s->min[0],
            s->max[1] - s->min[1], s->max[2] - s->min[2], s->units);
    fprintf(stderr, ", from (%.5g %.5g %.5g) to (%.5g %.5g %.5g)", s->min[0] + 0.0, s->min[1] + 0.0, s->min[2] + 0.0,
            s->max[0] + 0.0, s->max[1] + 0.0, s->max[2] + 0.0);
  }
  fputc('\n', stderr);
  double largest = 0;
  for (int i = 0; i < 3 && s->has_bounds && !s->bounds_at_most; i++) largest = fmax(largest, s->max[i] - s->min[i]);
  if (largest >= LARGEST_BUILDING && strcmp(s->units, "m") == 0) /* a drawing in metres of this size was probably meant
                                                                  * in millimetres */
    fprintf(stderr,
            "%s: the model is %.3g km large; if its lengths are not in metres, write (units 'mm) or (units 'cm)\n",
            title, largest / 1000);
}

/* ---- parameters ---- */

/* Writes a value as JSON: numbers and booleans as such, all other values (1/3, symbols, lists) as text. */
static void json_datum(FILE *to, vs_parameter_type type, const char *datum) {
  if (type == VS_PARAMETER_BOOLEAN) { fputs(strcmp(datum, "#f") == 0 ? "false" : "true", to); return; }
  double v;
  char rest;
  if ((type == VS_PARAMETER_INTEGER || type == VS_PARAMETER_REAL) && sscanf(datum, "%lf%c", &v, &rest) == 1 &&
      isfinite(v) && strspn(datum, "+-.0123456789eE") == strlen(datum)) {
    if (type == VS_PARAMETER_INTEGER) fputs(*datum == '+' ? datum + 1 : datum, to);
    else cli_json_number(to, v);
    return;
  }
  cli_json_text(to, datum);
}

void cli_report_parameters(FILE *to, vs_scheme *s) {
  static const char *const types[] = { [VS_PARAMETER_BOOLEAN] = "boolean",
                                       [VS_PARAMETER_INTEGER] = "integer",
                                       [VS_PARAMETER_REAL] = "real",
                                       [VS_PARAMETER_STRING] = "string",
                                       [VS_PARAMETER_DATUM] = "datum" };
  size_t count = vs_parameter_count(s);
  vs_parameter_info p;
  fputc('[', to);
  for (size_t i = 0; i < count && vs_parameter_get(s, i, &p); i++) {
    fprintf(to, "%s\n  {\"name\": ", i ? "," : "");
    cli_json_text(to, p.name);
    fputs(", \"label\": ", to);
    cli_json_text(to, p.label);
    fputs(", \"group\": ", to);
    cli_json_text(to, p.group);
    fputs(", \"unit\": ", to);
    cli_json_text(to, p.unit);
    fprintf(to, ", \"type\": \"%s\", \"value\": ", types[p.type]);
    json_datum(to, p.type, p.value);
    fputs(", \"default\": ", to);
    json_datum(to, p.type, p.default_value);
    if (p.has_range) {
      fputs(", \"min\": ", to);
      cli_json_number(to, p.min);
      fputs(", \"max\": ", to);
      cli_json_number(to, p.max);
      fputs(", \"step\": ", to);
      cli_json_number(to, p.step);
    }
    if (p.choices) {
      fputs(", \"choices\": [", to);
      for (size_t k = 0; k < p.choice_count; k++) {
        if (k) fputs(", ", to);
        json_datum(to, p.type, p.choices[k]);
      }
      fputc(']', to);
    }
    if (p.at.file) {
      fputs(", \"file\": ", to);
      cli_json_text(to, p.at.file);
      fprintf(to, ", \"line\": %" PRIu32, p.at.line);
    }
    fputc('}', to);
  }
  fputs(count ? "\n]\n" : "]\n", to);
}
