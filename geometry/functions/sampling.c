/* Evaluates tapes in doubles (sampling.h).
 *
 * A batch of points is evaluated step by step. The cost of a step is then small compared with the work on its numbers,
 * and simple operators become vector instructions of the processor. The numbers of a step are in a lane. A lane is
 * reused when no later step reads it; thus all lanes stay in the processor's first-level cache. A lane contains the
 * values, followed by the slopes. A constant has a lane of its own, which is filled once. In complete batches without
 * slopes, inputs are read directly from the caller's array. */
#include "geometry/functions/sampling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { BATCH = VS_SAMPLE_BATCH };

/* WIDE marks functions that are compiled twice, with and without AVX2; the loader chooses at the start, and the results
 * are identical. */
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define WIDE __attribute__((target_clones("avx2", "default")))
#else
#define WIDE
#endif

struct vs_sampler {
  const vs_tape *t;
  int slopes;
  uint32_t *lane;      /* lane[i]: lane (array of numbers) of step i */
  const double **from; /* from[i]: address of step i's values for the current batch of points */
  double *at;          /* memory of all lanes (arrays with the numbers of a step) */
  size_t width;        /* number of doubles in a lane (array of numbers of a step): the values for a batch of points,
                        * and their derivatives */
};

void vs_sampler_free(vs_sampler *s) {
  if (!s) return;
  free(s->lane);
  free(s->from);
  free(s->at);
  free(s);
}

/* Assigns a lane (array of numbers) to each step. Returns the number of lanes, or 0 when memory is out. */
static size_t assign_lanes(vs_sampler *s) {
  const vs_tape *t = s->t;
  uint32_t *last = NULL, *idle = NULL, idle_count = 0, lanes = 0;
  size_t last_room = 0, idle_room = 0;
  if (!VS_GROW(last, last_room, t->count + 1) || !VS_GROW(idle, idle_room, t->count + 1))
    return free(last), free(idle), (size_t)0;
  for (size_t i = 0; i < t->count; i++) {
    last[i] = (uint32_t)i;
    for (int k = 0; k < vs_tape_operands((vs_tape_operator)t->step[i].op); k++) last[t->step[i].of[k]] = (uint32_t)i;
  }
  for (uint32_t i = 0; i < t->outputs; i++) last[t->output[i]] = UINT32_MAX;
  for (size_t i = 0; i < t->count; i++)
    if (t->step[i].op == VS_TAPE_CONSTANT) last[i] = UINT32_MAX;
  for (size_t i = 0; i < t->count; i++) {
    const vs_tape_step *step = &t->step[i];
    bool used_before = idle_count && step->op != VS_TAPE_CONSTANT;
    /* The step gets its lane (array of numbers) before the lanes of its operands become free, so that it never writes
     * to a lane from which it reads. */
    s->lane[i] = used_before ? idle[--idle_count] : lanes++;
    int n = vs_tape_operands((vs_tape_operator)step->op);
    for (int k = 0; k < n; k++)
      if (last[step->of[k]] == i && !(k > 0 && step->of[k] == step->of[0]) && !(k > 1 && step->of[k] == step->of[1]))
        idle[idle_count++] = s->lane[step->of[k]];
  }
  free(last);
  free(idle);
  return lanes;
}

vs_sampler *vs_sampler_new(const vs_tape *t, int slopes) {
  vs_sampler *s = NULL;
  size_t one = 0, room = 0, from = 0, numbers = 0;
  VS_ASSERT(slopes >= 0 && slopes <= VS_SAMPLE_SLOPES);
  if (!VS_GROW(s, one, 1)) return NULL;
  *s = (vs_sampler){ .t = t, .slopes = slopes, .width = (size_t)BATCH * (size_t)(1 + slopes) };
  size_t lanes = VS_GROW(s->lane, room, t->count + 1) && VS_GROW(s->from, from, t->count + 1) ? assign_lanes(s) : 0;
  if (!lanes || !VS_GROW(s->at, numbers, lanes * s->width)) return vs_sampler_free(s), NULL;
  for (size_t k = 0; k < t->count; k++) {
    double *lane = s->at + s->lane[k] * s->width;
    s->from[k] = lane;
    if (t->step[k].op == VS_TAPE_CONSTANT)
      for (size_t i = 0; i < s->width; i++) lane[i] = i < BATCH ? t->step[k].value : 0;
  }
  return s;
}

#define EACH(expression)                                                                                               \
  for (int i = 0; i < BATCH; i++) r[i] = (expression)

WIDE static void values(const vs_tape_step *step, double *restrict r, const double *a, const double *b,
                        const double *c) {
  switch ((vs_tape_operator)step->op) {
  case VS_TAPE_CONSTANT: EACH(step->value); break;
  case VS_TAPE_ADD: EACH(a[i] + b[i]); break;
  case VS_TAPE_SUB: EACH(a[i] - b[i]); break;
  case VS_TAPE_MUL: EACH(a[i] * b[i]); break;
  case VS_TAPE_DIV: EACH(a[i] / b[i]); break;
  case VS_TAPE_NEG: EACH(-a[i]); break;
  case VS_TAPE_SQUARE: EACH(a[i] * a[i]); break;
  case VS_TAPE_ABS: EACH(fabs(a[i])); break;
  case VS_TAPE_SQRT: EACH(sqrt(a[i])); break;
  case VS_TAPE_EXP: EACH(exp(a[i])); break;
  case VS_TAPE_SIN: EACH(sin(a[i])); break;
  case VS_TAPE_COS: EACH(cos(a[i])); break;
  case VS_TAPE_MIN: EACH(a[i] < b[i] || a[i] != a[i] ? a[i] : b[i]); break;
  case VS_TAPE_MAX: EACH(a[i] > b[i] || a[i] != a[i] ? a[i] : b[i]); break;
  case VS_TAPE_CHOOSE: EACH(a[i] != 0 ? b[i] : c[i]); break;
  case VS_TAPE_INPUT:
  case VS_TAPE_FIELD:
  case VS_TAPE_OPERATORS: break;
  case VS_TAPE_CBRT:
  case VS_TAPE_LOG:
  case VS_TAPE_TAN:
  case VS_TAPE_ASIN:
  case VS_TAPE_ACOS:
  case VS_TAPE_ATAN:
  case VS_TAPE_ATAN2:
  case VS_TAPE_SINH:
  case VS_TAPE_COSH:
  case VS_TAPE_TANH:
  case VS_TAPE_POW:
  case VS_TAPE_FLOOR:
  case VS_TAPE_CEIL:
  case VS_TAPE_LESS:
  case VS_TAPE_ATMOST:
  case VS_TAPE_EQUAL: EACH(vs_tape_apply((vs_tape_operator)step->op, a[i], b[i], c[i])); break;
  }
}

/* Computes the partial derivatives of a step's result by its operands: p by the operand a, and q by the operand b. r:
 * the step's values. */
static void partials(const vs_tape_step *step, const double *r, const double *a, const double *b, double *p,
                     double *q) {
#define BOTH(by_a, by_b)                                                                                               \
  for (int i = 0; i < BATCH; i++) p[i] = (by_a), q[i] = (by_b)
#define ONE(by_a)                                                                                                      \
  for (int i = 0; i < BATCH; i++) p[i] = (by_a)
  switch ((vs_tape_operator)step->op) {
  case VS_TAPE_ADD: BOTH(1, 1); break;
  case VS_TAPE_SUB: BOTH(1, -1); break;
  case VS_TAPE_MUL: BOTH(b[i], a[i]); break;
  case VS_TAPE_DIV: BOTH(1 / b[i], -r[i] / b[i]); break;
  case VS_TAPE_NEG: ONE(-1); break;
  case VS_TAPE_SQUARE: ONE(2 * a[i]); break;
  case VS_TAPE_ABS: ONE(a[i] < 0 ? -1 : 1); break;
  case VS_TAPE_SQRT: ONE(.5 / r[i]); break;
  case VS_TAPE_CBRT: ONE(r[i] / (3 * a[i])); break;
  case VS_TAPE_EXP: ONE(r[i]); break;
  case VS_TAPE_LOG: ONE(1 / a[i]); break;
  case VS_TAPE_SIN: ONE(cos(a[i])); break;
  case VS_TAPE_COS: ONE(-sin(a[i])); break;
  case VS_TAPE_TAN: ONE(1 + r[i] * r[i]); break;
  case VS_TAPE_ASIN: ONE(1 / sqrt(1 - a[i] * a[i])); break;
  case VS_TAPE_ACOS: ONE(-1 / sqrt(1 - a[i] * a[i])); break;
  case VS_TAPE_ATAN: ONE(1 / (1 + a[i] * a[i])); break;
  case VS_TAPE_ATAN2: BOTH(b[i] / (a[i] * a[i] + b[i] * b[i]), -a[i] / (a[i] * a[i] + b[i] * b[i])); break;
  case VS_TAPE_SINH: ONE(cosh(a[i])); break;
  case VS_TAPE_COSH: ONE(sinh(a[i])); break;
  case VS_TAPE_TANH: ONE(1 - r[i] * r[i]); break;
  case VS_TAPE_POW: BOTH(b[i] == 0 ? 0 : b[i] * pow(a[i], b[i] - 1), a[i] > 0 ? r[i] * log(a[i]) : 0); break;
  case VS_TAPE_MIN: BOTH(a[i] <= b[i], !(a[i] <= b[i])); break;
  case VS_TAPE_MAX: BOTH(a[i] >= b[i], !(a[i] >= b[i])); break;
  case VS_TAPE_FLOOR:
  case VS_TAPE_CEIL: ONE(0); break;
  case VS_TAPE_LESS:
  case VS_TAPE_ATMOST:
  case VS_TAPE_EQUAL: BOTH(0, 0); break;
  case VS_TAPE_CHOOSE:
  case VS_TAPE_FIELD:
  case VS_TAPE_CONSTANT:
  case VS_TAPE_INPUT:
  case VS_TAPE_OPERATORS: break;
  }
}

/* Computes the slopes (derivatives by the inputs) of a step from the slopes of its operands. */
static void slopes(int count, const vs_tape_step *step, double *r, const double *a, const double *b, const double *c) {
  double p[BATCH], q[BATCH];
  int operands = vs_tape_operands((vs_tape_operator)step->op);
  if (operands == 0) {
    for (int j = 1; j <= count; j++)
      for (int i = 0; i < BATCH; i++) r[j * BATCH + i] = step->op == VS_TAPE_INPUT && step->of[0] == (uint32_t)j - 1;
    return;
  }
  partials(step, r, a, b, p, q);
  for (int j = BATCH; j <= count * BATCH; j += BATCH) {
    double *to = r + j;
    const double *da = a + j, *db = b + j, *dc = c + j;
    if (step->op == VS_TAPE_CHOOSE)
      for (int i = 0; i < BATCH; i++) to[i] = a[i] != 0 ? db[i] : dc[i];
    else if (operands == 1)
      for (int i = 0; i < BATCH; i++) to[i] = da[i] == 0 ? 0 : p[i] * da[i]; /* avoids the product 0 * inf, which would
                                                                              * be NaN, for example at a square root of
                                                                              * 0 */
    else
      for (int i = 0; i < BATCH; i++) to[i] = (da[i] == 0 ? 0 : p[i] * da[i]) + (db[i] == 0 ? 0 : q[i] * db[i]);
  }
}

/* Computes the values and slopes of field f (a function of space) for n points, whose coordinates are in of[0] to
 * of[2]. Elements from n on get the value of the first point. */
static void field(const vs_tape_field *f, int count, size_t n, double *r, const double *const of[3]) {
  const double *a = of[0], *b = of[1], *c = of[2];
  for (size_t i = 0; i < BATCH; i++) {
    double by[3];
    if (i < n) r[i] = f->value(f, (const double[]){ a[i], b[i], c[i] }, count ? by : NULL);
    if (i >= n) r[i] = r[0];
    for (size_t j = BATCH; j <= (size_t)count * BATCH; j += BATCH)
      r[j + i] = i < n ? by[0] * a[j + i] + by[1] * b[j + i] + by[2] * c[j + i] : 0;
  }
}

/* Evaluates the tape for a batch of n <= BATCH points, which begins at index `from` of the caller's arrays. */
static void batch(vs_sampler *s, const double *const *in, size_t from, size_t n, double *const *out,
                  double *const *slope) {
  const vs_tape *t = s->t;
  bool in_place = !slope && n == BATCH; /* true if inputs are read directly from the caller's arrays, and the value of a
                                         * single output is written directly to the caller's array */
  VS_ASSERT(n <= BATCH);
  for (size_t k = 0; k < t->count; k++) {
    const vs_tape_step *step = &t->step[k];
    if (step->op == VS_TAPE_CONSTANT) continue;
    if (step->op == VS_TAPE_INPUT && in_place) {
      s->from[k] = in[step->of[0]] + from;
      continue;
    }
    bool last = in_place && t->outputs == 1 && t->output[0] == k;
    double *r = last ? out[0] + from : s->at + s->lane[k] * s->width;
    s->from[k] = r;
    const double *a = s->from[step->op == VS_TAPE_INPUT ? 0 : step->of[0]], *b = s->from[step->of[1]],
                 *c = s->from[step->of[2]];
    if (step->op == VS_TAPE_INPUT) {
      memcpy(r, in[step->of[0]] + from, n * sizeof *r);
      for (size_t i = n; i < BATCH; i++) r[i] = r[0];
    } else if (step->op == VS_TAPE_FIELD) {
      field(t->field[(size_t)step->value], slope ? s->slopes : 0, n, r, (const double *const[]){ a, b, c });
      continue;
    } else {
      values(step, r, a, b, c);
    }
    if (slope) slopes(s->slopes, step, r, a, b, c);
  }
  for (uint32_t o = 0; o < t->outputs; o++)
    if (s->from[t->output[o]] != out[o] + from) memcpy(out[o] + from, s->from[t->output[o]], n * sizeof **out);
  for (int j = 0; slope && j < s->slopes; j++)
    memcpy(slope[j] + from, s->from[t->output[0]] + (j + 1) * BATCH, n * sizeof **slope);
}

void vs_sample(vs_sampler *s, const double *const *in, size_t n, double *const *out) {
  for (size_t from = 0; from < n; from += BATCH) batch(s, in, from, n - from < BATCH ? n - from : BATCH, out, NULL);
}

void vs_sample_slopes(vs_sampler *s, const double *const *in, size_t n, double *const *out, double *const *slope) {
  for (size_t from = 0; from < n; from += BATCH) batch(s, in, from, n - from < BATCH ? n - from : BATCH, out, slope);
}

/* ---- grids ---- */

/* Returns number `at` of a range of equally spaced numbers. Its two ends are exact. at is below r->n. */
static double computed(const vs_sample_range *r, int64_t at) {
  VS_ASSERT(at >= 0 && at < r->n);
  return at == 0 ? r->a : at == r->n - 1 ? r->b : r->a + (r->b - r->a) * (double)at / (double)(r->n - 1);
}

static double range_value(const vs_sample_range *r, int64_t at) {
  return at < VS_SAMPLE_KNOWN ? r->known[at] : computed(r, at);
}

/* Fills points as vs_sample_points does, up to the end of the innermost range at most. Returns the number of points. */
static int row(vs_sample_range *r, uint32_t inputs, double (*in)[VS_SAMPLE_BATCH], int k, int count) {
  vs_sample_range *last = &r[inputs - 1];
  int n = last->n - last->at < count - k ? (int)(last->n - last->at) : count - k;
  for (uint32_t i = 0; i + 1 < inputs; i++) {
    double now = range_value(&r[i], r[i].at);
    for (int j = 0; j < n; j++) in[i][k + j] = now;
  }
  if (last->at + n <= VS_SAMPLE_KNOWN)
    memcpy(in[inputs - 1] + k, last->known + last->at, (size_t)n * sizeof **in);
  else
    for (int j = 0; j < n; j++) in[inputs - 1][k + j] = range_value(last, last->at + j);
  last->at = last->at + n < last->n ? last->at + n : 0;
  for (uint32_t i = inputs - 1; i-- > 0 && !r[i + 1].at;) r[i].at = r[i].at + 1 < r[i].n ? r[i].at + 1 : 0;
  return n;
}

void vs_sample_begin(vs_sample_range *r) {
  int64_t known = r->n < VS_SAMPLE_KNOWN ? r->n : VS_SAMPLE_KNOWN;
  VS_ASSERT(r->n > 0);
  for (int64_t i = 0; i < known; i++) r->known[i] = computed(r, i);
  r->at = 0;
}

void vs_sample_points(vs_sample_range *r, uint32_t inputs, double (*in)[VS_SAMPLE_BATCH], int count) {
  VS_ASSERT(inputs > 0 && count <= VS_SAMPLE_BATCH);
  for (int k = 0; k < count;) k += row(r, inputs, in, k, count);
}

WIDE bool vs_sample_nan(const double *at, int count) {
  int bad = 0;
  for (int i = 0; i < count; i++) bad |= at[i] != at[i];
  return bad;
}
