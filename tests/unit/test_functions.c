/* Tests tapes, the compiled form of a function: a list of steps. Compares evaluation of many points at a time with
 * single points, slopes with difference quotients, and bounds with sampled values. Also tests contours, which must be
 * closed manifolds for every function and every size of cells. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/functions/contour.h"
#include "geometry/functions/enclosure.h"
#include "geometry/functions/formula_text.h"
#include "geometry/functions/sampling.h"

static double drawn(uint64_t *seed, double a, double b) { /* returns a random number from a to b by xorshift, equal in
                                                           * every run */
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return a + (b - a) * (double)(*seed >> 11) / 9007199254740992.0;
}

static uint32_t add(vs_tape *t, vs_tape_operator op, uint32_t a, uint32_t b) { return vs_tape_add(t, op, a, b, 0); }
static uint32_t squares(vs_tape *t, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t ab = add(t, VS_TAPE_ADD, add(t, VS_TAPE_SQUARE, a, 0), add(t, VS_TAPE_SQUARE, b, 0));
  return add(t, VS_TAPE_ADD, ab, add(t, VS_TAPE_SQUARE, c, 0));
}

static void steps_are_kept_once(void **state) {
  (void)state;
  vs_tape *t = vs_tape_new(2);
  uint32_t x = vs_tape_input(t, 0), y = vs_tape_input(t, 1), one = vs_tape_constant(t, 1);
  assert_int_equal(add(t, VS_TAPE_ADD, x, y), add(t, VS_TAPE_ADD, y, x));
  assert_int_equal(add(t, VS_TAPE_MUL, x, one), x);
  assert_int_equal(add(t, VS_TAPE_MUL, x, x), add(t, VS_TAPE_SQUARE, x, 0));
  assert_int_equal(add(t, VS_TAPE_ADD, one, one), vs_tape_constant(t, 2));
  assert_int_equal(add(t, VS_TAPE_ADD, x, 1000), UINT32_MAX); /* a step whose operand is a failed step fails too */
  size_t before = t->count;
  t->outputs = 1, t->output[0] = add(t, VS_TAPE_SIN, x, 0);
  vs_tape *c = vs_tape_compact(t);
  assert_true(before > 2 && c->count == 2);
  vs_tape_free(c), vs_tape_free(t);
}

/* Returns a tape with three inputs that uses every operator, except operators that jump or have a pole at the numbers
 * which the test draws. */
static vs_tape *of_all(void) {
  vs_tape *t = vs_tape_new(3);
  uint32_t x = vs_tape_input(t, 0), y = vs_tape_input(t, 1), z = vs_tape_input(t, 2), sum = vs_tape_constant(t, .25);
  uint32_t above = add(t, VS_TAPE_ADD, squares(t, x, y, z), vs_tape_constant(t, 1.5));
  uint32_t within = add(t, VS_TAPE_DIV, x, above);
  static const vs_tape_operator one[] = { VS_TAPE_NEG,  VS_TAPE_SQUARE, VS_TAPE_ABS,  VS_TAPE_SQRT, VS_TAPE_CBRT,
                                          VS_TAPE_EXP,  VS_TAPE_LOG,    VS_TAPE_SIN,  VS_TAPE_COS,  VS_TAPE_TAN,
                                          VS_TAPE_ATAN, VS_TAPE_SINH,   VS_TAPE_COSH, VS_TAPE_TANH };
  static const vs_tape_operator two[] = { VS_TAPE_ADD,   VS_TAPE_SUB, VS_TAPE_MUL, VS_TAPE_DIV,
                                          VS_TAPE_ATAN2, VS_TAPE_POW, VS_TAPE_MIN, VS_TAPE_MAX };
  for (size_t i = 0; i < sizeof one / sizeof *one; i++)
    sum = add(t, VS_TAPE_ADD, sum, add(t, one[i], i < 7 ? above : within, 0));
  for (size_t i = 0; i < sizeof two / sizeof *two; i++) sum = add(t, VS_TAPE_SUB, sum, add(t, two[i], above, within));
  sum = add(t, VS_TAPE_ADD, sum, add(t, VS_TAPE_ASIN, within, 0));
  sum = add(t, VS_TAPE_ADD, sum, add(t, VS_TAPE_ACOS, within, 0));
  uint32_t less = add(t, VS_TAPE_LESS, x, y);
  t->outputs = 1, t->output[0] = vs_tape_add(t, VS_TAPE_CHOOSE, less, sum, add(t, VS_TAPE_MUL, sum, z));
  return t;
}

static double value_at(const vs_tape *t, const double *in) {
  double *at = malloc(t->count * sizeof *at);
  for (size_t i = 0; i < t->count; i++) {
    const vs_tape_step *s = &t->step[i];
    at[i] = s->op == VS_TAPE_CONSTANT ? s->value
            : s->op == VS_TAPE_INPUT  ? in[s->of[0]]
                                     : vs_tape_apply((vs_tape_operator)s->op, at[s->of[0]], at[s->of[1]], at[s->of[2]]);
  }
  double v = at[t->output[0]];
  free(at);
  return v;
}

enum { POINTS = 3 * VS_SAMPLE_BATCH + 17 };

static void batches_give_what_single_points_give(void **state) {
  (void)state;
  vs_tape *t = of_all();
  uint64_t seed = 88172645463325252u;
  static double in[3][POINTS], out[POINTS], again[POINTS], slope[3][POINTS];
  for (int i = 0; i < POINTS; i++)
    for (int k = 0; k < 3; k++) in[k][i] = drawn(&seed, -1, 1);
  vs_sampler *values = vs_sampler_new(t, 0), *slopes = vs_sampler_new(t, 3);
  for (int run = 0; run < 2; run++) /* evaluates the tape twice: values that the first run left in memory must not
                                     * affect the second */
    vs_sample(values, (const double *const[]){ in[0], in[1], in[2] }, POINTS, (double *const[]){ out });
  vs_sample_slopes(slopes, (const double *const[]){ in[0], in[1], in[2] }, POINTS, (double *const[]){ again },
                   (double *const[]){ slope[0], slope[1], slope[2] });
  for (int i = 0; i < POINTS; i++) {
    double at[3] = { in[0][i], in[1][i], in[2][i] }, v = value_at(t, at);
    assert_true(fabs(out[i] - v) <= 1e-13 * fabs(v) && out[i] == again[i]);
    if (fabs(at[0] - at[1]) < 1e-3) continue; /* skips points near the place where the tape's choice between two values
                                               * changes, since the slope jumps there */
    for (int k = 0; k < 3; k++) {
      double up[3] = { at[0], at[1], at[2] }, down[3] = { at[0], at[1], at[2] }, h = 1e-5;
      up[k] += h, down[k] -= h;
      double quotient = (value_at(t, up) - value_at(t, down)) / (2 * h);
      if (fabs(slope[k][i] - quotient) > 1e-5 * (1 + fabs(quotient)))
        fail_msg("slope %d at %d: %g, not %g", k, i, slope[k][i], quotient);
    }
  }
  vs_sampler_free(values), vs_sampler_free(slopes), vs_tape_free(t);
}

static void bounds_hold_all_values(void **state) {
  (void)state;
  vs_tape *t = of_all();
  vs_enclosure *work = malloc(t->count * sizeof *work);
  uint64_t seed = 362436069u;
  for (int i = 0; i < 300; i++) {
    vs_enclosure in[3];
    double wide = pow(10, drawn(&seed, -6, 0));
    for (int k = 0; k < 3; k++) in[k].low = drawn(&seed, -1, 1), in[k].high = in[k].low + wide, in[k].partial = false;
    vs_enclosure v = vs_enclose_tape(t, in, work);
    for (int j = 0; j < 30; j++) {
      double at[3], here;
      for (int k = 0; k < 3; k++) at[k] = drawn(&seed, in[k].low, in[k].high);
      here = value_at(t, at);
      assert_true(v.low <= here && here <= v.high);
    }
  }
  free(work), vs_tape_free(t);
}

static void ranges_walk_through_grids(void **state) {
  (void)state;
  /* requests more values than vs_sample_begin computes in advance */
  vs_sample_range r[2] = { { .a = 0, .b = 1, .n = 3 }, { .a = 5, .b = 7, .n = 500 } };
  static double in[2][VS_SAMPLE_BATCH];
  vs_sample_begin(&r[0]), vs_sample_begin(&r[1]);
  for (int at = 0; at < 1500;) {
    int n = at + 100 < 1500 ? 100 : 1500 - at;
    vs_sample_points(r, 2, in, n);
    for (int k = 0; k < n; k++, at++) {
      assert_true(in[0][k] == .5 * (at / 500));
      assert_true(fabs(in[1][k] - (5 + 2. * (at % 500) / 499)) < 1e-14);
    }
  }
  assert_true(in[1][99] == 7); /* the last sample is exactly the end of the range */
}

/* ---- contours ---- */

typedef struct {
  uint32_t from, to, next;
} side;

static int by_ends(const void *a, const void *b) {
  const side *s = a, *t = b;
  if (s->from != t->from) return s->from < t->from ? -1 : 1;
  return (s->to > t->to) - (s->to < t->to);
}

static const side *find_side(const side *s, size_t n, uint32_t from, uint32_t to) {
  const side wanted = { from, to, 0 };
  return bsearch(&wanted, s, n, sizeof *s, by_ends);
}

/* Checks that each edge belongs to two triangles in opposite directions, and that the triangles of a vertex form a
 * single fan. Returns the enclosed volume. */
static double check_manifold(const vs_contour *c) {
  size_t n = 3 * c->triangle_count;
  side *s = malloc((n + 1) * sizeof *s);
  double volume = 0;
  for (size_t i = 0; i < c->triangle_count; i++) {
    const uint32_t *t = c->triangles[i];
    for (size_t k = 0; k < 3; k++) {
      assert_true(t[k] < c->point_count);
      s[3 * i + k] = (side){ t[k], t[(k + 1) % 3], t[(k + 2) % 3] };
    }
    volume += vs_v3_dot(c->points[t[0]], vs_v3_cross(c->points[t[1]], c->points[t[2]])) / 6;
  }
  qsort(s, n, sizeof *s, by_ends);
  for (size_t i = 0; i < n; i++) {
    if (i + 1 < n && !by_ends(&s[i], &s[i + 1])) fail_msg("an edge has two triangles on one side");
    if (!find_side(s, n, s[i].to, s[i].from)) fail_msg("an edge has one triangle");
  }
  size_t points = 0;
  for (size_t i = 0; i < n; points++) {
    size_t end = i, fan = 0;
    while (end < n && s[end].from == s[i].from) end++;
    const side *at = &s[i];
    do at = find_side(s, n, at->from, at->next), fan++;
    while (at && at != &s[i] && fan <= end - i);
    if (fan != end - i) fail_msg("a point has two fans");
    i = end;
  }
  assert_int_equal(points, c->point_count);
  free(s);
  return volume;
}

static bool go_on(void *context, double done) {
  (void)context, (void)done;
  return true;
}

static uint32_t slab(vs_tape *t, uint64_t *seed) {
  double n[3], length = 0;
  for (int a = 0; a < 3; a++) n[a] = drawn(seed, 0, 3) < 1 ? 0 : drawn(seed, -1, 1), length += n[a] * n[a];
  if (length == 0) n[2] = length = 1;
  uint32_t sum = vs_tape_constant(t, 0);
  for (uint32_t a = 0; a < 3; a++)
    sum = add(t, VS_TAPE_ADD, sum, add(t, VS_TAPE_MUL, vs_tape_input(t, a), vs_tape_constant(t, n[a] / sqrt(length))));
  return add(t, VS_TAPE_SUB, add(t, VS_TAPE_ABS, sum, 0), vs_tape_constant(t, drawn(seed, .02, .8)));
}

static uint32_t ball(vs_tape *t, uint64_t *seed) {
  uint32_t at[3];
  for (uint32_t a = 0; a < 3; a++)
    at[a] = add(t, VS_TAPE_SUB, vs_tape_input(t, a), vs_tape_constant(t, drawn(seed, -.7, .7)));
  return add(t, VS_TAPE_SUB, add(t, VS_TAPE_SQRT, squares(t, at[0], at[1], at[2]), 0),
             vs_tape_constant(t, drawn(seed, .1, .9)));
}

static uint32_t waves(vs_tape *t, uint64_t *seed) {
  uint32_t product = vs_tape_constant(t, 1);
  for (uint32_t a = 0; a < 3; a++) {
    uint32_t angle = add(t, VS_TAPE_MUL, vs_tape_input(t, a), vs_tape_constant(t, drawn(seed, 1, 9)));
    product = add(t, VS_TAPE_MUL, product, add(t, VS_TAPE_SIN, angle, 0));
  }
  return product;
}

/* Returns a random solid: a union, intersection or difference of slabs, balls and waves. It has edges, corners, thin
 * walls, and sheets that touch. */
static vs_tape *random_solid(uint64_t *seed) {
  vs_tape *t = vs_tape_new(3);
  uint32_t all = ball(t, seed);
  for (int parts = (int)drawn(seed, 1, 6); parts-- > 0;) {
    double kind = drawn(seed, 0, 3), how = drawn(seed, 0, 3);
    uint32_t part = kind < 1.5 ? slab(t, seed) : kind < 2.5 ? ball(t, seed) : waves(t, seed);
    all = how < 1   ? add(t, VS_TAPE_MIN, all, part)
          : how < 2 ? add(t, VS_TAPE_MAX, all, part)
                    : add(t, VS_TAPE_MAX, all, add(t, VS_TAPE_NEG, part, 0));
  }
  t->outputs = 1, t->output[0] = all;
  return t;
}

static void contours_are_manifolds(void **state) {
  (void)state;
  uint64_t seed = 521288629u;
  int made = 0, merged = 0;
  for (int i = 0; i < 120; i++) {
    vs_tape *t = random_solid(&seed);
    int cells = (int)drawn(&seed, 3, 40);
    vs_contour fine = { 0 }, coarse = { 0 };
    vs_vec3 p = vs_v3(-1, -1.1, -.9), q = vs_v3(1.05, .95, 1);
    vs_contour_outcome outcome = vs_contour_make(t, &(vs_contour_grid){ p, q, cells, 0 }, (vs_long_work){ go_on, NULL }, &fine);
    if (outcome == VS_CONTOUR_DONE) {
      check_manifold(&fine), made++;
      double tolerance = drawn(&seed, .5, 3) * fmax(fine.deviation, 1e-3);
      assert_int_equal(vs_contour_make(t, &(vs_contour_grid){ p, q, cells, tolerance }, (vs_long_work){ go_on, NULL }, &coarse), VS_CONTOUR_DONE);
      check_manifold(&coarse);
      if (fine.deviation <= tolerance) assert_true(coarse.deviation <= tolerance);
      merged += coarse.triangle_count < fine.triangle_count;
    } else
      assert_int_equal(outcome, VS_CONTOUR_EMPTY);
    vs_contour_free(&fine), vs_contour_free(&coarse), vs_tape_free(t);
  }
  if (made < 90 || merged < 60) fail_msg("%d solids, %d of them merged", made, merged);
}

static void flat_sides_are_few_triangles(void **state) {
  (void)state;
  vs_tape *t = vs_tape_new(3);
  uint32_t all = vs_tape_constant(t, -1);
  static const double half[3] = { .7, .61, .53 };
  for (uint32_t a = 0; a < 3; a++)
    all = add(t, VS_TAPE_MAX, all,
              add(t, VS_TAPE_SUB, add(t, VS_TAPE_ABS, vs_tape_input(t, a), 0), vs_tape_constant(t, half[a])));
  t->outputs = 1, t->output[0] = all;
  vs_contour c = { 0 };
  assert_int_equal(vs_contour_make(t, &(vs_contour_grid){ vs_v3(-1, -1, -1), vs_v3(1, 1, 1), 128, 0 }, (vs_long_work){ go_on, NULL }, &c), VS_CONTOUR_DONE);
  assert_true(fabs(check_manifold(&c) - 8 * .7 * .61 * .53) < 1e-6);
  assert_true(c.triangle_count < 40); /* large cells are merged; cells of equal size would make about 90,000
                                       * triangles */
  vs_contour_free(&c), vs_tape_free(t);
}

/* Tests that only detail makes cells small. For a ball with a narrow groove, the cells away from the groove must be
 * large. */
static void round_sides_follow_the_tolerance(void **state) {
  (void)state;
  vs_tape *t = vs_tape_new(3);
  uint32_t r = squares(t, vs_tape_input(t, 0), vs_tape_input(t, 1), vs_tape_input(t, 2));
  t->outputs = 1, t->output[0] = add(t, VS_TAPE_SUB, add(t, VS_TAPE_SQRT, r, 0), vs_tape_constant(t, 1));
  size_t before = SIZE_MAX;
  for (double tolerance = 5e-4; tolerance < .02; tolerance *= 3) {
    vs_contour c = { 0 };
    assert_int_equal(vs_contour_make(t, &(vs_contour_grid){ vs_v3(-1.2, -1.2, -1.2), vs_v3(1.2, 1.2, 1.2), 100, tolerance }, (vs_long_work){ go_on, NULL }, &c),
                     VS_CONTOUR_DONE);
    double volume = check_manifold(&c);
    assert_true(c.deviation <= tolerance && c.triangle_count < before);
    assert_true(fabs(volume / (4. / 3 * 3.14159265358979) - 1) < 3 * tolerance);
    before = c.triangle_count;
    vs_contour_free(&c);
  }
  if (before >= 2500) fail_msg("%zu triangles", before);
  vs_tape_free(t);
}

static bool stop(void *context, double done) {
  (void)done;
  return --*(int *)context > 0;
}

static void contours_can_be_stopped(void **state) {
  (void)state;
  uint64_t seed = 77;
  vs_tape *t = vs_tape_new(3);
  t->outputs = 1, t->output[0] = waves(t, &seed);
  bool done = false;
  for (int left = 1; !done && left < 10000; left += 1 + left / 3) {
    int turns = left;
    vs_contour c = { 0 };
    vs_contour_outcome outcome = vs_contour_make(t, &(vs_contour_grid){ vs_v3(.1, .1, .1), vs_v3(3, 3, 3), 60, .01 }, (vs_long_work){ stop, &turns }, &c);
    done = outcome == VS_CONTOUR_DONE;
    assert_true(done || outcome == VS_CONTOUR_STOPPED);
    vs_contour_free(&c);
  }
  assert_true(done);
  vs_tape_free(t);
}

static void formulas_as_text(void **state) {
  (void)state;
  vs_tape *t = vs_tape_new(2);
  uint32_t x = vs_tape_input(t, 0), y = vs_tape_input(t, 1);
  t->outputs = 1, t->output[0] = add(t, VS_TAPE_SUB, x, add(t, VS_TAPE_SUB, y, vs_tape_constant(t, -2)));
  bool too_long;
  char *text = vs_formula_text(t, 0, VS_FORMULA_JAVASCRIPT, (const char *const[]){ "x", "y" }, &too_long);
  assert_string_equal(text, "x - (y - (-2))");
  free(text), vs_tape_free(t);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(steps_are_kept_once),
    cmocka_unit_test(batches_give_what_single_points_give),
    cmocka_unit_test(bounds_hold_all_values),
    cmocka_unit_test(ranges_walk_through_grids),
    cmocka_unit_test(contours_are_manifolds),
    cmocka_unit_test(flat_sides_are_few_triangles),
    cmocka_unit_test(round_sides_follow_the_tolerance),
    cmocka_unit_test(contours_can_be_stopped),
    cmocka_unit_test(formulas_as_text),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
