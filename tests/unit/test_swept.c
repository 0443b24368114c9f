/* Tests curves and regions, and objects that are made from curves and regions: extrusions, sweeps, thickened curves,
 * plates and surfaces. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geometry/plane/join.h"
#include "geometry/files/polyface.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/tessellate.h"
#include "model/job.h"

static const double pi = 3.14159265358979323846;
static const vs_fineness fine = { 1e-4, 0 };

#define NODE(lower, upper, ...) vs_node_new(s, VS_##upper, &(struct vs_##lower){ __VA_ARGS__, 0 }, NULL, 0)

static vs_node *polyline(vs_store *s, const vs_vec3 *at, size_t n, bool closed) {
  vs_points *p = vs_points_new(s, at, n);
  vs_node *line = NODE(line, LINE, p, closed);
  vs_points_release(s, p);
  return line;
}

/* Returns a new node of the kind with the children a and b. Takes over the references to them. */
static vs_node *over(vs_store *s, vs_kind kind, const void *data, vs_node *a, vs_node *b) {
  vs_ref refs[2] = { { a, NULL }, { b, NULL } };
  vs_node *n = vs_node_new(s, kind, data, refs, b ? 2 : 1);
  vs_node_release(a);
  vs_node_release(b);
  return n;
}

static void check(vs_node *n, double volume, double relative) {
  vs_mesh m = { 0 };
  vs_error e = { 0 };
  bool ok;
  assert_int_equal(n->class_, VS_SOLID);
  if (!vs_tessellate(n, &fine, &m, &e)) fail_msg("%s", e.message);
  assert_true(vs_mesh_closed(&m, &ok) && ok);
  double found = vs_mesh_volume(&m);
  if (!(fabs(found - volume) <= relative * volume)) fail_msg("%s: volume %.12g, not %.12g", vs_kind_get((vs_kind)n->kind)->name, found, volume);
  vs_mesh_free(&m);
  vs_node_release(n);
}

static vs_node *square_at(vs_store *s, double x, double y, double z, double side) {
  vs_vec3 at[] = { { x, y, z }, { x + side, y, z }, { x + side, y + side, z }, { x, y + side, z } };
  return polyline(s, at, 4, true);
}

static void extrusions(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  struct vs_extrude up = { .along = { 0, 0, 3 }, .scale = 1 }, down = { .along = { 1, 0, -3 }, .scale = 1 }, middle = { .along = { 0, 0, 3 }, .scale = 1, .center = true };
  check(over(s, VS_EXTRUDE, &up, square_at(s, 1, 2, 5, 2), NULL), 12, 1e-14);
  check(over(s, VS_EXTRUDE, &down, square_at(s, 1, 2, 5, 2), NULL), 12, 1e-14);
  check(over(s, VS_EXTRUDE, &middle, square_at(s, 1, 2, 5, 2), NULL), 12, 1e-14);
  check(over(s, VS_EXTRUDE, &up, NODE(circle, CIRCLE, { 1, 2, 3 }, 2, 0), NULL), 12 * pi, 3e-4);
  struct vs_extrude tower = { .along = { 0, 0, 3 }, .scale = 0.5, .twist = pi }, spire = { .along = { 0, 0, 3 }, .scale = 0 };
  check(over(s, VS_EXTRUDE, &tower, square_at(s, 1, 2, 5, 2), NULL), 4 * 3 * (1 + 0.5 + 0.25) / 3, 2e-3);
  check(over(s, VS_EXTRUDE, &spire, square_at(s, 1, 2, 5, 2), NULL), 4, 1e-14);
  /* the loops of a ring with a square hole, and of an island in the hole */
  vs_ref bounds[] = { { square_at(s, 0, 0, 0, 10), NULL }, { square_at(s, 2, 2, 0, 5), NULL }, { square_at(s, 3, 3, 0, 1), NULL }, { square_at(s, 8, 8, 0, 1), NULL } };
  vs_node *region = vs_node_new(s, VS_REGION, NULL, bounds, 4);
  for (int i = 0; i < 4; i++) vs_node_release(bounds[i].node);
  check(over(s, VS_EXTRUDE, &up, region, NULL), 3 * (100 - 25 + 1 - 1), 1e-14);
  /* extruded along a curve without rotation, a solid is sheared: by Cavalieri's principle, its volume is area times
   * height */
  struct vs_extrude follow = { .scale = 1 };
  vs_vec3 bent[] = { { 0, 0, 0 }, { 1, 0, 2 }, { -2, 1, 5 } };
  check(over(s, VS_EXTRUDE, &follow, square_at(s, 1, 2, 5, 2), polyline(s, bent, 3, false)), 20, 1e-14);
  vs_node *flat = over(s, VS_EXTRUDE, &(struct vs_extrude){ .along = { 1, 0, 0 }, .scale = 1 }, square_at(s, 0, 0, 0, 1), NULL);
  vs_mesh m = { 0 };
  vs_error e = { 0 };
  assert_false(vs_tessellate(flat, &fine, &m, &e));
  assert_int_equal(e.kind, VS_ERROR_MODEL);
  vs_mesh_free(&m);
  vs_node_release(flat);
  vs_store_release(s);
}

static void sweeps(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  struct vs_sweep plain = { .scale = 1 }, half = { .scale = 0.5 }, none = { .scale = 0 }, turned = { .scale = 1, .twist = 2 * pi };
  vs_vec3 corner[] = { { 0, 0, 0 }, { 10, 0, 0 }, { 10, 10, 0 }, { 10, 10, 10 } }, straight[] = { { 1, 1, 1 }, { 4, 5, 1 } };
  /* the sweep moves the profile's centroid onto the path; with mitred corners, the volume is therefore area times
   * length, wherever the profile lies */
  check(over(s, VS_SWEEP, &plain, square_at(s, 7, 8, 9, 1), polyline(s, corner, 4, false)), 30, 1e-13);
  check(over(s, VS_SWEEP, &plain, square_at(s, 7, 8, 9, 1), square_at(s, 0, 0, 0, 10)), 40, 1e-13);
  check(over(s, VS_SWEEP, &half, square_at(s, 7, 8, 9, 2), polyline(s, straight, 2, false)), 5 * 4 * 1.75 / 3, 1e-13);
  check(over(s, VS_SWEEP, &none, square_at(s, 7, 8, 9, 2), polyline(s, straight, 2, false)), 20.0 / 3, 1e-13);
  check(over(s, VS_SWEEP, &turned, square_at(s, 7, 8, 9, 2), polyline(s, straight, 2, false)), 20, 1e-3);
  check(over(s, VS_SWEEP, &plain, NODE(circle, CIRCLE, { 1, 2, 3 }, 1, 0), NODE(circle, CIRCLE, { 1, 2, 3 }, 5, 0)), 2 * pi * pi * 5, 1e-3);
  check(over(s, VS_SWEEP, &turned, square_at(s, 0, 0, 0, 1), NODE(circle, CIRCLE, { 1, 2, 3 }, 5, 0)), 2 * pi * 5, 1e-3);
  check(over(s, VS_SWEEP, &half, square_at(s, 0, 0, 0, 1), NODE(circle, CIRCLE, { 1, 2, 3 }, 5, 0)), 2 * pi * 5 * 1.75 / 3, 2e-3);
  /* along a closed path that is not planar, the profile rotates, but the last section must equal the first */
  vs_vec3 knot[24];
  for (int i = 0; i < 24; i++) knot[i] = vs_v3((4 + cos(3 * pi * i / 12)) * cos(2 * pi * i / 12), (4 + cos(3 * pi * i / 12)) * sin(2 * pi * i / 12), sin(3 * pi * i / 12));
  vs_points *p = vs_points_new(s, knot, 24);
  vs_node *path = NODE(spline, SPLINE, p, true, { 0, 0, 0 }, { 0, 0, 0 }, 0);
  vs_points_release(s, p);
  vs_polyline line = { 0 };
  assert_true(vs_curve_sample(path, &fine, &line, NULL));
  double length = 0;
  for (size_t i = 0; i < line.count; i++) length += vs_v3_length(vs_v3_sub(line.at[(i + 1) % line.count], line.at[i]));
  vs_polyline_free(&line);
  check(over(s, VS_SWEEP, &plain, square_at(s, 0, 0, 0, 0.25), path), length / 16, 1e-3);
  vs_store_release(s);
}

static void thickened(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  struct vs_thicken t = { .width = 0.5, .segments = 8 }, by_tolerance = { .width = 0.5 };
  vs_vec3 corner[] = { { 0, 0, 0 }, { 10, 0, 0 }, { 10, 10, 0 } }, quad[] = { { 0, 0, 0 }, { 2, 0, 1 }, { 2, 3, 1 }, { 0, 3, 0 } };
  check(over(s, VS_THICKEN, &t, polyline(s, corner, 3, false), NULL), 20 * 4 * 0.0625 * sin(pi / 4), 1e-13);
  check(over(s, VS_THICKEN, &by_tolerance, NODE(circle, CIRCLE, { 0, 0, 0 }, 2, 0), NULL), 2 * pi * pi * 2 * 0.0625, 2e-3);
  vs_node *region = over(s, VS_REGION, NULL, square_at(s, 0, 0, 0, 2), NULL);
  check(over(s, VS_THICKEN, &t, region, NULL), 2, 1e-14);
  uint32_t starts[] = { 0, 4 }, corners[] = { 0, 1, 2, 3 };
  check(over(s, VS_THICKEN, &t, vs_polyface_make(s, &(vs_polygons){ quad, 4, starts, corners, 1 }, NULL), NULL), 3 * sqrt(5) * 0.5, 1e-13);
  vs_node *wall = over(s, VS_EXTRUDE, &(struct vs_extrude){ .along = { 0, 0, 3 }, .scale = 1 }, polyline(s, corner, 3, false), NULL);
  assert_int_equal(wall->class_, VS_SURFACE);
  check(over(s, VS_THICKEN, &t, wall, NULL), 20 * 3 * 0.5, 1e-13);
  vs_store_release(s);
}

static void splines_pass_through_their_points(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 at[] = { { 0, 0, 0 }, { 1, 2, 0 }, { 3, 1, 1 }, { 4, 4, 4 } };
  for (int closed = 0; closed < 2; closed++) {
    vs_points *p = vs_points_new(s, at, 4);
    vs_node *n = NODE(spline, SPLINE, p, closed, { 0, 0, 0 }, { 0, 0, 0 }, 0);
    vs_points_release(s, p);
    vs_polyline line = { 0 };
    assert_true(vs_curve_sample(n, &fine, &line, NULL));
    size_t found = 0;
    double sharpest = 0;
    for (size_t i = 0; i < line.count; i++) {
      if (found < 4 && vs_v3_equal(line.at[i], at[found])) found++;
      if (!closed && (i == 0 || i + 1 == line.count)) continue;
      vs_vec3 a = vs_v3_unit(vs_v3_sub(line.at[i], line.at[(i + line.count - 1) % line.count])), b = vs_v3_unit(vs_v3_sub(line.at[(i + 1) % line.count], line.at[i]));
      sharpest = fmax(sharpest, acos(fmin(1, vs_v3_dot(a, b))));
    }
    assert_int_equal(found, 4);
    assert_true(line.closed == closed && sharpest < 0.3); /* the spline has no sharp angle at its points; a closed
                                                           * spline has none where its ends join */
    vs_polyline_free(&line);
    vs_node_release(n);
  }
  /* a cubic spline with the tangents of a circle is close to the circle */
  vs_vec3 quarter[] = { { 1, 0, 0 }, { sqrt(0.5), sqrt(0.5), 0 }, { 0, 1, 0 } };
  vs_points *p = vs_points_new(s, quarter, 3);
  vs_node *n = NODE(spline, SPLINE, p, false, { 0, 7, 0 }, { -1, 0, 0 }, 0);
  vs_points_release(s, p);
  vs_polyline line = { 0 };
  assert_true(vs_curve_sample(n, &fine, &line, NULL));
  for (size_t i = 0; i < line.count; i++) assert_true(fabs(vs_v3_length(line.at[i]) - 1) < 0.01);
  vs_polyline_free(&line);
  vs_node_release(n);
  vs_store_release(s);
}

static bool never(void *asked, const char *stage, double done) {
  (void)stage, (void)done;
  return ++*(size_t *)asked, false;
}

/* Tests that lofts poll for an interrupt: about once per point while they search for the least twist, and while they
 * make rows of faces. */
static void lofts_are_interrupted(void **state) {
  (void)state;
  static const int segments[3][2] = { { 4000, 4000 }, { 300, 301 }, { 40000, 40001 } };
  vs_store *s = vs_store_new(NULL, NULL);
  vs_fineness f = { .tolerance = 0.01 };
  for (int i = 0; i < 3; i++) {
    size_t asked = 0;
    vs_node *n = over(s, VS_RULED_LOFT, NULL, NODE(circle, CIRCLE, { 0, 0, 0 }, 1, segments[i][0]),
                      NODE(circle, CIRCLE, { 0, 0, 3 }, 1, segments[i][1]));
    vs_mesh m = { 0 };
    vs_error e = { 0 };
    assert_true(vs_tessellate(n, &f, &m, &e));
    vs_mesh_free(&m);
    vs_job job = { .going = never, .context = &asked };
    vs_store_set_job(s, &job);
    bool made = vs_tessellate(n, &f, &m, &e);
    assert_true(made == (i == 1)); /* the small loft is complete before its first poll, the other lofts are
                                    * interrupted */
    assert_int_equal(asked, !made);
    if (!made) assert_int_equal(e.kind, VS_ERROR_INTERRUPT);
    vs_store_set_job(s, NULL);
    vs_mesh_free(&m);
    vs_node_release(n);
  }
  vs_store_release(s);
}

static void regions_join_open_curves(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 base[] = { { 2, 0, 0 }, { -2, 0, 0 } };
  vs_ref parts[] = { { NODE(arc, ARC, { 0, 0, 0 }, 2, 0, pi, 0), NULL }, { polyline(s, base, 2, false), NULL } };
  vs_error e = { 0 };
  vs_ref joined[] = { parts[0], parts[1] };
  size_t count = 2;
  assert_true(vs_curves_join(s, joined, &count, &e)); /* The line's direction is opposite to the arc's direction. The
                                                       * join must reverse the line */
  assert_int_equal(count, 1);
  assert_int_equal(joined[0].node->kind, VS_JOIN);
  vs_node *region = vs_node_new(s, VS_REGION, NULL, joined, 1);
  vs_node_release(joined[0].node);
  vs_outline o;
  vs_vec3 centroid;
  assert_true(vs_region_outline(region, &fine, &o, NULL));
  assert_int_equal(o.count, 1);
  assert_true(fabs(vs_outline_measure(&o, &centroid) - 2 * pi) < 2e-3);
  assert_true(fabs(centroid.y - 8 / (3 * pi)) < 1e-3 && fabs(centroid.x) < 1e-9);
  vs_outline_free(&o);
  vs_node_release(region);
  region = vs_node_new(s, VS_REGION, NULL, parts, 1);
  assert_false(vs_region_outline(region, &fine, &o, &e));
  assert_int_equal(e.kind, VS_ERROR_MODEL);
  vs_node_release(region);
  for (int i = 0; i < 2; i++) vs_node_release(parts[i].node);
  vs_vec3 twisted[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 1 }, { 0, 1, 0 } };
  region = over(s, VS_REGION, NULL, polyline(s, twisted, 4, true), NULL);
  assert_false(vs_region_outline(region, &fine, &o, &e));
  vs_node_release(region);
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(extrusions), cmocka_unit_test(sweeps), cmocka_unit_test(thickened), cmocka_unit_test(splines_pass_through_their_points),
    cmocka_unit_test(lofts_are_interrupted), cmocka_unit_test(regions_join_open_curves),
  };
  return cmocka_run_group_tests_name("geometry curves and sweeps", tests, NULL, NULL);
}
