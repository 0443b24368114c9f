/* Tests large numbers of objects: many solids in one place, vertices with very many triangles, and tables of very many
 * meshes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "kernel/check.h"
#include "kernel/mesh/bvh.h"
#include "kernel/mesh/hubs.h"
#include "kernel/mesh/inspect.h"
#include "kernel/mesh/triangles_apart.h"
#include "tests/oracle/sx.c"
#include "visualscheme.h"

/* ---- crowds: many solids in one place ---- */

static void near(double a, double b, double relative) {
  if (fabs(a - b) > relative * fmax(1, fabs(b))) fail_msg("%.17g is not %.17g", a, b);
}

static double area_of(const vs_mesh *m, uint32_t tag) {
  double sum = 0;
  for (size_t i = 0; i < m->triangle_count; i++) {
    const vs_vec3 *v = m->vertices;
    const uint32_t *t = m->triangles[i];
    vs_vec3 n = vs_v3_cross(vs_v3_sub(v[t[1]], v[t[0]]), vs_v3_sub(v[t[2]], v[t[0]]));
    if (m->tags[i] == tag) sum += sqrt(vs_v3_dot(n, n)) / 2;
  }
  return sum;
}

/* Evaluates the expression in a single step, then level by level of its tree, with one thread and with three. Volumes,
 * and the area of each operand's part of the surface, must be equal. The number of threads must not change any byte. */
static void check_levels(const char *text) {
  sx_problem p;
  assert_true(sx_parse(text, &p));
  for (uint32_t i = 0; i < p.problem.leaf_count; i++) p.leaves[i].tag = i;
  vs_mesh m[3] = { { 0 }, { 0 }, { 0 } };
  for (int i = 0; i < 3; i++) {
    vs_kernel_options options = { .threads = i == 2 ? 3 : 1, .in_levels = i > 0 };
    vs_kernel_error e;
    bool sure;
    if (!vs_kernel_evaluate(&p.problem, &options, &m[i], &e)) fail_msg("%d: %s", i, e.message);
    assert_true(vs_mesh_closed(&m[i], &sure));
    assert_true(m[i].triangle_count > 0);
  }
  near(vs_mesh_volume(&m[1]), vs_mesh_volume(&m[0]), 1e-12);
  for (uint32_t i = 0; i < p.problem.leaf_count; i++) near(area_of(&m[1], i), area_of(&m[0], i), 1e-9);
  assert_int_equal(m[2].triangle_count, m[1].triangle_count);
  assert_int_equal(m[2].vertex_count, m[1].vertex_count);
  assert_memory_equal(m[2].vertices, m[1].vertices, m[1].vertex_count * sizeof *m[1].vertices);
  assert_memory_equal(m[2].triangles, m[1].triangles, m[1].triangle_count * sizeof *m[1].triangles);
  for (int i = 0; i < 3; i++) vs_mesh_free(&m[i]);
  sx_free(&p);
}

/* Returns a text: `before`, then `count` copies of the solid `form`, each rotated differently about a common centre,
 * then `after`. */
static char *turned(const char *before, const char *form, int count, double by, const char *after) {
  char *text = malloc(200 * (size_t)count + 400), *to = text;
  assert_non_null(text);
  to += sprintf(to, "%s", before);
  for (int i = 0; i < count; i++)
    to += sprintf(to, " (rotate %.12g %.12g %.12g %s)", by * (i * 7 % 11 - 5), by * (i * 5 % 13 - 6),
        by * (i * 3 % 17 - 8), form);
  sprintf(to, "%s", after);
  return text;
}

static void test_levels(void **state) {
  (void)state;
  static const struct { const char *before, *form, *after; int count; double by; } crowds[] = {
    { "(union", "(cbox 10 10 10)", ")", 12, 0.002 },
    { "(union", "(cbox 10 10 10)", ")", 12, 9 },                                            /* solids rotated by large
                                                                                             * angles, so that much of
                                                                                             * each solid is visible */
    { "(union", "(translate 0 0 -10 (cyl 20 0.3 0.3 8))", " (translate 3 3 3 (sphere 1 12)))", 12, 13 },
    /* a box from which many cylinders are subtracted: the kernel unites the cylinders first */
    { "(difference (cbox 8 8 8)", "(translate 0 0 -10 (cyl 20 0.3 0.3 8))", ")", 12, 13 },
    /* no operand can be combined before the others, so all are combined in one step */
    { "(intersection (cbox 9.5 9.5 9.5) (union", "(cbox 10 10 9)", "))", 10, 3 },
    /* a difference that must be combined last, beside boxes that can be combined level by level */
    { "(union (difference (cbox 12 12 12) (cbox 11 11 30))", "(cbox 10 10 10)", ")", 8, 5 },
    /* boxes rotated by quarter turns, so that many faces are coplanar */
    { "(union", "(cbox 10 10 10)", ")", 5, 90 },
    /* the spheres have so many facets that several threads intersect them; the table of new points must grow
     * repeatedly */
    { "(union", "(sphere 10 64)", ")", 4, 0.05 },
  };
  for (size_t i = 0; i < sizeof crowds / sizeof *crowds; i++) {
    char *text = turned(crowds[i].before, crowds[i].form, crowds[i].count, crowds[i].by, crowds[i].after);
    check_levels(text);
    free(text);
  }
}

/* Tests a hundred and sixty boxes at one place, whose faces all intersect. The kernel must combine them level by level:
 * in a single step, millions of lines of intersection would cross each other, which needs several gigabytes. */
static void test_crowd_is_found(void **state) {
  (void)state;
  char *text = turned("(union", "(cbox 10 10 10)", 160, 0.00071, ")");
  sx_problem p;
  vs_mesh m = { 0 };
  vs_kernel_options options = { .threads = 1, .max_bytes = 200 << 20 };
  vs_kernel_error e;
  assert_true(sx_parse(text, &p));
  if (!vs_kernel_evaluate(&p.problem, &options, &m, &e)) fail_msg("%s", e.message);
  near(vs_mesh_volume(&m), 1000, 0.01);
  vs_mesh_free(&m);
  sx_free(&p);
  free(text);
}

/* ---- hubs: vertices with very many triangles ---- */

enum { CONE, FOLDED, TWICE, SADDLE, OPEN };

static vs_vec3 corner_of(const void *mesh, uint32_t vertex) { return ((const vs_mesh *)mesh)->vertices[vertex]; }

/* Returns true if the kernel proves that all triangles around vertex 0, called a hub, are disjoint. `what` selects the
 * mesh: a cone of n sides (CONE); a cone with a side that folds back over its neighbour; a cone that goes around twice;
 * a cone whose rim goes up and down; a cone with a gap. */
static bool is_proven(int what, uint32_t n) {
  vs_mesh m = { 0 };
  uint32_t id;
  assert_true(vs_mesh_add_vertex(&m, vs_v3(0, 0, 1), &id));
  for (uint32_t i = 0; i < n; i++) {
    double at = what == FOLDED && i == n / 2 ? i - 1.5 : i, angle = 2 * acos(-1) * at / n * (what == TWICE ? 2 : 1);
    assert_true(vs_mesh_add_vertex(&m, vs_v3(cos(angle), sin(angle), what == SADDLE ? 1 + 3 * cos(2 * angle) : 0),
        &id));
  }
  for (uint32_t i = 0; i < n - (what == OPEN); i++) assert_true(vs_mesh_add_triangle(&m, 0, 1 + i, 1 + (i + 1) % n));
  vs_kernel_options options = { .threads = 1 };
  vs_kernel_error e = { 0 };
  vs_kernel k = { .options = &options, .error = &e, .threads = 1 };
  vs_fans fans = { (const uint32_t (*)[3])m.triangles, m.triangle_count, m.vertex_count, NULL, corner_of, &m };
  vs_hubs hubs = { .edges = 0 };
  size_t proven = 0;
  assert_true(vs_hubs_find(&k, &fans, &hubs));
  for (size_t t = 0; t < hubs.of.count; t++) {
    assert_true(hubs.of.at[t] == 0 || hubs.of.at[t] == UINT32_MAX);
    proven += hubs.of.at[t] == 0;
  }
  assert_true(proven == 0 || proven == m.triangle_count);
  assert_int_equal(hubs.edges, proven); /* around the hub there are as many edges as proven triangles: each triangle
                                         * shares an edge with the next */
  assert_int_equal(hubs.corners.count, proven > 0);
  vs_hubs_free(&k, &hubs);
  assert_int_equal(k.bytes, 0);
  vs_mesh_free(&m);
  return proven > 0;
}

static void test_hubs(void **state) {
  (void)state;
  for (uint32_t n = 100; n <= 10000; n *= 10) {
    assert_true(is_proven(CONE, n));
    assert_false(is_proven(FOLDED, n));
    assert_false(is_proven(TWICE, n));
    assert_true(is_proven(SADDLE, n));
    assert_false(is_proven(OPEN, n));
  }
  assert_false(is_proven(CONE, 60)); /* a vertex with only 60 triangles is not treated as a hub; its triangles are
                                      * tested in pairs */
}

/* Adds a cone with the apex `tip`, and a rim of n vertices around `middle`. The rim's radius varies by the fraction
 * `waves`. */
static void add_cone(vs_mesh *m, vs_vec3 tip, vs_vec3 middle, double radius, double waves, uint32_t n, bool inwards) {
  uint32_t hub, first = (uint32_t)m->vertex_count + 1, id;
  assert_true(vs_mesh_add_vertex(m, tip, &hub));
  for (uint32_t i = 0; i < n; i++) {
    double angle = 2 * acos(-1) * i / n, r = radius * (1 + waves * cos(5 * angle));
    assert_true(vs_mesh_add_vertex(m, vs_v3_add(middle, vs_v3(r * cos(angle), r * sin(angle), 0)), &id));
  }
  for (uint32_t i = 0; i < n; i++) {
    uint32_t p = first + i, q = first + (i + 1) % n;
    assert_true(vs_mesh_add_triangle(m, hub, inwards ? q : p, inwards ? p : q));
  }
}

/* Returns the number of families of the mesh's triangles: any two triangles of a family share an edge or are proven
 * disjoint. Returns 0 if any triangle belongs to no hub (a vertex with very many triangles). */
static size_t families_in(vs_mesh *m) {
  vs_kernel_options options = { .threads = 1 };
  vs_kernel_error e = { 0 };
  vs_kernel k = { .options = &options, .error = &e, .threads = 1 };
  vs_fans fans = { (const uint32_t (*)[3])m->triangles, m->triangle_count, m->vertex_count, NULL, corner_of, m };
  vs_hubs hubs = { .edges = 0 };
  size_t count = 0;
  int shared;
  assert_true(vs_hubs_find(&k, &fans, &hubs));
  assert_int_equal(hubs.of.count, m->triangle_count);
  bool all = hubs.edges == m->triangle_count; /* whether the hubs have together as many edges as the mesh has triangles,
                                               * so that each triangle belongs to a hub */
  for (uint32_t a = 0; a < m->triangle_count; a++) {
    count += a == 0 || hubs.of.at[a] > hubs.of.at[a - 1];
    for (uint32_t b = 0; b < a; b++) {
      bool tried = hubs.of.at[a] == UINT32_MAX || hubs.of.at[a] != hubs.of.at[b];
      if (tried || m->triangles[a][0] == m->triangles[b][0]) continue;
      vs_vec3 x[3], y[3];
      for (int j = 0; j < 3; j++) x[j] = m->vertices[m->triangles[a][j]], y[j] = m->vertices[m->triangles[b][j]];
      assert_true(vs_triangles_apart(x, y, &shared) && shared == 0);
    }
  }
  vs_hubs_free(&k, &hubs);
  assert_int_equal(k.bytes, 0);
  vs_mesh_free(m);
  return all ? count : 0;
}

static size_t two_cones(vs_vec3 tip, vs_vec3 middle, double radius, double waves, bool inwards) {
  vs_mesh m = { 0 };
  add_cone(&m, vs_v3(0, 0, 2), vs_v3(0, 0, 0), 1, waves, 100, false);
  add_cone(&m, tip, middle, radius, 0, 90, inwards);
  return families_in(&m);
}

static void test_hubs_in_hubs(void **state) {
  (void)state;
  for (int inwards = 0; inwards < 2; inwards++) {
    /* an outer and an inner cone that form a thin shell are one family */
    assert_int_equal(two_cones(vs_v3(0, 0, 1.99), vs_v3(0, 0, 0), 0.99, 0, inwards), 1);
    assert_int_equal(two_cones(vs_v3(0.1, 0.2, 1), vs_v3(0.1, 0, 0.2), 0.5, 0, inwards), 1);
    /* the second cone lies below the first cone's rim, so the cones are one family */
    assert_int_equal(two_cones(vs_v3(0, 0, -3), vs_v3(0, 0, -1), 1.3, 0, inwards), 1);
    /* the inner cone's wall passes through the outer cone's tip */
    assert_int_equal(two_cones(vs_v3(0, 0, 2.01), vs_v3(0, 0, 0), 0.5, 0, inwards), 2);
    /* the inner cone's wall passes through a side of the outer cone */
    assert_int_equal(two_cones(vs_v3(0, 0, 1.9), vs_v3(0.3, 0, 0), 0.75, 0, inwards), 2);
    /* the inner cone's wall touches the outer cone's tip */
    assert_int_equal(two_cones(vs_v3(0, 0, 2), vs_v3(0, 0, 0), 0.5, 0, inwards), 2);
    /* the second cone's rim is not convex */
    assert_int_equal(two_cones(vs_v3(0, 0, 1.5), vs_v3(0, 0, 0), 0.5, 0.3, inwards), 2);
    /* the larger cone is not around the smaller cone */
    assert_int_equal(two_cones(vs_v3(0, 0, -9), vs_v3(0, 0, -10), 9, 0.3, inwards), 2);
    /* the larger cone is around the smaller cone */
    assert_int_equal(two_cones(vs_v3(0, 0, -9), vs_v3(0, 0, -1), 9, 0.3, inwards), 1);
  }
  vs_mesh m = { 0 };
  for (int i = 0; i < 4; i++) add_cone(&m, vs_v3(1e3, 0, 2 - 0.01 * i), vs_v3(1e3, 0, 0), 1 - 0.02 * i, 0, 80, i % 2);
  /* two cones beside each other, whose walls intersect */
  add_cone(&m, vs_v3(1e3 + 0.9, 0, 1.5), vs_v3(1e3 + 0.9, 0, 0), 0.5, 0, 80, false);
  assert_int_equal(families_in(&m), 2);
  size_t within = 0, apart = 0;
  for (uint32_t i = 0; i < 300; i++) { /* random pairs of cones: if the cones intersect, the kernel must not prove them
                                        * disjoint */
    double at[6];
    for (int j = 0; j < 6; j++) at[j] = (double)((i * 6 + (uint32_t)j + 1) * 2654435761u % 1000) / 1000;
    vs_vec3 tip = vs_v3(at[0] - 0.5, at[1] - 0.5, 2 * at[2]), middle = vs_v3(at[3] - 0.5, at[4] - 0.5, 0);
    size_t families = two_cones(tip, middle, 0.1 + at[5] / 2, 0, i % 2);
    within += families == 1, apart += families == 2;
  }
  assert_true(within > 20 && apart > 20);
}

/* Makes a cup of 2 discs, each a fan of triangles around its centre (a hub), and 4 rings of vertices that walls join.
 * The discs are the inner and the outer bottom. The cup is not star-shaped about its centre, so the search for
 * self-intersections tests its triangles pair by pair. */
static void make_cup(vs_mesh *m, uint32_t n) {
  static const double radius[4] = { 5, 5, 4, 4 }, height[4] = { 0, 10, 10, 1 };
  uint32_t id;
  assert_true(vs_mesh_add_vertex(m, vs_v3(0, 0, 0), &id) && vs_mesh_add_vertex(m, vs_v3(0, 0, 1), &id));
  for (int r = 0; r < 4; r++)
    for (uint32_t i = 0; i < n; i++) {
      double angle = 2 * acos(-1) * i / n;
      assert_true(vs_mesh_add_vertex(m, vs_v3(radius[r] * cos(angle), radius[r] * sin(angle), height[r]), &id));
    }
  for (uint32_t i = 0; i < n; i++) {
    uint32_t a = 2 + i, b = 2 + (i + 1) % n;
    assert_true(vs_mesh_add_triangle(m, 0, b, a) && vs_mesh_add_triangle(m, 1, a + 3 * n, b + 3 * n));
    for (uint32_t r = 0; r < 3 * n; r += n)
      assert_true(vs_mesh_add_triangle(m, a + r, b + r, b + r + n) && vs_mesh_add_triangle(m, a + r, b + r + n, a + r + n));
  }
}

static bool is_good(const vs_mesh *m) {
  vs_mesh_flaws flaws;
  vs_kernel_error e;
  vs_kernel_options options = { .threads = 1 };
  if (!vs_kernel_inspect(m, &options, &flaws, &e)) fail_msg("%s", e.message);
  assert_int_equal(flaws.open_count, 0);
  return flaws.wound_count == 0;
}

/* The search for self-intersections must test the triangles of a hub against those of another hub and against the
 * walls. A fan of triangles that folds over itself is not a hub. */
static void test_meshes_with_hubs(void **state) {
  (void)state;
  enum { SIDES = 400 };
  vs_mesh m = { 0 };
  make_cup(&m, SIDES);
  assert_true(is_good(&m));
  vs_vec3 was = m.vertices[1];
  m.vertices[1] = vs_v3(0, 0, -1); /* moves the centre of the inner bottom through the outer bottom */
  assert_false(is_good(&m));
  m.vertices[1] = vs_v3(0, 6, 3); /* moves the centre of the inner bottom through the walls */
  assert_false(is_good(&m));
  m.vertices[1] = was;
  assert_true(is_good(&m));
  m.vertices[2 + 3 * SIDES + 7] = vs_v3(-6, 1, 3); /* moves a vertex of the inner bottom's rim through the opposite
                                                    * wall */
  assert_false(is_good(&m));
  vs_mesh_free(&m);
}

/* Subtracts a box from a wall of the cup. The kernel copies most of the cup unchanged, with its hubs. */
static void test_combined_with_hubs(void **state) {
  (void)state;
  vs_mesh cup = { 0 }, out = { 0 };
  make_cup(&cup, 400);
  sx_problem p;
  assert_true(sx_parse("(translate 4 -1 4 (box 2 2 2))", &p));
  vs_kernel_leaf leaves[2] = { { &cup, vs_affine_identity(), 0, false }, p.problem.leaves[0] };
  vs_kernel_term terms[3] = { { VS_TERM_LEAF, 0, 0 }, { VS_TERM_LEAF, 1, 0 }, { VS_TERM_DIFFERENCE, 0, 2 } };
  uint32_t operands[2] = { 0, 1 };
  vs_kernel_problem problem = { .leaves = leaves, .terms = terms, .operands = operands, .leaf_count = 2, .term_count = 3,
                                .operand_count = 2 };
  vs_kernel_error e;
  if (!vs_kernel_evaluate(&problem, NULL, &out, &e)) fail_msg("%s", e.message);
  bool sure;
  assert_true(vs_mesh_closed(&out, &sure));
  vs_kernel_options whole = { .threads = 1, .in_levels = true };
  vs_mesh again = { 0 };
  if (!vs_kernel_evaluate(&problem, &whole, &again, &e)) fail_msg("%s", e.message);
  near(vs_mesh_volume(&out), vs_mesh_volume(&again), 1e-9);
  assert_true(vs_mesh_volume(&out) < vs_mesh_volume(&cup) - 3);
  sx_free(&p);
  vs_mesh_free(&cup);
  vs_mesh_free(&out);
  vs_mesh_free(&again);
}

/* ---- families: boxes that are not tested against each other ---- */

typedef struct { uint32_t family, alone; } met; /* family: number of reported pairs that include a box of the family.
                                                 * alone: number of reported pairs that include none */
enum { OF_ONE = 200000, ALONE = 40 };

static bool count_pair(void *context, uint32_t a, uint32_t b) {
  met *m = context;
  assert_true(a >= OF_ONE || b >= OF_ONE);
  if (a < OF_ONE || b < OF_ONE) m->family++;
  else m->alone++;
  return true;
}

static bool count_all(void *context, uint32_t a, uint32_t b) {
  (void)a, (void)b;
  (*(size_t *)context)++;
  return true;
}
static bool ask_twice(void *context, const char *stage, double fraction) {
  (void)stage, (void)fraction;
  return ++*(int *)context < 2;
}

/* Tests that a search for the pairs of 20,000 boxes, all of which overlap, ends at an interrupt, long before the two
 * hundred million pairs are found. */
static void test_interrupted_pairs(void **state) {
  (void)state;
  enum { BOXES = 20000, FEW = 1000000 };
  int asked = 0;
  vs_job job = { .going = ask_twice, .context = &asked };
  vs_kernel_options options = { .threads = 1, .job = &job };
  vs_kernel_error e = { 0 };
  vs_kernel k = { .options = &options, .error = &e, .threads = 1, .share = 1 };
  vs_bvh_box *boxes = malloc(BOXES * sizeof *boxes);
  assert_non_null(boxes);
  for (int32_t i = 0; i < BOXES; i++) boxes[i] = (vs_bvh_box){ { -i, -i, -i }, { i, i, i } };
  vs_bvh tree = { 0 };
  size_t pairs = 0;
  assert_true(vs_bvh_build(&k, &tree, boxes, BOXES));
  asked = 0;
  assert_false(vs_bvh_pairs(&k, &tree, 0, UINT32_MAX, count_all, &pairs));
  assert_int_equal(e.status, VS_KERNEL_INTERRUPTED);
  assert_true(pairs < FEW);
  vs_bvh_free(&k, &tree);
  free(boxes);
}

/* Tests 200,000 overlapping boxes of one family (boxes that need not be tested against each other), and a few boxes of
 * no family. The search reports only pairs that include a box of no family. It does not even visit the pairs within the
 * family. */
static void test_families(void **state) {
  (void)state;
  vs_kernel_options options = { .threads = 1 };
  vs_kernel_error e = { 0 };
  vs_kernel k = { .options = &options, .error = &e, .threads = 1 };
  vs_bvh_box *boxes = malloc((OF_ONE + ALONE) * sizeof *boxes);
  uint32_t *families = malloc((OF_ONE + ALONE) * sizeof *families);
  assert_non_null(boxes);
  assert_non_null(families);
  for (int32_t i = 0; i < OF_ONE; i++) { /* boxes from the origin to points in all directions */
    int32_t x = (int32_t)(1e8 * cos(i * 2e-5)), y = (int32_t)(1e8 * sin(i * 2e-5));
    boxes[i] = (vs_bvh_box){ { x < 0 ? x : 0, y < 0 ? y : 0, 0 }, { x > 0 ? x : 0, y > 0 ? y : 0, 1000 } };
    families[i] = 7;
  }
  for (int32_t i = OF_ONE; i < OF_ONE + ALONE; i++) { /* boxes around the origin, each of which overlaps all boxes of
                                                       * the family */
    boxes[i] = (vs_bvh_box){ { -i, -i, -i }, { i, i, i } };
    families[i] = UINT32_MAX;
  }
  vs_bvh tree = { .families = families };
  met m = { 0, 0 };
  clock_t begin = clock();
  assert_true(vs_bvh_build(&k, &tree, boxes, OF_ONE + ALONE));
  assert_true(vs_bvh_pairs(&k, &tree, 0, UINT32_MAX, count_pair, &m));
  double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
  assert_int_equal(m.family, OF_ONE * ALONE);
  assert_int_equal(m.alone, ALONE * (ALONE - 1) / 2);
  if (seconds > 3) fail_msg("%g s for %d boxes", seconds, OF_ONE);
  vs_bvh_free(&k, &tree);
  free(boxes);
  free(families);
}

/* ---- tables of meshes ---- */

/* Tests separate boxes of different sizes. Each adds a mesh to the table, which grows several times. Only every tenth
 * box equals the first box. */
static void test_many_meshes(void **state) {
  (void)state;
  static const char model[] = "(do ((i 0 (+ i 1))) ((= i 3000)) "
                              "  (draw (make-box (xyz (* 10 i) 0 0) 1 1"
                              "    (+ 1 (if (= (modulo i 10) 0) 0 (/ i 1000.0))))))";
  char path[64];
  snprintf(path, sizeof path, "/tmp/vs-crowds-%ld.stl", (long)getpid());
  vs_options o = vs_options_default();
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  assert_int_equal(vs_eval_text(s, "model", 1, model, strlen(model), 0), VS_OUTCOME_DONE);
  assert_int_equal(vs_write_drawing(s, path, NULL, NULL), VS_OUTCOME_DONE);
  vs_free(s);
  FILE *f = fopen(path, "rb");
  assert_non_null(f);
  enum { HEADER = 84, TRIANGLE = 50, COUNT = 12 * 3000 };
  unsigned char *bytes = malloc(HEADER + TRIANGLE * COUNT + 1);
  assert_non_null(bytes);
  assert_int_equal(fread(bytes, 1, HEADER + TRIANGLE * COUNT + 1, f), HEADER + TRIANGLE * COUNT);
  fclose(f);
  unlink(path);
  double volume = 0, want = 0;
  for (int i = 0; i < COUNT; i++) {
    float v[9];
    memcpy(v, bytes + HEADER + TRIANGLE * i + 12, sizeof v);
    vs_vec3 a = vs_v3(v[0] - 15000, v[1], v[2]), b = vs_v3(v[3] - 15000, v[4], v[5]);
    vs_vec3 c = vs_v3(v[6] - 15000, v[7], v[8]);
    volume += vs_v3_dot(a, vs_v3_cross(b, c)) / 6;
  }
  for (int i = 0; i < 3000; i++) want += 1 + (i % 10 ? i / 1000.0 : 0);
  near(volume, want, 1e-5);
  free(bytes);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_levels), cmocka_unit_test(test_crowd_is_found),
      cmocka_unit_test(test_hubs), cmocka_unit_test(test_hubs_in_hubs), cmocka_unit_test(test_meshes_with_hubs),
      cmocka_unit_test(test_combined_with_hubs), cmocka_unit_test(test_families), cmocka_unit_test(test_interrupted_pairs),
      cmocka_unit_test(test_many_meshes) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
