/* Tests geometry/ when memory runs out: each of its calls of malloc or realloc fails in turn. The result is an error of
 * kind memory, and no memory is lost. This program replaces the C library's allocator; if a sanitizer has already
 * replaced it, the test is skipped. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geometry/measure/node_measures.h"
#include "geometry/files/polyface.h"
#include "geometry/nets/plan_ways.h"
#include "geometry/plane/skeleton.h"
#include "geometry/structure/structure_modes.h"
#include "geometry/tessellate.h"
#include "tests/unit/allocator.h"
#include "tests/unit/skip.h"

static size_t fail_at, held; /* fail_at: 1 + number of allocations until one fails; 0: none fails. held: number of
                              * allocated blocks, counted only while fail_at is not 0 */

#if REPLACED
static bool refused(void) {
  if (!fail_at) return false;
  if (fail_at > 1) return fail_at--, held++, false;
  return true; /* this allocation fails, and so do all later allocations */
}
void *malloc(size_t n) { return refused() ? NULL : __libc_malloc(n); }
void *calloc(size_t n, size_t size) { return refused() ? NULL : __libc_calloc(n, size); }
void *realloc(void *p, size_t n) {
  if (!refused()) {
    if (fail_at && p) held--; /* realloc releases the block p */
    return __libc_realloc(p, n);
  }
  return NULL;
}
void free(void *p) {
  if (fail_at && p) held--;
  __libc_free(p);
}
#endif

#define NODE(lower, upper, ...) vs_node_new(s, VS_##upper, &(struct vs_##lower){ __VA_ARGS__, 0 }, NULL, 0)

static vs_node *over(vs_store *s, vs_kind kind, const void *data, vs_node *a, vs_node *b) { /* takes over the references to a
                                                                                             * and b */
  vs_ref refs[2] = { { a, NULL }, { b, NULL } };
  vs_node *n = vs_node_new(s, kind, data, refs, b ? 2 : 1);
  vs_node_release(a);
  vs_node_release(b);
  return n;
}

static vs_node *curve(vs_store *s, bool spline) {
  vs_vec3 at[] = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 2, 0 }, { 1, 2, 0 } };
  vs_points *p = vs_points_new(s, at, 4);
  vs_node *n = spline ? NODE(spline, SPLINE, p, true, { 0, 0, 0 }, { 0, 0, 0 }, 0) : NODE(line, LINE, p, true);
  vs_points_release(s, p);
  return n;
}

static bool task(const vs_node *n, vs_error *e) {
  vs_fineness f = { 0.01, 0 };
  vs_mesh m = { 0 };
  vs_bounds b;
  bool inside, closed_ok, ok = vs_tessellate(n, &f, &m, e);
  if (ok && !vs_mesh_closed(&m, &closed_ok)) ok = closed_ok ? vs_error_set(e, VS_ERROR_MODEL, NULL, "open") : vs_error_memory(e, NULL);
  vs_mesh_free(&m);
  return ok && vs_node_bounds(n, &b, e) && vs_node_contains(n, vs_v3(1, 1, 1), &inside, e);
}

static void run_short(const vs_node *n) {
  bool done = false;
  size_t tries = 1;
  for (; !done; tries++) {
    vs_error e = { 0 };
    held = 0;
    fail_at = tries;
    done = task(n, &e);
    fail_at = 0;
    if (!done && e.kind != VS_ERROR_MEMORY) fail_msg("%s", e.message);
    assert_int_equal(held, 0);
    assert_true(tries < 5000);
  }
  assert_true(tries > 4);
}

static void every_allocation_fails_in_turn(void **state) {
  (void)state;
  if (!REPLACED) SKIP_TEST("a sanitizer has replaced the allocator");
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 quad[] = { { 0, 0, 0 }, { 2, 0, 1 }, { 2, 3, 1 }, { 0, 3, 0 } };
  uint32_t starts[] = { 0, 4 }, corners[] = { 0, 1, 2, 3 };
  struct vs_extrude up = { .along = { 0, 0, 3 }, .scale = 1, .twist = 0.5 };
  struct vs_sweep plain = { .scale = 1 };
  struct vs_thicken thick = { .width = 0.5 };
  vs_node *hole = NODE(circle, CIRCLE, { 2, 1, 0 }, 0.5, 0);
  vs_ref loops[] = { { curve(s, false), NULL }, { hole, NULL } };
  vs_node *region = vs_node_new(s, VS_REGION, NULL, loops, 2);
  vs_node_release(loops[0].node);
  vs_node_release(hole);
  vs_node *all[] = { NODE(torus, TORUS, { 0, 0, 0 }, 3, 1, 0), over(s, VS_EXTRUDE, &up, region, NULL), over(s, VS_SWEEP, &plain, NODE(circle, CIRCLE, { 0, 0, 0 }, 0.2, 0), curve(s, true)),
                     over(s, VS_THICKEN, &thick, curve(s, false), NULL), over(s, VS_THICKEN, &thick, vs_polyface_make(s, &(vs_polygons){ quad, 4, starts, corners, 1 }, NULL), NULL),
                     over(s, VS_REVOLVE, &(struct vs_revolve){ .direction = { 0, 1, 0 }, .end = 4 }, NODE(circle, CIRCLE, { 3, 0, 0 }, 1, 0), NULL),
                     over(s, VS_EXTRUDE, &(struct vs_extrude){ .along = { 0, 0, 1 }, .scale = 1, .taper = 0.5 }, NODE(circle, CIRCLE, { 3, 0, 0 }, 1, 6), NULL),
                     over(s, VS_LOFT, &(struct vs_loft){ .start_angle = 1, .start_hold = 1 }, NODE(circle, CIRCLE, { 0, 0, 0 }, 1, 0), NODE(circle, CIRCLE, { 0, 0, 3 }, 1, 6)),
                     over(s, VS_RULED_LOFT, NULL, NODE(circle, CIRCLE, { 0, 0, 0 }, 1, 0), NODE(circle, CIRCLE, { 0, 0, 3 }, 1, 6)) };
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    run_short(all[i]);
    vs_node_release(all[i]);
  }
  vs_store_release(s);
}

static void making_a_polyface_fails_in_turn(void **state) {
  (void)state;
  if (!REPLACED) SKIP_TEST("a sanitizer has replaced the allocator");
  vs_vec3 cube[8];
  for (int i = 0; i < 8; i++) cube[i] = vs_v3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  uint32_t starts[] = { 0, 4, 8, 12, 16, 20, 24 }, inward[] = { 0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3 };
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *n = NULL;
  for (size_t tries = 1; !n; tries++) {
    vs_error e = { 0 };
    size_t bytes = vs_store_bytes(s);
    held = 0;
    fail_at = tries;
    n = vs_polyface_make(s, &(vs_polygons){ cube, 8, starts, inward, 6 }, &e);
    fail_at = 0;
    if (!n) assert_true(e.kind == VS_ERROR_MEMORY && held == 0 && vs_store_bytes(s) == bytes);
  }
  vs_node_release(n);
  vs_store_release(s);
}

static bool going(void *context, double done) { return !context && done >= 0; }

static void making_a_skeleton_fails_in_turn(void **state) {
  (void)state;
  if (!REPLACED) SKIP_TEST("a sanitizer has replaced the allocator");
  vs_vec2 at[] = { { 0, 0 }, { 5, 0 }, { 9, 0 }, { 9, 6 }, { 0, 6 }, { 4, 2 }, { 5, 2 }, { 4, 3 } };
  double speed[] = { 1, 2, 1, 1, 0, 1, 1, 1 }; /* a profile with a step, a gable and a hole */
  size_t size[] = { 5, 3 }, where[2], tries = 1;
  vs_skeleton_outcome outcome = VS_SKELETON_MEMORY;
  for (; outcome == VS_SKELETON_MEMORY; tries++) {
    vs_skeleton k;
    held = 0;
    fail_at = tries;
    outcome = vs_skeleton_make(&(vs_skeleton_outline){ at, speed, size, 2 }, (vs_long_work){ going, NULL }, &k, where);
    if (outcome == VS_SKELETON_DONE) vs_skeleton_free(&k);
    fail_at = 0;
    assert_int_equal(held, 0);
    assert_true(tries < 5000);
  }
  assert_int_equal(outcome, VS_SKELETON_DONE);
  assert_true(tries > 20);
}

/* Refuses allocations while a structure is solved. CHOLMOD, a library that is loaded on demand, allocates from the C
 * library directly, so only the allocations of geometry/ fail. */
static void solving_a_structure_fails_in_turn(void **state) {
  (void)state;
  if (!REPLACED) SKIP_TEST("a sanitizer has replaced the allocator");
  const vs_vec3 at[] = { { 0, 0, 0 }, { 0, 0, 3 }, { 4, 0, 3 }, { 4, 0, 0 } };
  vs_structure_member members[3];
  for (uint32_t i = 0; i < 3; i++)
    members[i] = (vs_structure_member){ .from = i, .to = i + 1, .area = 1e-3, .bend_y = 1e-6, .bend_z = 1e-6, .twist = 2e-6, .modulus = 210e9, .shear = 81e9 };
  bool held_ways[4 * VS_WAYS] = { 0 }, loose[4], free_ways[4 * VS_WAYS] = { 0 };
  for (size_t i = 0; i < VS_WAYS; i++) held_ways[i] = held_ways[3 * VS_WAYS + i] = free_ways[i < 3 ? i : 0] = true;
  double loads[4 * VS_WAYS] = { 0 }, lines[9] = { 0, 0, -9 }, moved[4 * VS_WAYS], ends[3 * VS_MEMBER_WAYS], reactions[4 * VS_WAYS];
  loads[VS_WAYS] = 1000;
  double plates[6];
  const vs_structure_plate plate = { { 0, 1, 2 }, 0.02, 210e9, 0.3 };
  vs_structure_state out = { moved, ends, reactions, plates, loose };
  for (int mechanism = 0; mechanism < 2; mechanism++) {
    vs_structure s = { .at = at, .count = 4, .members = members, .member_count = 3, .plates = &plate, .plate_count = mechanism ? 0 : 1,
                       .held = mechanism ? free_ways : held_ways, .cases = 1, .loads = loads, .lines = lines };
    vs_structure_report report;
    vs_error e = { 0 };
    vs_structure_outcome wanted = mechanism ? VS_STRUCTURE_MOVES : VS_STRUCTURE_DONE, outcome = VS_STRUCTURE_FAILED;
    if (vs_structure_solve(&s, &out, (vs_long_work){ 0 }, &report, &e) == VS_STRUCTURE_FAILED && e.kind == VS_ERROR_WORKER) SKIP_TEST("no CHOLMOD here");
    size_t tries = 1;
    for (; outcome != wanted; tries++) {
      held = 0;
      fail_at = tries;
      outcome = vs_structure_solve(&s, &out, (vs_long_work){ 0 }, &report, &e);
      fail_at = 0;
      assert_true(outcome == wanted || (outcome == VS_STRUCTURE_FAILED && e.kind == VS_ERROR_MEMORY));
      assert_int_equal(held, 0);
      assert_true(tries < 5000);
    }
    assert_true(tries > 6);
    if (mechanism) assert_int_equal(report.where, 3);
    else assert_true(reactions[0] < 0 && moved[VS_WAYS] > 0);
    const double axial[6] = { -1000, -1000, 0, 0, -1000, -1000 };
    double values[2], shapes[2 * 3 * 5 * 3];
    size_t found = 0;
    vs_modes_problem modes = { &s, axial, NULL, NULL, 4, 2 };
    for (tries = 1, outcome = VS_STRUCTURE_FAILED; outcome != wanted; tries++) {
      held = 0;
      fail_at = tries;
      outcome = vs_structure_modes(&modes, (vs_long_work){ 0 }, values, shapes, &found, &report, &e);
      fail_at = 0;
      assert_true(outcome == wanted || (outcome == VS_STRUCTURE_FAILED && e.kind == VS_ERROR_MEMORY));
      assert_int_equal(held, 0);
    }
    assert_true(tries > 10 && (mechanism || (found == 2 && values[0] > 0 && values[1] >= values[0])));
  }
}

static void ways_and_views_fail_in_turn(void **state) {
  (void)state;
  if (!REPLACED) SKIP_TEST("a sanitizer has replaced the allocator");
  const vs_vec2 at[] = { { 0, 0 }, { 9, 0 }, { 9, 6 }, { 0, 6 }, { 4, 1 }, { 4, 5 }, { 6, 5 }, { 6, 1 } }, exit = { 9, 3 };
  const size_t size[] = { 4, 4 }, room[] = { 0, 0 };
  const vs_plan plan = { at, 8, size, room, 2, 1 };
  vs_plan_place *places = NULL;
  size_t count = 0, tries = 1;
  for (vs_plan_outcome outcome = VS_PLAN_MEMORY; outcome != VS_PLAN_DONE; tries++) {
    held = 0;
    fail_at = tries;
    outcome = vs_plan_ways(&plan, &exit, 1, NULL, 0, (vs_long_work){ 0 }, &places, &count);
    if (outcome != VS_PLAN_DONE) free(places);
    fail_at = 0;
    assert_true(outcome == VS_PLAN_DONE || (outcome == VS_PLAN_MEMORY && held == 0));
  }
  assert_true(tries > 2 && count == 5);
  double far = 0;
  uint32_t first = 0;
  vs_vec2 *view = NULL, from = { 1, 3 };
  for (tries = 1, fail_at = 1; !vs_plan_way(&plan, places, count, from, &far, &first); fail_at = ++tries) {}
  for (tries = 1, fail_at = 1; !vs_plan_view(&plan, from, &view, &count); fail_at = ++tries) free(view);
  fail_at = 0;
  assert_true(fabs(far - (2 * sqrt(13) + 2)) < 1e-12 && count > 4);
  free(view), free(places);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(every_allocation_fails_in_turn), cmocka_unit_test(making_a_polyface_fails_in_turn),
                                      cmocka_unit_test(making_a_skeleton_fails_in_turn), cmocka_unit_test(solving_a_structure_fails_in_turn),
                                      cmocka_unit_test(ways_and_views_fail_in_turn) };
  return cmocka_run_group_tests_name("geometry short of memory", tests, NULL, NULL);
}
