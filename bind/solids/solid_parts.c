/* Implements the natives for the parts of solids: the connected parts of several solids, and the space on one side of a
 * surface. */
#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/context.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/mesh_distance.h"
#include "geometry/measure/mesh_parts.h"
#include "geometry/measure/node_measures.h"
#include "geometry/nets/mesh_edges.h"
#include "geometry/plane/plane.h"
#include "geometry/shapes/simple_nodes.h"
#include "model/store/array.h"
#include "solids/solid_meshes.h"

/* Sets *mine to an array that says which parts have faces of which of the `count` pieces: (*mine)[part * count +
 * piece]. */
static bool mark(const vs_solid *solid, const vs_mesh_parts *parts, size_t count, bool **mine) {
  *mine = vs_zeros((size_t)parts->count * count, sizeof **mine);
  for (size_t t = 0; *mine && t < solid->mesh.triangle_count; t++) {
    uint32_t object = solid->parts[solid->mesh.tags[t]].object;
    if (object >= 1 && object <= count) (*mine)[parts->of[t] * count + object - 1] = true;
  }
  return *mine != NULL;
}

/* Sets *out to a pair for one part: the list (piece-number ...) of the pieces in it, and the part as a mesh. */
static bool describe(vs_args *f, const vs_solid *solid, const vs_mesh_parts *parts, uint32_t part, const bool *mine,
                     size_t count, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 };
  VS_ROOTS(vm, r, 2);
  r[0] = r[1] = VS_NIL;
  for (size_t i = count; i-- > 0;)
    if (mine[i] && !vs_cons(vm, vs_fix((int64_t)i), r[0], &r[0])) return false;
  if (!vs_mesh_parts_copy(&solid->mesh, parts, part, &m)) return vs_fail_memory(vm);
  vs_node *n = vs_node_of_mesh(vs_call_store(f), &m, true);
  vs_mesh_free(&m);
  if (!n) return vs_fail_memory(vm);
  return vs_bind_give_node(f, n, &r[1]) && vs_cons(vm, r[0], r[1], out);
}

/* (%solid-parts pieces): returns a list of the parts of the pieces' union that do not touch each other. Each is a pair:
 * the list of the numbers (from 0) of the pieces in it, and a mesh. A piece without a face of its own in the union is
 * in no list. */
vs_status vs_p_solid_parts(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_refs refs = { vs_arg_refs(f, 0).at, vs_arg_refs(f, 0).count };
  vs_solid solid = { 0 };
  vs_mesh_parts parts = { 0 };
  vs_error e = { 0 };
  bool *mine = NULL;
  vs_bounds all = vs_bounds_empty(), b;
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = 0; i < refs.count; i++) {
    if (refs.at[i].node->flags & VS_NODE_ENDLESS)
      return vs_fail(vm, vm->sym.range, "%s", VS_ENDLESS_MESSAGE);
    if (vs_node_bounds(refs.at[i].node, &b, NULL)) vs_bounds_unite(&all, &b);
  }
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  if (!(facets.tolerance > 0)) facets.tolerance = fmax(vs_fineness_tolerance(&all) / 4, 1e-300);
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  if (!vs_solid_of_objects(&refs, 0, &facets, &options, &solid, &e))
    return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(vm, &e);
  bool ok = (vs_mesh_parts_find(&solid.mesh, &parts) && mark(&solid, &parts, refs.count, &mine)) ||
            vs_fail_memory(vm);
  for (uint32_t p = parts.count; ok && p-- > 0;)
    ok = describe(f, &solid, &parts, p, mine + p * refs.count, refs.count, &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  free(mine);
  vs_mesh_parts_free(&parts);
  vs_solid_free(&solid);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- surfaces that split solids ---- */

/* Adds to the surface m a copy that is moved by `way`, and walls between the borders of the two. m then bounds the
 * space between them. The surface's own triangles are turned to face against `way`. */
static bool thick(vs_mesh *m, const vs_mesh_edges *edges, vs_vec3 way) {
  size_t triangles = m->triangle_count, vertices = m->vertex_count;
  bool ok = vs_mesh_reserve(m, 2 * vertices, 2 * triangles);
  for (size_t i = 0; ok && i < vertices; i++) ok = vs_mesh_add_vertex(m, vs_v3_add(m->vertices[i], way), NULL);
  for (size_t t = 0; ok && t < triangles; t++) {
    const uint32_t *c = m->triangles[t], n = (uint32_t)vertices;
    ok = vs_mesh_add_triangle(m, c[0] + n, c[1] + n, c[2] + n);
  }
  for (size_t t = 0; ok && t < triangles; t++)
    for (int k = 0; ok && k < 3; k++) {
      const vs_mesh_edge *g = &edges->edges[edges->of[t][k]];
      const uint32_t *c = m->triangles[t];
      if (g->side[0] != VS_MESH_NONE && g->side[1] != VS_MESH_NONE) continue;
      uint32_t a = c[(k + 1) % 3], b = c[(k + 2) % 3], n = (uint32_t)vertices;
      ok = vs_mesh_add_triangle(m, a, b, b + n) && vs_mesh_add_triangle(m, a, b + n, a + n);
    }
  for (size_t t = 0; ok && t < triangles; t++) {
    uint32_t *c = m->triangles[t], k = c[1];
    c[1] = c[2], c[2] = k;
  }
  return ok;
}

/* Returns true if the surface's border intersects the solid, and sets *at to a point of the border inside the solid. */
static bool ends_inside(const vs_mesh_edges *edges, const vs_mesh *solid, double slack, vs_vec3 *at, bool *memory) {
  vs_mesh_distance *d = vs_mesh_distance_new(solid);
  bool found = false;
  *memory = d == NULL;
  for (size_t e = 0; d && !found && e < edges->edge_count; e++) {
    const vs_mesh_edge *g = &edges->edges[e];
    if (g->side[0] != VS_MESH_NONE && g->side[1] != VS_MESH_NONE) continue;
    vs_vec3 p = edges->m->vertices[g->a], q = edges->m->vertices[g->b];
    for (int k = 0; !found && k < 4; k++) {
      *at = vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), k / 4.));
      found = vs_mesh_distance_at(d, *at, NULL) < -slack;
    }
  }
  vs_mesh_distance_free(d);
  return found;
}

/* (%split surface solid): returns the solid between the surface and its copy, which is moved along the surface's normal
 * until it is beyond `solid`. */
vs_status vs_p_split(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 }, solid = { 0 };
  vs_mesh_edges edges = { 0 };
  vs_vec3 at = { 0, 0, 0 }, sum = { 0, 0, 0 };
  bool memory = false, ok;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0) || !vs_bind_finite(f, 1) || !vs_bind_resolve(f, 1))
    return VS_ERROR;
  ok = vs_bend_triangles(vm, vs_arg_ref(f, 0), &m) && vs_bend_triangles(vm, vs_arg_ref(f, 1), &solid);
  vs_bounds all = vs_mesh_bounds(&m), b = vs_mesh_bounds(&solid);
  vs_bounds_unite(&all, &b);
  double size = vs_bounds_diagonal(&all);
  for (size_t t = 0; t < m.triangle_count; t++) {
    const vs_vec3 *v = m.vertices;
    const uint32_t *c = m.triangles[t];
    sum = vs_v3_add(sum, vs_v3_cross(vs_v3_sub(v[c[1]], v[c[0]]), vs_v3_sub(v[c[2]], v[c[0]])));
  }
  vs_vec3 way = vs_v3_scale(vs_v3_unit(sum), 2 * size);
  for (size_t t = 0; ok && t < m.triangle_count; t++) {
    const vs_vec3 *v = m.vertices;
    const uint32_t *c = m.triangles[t];
    vs_vec3 n = vs_v3_cross(vs_v3_sub(v[c[1]], v[c[0]]), vs_v3_sub(v[c[2]], v[c[0]]));
    if (vs_v3_length(n) > 0 && !(vs_v3_dot(vs_v3_unit(n), vs_v3_unit(sum)) > 1e-6))
      ok = vs_fail(vm, vm->sym.range, "the tool folds back: no direction crosses all of it from one side; give a "
                                            "flatter surface, or a solid");
  }
  ok = ok && (vs_mesh_edges_make(&edges, &m) || vs_fail_memory(vm));
  if (ok && ends_inside(&edges, &solid, 1e-9 * size, &at, &memory)) {
    char x[32], y[32], z[32];
    vs_bind_number_text(x, at.x), vs_bind_number_text(y, at.y), vs_bind_number_text(z, at.z);
    ok = vs_fail(vm, vm->sym.range, "the tool must cross o: its border lies in o at (xyz %s %s %s)", x, y, z);
  }
  if (ok && memory) ok = vs_fail_memory(vm);
  ok = ok && (thick(&m, &edges, way) || vs_fail_memory(vm));
  vs_mesh_edges_free(&edges);
  ok = ok && vs_bind_give_node(f, vs_node_of_mesh(vs_call_store(f), &m, true), out);
  vs_mesh_free(&m), vs_mesh_free(&solid);
  return ok ? VS_OK : VS_ERROR;
}

/* (%region-normal region): returns the unit normal of the region's plane. */
vs_status vs_p_region_normal(vs_args *f, vs_value *out) {
  vs_shape_plane plane;
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  if (vs_node_plane(vs_arg_ref(f, 0).node, &plane) != VS_PLANE_ONE)
    return vs_bind_refuse(f, "region", "in one plane", vs_arg_value(f, 0));
  return vs_bind_give_vector(f, vs_v3_unit(plane.normal), out);
}
