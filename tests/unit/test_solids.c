/* Tests geometry/'s solids: each mesh is closed, faces outwards, has no splinters (very thin triangles), and has the
 * volume that a formula gives. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geometry/frame.h"
#include "geometry/files/polyface.h"
#include "geometry/tessellate.h"

static const double pi = 3.14159265358979323846;
static const vs_fineness fine = { 1e-4, 0 };

#define NODE(lower, upper, ...) vs_node_new(s, VS_##upper, &(struct vs_##lower){ __VA_ARGS__, 0 }, NULL, 0)

/* Checks the mesh of n, and compares its volume with `volume`, within a relative tolerance. Releases n. */
static void check(vs_node *n, const vs_fineness *f, double volume, double relative) {
  vs_mesh m = { 0 };
  vs_error e = { 0 };
  bool ok;
  assert_non_null(n);
  if (!vs_tessellate(n, f, &m, &e)) fail_msg("%s", e.message);
  assert_true(vs_mesh_closed(&m, &ok) && ok);
  for (size_t i = 0; i < m.triangle_count; i++) {
    const uint32_t *t = m.triangles[i];
    vs_vec3 a = m.vertices[t[0]];
    assert_true(vs_v3_length(vs_v3_cross(vs_v3_sub(m.vertices[t[1]], a), vs_v3_sub(m.vertices[t[2]], a))) > 1e-12);
  }
  double found = vs_mesh_volume(&m);
  if (!(fabs(found - volume) <= relative * volume)) fail_msg("%s: volume %.12g, not %.12g", vs_kind_get((vs_kind)n->kind)->name, found, volume);
  vs_mesh_free(&m);
  vs_node_release(n);
}

static void volumes(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 p = { 1, 2, 3 }, q = { 3, 5, 7 };
  double length = sqrt(4 + 9 + 16);
  check(NODE(box, BOX, p, q), &fine, 24, 1e-15);
  check(NODE(wedge, WEDGE, p, q), &fine, 12, 1e-15);
  check(NODE(sphere, SPHERE, p, 2, 0), &fine, 4 / 3.0 * pi * 8, 3e-4);
  check(NODE(cylinder, CYLINDER, p, q, 2, 0), &fine, pi * 4 * length, 2e-4);
  check(NODE(cylinder, CYLINDER, q, p, 2, 0), &fine, pi * 4 * length, 2e-4);
  check(NODE(cone, CONE, p, q, 2, 0), &fine, pi * 4 * length / 3, 2e-4);
  check(NODE(cut_cone, CUT_CONE, p, 2, q, 1, 0), &fine, pi * (4 + 2 + 1) * length / 3, 2e-4);
  check(NODE(cut_cone, CUT_CONE, p, 0, q, 1, 0), &fine, pi * length / 3, 3e-4);
  check(NODE(pyramid, PYRAMID, p, 2, 4, q, 0), &fine, 8 * length / 3, 1e-14);
  check(NODE(pyramid, PYRAMID, p, 2, 5, q, 2), &fine, 2.5 * 4 * sin(2 * pi / 5) * length, 1e-14);
  check(NODE(torus, TORUS, p, 3, 1, 0), &fine, 2 * pi * pi * 3, 5e-4);
  check(NODE(torus, TORUS, p, 1, 1, 0), &fine, 2 * pi * pi, 5e-4); /* the torus touches itself in its centre, a single
                                                                    * point */
  double a = acos(-0.5); /* a torus whose tube is thicker than the radius of its ring: the solid is the part of the disc
                          * on one side of the axis, revolved about the axis (Pappus) */
  check(NODE(torus, TORUS, p, 1, 2, 0), &fine, 2 * pi * (4 * a - 4 * sin(a) * cos(a) + 2.0 / 3 * 8 * pow(sin(a), 3)), 6e-4);
  vs_store_release(s);
}

static void segments_are_inscribed(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 o = { 0, 0, 0 }, up = { 0, 0, 2 };
  for (int n = 3; n < 20; n++) {
    check(NODE(cylinder, CYLINDER, o, up, 1, n), &fine, n * sin(2 * pi / n), 1e-14);
    check(NODE(pyramid, PYRAMID, o, 1, n, up, 1), &fine, n * sin(2 * pi / n), 1e-14);
  }
  vs_fineness six = { 1e-4, 6 };
  check(NODE(cylinder, CYLINDER, o, up, 1, 0), &six, 6 * sin(pi / 3), 1e-14);
  vs_store_release(s);
}

static void facets_keep_their_height(void **state) {
  (void)state;
  for (double r = 1e-3; r < 1e6; r *= 3) {
    int n = vs_fineness_turn(&fine, r, 0);
    assert_true(n >= 32 && n % 4 == 0);
    if (n < 4096) assert_true(r * (1 - cos(pi / n)) <= 1e-4 * (1 + 1e-9));
  }
  vs_bounds b = { { 0, 0, 0 }, { 3, 4, 0 } };
  assert_true(vs_fineness_tolerance(&b) == 1.0 / 1024);
  vs_affine turned = vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(1, 2, 3), 0.7), doubled = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(2, 2, 2));
  assert_true(vs_fineness_placed(&fine, &turned).tolerance == fine.tolerance);
  assert_true(vs_fineness_placed(&fine, &doubled).tolerance == fine.tolerance / 2);
}

static void mirrors_turn_the_facets(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  struct vs_transform mirror = { vs_affine_mirror(vs_v3(1, 0, 0), vs_v3(1, 1, 1)), 0 }, flat = { vs_affine_scaling(vs_v3(1, 1, 1), vs_v3(1, 2, -3)), 0 };
  vs_node *sphere = NODE(sphere, SPHERE, { 1, 2, 3 }, 1, 0);
  vs_node *once = vs_node_new(s, VS_TRANSFORM, &mirror, &(vs_ref){ sphere, NULL }, 1);
  vs_node *twice = vs_node_new(s, VS_TRANSFORM, &flat, &(vs_ref){ once, NULL }, 1);
  vs_node_release(sphere);
  check(once, &fine, 4 / 3.0 * pi, 6e-4);
  check(twice, &fine, 6 * 4 / 3.0 * pi, 6e-4);
  vs_store_release(s);
}

static void quarters_are_exact(void **state) {
  (void)state;
  double sine, cosine, mirrored_sine, mirrored_cosine;
  for (int k = -9; k <= 9; k++) {
    vs_sincos(k * pi / 2, &sine, &cosine);
    int q = ((k % 4) + 4) % 4;
    assert_true(sine == (q == 1) - (q == 3) && cosine == (q == 0) - (q == 2));
  }
  for (int n = 3; n < 70; n++)
    for (int i = 0; i < n; i++) {
      vs_turn_sincos(i, n, &sine, &cosine);
      vs_turn_sincos(n - i, n, &mirrored_sine, &mirrored_cosine);
      assert_true(cosine == mirrored_cosine && sine == -mirrored_sine);
      assert_true(fabs(sine - sin(2 * pi * i / n)) < 2e-15 && fabs(cosine - cos(2 * pi * i / n)) < 2e-15);
    }
  vs_affine r = vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(0, 0, 5), -pi / 2);
  assert_true(vs_v3_equal(vs_affine_point(&r, vs_v3(2, 2, 7)), vs_v3(1, 1, 7)));
}

static void on_the_axis(void **state) {
  (void)state;
  vs_affine f = vs_frame_on_axis(vs_v3(1, 2, 3), vs_v3(0, 0, -4));
  assert_true(vs_v3_equal(vs_affine_vector(&f, vs_v3(1, 0, 0)), vs_v3(1, 0, 0)));
  assert_true(vs_v3_equal(vs_affine_vector(&f, vs_v3(0, 1, 0)), vs_v3(0, -1, 0)));
  f = vs_frame_on_axis(vs_v3(0, 0, 0), vs_v3(0.1, 0, 0));
  assert_true(vs_v3_equal(vs_affine_vector(&f, vs_v3(1, 0, 0)), vs_v3(0, 0, -1)));
  assert_true(vs_v3_equal(vs_affine_vector(&f, vs_v3(0, 0, 1)), vs_v3(1, 0, 0)));
  for (int i = 0; i < 500; i++) { /* the coordinate frames must be orthonormal, right-handed, and have the given Z axis,
                                   * even if that axis is very close to -Z */
    double w = pow(10, -(i % 14)), phi = i;
    vs_vec3 d = vs_v3_unit(vs_v3(w * cos(phi), w * sin(phi), i & 1 ? -1 : 0.3));
    f = vs_frame_on_axis(vs_v3(0, 0, 0), d);
    assert_true(fabs(vs_affine_determinant(&f) - 1) < 1e-11);
    vs_vec3 x = { f.m[0][0], f.m[1][0], f.m[2][0] }, z = { f.m[0][2], f.m[1][2], f.m[2][2] };
    assert_true(fabs(vs_v3_dot(x, z)) < 2e-12 && fabs(vs_v3_dot(x, x) - 1) < 1e-11 && vs_v3_length(vs_v3_sub(z, d)) < 1e-15);
  }
}

static void polyfaces_are_put_right(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 cube[8];
  for (int i = 0; i < 8; i++) cube[i] = vs_v3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  uint32_t starts[] = { 0, 4, 8, 12, 16, 20, 24 };
  uint32_t inward[] = { 0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3 };
  vs_node *n = vs_polyface_make(s, &(vs_polygons){ cube, 8, starts, inward, 6 }, NULL);
  assert_int_equal(n->class_, VS_SOLID);
  check(n, &fine, 1, 1e-15);
  uint32_t mixed[] = { 0, 1, 3, 2, 4, 5, 7, 6, 0, 4, 5, 1, 2, 6, 7, 3, 0, 2, 6, 4, 1, 3, 7, 5 };
  check(vs_polyface_make(s, &(vs_polygons){ cube, 8, starts, mixed, 6 }, NULL), &fine, 1, 1e-15);
  n = vs_polyface_make(s, &(vs_polygons){ cube, 8, starts, inward, 5 }, NULL);
  assert_int_equal(n->class_, VS_SURFACE);
  vs_node_release(n);
  vs_vec3 own_corners[24]; /* gives each face its own copies of its corners, as in an STL file */
  uint32_t own[24];
  for (uint32_t i = 0; i < 24; i++) {
    own_corners[i] = cube[inward[i]];
    own[i] = i;
  }
  check(vs_polyface_make(s, &(vs_polygons){ own_corners, 24, starts, own, 6 }, NULL), &fine, 1, 1e-15);
  uint32_t thin[] = { 0, 1, 1, 0 }, one[] = { 0, 4 };
  n = vs_polyface_make(s, &(vs_polygons){ cube, 8, one, thin, 1 }, NULL);
  assert_int_equal(n->kind, VS_EMPTY);
  vs_node_release(n);
  /* an L-shaped prism: its ends are not convex, and its corner (0, 1) lies in the middle of a straight edge */
  double l[7][2] = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 }, { 0, 1 } };
  vs_vec3 at[14];
  uint32_t prism[14 + 28], prism_starts[10] = { 0, 7, 14 };
  for (uint32_t i = 0; i < 7; i++) {
    at[i] = vs_v3(l[i][0], l[i][1], 0);
    at[i + 7] = vs_v3(l[i][0], l[i][1], 1);
    prism[i] = 6 - i;
    prism[7 + i] = 7 + i;
    uint32_t j = (i + 1) % 7, quad[] = { i, j, j + 7, i + 7 };
    for (uint32_t k = 0; k < 4; k++) prism[14 + 4 * i + k] = quad[k];
    prism_starts[i + 3] = 14 + 4 * (i + 1);
  }
  check(vs_polyface_make(s, &(vs_polygons){ at, 14, prism_starts, prism, 9 }, NULL), &fine, 3, 1e-15);
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(volumes), cmocka_unit_test(segments_are_inscribed), cmocka_unit_test(facets_keep_their_height),
    cmocka_unit_test(mirrors_turn_the_facets), cmocka_unit_test(quarters_are_exact), cmocka_unit_test(on_the_axis),
    cmocka_unit_test(polyfaces_are_put_right),
  };
  return cmocka_run_group_tests_name("geometry solids", tests, NULL, NULL);
}
