/* Tests the removal of hidden lines against formulas: the visible length of edges beside, behind, in and through
 * triangles, in parallel and perspective views. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "solids/sight_edges.h"

/* A scene of boxes, in view coordinates: x right, y up, z away from the viewer. */
enum { MOST = 4000 };
typedef struct { vs_vec3 points[MOST]; uint32_t triangles[MOST][3]; size_t point_count, triangle_count; } model;

/* Adds a box from p to q, with its corners multiplied by the matrix `turn`. Faces are counter-clockwise as seen from
 * outside. The viewer's axes x, y, z are left-handed. */
static void add_box(model *m, vs_vec3 p, vs_vec3 q, const double turn[3][3]) {
  static const int faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  uint32_t base = (uint32_t)m->point_count;
  for (int i = 0; i < 8; i++) {
    double at[3] = { i & 1 ? q.x : p.x, i & 2 ? q.y : p.y, i & 4 ? q.z : p.z }, out[3] = { 0, 0, 0 };
    for (int r = 0; r < 3; r++)
      for (int c = 0; c < 3; c++) out[r] += (turn ? turn[r][c] : r == c) * at[c];
    m->points[m->point_count++] = vs_v3(out[0], out[1], out[2]);
  }
  for (int f = 0; f < 6; f++)
    for (int half = 0; half < 2; half++) {
      uint32_t *t = m->triangles[m->triangle_count++];
      t[0] = base + (uint32_t)faces[f][0], t[1] = base + (uint32_t)faces[f][1 + half], t[2] = base + (uint32_t)faces[f][2 + half];
    }
}

static bool never(void *context, const char *stage, double done) { return (void)context, (void)stage, (void)done, false; }

static vs_sight sight_of(const model *m, bool perspective) {
  return (vs_sight){ .points = m->points, .triangles = m->triangles, .point_count = m->point_count, .triangle_count = m->triangle_count,
                     .closed = m->triangle_count, .perspective = perspective, .slack = 1e-7 };
}

typedef struct { size_t pieces; double seen, hidden; } result;

/* Returns the lengths of visible and hidden edges in the picture. own: edges to test, or NULL for the model's edges. */
static result look(const model *m, bool perspective, const vs_sight_edges *own) {
  vs_store *store = vs_store_new(NULL, NULL);
  vs_sight_host host = { store, NULL };
  vs_sight s = sight_of(m, perspective);
  vs_sight_edges edges = { 0 };
  vs_sight_pieces pieces = { 0 };
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  result r = { 0, 0, 0 };
  if (!own) assert_true(vs_sight_find_edges(&host, &s, &edges, &e));
  const vs_sight_edges *all = own ? own : &edges;
  assert_true(vs_sight_find_visible(&host, &s, all, true, &pieces, &e));
  for (size_t i = 0; i < pieces.count; i++) {
    const vs_sight_edge *edge = &all->at[pieces.at[i].edge];
    double a[2], b[2];
    for (int k = 0; k < 2; k++) {
      double share = k ? pieces.at[i].to : pieces.at[i].from, *at = k ? b : a;
      vs_vec3 p = vs_v3_add(edge->p, vs_v3_scale(vs_v3_sub(edge->q, edge->p), share));
      at[0] = perspective ? p.x / p.z : p.x, at[1] = perspective ? p.y / p.z : p.y;
    }
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    *(pieces.at[i].hidden ? &r.hidden : &r.seen) += length;
    r.pieces += !pieces.at[i].hidden;
  }
  vs_sight_edges_free(&host, &edges);
  vs_sight_pieces_free(&host, &pieces);
  assert_int_equal(vs_store_bytes(store), 0);
  vs_store_release(store);
  return r;
}

static result look_at_line(const model *m, bool perspective, vs_vec3 p, vs_vec3 q) {
  vs_sight_edge edge = { p, q, VS_SIGHT_CURVE, 1e-7, 0 };
  return look(m, perspective, &(vs_sight_edges){ &edge, 1, 1 });
}

/* Rotation for an isometric view: a diagonal of the cube is parallel to the direction of view. */
static const double isometric[3][3] = { { 0.70710678118654752, 0, -0.70710678118654752 },
                                        { 0.40824829046386302, 0.81649658092772603, 0.40824829046386302 },
                                        { -0.57735026918962576, 0.57735026918962576, -0.57735026918962576 } };

static void a_cube_in_isometric_has_nine_edges(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  add_box(&m, vs_v3(0, 0, 0), vs_v3(2, 2, 2), isometric);
  result r = look(&m, false, NULL);
  assert_int_equal(r.pieces, 9);
  assert_true(fabs(r.seen - 9 * 2 * sqrt(2. / 3)) < 1e-9); /* nine edges of the cube are visible; the three hidden edges
                                                            * end at the corner behind the nearest corner */
}

static void a_box_seen_from_the_front_is_a_rectangle(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  add_box(&m, vs_v3(1, 2, 3), vs_v3(4, 4, 9), NULL);
  result r = look(&m, false, NULL);
  assert_true(fabs(r.seen - 10) < 1e-9); /* the back face's edges are hidden by the front face; edges parallel to the
                                          * view appear as points, of length 0 */
}

static void a_box_behind_a_box(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  add_box(&m, vs_v3(0, 0, 0), vs_v3(4, 4, 1), NULL);
  add_box(&m, vs_v3(2, 1, 5), vs_v3(6, 3, 6), NULL); /* the second box's face is 4 wide and 2 high; its left half is
                                                      * behind the first box */
  assert_true(fabs(look(&m, false, NULL).seen - (16 + 2 + 2 + 2)) < 1e-9);
  model touching = { .point_count = 0 }; /* two boxes side by side with their front faces in one plane: neither face
                                          * hides the other */
  add_box(&touching, vs_v3(0, 0, 0), vs_v3(4, 4, 1), NULL);
  add_box(&touching, vs_v3(4, 0, 0), vs_v3(6, 4, 1), NULL);
  /* the two front faces have an edge of length 4 in common, whose length counts once */
  assert_true(fabs(look(&touching, false, NULL).seen - (16 + 12 - 4)) < 1e-9);
}

static void lines_beside_behind_and_through(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  add_box(&m, vs_v3(0, 0, 0), vs_v3(2, 2, 2), NULL);
  result r = look_at_line(&m, false, vs_v3(-1, 1, 5), vs_v3(5, 1, 5));
  assert_true(fabs(r.hidden - 2) < 1e-9 && fabs(r.seen - 4) < 1e-9 && r.pieces == 2);
  r = look_at_line(&m, false, vs_v3(-1, 1, -1), vs_v3(5, 1, -1)); /* a line in front of the box */
  assert_true(r.hidden == 0 && r.pieces == 1);
  r = look_at_line(&m, false, vs_v3(-1, 1, 0), vs_v3(5, 1, 0)); /* a line in the front face of the box */
  assert_true(r.hidden == 0 && r.pieces == 1);
  r = look_at_line(&m, false, vs_v3(0.5, 1, -1), vs_v3(1.5, 1, 1)); /* a line that enters the box through the front face
                                                                     * at the line's midpoint */
  assert_true(fabs(r.hidden - 0.5) < 1e-6 && fabs(r.seen - 0.5) < 1e-6);
  r = look_at_line(&m, false, vs_v3(0, 0, 3), vs_v3(2, 2, 3)); /* a line behind the front face, along the diagonal that
                                                                * divides this face into triangles */
  assert_true(r.pieces == 0 && fabs(r.hidden - sqrt(8)) < 1e-9);
  r = look_at_line(&m, false, vs_v3(0, -1, 3), vs_v3(0, 3, 3)); /* a line behind the border of the front face: the part
                                                                 * behind the border is hidden */
  assert_true(fabs(r.hidden - 2) < 1e-9 && r.pieces == 2);
  r = look_at_line(&m, false, vs_v3(2, 1, 5), vs_v3(4, 3, 5)); /* a line that begins at the border of a face */
  assert_true(r.hidden == 0 && r.pieces == 1);
}

static void in_perspective(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  add_box(&m, vs_v3(-1, -1, 4), vs_v3(1, 1, 6), NULL);
  result r = look(&m, true, NULL); /* in the picture, half the front face's width is 1/4; half the back face's width is
                                    * 1/6, so the front face hides it */
  assert_true(fabs(r.seen - 8 * 0.25) < 1e-9);
  r = look_at_line(&m, true, vs_v3(-4, 0, 8), vs_v3(4, 0, 8)); /* in the picture, the line goes from -1/2 to 1/2; the
                                                                * box hides it from -1/4 to 1/4 */
  assert_true(fabs(r.hidden - 0.5) < 1e-9 && fabs(r.seen - 0.5) < 1e-9);
  r = look_at_line(&m, true, vs_v3(-4, 0, 8), vs_v3(4, 0, 16)); /* an oblique line: in the picture, it goes from -1/2 to
                                                                 * 1/4; the box hides it from -1/4 on */
  assert_true(fabs(r.hidden - 0.5) < 1e-9 && fabs(r.seen - 0.25) < 1e-9);
}

static void faces_seen_edge_on_hide_nothing(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  static const double nearly[3][3] = { { 1, 0, 1e-9 }, { 0, 1, 0 }, { -1e-9, 0, 1 } };
  add_box(&m, vs_v3(0, 0, 0), vs_v3(2, 2, 1000), nearly); /* a long box, rotated by a billionth of a radian from the
                                                           * direction of view */
  result r = look_at_line(&m, false, vs_v3(2.001, 0, 2000), vs_v3(2.001, 2, 2000));
  assert_true(r.hidden == 0 && r.pieces == 1);
  assert_true(fabs(look(&m, false, NULL).seen - 8) < 1e-5);
}

/* Tests a row of boxes, each of which hides the next. Time and memory must not grow too fast. Only the first box and
 * the edges that project beyond it are visible. */
static void many_boxes(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  for (int i = 0; i < 300; i++) add_box(&m, vs_v3(0, 0, 2 * i), vs_v3(4 + 0.001 * i, 4, 2 * i + 1), NULL);
  result r = look(&m, false, NULL);
  assert_true(fabs(r.seen - (16 + 299 * (4 + 0.001 * 2))) < 1e-6); /* of each of the 299 later boxes, the right edge of
                                                                    * length 4 is visible, and 0.001 of each of the two
                                                                    * edges at its ends */
}

static void stopping_and_failing(void **state) {
  (void)state;
  model m = { .point_count = 0 };
  for (int i = 0; i < 300; i++) add_box(&m, vs_v3(3 * (i % 20), 3 * (i / 20), 0), vs_v3(3 * (i % 20) + 2, 3 * (i / 20) + 2, 1), isometric);
  vs_sight s = sight_of(&m, false);
  vs_store *store = vs_store_new(NULL, NULL);
  vs_sight_edges edges = { 0 };
  vs_sight_pieces pieces = { 0 };
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_job stopped = { .going = never };
  assert_false(vs_sight_find_edges(&(vs_sight_host){ store, &stopped }, &s, &edges, &e));
  assert_int_equal(e.kind, VS_ERROR_INTERRUPT);
  vs_sight_host host = { store, NULL };
  vs_sight_edges_free(&host, &edges);
  assert_true(vs_sight_find_edges(&host, &s, &edges, &e));
  host.job = &stopped;
  assert_false(vs_sight_find_visible(&host, &s, &edges, false, &pieces, &e));
  assert_int_equal(e.kind, VS_ERROR_INTERRUPT);
  host.job = NULL;
  vs_sight_pieces_free(&host, &pieces);
  for (size_t n = 1; n < 12; n++) { /* refuses the n-th allocation: the result is an error, and no memory is lost */
    vs_store_fail_at(store, n);
    if (!vs_sight_find_visible(&host, &s, &edges, false, &pieces, &e)) assert_int_equal(e.kind, VS_ERROR_MEMORY);
    vs_store_fail_at(store, 0);
    vs_sight_pieces_free(&host, &pieces);
  }
  vs_sight_edges_free(&host, &edges);
  assert_int_equal(vs_store_bytes(store), 0);
  vs_store_release(store);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_cube_in_isometric_has_nine_edges), cmocka_unit_test(a_box_seen_from_the_front_is_a_rectangle),
    cmocka_unit_test(a_box_behind_a_box), cmocka_unit_test(lines_beside_behind_and_through), cmocka_unit_test(in_perspective),
    cmocka_unit_test(faces_seen_edge_on_hide_nothing), cmocka_unit_test(many_boxes), cmocka_unit_test(stopping_and_failing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
