/* Computes the components of a scope that is a mesh: the faces of its object as polygon scopes, and their edges and
 * vertices.
 *
 * Polyface meshes and boxes already have faces. A region or closed curve has a face for each of its areas. The faces of
 * other solids and surfaces are the triangles of their mesh. An edge or a vertex that several faces share is listed
 * once. */
#include "bind/rules/mesh_faces.h"

#include "bind/call/call.h"
#include "bind/call/context.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/rules/derivation.h"
#include "bind/rules/make_scopes.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/tessellate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "geometry/shapes/polygons.h"
#include "solids/solid_meshes.h"

typedef struct {
  vs_args *f;
  vs_scope_loops **at; /* at[i]: loops of face i; the array is freed when the call ends */
  size_t count, room;
} faces;

static bool add_loops(faces *all, vs_scope_loops *l) {
  if (!l) return vs_fail_memory(all->f->vm);
  if (all->count == all->room) {
    size_t room = all->room ? 2 * all->room : 64;
    vs_scope_loops **more = vs_bind_scratch(all->f, room * sizeof *more);
    if (!more) return vs_scope_loops_release(all->f->store, l), false;
    if (all->count) memcpy(more, all->at, all->count * sizeof *more);
    all->at = more, all->room = room;
  }
  all->at[all->count++] = l;
  return vs_poll(all->f->vm, 16);
}

static bool add_face(void *context, const vs_vec3 *corner, uint32_t n) {
  faces *all = context;
  const uint32_t start[2] = { 0, n };
  return add_loops(all, vs_scope_loops_new(all->f->store, corner, start, 1));
}

static bool add_mesh(faces *all, const vs_mesh *m, const vs_affine *map) {
  bool mirrored = vs_affine_determinant(map) < 0;
  for (size_t i = 0; i < m->triangle_count; i++) {
    vs_vec3 at[3];
    for (int c = 0; c < 3; c++) at[mirrored ? 2 - c : c] = vs_affine_point(map, m->vertices[m->triangles[i][c]]);
    if (!add_face(all, at, 3)) return false;
  }
  return true;
}

static bool add_leaf(faces *all, vs_ref ref, const vs_affine *map) {
  vs_node *n = ref.node;
  vs_error e = { 0 };
  if (n->kind == VS_POLYFACE_MESH || n->kind == VS_BOX) {
    vs_polygons_result r = vs_polygons_each(n, map, add_face, all);
    return r == VS_POLYGONS_MEMORY ? vs_fail_memory(all->f->vm) : r == VS_POLYGONS_GIVEN;
  }
  vs_fineness facets = vs_bend_facets(all->f->vm, n);
  if (n->class_ == VS_REGION_CLASS || n->class_ == VS_CURVE) {
    vs_outline o = { 0 };
    if (n->class_ == VS_CURVE && !(n->flags & VS_NODE_CLOSED))
      return vs_fail(all->f->vm, all->f->vm->sym.type, "an open curve has no faces");
    if (!vs_region_outline(n, &facets, &o, &e)) return vs_bind_error(all->f->vm, &e);
    bool ok = true;
    for (size_t next = 0; ok && next < o.count;) {
      vs_scope_loops *l = vs_rules_outline_loops(all->f, &o, &next);
      vs_vec3 *at = l ? (vs_vec3 *)(uintptr_t)l->points->at : NULL;
      for (uint32_t i = 0; l && i < l->points->count; i++) at[i] = vs_affine_point(map, at[i]);
      ok = l && add_loops(all, l);
    }
    vs_outline_free(&o);
    return ok;
  }
  bool ok = true;
  if (n->class_ == VS_SOLID) {
    vs_solid solid = { 0 };
    vs_kernel_options options = { .job = vs_bind_job(all->f->vm) };
    if (!vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e))
      return e.kind == VS_ERROR_INTERRUPT ? false : vs_bind_error(all->f->vm, &e);
    ok = add_mesh(all, &solid.mesh, map);
    vs_solid_free(&solid);
  } else if (n->class_ == VS_SURFACE) {
    vs_mesh mesh = { 0 };
    ok = vs_tessellate(n, &facets, &mesh, &e) ? add_mesh(all, &mesh, map) : vs_bind_error(all->f->vm, &e);
    vs_mesh_free(&mesh);
  }
  return ok;
}

/* Adds the faces of the object `root`. Visits unions, placements and wrappers with an explicit stack. */
static bool add_object(faces *all, vs_ref root) {
  typedef struct {
    vs_ref ref;
    vs_affine map;
  } open;
  open *stack = vs_bind_scratch(all->f, 64 * sizeof *stack);
  size_t count = 0, room = 64;
  if (!stack) return false;
  stack[count++] = (open){ root, vs_affine_identity() };
  while (count) {
    open o = stack[--count];
    vs_node *n = o.ref.node;
    if (n->kind == VS_EMPTY) continue;
    bool through = n->kind == VS_UNION || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n);
    if (!through) {
      if (!add_leaf(all, o.ref, &o.map)) return false;
      continue;
    }
    if (n->kind == VS_TRANSFORM) o.map = vs_affine_multiply(&o.map, &VS_AS(transform, n)->matrix);
    if (count + n->child_count > room) {
      open *more = vs_bind_scratch(all->f, 2 * (count + n->child_count) * sizeof *more);
      if (!more) return false;
      memcpy(more, stack, count * sizeof *more);
      stack = more, room = 2 * (count + n->child_count);
    }
    for (uint32_t i = n->child_count; i-- > 0;) stack[count++] = (open){ n->children[i], o.map };
  }
  return true;
}

/* An edge of a face, from a to b. order: its number among all edges of the faces. If a and b are equal, it represents a
 * vertex. */
typedef struct { vs_vec3 a, b; size_t order; } face_edge;

static int by_place(vs_vec3 p, vs_vec3 q) {
  if (p.x != q.x) return p.x < q.x ? -1 : 1;
  if (p.y != q.y) return p.y < q.y ? -1 : 1;
  return p.z == q.z ? 0 : p.z < q.z ? -1 : 1;
}

/* Compares two edges by their end points, ignoring their direction. */
static int compare_edges(const face_edge *p, const face_edge *q) {
  bool p_back = by_place(p->a, p->b) > 0, q_back = by_place(q->a, q->b) > 0;
  int low = by_place(p_back ? p->b : p->a, q_back ? q->b : q->a);
  return low ? low : by_place(p_back ? p->a : p->b, q_back ? q->a : q->b);
}

static int by_ends(const void *p, const void *q) {
  const face_edge *e = p, *f = q;
  int ends = compare_edges(e, f);
  return ends ? ends : (e->order > f->order) - (e->order < f->order);
}

static int by_order(const void *p, const void *q) {
  const face_edge *e = p, *f = q;
  return (e->order > f->order) - (e->order < f->order);
}

/* Sets *out to the edges or vertices of all faces, without duplicates, in the order of the faces, and *count to their
 * number. The array is freed when the call ends. */
static bool edges_once(const faces *all, bool vertices, face_edge **out, size_t *count) {
  size_t n = 0, kept = 0;
  for (size_t i = 0; i < all->count; i++) n += all->at[i]->points->count;
  face_edge *e = *out = vs_bind_scratch(all->f, (n ? n : 1) * sizeof *e);
  if (!e) return false;
  n = 0;
  for (size_t i = 0; i < all->count; i++) {
    const vs_scope_loops *l = all->at[i];
    for (uint32_t k = 0; k < l->count; k++)
      for (uint32_t from = l->start[k], end = l->start[k + 1], j = from; j < end; j++, n++)
        e[n] = (face_edge){ l->points->at[j], l->points->at[vertices ? j : j + 1 < end ? j + 1 : from], n };
  }
  if (n) qsort(e, n, sizeof *e, by_ends);
  for (size_t i = 0; i < n; i++)
    if (!kept || compare_edges(&e[kept - 1], &e[i])) e[kept++] = e[i];
  if (kept) qsort(e, kept, sizeof *e, by_order);
  *count = kept;
  return true;
}

/* Sets c to component i of the mesh scope s: a face with its loops, or an edge or vertex with a frame parallel to
 * that of s. The y of a vertical edge is as close as possible to the x of that frame. Returns false for a face
 * without area. */
static bool lay_component(vs_scope *c, const vs_scope *s, faces *all, const face_edge *edges, size_t i) {
  if (!edges) {
    c->loops = all->at[i], all->at[i] = NULL;
    return vs_scope_frame_loops(c);
  }
  vs_affine frame = vs_scope_frame(s);
  vs_vec3 d = vs_v3_unit(vs_v3_sub(edges[i].b, edges[i].a));
  bool upright = fabs(vs_v3_dot(d, vs_affine_column(&frame, 1))) > 1 - 1e-9;
  vs_scope_lay_edge(c, &frame, upright ? 0 : 1, edges[i].a, edges[i].b);
  return true;
}

vs_status vs_mesh_components(vs_args *f, const char *of, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  vs_scope *s = f->arg[0].scope;
  faces all = { .f = f };
  face_edge *edges = NULL;
  bool whole = !strcmp(of, "faces"), vertices = !strcmp(of, "vertices");
  r[0] = f->arg[1].value;
  if (!whole && !vertices && strcmp(of, "edges"))
    return vs_bind_refuse(f, "#:of", "one of 'faces 'edges 'vertices, for a mesh", f->key[0].value);
  bool ok = add_object(&all, s->object);
  size_t n = all.count;
  if (ok && !whole) ok = edges_once(&all, vertices, &edges, &n);
  vs_derivation *d = ok ? vs_rules_begin(f, &r[1]) : NULL;
  vs_rule_task *t = d ? vs_task_new(d, (uint32_t)n, false) : NULL;
  if (t) t->rules[0] = r[0];
  for (size_t i = 0; t && i < n; i++) {
    vs_scope *c = t->child[i] = vs_rules_child(d, s, whole ? VS_SCOPE_POLYGON : VS_SCOPE_BOX, vs_rules_operator(f),
                                               (uint32_t)i, (uint32_t)n);
    if (!c) {
      vs_task_drop(d, t), t = NULL;
      break;
    }
    if (!lay_component(c, s, &all, edges, i)) vs_scope_release(c), t->child[i] = NULL; /* a face without area is omitted
                                                                                        * from the children */
  }
  for (size_t i = 0; i < all.count; i++) vs_scope_loops_release(f->store, all.at[i]);
  *out = r[1];
  return t && vs_task_push(d, t) ? VS_OK : VS_ERROR;
}
