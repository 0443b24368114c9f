/* Contains small drawings that the tests of several layers build in C. A parent node takes over the only reference to
 * each child. */
#ifndef VS_TESTS_SCENES_H
#define VS_TESTS_SCENES_H

#include "model/scene.h"

#include "model/looks/ready_materials.h"

typedef struct { vs_store *store; vs_scene scene; } test_model;

static inline test_model *test_model_open(test_model *m) {
  m->store = vs_store_new(NULL, NULL);
  vs_scene_init(&m->scene, m->store);
  m->scene.title = vs_store_text(m->store, "model", 5);
  return m;
}
static inline void test_model_close(test_model *m) {
  vs_scene_free(&m->scene);
  vs_store_release(m->store);
}
/* Returns a node that records `line` as the line of the program that made it. */
static inline vs_ref test_node(test_model *m, uint32_t line, vs_kind kind, const void *data, const vs_ref *children, size_t count) {
  vs_ref made = { vs_node_new(m->store, kind, data, children, count), vs_store_origin(m->store, "house.vs", line, 3, NULL) };
  for (size_t i = 0; i < count; i++) vs_node_release(children[i].node);
  return made;
}
static inline vs_ref test_box(test_model *m, double a, double b, double c, double x, double y, double z) {
  return test_node(m, 1, VS_BOX, &(struct vs_box){ .p = { a, b, c }, .q = { x, y, z } }, NULL, 0);
}
static inline vs_ref test_sphere(test_model *m, double x, double y, double z, double r) {
  return test_node(m, 2, VS_SPHERE, &(struct vs_sphere){ .center = { x, y, z }, .radius = r }, NULL, 0);
}
static inline vs_ref test_cylinder(test_model *m, vs_vec3 base, vs_vec3 top, double r) {
  return test_node(m, 3, VS_CYLINDER, &(struct vs_cylinder){ .base = base, .top = top, .radius = r }, NULL, 0);
}
static inline vs_ref test_move(test_model *m, double x, double y, double z, vs_ref what) {
  return test_node(m, 4, VS_TRANSFORM, &(struct vs_transform){ .matrix = vs_affine_translation(vs_v3(x, y, z)) }, &what, 1);
}
/* Returns a node that gives the object `what` the material `name`. The node's data have the layout of struct
 * vs_material, which this function uses instead of the equally named type of prims.def. */
static inline vs_ref test_paint(test_model *m, const char *name, vs_ref what) {
  struct { vs_field_material material; unsigned char end; } data = { vs_store_ready_material(m->store, name), 0 };
  return test_node(m, 5, VS_MATERIAL, &data, &what, 1);
}
static inline vs_ref test_pair(test_model *m, vs_kind kind, vs_ref a, vs_ref b) {
  vs_ref both[] = { a, b };
  static const unsigned char nothing[8];
  return test_node(m, 6, kind, nothing, both, 2);
}
static inline void test_draw(test_model *m, vs_ref what) {
  vs_scene_draw(&m->scene, what);
  vs_node_release(what.node);
}

/* Returns a sample node of the kind, with children if the kind has any. Two tests use every kind once: the golden file
 * of the tree dump, and the test that reads the dump back. */
static inline vs_ref test_any(test_model *m, vs_kind kind) {
  unsigned char data[256] = { 0 };
  const vs_kind_info *info = vs_kind_get(kind);
  static const vs_vec3 corners[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2.5, 0 }, { 0, 0, 1e-7 } };
  static const uint32_t starts[] = { 0, 3, 6, 9, 12 }, indices[] = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3 };
  vs_points *points = vs_points_new(m->store, corners, 4);
  vs_faces *faces = vs_faces_new(m->store, starts, 4, indices, 12);
  vs_ticket *ticket = vs_ticket_new(m->store, 7);
  for (size_t i = 0; i < info->field_count; i++) {
    void *at = data + info->fields[i].offset;
    double k = 0.25 + (double)i;
    switch (info->fields[i].type) {
    case VS_FIELD_real: *(vs_field_real *)at = k; break;
    case VS_FIELD_integer: *(vs_field_integer *)at = 5; break;
    case VS_FIELD_boolean: *(vs_field_boolean *)at = true; break;
    case VS_FIELD_point: case VS_FIELD_vector: *(vs_vec3 *)at = vs_v3(k, -k / 3, 10 * k); break;
    case VS_FIELD_affine: *(vs_affine *)at = vs_affine_rotation(vs_v3(1, 2, 3), vs_v3(0, 0.6, 0.8), 1); break;
    case VS_FIELD_points: *(vs_field_points *)at = points; break;
    case VS_FIELD_faces: *(vs_field_faces *)at = faces; break;
    case VS_FIELD_text: *(vs_field_text *)at = vs_store_text(m->store, "a \"b\" \\ c", 9); break;
    case VS_FIELD_ticket: *(vs_field_ticket *)at = ticket; break;
    case VS_FIELD_material: *(vs_field_material *)at = vs_store_ready_material(m->store, "flemish-brick"); break;
    }
  }
  vs_ref children[2];
  size_t count = 0;
  if (kind == VS_REGION || kind == VS_EXTRUDE || kind == VS_SWEEP || kind == VS_THICKEN || kind == VS_JOIN || kind == VS_OFFSET)
    children[count++] = test_node(m, 7, VS_CIRCLE, &(struct vs_circle){ .radius = 1 }, NULL, 0);
  else if (info->level >= VS_LEVEL_OPERATION || kind == VS_SECTION || kind == VS_PROJECT || kind == VS_EDGES || kind == VS_DEFORM)
    children[count++] = test_box(m, 0, 0, 0, 1, 1, 1);
  if (kind == VS_UNION || kind == VS_INTERSECTION || kind == VS_DIFFERENCE) children[count++] = test_sphere(m, 0, 0, 0, 0.5);
  if (kind == VS_SWEEP) children[count++] = test_node(m, 8, VS_LINE, &(struct vs_line){ .points = points }, NULL, 0);
  vs_ref made = test_node(m, 9, kind, data, children, count);
  vs_points_release(m->store, points);
  vs_faces_release(m->store, faces);
  vs_ticket_release(m->store, ticket);
  return made;
}

#endif
