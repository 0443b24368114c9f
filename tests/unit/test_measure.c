/* Tests bounds, contains? and the measures of volume and area: the results must agree with each other and with
 * formulas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geometry/measure/node_measures.h"
#include "geometry/files/polyface.h"
#include "geometry/tessellate.h"

static const double pi = 3.14159265358979323846;

#define NODE(lower, upper, ...) vs_node_new(s, VS_##upper, &(struct vs_##lower){ __VA_ARGS__, 0 }, NULL, 0)

static vs_node *over(vs_store *s, vs_kind kind, const void *data, vs_node *a, vs_node *b) { /* takes over the references to a
                                                                                             * and b */
  vs_ref refs[2] = { { a, NULL }, { b, NULL } };
  vs_node *n = vs_node_new(s, kind, data, refs, b ? 2 : 1);
  vs_node_release(a);
  vs_node_release(b);
  return n;
}

static vs_node *placed(vs_store *s, vs_affine a, vs_node *n) { return over(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = a }, n, NULL); }

static double drawn(uint64_t *seed) { /* returns a random number by xorshift, equal in every run */
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return (double)(*seed >> 11) / 9007199254740992.0;
}

/* Estimates the volume: the fraction of 60,000 random points of the bounding box that are inside. *deviation is four
 * standard deviations. */
static double sampled_volume(const vs_node *n, double *deviation) {
  enum { POINTS = 60000 };
  vs_error e = { 0 };
  vs_bounds b;
  uint64_t seed = 88172645463325252u;
  if (!vs_node_bounds(n, &b, &e)) fail_msg("%s", e.message);
  vs_vec3 d = vs_v3_sub(b.max, b.min);
  vs_inside *v = vs_inside_new(n, &e);
  if (!v) fail_msg("%s", e.message);
  int hits = 0;
  for (int i = 0; i < POINTS; i++) hits += vs_inside_test(v, vs_v3(b.min.x + d.x * drawn(&seed), b.min.y + d.y * drawn(&seed), b.min.z + d.z * drawn(&seed)));
  vs_inside_free(v);
  double share = (double)hits / POINTS, box = d.x * d.y * d.z;
  *deviation = 4 * box * sqrt(share * (1 - share) / POINTS) + 1e-9 * box;
  return share * box;
}

/* Checks that the solid's mesh, its formula, random sample points and its bounds agree. `formula`: whether the volume
 * has a formula. Releases n. */
static void agree(vs_node *n, bool formula) {
  vs_mesh m = { 0 };
  vs_error e = { 0 };
  vs_bounds b, of_mesh;
  vs_measure by_formula, by_mesh;
  assert_true(vs_node_bounds(n, &b, &e));
  vs_fineness f = { vs_bounds_diagonal(&b) / 40000, 0 };
  if (!vs_tessellate(n, &f, &m, &e)) fail_msg("%s", e.message);
  of_mesh = vs_mesh_bounds(&m);
  double slack = vs_bounds_diagonal(&b) * 1e-4, deviation;
  if (vs_v3_length(vs_v3_sub(b.min, of_mesh.min)) > slack || vs_v3_length(vs_v3_sub(b.max, of_mesh.max)) > slack)
    fail_msg("%s: bounds to %g %g %g, mesh to %g %g %g", vs_kind_get((vs_kind)n->kind)->name, b.max.x, b.max.y, b.max.z, of_mesh.max.x, of_mesh.max.y, of_mesh.max.z);
  vs_mesh_measure(&m, &by_mesh);
  double sampled = sampled_volume(n, &deviation);
  if (fabs(sampled - by_mesh.volume) > deviation + 1e-3 * by_mesh.volume) fail_msg("%s: %g by samples, %g by mesh", vs_kind_get((vs_kind)n->kind)->name, sampled, by_mesh.volume);
  assert_true(vs_node_measure(n, &by_formula, &e));
  assert_int_equal(by_formula.known, formula);
  if (formula) {
    assert_true(fabs(by_formula.volume / by_mesh.volume - 1) < 1e-3);
    assert_true(vs_v3_length(vs_v3_sub(by_formula.centroid, by_mesh.centroid)) < slack * 4);
    if (by_formula.area_known) assert_true(fabs(by_formula.area / by_mesh.area - 1) < 2e-3);
  }
  vs_mesh_free(&m);
  vs_node_release(n);
}

static vs_node *curve(vs_store *s, const vs_vec3 *at, size_t n, bool closed) {
  vs_points *p = vs_points_new(s, at, n);
  vs_node *line = NODE(line, LINE, p, closed);
  vs_points_release(s, p);
  return line;
}

static vs_node *example(vs_store *s, int which) {
  vs_vec3 p = { 1, 2, 3 }, q = { 3, 1, 7 }, far = { 3, 5, 7 };
  vs_vec3 l[] = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } };
  vs_vec3 way[] = { { 0, 0, 0 }, { 6, 0, 0 }, { 6, 6, 2 }, { 0, 9, 5 } }, quad[] = { { 0, 0, 0 }, { 2, 0, 1 }, { 2, 3, 1 }, { 0, 3, 0 } };
  uint32_t starts[] = { 0, 4 }, corners[] = { 0, 1, 2, 3 };
  struct vs_extrude up = { .along = { 1, 0, 3 }, .scale = 0.5, .twist = 1 };
  struct vs_sweep plain = { .scale = 1 }, turned = { .scale = 0.3, .twist = 2 };
  struct vs_thicken bar = { .width = 0.8 };
  switch (which) {
    case 0: return NODE(box, BOX, p, far);
    case 1: return NODE(wedge, WEDGE, p, far);
    case 2: return NODE(sphere, SPHERE, p, 2, 0);
    case 3: return NODE(cylinder, CYLINDER, p, q, 2, 0);
    case 4: return NODE(cone, CONE, p, q, 2, 0);
    case 5: return NODE(cut_cone, CUT_CONE, p, 0.5, q, 2, 0);
    case 6: return NODE(pyramid, PYRAMID, p, 2, 5, q, 1);
    case 7: return NODE(torus, TORUS, p, 3, 1, 0);
    case 8: return NODE(torus, TORUS, p, 1, 2, 0);
    case 9: return over(s, VS_EXTRUDE, &up, curve(s, l, 6, true), NULL);
    case 10: return over(s, VS_SWEEP, &plain, curve(s, l, 6, true), curve(s, way, 4, false));
    case 11: return over(s, VS_SWEEP, &turned, curve(s, l, 6, true), NODE(arc, ARC, p, 9, 0, 2, 0));
    case 12: return over(s, VS_THICKEN, &bar, curve(s, way, 4, false), NULL);
    case 13: return over(s, VS_THICKEN, &bar, vs_polyface_make(s, &(vs_polygons){ quad, 4, starts, corners, 1 }, NULL), NULL);
    case 14: return over(s, VS_SWEEP, &plain, NODE(circle, CIRCLE, p, 0.5, 0), NODE(circle, CIRCLE, p, 4, 0));
    case 15: return over(s, VS_EXTRUDE, &(struct vs_extrude){ .along = { 0, 0, 2 }, .scale = 0 }, curve(s, l, 6, true), NULL);
    case 16: return over(s, VS_REVOLVE, &(struct vs_revolve){ .at = { -1, 0, 0 }, .direction = { 0, 1, 0 }, .start = 0.5, .end = 4 }, curve(s, l, 6, true), NULL);
    case 17: return over(s, VS_REVOLVE, &(struct vs_revolve){ .at = { 0, 0, 0 }, .direction = { 1, 0, 0 }, .end = 7 }, curve(s, l, 6, true), NULL);
    case 18: return over(s, VS_EXTRUDE, &(struct vs_extrude){ .along = { 0, 1, 3 }, .scale = 1, .taper = 0.3 }, curve(s, l, 6, true), NULL);
    case 19: return over(s, VS_EXTRUDE, &(struct vs_extrude){ .along = { 0, 1, -2 }, .scale = 1, .taper = -0.3 }, curve(s, l, 6, true), NULL);
    case 20: return over(s, VS_LOFT, &(struct vs_loft){ .start_angle = 0.5, .start_hold = 1 }, curve(s, l, 6, true), NODE(circle, CIRCLE, q, 2, 0));
    case 21: return over(s, VS_RULED_LOFT, NULL, curve(s, l, 6, true), NODE(circle, CIRCLE, q, 2, 0));
    default: return NULL;
  }
}

static void solids_agree(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  for (int i = 0; i < 22; i++) agree(example(s, i), i <= 9 || (i >= 15 && i <= 17));
  vs_store_release(s);
}

static void placed_primitives_have_exact_bounds(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_affine turn = vs_affine_rotation(vs_v3(1, 0, 0), vs_v3(1, 2, 3), 1), uneven = vs_affine_scaling(vs_v3(1, 1, 1), vs_v3(1, 2, -0.5));
  for (int i = 0; i < 9; i++) agree(placed(s, uneven, placed(s, turn, example(s, i))), true);
  vs_store_release(s);
}

static void sets(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  double deviation;
  vs_node *ball = NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0), *drill = NODE(cylinder, CYLINDER, { 0, 0, -2 }, { 0, 0, 2 }, 0.5, 0);
  vs_node *bead = over(s, VS_DIFFERENCE, NULL, vs_node_retain(ball), vs_node_retain(drill));
  assert_true(fabs(sampled_volume(bead, &deviation) - pi / 6 * pow(sqrt(3), 3)) < deviation);
  vs_node *core = over(s, VS_INTERSECTION, NULL, vs_node_retain(ball), vs_node_retain(drill));
  assert_true(fabs(sampled_volume(core, &deviation) - (4 * pi / 3 - pi / 6 * pow(sqrt(3), 3))) < deviation);
  vs_bounds b;
  assert_true(vs_node_bounds(core, &b, NULL) && b.max.x == 0.5 && b.max.z == 1);
  vs_node *pair = over(s, VS_UNION, NULL, bead, placed(s, vs_affine_translation(vs_v3(5, 0, 0)), vs_node_retain(bead)));
  assert_true(fabs(sampled_volume(pair, &deviation) - pi / 3 * pow(sqrt(3), 3)) < deviation);
  vs_node *all[] = { ball, drill, core, pair };
  for (int i = 0; i < 4; i++) vs_node_release(all[i]);
  vs_store_release(s);
}

/* Maps a point as a node's placement does, with more digits. */
static void map_long(const vs_affine *a, long double p[3]) {
  long double q[3];
  for (int i = 0; i < 3; i++) {
    q[i] = a->m[i][3];
    for (int k = 0; k < 3; k++) q[i] += a->m[i][k] * p[k];
  }
  for (int i = 0; i < 3; i++) p[i] = q[i];
}

/* The bounds of a small box far from the origin contain its middle below many turns: the balls that limit boxes count
 * the rounding errors of far coordinates. */
static void far_turns(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  const double far = 1e7, half = 1e-8;
  vs_node *n = NODE(box, BOX, { far - half, far - half, far - half }, { far + half, far + half, far + half });
  long double middle[3] = { far, far, far };
  vs_affine turn = vs_affine_rotation(vs_v3(3, 1, 2), vs_v3(1, 2, 3), 0.7);
  for (int i = 0; i < 60; i++) {
    n = placed(s, turn, n);
    map_long(&turn, middle);
    vs_bounds b;
    assert_true(vs_node_bounds(n, &b, NULL));
    const double low[3] = { b.min.x, b.min.y, b.min.z }, high[3] = { b.max.x, b.max.y, b.max.z };
    for (int k = 0; k < 3; k++) assert_true(low[k] <= middle[k] && middle[k] <= high[k]);
  }
  vs_node_release(n);
  vs_store_release(s);
}

static void deep_and_wide_trees(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  bool inside;
  vs_vec3 o = { 0, 0, 0 };
  vs_node *deep = NODE(sphere, SPHERE, o, 1, 0), *wide = vs_node_retain(deep);
  for (int i = 0; i < 200000; i++) deep = over(s, i % 2 ? VS_UNION : VS_DIFFERENCE, NULL, deep, NULL);
  for (int i = 0; i < 60; i++) wide = over(s, VS_UNION, NULL, vs_node_retain(wide), wide);
  vs_bounds b;
  assert_true(vs_node_bounds(deep, &b, NULL) && b.max.x == 1);
  assert_true(vs_node_bounds(wide, &b, NULL) && b.max.x == 1);
  assert_true(vs_node_contains(deep, o, &inside, NULL) && inside);
  assert_true(vs_node_contains(wide, o, &inside, NULL) && inside);
  vs_node_release(deep);
  vs_node_release(wide);
  vs_store_release(s);
}

static void curves_and_regions(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_measure m;
  vs_node *arc = NODE(arc, ARC, { 1, 2, 3 }, 2, 0, pi / 2, 0);
  assert_true(vs_node_measure(arc, &m, NULL) && m.known && m.length == pi);
  vs_bounds b;
  vs_node *turned = placed(s, vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(0, 0, 1), pi / 4), arc);
  assert_true(vs_node_bounds(turned, &b, NULL) && fabs(b.max.y - 4) < 1e-15 && fabs(b.min.y - (2 + sqrt(2))) < 1e-14);
  vs_node_release(turned);
  vs_node *disc = over(s, VS_REGION, NULL, NODE(circle, CIRCLE, { 1, 2, 3 }, 2, 0), NULL);
  assert_true(vs_node_measure(disc, &m, NULL) && m.area == 4 * pi && fabs(m.centroid.x - 1) < 1e-9);
  vs_node_release(disc);
  vs_vec3 from, to;
  vs_bounds box = { { 0, 0, 0 }, { 2, 2, 2 } };
  assert_true(vs_line_clip(vs_v3(1, 1, 1), vs_v3(1, 0, 0), false, &box, &from, &to) && from.x == 0 && to.x == 2);
  assert_true(vs_line_clip(vs_v3(1, 1, 1), vs_v3(1, 0, 0), true, &box, &from, &to) && from.x == 1 && to.x == 2);
  assert_false(vs_line_clip(vs_v3(1, 3, 1), vs_v3(1, 0, 0), false, &box, &from, &to));
  vs_store_release(s);
}

/* Returns a random map that keeps angles: a rotation about a random axis through a random point; mirrored at times, and
 * a little larger or smaller. */
static vs_affine random_similarity(uint64_t *seed) {
  vs_vec3 axis = vs_v3(drawn(seed) - .5, drawn(seed) - .5, drawn(seed) - .5), at = vs_v3(drawn(seed), drawn(seed), drawn(seed));
  double grow = .98 + .04 * drawn(seed), side = drawn(seed) < .3 ? -grow : grow;
  vs_affine turn = vs_affine_rotation(at, axis, 6.3 * drawn(seed)), size = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(side, grow, grow));
  return vs_affine_multiply(&turn, &size);
}

/* Deep sets, each placed by a map that turns: the bounds contain every corner, and are at most thrice as large as the
 * solid. A box of a box at each level would be 10^40 times as large. */
static void deep_turned_sets(void **state) {
  (void)state;
  enum { DEEP = 300, CORNERS = 8 * DEEP };
  static vs_vec3 corner[CORNERS];
  const vs_kind kinds[] = { VS_UNION, VS_DIFFERENCE, VS_INTERSECTION, VS_LAYER };
  for (uint64_t trial = 1; trial <= 40; trial++) {
    vs_store *s = vs_store_new(NULL, NULL);
    uint64_t seed = trial * 0x9E3779B97F4A7C15u;
    vs_node *n = NODE(box, BOX, { -1, -2, -3 }, { 1, 2, 3 });
    size_t count = 0;
    for (int i = 0; i < 8; i++) corner[count++] = vs_v3(i & 1 ? 1 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -3);
    for (int level = 1; level < DEEP; level++) {
      vs_affine map = random_similarity(&seed);
      n = placed(s, map, n);
      for (size_t i = 0; i < count; i++) corner[i] = vs_affine_point(&map, corner[i]);
      vs_vec3 p = vs_v3(9 * drawn(&seed), 9 * drawn(&seed), 9 * drawn(&seed)), q = vs_v3_add(p, vs_v3(1, 1, 1));
      vs_kind kind = kinds[level % 4];
      if (kind == VS_LAYER) continue;
      n = over(s, kind, NULL, n, kind == VS_INTERSECTION ? NODE(sphere, SPHERE, { 0, 0, 0 }, 1e9, 0) : NODE(box, BOX, p, q));
      for (int i = 0; kind == VS_UNION && i < 8; i++) corner[count++] = vs_v3(i & 1 ? p.x : q.x, i & 2 ? p.y : q.y, i & 4 ? p.z : q.z);
    }
    vs_bounds b, right = vs_bounds_empty();
    vs_error e = { 0 };
    if (!vs_node_bounds(n, &b, &e)) fail_msg("%s", e.message);
    for (size_t i = 0; i < count; i++) vs_bounds_add(&right, corner[i]);
    double size = vs_bounds_diagonal(&right), slack = 1e-9 * size;
    vs_bounds both = b;
    vs_bounds_unite(&both, &right);
    if (vs_bounds_diagonal(&both) > vs_bounds_diagonal(&b) + slack) fail_msg("trial %d: a corner lies outside the bounds", (int)trial);
    if (vs_bounds_diagonal(&b) > 3 * size) fail_msg("trial %d: bounds of %g for a solid of %g", (int)trial, vs_bounds_diagonal(&b), size);
    vs_node_release(n);
    vs_store_release(s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(solids_agree), cmocka_unit_test(placed_primitives_have_exact_bounds), cmocka_unit_test(sets),
    cmocka_unit_test(far_turns), cmocka_unit_test(deep_and_wide_trees), cmocka_unit_test(curves_and_regions),
    cmocka_unit_test(deep_turned_sets),
  };
  return cmocka_run_group_tests_name("geometry bounds, inside, measures", tests, NULL, NULL);
}
