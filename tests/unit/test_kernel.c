/* Tests the mesh kernel: boolean operations, compared with another implementation in rational numbers; degenerate
 * cases, errors and limits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel/arrange/snap_to_grid.h"
#include "kernel/check.h"
#include "tests/oracle/oracle.c"
#include "tests/oracle/sx.c"
#include "tests/tools/crossings.h"
#include "tests/unit/dice.h"

static dice thrown = { 88172645463325252u };
static int32_t span(int32_t low, int32_t high) { return whole_between(&thrown, low, high); }

/* ---- boolean operations ---- */

static void check_mesh(const vs_mesh *m) {
  bool sure;
  assert_true(vs_mesh_closed(m, &sure));
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    assert_true(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    assert_true(t[0] < m->vertex_count && t[1] < m->vertex_count && t[2] < m->vertex_count);
  }
}

static double volume_of(const char *text, size_t *triangles) {
  sx_problem p;
  vs_mesh m = { 0 };
  vs_kernel_error e;
  assert_true(sx_parse(text, &p));
  if (!vs_kernel_evaluate(&p.problem, NULL, &m, &e)) fail_msg("%s", e.message);
  check_mesh(&m);
  double v = vs_mesh_volume(&m);
  if (triangles) *triangles = m.triangle_count;
  vs_mesh_free(&m);
  sx_free(&p);
  return v;
}

static void near(double a, double b, double relative) {
  if (fabs(a - b) > relative * fmax(1, fabs(b))) fail_msg("%.17g is not %.17g", a, b);
}

/* Makes a tetrahedron, box or double pyramid with small integer corners: many coplanar faces, shared corners, touching
 * edges. */
static void random_convex(vs_mesh *m, int32_t most) {
  *m = (vs_mesh){ 0 };
  int32_t v[4][3];
  int what = span(0, 2);
  if (what == 0) {
    double a[3];
    int32_t at[3];
    for (int i = 0; i < 3; i++) at[i] = span(-most, most - 1), a[i] = span(1, most - at[i]);
    make(m, "box", a);
    for (size_t i = 0; i < m->vertex_count; i++) m->vertices[i] = vs_v3_add(m->vertices[i], vs_v3(at[0], at[1], at[2]));
    return;
  }
  int32_t six;
  do {
    for (int i = 0; i < 12; i++) v[i / 3][i % 3] = span(-most, most);
    int32_t p[3][3];
    for (int i = 0; i < 9; i++) p[i / 3][i % 3] = v[i / 3 + 1][i % 3] - v[0][i % 3];
    six = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) - p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
          p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  } while (six == 0);
  for (int i = 0; i < 4; i++) vertex(m, v[i][0], v[i][1], v[i][2]);
  static const uint32_t faces[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };
  for (int i = 0; i < 4; i++) face(m, faces[i][six > 0 ? 0 : 2], faces[i][1], faces[i][six > 0 ? 2 : 0]);
}

static void test_against_oracle(void **state) {
  (void)state;
  int solid = 0;
  for (int round = 0; round < 40; round++) {
    vs_mesh meshes[5];
    vs_kernel_leaf leaves[5];
    vs_kernel_term terms[16];
    uint32_t operands[64], count = (uint32_t)span(2, 4), term = count, operand = 0;
    int32_t most = round % 3 == 0 ? 3 : round % 3 == 1 ? 6 : 40;
    for (uint32_t i = 0; i < count; i++) {
      random_convex(&meshes[i], most);
      leaves[i] = (vs_kernel_leaf){ &meshes[i], vs_affine_identity(), i, false };
      terms[i] = (vs_kernel_term){ VS_TERM_LEAF, i, 0 };
    }
    for (int i = 0; i < 4; i++) { /* each operation combines two or three earlier terms; the last operation is the
                                   * root */
      uint32_t n = (uint32_t)span(2, 3);
      terms[term] = (vs_kernel_term){ (vs_term_kind)span(1, 3), operand, n };
      for (uint32_t j = 0; j < n; j++) operands[operand++] = j == 0 ? term - 1 : (uint32_t)span(0, (int32_t)term - 1);
      term++;
    }
    vs_kernel_problem p = { leaves, terms, operands, count, term, operand, NULL, NULL, NULL };
    vs_mesh m = { 0 };
    vs_kernel_error e;
    if (!vs_kernel_evaluate(&p, NULL, &m, &e)) fail_msg("round %d: %s", round, e.message);
    check_mesh(&m);
    double want = oracle_volume(&p, most + 1);
    near(vs_mesh_volume(&m), want, 1e-9);
    solid += want > 0;
    vs_mesh_free(&m);
    for (uint32_t i = 0; i < count; i++) vs_mesh_free(&meshes[i]);
  }
  assert_true(solid > 12);
}

static void test_equal_turns_written_differently(void **state) {
  (void)state;
  size_t triangles;
  near(volume_of("(union (rotate 33 21 17 (box 2 1 1)) (rotate 0 0 17 (rotate 0 21 0 (rotate 33 0 0 (translate 0 1 0 (box 2 1 1))))) "
                 "(rotate 393 -339 377 (translate 0 0 1 (box 2 2 1))))", &triangles), 8, 1e-9);
  assert_int_equal(triangles, 12);
}

/* Tests that solids which touch still touch after all of them are rotated and scaled unequally. */
static void test_sheared_alike(void **state) {
  (void)state;
  size_t triangles;
  double straight = volume_of("(union (box 2 2 1) (translate .5 .5 1 (box 1 1 1)) (translate 2 0 0 (box 1 2 1)))", &triangles);
  size_t sheared;
  double v = volume_of("(scale 1.5 .75 1.25 (rotate 10 40 30 (union (box 2 2 1) (translate .5 .5 1 (box 1 1 1)) (translate 2 0 0 (box 1 2 1)))))", &sheared);
  near(v, straight * 1.5 * .75 * 1.25, 1e-9);
  assert_int_equal(sheared, triangles);
}

/* Checks that every edge belongs to two triangles, and that the triangles of every vertex form a single fan. The kernel
 * splits a vertex where the solid touches itself. */
static void check_manifold(const vs_mesh *m) {
  check_mesh(m);
  size_t corners = 3 * m->triangle_count;
  size_t *degree = calloc(m->vertex_count, sizeof *degree);
  uint32_t(*edges)[3] = malloc(corners * sizeof *edges);
  assert_non_null(degree);
  assert_non_null(edges);
  for (size_t i = 0; i < corners; i++) {
    uint32_t a = m->triangles[i / 3][i % 3], b = m->triangles[i / 3][(i + 1) % 3];
    edges[i][0] = a;
    edges[i][1] = b;
    degree[a]++;
  }
  for (size_t i = 0; i < corners; i++)
    /* each edge occurs at most once in each direction */
    for (size_t j = i + 1; j < corners; j++) assert_false(edges[i][0] == edges[j][0] && edges[i][1] == edges[j][1]);
  for (uint32_t v = 0; v < m->vertex_count; v++) { /* a walk around vertex v from triangle to triangle must visit all of
                                                    * v's triangles */
    size_t start = corners, at, count = 0;
    for (size_t i = 0; i < corners && start == corners; i++)
      if (edges[i][0] == v) start = i;
    if (start == corners) continue;
    at = start;
    do {
      count++;
      size_t twin = 0;
      while (edges[twin][0] != edges[at][1] || edges[twin][1] != edges[at][0]) twin++;
      at = twin % 3 == 2 ? twin - 2 : twin + 1;
    } while (at != start);
    assert_int_equal(count, degree[v]);
  }
  free(degree);
  free(edges);
}

/* Tests 16^3 unit cubes that share faces. Their union is a box, an L, or two halves with different tags. It must have
 * the least possible number of triangles and no vertices except the corners. */
static void test_cubes_become_one(void **state) {
  (void)state;
  enum { SIDE = 16, ALL = SIDE * SIDE * SIDE };
  enum { BOX, ELL, HALVES, SHAPES };
  static const struct { double volume; size_t triangles, vertices, tagged[2]; } want[SHAPES] = {
    [BOX] = { 4096, 12, 8, { 12, 0 } },
    [ELL] = { 3072, 20, 12, { 20, 0 } },      /* an L-shaped prism: each of 2 ends has 6 corners, thus 4 triangles; each
                                               * of 6 sides has 2 triangles */
    [HALVES] = { 4096, 20, 12, { 10, 10 } },  /* each half has 10 triangles: 2 for its end, and 2 for each of 4 sides.
                                               * The halves' common face is inside the solid */
  };
  const vs_affine turns[] = { vs_affine_identity(), vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(0, 0, 1), .5), vs_affine_rotation(vs_v3(.3, -7, 2), vs_v3(1, 2.3, -.7), .6180339) };
  vs_mesh cube = { 0 };
  double size[3] = { 1, 1, 1 };
  make(&cube, "box", size);
  vs_kernel_leaf *leaves = calloc(ALL, sizeof *leaves);
  vs_kernel_term *terms = calloc(ALL + 1, sizeof *terms);
  uint32_t *operands = calloc(ALL, sizeof *operands);
  assert_true(leaves && terms && operands);
  for (int shape = 0; shape < SHAPES; shape++)
    for (size_t turn = 0; turn < sizeof turns / sizeof *turns; turn++) {
      uint32_t n = 0;
      for (int i = 0; i < ALL; i++) {
        int x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
        if (shape == ELL && x >= SIDE / 2 && y >= SIDE / 2) continue;
        vs_affine at = vs_affine_translation(vs_v3(x, y, z));
        leaves[n] = (vs_kernel_leaf){ &cube, vs_affine_multiply(&turns[turn], &at), shape == HALVES && x >= SIDE / 2, false };
        terms[n] = (vs_kernel_term){ VS_TERM_LEAF, n, 0 };
        operands[n] = n;
        n++;
      }
      terms[n] = (vs_kernel_term){ VS_TERM_UNION, 0, n };
      vs_kernel_problem p = { leaves, terms, operands, n, n + 1, n, NULL, NULL, NULL };
      vs_mesh m = { 0 };
      vs_kernel_error e;
      if (!vs_kernel_evaluate(&p, NULL, &m, &e)) fail_msg("%s", e.message);
      check_manifold(&m);
      near(vs_mesh_volume(&m), want[shape].volume, 1e-9);
      assert_int_equal(m.triangle_count, want[shape].triangles);
      assert_int_equal(m.vertex_count, want[shape].vertices);
      size_t tagged[2] = { 0 };
      for (size_t i = 0; i < m.triangle_count; i++) {
        vs_vec3 v[3];
        double longest = 0;
        for (int k = 0; k < 3; k++) v[k] = m.vertices[m.triangles[i][k]];
        for (int k = 0; k < 3; k++) longest = fmax(longest, vs_v3_length(vs_v3_sub(v[k], v[(k + 1) % 3])));
        /* the triangle's height is above 2 grid units, so it is not a sliver */
        assert_true(vs_v3_length(vs_v3_cross(vs_v3_sub(v[1], v[0]), vs_v3_sub(v[2], v[0]))) > 2 * longest);
        assert_true(m.tags[i] < 2);
        tagged[m.tags[i]]++;
      }
      assert_memory_equal(tagged, want[shape].tagged, sizeof tagged);
      vs_mesh_free(&m);
    }
  vs_mesh_free(&cube);
  free(leaves);
  free(terms);
  free(operands);
}

static void test_touching_is_split(void **state) {
  (void)state;
  static const struct { const char *text; size_t vertices, triangles; } cases[] = {
    { "(union (box 1 1 1) (translate 1 1 0 (box 1 1 1)))", 16, 24 },                          /* the boxes touch along an
                                                                                               * edge */
    { "(union (box 1 1 1) (translate 1 1 1 (box 1 1 1)))", 16, 24 },                          /* the boxes touch at a corner */
    { "(rotate 33 21 17 (union (box 1 1 1) (translate 1 1 0 (box 1 1 1))))", 16, 24 },
    { "(difference (box 4 4 4) (translate 1 1 1 (box 1 1 1)) (translate 2 2 1 (box 1 1 1)))", 0, 0 }, /* two cavities that touch along an edge */
    { "(difference (box 2 2 1) (translate 0 0 -1 (box 1 1 3)) (translate 1 1 -1 (box 1 1 3)))", 16, 24 },
    { "(difference (box 4 4 4) (translate 1 1 1 (box 1 1 1)) (translate 2 2 1 (box 1 1 1)) (translate 1 1 2 (box 2 2 1)))", 0, 0 },
    { "(difference (box 3 3 3) (translate 0 0 1 (box 1 1 1)) (translate 1 1 1 (box 1 1 1)) (translate 2 2 1 (box 1 1 1)))", 0, 0 },
    { "(union (sphere 1 8) (translate 0 0 2 (sphere 1 8)))", 0, 0 },
    { "(difference (box 4 4 4) (translate 2 2 0 (cyl 4 1 0 12)) (translate 2 2 4 (rotate 180 0 0 (cyl 4 1 0 12))))", 0, 0 },
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    sx_problem p;
    vs_mesh m = { 0 };
    vs_kernel_error e;
    assert_true(sx_parse(cases[i].text, &p));
    if (!vs_kernel_evaluate(&p.problem, NULL, &m, &e)) fail_msg("%s: %s", cases[i].text, e.message);
    check_manifold(&m);
    if (cases[i].vertices) assert_int_equal(m.vertex_count, cases[i].vertices);
    if (cases[i].triangles) assert_int_equal(m.triangle_count, cases[i].triangles);
    vs_mesh_free(&m);
    sx_free(&p);
  }
}

static void test_identities(void **state) {
  (void)state;
  const char *a = "(rotate 10 20 30 (sphere 3 16))", *b = "(translate 1 .5 .25 (cyl 4 2 1 12))";
  char text[600];
  size_t triangles;
  snprintf(text, sizeof text, "(difference %s %s)", a, a);
  near(volume_of(text, &triangles), 0, 0);
  assert_int_equal(triangles, 0);
  double va = volume_of(a, NULL), vb = volume_of(b, NULL);
  snprintf(text, sizeof text, "(union %s %s)", a, a);
  near(volume_of(text, NULL), va, 1e-7); /* the kernel copies a solid that touches no other solid, but rounds solids
                                          * that it combines to a grid */
  snprintf(text, sizeof text, "(union %s %s)", a, b);
  double both = volume_of(text, NULL);
  snprintf(text, sizeof text, "(intersection %s %s)", a, b);
  double common = volume_of(text, NULL);
  near(both + common, va + vb, 1e-7);
  snprintf(text, sizeof text, "(difference %s (difference %s %s))", a, a, b);
  near(volume_of(text, NULL), common, 1e-7);
  assert_true(common > 1 && common < vb);
}

/* Tests a plate as thick as 20 steps of the kernel's grid in a model of 300 units, cavities, and a solid that
 * intersects itself. */
static void test_thin_and_nested(void **state) {
  (void)state;
  near(volume_of("(union (cbox 300 300 .0001) (translate 0 0 5 (cbox 1 1 20)))", NULL), 9 + 20 - .0001, 1e-9);
  near(volume_of("(difference (box 10 10 10) (translate 1 1 1 (box 8 8 8)) )", NULL), 488, 1e-12);
  near(volume_of("(union (difference (box 10 10 10) (translate 1 1 1 (box 8 8 8))) (translate 3 3 3 (box 1 1 1)))", NULL), 489, 1e-12);
  near(volume_of("(union (translate 5 5 5 (box 1 1 1)) (box 10 10 10))", NULL), 1000, 1e-12);
  size_t triangles;
  near(volume_of("(union (box 1 1 1) (translate 1 1 0 (box 1 1 1)) (translate 1 1 1 (scale -1 -1 -1 (box .5 .5 .5))))", &triangles), 2, 1e-12);
}

/* Tests two ways to compute a result. The kernel copies the triangles of a large operand (leaf) that touches no other
 * operand. If the operand occurs twice, the kernel intersects all of its triangles with the other operands. The results
 * must be equal. */
static void test_plain(void **state) {
  (void)state;
#define RING "(torus 10 3 32 16)"
#define OTHER "(translate 1 .3 .2 (rotate 25 0 0 (torus 10 2.5 32 16)))"
#define BALL "(translate 8 1 1 (rotate 20 30 40 (sphere 4 24)))"
#define SPINDLE "(torus 1 3 32 16)"
#define WITHIN "(rotate 3 2 1 (torus 10 1 32 16))"
#define LINK "(translate 10 0 0 (rotate 90 0 0 (torus 10 3 32 16)))"
#define TWICE(x) "(union " x x ")"
  static const char *const cases[][2] = { /* two texts of each test case: with each operand once, and with each operand
                                           * twice */
    { "(difference " RING OTHER ")", "(difference " TWICE(RING) TWICE(OTHER) ")" },
    { "(scale -1 1 1 (intersection " RING OTHER "))", "(scale -1 1 1 (intersection " TWICE(RING) TWICE(OTHER) "))" },
    { "(union " RING "(scale -1 1 1 " BALL ") " BALL ")", "(union " TWICE(RING) "(scale -1 1 1 " BALL ") " BALL BALL "(scale -1 1 1 " BALL "))" },
    { "(difference " RING BALL ")", "(difference " TWICE(RING) TWICE(BALL) ")" },
    { "(difference " BALL RING ")", "(difference " TWICE(BALL) TWICE(RING) ")" },
    { SPINDLE, TWICE(SPINDLE) },                                                        /* a solid that intersects
                                                                                         * itself */
    { "(difference (box 20 20 3) " SPINDLE ")", "(difference (box 20 20 3) " TWICE(SPINDLE) ")" },
    /* two rings, one within the other, whose surfaces do not intersect */
    { "(difference " RING WITHIN ")", "(difference " TWICE(RING) TWICE(WITHIN) ")" },
    { "(difference (scale 1 -1 1 " RING ") " WITHIN ")", "(difference " TWICE("(scale 1 -1 1 " RING ")") TWICE(WITHIN) ")" },
    { "(union (difference " RING WITHIN ") " LINK ")", "(union (difference " TWICE(RING) TWICE(WITHIN) ") " TWICE(LINK) ")" },
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    vs_mesh m[2] = { { 0 } };
    for (int j = 0; j < 2; j++) {
      sx_problem p;
      vs_kernel_error e;
      assert_true(sx_parse(cases[i][j], &p));
      if (!vs_kernel_evaluate(&p.problem, NULL, &m[j], &e)) fail_msg("%s: %s", cases[i][j], e.message);
      check_manifold(&m[j]);
      sx_free(&p);
    }
    near(vs_mesh_volume(&m[0]), vs_mesh_volume(&m[1]), 1e-9);
    assert_int_equal(m[0].triangle_count, m[1].triangle_count);
    assert_int_equal(m[0].vertex_count, m[1].vertex_count);
    vs_mesh_free(&m[0]);
    vs_mesh_free(&m[1]);
  }
}

/* A part that touches no other part is not rounded to the kernel's grid, whether the part is star-shaped or not. The
 * test uses two horseshoes with multiples of 1/3 as coordinates. */
static void test_alone(void **state) {
  (void)state;
  static const double at[8][2] = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
  static const uint32_t cap[6][3] = { { 0, 1, 4 }, { 1, 2, 3 }, { 1, 3, 4 }, { 0, 4, 5 }, { 0, 5, 7 }, { 5, 6, 7 } };
  vs_mesh m = { 0 }, out = { 0 };
  for (int i = 0; i < 16; i++)
    assert_true(vs_mesh_add_vertex(&m, vs_v3(at[i % 8][0] / 3, at[i % 8][1] / 7, i / 8 / 3.0), NULL));
  for (int i = 0; i < 6; i++)
    assert_true(vs_mesh_add_triangle(&m, cap[i][0], cap[i][2], cap[i][1]) &&
                vs_mesh_add_triangle(&m, cap[i][0] + 8, cap[i][1] + 8, cap[i][2] + 8));
  for (uint32_t i = 0; i < 8; i++) {
    uint32_t j = (i + 1) % 8;
    assert_true(vs_mesh_add_triangle(&m, i, j, j + 8) && vs_mesh_add_triangle(&m, i, j + 8, i + 8));
  }
  vs_affine far = vs_affine_translation(vs_v3(100, 0, 0));
  vs_kernel_leaf leaves[2] = { { &m, vs_affine_identity(), 0, false }, { &m, far, 0, false } };
  vs_kernel_term terms[3] = { { VS_TERM_LEAF, 0, 0 }, { VS_TERM_LEAF, 1, 0 }, { VS_TERM_UNION, 0, 2 } };
  uint32_t operands[2] = { 0, 1 };
  vs_kernel_problem problem = {
    .leaves = leaves, .terms = terms, .operands = operands, .leaf_count = 2, .term_count = 3, .operand_count = 2
  };
  assert_true(vs_kernel_evaluate(&problem, NULL, &out, NULL));
  assert_int_equal(out.triangle_count, 2 * m.triangle_count);
  for (size_t i = 0; i < out.vertex_count; i++) {
    bool found = false;
    for (size_t j = 0; j < 16; j++) {
      vs_vec3 moved = vs_affine_point(&far, m.vertices[j]);
      found = found || vs_v3_equal(out.vertices[i], m.vertices[j]) || vs_v3_equal(out.vertices[i], moved);
    }
    assert_true(found);
  }
  vs_mesh_free(&m);
  vs_mesh_free(&out);
}

static void test_twice_in_place(void **state) {
  (void)state;
#define JOINT "(translate 0.681 0.233 6.874 (rotate 238 354 241 (sphere 3.346 12)))"
#define RODS                                                                                                                                  \
  "(translate 5.17 6.81 1.071 (cyl 5 2.267 2.267 16)) (translate 3.632 0.301 6.409 (rotate 0 180 270 (cyl 5 2.952 0 12))) "                     \
  "(difference (translate 7.084 2.868 5.635 (torus 3.329 0.75 10 3)) (translate 0.037 2.306 3.573 (rotate 351 208 191 (cyl 1 3.41 3.41 7)))) " \
  "(translate 0.85 2.046 6.242 (rotate 290 68 236 (cyl 5 2.02 2.02 14))) (translate 2.313 0.789 2.559 (box 4 4 4)) "
  double once = volume_of("(union " JOINT RODS ")", NULL);
  near(once, 314.323924834, 1e-6);
  near(volume_of("(union " JOINT RODS JOINT ")", NULL), once, 1e-9);
  near(volume_of("(union " JOINT RODS JOINT RODS ")", NULL), once, 1e-9);
}

/* An edge that lies on the diagonal between two triangles of another solid's face still divides that face. */
static void test_edge_on_diagonal(void **state) {
  (void)state;
  sx_problem p;
  vs_mesh m = { 0 };
  vs_kernel_error e;
  assert_true(sx_parse("(union (box 1 1 1) (box 2 2 2))", &p));
  vs_mesh *t = p.meshes[1];
  t->vertex_count = t->triangle_count = 0;
  /* the tetrahedron passes through the top of the box; one of its edges lies on the diagonal of the box's top */
  vertex(t, 0, 0, 1), vertex(t, 1, 1, 1), vertex(t, 1, 0, 2), vertex(t, 1, 0, 0);
  face(t, 0, 2, 1), face(t, 0, 1, 3), face(t, 1, 2, 3), face(t, 0, 3, 2);
  if (!vs_kernel_evaluate(&p.problem, NULL, &m, &e)) fail_msg("%s", e.message);
  check_mesh(&m);
  near(vs_mesh_volume(&m), 7.0 / 6, 1e-12);
  vs_mesh_free(&m);
  sx_free(&p);
}

/* Tests an operand that is far larger than the region where it has an effect. The kernel clips it first, because a grid
 * for the whole operand would be too coarse for the other operand. */
static void test_far_larger(void **state) {
  (void)state;
  static const struct { const char *text; double volume; } cases[] = {
    { "(intersection (translate -5e5 -5e5 -1 (box 1e6 1e6 1)) (translate .1 .2 -.005 (box .01 .01 .01)))", 5e-7 },
    { "(difference (translate .1 .2 -.005 (box .01 .01 .01)) (translate -5e5 -5e5 -1 (box 1e6 1e6 1)))", 5e-7 },
    { "(rotate 33 21 17 (difference (translate .1 .2 -.005 (box .01 .01 .01)) (translate -5e5 -5e5 -1 (box 1e6 1e6 1))))", 5e-7 },
    /* the small operand is inside the large operand */
    { "(difference (translate .1 .2 -.005 (box .01 .01 .01)) (rotate 33 21 17 (translate -5e5 -5e5 -5e5 (box 1e6 1e6 1e6))))", 0 },
    { "(union (translate 3 0 0 (box .01 .01 .01)) (difference (translate .1 .2 -.005 (box .01 .01 .01)) (translate -5e5 -5e5 -1 (box 1e6 1e6 1))))", 1.5e-6 },
    { "(difference (translate .1 .2 -.005 (box .01 .01 .01)) (difference (cbox 1e6 1e6 2) (translate 0 0 -2 (box 1e6 1e6 4))))", 1e-6 },
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    double v = volume_of(cases[i].text, NULL);
    if (fabs(v - cases[i].volume) > 1e-6 * cases[i].volume) fail_msg("%s: %.12g, not %.12g", cases[i].text, v, cases[i].volume);
  }
  static const char *const large[] = { "(translate 0 0 -1e4 (sphere 1e4 64))", "(rotate 10 20 30 (translate 3e3 0 0 (torus 3e3 1e3 40 20)))", "(rotate 5 5 5 (translate 0 0 -9e5 (cyl 9e5 5e5 1 31)))",
                                       "(difference (rotate 3 4 5 (cbox 1e5 1e5 1e5)) (rotate 1 1 1 (box 1e5 1e5 1e5)))" };
  for (size_t i = 0; i < sizeof large / sizeof *large; i++) { /* the volumes of difference and intersection add up to
                                                               * the volume of the first operand */
    char text[400];
    static const char detail[] = "(translate .002 .003 0 (rotate 40 30 20 (cbox .02 .01 .03)))";
    snprintf(text, sizeof text, "(difference %s %s)", detail, large[i]);
    double left = volume_of(text, NULL);
    snprintf(text, sizeof text, "(intersection %s %s)", detail, large[i]);
    double common = volume_of(text, NULL);
    if (fabs(left + common - 6e-6) > 1e-7 * 6e-6) fail_msg("%s: %.12g and %.12g", text, left, common);
  }
}

/* Tests the kernel's check of its own result. The check must accept right results, and report a lost, doubled or
 * reversed part. */
static void test_self_check(void **state) {
  (void)state;
  static const char *const texts[] = {
    "(union (box 4 4 4) (translate 2 2 2 (sphere 3 16)) (translate 20 0 0 (box 1 1 1)))", "(rotate 33 21 17 (difference (box 4 4 4) (translate 3 3 3 (box 2 2 2))))",
    "(union (difference (box 4 4 4) (translate 3 3 3 (sphere 1 8))) (intersection (box 9 1 1) (translate 3 0 0 (box 9 9 9))))",
  };
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    sx_problem p;
    vs_mesh m = { 0 };
    vs_kernel_error e;
    assert_true(sx_parse(texts[i], &p));
    uint32_t leaves[8], same[8] = { 0 }, n = p.problem.leaf_count;
    for (uint32_t j = 0; j < n; j++) leaves[j] = j;
    assert_true(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
    size_t whole = m.triangle_count;
    for (int fault = 0; fault < 4; fault++) {
      vs_kernel k = { .error = &e, .threads = 1 };
      vs_parts parts = { .all = { 0 } };
      vs_expression expression = { .root = 0 };
      vs_check check = { .leaves = { 0 } };
      vs_kernel_counts counts = { 0 };
      vs_cluster c = { .problem = &p.problem, .parts = &parts, .expression = &expression, .leaves = leaves, .leaf_count = n };
      e = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
      assert_true(vs_parts_prepare(&k, &parts, &p.problem, leaves, same, n) && vs_expression_build(&k, &expression, &p.problem) && vs_snap_to_grid(&k, &c));
      assert_true(vs_check_leaves(&k, &c, &check, &counts));
      assert_int_equal(counts.coarse, 0);
      if (fault == 1) m.triangle_count = 0;
      if (fault == 2) vs_mesh_turn(&m, 0);
      if (fault == 3)
        for (size_t v = 0; v < m.vertex_count; v++) m.vertices[v] = vs_v3_scale(m.vertices[v], 3);
      assert_int_equal(vs_check_result(&k, &c, &check, &m, 0), fault == 0);
      assert_int_equal(e.status, fault ? VS_KERNEL_INTERNAL : VS_KERNEL_FINE);
      m.triangle_count = whole;
      if (fault == 2) vs_mesh_turn(&m, 0);
      vs_check_free(&k, &check);
      vs_cluster_free(&k, &c);
      vs_expression_free(&k, &expression);
      vs_parts_free(&k, &parts);
    }
    vs_mesh_free(&m);
    sx_free(&p);
  }
  sx_problem p; /* a thin peg in a huge plate: the grid for the plate is so coarse that it changes the peg */
  vs_mesh m = { 0 };
  vs_kernel_error e;
  vs_kernel_counts counts = { 0 };
  vs_kernel_options options = { .counts = &counts };
  assert_true(sx_parse("(difference (cbox 1e6 1e6 2) (translate 0 0 .995 (box .0013 .0013 1)))", &p));
  assert_true(vs_kernel_evaluate(&p.problem, &options, &m, &e));
  assert_int_equal(counts.coarse, 1);
  assert_int_equal(counts.coarse_leaf, 1);
  vs_mesh_free(&m);
  sx_free(&p);
}

static void test_tags(void **state) {
  (void)state;
  sx_problem p;
  assert_true(sx_parse("(difference (box 4 4 4) (translate 1 1 1 (box 2 2 8)))", &p));
  for (int bare = 0; bare < 2; bare++) {
    p.leaves[0].tag = 7;
    p.leaves[1].tag = 9;
    p.leaves[1].bare = bare;
    vs_mesh m = { 0 };
    vs_kernel_error e;
    assert_true(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
    size_t cutter = 0;
    for (size_t i = 0; i < m.triangle_count; i++) {
      assert_true(m.tags[i] == 7 || m.tags[i] == 9);
      cutter += m.tags[i] == 9;
    }
    assert_int_equal(cutter, bare ? 0 : 10);
    vs_mesh_free(&m);
  }
  sx_free(&p);
}

static void test_wide_and_deep(void **state) {
  (void)state;
  enum { DEEP = 200000, WIDE = 100000 };
  vs_mesh box = { 0 };
  double size[3] = { 1, 1, 1 };
  make(&box, "box", size);
  vs_kernel_leaf *leaves = calloc(WIDE, sizeof *leaves);
  vs_kernel_term *terms = calloc(2 * DEEP + 2, sizeof *terms);
  uint32_t *operands = calloc(2 * DEEP + 2, sizeof *operands);
  assert_true(leaves && terms && operands);
  vs_mesh m = { 0 };
  vs_kernel_error e;
  for (uint32_t i = 0; i < WIDE; i++) {
    leaves[i] = (vs_kernel_leaf){ &box, vs_affine_translation(vs_v3(3.0 * (i % 1000), 3.0 * (i / 1000), 0)), 0, false };
    terms[i] = (vs_kernel_term){ VS_TERM_LEAF, i, 0 };
    operands[i] = i;
  }
  terms[WIDE] = (vs_kernel_term){ VS_TERM_UNION, 0, WIDE };
  vs_kernel_problem wide = { leaves, terms, operands, WIDE, WIDE + 1, WIDE, NULL, NULL, NULL };
  assert_true(vs_kernel_evaluate(&wide, NULL, &m, &e));
  assert_int_equal(m.triangle_count, 12 * WIDE);
  vs_mesh_free(&m);
  /* nests DEEP operations: ((a - b) union a) - b ... */
  for (uint32_t i = 0; i < 2; i++) terms[i] = (vs_kernel_term){ VS_TERM_LEAF, i, 0 };
  leaves[1].placement = vs_affine_translation(vs_v3(0.5, 0.5, 0.5));
  for (uint32_t i = 0; i < DEEP; i++) {
    terms[2 + i] = (vs_kernel_term){ i % 2 ? VS_TERM_UNION : VS_TERM_DIFFERENCE, 2 * i, 2 };
    operands[2 * i] = i ? 1 + i : 0;
    operands[2 * i + 1] = i % 2 ? 0 : 1;
  }
  vs_kernel_problem deep = { leaves, terms, operands, 2, DEEP + 2, 2 * DEEP, NULL, NULL, NULL };
  assert_true(vs_kernel_evaluate(&deep, NULL, &m, &e));
  near(vs_mesh_volume(&m), 1, 1e-12);
  vs_mesh_free(&m);
  vs_mesh_free(&box);
  free(leaves);
  free(terms);
  free(operands);
}

/* Clusters (groups of touching solids) that are copies of each other are stored once, including rotated, mirrored and
 * differently painted copies. */
static void test_copies(void **state) {
  (void)state;
  static const char one[] = "(difference (box 4 2 2) (translate 1 1 -1 (cyl 5 .5 .5 16)))";
  char text[2000];
  sprintf(text, "(union %s (translate 100 0 0 %s) (translate 200 7.3 0 (rotate 10 20 30 %s)) (translate 300 0 0 (scale -1 1 1 %s)) (translate 400 0 0 (box 4 2 2)))", one, one,
          one, one);
  sx_problem p;
  assert_true(sx_parse(text, &p));
  vs_kernel_copies c;
  vs_kernel_error e;
  vs_mesh m = { 0 };
  if (!vs_kernel_evaluate_copies(&p.problem, NULL, &c, &e)) fail_msg("%s", e.message);
  assert_int_equal(c.mesh_count, 2);
  assert_int_equal(c.copy_count, 5);
  assert_true(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
  check_mesh(&m);
  double single = vs_mesh_volume(&c.meshes[0]), sum = 0;
  near(vs_mesh_volume(&m), 4 * single + 16, 1e-9);
  for (size_t i = 0; i < c.copy_count; i++) {
    vs_mesh *from = &c.meshes[c.copies[i].mesh];
    sum += vs_mesh_volume(from) * fabs(vs_affine_determinant(&c.copies[i].place));
  }
  near(sum, vs_mesh_volume(&m), 1e-9);
  /* the first vertex of the stored mesh, moved to the place of the mesh's third copy, must be a vertex of the result */
  vs_vec3 at = vs_affine_point(&c.copies[2].place, c.meshes[0].vertices[0]);
  bool found = false;
  for (size_t i = 0; i < m.vertex_count; i++) found = found || vs_v3_length(vs_v3_sub(m.vertices[i], at)) < 1e-9;
  assert_true(found);
  /* gives each leaf a tag of its own; all tags have the same paint, so the clusters remain copies of each other */
  for (uint32_t i = 0; i < p.problem.leaf_count; i++) p.leaves[i].tag = i;
  uint32_t paints[9] = { 0 };
  p.problem.paints = paints;
  m.vertex_count = m.triangle_count = 0;
  assert_true(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
  for (size_t i = 0; i < m.triangle_count; i++) assert_int_equal(m.tags[i] / 2, (uint32_t)((m.vertices[m.triangles[i][0]].x + 10) / 100));
  vs_kernel_copies_free(&c);
  vs_mesh_free(&m);
  sx_free(&p);
}

static bool stop(void *context, const char *stage, double done) {
  (void)stage;
  (void)done;
  return --*(int *)context > 0;
}

/* Checks that the result consists of equal bytes for any number of threads. Returns the number of triangles. */
static size_t by_threads(const vs_kernel_problem *problem) {
  vs_mesh m[3] = { { 0 } };
  for (uint32_t i = 0; i < 3; i++) {
    vs_kernel_options options = { .threads = 1 + 2 * i };
    vs_kernel_error e;
    if (!vs_kernel_evaluate(problem, &options, &m[i], &e)) fail_msg("%s", e.message);
    check_mesh(&m[i]);
    assert_int_equal(m[i].triangle_count, m[0].triangle_count);
    assert_int_equal(m[i].vertex_count, m[0].vertex_count);
    assert_memory_equal(m[i].vertices, m[0].vertices, m[0].vertex_count * sizeof *m[0].vertices);
    assert_memory_equal(m[i].triangles, m[0].triangles, m[0].triangle_count * sizeof *m[0].triangles);
    assert_memory_equal(m[i].tags, m[0].tags, m[0].triangle_count * sizeof *m[0].tags);
  }
  size_t triangles = m[0].triangle_count;
  for (int i = 0; i < 3; i++) vs_mesh_free(&m[i]);
  return triangles;
}

/* Several threads copy parts that touch no other part to their places, and place copies of clusters (groups of touching
 * solids). Between these parts lie clusters that the kernel must combine. */
static void test_places(void **state) {
  (void)state;
  char text[8000] = "(union";
  for (int i = 0; i < 20; i++) { /* twenty rows of three parts: a sphere whose size differs in each row, a rotated
                                  * sphere of constant size, and a pair of overlapping boxes; every second pair is
                                  * equal */
    sprintf(text + strlen(text), " (translate %d 0 0 (sphere %g 48)) (translate %d 9 0 (rotate 0 0 %d (sphere 2 48)))", 9 * i, 2 + i * 0.0625, 9 * i, 90 * i);
    sprintf(text + strlen(text), " (translate %d 18 0 (rotate 0 0 %d (union (cbox 2 2 2) (translate 1 1 %g (cbox 2 2 2)))))", 9 * i, 90 * i, i % 2 ? 1.0 : 1 + i * 0.03125);
  }
  strcat(text, ")");
  sx_problem p;
  assert_true(sx_parse(text, &p));
  for (uint32_t i = 0; i < p.problem.leaf_count; i += 5) p.leaves[i].placement.m[2][2] *= -1; /* mirrors some of the leaves */
  assert_true(by_threads(&p.problem) > 40 * 48 * 40);
  sx_free(&p);
}

static void test_threads(void **state) {
  (void)state;
  char text[2000] = "(difference (union";
  for (int i = 0; i < 12; i++)
    sprintf(text + strlen(text), " (translate %d %d %d (rotate %d 20 %d (sphere 3 64)))", (int)span(0, 6), (int)span(0, 6), (int)span(0, 6), i * 7, i * 11);
  strcat(text, ") (translate 1 1 -9 (cyl 30 1 2 48)) (torus 4 1 64 32))");
  sx_problem p;
  vs_mesh m = { 0 };
  assert_true(sx_parse(text, &p));
  assert_true(by_threads(&p.problem) > 10000);
  for (int ticks = 1; ticks < 40; ticks += 7) {
    int left = ticks;
    vs_job job = { .going = stop, .context = &left };
    vs_kernel_options options = { .job = &job, .threads = 4 };
    vs_kernel_error e;
    assert_false(vs_kernel_evaluate(&p.problem, &options, &m, &e));
    assert_int_equal(e.status, VS_KERNEL_INTERRUPTED);
  }
  for (size_t bytes = 100000; bytes < 30000000; bytes *= 3) {
    vs_kernel_options options = { .max_bytes = bytes, .threads = 4 };
    vs_kernel_error e;
    if (!vs_kernel_evaluate(&p.problem, &options, &m, &e)) assert_int_equal(e.status, VS_KERNEL_OUT_OF_MEMORY);
  }
  vs_mesh_free(&m);
  sx_free(&p);
}

static void test_errors(void **state) {
  (void)state;
  sx_problem p;
  vs_mesh m = { 0 };
  vs_kernel_error e;
  assert_true(sx_parse("(union (box 1 1 1) (translate 5 0 0 (sphere 1 8)))", &p));
  p.meshes[1]->triangle_count--;
  assert_false(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
  assert_int_equal(e.status, VS_KERNEL_OPEN);
  assert_int_equal(e.leaf, 1);
  assert_int_equal(m.triangle_count, 0);
  p.meshes[1]->triangle_count++;
  vs_mesh_turn(p.meshes[0], 0);
  assert_false(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
  assert_int_equal(e.status, VS_KERNEL_INSIDE_OUT);
  assert_int_equal(e.leaf, 0);
  vs_mesh_turn(p.meshes[0], 0);
  p.leaves[0].placement.m[0][0] = -1; /* mirrors a leaf: the kernel must not report its faces as inside out */
  assert_true(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
  p.leaves[0].placement.m[0][3] = NAN;
  size_t before = m.triangle_count;
  assert_false(vs_kernel_evaluate(&p.problem, NULL, &m, &e));
  assert_int_equal(e.status, VS_KERNEL_NOT_FINITE);
  assert_int_equal(m.triangle_count, before);
  vs_mesh_free(&m);
  sx_free(&p);
  assert_true(sx_parse("(difference (sphere 3 32) (translate 1 1 1 (sphere 3 32)))", &p));
  vs_kernel_options limits = { .max_triangles = 10 };
  assert_false(vs_kernel_evaluate(&p.problem, &limits, &m, &e));
  assert_int_equal(e.status, VS_KERNEL_LIMIT);
  for (size_t bytes = 1000; bytes < 3000000; bytes *= 3) { /* limits the memory to a different number of bytes in each
                                                            * run; a run that fails must free all memory */
    limits = (vs_kernel_options){ .max_bytes = bytes };
    if (!vs_kernel_evaluate(&p.problem, &limits, &m, &e)) assert_int_equal(e.status, VS_KERNEL_OUT_OF_MEMORY);
    else assert_true(bytes > 200000);
  }
  for (int ticks = 1; ticks < 6; ticks++) {
    int left = ticks;
    vs_job job = { .going = stop, .context = &left };
    limits = (vs_kernel_options){ .job = &job };
    assert_false(vs_kernel_evaluate(&p.problem, &limits, &m, &e));
    assert_int_equal(e.status, VS_KERNEL_INTERRUPTED);
  }
  vs_mesh_free(&m);
  sx_free(&p);
}

/* Returns two layers of `bars` crossed bars; each crossing adds some 8 faces to the result. */
static char *lattice(int bars) {
  size_t room = 64 + 128 * (size_t)bars, used = 0;
  char *text = malloc(room);
  assert_non_null(text);
  used += (size_t)snprintf(text, room, "(union");
  for (int i = 0; i < bars; i++)
    used += (size_t)snprintf(text + used, room - used,
                             " (translate 0 %d 0 (box %d 1 1)) (translate %d 0 0.25 (box 1 %d 1))",
                             2 * i, 2 * bars, 2 * i, 2 * bars);
  snprintf(text + used, room - used, ")");
  return text;
}

/* The kernel checks the limit on triangles during its work, not only at the end. Therefore the limit also bounds the
 * memory that is used. */
static void test_limit_on_the_way(void **state) {
  (void)state;
  enum { FEW = 500, MORE = 2000 };
  size_t peaks[3];
  const size_t limits[3] = { 0, MORE, FEW };
  char *text = lattice(170);
  for (int i = 0; i < 3; i++) {
    sx_problem p;
    vs_mesh m = { 0 };
    vs_kernel_error e;
    vs_kernel_counts counts = { 0 };
    assert_true(sx_parse(text, &p));
    vs_kernel_options o = { .max_triangles = limits[i], .counts = &counts, .threads = 1 };
    assert_int_equal(vs_kernel_evaluate(&p.problem, &o, &m, &e), i == 0);
    if (i == 0) assert_true(m.triangle_count > 200000);
    else assert_int_equal(e.status, VS_KERNEL_LIMIT);
    if (i > 0) assert_non_null(strstr(e.message, "8 times the limit"));
    peaks[i] = counts.peak;
    vs_mesh_free(&m);
    sx_free(&p);
  }
  if (peaks[1] > peaks[0] / 2 || peaks[2] > peaks[1]) fail_msg("%zu, %zu and %zu bytes", peaks[0], peaks[1], peaks[2]);
  free(text);
}

/* Tests the kernel's option `straight`, which removes unnecessary vertices from edges. With it, a result has only the
 * corners of its solids and of their intersections; Euler's formula gives the number of triangles. Without it, a result
 * has more triangles, and the same volume. */
static void test_facets_stay_whole(void **state) {
  (void)state;
  static const struct {
    const char *text;
    size_t triangles; /* expected number of triangles with the option `straight`; 0 if unknown */
  } cases[] = {
    { "(difference (box 4 4 4) (translate 2 2 2 (rotate 33 21 17 (cbox 1 1 9))))", 32 },
    { "(difference (rotate 33 21 17 (box 4 4 4)) (translate 0 0 1 (box 1 1 9)) (rotate 33 21 17 (translate 9 0 0 (box 1 1 1))))", 0 },
    { "(union (cbox 1 1 9) (rotate 90 0 0 (cbox .5 .5 9)) (rotate 77 31 12 (cbox .75 .75 9)))", 0 },
    { "(union (rotate 10 20 30 (cyl 6 1 1 12)) (rotate 95 3 40 (translate 0 0 -3 (cyl 6 .8 .6 12))) (rotate 50 103 7 (translate 0 0 -2 (cyl 6 .7 .7 12))))", 0 },
    { "(intersection (rotate 10 20 30 (cbox 3 3 3)) (rotate 40 50 60 (cbox 3 3 3)) (rotate 70 15 25 (cbox 3 3 3)))", 0 },
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    sx_problem p;
    vs_kernel_error e;
    vs_mesh m[2] = { { 0 } };
    vs_kernel_counts counts[2] = { { 0 } };
    crossings_found found;
    assert_true(sx_parse(cases[i].text, &p));
    for (int straight = 0; straight < 2; straight++) {
      vs_kernel_options options = { .straight = straight, .counts = &counts[straight] };
      if (!vs_kernel_evaluate(&p.problem, &options, &m[straight], &e)) fail_msg("%s: %s", cases[i].text, e.message);
      check_manifold(&m[straight]);
      assert_true(crossings_find((const crossings_point *)m[straight].vertices, m[straight].vertex_count, (const crossings_triangle *)m[straight].triangles,
                                 m[straight].triangle_count, &found));
      assert_int_equal(crossings_sum(&found), 0);
    }
    near(vs_mesh_volume(&m[1]), vs_mesh_volume(&m[0]), 1e-8);
    assert_int_equal(counts[0].straightened, 0);
    assert_true(counts[1].straightened > 0);
    assert_int_equal(m[1].triangle_count + 2 * counts[1].straightened, m[0].triangle_count);
    if (cases[i].triangles) assert_int_equal(m[1].triangle_count, cases[i].triangles);
    for (int straight = 0; straight < 2; straight++) vs_mesh_free(&m[straight]);
    sx_free(&p);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_against_oracle),
    cmocka_unit_test(test_cubes_become_one),
    cmocka_unit_test(test_equal_turns_written_differently),
    cmocka_unit_test(test_sheared_alike),
    cmocka_unit_test(test_touching_is_split),
    cmocka_unit_test(test_identities),
    cmocka_unit_test(test_thin_and_nested),
    cmocka_unit_test(test_plain),
    cmocka_unit_test(test_alone),
    cmocka_unit_test(test_twice_in_place),
    cmocka_unit_test(test_edge_on_diagonal),
    cmocka_unit_test(test_far_larger),
    cmocka_unit_test(test_self_check),
    cmocka_unit_test(test_tags),
    cmocka_unit_test(test_facets_stay_whole),
    cmocka_unit_test(test_wide_and_deep),
    cmocka_unit_test(test_places),
    cmocka_unit_test(test_threads),
    cmocka_unit_test(test_copies),
    cmocka_unit_test(test_errors),
    cmocka_unit_test(test_limit_on_the_way),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
