/* Tests the nodes of model/: hashes, equality, deep trees, graphs with shared nodes, materials, and a failure of each
 * allocation. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "model/node.h"

#include "model/walk.h"
#include "model/looks/ready_materials.h"

static vs_node *sphere(vs_store *s, double x, double r) {
  struct vs_sphere data = { .center = { x, 0, 0 }, .radius = r };
  return vs_node_new(s, VS_SPHERE, &data, NULL, 0);
}

static vs_node *both(vs_store *s, vs_kind kind, vs_node *a, vs_node *b) { /* makes a node with the children a and b;
                                                                           * takes over the references to them */
  vs_ref refs[2] = { { a, NULL }, { b, NULL } };
  vs_node *n = a && b ? vs_node_new(s, kind, NULL, refs, 2) : NULL;
  vs_node_release(a);
  vs_node_release(b);
  return n;
}

static void equal_by_value(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *a = both(s, VS_UNION, sphere(s, 0, 1), sphere(s, 2, 1)), *b = both(s, VS_UNION, sphere(s, -0.0, 1), sphere(s, 2, 1));
  vs_node *c = both(s, VS_UNION, sphere(s, 2, 1), sphere(s, 0, 1)), *d = both(s, VS_DIFFERENCE, sphere(s, 0, 1), sphere(s, 2, 1));
  assert_true(a->hash == b->hash && vs_node_equal(a, b, NULL));
  assert_false(vs_node_equal(a, c, NULL));
  assert_false(vs_node_equal(a, d, NULL));
  assert_int_equal(a->class_, VS_SOLID);
  assert_int_equal(a->depth, 2);
  vs_node *all[] = { a, b, c, d };
  for (int i = 0; i < 4; i++) vs_node_release(all[i]);
  vs_store_release(s);
}

static void origins_do_not_count(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  const vs_origin *here = vs_store_origin(s, "a.vs", 3, 4, NULL);
  assert_ptr_equal(here, vs_store_origin(s, "a.vs", 3, 4, NULL));
  assert_ptr_not_equal(here, vs_store_origin(s, "a.vs", 3, 5, NULL));
  vs_node *leaf = sphere(s, 0, 1);
  vs_ref with = { leaf, here }, without = { leaf, NULL };
  vs_node *a = vs_node_new(s, VS_UNION, NULL, &with, 1), *b = vs_node_new(s, VS_UNION, NULL, &without, 1);
  assert_true(vs_node_equal(a, b, NULL));
  vs_node *all[] = { leaf, a, b };
  for (int i = 0; i < 3; i++) vs_node_release(all[i]);
  vs_store_release(s);
}

static void every_kind_has_its_row(void **state) {
  (void)state;
  for (int k = 0; k < VS_KIND_COUNT; k++) {
    const vs_kind_info *info = vs_kind_get((vs_kind)k);
    assert_non_null(info);
    for (size_t i = 0; i < info->field_count; i++) assert_true(info->fields[i].offset < info->size && info->fields[i].name[0]);
  }
  assert_string_equal(vs_kind_get(VS_CUT_CONE)->name, "cut-cone");
  assert_int_equal(vs_kind_get(VS_CUT_CONE)->field_count, 5);
  assert_int_equal(vs_kind_get(VS_CUT_CONE)->fields[4].offset, offsetof(struct vs_cut_cone, segments));
  assert_int_equal(vs_kind_get(VS_REGION)->class_, VS_REGION_CLASS);
  assert_int_equal(vs_kind_get(VS_EMPTY)->field_count, 0);
}

static void two_hundred_thousand_deep(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  size_t before = vs_store_bytes(s), entered = 0, left = 0, deepest = 0, depth;
  vs_node *deep[2];
  for (int k = 0; k < 2; k++) {
    deep[k] = sphere(s, 0, 1);
    for (int i = 0; i < 200000; i++) deep[k] = both(s, VS_UNION, deep[k], sphere(s, i, 1));
    assert_non_null(deep[k]);
  }
  assert_int_equal(deep[0]->depth, 200001);
  assert_true(vs_node_equal(deep[0], deep[1], NULL));
  vs_walk *w = vs_walk_new(s, (vs_ref){ deep[0], NULL });
  vs_ref at;
  for (vs_walk_event ev; (ev = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE;) {
    assert_int_not_equal(ev, VS_WALK_FAILED);
    if (ev == VS_WALK_ENTER) entered++;
    else left++;
    if (depth > deepest) deepest = depth;
  }
  vs_walk_free(w);
  assert_int_equal(entered, 400001);
  assert_int_equal(left, 400001);
  assert_int_equal(deepest, 200000);
  vs_node_release(deep[0]);
  vs_node_release(deep[1]);
  assert_int_equal(vs_store_bytes(s), before);
  vs_store_release(s);
}

/* Tests a graph of 60 nodes with 2^60 paths. The comparison of two such graphs, built separately, must compare each
 * pair of nodes only once. */
static void wide_dags_compare_by_node(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *dag[3];
  for (int k = 0; k < 3; k++) {
    dag[k] = sphere(s, k == 2 ? 9 : 0, 1);
    for (int i = 0; i < 60; i++) dag[k] = both(s, VS_UNION, vs_node_retain(dag[k]), dag[k]);
  }
  assert_true(vs_node_equal(dag[0], dag[1], NULL));
  assert_false(vs_node_equal(dag[0], dag[2], NULL));
  for (int k = 0; k < 3; k++) vs_node_release(dag[k]);
  vs_store_release(s);
}

static void curves_know_whether_they_close(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_vec3 corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
  vs_points *at = vs_points_new(s, corners, 3);
  struct vs_line open = { .points = at }, closed = { .points = at, .closed = true };
  struct vs_extrude up = { .along = { 0, 0, 1 }, .scale = 1 };
  struct vs_transform moved = { .matrix = vs_affine_translation(vs_v3(1, 2, 3)) };
  vs_node *a = vs_node_new(s, VS_LINE, &open, NULL, 0), *b = vs_node_new(s, VS_LINE, &closed, NULL, 0);
  vs_node *c = vs_node_new(s, VS_TRANSFORM, &moved, &(vs_ref){ b, NULL }, 1);
  vs_node *wall = vs_node_new(s, VS_EXTRUDE, &up, &(vs_ref){ a, NULL }, 1), *prism = vs_node_new(s, VS_EXTRUDE, &up, &(vs_ref){ c, NULL }, 1);
  assert_false(a->flags & VS_NODE_CLOSED);
  assert_true(c->flags & VS_NODE_CLOSED);
  assert_int_equal(wall->class_, VS_SURFACE);
  assert_int_equal(prism->class_, VS_SOLID);
  vs_node *all[] = { a, b, c, wall, prism };
  for (int i = 0; i < 5; i++) vs_node_release(all[i]);
  vs_points_release(s, at);
  vs_store_release(s);
}

static void materials_by_name(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  const vs_material *red = vs_store_ready_material(s, "red"), *hex = vs_store_ready_material(s, "#Ff8000");
  assert_true(red->red == 1 && red->green == 0 && red->blue == 0);
  assert_true(hex->red == 1 && hex->green == 128 / 255.0 && hex->blue == 0);
  assert_ptr_equal(red, vs_store_ready_material(s, "Red"));
  assert_true(vs_store_ready_material(s, "glass")->transparency > 0.5);
  assert_null(vs_store_ready_material(s, "no-such-color"));
  assert_null(vs_store_ready_material(s, "#12345"));
  assert_null(vs_store_ready_material(s, "#12345g"));
  vs_store_release(s);
}

static void long_messages_are_cut_at_a_character(void **state) {
  (void)state;
  vs_error e;
  char text[700];
  for (size_t i = 0; i + 3 < sizeof text; i += 2) memcpy(text + i, "\xC3\xA3", 3);
  assert_false(vs_error_set(&e, VS_ERROR_MODEL, NULL, "%s", text));
  assert_int_equal(strlen(e.message), 510);
  assert_false(vs_error_set(&e, VS_ERROR_MODEL, NULL, "x%s", text));
  assert_int_equal(strlen(e.message), 511);
}

/* Tests how a picture's plane on a face depends on the face's direction. The plane differs from the face by at most
 * 11.25 degrees in each direction. The plane's axes are perpendicular. Seen from outside, the first axis points right
 * when the second points up. */
static void pictures_lie_by_directions(void **state) {
  (void)state;
  uint32_t seed = 7;
  for (int i = 0; i < 20000; i++) {
    double n[3], across[3], up[3], length = 0, off = 0, normal = 0, size = 0;
    for (int k = 0; k < 3; k++) n[k] = (double)((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 23) - 1, length += n[k] * n[k];
    if (length < 0.01) continue;
    vs_picture_axes(vs_picture_direction(n[0], n[1], n[2]), across, up);
    for (int k = 0; k < 3; k++) {
      const double out = across[(k + 1) % 3] * up[(k + 2) % 3] - across[(k + 2) % 3] * up[(k + 1) % 3];
      off += across[k] * up[k], normal += out * n[k] / sqrt(length), size += out * out;
    }
    assert_true(fabs(off) < 1e-12 && fabs(size - 1) < 1e-12);
    assert_true(normal > cos(11.3 * 3.14159265358979 / 180) * cos(11.3 * 3.14159265358979 / 180));
  }
  double place[2];
  vs_picture_place(2, 1, 0, vs_picture_direction(0, -1, 0), (double[]){ 1, 7, 0.25 }, place); /* a wall to the south */
  assert_true(fabs(place[0] - 0.5) < 1e-12 && fabs(place[1] - 0.25) < 1e-12);
  vs_picture_place(2, 1, 0, vs_picture_direction(0, 1, 0), (double[]){ 1, 7, 0.25 }, place); /* a wall to the north */
  assert_true(fabs(place[0] + 0.5) < 1e-12 && fabs(place[1] - 0.25) < 1e-12);
  vs_picture_place(2, 1, 90, vs_picture_direction(0, 0, 1), (double[]){ 1, 3, 7 }, place); /* a floor, rotated */
  assert_true(fabs(place[0] - 1.5) < 1e-12 && fabs(place[1] + 1) < 1e-12);
}

/* ---- each allocation of a small task fails in turn; no memory is lost ---- */

typedef struct { size_t held; } ledger;

static void *ledger_alloc(void *context, void *old, size_t old_size, size_t new_size) {
  ledger *l = context;
  if (!new_size) {
    free(old);
    l->held -= old_size;
    return NULL;
  }
  void *p = realloc(old, new_size);
  if (p) l->held += new_size - (old ? old_size : 0);
  return p;
}

static bool small_task(vs_store *s) {
  bool ok = vs_store_origin(s, "f.vs", 1, 1, NULL) && vs_store_ready_material(s, "steel") &&
            vs_store_picture(s, &(vs_picture){ "a.png", "png", (const unsigned char *)"abc", 3, 1, 1, 0, { 0 }, NULL });
  vs_vec3 corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
  vs_points *at = ok ? vs_points_new(s, corners, 3) : NULL;
  struct vs_line data = { .points = at, .closed = true };
  vs_node *line = at ? vs_node_new(s, VS_LINE, &data, NULL, 0) : NULL;
  vs_node *region = line ? vs_node_new(s, VS_REGION, NULL, &(vs_ref){ line, NULL }, 1) : NULL;
  vs_node *pair = region ? both(s, VS_UNION, vs_node_retain(region), sphere(s, 0, 1)) : NULL;
  vs_node *twin = pair ? both(s, VS_UNION, vs_node_new(s, VS_REGION, NULL, &(vs_ref){ line, NULL }, 1), sphere(s, 0, 1)) : NULL;
  bool memory = twin != NULL;
  if (twin) assert_true(vs_node_equal(pair, twin, &memory) || !memory);
  vs_walk *w = memory ? vs_walk_new(s, (vs_ref){ pair, NULL }) : NULL;
  vs_walk_event ev = VS_WALK_FAILED;
  for (vs_ref ref; w && (ev = vs_walk_next(w, &ref, NULL)) < VS_WALK_DONE;) continue;
  vs_walk_free(w);
  vs_node *all[] = { line, region, pair, twin };
  for (int i = 0; i < 4; i++) vs_node_release(all[i]);
  if (at) vs_points_release(s, at);
  return ev == VS_WALK_DONE;
}

static void every_allocation_fails_in_turn(void **state) {
  (void)state;
  bool done = false;
  size_t n = 1;
  for (; !done; n++) {
    ledger l = { 0 };
    vs_store *s = vs_store_new(ledger_alloc, &l);
    vs_store_fail_at(s, n);
    done = small_task(s);
    vs_store_fail_at(s, 0);
    vs_store_release(s);
    assert_int_equal(l.held, 0);
    assert_true(n < 1000);
  }
  assert_true(n > 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(equal_by_value), cmocka_unit_test(origins_do_not_count), cmocka_unit_test(every_kind_has_its_row),
    cmocka_unit_test(two_hundred_thousand_deep), cmocka_unit_test(wide_dags_compare_by_node), cmocka_unit_test(curves_know_whether_they_close),
    cmocka_unit_test(materials_by_name), cmocka_unit_test(pictures_lie_by_directions), cmocka_unit_test(long_messages_are_cut_at_a_character), cmocka_unit_test(every_allocation_fails_in_turn),
  };
  return cmocka_run_group_tests_name("model nodes", tests, NULL, NULL);
}
