/* Tests that a sweep is the union of all positions of its profile, for all bends, twists and overlaps with itself.
 *
 * Random profiles move along random paths, with random twists, scales and base points; most sweeps overlap themselves.
 * The test compares each sweep with a formula that uses no mesh (geometry/measure/inside.c): a point between two
 * sections is inside. At random points the solid's mesh must agree with the formula, except within a few tolerances of
 * its surface. The mesh's volume must equal the measured volume. The mesh is closed, and after rounding to the numbers
 * of .off and .stl no two of its triangles intersect.
 *
 * A sweep that does not overlap itself is never refused. At most one in twenty overlapping sweeps is refused, by an
 * error that names the bend. Tests a sample of some 30 small sweeps, with LONG=1 two thousand of any size, or those of
 * SEEDS=FROM-TO; TELL=1 prints the results. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "geometry/measure/bounds.h"
#include "geometry/measure/inside.h"
#include "geometry/measure/ray_crossings.h"
#include "geometry/tessellate.h"
#include "kernel/round/rounding.h"
#include "model/store/cache.h"
#include "solids/overlaps.h"
#include "solids/primitive_meshes.h"
#include "solids/solid_measures.h"
#include "solids/solid_meshes.h"
#include "tests/unit/dice.h"
#include "tests/unit/seeds.h"

enum { POINTS = 1500 };
static const double pi = 3.14159265358979323846;

static int any(dice *d, int n) { return (int)(throw(d) % (uint64_t)n); }

#define NODE(lower, upper, ...) vs_node_new(s, VS_##upper, &(struct vs_##lower){ __VA_ARGS__, 0 }, NULL, 0)

/* ---- profiles and paths ---- */

static vs_node *through(vs_store *s, vs_kind kind, const vs_vec3 *at, size_t n, bool closed) {
  vs_points *p = vs_points_new(s, at, n);
  vs_node *curve = kind == VS_LINE ? NODE(line, LINE, p, closed) : vs_node_new(s, VS_SPLINE, &(struct vs_spline){ .points = p, .closed = closed }, NULL, 0);
  vs_points_release(s, p);
  return curve;
}

static vs_node *rectangle(vs_store *s, double x, double y, double w, double h) {
  vs_vec3 at[] = { { x, y, 0 }, { x + w, y, 0 }, { x + w, y + h, 0 }, { x, y + h, 0 } };
  return through(s, VS_LINE, at, 4, true);
}

static vs_node *profile(vs_store *s, dice *d, double r) {
  vs_vec3 at[12];
  switch (any(d, 6)) {
  case 0: return NODE(circle, CIRCLE, { 0, 0, 0 }, r, 0);
  case 1: { /* makes a regular polygon */
    int n = 3 + any(d, 6);
    for (int i = 0; i < n; i++) at[i] = vs_v3(r * cos(2 * pi * i / n), r * sin(2 * pi * i / n), 0);
    return through(s, VS_LINE, at, (size_t)n, true);
  }
  case 2: { /* makes a star, which is not convex */
    int n = 6 + 2 * any(d, 3);
    for (int i = 0; i < n; i++) at[i] = vs_v3(r * (i % 2 ? .4 : 1) * cos(2 * pi * i / n), r * (i % 2 ? .4 : 1) * sin(2 * pi * i / n), 0);
    return through(s, VS_LINE, at, (size_t)n, true);
  }
  case 3: { /* makes a frame, which has a hole */
    double w = between(d, r, 2 * r), h = between(d, r, 2 * r);
    vs_ref loops[] = { { rectangle(s, 0, 0, w, h), NULL }, { rectangle(s, w * .2, h * .2, w * .5, h * .6), NULL } };
    vs_node *region = vs_node_new(s, VS_REGION, NULL, loops, 2);
    for (int i = 0; i < 2; i++) vs_node_release(loops[i].node);
    return region;
  }
  case 4: { /* makes an L */
    double w = between(d, r, 2 * r), h = between(d, r, 2 * r), t = between(d, .1, .6) * r;
    vs_vec3 l[] = { { 0, 0, 0 }, { w, 0, 0 }, { w, t, 0 }, { t, t, 0 }, { t, h, 0 }, { 0, h, 0 } };
    return through(s, VS_LINE, l, 6, true);
  }
  default: return rectangle(s, 0, 0, between(d, .2, 2) * r, between(d, .2, 2) * r);
  }
}

static vs_node *path(vs_store *s, dice *d, bool corners) {
  vs_vec3 at[8];
  int n = 3 + any(d, 4), which = corners ? 2 : any(d, 6);
  bool flat = any(d, 3) == 0;
  if (which == 0) return NODE(circle, CIRCLE, { 0, 0, 0 }, between(d, .2, 2), 0);
  if (which == 1) return NODE(arc, ARC, { 0, 0, 0 }, between(d, .2, 2), 0, between(d, 1, 6), 0);
  for (int i = 0; i < n; i++) {
    bool good = false; /* whether all neighbouring points are clearly apart */
    while (!good) {
      at[i] = vs_v3(between(d, -2, 2), between(d, -2, 2), flat ? 0 : between(d, -2, 2));
      good = (!i || vs_v3_length(vs_v3_sub(at[i], at[i - 1])) > .3) && (i + 1 < n || vs_v3_length(vs_v3_sub(at[i], at[0])) > .3);
    }
  }
  return through(s, which == 2 ? VS_LINE : VS_SPLINE, at, (size_t)n, any(d, 4) == 0);
}

/* corners: true for a line with corners as path, and a profile that turns */
static vs_node *sweep(vs_store *s, uint64_t seed, bool corners) {
  dice d = { seed * 7919 };
  struct vs_sweep data = { .scale = any(&d, 3) ? 1 : between(&d, 0, 2), .twist = any(&d, 2) ? 0 : any(&d, 4) ? between(&d, -6, 6) : pi / 2 * any(&d, 5) };
  if (corners) data.twist = between(&d, 1, 6);
  double r = between(&d, 0, 1);
  r = .05 + r * r * 1.2; /* squares the random number, so that thin profiles are frequent */
  vs_ref children[2] = { { profile(s, &d, r), NULL }, { NULL, NULL } };
  children[1].node = path(s, &d, corners);
  if (any(&d, 6) == 0) data.has_base = true, data.base = vs_v3(between(&d, -r, r), between(&d, -r, r), 0);
  vs_node *n = vs_node_new(s, VS_SWEEP, &data, children, 2);
  for (int i = 0; i < 2; i++) vs_node_release(children[i].node);
  return n;
}

/* ---- distance of a point from the surface ---- */

static double from_segment(vs_vec3 p, vs_vec3 a, vs_vec3 b) {
  vs_vec3 d = vs_v3_sub(b, a);
  double along = vs_v3_dot(d, d), t = along > 0 ? vs_v3_dot(vs_v3_sub(p, a), d) / along : 0;
  return vs_v3_length(vs_v3_sub(p, vs_v3_add(a, vs_v3_scale(d, fmax(0, fmin(1, t))))));
}

static double from_triangle(vs_vec3 p, vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  vs_vec3 n = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
  double length = vs_v3_length(n), best = fmin(from_segment(p, a, b), fmin(from_segment(p, b, c), from_segment(p, c, a)));
  if (!(length > 0)) return best;
  vs_vec3 u = vs_v3_scale(n, 1 / length), q = vs_v3_sub(p, vs_v3_scale(u, vs_v3_dot(vs_v3_sub(p, a), u)));
  bool over = vs_v3_dot(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(q, a)), n) >= 0 && vs_v3_dot(vs_v3_cross(vs_v3_sub(c, b), vs_v3_sub(q, b)), n) >= 0 &&
              vs_v3_dot(vs_v3_cross(vs_v3_sub(a, c), vs_v3_sub(q, c)), n) >= 0;
  return over ? fmin(best, fabs(vs_v3_dot(vs_v3_sub(p, a), u))) : best;
}

static double from_surface(const vs_mesh *m, vs_vec3 p) {
  double best = HUGE_VAL;
  for (size_t t = 0; t < m->triangle_count; t++)
    best = fmin(best, from_triangle(p, m->vertices[m->triangles[t][0]], m->vertices[m->triangles[t][1]], m->vertices[m->triangles[t][2]]));
  return best;
}

/* ---- test of a sweep ---- */

/* most: limit of triangles above which a sweep is skipped; 0: no limit. The other integers count sweeps or points.
 * furthest: distance of a wrong point from the surface, the largest of all. corners: as for sweep() */
typedef struct { bool corners; size_t most, sweeps, overlapping, points, inside, met, refused, wrong; double furthest; } tally;

/* Returns the number of triangles that intersect after their coordinates are rounded to the number format `numbers`. */
static size_t met(const vs_mesh *m, vs_numbers numbers) {
  vs_mesh copy = { 0 };
  vs_rounded r = { 0 };
  assert_true(vs_mesh_copy(m, &copy));
  assert_true(vs_mesh_round(&copy, numbers, NULL, &r, NULL));
  vs_mesh_free(&copy);
  return r.met;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* With TELL=1, prints the sweep before the test, so that the output also shows a sweep that takes too long. */
static void describe(const vs_node *n, uint64_t seed) {
  const struct vs_sweep *w = VS_AS(sweep, n);
  const vs_node *curve = n->children[1].node;
  const vs_points *p = curve->kind == VS_LINE ? VS_AS(line, curve)->points : curve->kind == VS_SPLINE ? VS_AS(spline, curve)->points : NULL;
  if (!getenv("TELL")) return;
  fprintf(stderr, "sweep %llu: %s along %s, twist %.9g, scale %.9g%s", (unsigned long long)seed, vs_kind_get((vs_kind)n->children[0].node->kind)->name, vs_kind_get((vs_kind)curve->kind)->name, w->twist,
          w->scale, w->has_base ? ", with a base" : "");
  for (size_t i = 0; p && i < p->count; i++) fprintf(stderr, " (xyz %.9g %.9g %.9g)", p->at[i].x, p->at[i].y, p->at[i].z);
  fprintf(stderr, "\n");
}

static size_t triangles(const vs_node *n, const vs_fineness *f) {
  vs_mesh m = { 0 };
  vs_error e = { 0 };
  assert_true(vs_tessellate(n, f, &m, &e));
  size_t count = m.triangle_count;
  vs_mesh_free(&m);
  return count;
}

/* Tests the sweep of this seed. Writes the fault to `why`, or "" if there is none. */
static void look(vs_store *s, uint64_t seed, tally *t, char why[600]) {
  double begun = now();
  vs_error e = { 0 };
  vs_node *n = sweep(s, seed, t->corners);
  vs_ref ref = { n, NULL };
  vs_bounds b;
  vs_solid solid;
  vs_measure measure;
  bool overlaps = false, closed;
  why[0] = 0;
  describe(n, seed);
  assert_true(vs_node_bounds(n, &b, &e));
  vs_fineness f = { vs_fineness_tolerance(&b), 0 };
  if (t->most && triangles(n, &f) > t->most) {
    vs_node_release(n);
    return;
  }
  if (!vs_primitive_overlaps(n, &f, NULL, &overlaps, &e) || !vs_solid_evaluate(&ref, 1, &f, NULL, &solid, &e)) {
    t->refused++;
    t->overlapping += overlaps;
    if (!overlaps || !(strstr(e.message, "the bend at (xyz ") || strstr(e.message, "the sweep overlaps itself at (xyz "))) snprintf(why, 600, "refused: %s", e.message);
    else if (getenv("TELL")) fprintf(stderr, "sweep %llu: refused: %s\n", (unsigned long long)seed, e.message);
    vs_node_release(n);
    return;
  }
  t->sweeps++;
  t->overlapping += overlaps;
  vs_facet_index index = { 0 };
  assert_true(vs_mesh_copy(&solid.mesh, &index.mesh) && vs_facet_index_make(&index));
  vs_inside *stations = vs_inside_new(n, &e);
  assert_non_null(stations);
  dice d = { seed };
  vs_vec3 size = vs_v3_sub(b.max, b.min);
  for (int i = 0; i < POINTS; i++) {
    vs_vec3 p = { between(&d, b.min.x, b.max.x), between(&d, b.min.y, b.max.y), between(&d, b.min.z, b.max.z) };
    bool in = vs_inside_test(stations, p), is = vs_facet_index_holds(&index, p);
    t->points++;
    t->inside += in;
    if (in == is) continue;
    double away = from_surface(&solid.mesh, p) / f.tolerance;
    t->furthest = fmax(t->furthest, away);
    if (away > 3 && !why[0]) snprintf(why, 600, "a point %.3g tolerances from the surface is %s by its stations: %.9g %.9g %.9g (of %g %g %g)", away, in ? "inside" : "outside", p.x, p.y, p.z, size.x, size.y, size.z);
  }
  if (!why[0] && !(vs_mesh_closed(&solid.mesh, &closed) && closed)) snprintf(why, 600, "the mesh is open");
  if (!why[0] && !vs_solid_measure(ref, VS_ASK_VOLUME, f.tolerance, NULL, &measure, &e)) snprintf(why, 600, "no volume: %s", e.message);
  double volume = vs_mesh_volume(&solid.mesh), off = vs_mesh_area(&solid.mesh) * f.tolerance;
  if (!why[0] && !(fabs(measure.volume - volume) <= 2 * off)) snprintf(why, 600, "its volume is %.9g, its mesh's %.9g, +- %.2g", measure.volume, volume, off);
  size_t digits = why[0] ? 0 : met(&solid.mesh, VS_NUMBERS_DIGITS), loose = why[0] ? 0 : met(&solid.mesh, VS_NUMBERS_LOOSE);
  if (digits + loose > 0) t->met++, snprintf(why, 600, "triangles meet: %zu in .off, %zu in .stl", digits, loose);
  if (getenv("TELL") && now() - begun > 3) fprintf(stderr, "sweep %llu: %.1f s, %zu triangles\n", (unsigned long long)seed, now() - begun, solid.mesh.triangle_count);
  vs_inside_free(stations);
  vs_facet_index_free(&index);
  vs_solid_free(&solid);
  vs_node_release(n);
}

static void look_at_all(seed_range seeds, tally *t) {
  for (uint64_t seed = seeds.from; seed <= seeds.to; seed++) {
    char why[600];
    vs_store *s = vs_store_new(NULL, NULL);
    vs_cache *cache = vs_cache_new(s, (size_t)1 << 28); /* a cache for the mesh, because the measurement requests the
                                                         * mesh a second time */
    assert_non_null(cache);
    look(s, seed, t, why);
    if (why[0]) t->wrong++, fprintf(stderr, "sweep %llu: %s\n", (unsigned long long)seed, why);
    vs_cache_free(cache);
    vs_store_release(s);
  }
  if (getenv("TELL"))
    fprintf(stderr, "%zu sweeps, %zu overlap, %zu of %zu points inside, the furthest wrong one %.3g tolerances away; %zu wrong, %zu refused, %zu meet\n", t->sweeps, t->overlapping, t->inside,
            t->points, t->furthest, t->wrong, t->refused, t->met);
  assert_int_equal(t->wrong, 0);
}

static void sweeps_are_where_the_profile_was(void **state) {
  (void)state;
  seed_range seeds = seeds_asked(55, 2000);
  tally t = { .most = seeds.whole ? 0 : 6000 };
  look_at_all(seeds, &t);
  assert_true(t.refused * 20 <= t.overlapping || seeds.to - seeds.from < 20);
  /* checks that the run has tested enough sweeps and points; fewer small sweeps overlap */
  if (seeds.to - seeds.from > 20) assert_true(t.overlapping * (seeds.whole ? 3 : 4) > t.sweeps && t.inside * 40 > t.points);
}

static void twisted_sweeps_with_corners_do_not_depend_on_the_tolerance(void **state) {
  (void)state;
  seed_range seeds = seeds_asked(60, 600);
  tally t = { .corners = true, .most = 4000 };
  if (seeds.asked) return; /* these are seeds of sweeps along any path */
  look_at_all(seeds, &t);
  assert_true(t.sweeps >= 20);
}

/* Returns the sweep without a half of its box. */
static vs_node *half_of(vs_store *s, vs_node *sweep) {
  vs_bounds b;
  vs_error e = { 0 };
  assert_true(vs_node_bounds(sweep, &b, &e));
  vs_vec3 low = vs_v3_sub(b.min, vs_v3(1, 1, 1)), high = { (b.min.x + b.max.x) / 2, b.max.y + 1, b.max.z + 1 };
  vs_ref parts[2] = { { sweep, NULL }, { NODE(box, BOX, low, high), NULL } };
  vs_node *half = vs_node_new(s, VS_DIFFERENCE, &(struct vs_difference){ 0 }, parts, 2);
  vs_node_release(parts[1].node);
  return half;
}

/* A finer mesh of a sweep that overlaps itself takes too long. Therefore the volume of a cut sweep is that of the mesh
 * with the usual tolerance if the sweep overlaps itself; otherwise a finer mesh is measured. */
static void cut_sweeps_are_measured_at_their_own_tolerance(void **state) {
  (void)state;
  enum { EACH = 2, SMALL = 1500 };
  int tested[2] = { 0, 0 };
  if (seeds_asked(1, 1).asked) return;
  for (uint64_t seed = 1; seed < 200 && (tested[0] < EACH || tested[1] < EACH); seed++) {
    vs_store *s = vs_store_new(NULL, NULL);
    vs_cache *cache = vs_cache_new(s, (size_t)1 << 28);
    vs_error e = { 0 };
    vs_bounds b;
    vs_solid solid;
    vs_measure measure;
    vs_node *n = sweep(s, seed, false), *half = half_of(s, n);
    vs_ref ref = { half, NULL };
    bool overlaps;
    assert_true(vs_node_bounds(half, &b, &e));
    vs_fineness f = { vs_fineness_tolerance(&b), 0 };
    bool round = triangles(n, &f) > 600 && triangles(n, &f) < SMALL;
    if (round && vs_primitive_overlaps(n, &f, NULL, &overlaps, &e) && tested[overlaps] < EACH && vs_solid_evaluate(&ref, 1, &f, NULL, &solid, &e)) {
      assert_true(vs_solid_measure(ref, VS_ASK_VOLUME, 0, NULL, &measure, &e));
      double volume = vs_mesh_volume(&solid.mesh);
      if ((fabs(measure.volume - volume) < 1e-9 * volume) != overlaps)
        fail_msg("sweep %llu: the volume is %.12g, that of the mesh %.12g", (unsigned long long)seed, measure.volume, volume);
      tested[overlaps]++;
      vs_solid_free(&solid);
    }
    vs_node_release(half);
    vs_node_release(n);
    vs_cache_free(cache);
    vs_store_release(s);
  }
  assert_true(tested[0] == EACH && tested[1] == EACH);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(cut_sweeps_are_measured_at_their_own_tolerance), cmocka_unit_test(sweeps_are_where_the_profile_was), cmocka_unit_test(twisted_sweeps_with_corners_do_not_depend_on_the_tolerance) };
  return cmocka_run_group_tests_name("random sweeps", tests, NULL, NULL);
}
