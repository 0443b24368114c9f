/* Contains `trial`, the test of a random program. Its interpreter records messages and runs texts. The trial writes the
 * drawing, reads it back as a mesh, and measures the mesh. */
#ifndef VS_TESTS_TRIALS_H
#define VS_TESTS_TRIALS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <unistd.h>

#include <cmocka.h>

#include "visualscheme.h"
#include "tests/oracle/models.c" /* this file calls static functions of models.c */
#include "tests/tools/written_mesh.h"

enum { TEXT = 4 * MODEL_ROOM };

typedef struct {
  char error[600], warning[2000], out[TEXT];
  size_t out_count;
} said;
typedef struct {
  vs_scheme *vm;
  said heard;
  char why[900];
  unsigned line;
  const char *file;                /* file name that error messages show for the texts; NULL means "model" */
  bool volumes;                    /* whether to measure volumes and to write two more formats, which takes most of the
                                    * time */
  const vs_output_options *output; /* options for writing; NULL means the defaults */
} trial;

static void hear(void *context, const vs_diagnostic *d) {
  said *s = context;
  if (d->severity == VS_SEVERITY_ERROR) snprintf(s->error, sizeof s->error, "%s", d->message);
  if (d->severity == VS_SEVERITY_WARNING) {
    size_t n = strlen(s->warning);
    snprintf(s->warning + n, sizeof s->warning - n, "%s\n", d->message);
  }
}
static bool print(void *context, const char *text, size_t length) {
  said *s = context;
  if (s->out_count + length >= TEXT) return false;
  memcpy(s->out + s->out_count, text, length);
  s->out[s->out_count += length] = 0;
  return true;
}

static vs_outcome run(trial *t, const char *format, ...) {
  static char text[TEXT];
  va_list rest;
  va_start(rest, format);
  vsnprintf(text, sizeof text, format, rest);
  va_end(rest);
  t->heard.error[0] = t->heard.warning[0] = 0;
  t->heard.out_count = 0;
  t->heard.out[0] = 0;
  return vs_eval_text(t->vm, t->file ? t->file : "model", ++t->line, text, strlen(text), 0);
}

/* ---- written meshes ---- */

typedef struct {
  crossings_point low, high;
  double volume, area;
  written_mesh s;
} written;

static bool to_file(void *context, const void *bytes, size_t count) {
  return fwrite(bytes, 1, count, context) == count;
}

static void measure(written *w) {
  for (int k = 0; k < 3; k++) w->low[k] = INFINITY, w->high[k] = -INFINITY;
  w->volume = written_volume(&w->s);
  w->area = 0;
  for (size_t i = 0; i < w->s.count; i++) {
    const double *a = w->s.points[w->s.triangles[i][0]], *b = w->s.points[w->s.triangles[i][1]],
                 *c = w->s.points[w->s.triangles[i][2]];
    double p[3], q[3], n[3];
    for (int k = 0; k < 3; k++) {
      p[k] = b[k] - a[k], q[k] = c[k] - a[k];
      w->low[k] = fmin(w->low[k], fmin(a[k], fmin(b[k], c[k])));
      w->high[k] = fmax(w->high[k], fmax(a[k], fmax(b[k], c[k])));
    }
    for (int k = 0; k < 3; k++) n[k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
    w->area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
  }
}

static void release(written *w) {
  written_free(&w->s);
  *w = (written){ .volume = 0 };
}

/* Writes the drawing in the format, and reads mesh number `which` from the written file. Returns false if the drawing
 * was not written. */
static bool write_as(trial *t, const char *suffix, size_t which, written *out, bool *more) {
  char path[100];
  *more = false;
  const char *folder = getenv("TMPDIR");
  snprintf(path, sizeof path, "%.60s/models-%ld%s", folder && *folder ? folder : "/tmp", (long)getpid(), suffix);
  FILE *f = fopen(path, "wb");
  assert_non_null(f);
  t->heard.error[0] = t->heard.warning[0] = 0;
  bool ok = vs_write_drawing_to(t->vm, suffix, t->output, to_file, f) == VS_OUTCOME_DONE;
  fclose(f);
  *out = (written){ .volume = 0 };
  if (ok && !read_mesh(path, which, &out->s, more)) abort();
  remove(path);
  if (ok) measure(out);
  return ok;
}

/* Returns the winding number of the mesh at p: the sum of the triangles' solid angles divided by 4 pi. *nearest is a
 * lower bound of the distance to the nearest triangle. */
static inline double winding(const written_mesh *s, const double p[3], double *nearest) {
  double sum = 0;
  *nearest = INFINITY;
  for (size_t i = 0; i < s->count; i++) {
    double v[3][3], length[3], middle = 0;
    for (int j = 0; j < 3; j++) {
      length[j] = 0;
      for (int k = 0; k < 3; k++) v[j][k] = s->points[s->triangles[i][j]][k] - p[k], length[j] += v[j][k] * v[j][k];
      length[j] = sqrt(length[j]);
    }
    double e[3], f[3], n[3], size = 0;
    for (int k = 0; k < 3; k++) e[k] = v[1][k] - v[0][k], f[k] = v[2][k] - v[0][k];
    for (int k = 0; k < 3; k++)
      n[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3], size += n[k] * n[k],
      middle += n[k] * v[0][k];
    double det = middle, dots[3];
    for (int j = 0; j < 3; j++)
      dots[j] = v[j][0] * v[(j + 1) % 3][0] + v[j][1] * v[(j + 1) % 3][1] + v[j][2] * v[(j + 1) % 3][2];
    sum += 2 * atan2(det, length[0] * length[1] * length[2] + dots[0] * length[2] + dots[1] * length[0] +
                              dots[2] * length[1]);
    /* If the triangle appears large from p, the distance of p from the triangle's plane; otherwise a bound computed
     * from the corners. Neither exceeds the distance of p from the triangle. */
    double plane = size > 0 ? fabs(det) / sqrt(size) : 0, longest = 0;
    for (int k = 0; k < 3; k++) longest = fmax(longest, fmax(fabs(e[k]), fabs(f[k])));
    *nearest = fmin(*nearest, fmax(plane, fmin(length[0], fmin(length[1], length[2])) - 2 * longest));
  }
  return sum / (4 * 3.14159265358979323846);
}

static inline bool number_of(trial *t, const char *expression, double *out) {
  if (run(t, "(display %s)", expression) != VS_OUTCOME_DONE) return false;
  *out = strtod(t->heard.out, NULL);
  return true;
}

/* Begins a trial. cache: limit of cached results in bytes, as in vs_options. */
static void begin(trial *t, size_t cache) {
  vs_options o = vs_options_default();
  *t = (trial){ .vm = NULL };
  o.cache = cache;
  o.host.context = &t->heard;
  o.host.diagnose = hear;
  o.host.output = print;
  o.limit_time = 20;
  o.limit_memory = (size_t)1500 << 20;
  t->vm = vs_new(&o);
  assert_non_null(t->vm);
}

/* Prints the program of a seed for which `fails` returned true, and then the smallest part of the program for which
 * `fails` still returns true. `why` is the reason, which `fails` writes; `label` is printed before the seed. With
 * NOSHRINK=1, prints only the program. */
static void report_seed(const char *label, unsigned long long seed, char text[MODEL_ROOM],
                        bool (*fails)(void *context, const char *text), void *context, const char *why) {
  fprintf(stderr, "%sseed %llu: %s\n%s\n", label, seed, why, text);
  if (getenv("NOSHRINK")) return;
  model_shrink(text, fails, context);
  fails(context, text);
  fprintf(stderr, "smaller: %s\n%s\n", why, text);
}

#endif
