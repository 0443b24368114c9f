/* Implements the native that finds a solid's faces and edges for edges.scm. */
#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/context.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/moved_faces.h"
#include "geometry/shapes/simple_nodes.h"
#include "model/store/array.h"
#include "solids/faced_solid.h"

static vs_status find(vs_args *f, vs_faced_solid *s) {
  vs_scheme *vm = vs_call_vm(f);
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  if (vs_faced_solid_find(vs_arg_ref(f, 0), &facets, &options, s, &e)) return VS_OK;
  return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(vm, &e);
}

/* Sets *out to a surface that consists of the triangles of one face. */
static vs_status surface_of(vs_args *f, const vs_faced_solid *s, uint32_t face, vs_value *out) {
  vs_mesh m = { 0 };
  uint32_t *name = NULL;
  const vs_mesh *all = &s->solid.mesh;
  bool ok = VS_FRESH(name, all->vertex_count + 1);
  for (size_t v = 0; ok && v < all->vertex_count; v++) name[v] = UINT32_MAX;
  for (uint32_t t = 0; ok && t < all->triangle_count; t++) {
    uint32_t c[3];
    if (s->faces.of[t] != face) continue;
    for (int k = 0; ok && k < 3; k++) {
      uint32_t v = vs_mesh_edges_corner(&s->edges, t, k);
      if (name[v] == UINT32_MAX) ok = vs_mesh_add_vertex(&m, all->vertices[v], &name[v]);
      c[k] = name[v];
    }
    ok = ok && vs_mesh_add_triangle(&m, c[0], c[1], c[2]);
  }
  free(name);
  vs_node *n = ok ? vs_node_of_mesh(vs_call_store(f), &m, false) : NULL;
  vs_mesh_free(&m);
  return n ? vs_bind_give_node(f, n, out) : vs_fail_memory(vs_call_vm(f));
}

/* Sets *out to the list of the n values in `items`. */
static bool list_of(vs_args *f, const vs_value *items, size_t n, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  for (size_t i = n; i-- > 0;)
    if (!vs_cons(vm, items[i], r[0], &r[0])) return false;
  *out = r[0];
  return true;
}

/* Sets *out to the description of a face: (form area normal point radius surface object). object: the primitive to
 * which the face belongs. */
static bool give_face(vs_args *f, const vs_faced_solid *s, uint32_t face, vs_value *out) {
  const vs_mesh_face *g = &s->faces.faces[face];
  VS_ROOTS(vs_call_vm(f), r, 7);
  vs_ref leaf = s->solid.parts[s->solid.mesh.tags[g->first]].leaf;
  r[0] = vs_fix((int64_t)g->form), r[1] = vs_flonum(g->area), r[4] = vs_flonum(g->radius), r[6] = VS_FALSE;
  return vs_bind_give_vector(f, g->normal, &r[2]) && vs_bind_give_point(f, g->at, &r[3]) &&
         surface_of(f, s, face, &r[5]) && (!leaf.node || vs_bind_give_ref(vs_call_bind(f), leaf, &r[6])) &&
         list_of(f, r, 7, out);
}

/* Sets *out to the description of edge i: (face face closed? angle point ...). */
static bool give_edge(vs_args *f, const vs_faced_solid *s, size_t i, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_face_edge *g = &s->faces.edges[i];
  VS_ROOTS(vm, r, 5);
  r[4] = VS_NIL;
  for (size_t k = g->count; k-- > 0;)
    if (!vs_bind_give_point(f, s->faces.at[g->first + k], &r[0]) || !vs_cons(vm, r[0], r[4], &r[4])) return false;
  r[0] = vs_fix((int64_t)g->face[0]), r[1] = vs_fix((int64_t)g->face[1]);
  r[2] = g->closed ? VS_TRUE : VS_FALSE, r[3] = vs_flonum(g->angle);
  for (int k = 4; k-- > 0;)
    if (!vs_cons(vm, r[k], r[4], &r[4])) return false;
  *out = r[4];
  return true;
}

/* (%solid-faces o): returns a pair: the list of the solid's faces, and the list of its edges. */
vs_status vs_p_solid_faces(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_faced_solid s = { 0 };
  VS_ROOTS(vm, r, 3);
  r[0] = r[1] = VS_NIL;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  bool ok = vs_arg_ref(f, 0).node->kind == VS_EMPTY || find(f, &s);
  for (uint32_t i = (uint32_t)s.faces.face_count; ok && i-- > 0;)
    ok = give_face(f, &s, i, &r[2]) && vs_cons(vm, r[2], r[0], &r[0]);
  for (size_t i = s.faces.edge_count; ok && i-- > 0;)
    ok = give_edge(f, &s, i, &r[2]) && vs_cons(vm, r[2], r[1], &r[1]) && vs_poll(vm, 8);
  vs_faced_solid_free(&s);
  return ok && vs_cons(vm, r[0], r[1], out) ? VS_OK : VS_ERROR;
}

/* (%edges-along axis): returns the unit gvector along the axis, for edges.scm. */
vs_status vs_p_edges_along(vs_args *f, vs_value *out) {
  return vs_bind_give_vector(f, vs_v3_unit(vs_arg_line(f, 0).direction), out);
}

/* (%faces-towards v): returns the unit gvector in the direction v, for edges.scm. */
vs_status vs_p_faces_towards(vs_args *f, vs_value *out) {
  return vs_bind_give_vector(f, vs_v3_unit(vs_arg_point(f, 0)), out);
}

/* ---- moving faces of a solid ---- */

/* Returns the coordinates of a point or gvector. */
static vs_vec3 place_of(vs_value v) {
  const double *d = vs_as_flat(v)->at;
  return vs_v3(d[0], d[1], d[2]);
}

/* Sets *out to the moves of the faces from argument 1: for each face a number (a distance), or a list of a point and a
 * normal (its new plane). */
static vs_status take_moves(vs_args *f, const vs_faced_solid *s, vs_face_move **out) {
  size_t n = s->faces.face_count, i = 0;
  vs_face_move *m = vs_bind_scratch(f, (n + 1) * sizeof *m);
  if (!m) return VS_ERROR;
  for (vs_value l = vs_arg_value(f, 1); i < n && vs_is_pair(l); l = vs_cdr(l), i++) {
    vs_value v = vs_car(l);
    m[i] = (vs_face_move){ .tilted = vs_is_pair(v) };
    if (m[i].tilted) {
      m[i].at = place_of(vs_car(v));
      m[i].normal = vs_v3_unit(place_of(vs_car(vs_cdr(v))));
    } else if (!vs_bind_take_number(vs_call_vm(f), v, &m[i].distance)) break;
  }
  *out = m;
  return i == n ? VS_OK : vs_bind_refuse(f, "moves", "a list of one move for each face", vs_arg_value(f, 1));
}

/* (%move-faces o moves): returns the solid with its faces moved. If a move fails, returns a list of the place of the
 * failure, and #t if a face would be turned over there, or #f if faces do not intersect there. */
vs_status vs_p_move_faces(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_faced_solid s = { 0 };
  vs_face_move *moves = NULL;
  vs_mesh m = { 0 };
  vs_vec3 at = { 0, 0, 0 };
  VS_ROOTS(vm, r, 2);
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  bool ok = find(f, &s) && take_moves(f, &s, &moves) && (vs_mesh_copy(&s.solid.mesh, &m) || vs_fail_memory(vm));
  vs_moved_outcome outcome = ok ? vs_faces_move(&s.edges, &s.faces, moves, &m, &at) : VS_MOVED_MEMORY;
  if (ok && outcome == VS_MOVED_MEMORY) ok = vs_fail_memory(vm);
  if (ok && outcome == VS_MOVED) {
    m.settled = false;
    ok = vs_bend_solid(vm, &m) && vs_bind_give_node(f, vs_node_of_mesh(vs_call_store(f), &m, true), out);
  } else if (ok) {
    r[0] = outcome == VS_MOVED_TURNED ? VS_TRUE : VS_FALSE;
    ok = vs_bind_give_point(f, at, &r[1]) && vs_cons(vm, r[0], VS_NIL, &r[0]) && vs_cons(vm, r[1], r[0], out);
  }
  vs_mesh_free(&m);
  vs_faced_solid_free(&s);
  return ok ? VS_OK : VS_ERROR;
}

/* (%do-draft plane): returns a list of a point of the plane and its unit normal, for edges.scm. */
vs_status vs_p_do_draft(vs_args *f, vs_value *out) {
  VS_ROOTS(vs_call_vm(f), r, 2);
  bool ok = vs_bind_give_point(f, vs_arg_line(f, 0).at, &r[0]) &&
            vs_bind_give_vector(f, vs_v3_unit(vs_arg_line(f, 0).direction), &r[1]) && list_of(f, r, 2, out);
  return ok ? VS_OK : VS_ERROR;
}
