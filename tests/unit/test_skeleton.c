/* Tests straight skeletons (roofs) of outlines with a known solution, and of random outlines with holes. For each
 * random outline, every face of the roof is planar with the right slope. GEOS checks that the union of the faces is
 * the outline, and that the faces' areas add up to the outline's area. LONG=1 tests 1,000 outlines of each family,
 * else 50. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/plane/areas.h"
#include "geometry/plane/skeleton.h"

enum { MOST = 400, LOOPS = 40, CELLS = 6 };

typedef struct {
  vs_vec2 at[MOST];
  double speed[MOST];
  size_t size[LOOPS], loops, count, from[MOST], to[MOST]; /* from[e], to[e]: numbers of the corners of edge e */
} shape;

static uint64_t seed;
static double dice(void) { /* returns a random number, at least 0 and less than 1 */
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(seed >> 11) / 9007199254740992.0;
}
static size_t pick(size_t n) { return (size_t)(dice() * (double)n); }

static void add_loop(shape *s, const vs_vec2 *at, size_t n, bool back) {
  assert_true(s->count + n <= MOST && s->loops < LOOPS);
  for (size_t i = 0; i < n; i++) {
    size_t k = s->count + i;
    s->at[k] = at[back ? n - 1 - i : i];
    s->speed[k] = 1;
    s->from[k] = k, s->to[k] = s->count + (i + 1) % n;
  }
  s->count += n, s->size[s->loops++] = n;
}

static bool going(void *context, double done) { return !context && done >= 0 && done <= 1; }

static vs_skeleton_outcome make(const shape *s, vs_skeleton *out, size_t where[2]) {
  return vs_skeleton_make(&(vs_skeleton_outline){ s->at, s->speed, s->size, s->loops }, (vs_long_work){ going, NULL },
                          out, where);
}

static double size_of(const vs_area *a) {
  double sum = 0;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 o = a->at[first], p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      sum += ((p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x)) / 2;
    }
  return sum;
}

static void combine(vs_area_operation operation, const vs_area *operands, size_t n, vs_area *out) {
  vs_error e = { 0 };
  *out = (vs_area){ 0 };
  if (!vs_area_combine(operation, operands, n, "tests", out, &e)) fail_msg("%s", e.message);
}

/* Computes the area of a shape in the plane; the winding number of its edges decides which points are inside. Loops may
 * run in either direction. */
static void shape_area(const shape *s, vs_area *out) {
  *out = (vs_area){ 0 };
  for (size_t l = 0, first = 0; l < s->loops; first += s->size[l++]) {
    vs_area one = { 0 }, met, both[2];
    for (size_t i = 0; i < s->size[l]; i++) assert_true(vs_area_point(&one, s->at[first + i].x, s->at[first + i].y));
    assert_true(vs_area_loop(&one, false));
    if (size_of(&one) < 0) {
      vs_area_free(&one), one = (vs_area){ 0 };
      for (size_t i = s->size[l]; i-- > 0;) assert_true(vs_area_point(&one, s->at[first + i].x, s->at[first + i].y));
      assert_true(vs_area_loop(&one, false));
    }
    both[0] = *out, both[1] = one;
    if (!l) { *out = one; continue; }
    combine(VS_AREA_INTERSECTION, both, 2, &met);
    bool hole = size_of(&met) > 0;
    vs_area_free(&met);
    combine(hole ? VS_AREA_DIFFERENCE : VS_AREA_UNION, both, 2, &met);
    vs_area_free(&one), vs_area_free(out);
    *out = met;
  }
}

/* Checks that p lies in the plane of the roof's face above edge e. */
static void in_plane(const shape *s, size_t e, bool left, vs_vec3 p, double size) {
  vs_vec2 a = s->at[s->from[e]], b = s->at[s->to[e]];
  double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy);
  double far = ((p.y - a.y) * dx - (p.x - a.x) * dy) / length * (left ? 1 : -1);
  if (fabs(far - s->speed[e] * p.z) > 1e-6 * size) fail_msg("edge %zu: %g, not %g", e, far, s->speed[e] * p.z);
}

static bool inside_left(const shape *s, const vs_area *whole, size_t e) {
  vs_vec2 a = s->at[s->from[e]], b = s->at[s->to[e]];
  double dx = b.x - a.x, dy = b.y - a.y;
  return vs_area_holds(whole, (a.x + b.x) / 2 - 1e-4 * dy, (a.y + b.y) / 2 + 1e-4 * dx);
}

/* Tests the faces of a shape's roof. Returns false if the speeds of the edges (the inverse slopes of the faces) do not
 * give a closed roof. */
static bool judge(const shape *s) {
  vs_skeleton k;
  size_t where[2], areas = 0;
  vs_skeleton_outcome outcome = make(s, &k, where);
  if (outcome == VS_SKELETON_OPEN) return false;
  if (outcome != VS_SKELETON_DONE) fail_msg("outcome %d, edges %zu and %zu", outcome, where[0], where[1]);
  vs_area whole, joined, *faces = calloc(k.face_count + 1, sizeof *faces);
  assert_non_null(faces);
  shape_area(s, &whole);
  double sum = 0, all = size_of(&whole);
  for (size_t f = 0; f < k.face_count; f++) {
    const vs_skeleton_face *face = &k.face[f];
    bool level = face->edge != VS_SKELETON_STEP && s->speed[face->edge] > 0;
    bool left = level && inside_left(s, &whole, face->edge);
    for (size_t i = 0; i < face->count; i++) {
      vs_vec3 p = k.at[k.corner[face->first + i]];
      if (level) in_plane(s, face->edge, left, p, sqrt(all));
      if (level) assert_true(vs_area_point(&faces[areas], p.x, p.y));
    }
    if (!level) continue;
    assert_true(vs_area_loop(&faces[areas], false));
    double own = size_of(&faces[areas]);
    if (!(own > -1e-9 * all)) fail_msg("face of edge %zu has the area %g", face->edge, own);
    sum += own, areas++;
  }
  combine(VS_AREA_UNION, faces, areas, &joined);
  double got = size_of(&joined);
  if (fabs(sum - all) > 1e-7 * all) fail_msg("faces %g, outline %g", sum, all);
  if (fabs(got - all) > 1e-6 * all) fail_msg("union of the faces %g, outline %g", got, all);
  for (size_t f = 0; f < areas; f++) vs_area_free(&faces[f]);
  vs_area_free(&whole), vs_area_free(&joined), vs_skeleton_free(&k), free(faces);
  return true;
}

/* ---- families of outlines ---- */

static void star(shape *s, double radius, vs_vec2 middle, size_t n, bool back) {
  vs_vec2 at[64];
  for (size_t i = 0; i < n; i++) {
    double angle = 6.283185307179586 * ((double)i + 0.6 * dice()) / (double)n, far = radius * (0.35 + 0.65 * dice());
    at[i] = (vs_vec2){ middle.x + far * cos(angle), middle.y + far * sin(angle) };
  }
  add_loop(s, at, n, back);
}

/* Makes a star, with a hole or two within the circle through its inner corners. */
static void random_stars(shape *s) {
  star(s, 10, (vs_vec2){ 0, 0 }, 4 + pick(40), pick(2));
  if (s->size[0] < 8) return;
  size_t holes = pick(3);
  if (holes > 0) star(s, 1.0, (vs_vec2){ 1.3, 0 }, 3 + pick(8), pick(2));
  if (holes > 1) star(s, 1.0, (vs_vec2){ -1.3, 0.2 }, 3 + pick(8), pick(2));
}

/* Fills cells until no two cells touch in a corner alone. */
static void fill_corners(bool on[CELLS][CELLS]) {
  bool again = true;
  while (again) {
    again = false;
    for (int x = 0; x + 1 < CELLS; x++)
      for (int y = 0; y + 1 < CELLS; y++)
        if (on[x][y] == on[x + 1][y + 1] && on[x + 1][y] == on[x][y + 1] && on[x][y] != on[x + 1][y])
          on[x][y] = on[x + 1][y] = again = true;
  }
}

/* Makes an outline of random cells of a grid: as the roof grows, many edges meet at one time. */
static void random_cells(shape *s) {
  vs_area cells[CELLS * CELLS] = { { 0 } }, joined;
  size_t n = 0;
  double tilt = pick(2) ? 0.3 : 0;
  bool on[CELLS][CELLS];
  for (int x = 0; x < CELLS; x++)
    for (int y = 0; y < CELLS; y++) on[x][y] = dice() < 0.6;
  fill_corners(on);
  for (int x = 0; x < CELLS; x++)
    for (int y = 0; y < CELLS; y++) {
      if (!on[x][y]) continue;
      for (int c = 0; c < 4; c++) {
        double u = x + (c == 1 || c == 2), v = y + (c > 1);
        assert_true(vs_area_point(&cells[n], u * cos(tilt) - v * sin(tilt), u * sin(tilt) + v * cos(tilt)));
      }
      assert_true(vs_area_loop(&cells[n++], false));
    }
  combine(VS_AREA_UNION, cells, n, &joined);
  for (size_t l = 0, first = 0; l < joined.loop_count; first += joined.size[l++])
    add_loop(s, joined.at + first, joined.size[l], false);
  for (size_t i = 0; i < n; i++) vs_area_free(&cells[i]);
  vs_area_free(&joined);
}

static void even_speeds(shape *s) { (void)s; }
static void any_speeds(shape *s) {
  for (size_t i = 0; i < s->count; i++) s->speed[i] = 0.3 + 2 * dice();
}
static void few_speeds(shape *s) {
  static const double few[] = { 0.5, 1, 1, 2 };
  for (size_t i = 0; i < s->count; i++) s->speed[i] = few[pick(4)];
}
static void gables(shape *s) {
  for (size_t i = 0; i < s->count; i++) s->speed[i] = pick(5) ? 1 : 0;
}

static void many(void (*outline)(shape *), void (*speeds)(shape *), const char *name) {
  const char *only = getenv("SEEDS"), *longer = getenv("LONG");
  uint64_t first = only && *only ? strtoull(only, NULL, 10) : 1;
  uint64_t last = only && *only ? first : longer && *longer ? 1000 : 50, more = last == 50;
  size_t closed = 0, rings = 0;
  for (uint64_t n = first; n <= last + more; n++) {
    uint64_t i = n <= last ? n : 266; /* the last run uses star number 266, of which GEOS loses a face */
    shape s = { .count = 0 };
    vs_skeleton k;
    size_t where[2];
    seed = i * 7919;
    outline(&s), speeds(&s);
    vs_skeleton_outcome outcome = make(&s, &k, where);
    if (outcome == VS_SKELETON_DONE) vs_skeleton_free(&k);
    rings += outcome == VS_SKELETON_RING;
    if (outcome == VS_SKELETON_RING && speeds != even_speeds) continue;
    if (outcome != VS_SKELETON_DONE && outcome != VS_SKELETON_OPEN)
      fail_msg("%s: SEEDS=%llu: outcome %d", name, (unsigned long long)i, outcome);
    closed += judge(&s);
  }
  if (rings > 5) fail_msg("%s: %zu outlines have faces with holes", name, rings);
  if (!only && closed < last / 3) fail_msg("%s: only %zu of %llu closed", name, closed, (unsigned long long)last);
}

#define FAMILY(name, outline, speeds) static void name(void **state) { (void)state; many(outline, speeds, #name); }
FAMILY(test_stars, random_stars, even_speeds)
FAMILY(test_stars_of_any_speeds, random_stars, any_speeds)
FAMILY(test_cells, random_cells, even_speeds)
FAMILY(test_cells_of_few_speeds, random_cells, few_speeds)
FAMILY(test_stars_with_gables, random_stars, gables)
FAMILY(test_cells_with_gables, random_cells, gables)

/* ---- roofs whose height is known ---- */

static double top(const shape *s) {
  vs_skeleton k;
  size_t where[2];
  double high = 0;
  assert_int_equal(make(s, &k, where), VS_SKELETON_DONE);
  for (size_t i = 0; i < k.count; i++) high = fmax(high, k.at[i].z);
  vs_skeleton_free(&k);
  return high;
}

static void test_closed_forms(void **state) {
  (void)state;
  shape s = { .count = 0 };
  vs_vec2 box[] = { { 0, 0 }, { 6, 0 }, { 6, 4 }, { 0, 4 } }, hole[] = { { 1, 1 }, { 5, 1 }, { 5, 3 }, { 1, 3 } };
  add_loop(&s, box, 4, false);
  assert_true(fabs(top(&s) - 2) < 1e-12); /* hipped roof: its height is half the rectangle's width */
  s.speed[1] = s.speed[3] = 0;
  assert_true(fabs(top(&s) - 2) < 1e-12 && judge(&s)); /* vertical gables at two ends do not change the height of the
                                                        * ridge */
  s.speed[0] = 3;
  assert_true(fabs(top(&s) - 1) < 1e-12 && judge(&s)); /* faces with the speeds 3 and 1 meet at the height t = 1, since
                                                        * 3 t + t equals the width 4 */
  s.speed[0] = s.speed[2] = 0, s.speed[1] = 2;
  assert_true(fabs(top(&s) - 3) < 1e-12 && judge(&s)); /* a shed roof: a single sloping side */
  s.speed[1] = 0;
  vs_skeleton k;
  size_t where[2];
  assert_int_equal(make(&s, &k, where), VS_SKELETON_OPEN);
  for (int i = 0; i < 4; i++) s.speed[i] = 1;
  add_loop(&s, hole, 4, false);
  assert_true(fabs(top(&s) - 0.5) < 1e-12 && judge(&s)); /* a ring of width 1 has a roof of height 1/2 */
}

static void test_steps(void **state) { /* two edges on one line have different speeds, so a vertical step separates
                                        * their faces */
  (void)state;
  shape s = { .count = 0 };
  vs_vec2 box[] = { { 0, 0 }, { 3, 0 }, { 6, 0 }, { 6, 4 }, { 0, 4 } };
  add_loop(&s, box, 5, false);
  s.speed[1] = 2;
  assert_true(judge(&s));
  vs_skeleton k;
  size_t where[2];
  assert_int_equal(make(&s, &k, where), VS_SKELETON_DONE);
  assert_true(k.face[k.face_count - 1].edge == VS_SKELETON_STEP);
  vs_skeleton_free(&k);
}

static void test_stopped(void **state) {
  (void)state;
  shape s = { .count = 0 };
  vs_vec2 box[] = { { 0, 0 }, { 6, 0 }, { 6, 4 }, { 0, 4 } };
  add_loop(&s, box, 4, false);
  vs_skeleton k;
  size_t where[2];
  vs_skeleton_outline o = { s.at, s.speed, s.size, 1 };
  assert_int_equal(vs_skeleton_make(&o, (vs_long_work){ going, &s }, &k, where), VS_SKELETON_STOPPED);
}

static void test_crossing(void **state) {
  (void)state;
  static const vs_vec2 bad[][4] = { { { 0, 0 }, { 4, 4 }, { 4, 0 }, { 0, 4 } },
                                    { { 0, 0 }, { 4, 0 }, { 1, 0 }, { 1, 4 } },
                                    { { 0, 0 }, { 0, 0 }, { 1, 0 }, { 1, 4 } },
                                    { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 2, 0 } } };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    shape s = { .count = 0 };
    vs_skeleton k;
    size_t where[2];
    add_loop(&s, bad[i], 4, false);
    assert_int_equal(make(&s, &k, where), VS_SKELETON_CROSSES);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_closed_forms),        cmocka_unit_test(test_steps),
    cmocka_unit_test(test_stopped),
    cmocka_unit_test(test_crossing),            cmocka_unit_test(test_stars),
    cmocka_unit_test(test_stars_of_any_speeds), cmocka_unit_test(test_cells),
    cmocka_unit_test(test_cells_of_few_speeds), cmocka_unit_test(test_stars_with_gables),
    cmocka_unit_test(test_cells_with_gables),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
