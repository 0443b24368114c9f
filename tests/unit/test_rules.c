/* Tests the C part of the language GML's rules: scopes, their flags and paths, and objects deformed by hexahedra. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "bind/rules/scope.h"
#include "geometry/measure/node_measures.h"
#include "solids/deformed.h"

enum { DEEP = 200000 };

static vs_scope *box(vs_store *s, double x, double y, double z) {
  vs_scope *b = vs_scope_fresh(s, VS_SCOPE_BOX);
  assert_non_null(b);
  b->as.box.frame = vs_affine_columns(vs_v3(1, 0, 0), vs_v3(0, 0, 1), vs_v3(0, -1, 0), vs_v3(0, 0, 0));
  b->as.box.size = vs_v3(x, y, z);
  return b;
}

static void one_deep_path(vs_store *s) {
  vs_scope *last = box(s, 1, 2, 3);
  for (int i = 0; i < DEEP; i++) {
    vs_scope *child = vs_scope_copy(last);
    assert_non_null(child);
    vs_scope_release(child->parent);
    child->parent = last, child->depth = last->depth + 1;
    child->op = vs_store_text(s, "split", 5), child->index = (uint32_t)i;
    last = child;
  }
  char text[300];
  vs_scope_path_text(last, text, sizeof text);
  assert_true(strlen(text) < sizeof text);
  assert_non_null(strstr(text, "split.199999"));
  vs_scope_release(last);
}

/* A path of any depth must be freed without recursion, and later paths use the freed memory. */
static void deep_paths(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  one_deep_path(s);
  size_t held = vs_store_bytes(s);
  one_deep_path(s);
  assert_int_equal(vs_store_bytes(s), held);
  vs_store_release(s);
}

static void flags_of_scopes(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  const char *door = vs_store_text(s, "door", 4), *corner = vs_store_text(s, "corner", 6), *top = vs_store_text(s, "top", 3);
  vs_scope *a = box(s, 1, 1, 1), *b = vs_scope_copy(a);
  assert_true(vs_scope_add_flags(b, (const char *const[]){ door, corner, door }, 3));
  vs_scope *c = vs_scope_copy(b);
  assert_true(vs_scope_add_flags(c, &top, 1));
  assert_true(vs_scope_has_flag(b, door) && vs_scope_has_flag(b, corner) && !vs_scope_has_flag(b, top));
  assert_true(vs_scope_has_flag(c, door) && vs_scope_has_flag(c, corner) && vs_scope_has_flag(c, top));
  assert_false(vs_scope_has_flag(a, door));
  vs_scope_release(c), vs_scope_release(b), vs_scope_release(a);
  vs_store_release(s);
}

static void corners_and_loops(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_scope *b = box(s, 4, 3, 2);
  vs_vec3 p = vs_scope_corner(b, 1, 1, 1);
  assert_true(p.x == 4 && p.y == -2 && p.z == 3);
  vs_scope_release(b);
  /* the scope of a triangle in an oblique plane: its x axis is the first edge, and its size is that of the bounding
   * box */
  const vs_vec3 at[3] = { { 0, 0, 0 }, { 3, 0, 4 }, { 0, 2, 0 } };
  vs_scope *t = vs_scope_fresh(s, VS_SCOPE_TRIANGLE);
  t->loops = vs_scope_loops_new(s, at, (const uint32_t[]){ 0, 3 }, 1);
  assert_true(t->loops && vs_scope_frame_loops(t));
  vs_vec3 size = vs_scope_size(t);
  assert_true(fabs(size.x - 5) < 1e-12 && fabs(size.y - 2) < 1e-12 && size.z == 0);
  vs_scope_release(t);
  const vs_vec3 line[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  t = vs_scope_fresh(s, VS_SCOPE_TRIANGLE);
  t->loops = vs_scope_loops_new(s, line, (const uint32_t[]){ 0, 3 }, 1);
  assert_false(vs_scope_frame_loops(t));
  vs_scope_release(t);
  vs_store_release(s);
}

static struct vs_deform moved(struct vs_deform d, const vs_affine *m) {
  vs_vec3 *const corner[8] = { &d.c000, &d.c100, &d.c010, &d.c110, &d.c001, &d.c101, &d.c011, &d.c111 };
  for (int i = 0; i < 8; i++) *corner[i] = vs_affine_point(m, *corner[i]);
  return d;
}

static const struct vs_deform frustum = {
  .c000 = { -2, -2, 0 }, .c100 = { 2, -2, 0 }, .c010 = { -2, 2, 0 }, .c110 = { 2, 2, 0 },
  .c001 = { -1, -1, 3 }, .c101 = { 1, -1, 3 }, .c011 = { -1, 1, 3 }, .c111 = { 1, 1, 3 } };

/* Returns the volume of the node `placed`, a mesh with a placement. Sets *mesh to the mesh node. */
static double volume_below(const vs_node *placed, const vs_node **mesh) {
  assert_int_equal(placed->kind, VS_TRANSFORM);
  *mesh = placed->children[0].node;
  vs_fineness f = { 0.01, 0 };
  vs_error e = { 0 };
  vs_solid solid = { 0 };
  vs_kernel_options options = { 0 };
  vs_ref ref = { (vs_node *)(uintptr_t)placed, NULL };
  assert_true(vs_solid_evaluate(&ref, 1, &f, &options, &solid, &e));
  double volume = vs_mesh_volume(&solid.mesh);
  assert_true(vs_mesh_closed(&solid.mesh, NULL));
  vs_solid_free(&solid);
  return volume;
}

static void deformed_objects(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_fineness facets = { 0.01, 0 };
  vs_kernel_options options = { 0 };
  vs_error e = { 0 };
  struct vs_box unit = { .p = { 0, 0, 0 }, .q = { 1, 1, 1 } };
  vs_ref cube = { vs_node_new(s, VS_BOX, &unit, NULL, 0), NULL };
  vs_deformer *d = vs_deformer_new(s, &facets, &options);
  const vs_node *mesh[3];
  /* a hexahedron, the same hexahedron elsewhere, and a rotated copy share one mesh, whose volume is that of a
   * frustum */
  vs_affine away = vs_affine_translation(vs_v3(7, -3, 100));
  vs_affine turn = vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(1, 1, 0), 0.7);
  const struct vs_deform shape[3] = { frustum, moved(frustum, &away), moved(frustum, &turn) };
  vs_node *made[3];
  for (int i = 0; i < 3; i++) {
    made[i] = vs_deformer_apply(d, &shape[i], cube, &e);
    assert_non_null(made[i]);
    assert_true(fabs(volume_below(made[i], &mesh[i]) - 28) < 1e-6);
  }
  assert_ptr_equal(mesh[0], mesh[1]);
  assert_ptr_equal(mesh[0], mesh[2]);
  /* the mesh of a mirrored copy also faces outwards */
  vs_affine mirror = vs_affine_mirror(vs_v3(0, 0, 0), vs_v3(1, 0, 0));
  struct vs_deform other = moved(frustum, &mirror);
  vs_node *turned = vs_deformer_apply(d, &other, cube, &e);
  assert_true(fabs(volume_below(turned, &mesh[1]) - 28) < 1e-6);
  /* if the hexahedron is a parallelepiped, the result is the object itself with a placement, not a mesh */
  struct vs_deform slanting = frustum;
  slanting.c001 = vs_v3(-1, -2, 3), slanting.c101 = vs_v3(3, -2, 3);
  slanting.c011 = vs_v3(-1, 2, 3), slanting.c111 = vs_v3(3, 2, 3);
  vs_node *placed = vs_deformer_apply(d, &slanting, cube, &e);
  assert_int_equal(placed->kind, VS_TRANSFORM);
  assert_ptr_equal(placed->children[0].node, cube.node);
  for (int i = 0; i < 3; i++) vs_node_release(made[i]);
  vs_node_release(turned), vs_node_release(placed);
  vs_deformer_free(d);
  /* the bounds of the deformed object contain the hexahedron's corners */
  vs_bounds b;
  vs_node *n = vs_node_new(s, VS_DEFORM, &frustum, &cube, 1);
  assert_true(n->class_ == VS_SOLID && n->flags & VS_NODE_UNRESOLVED);
  assert_true(vs_node_bounds(n, &b, &e) && b.min.x == -2 && b.max.y == 2 && b.max.z == 3);
  vs_node_release(n), vs_node_release(cube.node);
  vs_store_release(s);
}

/* Tests that deformed objects keep the innermost paint and layer, and their origin in the program. */
static void leaves_keep_their_looks(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_fineness facets = { 0.01, 0 };
  vs_kernel_options options = { 0 };
  vs_error e = { 0 };
  struct vs_box unit = { .p = { 0, 0, 0 }, .q = { 1, 1, 1 } };
  const vs_origin *here = (const vs_origin *)(const void *)&unit; /* an address that is passed on as an origin, but
                                                                   * never dereferenced */
  vs_ref at = { vs_node_new(s, VS_BOX, &unit, NULL, 0), here };
  for (int i = 0; i < 12; i++) {
    struct vs_layer layer = { .name = vs_store_text(s, i ? "outer" : "inner", 5) };
    vs_node *n = vs_node_new(s, VS_LAYER, &layer, &at, 1);
    vs_node_release(at.node);
    at = (vs_ref){ n, NULL };
  }
  vs_bend_leaves leaves;
  assert_true(vs_take_apart(at, &facets, &options, NULL, &leaves, &e));
  assert_int_equal(leaves.count, 1);
  assert_ptr_equal(leaves.at[0].origin, here);
  assert_int_equal(leaves.at[0].look_count, 1);
  assert_string_equal(VS_AS(layer, leaves.at[0].looks[0])->name, "inner");
  vs_bend_drop(&leaves);
  vs_node_release(at.node);
  vs_store_release(s);
}

/* Each allocation of the store fails once. The result must be an error or complete, and no memory may be lost. */
static void refused_memory(void **state) {
  (void)state;
  vs_fineness facets = { 0.01, 0 };
  vs_kernel_options options = { 0 };
  bool whole = false;
  for (size_t k = 1; k < 200 && !whole; k++) {
    vs_store *s = vs_store_new(NULL, NULL);
    struct vs_box unit = { .p = { 0, 0, 0 }, .q = { 1, 1, 1 } };
    vs_ref cube = { vs_node_new(s, VS_BOX, &unit, NULL, 0), NULL };
    vs_error e = { 0 };
    vs_deformer *d = vs_deformer_new(s, &facets, &options);
    vs_store_fail_at(s, k);
    vs_node *n = vs_deformer_apply(d, &frustum, cube, &e);
    vs_store_fail_at(s, 0);
    assert_true(n != NULL || e.kind == VS_ERROR_MEMORY);
    whole = n != NULL;
    vs_node_release(n);
    vs_deformer_free(d);
    vs_node_release(cube.node);
    vs_store_release(s);
  }
  assert_true(whole);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(deep_paths),       cmocka_unit_test(flags_of_scopes),         cmocka_unit_test(corners_and_loops),
    cmocka_unit_test(deformed_objects), cmocka_unit_test(leaves_keep_their_looks), cmocka_unit_test(refused_memory),
  };
  return cmocka_run_group_tests_name("rules", tests, NULL, NULL);
}
