/* Tests three functions for meshes: the check whether a mesh is a solid, the repair of self-intersections, and the
 * rounding of coordinates. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel/mesh/triangles_apart.h"
#include "kernel/mesh/inspect.h"
#include "kernel/round/rounding.h"
#include "tests/oracle/sx.c"
#include "tests/tools/crossings.h"

/* Joins the solids of the .sx text into a single mesh, each solid at its own place. The solids from number `turned` on
 * are inside out. */
static void join(vs_mesh *m, const char *text, uint32_t turned) {
  sx_problem p;
  assert_true(sx_parse(text, &p));
  for (uint32_t i = 0; i < p.problem.leaf_count; i++) {
    const vs_kernel_leaf *l = &p.problem.leaves[i];
    uint32_t base = (uint32_t)m->vertex_count;
    size_t first = m->triangle_count;
    for (size_t j = 0; j < l->mesh->vertex_count; j++) assert_true(vs_mesh_add_vertex(m, vs_affine_point(&l->placement, l->mesh->vertices[j]), NULL));
    for (size_t j = 0; j < l->mesh->triangle_count; j++) {
      const uint32_t *t = l->mesh->triangles[j];
      assert_true(vs_mesh_add_triangle(m, base + t[0], base + t[1], base + t[2]));
    }
    if (i >= turned) vs_mesh_turn(m, first);
  }
  sx_free(&p);
}

static vs_mesh_flaws inspect(const char *text, uint32_t turned, double volume) {
  vs_mesh m = { 0 }, made = { 0 };
  vs_mesh_flaws f;
  vs_kernel_error e;
  join(&m, text, turned);
  if (!vs_kernel_inspect(&m, NULL, &f, &e)) fail_msg("%s: %s", text, e.message);
  if (volume >= 0) {
    if (!vs_kernel_resolve(&m, 3, NULL, &made, &e)) fail_msg("%s: %s", text, e.message);
    if (!(fabs(vs_mesh_volume(&made) - volume) < 1e-6 * volume)) fail_msg("%s: %.12g is not %.12g", text, vs_mesh_volume(&made), volume);
    vs_mesh_flaws again;
    assert_true(vs_kernel_inspect(&made, NULL, &again, &e));
    assert_true(vs_mesh_flawless(&again));
    for (size_t i = 0; i < made.triangle_count; i++) assert_int_equal(made.tags[i], 3);
  }
  vs_mesh_free(&m);
  vs_mesh_free(&made);
  return f;
}

static void test_simple(void **state) {
  (void)state;
  static const char *const good[] = {
    "(box 1 2 3)", "(sphere 2 32)", "(rotate 33 21 17 (sphere 2 32))", "(union (box 1 1 1) (translate 2 0 0 (box 1 1 1)))",
    "(union (box 1 1 1) (translate 1 0 0 (box 1 1 1)))", "(union (box 1 1 1) (translate 1 1 0 (box 1 1 1)))", "(torus 3 1 24 12)",
    "(rotate 10 20 30 (union (box 1 1 1) (translate 1 1 1 (box 1 1 1))))" };
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    vs_mesh_flaws f = inspect(good[i], 9, -1);
    if (!vs_mesh_flawless(&f) || f.least != 0 || f.most != 1) fail_msg("%s: %zu open, %zu wound %d..%d", good[i], f.open_count, f.wound_count, f.least, f.most);
  }
  /* the second box is inside out, and therefore a cavity */
  vs_mesh_flaws f = inspect("(union (box 3 3 3) (translate 1 1 1 (box 1 1 1)))", 1, 26);
  assert_true(vs_mesh_flawless(&f));
}

static void test_wound(void **state) {
  (void)state;
  vs_mesh_flaws f = inspect("(union (box 2 2 2) (translate 1 1 1 (box 2 2 2)))", 9, 15);
  assert_true(f.wound_count > 0);
  assert_int_equal(f.most, 2);
  for (size_t i = 0; i < f.wound_count && i < VS_FLAWS_LISTED; i++) {
    assert_true(i == 0 || f.wound[i - 1].triangle < f.wound[i].triangle);
    vs_vec3 at = f.wound[i].at; /* a point on the small cube, which lies inside both solids */
    assert_true(at.x >= 1 && at.y >= 1 && at.z >= 1 && at.x <= 2 && at.y <= 2 && at.z <= 2);
    assert_int_equal(f.wound[i].winding, 2);
  }
  f = inspect("(union (box 2 2 2) (box 2 2 2))", 9, 8); /* two equal boxes at one place: no faces cross, but the mesh is
                                                         * not a solid */
  assert_int_equal(f.most, 2);
  assert_true(f.wound_count > 0);
  f = inspect("(union (box 3 3 3) (translate 1 1 1 (box 1 1 1)))", 9, 27);
  assert_int_equal(f.most, 2);
  assert_int_equal(f.wound_count, 6);
  f = inspect("(box 1 1 1)", 0, -1);
  assert_int_equal(f.least, -1);
  assert_int_equal(f.wound_count, 6);
  assert_true(f.volume < 0);
  f = inspect("(union (box 2 2 2) (translate 5 0 0 (box 1 1 1)))", 1, 8); /* the second box is inside out, and lies
                                                                           * outside the first box */
  assert_int_equal(f.least, -1);
  assert_int_equal(f.wound_count, 6);
  f = inspect("(union (rotate 12 34 56 (sphere 2 32)) (translate 1.5 0 0 (sphere 1 32)))", 9, -1);
  assert_int_equal(f.most, 2);
}

static void test_open(void **state) {
  (void)state;
  vs_mesh m = { 0 };
  vs_mesh_flaws f;
  vs_kernel_error e;
  join(&m, "(box 1 1 1)", 9);
  m.triangle_count--;
  assert_true(vs_kernel_inspect(&m, NULL, &f, &e));
  assert_int_equal(f.open_count, 3);
  assert_true(f.open[0].triangle <= f.open[1].triangle && f.open[2].triangle < 11);
  vs_mesh made = { 0 };
  assert_false(vs_kernel_resolve(&m, 0, NULL, &made, &e));
  assert_int_equal(e.status, VS_KERNEL_OPEN);
  m.triangle_count++;
  uint32_t swap = m.triangles[3][0];
  m.triangles[3][0] = m.triangles[3][1];
  m.triangles[3][1] = swap; /* reverses the orientation of a single face */
  assert_true(vs_kernel_inspect(&m, NULL, &f, &e));
  assert_int_equal(f.open_count, 3);
  m.vertices[2].x = NAN;
  assert_false(vs_kernel_inspect(&m, NULL, &f, &e));
  assert_int_equal(e.status, VS_KERNEL_NOT_FINITE);
  vs_mesh_free(&m);
  vs_mesh_free(&made);
}

static bool count_polls(void *context, const char *stage, double done) { return (void)stage, (void)done, ++*(size_t *)context, true; }

/* Returns the number of polls for an interrupt while boxes are sorted by their level of nesting (storey). The boxes
 * form a stair with very many storeys, or lie at one place with six storeys. The two arrangements have equally many
 * triangles, so the polls differ only by the sorting. The faces of each side are consecutive. */
static size_t polls_of_stair(size_t boxes, double step) {
  vs_mesh m = { 0 };
  size_t polls = 0;
  vs_rounded s;
  vs_kernel_error e;
  for (size_t i = 0; i < boxes; i++) {
    double at = step * (double)i;
    for (int k = 0; k < 8; k++)
      assert_true(vs_mesh_add_vertex(&m, vs_v3(at + (k & 1), at + (k >> 1 & 1), at + (k >> 2)), NULL));
  }
  for (size_t i = 0; i < 12 * boxes; i++) {
    static const uint8_t faces[12][3] = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                                          { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
    const uint8_t *face = faces[i / boxes];
    uint32_t base = 8 * (uint32_t)(i % boxes);
    assert_true(vs_mesh_add_triangle(&m, base + face[0], base + face[1], base + face[2]));
  }
  vs_kernel_options o = { .job = &(vs_job){ .going = count_polls, .context = &polls }, .threads = 1 };
  assert_true(vs_mesh_round(&m, VS_NUMBERS_DIGITS, &o, &s, &e));
  vs_mesh_free(&m);
  return polls;
}

/* Sorting shells by their level of nesting (storey) polls for an interrupt: with more storeys, it polls more often. */
static void test_storeys_are_interrupted(void **state) {
  (void)state;
  size_t few = polls_of_stair(40000, 0), many = polls_of_stair(40000, 3);
  if (many < few + 8) fail_msg("%zu polls, and %zu where there is nothing to sort", many, few);
}

/* Tests a mesh with vertices closer than the file format's precision. Rounding merges them, and the mesh stays closed
 * and encloses the same solid. */
static void test_settle(void **state) {
  (void)state;
  vs_mesh m = { 0 };
  vs_rounded s;
  bool sure;
  join(&m, "(sphere 2 32)", 9);
  size_t triangles = m.triangle_count, vertices = m.vertex_count;
  double volume = vs_mesh_volume(&m);
  assert_true(vs_mesh_round(&m, VS_NUMBERS_SINGLE, NULL, &s, NULL));
  assert_int_equal(s.collapsed + s.flipped + s.met, 0);
  assert_int_equal(m.triangle_count, triangles);
  for (uint32_t t = 0; t < triangles; t += 211) { /* moves a vertex of every 211th triangle almost onto another vertex
                                                   * of the triangle */
    uint32_t *v = m.triangles[t];
    m.vertices[v[1]] = vs_v3_add(m.vertices[v[0]], vs_v3(1e-9, 0, -1e-9));
  }
  double pulled = vs_mesh_volume(&m);
  assert_true(vs_mesh_round(&m, VS_NUMBERS_DIGITS, NULL, &s, NULL));
  assert_int_equal(s.collapsed, 0); /* with 12 digits, the moved vertices still differ from their neighbours */
  assert_true(vs_mesh_round(&m, VS_NUMBERS_SINGLE, NULL, &s, NULL));
  assert_int_equal(s.collapsed, 5);
  assert_int_equal(m.triangle_count, triangles - 2 * s.collapsed);
  assert_int_equal(m.vertex_count, vertices - s.collapsed);
  assert_true(vs_mesh_closed(&m, &sure));
  assert_true(fabs(vs_mesh_volume(&m) - pulled) < 1e-6 && pulled < volume);
  vs_mesh_free(&m);
  join(&m, "(cyl 1 1 0 3)", 9); /* a tetrahedron smaller than the file format's precision is kept, since rounding would
                                 * flatten it to sheets */
  for (size_t i = 0; i < m.vertex_count; i++) m.vertices[i] = vs_v3_add(vs_v3(1000, 1000, 1000), vs_v3_scale(m.vertices[i], 1e-6));
  assert_true(vs_mesh_round(&m, VS_NUMBERS_SINGLE, NULL, &s, NULL));
  assert_int_equal(m.triangle_count, 4);
  assert_true(vs_mesh_closed(&m, &sure));
  vs_mesh_free(&m);
}

/* Tests two rotated cubes with a gap that 32-bit numbers cannot represent. The cubes are shifted along the gap, so no
 * triangle is thin, but after rounding to 32 bits the cubes intersect. */
static void test_between(void **state) {
  (void)state;
  static const double gaps[] = { 1e-9, 1e-3 };
  for (int i = 0; i < 2; i++) {
    vs_mesh m = { 0 };
    vs_rounded s;
    join(&m, "(union (rotate 33 21 17 (translate 20 1 5 (box 2 2 2))) (rotate 33 21 17 (translate 20 1 5 (box 2 2 2))))", 9);
    size_t n = m.vertex_count / 2;
    vs_vec3 along[3];
    for (size_t v = 1, found = 0; v < n && found < 3; v++) {
      along[found] = vs_v3_sub(m.vertices[v], m.vertices[0]);
      found += fabs(vs_v3_length(along[found]) - 2) < 1e-6;
    }
    for (size_t v = n; v < 2 * n; v++)
      m.vertices[v] = vs_v3_add(m.vertices[v], vs_v3_add(vs_v3_scale(along[0], 1 + gaps[i] / 2), vs_v3_add(vs_v3_scale(along[1], 0.31), vs_v3_scale(along[2], 0.17))));
    assert_true(vs_mesh_round(&m, VS_NUMBERS_SINGLE, NULL, &s, NULL));
    assert_int_equal(s.collapsed + s.flipped + s.dropped, 0);
    assert_int_equal(s.met > 0, i == 0);
    vs_mesh_free(&m);
  }
}

/* Tests a bent bar whose two ends nearly touch, with a gap below the file format's precision. Along the surface, the
 * ends are far from each other. If the bar is rotated, rounding makes the ends intersect. If it is parallel to the
 * axes, they intersect only if both ends are rounded to one plane. */
static void test_ends(void **state) {
  (void)state;
  static const char ring[] = "(union (box 5 1 1) (box 1 1 5) (translate 0 0 4 (box 5 1 1)) (translate 4 0 0 (box 1 1 2)) (translate 4.31 0.23 2.5 (box 0.5 0.5 2)))";
  static const struct { double gap; vs_numbers numbers; bool turned, meets; } cases[] = {
    { 1e-9, VS_NUMBERS_SINGLE, true, true }, { 1e-3, VS_NUMBERS_SINGLE, true, false }, { 1e-9, VS_NUMBERS_DIGITS, true, false }, { 1e-12, VS_NUMBERS_DIGITS, true, true },
    { 1e-9, VS_NUMBERS_SINGLE, false, true }, { 1e-6, VS_NUMBERS_SINGLE, false, false } };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    sx_problem p;
    vs_mesh m = { 0 };
    vs_rounded s;
    vs_kernel_error e;
    vs_affine turn = vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(3, 1, 2), 1);
    assert_true(sx_parse(ring, &p));
    assert_true(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
    sx_free(&p);
    size_t moved = 0;
    for (size_t v = 0; v < m.vertex_count; v++)
      if (fabs(m.vertices[v].z - 2.5) < 1e-6) m.vertices[v].z = 2 + cases[i].gap, moved++;
    assert_int_equal(moved, 4);
    if (cases[i].turned) vs_mesh_transform(&m, &turn);
    assert_true(vs_mesh_round(&m, cases[i].numbers, NULL, &s, NULL));
    assert_int_equal(s.collapsed + s.flipped + s.dropped, 0);
    assert_int_equal(s.met > 0, cases[i].meets);
    vs_mesh_free(&m);
  }
}

/* Makes two cones, base to base, on a ring of `steps` steps; each step is a seventh of a turn. With `turns` 2 the ring
 * goes round twice: its second turn begins further out than the first and ends further in. Seen from the centre, all
 * triangles face outwards. The triangles of step `first` come first in the mesh. `closed` joins the ring's ends.
 * Returns the number of triangles that intersect. */
static size_t met_by_turns(int turns, int steps, int first, bool closed) {
  vs_mesh m = { 0 };
  vs_rounded s;
  for (int i = 0; i < 2; i++) assert_true(vs_mesh_add_vertex(&m, vs_v3(0, 0, i ? 1 : -1), NULL));
  for (int i = 0; i <= steps; i++) {
    double angle = 6.283185307179586 * i / 7, out = turns > 1 ? 1.2 + 0.05 * (i % 7) * (i < 7 ? 1 : -1) - (i < 7 ? 0.15 : 0) : 1;
    assert_true(vs_mesh_add_vertex(&m, vs_v3(out * cos(angle), out * sin(angle), 0), NULL));
  }
  for (int i = 0; i < steps; i++) { /* puts the triangles of step `first` first */
    uint32_t k = 2 + (uint32_t)((i + first) % steps), next = closed && k == (uint32_t)steps + 1 ? 2 : k + 1;
    assert_true(vs_mesh_add_triangle(&m, k, next, 1) && vs_mesh_add_triangle(&m, next, k, 0));
  }
  if (closed) m.vertex_count--; /* in a closed ring, the last vertex equals the first and is not stored */
  assert_true(vs_mesh_round(&m, VS_NUMBERS_SINGLE, NULL, &s, NULL));
  vs_mesh_free(&m);
  return s.met;
}

static size_t met_by(const char *parts, double pull) {
  vs_mesh m = { 0 };
  vs_rounded s;
  join(&m, parts, 9);
  m.vertices[0] = vs_v3_scale(m.vertices[0], 1 - pull); /* moves a vertex of a ball around the origin towards the
                                                         * opposite side; a `pull` above 1 moves it past the centre */
  assert_true(vs_mesh_round(&m, VS_NUMBERS_SINGLE, NULL, &s, NULL));
  vs_mesh_free(&m);
  return s.met;
}

/* The search for self-intersections skips shells that are separate and star-shaped about their centre. It must test
 * shells that only appear to be star-shaped. */
static void test_stars(void **state) {
  (void)state;
  assert_int_equal(met_by_turns(1, 7, 0, true), 0);
  assert_true(met_by_turns(2, 14, 0, true) > 0);   /* a ray from the centre in any direction intersects the ring of two
                                                    * turns twice */
  assert_true(met_by_turns(2, 11, 5, false) > 0);  /* an open ring: a ray from the centre in the direction of its first
                                                    * triangle intersects it once */
  assert_int_equal(met_by("(sphere 2 32)", 0), 0);
  assert_int_equal(met_by("(sphere 2 32)", 0.7), 0); /* a vertex that is pulled inwards makes a dent: the mesh is no
                                                      * longer star-shaped, but has no self-intersections */
  assert_true(met_by("(sphere 2 32)", 2.5) > 0);
  assert_int_equal(met_by("(union (sphere 2 32) (translate 9 0 0 (sphere 2 16)))", 0), 0);
  assert_true(met_by("(union (sphere 2 32) (translate 3 0 0 (sphere 2 16)))", 0) > 0);
}

/* Tests the fast test of two triangles, which computes in doubles. If it reports the triangles as disjoint, they must
 * be disjoint by exact signs. The random triangles have vertices at and near few points. */
static void test_apart(void **state) {
  (void)state;
  uint64_t seed = 88172645463325252u;
  size_t said = 0, met = 0, missed = 0;
  for (int n = 0; n < 200000; n++) {
    crossings_point at[6];
    crossings_triangle triangles[2] = { { 0, 1, 2 }, { 3, 4, 5 } };
    crossings_found found;
    vs_vec3 v[6];
    int shared;
    for (int i = 0; i < 6; i++)
      for (int k = 0; k < 3; k++) {
        seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
        at[i][k] = n % 3 == 0 && k == 2 ? 0 : (double)((seed >> 33) % 4) + (n % 5 == 0 && (seed >> 50) % 3 == 0 ? 1e-16 * (double)((seed >> 40) % 9) : 0);
      }
    for (int i = 0; i < 6; i++) v[i] = vs_v3(at[i][0], at[i][1], at[i][2]);
    if (n % 2) memcpy(at[3], at[1], sizeof at[3]), v[3] = v[1];
    if (n % 4 == 3) memcpy(at[4], at[0], sizeof at[4]), v[4] = v[0];
    assert_true(crossings_find((const crossings_point *)at, 6, (const crossings_triangle *)triangles, 2, &found));
    size_t faults = crossings_sum(&found);
    bool apart = vs_triangles_apart(v, v + 3, &shared);
    assert_false(apart && faults > found.count[CROSSINGS_FLAT]);
    said += apart;
    met += faults > 0;
    missed += !apart && faults == 0;
  }
  assert_true(said > 40000 && met > 40000); /* the fast test often reports disjoint triangles, and the random triangles
                                             * often intersect */
  assert_true(missed * 5 < said);           /* the fast test rarely fails to recognize disjoint triangles, although many
                                             * triangles touch */
  /* two triangles with one common vertex, on opposite sides of it, as at the centre of a torus without a hole */
  const vs_vec3 opposed[6] = { { 0, 0, 0 }, { 3, 1, 1 }, { 3, -1, 1 }, { 0, 0, 0 }, { -3, -1, -1 }, { -3, 1, -1 } };
  int shared;
  assert_true(vs_triangles_apart(opposed, opposed + 3, &shared));
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_simple), cmocka_unit_test(test_wound), cmocka_unit_test(test_open), cmocka_unit_test(test_settle),
    cmocka_unit_test(test_storeys_are_interrupted), cmocka_unit_test(test_between), cmocka_unit_test(test_ends), cmocka_unit_test(test_stars), cmocka_unit_test(test_apart) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
