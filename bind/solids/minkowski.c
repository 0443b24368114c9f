/* Implements minkowski: the sum of two solids, as a hull or a union of hulls.
 *
 * The sum of two convex solids is the hull of the sums of their corners. The sum of two other solids A and B is a
 * union. Its parts are A moved by one point of B, B moved by one point of A, and the sums of all pairs of boundary
 * polygons. A point x is in the sum if x - B and A have a common point. Then their boundaries intersect, or one of the
 * two solids lies in the other. Each polygon is convex, and so is each of the sums. */
#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/positional.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/origins.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/mesh_parts.h"
#include "geometry/shapes/convexity.h"
#include "geometry/shapes/hull.h"
#include "model/store/array.h"

enum {
  COPIES_MOST = 64,       /* greatest number of corners of a solid for which the sum is the hull of copies of the other
                           * solid; the copies keep their kind */
  POINTS_MOST = 4000000,  /* greatest number of points of one hull */
  PAIRS_MOST = 4000000,   /* greatest number of points of all hulls of a union */
  SUMS_MOST = 1000000000  /* greatest number of pairs of corners of two convex solids that are compared */
};

/* A solid that is added to another. */
typedef struct {
  vs_ref ref;
  vs_mesh mesh;
  vs_mesh_edges edges;
  vs_convex_faces faces; /* the boundary as convex polygons; a convex solid has one polygon of all its corners */
  bool convex;
} summand;

static void summand_free(summand *s) {
  vs_convex_faces_free(&s->faces);
  vs_mesh_edges_free(&s->edges);
  vs_mesh_free(&s->mesh);
}

/* Puts all corners of the boundary into one polygon. */
static bool corners_of(summand *s) {
  const vs_mesh *m = &s->mesh;
  vs_convex_faces *c = &s->faces;
  if (!VS_GROW(c->at, c->room, m->vertex_count + 1) || !VS_GROW(c->starts, c->start_room, 2)) return false;
  for (uint32_t i = 0; i < m->vertex_count; i++)
    if (s->edges.corner[i] == i) c->at[c->count++] = m->vertices[i];
  c->starts[0] = 0, c->starts[1] = (uint32_t)c->count, c->polygons = 1;
  return true;
}

static vs_status begin(vs_args *f, int i, summand *s) {
  vs_scheme *vm = vs_call_vm(f);
  *s = (summand){ .ref = vs_arg_ref(f, i) };
  if (!vs_bend_triangles(vm, s->ref, &s->mesh)) return VS_ERROR;
  if (!vs_mesh_edges_make(&s->edges, &s->mesh)) return vs_fail_memory(vm);
  s->convex = vs_mesh_is_convex(&s->edges);
  bool ok = s->convex ? corners_of(s) : vs_mesh_convex_faces(&s->edges, &s->faces);
  return ok ? VS_OK : vs_fail_memory(vm);
}

/* The sum of two solids while it is computed: a growing list of nodes, which are released when the call ends. */
typedef struct {
  vs_args *f;
  vs_growing refs;
} sum;

static vs_status add_node(sum *s, vs_node *n) {
  if (!vs_bind_keep(s->f, n)) return VS_ERROR;
  vs_ref *to = vs_bind_grow(s->f, &s->refs);
  if (!to) return VS_ERROR;
  *to = (vs_ref){ n, vs_bind_origin(vs_call_bind(s->f)) };
  return VS_OK;
}

static vs_node *moved(vs_args *f, vs_ref ref, vs_vec3 by) {
  struct vs_transform d = { .matrix = vs_affine_translation(by) };
  return vs_node_new(vs_call_store(f), VS_TRANSFORM, &d, &ref, 1);
}

static vs_status add_moved(sum *s, vs_ref ref, vs_vec3 by) { return add_node(s, moved(s->f, ref, by)); }

/* Adds the hull of a cloud of points, unless they lie in one plane. Frees the cloud. */
static vs_status add_hull(sum *s, vs_cloud *cloud) {
  vs_mesh hull = { 0 };
  vs_points *points = NULL;
  if (vs_cloud_dimension(cloud) < 3) return vs_cloud_free(cloud), VS_OK;
  vs_store *store = vs_call_store(s->f);
  bool ok = vs_cloud_hull(cloud, &hull) && (points = vs_points_new(store, hull.vertices, hull.vertex_count));
  vs_node *made =
      ok ? vs_node_new(store, VS_HULL, &(struct vs_hull){ .points = points, .dimension = 3 }, NULL, 0) : NULL;
  if (points) vs_points_release(store, points);
  vs_mesh_free(&hull);
  vs_cloud_free(cloud);
  return add_node(s, made);
}

/* Adds the hull of the sums p + q of the n points at a and the m points at b, unless all sums lie in one plane. */
static vs_status add_sum_of_points(sum *s, const vs_vec3 *a, size_t n, const vs_vec3 *b, size_t m) {
  vs_cloud cloud = { 0 };
  bool ok = true;
  for (size_t i = 0; ok && i < n; i++)
    for (size_t k = 0; ok && k < m; k++) ok = vs_cloud_add(&cloud, vs_v3_add(a[i], b[k]));
  return ok ? add_hull(s, &cloud) : (vs_cloud_free(&cloud), vs_fail_memory(vs_call_vm(s->f)));
}

/* Adds the hull of n copies of the object `whole`, each moved by one of the points. */
static vs_status add_copies(sum *s, const vs_vec3 *at, size_t n, vs_ref whole) {
  vs_ref *child = vs_bind_scratch(s->f, n * sizeof *child);
  vs_points *none = child ? vs_points_new(vs_call_store(s->f), NULL, 0) : NULL;
  bool ok = child != NULL;
  for (size_t i = 0; ok && i < n; i++) {
    child[i] = (vs_ref){ moved(s->f, whole, at[i]), vs_bind_origin(vs_call_bind(s->f)) };
    ok = vs_bind_keep(s->f, child[i].node);
  }
  vs_node *made = ok && none ? vs_node_new(vs_call_store(s->f), VS_HULL,
                                           &(struct vs_hull){ .points = none, .dimension = 3 }, child, n)
                             : NULL;
  if (none) vs_points_release(vs_call_store(s->f), none);
  return ok ? add_node(s, made) : VS_ERROR;
}

/* Adds the sum of a polygon, whose n corners are at a, and the convex solid b. If b is round, the hull of copies of b
 * keeps b's kind. */
static vs_status add_pair(sum *s, const vs_vec3 *a, size_t n, const summand *b) {
  if (n <= COPIES_MOST && b->faces.count > COPIES_MOST) return add_copies(s, a, n, b->ref);
  return add_sum_of_points(s, a, n, b->faces.at, b->faces.count);
}

static vs_status too_fine(vs_args *f, size_t points) {
  vs_scheme *vm = vs_call_vm(f);
  return vs_fail(vm, vm->sym.range,
                 "the sum would be made of %zu points; make the solids coarser with #:segments or current-segments",
                 points);
}

/* Adds the sum of two convex solids with many corners. It is the hull of sums of two corners that can be the
 * farthest ones in a common direction. For other pairs of corners no such direction exists, so their sums lie within
 * the hull. */
static vs_status add_round_sum(sum *s, const summand *a, const summand *b) {
  vs_normal_cap *p = vs_bind_scratch(s->f, a->mesh.vertex_count * sizeof *p),
                *q = vs_bind_scratch(s->f, b->mesh.vertex_count * sizeof *q);
  vs_cloud cloud = { 0 };
  if (!p || !q) return VS_ERROR;
  bool ok = vs_mesh_normal_caps(&a->edges, p) && vs_mesh_normal_caps(&b->edges, q);
  for (uint32_t i = 0; ok && i < a->mesh.vertex_count; i++) {
    if (a->edges.corner[i] != i) continue;
    for (uint32_t k = 0; ok && k < b->mesh.vertex_count; k++) {
      double angle = p[i].angle + q[k].angle + 1e-6;
      if (b->edges.corner[k] != k || (angle < 3.1415 && vs_v3_dot(p[i].axis, q[k].axis) < cos(angle))) continue;
      if (cloud.count >= POINTS_MOST) return vs_cloud_free(&cloud), too_fine(s->f, cloud.count);
      ok = vs_cloud_add(&cloud, vs_v3_add(a->mesh.vertices[i], b->mesh.vertices[k]));
    }
    if (ok && !vs_poll(vs_call_vm(s->f), (uint32_t)(b->mesh.vertex_count / 8 + 1)))
      return vs_cloud_free(&cloud), VS_ERROR;
  }
  return ok ? add_hull(s, &cloud) : (vs_cloud_free(&cloud), vs_fail_memory(vs_call_vm(s->f)));
}

static vs_status sum_of_convex(sum *s, const summand *a, const summand *b) {
  size_t n = a->faces.count, m = b->faces.count;
  if (m < n) {
    const summand *c = a;
    a = b, b = c, n = a->faces.count, m = b->faces.count;
  }
  if (n * m > SUMS_MOST) return too_fine(s->f, n * m);
  if (n > COPIES_MOST) return add_round_sum(s, a, b);
  return add_pair(s, a->faces.at, n, b);
}

/* Adds copies of the object `whole`: for each connected part of `at`, a copy moved by a point of this part. */
static vs_status add_inner(sum *s, vs_ref whole, const summand *at) {
  vs_mesh_parts parts;
  vs_status ok = vs_mesh_parts_find(&at->mesh, &parts) ? VS_OK : vs_fail_memory(vs_call_vm(s->f));
  uint32_t next = 0;
  for (size_t t = 0; ok && t < at->mesh.triangle_count; t++)
    if (parts.of[t] == next) ok = add_moved(s, whole, at->mesh.vertices[at->mesh.triangles[t][0]]), next++;
  vs_mesh_parts_free(&parts);
  return ok;
}

/* Adds the sums of all pairs of boundary polygons, one of a and one of b. */
static vs_status sum_of_boundaries(sum *s, const summand *a, const summand *b) {
  size_t points = a->faces.count * b->faces.count;
  if (points > PAIRS_MOST) return too_fine(s->f, points);
  vs_status ok = VS_OK;
  for (size_t i = 0; ok && i < a->faces.polygons; i++)
    for (size_t k = 0; ok && k < b->faces.polygons; k++) {
      const vs_vec3 *p = a->faces.at + a->faces.starts[i], *q = b->faces.at + b->faces.starts[k];
      size_t n = a->faces.starts[i + 1] - a->faces.starts[i], m = b->faces.starts[k + 1] - b->faces.starts[k];
      ok = b->convex ? add_pair(s, p, n, b) : a->convex ? add_pair(s, q, m, a) : add_sum_of_points(s, p, n, q, m);
      if (ok && !vs_poll(vs_call_vm(s->f), 64)) ok = VS_ERROR;
    }
  return ok;
}

static vs_status sum_of_any(sum *s, const summand *a, const summand *b) {
  vs_status ok = sum_of_boundaries(s, a, b);
  return ok && add_inner(s, a->ref, b) && add_inner(s, b->ref, a) ? VS_OK : VS_ERROR;
}

/* Sets *out to the union of the nodes in s. */
static vs_status give_sum(sum *s, vs_value *out) {
  const vs_ref *refs = s->refs.at;
  vs_node *n = s->refs.count == 1
                   ? vs_node_retain(refs[0].node)
                   : vs_node_new(vs_call_store(s->f), VS_UNION, &(struct vs_union){ 0 }, refs, s->refs.count);
  return vs_bind_give_node(s->f, n, out);
}

/* (%do-offset-solid o ball): returns the union of copies of the convex solid `ball`, one for each point of the boundary
 * of o. */
vs_status vs_p_solid_skin(vs_args *f, vs_value *out) {
  summand a = { 0 }, b = { 0 };
  sum s = { .f = f, .refs = { .size = sizeof(vs_ref) } };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_status ok = begin(f, 0, &a) && begin(f, 1, &b) ? VS_OK : VS_ERROR;
  vs_convex_faces_free(&a.faces);
  if (ok && !vs_mesh_convex_faces(&a.edges, &a.faces)) ok = vs_fail_memory(vs_call_vm(f));
  ok = ok && sum_of_boundaries(&s, &a, &b) && give_sum(&s, out);
  summand_free(&a), summand_free(&b);
  return ok;
}

/* (minkowski a b): returns the solid of all points p + q, where p is in a and q in b. */
vs_status vs_p_minkowski(vs_args *f, vs_value *out) {
  summand a = { 0 }, b = { 0 };
  sum s = { .f = f, .refs = { .size = sizeof(vs_ref) } };
  for (int i = 0; i < 2; i++) {
    if (!vs_bind_finite(f, i) || !vs_bind_resolve(f, i)) return VS_ERROR;
    if (vs_arg_ref(f, i).node->kind == VS_EMPTY) return vs_bind_empty(f, "a summand is empty", out);
  }
  vs_status ok = begin(f, 0, &a) && begin(f, 1, &b) ? VS_OK : VS_ERROR;
  if (ok && (!a.mesh.triangle_count || !b.mesh.triangle_count)) ok = vs_bind_empty(f, "a summand is empty", out);
  else if (ok) {
    ok = a.convex && b.convex ? sum_of_convex(&s, &a, &b) : sum_of_any(&s, &a, &b);
    ok = ok && give_sum(&s, out);
  }
  summand_free(&a), summand_free(&b);
  return ok;
}
