/* Implements land: a surface through surveyed points and along given lines (breaklines), and the solid under a
 * surface. */

#include <math.h>
#include <stdlib.h>

#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/nets/mesh_edges.h"
#include "geometry/plane/breaklines.h"

/* Sets *out to a pair: a list of points, and a list of faces, each a list of indices of points, counted from 1. */
static vs_status points_and_faces(vs_args *f, const vs_mesh *m, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 3);
  r[0] = r[1] = VS_NIL;
  for (size_t i = m->vertex_count; i-- > 0;)
    if (!vs_bind_give_point(f, m->vertices[i], &r[2]) || !vs_cons(vm, r[2], r[0], &r[0])) return VS_ERROR;
  for (size_t i = m->triangle_count; i-- > 0;) {
    r[2] = VS_NIL;
    for (int k = 2; k >= 0; k--)
      if (!vs_cons(vm, vs_fix((int64_t)m->triangles[i][k] + 1), r[2], &r[2])) return VS_ERROR;
    if (!vs_cons(vm, r[2], r[1], &r[1]) || !vs_poll(vm, 8)) return VS_ERROR;
  }
  return vs_cons(vm, r[0], r[1], out);
}

/* ---- terrain ---- */

typedef struct { vs_vec3 at; uint32_t number; } placed;

static int by_place(const void *p, const void *q) {
  const placed *a = p, *b = q;
  if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
  if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
  return a->number < b->number ? -1 : a->number > b->number;
}

static vs_status two_heights(vs_args *f, vs_vec3 p, vs_vec3 q) {
  vs_scheme *vm = vs_call_vm(f);
  char n[4][32];
  const double d[4] = { p.x, p.y, p.z, q.z };
  for (int i = 0; i < 4; i++) vs_bind_number_text(n[i], d[i]);
  return vs_fail(vm, vm->sym.range, "points at (xy %s %s) have two heights, %s and %s; omit one of them", n[0], n[1],
                 n[2], n[3]);
}

/* Sets number[i] to the index of the vertex in m for point i. Points with equal x and y have one vertex. Sets an error
 * if their heights differ. */
static vs_status number_points(vs_args *f, const vs_vec3 *at, size_t n, uint32_t *number, vs_mesh *m) {
  placed *p = vs_bind_scratch(f, (n + 1) * sizeof *p);
  if (!p) return VS_ERROR;
  for (size_t i = 0; i < n; i++) p[i] = (placed){ vs_v3(at[i].x + 0.0, at[i].y + 0.0, at[i].z), (uint32_t)i };
  qsort(p, n, sizeof *p, by_place);
  for (size_t i = 0; i < n; i++) {
    bool same = i > 0 && p[i].at.x == p[i - 1].at.x && p[i].at.y == p[i - 1].at.y;
    if (same && p[i].at.z != p[i - 1].at.z) return two_heights(f, p[i - 1].at, p[i].at);
    if (!same && !vs_mesh_add_vertex(m, p[i].at, NULL)) return vs_fail_memory(vs_call_vm(f));
    number[p[i].number] = (uint32_t)m->vertex_count - 1;
  }
  return VS_OK;
}

static vs_status not_constrained(vs_args *f, vs_breaklines_outcome outcome, vs_vec2 where) {
  vs_scheme *vm = vs_call_vm(f);
  char x[32], y[32];
  if (outcome == VS_BREAKLINES_MEMORY) return vs_fail_memory(vm);
  vs_bind_number_text(x, round(where.x * 1e6) / 1e6 + 0.0), vs_bind_number_text(y, round(where.y * 1e6) / 1e6 + 0.0);
  if (outcome == VS_BREAKLINES_CROSS)
    return vs_fail(vm, vm->sym.range,
                   "breaklines must not cross; two cross at (xy %s %s): they need a point there", x, y);
  return vs_fail(vm, vm->sym.range, "a breakline at (xy %s %s) comes too near to other points", x, y);
}

/* (%terrain points breaks sizes): computes a surface through the points. breaks: the points of all breaklines in
 * sequence; sizes: the number of points of each breakline. Returns a pair of a list of points and a list of faces. */
vs_status vs_p_terrain(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_arg_points(f, 0).count, breaks = vs_arg_points(f, 1).count, all = n + breaks, edge_count = 0;
  vs_vec3 *at = vs_bind_scratch(f, (all + 1) * sizeof *at);
  vs_vec2 *flat = vs_bind_scratch(f, (all + 1) * sizeof *flat), where = { 0, 0 };
  uint32_t *number = vs_bind_scratch(f, (all + 1) * sizeof *number);
  uint32_t(*edges)[2] = vs_bind_scratch(f, (breaks + 1) * sizeof *edges);
  vs_mesh m = { 0 };
  vs_error e = { 0 };
  vs_breakline_mesh t = { .at = flat };
  if (!at || !flat || !number || !edges) return VS_ERROR;
  for (size_t i = 0; i < all; i++) at[i] = i < n ? vs_arg_points(f, 0).at[i] : vs_arg_points(f, 1).at[i - n];
  bool ok = number_points(f, at, all, number, &m);
  size_t next = n;
  for (vs_value l = vs_arg_value(f, 2); ok && vs_is_pair(l); l = vs_cdr(l)) {
    double size = 0;
    vs_bind_take_number(vm, vs_car(l), &size);
    for (size_t i = 1; i < (size_t)size && next + i < all; i++)
      edges[edge_count][0] = number[next + i - 1], edges[edge_count++][1] = number[next + i];
    next += (size_t)size;
  }
  for (size_t i = 0; ok && i < m.vertex_count; i++) flat[i] = (vs_vec2){ m.vertices[i].x, m.vertices[i].y };
  t.count = m.vertex_count;
  if (ok && m.vertex_count > 2)
    ok = vs_points_delaunay(flat, t.count, &t.triangles, &t.triangle_count, &e) || vs_bind_error(vm, &e);
  t.room = t.triangle_count;
  if (ok && !t.triangle_count)
    ok = vs_fail(vm, vm->sym.range, "points must be three or more that do not lie on one line, seen from above");
  if (ok) {
    vs_breaklines_outcome outcome = vs_breaklines_insert(&t, (const uint32_t (*)[2])edges, edge_count, &where);
    ok = outcome == VS_BREAKLINES_DONE || not_constrained(f, outcome, where);
  }
  for (size_t i = 0; ok && i < t.triangle_count; i++)
    ok = vs_mesh_add_triangle(&m, t.triangles[i][0], t.triangles[i][1], t.triangles[i][2]) || vs_fail_memory(vm);
  ok = ok && points_and_faces(f, &m, out);
  free(t.triangles);
  vs_mesh_free(&m);
  return ok ? VS_OK : VS_ERROR;
}

/* ---- the solid under a surface ---- */

/* Adds a wall below the border edge from a to b of a surface. The surface lies to the left of the edge. Vertices base +
 * a and base + b are the lower corners of the wall. */
static bool add_wall(vs_mesh *m, uint32_t a, uint32_t b, uint32_t base) {
  return vs_mesh_add_triangle(m, a, base + a, base + b) && vs_mesh_add_triangle(m, a, base + b, b);
}

/* Sets *out to the closed mesh between the surface s and the horizontal plane at the height `low`. If `top` is a
 * number, s is first projected to the height `top`. */
static bool close_surface(const vs_mesh *s, double low, double top, vs_mesh *out) {
  vs_mesh_edges edges = { 0 };
  uint32_t base = (uint32_t)s->vertex_count;
  bool ok = vs_mesh_edges_make(&edges, s);
  for (int k = 0; ok && k < 2; k++)
    for (size_t i = 0; ok && i < s->vertex_count; i++) {
      vs_vec3 p = s->vertices[i];
      ok = vs_mesh_add_vertex(out, vs_v3(p.x, p.y, k ? low : isnan(top) ? p.z : top), NULL);
    }
  for (uint32_t i = 0; ok && i < s->triangle_count; i++) {
    uint32_t c[3];
    for (int k = 0; k < 3; k++) c[k] = vs_mesh_edges_corner(&edges, i, k);
    ok =
        vs_mesh_add_triangle(out, c[0], c[1], c[2]) && vs_mesh_add_triangle(out, base + c[0], base + c[2], base + c[1]);
    for (int k = 0; ok && k < 3; k++)
      if (edges.edges[edges.of[i][k]].side[1] == VS_MESH_NONE) ok = add_wall(out, c[(k + 1) % 3], c[(k + 2) % 3], base);
  }
  vs_mesh_edges_free(&edges);
  return ok;
}

/* (%cut-and-fill surface low top name): returns the points and faces of the solid between the height low and the
 * surface. If top is given, the solid ends at the height top instead of the surface. Without heights, returns the pair
 * of the surface's least and greatest height. */
vs_status vs_p_cut_and_fill(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 }, solid = { 0 };
  double low = 0, top = NAN;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  if (vs_arg_ref(f, 0).node->class_ != VS_SURFACE)
    return vs_bind_refuse(f, vs_arg_text(f, 3), "a surface, such as (terrain points)", vs_arg_value(f, 0));
  bool ok = vs_bend_triangles(vm, vs_arg_ref(f, 0), &m);
  vs_bounds b = vs_mesh_bounds(&m);
  double size = vs_bounds_diagonal(&b);
  for (size_t i = 0; ok && i < m.triangle_count; i++) {
    uint32_t *t = m.triangles[i];
    vs_vec3 n =
        vs_v3_cross(vs_v3_sub(m.vertices[t[1]], m.vertices[t[0]]), vs_v3_sub(m.vertices[t[2]], m.vertices[t[0]]));
    if (fabs(n.z) <= 1e-9 * vs_v3_length(n) && vs_v3_length(n) > 1e-12 * size * size)
      ok = vs_bind_refuse(f, vs_arg_text(f, 3), "a surface without upright faces", vs_arg_value(f, 0));
    uint32_t swap = t[1];
    if (n.z < 0) t[1] = t[2], t[2] = swap;
  }
  if (ok && !vs_bind_take_number(vm, vs_arg_value(f, 1), &low))
    ok = vs_cons(vm, vs_flonum(b.min.z), vs_flonum(b.max.z), out);
  else if (ok) {
    vs_bind_take_number(vm, vs_arg_value(f, 2), &top);
    ok = close_surface(&m, low, top, &solid) || vs_fail_memory(vm);
    ok = ok && points_and_faces(f, &solid, out);
  }
  vs_mesh_free(&solid);
  vs_mesh_free(&m);
  return ok ? VS_OK : VS_ERROR;
}
