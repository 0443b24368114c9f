/* Tests that welding removes details smaller than a step of the grid from a mesh, and changes nothing else.
 *
 * The test splits the edges of a cube again and again, near their ends and in their middles, and displaces every new
 * corner slightly. The mesh then has hundreds of very thin triangles, tiny triangles and folds. After welding it must
 * be closed, without short edges and thin triangles. Its winding number at each point must be as before, except within
 * a few steps of its surface. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>

#include "model/net.h"
#include "solids/weld.h"
#include "tests/unit/dice.h"

enum { CUBES = 60, SPLITS = 120, POINTS = 60 };
static const double step = 1e-3, pi = 3.14159265358979323846;

static vs_mesh cube(void) {
  static const uint32_t faces[12][3] = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
                                         { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  vs_mesh m = { 0 };
  for (int i = 0; i < 8; i++) assert_true(vs_mesh_add_vertex(&m, vs_v3(i & 1, i >> 1 & 1, i >> 2), NULL));
  for (int t = 0; t < 12; t++) assert_true(vs_mesh_add_triangle(&m, faces[t][0], faces[t][1], faces[t][2]));
  return m;
}

/* Splits a random edge at a new corner near the edge, in all triangles that have this edge. */
static void split(vs_mesh *m, dice *d) {
  static const double parts[] = { 1e-9, 1e-5, 1e-4, .3, .5, .9999 };
  uint32_t *t = m->triangles[throw(d) % m->triangle_count], a = t[0], b = t[1], c;
  double part = parts[throw(d) % 6], off = step * (throw(d) % 3 ? .1 : 1e-6);
  vs_vec3 p = m->vertices[a], way = vs_v3_sub(m->vertices[b], p), noise = { between(d, -off, off), between(d, -off, off), between(d, -off, off) };
  assert_true(vs_mesh_add_vertex(m, vs_v3_add(vs_v3_add(p, vs_v3_scale(way, part)), noise), &c));
  for (size_t i = 0, n = m->triangle_count; i < n; i++)
    for (int j = 0; j < 3; j++) {
      uint32_t *u = m->triangles[i], from = u[j], to = u[(j + 1) % 3], top = u[(j + 2) % 3];
      if (!((from == a && to == b) || (from == b && to == a))) continue;
      u[(j + 1) % 3] = c;
      assert_true(vs_mesh_add_triangle(m, c, to, top));
      break;
    }
}

/* Returns the winding number of m at p. */
static double winding(const vs_mesh *m, vs_vec3 p) {
  double sum = 0;
  for (size_t t = 0; t < m->triangle_count; t++) {
    vs_vec3 v[3];
    double l[3];
    for (int i = 0; i < 3; i++) v[i] = vs_v3_sub(m->vertices[m->triangles[t][i]], p), l[i] = vs_v3_length(v[i]);
    sum += 2 * atan2(vs_v3_dot(v[0], vs_v3_cross(v[1], v[2])), l[0] * l[1] * l[2] + vs_v3_dot(v[0], v[1]) * l[2] + vs_v3_dot(v[1], v[2]) * l[0] + vs_v3_dot(v[2], v[0]) * l[1]);
  }
  return sum / (4 * pi);
}

static bool near_cube(vs_vec3 p, double distance) { /* returns true if p is near the surface of the cube */
  double inside = fmin(fmin(fmin(p.x, 1 - p.x), fmin(p.y, 1 - p.y)), fmin(p.z, 1 - p.z));
  return fabs(inside) < distance;
}

static void check(const vs_mesh *m, dice *d) {
  bool closed;
  assert_true(vs_mesh_closed(m, &closed));
  assert_true(closed);
  for (size_t v = 0; v < m->vertex_count; v++)
    for (size_t u = 0; u < v; u++) assert_true(vs_v3_length(vs_v3_sub(m->vertices[u], m->vertices[v])) >= step);
  for (size_t t = 0; t < m->triangle_count; t++) {
    vs_vec3 a = m->vertices[m->triangles[t][0]], b = m->vertices[m->triangles[t][1]], c = m->vertices[m->triangles[t][2]];
    double longest = fmax(vs_v3_length(vs_v3_sub(a, b)), fmax(vs_v3_length(vs_v3_sub(b, c)), vs_v3_length(vs_v3_sub(c, a))));
    assert_true(vs_v3_length(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a))) >= step * longest);
  }
  for (int i = 0; i < POINTS; i++) {
    vs_vec3 p = { between(d, -.5, 1.5), between(d, -.5, 1.5), between(d, -.5, 1.5) };
    bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1;
    if (!near_cube(p, 8 * step)) assert_true(fabs(winding(m, p) - (inside ? 1 : 0)) < 1e-6);
  }
}

static void welded_meshes_have_no_details(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= CUBES; seed++) {
    dice d = { seed };
    vs_mesh m = cube();
    for (int i = 0; i < SPLITS; i++) split(&m, &d);
    size_t before = m.triangle_count;
    assert_true(vs_mesh_weld(&m, step));
    assert_true(m.triangle_count < before);
    check(&m, &d);
    vs_mesh_free(&m);
  }
}

/* Tests that welding keeps details larger than a step of the grid: no corner changes. */
static void welding_keeps_the_rest(void **state) {
  (void)state;
  vs_mesh m = cube(), w = cube();
  assert_true(vs_mesh_weld(&w, step));
  assert_int_equal(w.vertex_count, 8);
  assert_int_equal(w.triangle_count, 12);
  for (int v = 0; v < 8; v++) assert_true(vs_v3_equal(m.vertices[v], w.vertices[v]));
  vs_mesh_free(&m);
  vs_mesh_free(&w);
}

static void sheets_cancel(void **state) {
  (void)state;
  vs_mesh m = cube();
  assert_true(vs_mesh_add_triangle(&m, 0, 1, 2)); /* adds the first triangle again, reversed */
  assert_true(vs_mesh_add_triangle(&m, 5, 6, 4)); /* adds the third triangle again, in the same orientation */
  assert_true(vs_mesh_add_triangle(&m, 3, 3, 4));
  assert_true(vs_mesh_net(&m, 0));
  assert_int_equal(m.triangle_count, 12);
  int thirds = 0;
  for (size_t t = 0; t < m.triangle_count; t++) thirds += m.triangles[t][0] == 4 && m.triangles[t][1] == 5 && m.triangles[t][2] == 6;
  assert_int_equal(thirds, 2);
  vs_mesh_free(&m);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(welded_meshes_have_no_details), cmocka_unit_test(welding_keeps_the_rest), cmocka_unit_test(sheets_cancel) };
  return cmocka_run_group_tests_name("weld", tests, NULL, NULL);
}
