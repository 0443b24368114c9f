/* Tests convex hulls and height fields. They must be closed and have the volume that a formula gives. A hull must also
 * be convex and contain every point. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geometry/primitives/height_field.h"
#include "geometry/shapes/hull.h"
#include "geometry/measure/node_measures.h"

static double drawn(uint64_t *seed) { /* returns a random number by xorshift, equal in every run */
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return (double)(*seed >> 11) / 9007199254740992.0;
}

/* Checks that the hull is closed and connected, and that no point is outside it by more than a step of the kernel's
 * grid. Returns the volume. */
static double check_hull(vs_cloud *c) {
  vs_mesh m = { 0 };
  assert_int_equal(vs_cloud_dimension(c), 3);
  assert_true(vs_cloud_hull(c, &m));
  assert_true(vs_mesh_closed(&m, NULL));
  assert_int_equal(m.triangle_count, 2 * m.vertex_count - 4);
  vs_bounds b = vs_mesh_bounds(&m);
  double size = vs_bounds_diagonal(&b), volume = vs_mesh_volume(&m);
  for (size_t t = 0; t < m.triangle_count && c->count < 3000; t++) {
    vs_vec3 a = m.vertices[m.triangles[t][0]], u = vs_v3_sub(m.vertices[m.triangles[t][1]], a), v = vs_v3_sub(m.vertices[m.triangles[t][2]], a), n = vs_v3_cross(u, v);
    for (size_t i = 0; i < c->count; i++) /* multiplies the distance by twice the triangle's area, because the plane of
                                           * a thin triangle is less exact */
      if (vs_v3_dot(n, vs_v3_sub(c->at[i], a)) > 1e-11 * size * size * size) fail_msg("point %zu lies outside face %zu", i, t);
  }
  vs_mesh_free(&m);
  vs_cloud_free(c);
  return volume;
}

static void hulls_of_points(void **state) {
  (void)state;
  uint64_t seed = 88172645463325252u;
  for (int round = 0; round < 200; round++) { /* random points in a box, on a ball, or on a coarse lattice (where many
                                               * points are coplanar); all are rotated, and far from the origin */
    vs_cloud c = { 0 };
    int kind = round % 4, n = 4 + (int)(drawn(&seed) * (round < 190 ? 60 : 2000));
    vs_affine turn = vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(drawn(&seed), 1, drawn(&seed)), drawn(&seed) * 6);
    for (int i = 0; i < n; i++) {
      vs_vec3 p = { drawn(&seed) * 2 - 1, drawn(&seed) * 2 - 1, drawn(&seed) * 2 - 1 };
      if (kind == 1) p = vs_v3_unit(p);
      if (kind >= 2) p = vs_v3(nearbyint(p.x * 2), nearbyint(p.y * 2), nearbyint(p.z * 2));
      if (kind == 3) p = vs_affine_point(&turn, vs_v3_scale(p, 1e6));
      assert_true(vs_cloud_add(&c, p));
    }
    for (int i = 0; i < 4; i++) assert_true(vs_cloud_add(&c, c.at[i])); /* adds four of the points a second time */
    if (vs_cloud_dimension(&c) == 3) check_hull(&c);
    else vs_cloud_free(&c);
  }
}

static void hulls_of_known_volume(void **state) {
  (void)state;
  vs_cloud lattice = { 0 }, ball = { 0 };
  uint64_t seed = 1;
  for (int i = 0; i < 1331; i++) assert_true(vs_cloud_add(&lattice, vs_v3(i % 11, i / 11 % 11, i / 121)));
  assert_true(check_hull(&lattice) == 1000);
  for (int i = 0; i < 20000; i++) {
    vs_vec3 p = { drawn(&seed) * 2 - 1, drawn(&seed) * 2 - 1, drawn(&seed) * 2 - 1 };
    if (vs_v3_dot(p, p) < 1) assert_true(vs_cloud_add(&ball, vs_v3_add(vs_v3_unit(p), vs_v3(100, 0, 0))));
  }
  assert_true(fabs(check_hull(&ball) - 4.18879) < 5e-3);
}

static void flat_hulls(void **state) {
  (void)state;
  vs_cloud c = { 0 };
  vs_polyline p;
  vs_affine turn = vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(1, 1, 1), 1);
  assert_int_equal(vs_cloud_dimension(&c), -1);
  assert_true(vs_cloud_add(&c, vs_affine_point(&turn, vs_v3(5, 5, 5))));
  assert_int_equal(vs_cloud_dimension(&c), 0);
  for (int i = 0; i < 5; i++) assert_true(vs_cloud_add(&c, vs_affine_point(&turn, vs_v3(5 + i, 5, 5))));
  assert_int_equal(vs_cloud_dimension(&c), 1);
  assert_true(vs_cloud_polygon(&c, &p));
  assert_int_equal(p.count, 2);
  vs_polyline_free(&p);
  for (int i = 0; i < 25; i++) assert_true(vs_cloud_add(&c, vs_affine_point(&turn, vs_v3(5 + i % 5, 5 + i / 5, 5))));
  assert_int_equal(vs_cloud_dimension(&c), 2);
  assert_true(vs_cloud_polygon(&c, &p));
  assert_int_equal(p.count, 4);
  vs_polyline_free(&p);
  vs_mesh m = { 0 };
  assert_true(vs_cloud_hull(&c, &m) && m.triangle_count == 0);
  vs_cloud_free(&c);
}

/* Tests height fields: a frustum of a pyramid with a border of one cell, an island that touches the floor, and a level
 * plain. */
static void height_fields(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  uint64_t seed = 7;
  for (int round = 0; round < 60; round++) {
    int columns = 2 + (int)(drawn(&seed) * 6), rows = 2 + (int)(drawn(&seed) * 6), kind = round % 3;
    vs_vec3 at[64];
    double sum = 0;
    for (int i = 0; i < columns * rows; i++) at[i] = vs_v3(1 + i % columns * 0.5, 2 + i / columns * 0.25, kind == 0 ? 3 : kind == 1 ? 1 + drawn(&seed) : fmax(1, drawn(&seed) * 2));
    vs_points *points = vs_points_new(s, at, (size_t)(columns * rows));
    vs_node *n = vs_node_new(s, VS_HEIGHT_FIELD, &(struct vs_height_field){ .points = points, .columns = columns, .low = kind == 2 ? 1 : 0.5 }, NULL, 0);
    double low = VS_AS(height_field, n)->low;
    for (int j = 0; j + 1 < rows; j++)
      for (int i = 0; i + 1 < columns; i++) {
        int a = j * columns + i;
        sum += 0.125 / 6 * (2 * at[a].z + at[a + 1].z + 2 * at[a + columns + 1].z + at[a + columns].z - 6 * low);
      }
    vs_mesh m = { 0 };
    vs_measure of;
    assert_true(vs_height_field_mesh(&m, VS_AS(height_field, n)));
    assert_true(vs_mesh_closed(&m, NULL));
    assert_true(fabs(vs_mesh_volume(&m) - sum) < 1e-12 * (1 + sum));
    assert_true(vs_node_measure(n, &of, NULL) && of.known && of.volume == vs_mesh_volume(&m));
    vs_inside *v = vs_inside_new(n, NULL);
    int hits = 0, all = 20000;
    vs_bounds b = vs_mesh_bounds(&m);
    if (!vs_bounds_is_empty(&b)) {
      for (int i = 0; i < all; i++)
        hits += vs_inside_test(v, vs_v3(b.min.x + (b.max.x - b.min.x) * drawn(&seed), b.min.y + (b.max.y - b.min.y) * drawn(&seed), b.min.z + (b.max.z - b.min.z) * drawn(&seed)));
      double box = (b.max.x - b.min.x) * (b.max.y - b.min.y) * (b.max.z - b.min.z), share = sum / box;
      assert_true(fabs((double)hits / all - share) <= 5 * sqrt(share * (1 - share) / all) + 1e-9);
    }
    vs_inside_free(v);
    vs_mesh_free(&m);
    vs_node_release(n);
    vs_points_release(s, points);
  }
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(hulls_of_points), cmocka_unit_test(hulls_of_known_volume), cmocka_unit_test(flat_hulls), cmocka_unit_test(height_fields),
  };
  return cmocka_run_group_tests_name("hulls and height fields", tests, NULL, NULL);
}
