/* Tests that the passes keep the solid of each random drawing, and that each pass has its intended effect. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/measure/node_measures.h"
#include "model/job.h"
#include "model/order.h"
#include "passes/group.h"
#include "passes/passes.h"
#include "model/looks/ready_materials.h"
#include "model/store/store_inside.h"
#include "passes/rewrite.h"

#define NODE(lower, upper, ...) vs_node_new(s, VS_##upper, &(struct vs_##lower){ __VA_ARGS__, 0 }, NULL, 0)
enum { ALL = (1 << VS_PASS_COUNT) - 1 };

static bool bounds(void *context, const vs_node *n, vs_bounds *out, vs_error *e) { return vs_bounds_memo_get(context, n, out, e); }

static vs_pass_stats run(vs_store *s, vs_ref *ref, unsigned passes) {
  vs_bounds_memo memo = { .places = { .store = s } };
  vs_pass_options o = { passes, bounds, &memo, NULL };
  vs_pass_stats stats;
  vs_error e = { 0 };
  if (!vs_passes_run(s, ref, 1, &o, &stats, &e)) fail_msg("%s", e.message);
  vs_bounds_memo_free(&memo);
  return stats;
}

/* takes over the references to the children `kids` */
static vs_node *over(vs_store *s, vs_kind kind, const void *data, vs_node **kids, size_t count) {
  vs_ref *refs = malloc((count + 1) * sizeof *refs);
  assert_non_null(refs);
  for (size_t i = 0; i < count; i++) refs[i] = (vs_ref){ kids[i], NULL };
  vs_node *n = vs_node_new(s, kind, data, refs, count);
  for (size_t i = 0; i < count; i++) vs_node_release(kids[i]);
  free(refs);
  return n;
}
static vs_node *two(vs_store *s, vs_kind kind, vs_node *a, vs_node *b) { return over(s, kind, NULL, (vs_node *[]){ a, b }, 2); }
static vs_node *moved(vs_store *s, vs_affine a, vs_node *n) { return over(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = a }, &n, 1); }
static vs_node *shifted(vs_store *s, double x, double y, double z, vs_node *n) { return moved(s, vs_affine_translation(vs_v3(x, y, z)), n); }

static void sets_become_flat(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *sum = NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0);
  for (int i = 1; i < 1000; i++) sum = two(s, VS_UNION, sum, NODE(sphere, SPHERE, { i, 0, 0 }, 1, 0));
  vs_ref r = { sum, NULL };
  run(s, &r, 1 << VS_PASS_FLATTEN);
  assert_int_equal(r.node->child_count, 1000);
  for (uint32_t i = 0; i < 1000; i++) assert_true(VS_AS(sphere, r.node->children[i].node)->center.x == i);
  vs_node_release(r.node);
  vs_node *cut = two(s, VS_DIFFERENCE, two(s, VS_DIFFERENCE, NODE(sphere, SPHERE, { 0, 0, 0 }, 3, 0), NODE(sphere, SPHERE, { 1, 0, 0 }, 1, 0)),
                     two(s, VS_UNION, NODE(sphere, SPHERE, { 2, 0, 0 }, 1, 0), NODE(sphere, SPHERE, { 3, 0, 0 }, 1, 0)));
  r = (vs_ref){ cut, NULL };
  vs_pass_stats stats = run(s, &r, 1 << VS_PASS_FLATTEN);
  assert_int_equal(r.node->kind, VS_DIFFERENCE);
  assert_int_equal(r.node->child_count, 4);
  assert_true(stats.commands_before == 7 && stats.commands_after == 7 && stats.changed[VS_PASS_FLATTEN] == 1);
  vs_node_release(r.node);
  vs_store_release(s);
}

static bool never(void *asked, const char *stage, double done) {
  (void)stage, (void)done;
  return ++*(size_t *)asked, false;
}

/* The pass machinery numbers the nodes of a large drawing. It must poll for an interrupt meanwhile, and free all memory
 * after an interrupt. */
static void numbering_is_interrupted(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *all[20000];
  size_t count = sizeof all / sizeof *all, asked = 0;
  vs_ref *refs = malloc(count * sizeof *refs);
  assert_non_null(refs);
  for (size_t i = 0; i < count; i++) {
    all[i] = shifted(s, (double)i, 0, 0, NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0));
    refs[i] = (vs_ref){ all[i], NULL };
  }
  vs_order o = { .store = s };
  vs_error e = { 0 };
  assert_true(vs_order_make(&o, refs, count, &e) && o.count == count);
  vs_job job = { .going = never, .context = &asked };
  vs_store_set_job(s, &job);
  assert_false(vs_order_make(&o, refs, count, &e));
  assert_int_equal(e.kind, VS_ERROR_INTERRUPT);
  assert_true(asked == 1 && o.at == NULL && o.count == 0);
  vs_store_set_job(s, NULL);
  for (size_t i = 0; i < count; i++) vs_node_release(all[i]);
  free(refs);
  vs_store_release(s);
}

static void templates_are_not_undone(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *pair = two(s, VS_UNION, NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0), NODE(sphere, SPHERE, { 2, 0, 0 }, 1, 0));
  vs_ref r = { two(s, VS_UNION, shifted(s, 5, 0, 0, vs_node_retain(pair)), vs_node_retain(pair)), NULL };
  run(s, &r, ALL);
  assert_int_equal(r.node->child_count, 2);
  assert_ptr_equal(r.node->children[1].node, pair);
  assert_ptr_equal(r.node->children[0].node->children[0].node, pair);
  vs_node_release(r.node);
  vs_node_release(pair);
  vs_store_release(s);
}

static void placements_fold(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_affine quarter = vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(0, 0, 1), 1.57079632679489661923), tilt = vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(1, 1, 0), 0.3);
  vs_ref r = { shifted(s, 1, 0, 0, moved(s, quarter, shifted(s, 1, 1, 1, NODE(box, BOX, { 0, 0, 0 }, { 2, 1, 1 })))), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_BOX);
  assert_true(vs_v3_equal(VS_AS(box, r.node)->p, vs_v3(-1, 1, 1)) && vs_v3_equal(VS_AS(box, r.node)->q, vs_v3(0, 3, 2)));
  vs_node_release(r.node);
  r = (vs_ref){ moved(s, tilt, NODE(box, BOX, { 0, 0, 0 }, { 2, 1, 1 })), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_TRANSFORM);
  vs_node_release(r.node);
  r = (vs_ref){ moved(s, tilt, NODE(cylinder, CYLINDER, { 0, 0, 0 }, { 0, 0, 2 }, 1, 0)), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_CYLINDER);
  assert_true(VS_AS(cylinder, r.node)->radius == 1);
  vs_node_release(r.node);
  /* the program requires six facets, so the pass may not replace the placement by a mere rotation of the facets */
  r = (vs_ref){ moved(s, tilt, NODE(cylinder, CYLINDER, { 0, 0, 0 }, { 0, 0, 2 }, 1, 6)), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_TRANSFORM);
  vs_node_release(r.node);
  vs_store_release(s);
}

/* Checks that the pass replaces the node n, moved by the transformation a, by a node of this kind. VS_TRANSFORM: the
 * pass must not replace it. Releases n. */
static void folds_to(vs_store *s, vs_affine a, vs_node *n, vs_kind kind) {
  vs_ref r = { moved(s, a, n), NULL };
  vs_bounds before, after;
  assert_true(vs_node_bounds(r.node, &before, NULL));
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, kind);
  assert_true(vs_node_bounds(r.node, &after, NULL));
  assert_true(vs_v3_length(vs_v3_sub(before.max, after.max)) < 1e-9 && vs_v3_length(vs_v3_sub(before.min, after.min)) < 1e-9);
  vs_node_release(r.node);
}

static void kinds_fold_under_what_they_are_closed_under(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 o = { 0, 0, 0 }, heights[] = { { 0, 0, 1 }, { 1, 0, 2 }, { 0, 1, 1 }, { 1, 1, 3 } };
  vs_affine turn = vs_affine_rotation(o, vs_v3(0, 0, 1), 0.3), tilt = vs_affine_rotation(o, vs_v3(1, 2, 0), 0.3), uneven = vs_affine_scaling(o, vs_v3(2, 3, 4));
  vs_affine tall = vs_affine_scaling(o, vs_v3(2, 2, 5)), larger = vs_affine_scaling(o, vs_v3(3, 3, 3)), mirror = vs_affine_mirror(vs_v3(1, 2, 3), vs_v3(1, 1, 2));
  folds_to(s, uneven, NODE(box, BOX, { 0, 0, 0 }, { 1, 2, 3 }), VS_BOX);
  folds_to(s, turn, NODE(box, BOX, { 0, 0, 0 }, { 1, 2, 3 }), VS_TRANSFORM);
  folds_to(s, uneven, NODE(wedge, WEDGE, { 0, 0, 0 }, { 1, 2, 3 }), VS_WEDGE);
  folds_to(s, vs_affine_mirror(o, vs_v3(1, 0, 0)), NODE(wedge, WEDGE, { 0, 0, 0 }, { 1, 2, 3 }), VS_TRANSFORM);
  folds_to(s, mirror, NODE(sphere, SPHERE, { 1, 2, 3 }, 2, 0), VS_SPHERE);
  folds_to(s, tall, NODE(sphere, SPHERE, { 1, 2, 3 }, 2, 0), VS_TRANSFORM);
  folds_to(s, tall, NODE(cylinder, CYLINDER, { 1, 2, 3 }, { 1, 2, 5 }, 2, 0), VS_CYLINDER);
  folds_to(s, tall, NODE(cylinder, CYLINDER, { 1, 2, 3 }, { 2, 2, 5 }, 2, 0), VS_TRANSFORM);
  folds_to(s, uneven, NODE(cylinder, CYLINDER, { 1, 2, 3 }, { 1, 2, 5 }, 2, 0), VS_TRANSFORM);
  folds_to(s, tall, NODE(cone, CONE, { 1, 2, 3 }, { 1, 2, 5 }, 2, 0), VS_CONE);
  folds_to(s, mirror, NODE(cut_cone, CUT_CONE, { 1, 2, 3 }, 2, { 1, 4, 5 }, 1, 0), VS_CUT_CONE);
  folds_to(s, uneven, NODE(e_cone, E_CONE, { 1, 2, 3 }, 2, 1, { 1, 2, 5 }, 1, 7), VS_E_CONE);
  folds_to(s, uneven, NODE(e_cone, E_CONE, { 1, 2, 3 }, 2, 1, { 1, 3, 5 }, 1, 0), VS_TRANSFORM);
  folds_to(s, turn, NODE(torus, TORUS, { 1, 2, 3 }, 2, 1, 0), VS_TORUS);
  folds_to(s, tilt, NODE(torus, TORUS, { 1, 2, 3 }, 2, 1, 0), VS_TRANSFORM);
  folds_to(s, larger, NODE(superellipsoid, SUPERELLIPSOID, 0.5, 0.5, 2, 0), VS_SUPERELLIPSOID);
  folds_to(s, vs_affine_translation(vs_v3(1, 0, 0)), NODE(superellipsoid, SUPERELLIPSOID, 0.5, 0.5, 2, 0), VS_TRANSFORM);
  folds_to(s, larger, NODE(pyramid, PYRAMID, { 1, 2, 3 }, 2, 5, { 1, 4, 5 }, 1), VS_PYRAMID);
  folds_to(s, turn, NODE(arc, ARC, { 1, 2, 3 }, 2, 0.5, 2, 0), VS_ARC);
  /* the pass keeps this placement: a rotated circle would begin at another point, which would change a sweep along
   * it */
  folds_to(s, turn, NODE(circle, CIRCLE, { 1, 2, 3 }, 2, 0), VS_TRANSFORM);
  vs_points *points = vs_points_new(s, heights, 4);
  folds_to(s, mirror, NODE(line, LINE, points, false), VS_LINE);
  folds_to(s, tilt, NODE(spline, SPLINE, points, false, { 0, 0, 0 }, { 0, 0, 0 }, 0), VS_SPLINE);
  folds_to(s, uneven, NODE(spline, SPLINE, points, false, { 0, 0, 0 }, { 0, 0, 0 }, 32), VS_TRANSFORM);
  folds_to(s, uneven, NODE(height_field, HEIGHT_FIELD, points, 2, -1), VS_HEIGHT_FIELD);
  folds_to(s, turn, NODE(height_field, HEIGHT_FIELD, points, 2, -1), VS_TRANSFORM);
  vs_points *corners = vs_points_new(s, (vs_vec3[]){ { 1, 0, 0 }, { 2, 0, 0 }, { 1, 3, 0 } }, 3);
  struct vs_extrude up = { .along = { 0, 1, 3 }, .scale = 1 };
  for (int i = 0; i < 2; i++) {
    vs_node *line = NODE(line, LINE, corners, true);
    folds_to(s, i ? turn : larger, over(s, VS_EXTRUDE, &up, &line, 1), i ? VS_TRANSFORM : VS_EXTRUDE);
  }
  vs_points_release(s, corners);
  vs_points_release(s, points);
  vs_store_release(s);
}

static vs_node *painted(vs_store *s, const char *name, vs_node *n) {
  struct { vs_field_material material; unsigned char end; } data = { vs_store_ready_material(s, name), 0 };
  return over(s, VS_MATERIAL, &data, &n, 1);
}
static vs_node *layered(vs_store *s, const char *name, vs_node *n) { return over(s, VS_LAYER, &(struct vs_layer){ .name = vs_store_text(s, name, strlen(name)) }, &n, 1); }

static void placements_go_through_what_takes_them_in(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_ref r = { shifted(s, 1, 2, 3, painted(s, "red", layered(s, "roof", NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0)))), NULL };
  vs_pass_stats stats = run(s, &r, 1 << VS_PASS_FOLD);
  assert_true(stats.commands_before == 4 && stats.commands_after == 3);
  assert_int_equal(r.node->kind, VS_MATERIAL);
  assert_int_equal(r.node->children[0].node->children[0].node->kind, VS_SPHERE);
  vs_node_release(r.node);
  vs_node *cut = two(s, VS_DIFFERENCE, NODE(sphere, SPHERE, { 0, 0, 0 }, 2, 0), shifted(s, 0, 0, 1, NODE(torus, TORUS, { 0, 0, 0 }, 1, 0.5, 6)));
  r = (vs_ref){ shifted(s, 1, 2, 3, cut), NULL };
  stats = run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_DIFFERENCE);
  assert_true(stats.commands_after == 3 && VS_AS(torus, r.node->children[1].node)->center.z == 4);
  vs_node_release(r.node);
  /* the pass keeps a box's rotation as a placement, because fields of the box for it would save nothing */
  vs_affine turn = vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(0, 0, 1), 0.3);
  r = (vs_ref){ moved(s, turn, two(s, VS_UNION, NODE(sphere, SPHERE, { 0, 0, 0 }, 2, 0), NODE(box, BOX, { 0, 0, 0 }, { 1, 1, 1 }))), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_TRANSFORM);
  vs_node_release(r.node);
  /* a moved union inside a union: the pass makes a single union of the members of both unions */
  r = (vs_ref){ two(s, VS_UNION, NODE(sphere, SPHERE, { 9, 0, 0 }, 2, 0), shifted(s, 1, 0, 0, two(s, VS_UNION, NODE(sphere, SPHERE, { 0, 0, 0 }, 2, 0), NODE(sphere, SPHERE, { 4, 0, 0 }, 1, 0)))), NULL };
  stats = run(s, &r, ALL);
  assert_true(r.node->child_count == 3 && stats.commands_before == 6 && stats.commands_after == 5);
  vs_node_release(r.node);
  vs_store_release(s);
}

static void paint_rises(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *kids[6];
  for (int i = 0; i < 6; i++) kids[i] = painted(s, "red", layered(s, i < 4 ? "roof" : "wall", NODE(sphere, SPHERE, { i, 0, 0 }, 1, 0)));
  vs_ref r = { over(s, VS_UNION, NULL, kids, 6), NULL };
  vs_pass_stats stats = run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_MATERIAL); /* the pass has replaced the materials of the six objects by a single
                                                * material around all of them */
  assert_true(stats.commands_before == 23 && stats.commands_after == 14);
  vs_node_release(r.node);
  for (int i = 0; i < 6; i++) kids[i] = painted(s, i == 2 ? "green" : "red", NODE(sphere, SPHERE, { i, 0, 0 }, 1, 0));
  r = (vs_ref){ over(s, VS_UNION, NULL, kids, 6), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  /* three objects in red, green and red keep their order, because later objects hide earlier objects where they
   * overlap */
  assert_true(r.node->kind == VS_UNION && r.node->child_count == 3);
  assert_int_equal(r.node->children[0].node->children[0].node->child_count, 2);
  assert_int_equal(r.node->children[2].node->children[0].node->child_count, 3);
  vs_node_release(r.node);
  r = (vs_ref){ two(s, VS_UNION, painted(s, "glass", NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0)), painted(s, "glass", NODE(sphere, SPHERE, { 1, 0, 0 }, 1, 0))), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_int_equal(r.node->kind, VS_UNION); /* panes of glass that touch remain separate solids */
  vs_node_release(r.node);
  r = (vs_ref){ painted(s, "red", painted(s, "green", NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0))), NULL };
  run(s, &r, 1 << VS_PASS_FOLD);
  assert_true(r.node->children[0].node->kind == VS_SPHERE && VS_AS(material, r.node)->material == vs_store_ready_material(s, "green"));
  vs_node_release(r.node);
  vs_store_release(s);
}

static void nothing_is_pruned_away_but_nothing(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *none = vs_node_new(s, VS_EMPTY, NULL, NULL, 0);
  vs_node *kids[] = { NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0), NODE(sphere, SPHERE, { 9, 0, 0 }, 1, 0), NODE(sphere, SPHERE, { 1, 0, 0 }, 1, 0), vs_node_retain(none) };
  vs_ref r = { two(s, VS_UNION, over(s, VS_DIFFERENCE, NULL, kids, 4), shifted(s, 1, 2, 3, none)), NULL };
  run(s, &r, 1 << VS_PASS_PRUNE);
  assert_int_equal(r.node->kind, VS_DIFFERENCE);
  assert_int_equal(r.node->child_count, 2);
  vs_node_release(r.node);
  r = (vs_ref){ two(s, VS_INTERSECTION, NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0), NODE(sphere, SPHERE, { 9, 0, 0 }, 1, 0)), NULL };
  run(s, &r, 1 << VS_PASS_PRUNE);
  assert_int_equal(r.node->kind, VS_EMPTY);
  vs_node_release(r.node);
  vs_store_release(s);
}

static vs_node *column(vs_store *s, double x, double y) {
  vs_node *parts[] = { NODE(cylinder, CYLINDER, { x, y, 0 }, { x, y, 4 }, 0.3, 0), NODE(box, BOX, { x - 0.4, y - 0.4, 4 }, { x + 0.4, y + 0.4, 4.2 }),
                       NODE(cut_cone, CUT_CONE, { x, y, 3.5 }, 0.3, { x, y, 4 }, 0.4, 0) };
  return over(s, VS_UNION, NULL, parts, 3);
}

static void copies_become_a_template(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *columns[49];
  for (int i = 0; i < 49; i++) columns[i] = column(s, i % 7 * 3.3 + 0.1, i / 7 * 2.7 - 0.7);
  vs_ref r = { over(s, VS_UNION, NULL, columns, 49), NULL };
  vs_bounds before, after;
  assert_true(vs_node_bounds(r.node, &before, NULL));
  vs_pass_stats stats = run(s, &r, 1 << VS_PASS_SHARE);
  assert_int_equal(stats.changed[VS_PASS_SHARE], 48);
  assert_true(stats.commands_before == 49 * 5 + 48);
  assert_true(stats.commands_after == 5 + 1 + 49 + 48 + 48); /* the output has 5 commands for a column, 1 for its
                                                              * template, 49 uses of the template, 48 placements of
                                                              * these uses, 48 unions */
  assert_true(vs_node_bounds(r.node, &after, NULL));
  assert_true(vs_v3_length(vs_v3_sub(before.max, after.max)) < 1e-9 && vs_v3_length(vs_v3_sub(before.min, after.min)) < 1e-9);
  vs_node_release(r.node);
  vs_store_release(s);
}

/* The next tests use trees that a program writes several times at different places. The numbers of two such trees
 * differ in their last bits. Rounding the numbers, with any step, would therefore not make all copies equal. */
/* Returns a long outline of 40 points with two holes, at the position x. The last point is displaced by `off`. */
static vs_node *strip(vs_store *s, double x, double off) {
  enum { POINTS = 40 };
  vs_vec3 at[POINTS];
  uint32_t starts[POINTS - 1], corners[3 * (POINTS - 2)];
  for (int i = 0; i < POINTS; i++) at[i] = vs_v3(x + i / 2 * 0.25, i % 2, i == POINTS - 1 ? off : 0);
  for (uint32_t i = 0; i < POINTS - 1; i++) starts[i] = 3 * i;
  for (uint32_t i = 0; i < 3 * (POINTS - 2); i++) corners[i] = i / 3 + i % 3;
  vs_points *points = vs_points_new(s, at, POINTS);
  vs_faces *faces = vs_faces_new(s, starts, POINTS - 2, corners, 3 * (POINTS - 2));
  vs_node *n = vs_node_new(s, VS_POLYFACE_MESH, &(struct vs_polyface_mesh){ .points = points, .faces = faces }, NULL, 0);
  vs_points_release(s, points);
  vs_faces_release(s, faces);
  return over(s, VS_DIFFERENCE, NULL, (vs_node *[]){ n, NODE(sphere, SPHERE, { x, 0, 0 }, 0.125, 0), NODE(sphere, SPHERE, { x + 1, 0, 0 }, 0.125, 0) }, 3);
}

static void long_arrays_count_to_their_ends(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *kids[9];
  for (int i = 0; i < 9; i++) kids[i] = strip(s, 16.0 * i, i < 4 ? 0 : i < 8 ? 0.5 : 0.75);
  vs_ref r = { over(s, VS_UNION, NULL, kids, 9), NULL };
  vs_pass_stats stats = run(s, &r, 1 << VS_PASS_SHARE);
  assert_int_equal(stats.changed[VS_PASS_SHARE], 6);
  for (uint32_t i = 0; i < 9; i++) assert_int_equal(r.node->children[i].node->kind, i == 0 || i == 4 || i == 8 ? VS_DIFFERENCE : VS_TRANSFORM);
  assert_ptr_equal(r.node->children[3].node->children[0].node, r.node->children[0].node);
  assert_ptr_equal(r.node->children[7].node->children[0].node, r.node->children[4].node);
  vs_node_release(r.node);
  vs_store_release(s);
}

static void copies_survive_rounding_and_flattening(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *trees[12], *rods[150];
  for (int t = 0; t < 12; t++) {
    for (int i = 0; i < 150; i++) {
      double x = t * 36.955181300451 + 0.7, a = 0.1 * i;
      rods[i] = NODE(cylinder, CYLINDER, { x, sin(a), 11 + a }, { x + 18.47 * cos(a), 3 * sin(7 * a), 25.5 + sin(3 * a) }, 0.12, 12);
    }
    trees[t] = over(s, VS_UNION, NULL, rods, 150);
    /* this strip has a placement around it, so its nodes equal those of the unmoved strip */
    if (t == 7) trees[t] = shifted(s, 0, 0, 0.1, over(s, VS_UNION, NULL, &trees[t], 1));
  }
  vs_ref r = { over(s, VS_UNION, NULL, trees, 12), NULL };
  vs_bounds before, after;
  assert_true(vs_node_bounds(r.node, &before, NULL));
  run(s, &r, ALL);
  assert_int_equal(r.node->child_count, 12);
  const vs_node *first = r.node->children[0].node;
  assert_int_equal(first->kind, VS_UNION);
  for (int t = 1; t < 12; t++) {
    assert_int_equal(r.node->children[t].node->kind, VS_TRANSFORM);
    assert_ptr_equal(r.node->children[t].node->children[0].node, first);
  }
  assert_true(vs_node_bounds(r.node, &after, NULL));
  assert_true(vs_v3_length(vs_v3_sub(before.max, after.max)) < 1e-9 && vs_v3_length(vs_v3_sub(before.min, after.min)) < 1e-9);
  vs_node_release(r.node);
  vs_store_release(s);
}

/* Returns a brace (a bar of a scaffold) at the distance x from the axis, rotated by the angle about Z. Its numbers are
 * rounded as a program's would be. mirrored: the brace is mirrored in the plane of X and Z. */
static vs_node *brace(vs_store *s, double x, double angle, bool mirrored, double radius) {
  vs_affine turn = vs_affine_rotation(vs_v3(x, 1, 0), vs_v3(0, 0, 1), angle), flip = vs_affine_mirror(vs_v3(0, 0, 0), vs_v3(0, 1, 0));
  if (mirrored) turn = vs_affine_multiply(&turn, &flip);
  vs_vec3 at[5] = { { 5, 0, 0 }, { 7, 1, 2 }, { 6, 2, 3 }, { 5, 3, 1 }, { 5.5, 3, 4 } };
  for (int i = 0; i < 5; i++) at[i] = vs_affine_point(&turn, at[i]);
  vs_points *corners = vs_points_new(s, at, 3);
  vs_node *line = NODE(line, LINE, corners, true);
  struct vs_extrude out = { .along = vs_affine_vector(&turn, vs_v3(0.5, -0.5, 0.25)), .scale = 1 };
  vs_node *parts[] = { NODE(cylinder, CYLINDER, at[0], at[1], 0.1, 0), NODE(cone, CONE, at[1], at[2], 0.2, 0), NODE(sphere, SPHERE, at[3], radius, 0),
                       NODE(cut_cone, CUT_CONE, at[3], 0.1, at[4], 0.3, 0), over(s, VS_EXTRUDE, &out, &line, 1), moved(s, turn, NODE(box, BOX, { 4, 4, 4 }, { 5, 6, 7 })) };
  vs_points_release(s, corners);
  return over(s, VS_UNION, NULL, parts, 6);
}

static void turned_copies_become_a_template(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *all[14];
  for (int i = 0; i < 12; i++) all[i] = brace(s, 3, 6.283185307179586 / 12 * i, i % 3 == 2, 0.3);
  all[12] = brace(s, 3, 1, false, 0.3001); /* two braces that are not copies of the others: with another radius, and
                                            * mirrored */
  all[13] = two(s, VS_UNION, brace(s, 3, 2, false, 0.3), NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0));
  vs_ref r = { over(s, VS_UNION, NULL, all, 14), NULL };
  vs_bounds before, after;
  assert_true(vs_node_bounds(r.node, &before, NULL));
  vs_inside *was = vs_inside_new(r.node, NULL);
  vs_pass_stats stats = run(s, &r, 1 << VS_PASS_SHARE);
  assert_int_equal(stats.changed[VS_PASS_SHARE], 12); /* the pass share changes the eleven copies, and a part inside the
                                                       * last copy */
  const vs_node *first = r.node->children[0].node;
  for (int i = 1; i < 12; i++) {
    const vs_node *n = r.node->children[i].node;
    assert_int_equal(n->kind, VS_TRANSFORM);
    assert_ptr_equal(n->children[0].node, first);
    assert_true((vs_affine_determinant(&VS_AS(transform, n)->matrix) < 0) == (i % 3 == 2));
  }
  const vs_affine *quarter = &VS_AS(transform, r.node->children[3].node)->matrix;
  /* the matrix of a quarter turn is exact */
  assert_true(quarter->m[0][0] == 0 && quarter->m[0][1] == -1 && quarter->m[1][0] == 1 && quarter->m[2][2] == 1);
  assert_int_equal(r.node->children[12].node->kind, VS_UNION);
  assert_true(vs_node_bounds(r.node, &after, NULL)); /* the bounds of the rotated union are those of its rotated parts,
                                                      * not those of a rotated box */
  assert_true(vs_v3_length(vs_v3_sub(before.max, after.max)) < 1e-9 && vs_v3_length(vs_v3_sub(before.min, after.min)) < 1e-9);
  vs_inside *is = vs_inside_new(r.node, NULL);
  uint64_t seed = 11;
  size_t inside = 0;
  for (int i = 0; i < 20000; i++) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    vs_vec3 p = { (double)(seed >> 40) / 16777216 * 20 - 7, (double)(seed >> 20 & 0xfffff) / 1048576 * 20 - 9, (double)(seed >> 8 & 0xfff) / 4096 * 8 };
    inside += vs_inside_test(was, p);
    assert_int_equal(vs_inside_test(was, p), vs_inside_test(is, p));
  }
  assert_true(inside > 200);
  vs_inside_free(was);
  vs_inside_free(is);
  vs_node_release(r.node);
  /* every allocation fails in turn */
  vs_node *beside[] = { brace(s, 3, 0, false, 0.3), brace(s, 3, 1, false, 0.3), brace(s, 4, 1, false, 0.3), brace(s, 3, 2, true, 0.3), brace(s, -1, 2, true, 0.3) };
  r.node = over(s, VS_UNION, NULL, beside, 5); /* adds four copies of the first brace: rotated, or rotated and moved */
  assert_true(vs_node_bounds(r.node, &before, NULL));
  run(s, &r, 1 << VS_PASS_SHARE);
  assert_true(vs_node_bounds(r.node, &after, NULL));
  for (int i = 1; i < 5; i++) assert_ptr_equal(r.node->children[i].node->children[0].node, r.node->children[0].node);
  assert_true(vs_v3_length(vs_v3_sub(before.max, after.max)) < 1e-9 && vs_v3_length(vs_v3_sub(before.min, after.min)) < 1e-9);
  vs_node_release(r.node);
  vs_node *pair[] = { brace(s, 3, 0, false, 0.3), brace(s, 3, 1, false, 0.3), brace(s, 3, 2, true, 0.3) };
  r.node = over(s, VS_UNION, NULL, pair, 3);
  vs_node *old = r.node;
  for (size_t n = 1, done = 0; !done; n++) {
    vs_pass_options o = { 1 << VS_PASS_SHARE, NULL, NULL, NULL };
    vs_error e = { 0 };
    size_t held = vs_store_bytes(s);
    vs_store_fail_at(s, n);
    done = vs_passes_run(s, &r, 1, &o, NULL, &e);
    vs_store_fail_at(s, 0);
    if (!done) assert_true(e.kind == VS_ERROR_MEMORY && r.node == old && vs_store_bytes(s) == held);
  }
  assert_int_equal(r.node->children[2].node->kind, VS_TRANSFORM);
  vs_node_release(r.node);
  vs_store_release(s);
}

/* For POV-Ray, the pass changes large unions to trees of unions by bounding box. The solid does not change, and no
 * union has many members. */
static void large_sets_become_trees_of_boxes(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *kids[402];
  struct { vs_field_material material; unsigned char end; } red = { vs_store_ready_material(s, "red"), 0 };
  vs_node *painted = NODE(sphere, SPHERE, { 10, 10, 2 }, 0.5, 0);
  kids[0] = NODE(box, BOX, { -1, -1, 0 }, { 21, 21, 2 });
  for (int i = 0; i < 400; i++) kids[i + 1] = NODE(sphere, SPHERE, { i % 20 + 0.3 * (i % 7), i / 20, 2 }, 0.4 + 0.01 * (i % 5), 0);
  kids[401] = over(s, VS_MATERIAL, &red, &painted, 1);
  vs_ref r = { two(s, VS_UNION, over(s, VS_DIFFERENCE, NULL, kids, 402), NODE(sphere, SPHERE, { 0, 0, 9 }, 1, 0)), NULL };
  vs_inside *before = vs_inside_new(r.node, NULL);
  vs_bounds_memo memo = { .places = { .store = s } };
  vs_pass_options o = { 0, bounds, &memo, NULL };
  vs_node *was = vs_node_retain(r.node);
  assert_true(vs_sets_group(s, &r, 1, &o, NULL));
  const vs_node *cut = r.node->children[0].node;
  assert_int_equal(cut->kind, VS_DIFFERENCE);
  assert_int_equal(cut->child_count, 3); /* the difference has three children: the minuend, the painted subtrahend, and
                                          * one union of all other subtrahends */
  assert_int_equal(cut->children[1].node->kind, VS_MATERIAL);
  vs_ref level[64] = { cut->children[2] };
  size_t open = 1, leaves = 0;
  while (open) {
    const vs_node *n = level[--open].node;
    leaves += n->kind == VS_SPHERE;
    if (n->kind == VS_SPHERE) continue;
    assert_int_equal(n->kind, VS_INTERSECTION);
    assert_int_equal(n->children[0].node->kind, VS_BOX);
    const vs_node *both = n->children[1].node;
    assert_true(both->kind == VS_UNION && both->child_count <= 5);
    for (uint32_t i = 0; i < both->child_count; i++) level[open++] = both->children[i];
  }
  assert_int_equal(leaves, 400);
  vs_inside *after = vs_inside_new(r.node, NULL);
  uint64_t seed = 5;
  size_t holes = 0;
  for (int i = 0; i < 20000; i++) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    vs_vec3 p = { (double)(seed >> 40) / 16777216 * 22 - 1, (double)(seed >> 20 & 0xfffff) / 1048576 * 22 - 1, (double)(seed >> 8 & 0xfff) / 4096 * 2.2 };
    bool in = vs_inside_test(before, p);
    holes += !in && p.z < 2;
    assert_int_equal(in, vs_inside_test(after, p));
  }
  assert_true(holes > 500);
  vs_inside_free(before);
  vs_inside_free(after);
  vs_node_release(r.node);
  r.node = was;
  for (size_t n = 1, done = 0; !done; n++) {
    vs_error e = { 0 };
    vs_bounds_memo_free(&memo);
    size_t held = vs_store_bytes(s);
    vs_store_fail_at(s, n);
    done = vs_sets_group(s, &r, 1, &o, &e);
    vs_store_fail_at(s, 0);
    vs_bounds_memo_free(&memo);
    if (!done) assert_true(e.kind == VS_ERROR_MEMORY && r.node == was && vs_store_bytes(s) == held);
    n += n / 8;
  }
  vs_node_release(r.node);
  vs_store_release(s);
}

/* ---- random drawings ---- */

static uint64_t draw(uint64_t *seed) {
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return *seed >> 16;
}
static double real(uint64_t *seed) { return (double)(draw(seed) % 33) / 8 - 2; }

static vs_node *random_leaf(vs_store *s, uint64_t *seed) {
  vs_vec3 p = { real(seed), real(seed), real(seed) }, d = { real(seed) + 2.1, real(seed) + 2.1, real(seed) + 2.1 }, q = vs_v3_add(p, d);
  switch (draw(seed) % 8) {
    case 0: return NODE(box, BOX, p, q);
    case 1: return NODE(sphere, SPHERE, p, d.x, 0);
    case 2: return NODE(cylinder, CYLINDER, p, q, d.x / 2, draw(seed) % 2 ? 0 : 5);
    case 3: return NODE(cone, CONE, p, q, d.x, 0);
    case 4: return NODE(wedge, WEDGE, p, q);
    case 5: return NODE(torus, TORUS, p, d.x, d.y / 3, 0);
    case 6: return NODE(pyramid, PYRAMID, p, d.x, 5, q, d.y / 2);
    default: return vs_node_new(s, VS_EMPTY, NULL, NULL, 0);
  }
}

static vs_node *random_tree(vs_store *s, uint64_t *seed) {
  vs_node *stock[14];
  for (int i = 0; i < 8; i++) stock[i] = random_leaf(s, seed);
  for (int i = 8; i < 14; i++) {
    vs_node *kids[4];
    size_t n = 1 + draw(seed) % 4;
    for (size_t k = 0; k < n; k++) kids[k] = vs_node_retain(stock[draw(seed) % (uint64_t)i]);
    static const vs_kind sets[] = { VS_UNION, VS_INTERSECTION, VS_DIFFERENCE, VS_UNION };
    stock[i] = over(s, sets[draw(seed) % 4], NULL, kids, n);
    vs_affine a = draw(seed) % 3 == 0   ? vs_affine_translation(vs_v3(real(seed), real(seed), real(seed)))
                  : draw(seed) % 2 == 0 ? vs_affine_rotation(vs_v3(real(seed), 0, 0), vs_v3(real(seed) + 2.5, real(seed), 1), (double)(draw(seed) % 8) * 0.78539816339744830962)
                                        : vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(1, draw(seed) % 2 ? -2 : 1, 0.5));
    if (draw(seed) % 2) stock[i] = moved(s, a, stock[i]);
  }
  vs_node *top = two(s, VS_UNION, vs_node_retain(stock[13]), vs_node_retain(stock[12]));
  for (int i = 0; i < 14; i++) vs_node_release(stock[i]);
  return top;
}

static void random_solids_stay_what_they_are(void **state) {
  (void)state;
  uint64_t seed = 0x9E3779B97F4A7C15u;
  size_t inside = 0, differ = 0;
  for (int round = 0; round < 150; round++) {
    vs_store *s = vs_store_new(NULL, NULL);
    vs_ref r = { random_tree(s, &seed), NULL };
    vs_inside *before = vs_inside_new(r.node, NULL);
    run(s, &r, round % 2 ? ALL : 1u << (round / 2 % VS_PASS_COUNT));
    vs_inside *after = vs_inside_new(r.node, NULL);
    assert_true(before && after);
    for (int i = 0; i < 400; i++) { /* compares at random points, because rounding decides at corners that two solids
                                     * have in common */
      vs_vec3 p = { real(&seed) * 1.3 + 0.0137, real(&seed) * 1.3 + 0.0171, real(&seed) * 1.3 + 0.0113 };
      bool was = vs_inside_test(before, p);
      inside += was;
      differ += was != vs_inside_test(after, p);
    }
    vs_inside_free(before);
    vs_inside_free(after);
    vs_node_release(r.node);
    vs_store_release(s);
  }
  assert_true(inside > 1000);
  assert_int_equal(differ, 0);
}

static void deep_trees_and_short_memory(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *deep = NODE(sphere, SPHERE, { 0, 0, 0 }, 1, 0);
  for (int i = 0; i < 200000; i++) deep = i % 2 ? shifted(s, 1, 0, 0, deep) : over(s, VS_UNION, NULL, &deep, 1);
  vs_ref r = { deep, NULL };
  run(s, &r, ALL);
  assert_int_equal(r.node->kind, VS_SPHERE);
  assert_true(VS_AS(sphere, r.node)->center.x == 100000);
  vs_node_release(r.node);
  uint64_t seed = 7;
  r.node = random_tree(s, &seed);
  vs_node *was = r.node;
  bool done = false;
  for (size_t n = 1; !done; n++) { /* every allocation fails in turn; the drawing is then unchanged, and no memory is
                                    * lost */
    vs_pass_options o = { ALL, NULL, NULL, NULL };
    vs_error e = { 0 };
    size_t held = vs_store_bytes(s);
    vs_store_fail_at(s, n);
    done = vs_passes_run(s, &r, 1, &o, NULL, &e);
    vs_store_fail_at(s, 0);
    if (!done) assert_true(e.kind == VS_ERROR_MEMORY && r.node == was && vs_store_bytes(s) == held);
  }
  vs_node_release(r.node);
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(numbering_is_interrupted), cmocka_unit_test(sets_become_flat), cmocka_unit_test(templates_are_not_undone), cmocka_unit_test(placements_fold), cmocka_unit_test(kinds_fold_under_what_they_are_closed_under),
    cmocka_unit_test(placements_go_through_what_takes_them_in), cmocka_unit_test(paint_rises),
    cmocka_unit_test(nothing_is_pruned_away_but_nothing), cmocka_unit_test(copies_become_a_template), cmocka_unit_test(long_arrays_count_to_their_ends), cmocka_unit_test(copies_survive_rounding_and_flattening), cmocka_unit_test(turned_copies_become_a_template), cmocka_unit_test(large_sets_become_trees_of_boxes),
    cmocka_unit_test(random_solids_stay_what_they_are), cmocka_unit_test(deep_trees_and_short_memory),
  };
  return cmocka_run_group_tests_name("model passes", tests, NULL, NULL);
}
