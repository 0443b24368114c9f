/* Implements the natives of the scene: matrices, rays, and the drawings of scene nodes.
 *
 * There is one current drawing, to which `draw` adds: that of the node with the focus. When another node gets the
 * focus, drawing_swap returns the objects of the old node's drawing as a list, and replaces them by the objects of the
 * new node. */
#include "bind/scene/node_natives.h"

#include <math.h>
#include <string.h>

#include "bind/call/give.h"
#include "bind/data.h"
#include "bind/functions/function_values.h"
#include "bind/incoming/file_texts.h"
#include "bind/incoming/model_bytes.h"
#include "bind/objects.h"
#include "bind/procedures.h"
#include "bind/records.h"
#include "bind/reserved.h"
#include "bind/scene/ray_hits.h"
#include "bind/state.h"
#include "model/store/nodemap.h"
#include "vm/front/environment.h"
#include "vm/machine/program.h"
#include "vm/machine/record_call.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"
#include "vm/values/table.h"

const vs_native_table *const *vs_nodes_tables(void) {
  static const vs_native_table *const tables[] = { &vs_bind_table, &vs_bind_reserved_table, &vs_bind_data_table,
                                                   &vs_function_table, &vs_incoming_table, &vs_model_bytes_table,
                                                   &vs_node_table, NULL };
  return tables;
}

/* ---- matrices of nodes ---- */

static const double degree = 3.141592653589793 / 180;

static vs_status give_matrix(vs_scheme *vm, const vs_affine *m, vs_value *out) {
  double d[16] = { 0 };
  for (int i = 0; i < 12; i++) d[i] = m->m[i / 4][i % 4];
  d[15] = 1;
  return vs_make_flat(vm, VS_FLAT_MATRIX, d, 16, out);
}

/* (translate rotate scale), three gvectors: returns the matrix that scales, then rotates about X, Y and Z in this
 * order, then moves. */
static vs_status node_matrix(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  const double *t = vs_as_flat(a[0])->at, *r = vs_as_flat(a[1])->at, *s = vs_as_flat(a[2])->at;
  const vs_vec3 origin = vs_v3(0, 0, 0), axis[] = { vs_v3(1, 0, 0), vs_v3(0, 1, 0), vs_v3(0, 0, 1) };
  vs_affine m = vs_affine_scaling(origin, vs_v3(s[0], s[1], s[2])), next;
  for (int i = 0; i < 3; i++) {
    next = vs_affine_rotation(origin, axis[i], fmod(r[i], 360) * degree);
    m = vs_affine_multiply(&next, &m);
  }
  next = vs_affine_translation(vs_v3(t[0], t[1], t[2]));
  m = vs_affine_multiply(&next, &m);
  return give_matrix(vm, &m, out);
}

/* Inverts node_matrix: returns the list (translate rotate scale) from which node_matrix computes this matrix. Returns
 * #f if the columns of the matrix are not perpendicular, or a column is 0. If the matrix mirrors, the scale along X is
 * negative. */
static vs_status matrix_parts(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_affine m = vs_bind_take_matrix(vs_as_flat(a[0])->at);
  *out = VS_FALSE;
  if (vs_affine_determinant(&m) == 0 || !vs_affine_is_placement(&m)) return VS_OK;
  vs_vec3 move, scale, column[3];
  double quaternion[4];
  vs_affine_split(&m, &move, quaternion, &scale);
  const double t[3] = { move.x, move.y, move.z }, s[3] = { scale.x, scale.y, scale.z };
  for (int i = 0; i < 3; i++) column[i] = vs_v3_scale(vs_v3(m.m[0][i], m.m[1][i], m.m[2][i]), 1 / s[i]);
  double flat = hypot(column[0].x, column[0].y), r[3] = { 0, atan2(-column[0].z, flat) / degree, 0 };
  if (flat > 1e-12) {
    r[0] = atan2(column[1].z, column[2].z) / degree;
    r[2] = atan2(column[0].y, column[0].x) / degree;
  } else r[0] = atan2(-column[2].y, column[1].y) / degree; /* X is vertical: rotations about X and about Z have the same
                                                            * effect */
  const double *const parts[3] = { t, r, s };
  VS_ROOTS(vm, root, 2);
  root[0] = VS_NIL;
  for (int i = 3; i-- > 0;)
    if (!vs_make_flat(vm, VS_FLAT_VECTOR, parts[i], 3, &root[1]) || !vs_cons(vm, root[1], root[0], &root[0]))
      return VS_ERROR;
  *out = root[0];
  return VS_OK;
}

/* (matrix point): returns the image of the point under the matrix. */
static vs_status matrix_point(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_affine m = vs_bind_take_matrix(vs_as_flat(a[0])->at);
  const double *d = vs_as_flat(a[1])->at;
  vs_vec3 p = vs_affine_point(&m, vs_v3(d[0], d[1], d[2]));
  const double at[3] = { p.x, p.y, p.z };
  return vs_make_flat(vm, VS_FLAT_POINT, at, 3, out);
}

/* ---- rays that pick objects ---- */

static vs_status fail_ray(vs_scheme *vm, const vs_error *e) {
  if (e->kind == VS_ERROR_INTERRUPT) return VS_ERROR; /* vm->condition is already set */
  if (e->kind == VS_ERROR_MEMORY) return vs_fail_memory(vm);
  return vs_fail(vm, vm->sym.error, "%s", *e->message ? e->message : "the ray's hits cannot be computed");
}

/* (object matrix from direction): intersects a ray with the object, placed by the matrix. Returns #f if the ray misses
 * the object. Otherwise returns (distance file line column) for the nearest intersection, or (distance . #f) if the
 * object's origin is unknown. The distance is a multiple of the length of `direction`. */
static vs_status ray_meets(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_affine m = vs_bind_take_matrix(vs_as_flat(a[1])->at), back;
  const double *p = vs_as_flat(a[2])->at, *d = vs_as_flat(a[3])->at;
  vs_ray_hit hit;
  vs_error e = { 0 };
  *out = VS_FALSE;
  if (!vs_affine_invert(&m, &back)) return VS_OK; /* a matrix that cannot be inverted flattens the object, so that no
                                                   * ray intersects it */
  vs_vec3 from = vs_affine_point(&back, vs_v3(p[0], p[1], p[2]));
  vs_vec3 direction = vs_affine_vector(&back, vs_v3(d[0], d[1], d[2]));
  if (!vs_ray_meets(vm, vs_bind_take_ref(a[0]), from, direction, &hit, &e)) return fail_ray(vm, &e);
  if (hit.at == INFINITY) return VS_OK;
  VS_ROOTS(vm, r, 2);
  r[0] = VS_FALSE;
  if (hit.origin) {
    r[0] = VS_NIL;
    if (!vs_cons(vm, vs_fix(hit.origin->column), r[0], &r[0]) || !vs_cons(vm, vs_fix(hit.origin->line), r[0], &r[0]) ||
        !vs_string_from_utf8(vm, hit.origin->file, strlen(hit.origin->file), &r[1]) || !vs_cons(vm, r[1], r[0], &r[0]))
      return VS_ERROR;
  }
  return vs_cons(vm, vs_flonum(hit.at), r[0], out);
}

/* ---- the drawing of the node with the focus ---- */

static vs_status drawing_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  vs_bind *b = vs_bind_of(vm);
  return vs_bind_give_refs(b, b->scene.drawn, b->scene.drawn_count, out);
}

/* Called before the drawing of the root node is replaced. An object counts as used if the program has drawn the object
 * itself, or all its parts. Marks these objects among the top-level values, so that vs does not warn that they are
 * unused. When memory is out, marks none. */
static void was_shown(vs_bind *b) {
  if (b->returned_count == 0 || b->scene.drawn_count == 0) return;
  vs_nodemap all = { .store = b->store };
  bool known = true;
  for (size_t i = 0; known && i < b->scene.drawn_count; i++)
    known = vs_nodemap_put(&all, b->scene.drawn[i].node, NULL) != NULL;
  for (size_t i = 0; known && i < b->returned_count; i++) {
    const vs_node *n = b->returned[i].node;
    bool parts = n->kind == VS_UNION; /* parts: whether n is a union, because (draw a list) draws the parts and returns
                                       * their union */
    for (uint32_t k = 0; parts && k < n->child_count; k++) parts = vs_nodemap_get(&all, n->children[k].node) != NULL;
    if (parts || vs_nodemap_get(&all, n)) b->returned[i].shown = true;
  }
  vs_nodemap_free(&all);
}

/* (objects away): replaces the current drawing by a list of objects, and returns the old drawing. away: whether the new
 * drawing belongs to a node other than the root. */
static vs_status drawing_swap(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_bind *b = vs_bind_of(vm);
  VS_ROOTS(vm, r, 1);
  if (!drawing_list(vm, a, n, &r[0])) return VS_ERROR;
  size_t before = b->scene.drawn_count, kept = 0;
  if (!b->away && a[1] == VS_FALSE) was_shown(b);
  for (vs_value l = a[0]; vs_is_pair(l); l = vs_cdr(l)) /* adds the new objects after the old ones, so that the old ones
                                                         * remain if adding fails */
    if (!vs_scene_draw(&b->scene, vs_bind_take_ref(vs_car(l)))) {
      while (b->scene.drawn_count > before) vs_node_release(b->scene.drawn[--b->scene.drawn_count].node);
      return vs_fail_memory(vm);
    }
  for (size_t i = 0; i < b->scene.drawn_count; i++)
    if (i < before) vs_node_release(b->scene.drawn[i].node);
    else b->scene.drawn[kept++] = b->scene.drawn[i];
  b->scene.drawn_count = kept;
  if (b->drawn_last) b->drawn_away = b->drawn_last;
  b->drawn_last = NULL;
  b->away = a[1] != VS_FALSE;
  b->drew = b->drew || (!b->away && kept > 0); /* node-setdrawing can set the root node's drawing without a call of
                                                * draw */
  *out = r[0];
  return VS_OK;
}

/* ---- starting new programs ---- */

static vs_status new_program(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  return vs_program_new(vm, out);
}

/* (environment name): returns #t if the program itself, and not the library, has defined the name. */
static vs_status program_defines(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  vs_meaning m = vs_environment_find(a[0], a[1]);
  *out = vs_bool(m.kind == VS_MEANS_CELL && !m.foreign && vs_as_cell(m.value)->value != VS_UNDEFINED);
  return VS_OK;
}

/* ---- calling the host's procedures ---- */

static vs_status host_call(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_bind *b = vs_bind_of(vm);
  if (!b->host_call) return vs_fail(vm, vm->sym.error, "there is no host");
  return b->host_call(vm, a, n, out);
}

/* ---- passing the scene to the session ---- */

enum { HOST_SCENE = 4 }; /* index in at.host where nodes.scm stores its procedure when the first node is created */

bool vs_nodes_are_there(const vs_bind *b) {
  vs_value host = b->vm->at.host;
  return vs_is_vector(host) && vs_as_vector(host)->at[HOST_SCENE] != VS_FALSE;
}

/* Reads a field of v by an accessor of nodes.scm, without starting the interpreter's run loop. Returns false if v is no
 * record of the accessor's type. */
static bool read_field(vs_scheme *vm, const char *accessor, vs_value v, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  if (!vs_intern_c(vm, accessor, &r[0])) return false;
  r[0] = vs_environment_value(vm->at.core, r[0]);
  int64_t fuel = vm->fuel;
  vm->fuel = 2; /* fuel for one call outside of the run loop */
  vs_value arguments[2] = { v, VS_UNSPECIFIC }; /* the second argument is used only by a modifier */
  bool ok = vs_is(r[0], VS_T_CLOSURE) && vs_record_call(vm, r[0], arguments, 1, out);
  vm->fuel = fuel;
  return ok;
}

bool vs_node_read(vs_scheme *vm, vs_value v, vs_node_part part, vs_value *out) {
  static const char *const accessors[] = { [VS_NODE_NAME] = "%node-name", [VS_NODE_PARENT] = "%node-parent",
                                           [VS_NODE_CHILDREN] = "%node-children" };
  VS_ROOTS(vm, r, 3); /* roots of the garbage collector: the value of the part, the list, a child */
  vs_value of;
  *out = VS_FALSE;
  if (!read_field(vm, accessors[part], v, &r[0])) return false;
  if (part == VS_NODE_CHILDREN) {
    r[1] = VS_NIL;
    for (uint32_t at = 0; vs_table_next(r[0], &at, &r[2], &of);)
      if (!vs_cons(vm, r[2], r[1], &r[1])) return false;
    for (r[0] = VS_NIL; vs_is_pair(r[1]); r[1] = vs_cdr(r[1]))
      if (!vs_cons(vm, vs_car(r[1]), r[0], &r[0])) return false;
  }
  *out = r[0];
  return true;
}

bool vs_nodes_shown(vs_bind *b, bool *beside, vs_value *list) {
  vs_scheme *vm = b->vm;
  VS_ROOTS(vm, r, 1);
  if (!vs_run(vm, vs_as_vector(vm->at.host)->at[HOST_SCENE], 0, NULL, &r[0])) return false;
  *beside = vs_car(r[0]) != VS_FALSE;
  *list = vs_cdr(r[0]);
  return true;
}

static const vs_native_def defs[] = {
  { "%node-matrix", "translate rotate scale", node_matrix, 0, NULL },
  { "%matrix-parts", "matrix", matrix_parts, 0, NULL },
  { "%matrix-point", "matrix point", matrix_point, 0, NULL },
  { "%ray-meets", "object matrix from direction", ray_meets, 0, NULL },
  { "%new-program", "", new_program, 0, NULL },
  { "%program-defines?", "environment name", program_defines, 0, NULL },
  { "%host-call", "number . arguments", host_call, 0, NULL },
  { "%drawing-list", "", drawing_list, 0, NULL },
  { "%drawing-swap!", "objects away", drawing_swap, 0, NULL },
  { 0 },
};
const vs_native_table vs_node_table = { "node", defs };
