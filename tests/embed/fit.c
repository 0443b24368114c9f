/* Tests fits that a host starts (vs fit). The program and the scan are in the host's memory. The fit reports doubtful
 * results, and writes the map of deviations to a file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <visualscheme.h>

static int failures;
#define CHECK(what) ((what) ? puts("ok embed:" #what) : (failures++, puts("not ok embed:" #what)))

static const char program[] = "(define-parameter wide 1.5) (define-parameter high 2.0 #:min 1.0 #:max 9) (define-parameter n 3)"
                              "(display \"run\") (draw (make-box (xyz 0 0 0) (xyz wide 1 high)))";
static char scan[40000];
typedef struct { int printed, warned, failed; } heard;

static bool read_file(void *context, const char *path, char **text, size_t *length, const char **why) {
  const char *from = strcmp(path, "box.vs") == 0 ? program : strcmp(path, "box.off") == 0 ? scan : NULL;
  (void)context;
  *why = "no such file";
  if (!from) return false;
  *length = strlen(from);
  *text = malloc(*length + 1);
  if (*text) memcpy(*text, from, *length + 1);
  return *text != NULL;
}
static bool output(void *context, const char *text, size_t length) {
  (void)text, (void)length;
  ((heard *)context)->printed++;
  return true;
}
static void diagnose(void *context, const vs_diagnostic *d) {
  heard *h = context;
  h->warned += d->severity == VS_SEVERITY_WARNING, h->failed += d->severity == VS_SEVERITY_ERROR;
}

int main(void) {
  heard h = {0};
  vs_options o = vs_options_default();
  o.host.context = &h, o.host.read_file = read_file, o.host.output = output, o.host.diagnose = diagnose;
  vs_scheme *s = vs_new(&o);
  vs_fit_options f = vs_fit_options_default();
  vs_fit_result r;
  vs_fit_parameter p;
  size_t used = (size_t)sprintf(scan, "OFF\n600 0 0\n"), count;
  for (int i = 0; i < 600; i++) { /* makes points on all six sides of a box of 1.8 x 1 x 2.6 */
    double at[3] = {1.8 * (i % 10 + .5) / 10, (i / 10 % 10 + .5) / 10, 2.6 * (i % 7 + .5) / 7};
    const double side[3] = {1.8, 1, 2.6};
    at[i % 3] = i % 2 ? side[i % 3] : 0;
    used += (size_t)sprintf(scan + used, "%.6f %.6f %.6f\n", at[0], at[1], at[2]);
  }
  f.placed = true;
  CHECK(vs_fit(s, "box.vs", "box.off", &f, &r) == VS_OUTCOME_DONE && r.samples == 600 && r.converged);
  CHECK(h.printed == 1); /* the fit runs the program many times, but the host receives only the output of the first
                          * run */
  CHECK(vs_fit_parameter_get(s, 0, &p) && p.state == VS_FIT_FITTED && fabs(p.value - 1.8) < 1e-3 && p.start == 1.5);
  CHECK(vs_fit_parameter_get(s, 1, &p) && p.state == VS_FIT_FITTED && fabs(p.value - 2.6) < 1e-3 && p.low <= 2.6 && p.high >= 2.6);
  CHECK(vs_fit_parameter_get(s, 2, &p) && p.state == VS_FIT_NO_NUMBER && !vs_fit_parameter_get(s, 3, &p));
  const double *d = vs_fit_distances(s, &count);
  CHECK(count == 600 && fabs(d[0]) < 1e-3 && fabs(d[599]) < 1e-3);
  vs_summary summary; /* after the fit, the interpreter's drawing is that of the program with the fitted values */
  CHECK(vs_drawing_summary(s, &summary) == VS_OUTCOME_DONE && fabs(summary.max[0] - 1.8) < 1e-3 && fabs(summary.max[2] - 2.6) < 1e-3);
  CHECK(h.failed == 0 && vs_fit(s, "box.vs", "gone.off", &f, &r) == VS_OUTCOME_USAGE && r.samples == 0 && h.failed == 1);
  CHECK(!vs_fit_distances(s, &count) && count == 0);
  vs_free(s);
  return failures != 0;
}
