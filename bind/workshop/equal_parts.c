/* Implements the natives of part-groups and part-size: comparing the shapes of parts independently of their place, and
 * computing the smallest box around a part. */
#include <math.h>
#include <stdlib.h>

#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/part_shape.h"
#include "geometry/parts.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/profiles/swept_mesh.h"

/* A piece of a part. placed: the map from the piece's coordinates to those of the part. */
typedef struct { vs_ref ref; vs_affine placed; } piece;

/* A part, of which only the pieces of the highest dimension are compared: the region of a slice, but not its engraved
 * lines. The pieces are below the part's placements, so that their facets do not depend on how the part is turned. */
typedef struct {
  vs_args *f;
  vs_growing pieces;  /* array of elements of type piece */
  vs_class class_;
} part;

static int rank(vs_class c) { return c == VS_SOLID ? 3 : c == VS_SURFACE || c == VS_REGION_CLASS ? 2 : c == VS_CURVE; }

static piece *piece_at(const part *p, size_t i) { return (piece *)p->pieces.at + i; }

/* Returns true if the children of the union n are pieces of their own. A union of solids, or of regions, is one
 * piece. */
static bool divides(const vs_node *n) {
  return n->kind == VS_UNION && (n->class_ == VS_MIXED || n->class_ == VS_CURVE || n->class_ == VS_SURFACE);
}

/* Replaces the piece's node by the node below its placements, materials and layers. */
static void descend(piece *p) {
  for (const vs_node *n = p->ref.node; vs_is_wrapper(n); n = p->ref.node) {
    if (n->kind == VS_TRANSFORM) p->placed = vs_affine_multiply(&p->placed, &VS_AS(transform, n)->matrix);
    p->ref = n->children[0];
  }
}

/* Divides the part into pieces: replaces each union for which `divides` is true by its children. */
static bool part_open(part *p, vs_args *f, vs_ref whole) {
  *p = (part){ .f = f, .pieces = { .size = sizeof(piece) } };
  piece *first = vs_bind_grow(f, &p->pieces);
  if (!first) return false;
  *first = (piece){ whole, vs_affine_identity() };
  for (size_t i = 0; i < p->pieces.count; i++) {
    descend(piece_at(p, i));
    const piece at = *piece_at(p, i);
    if (!divides(at.ref.node)) {
      if (rank((vs_class)at.ref.node->class_) > rank(p->class_)) p->class_ = (vs_class)at.ref.node->class_;
      continue;
    }
    for (uint32_t c = 0; c < at.ref.node->child_count; c++) {
      piece *below = vs_bind_grow(f, &p->pieces);
      if (!below) return false;
      *below = (piece){ at.ref.node->children[c], at.placed };
    }
    if (!vs_poll(vs_call_vm(f), 16)) return false;
  }
  return true;
}

static bool counts(const part *p, size_t i) {
  const vs_node *n = piece_at(p, i)->ref.node;
  return !divides(n) && rank((vs_class)n->class_) == rank(p->class_);
}

/* Sets *m to the triangles of a piece. */
static bool piece_triangles(vs_args *f, vs_ref ref, vs_mesh *m) {
  vs_scheme *vm = vs_call_vm(f);
  if (ref.node->class_ != VS_REGION_CLASS) return vs_bend_triangles(vm, ref, m);
  vs_outline o = { 0 };
  vs_error e = { 0 };
  const vs_fineness facets = vs_bend_facets(vm, ref.node);
  bool ok = vs_region_outline(ref.node, &facets, &o, &e) || vs_bind_error(vm, &e);
  ok = ok && (!o.count || vs_outline_mesh(&o, m) || vs_fail_memory(vm));
  vs_outline_free(&o);
  return ok;
}

/* Adds the triangles of a piece to the mesh. */
static bool add_piece(vs_args *f, const piece *p, vs_mesh *m) {
  vs_mesh own = { 0 };
  const uint32_t first = (uint32_t)m->vertex_count;
  bool ok = piece_triangles(f, p->ref, &own), room = true;
  vs_mesh_transform(&own, &p->placed);
  for (size_t i = 0; ok && room && i < own.vertex_count; i++) room = vs_mesh_add_vertex(m, own.vertices[i], NULL);
  for (size_t i = 0; ok && room && i < own.triangle_count; i++) {
    const uint32_t *t = own.triangles[i];
    room = vs_mesh_add_triangle(m, first + t[0], first + t[1], first + t[2]);
  }
  vs_mesh_free(&own);
  return ok && (room || vs_fail_memory(vs_call_vm(f)));
}

/* Computes the shape of a part that is a curve. Refuses several curves. */
static bool curve_shape(part *p, vs_part_shape *out) {
  vs_polyline line = { 0 };
  vs_error e = { 0 };
  size_t one = 0, several = 0;
  for (size_t i = 0; i < p->pieces.count; i++)
    if (counts(p, i)) one = i, several++;
  if (several > 1)
    return vs_bind_refuse(p->f, "parts", "solids, regions, surfaces and single curves", vs_arg_value(p->f, 0));
  const piece *curve = piece_at(p, one);
  const vs_fineness facets = vs_bend_facets(vs_call_vm(p->f), curve->ref.node);
  bool ok = vs_curve_sample(curve->ref.node, &facets, &line, &e) || vs_bind_error(vs_call_vm(p->f), &e);
  for (size_t i = 0; ok && i < line.count; i++) line.at[i] = vs_affine_point(&curve->placed, line.at[i]);
  ok = ok && (vs_part_shape_of_line(line.at, line.count, line.closed, out) || vs_fail_memory(vs_call_vm(p->f)));
  vs_polyline_free(&line);
  return ok;
}

/* Finds the smallest box around the part. Also tries the axes of the coordinates in which the first piece was made:
 * they suit round parts. */
static void find_box(const part *p, const vs_mesh *m, vs_part_box *box) {
  vs_vec3 own[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  size_t i = 0;
  while (i < p->pieces.count && !counts(p, i)) i++;
  if (i < p->pieces.count) {
    const vs_affine *a = &piece_at(p, i)->placed;
    const vs_vec3 x = vs_v3_unit(vs_v3(a->m[0][0], a->m[1][0], a->m[2][0])), y = { a->m[0][1], a->m[1][1], a->m[2][1] };
    const vs_vec3 z = vs_v3_unit(vs_v3_cross(x, y));
    if (vs_v3_length(z) > 0) own[0] = x, own[1] = vs_v3_cross(z, x), own[2] = z;
  }
  vs_mesh_smallest_box(m, own, box);
}

/* Computes the shape of a part, and the box around it if `box` is not NULL. */
static bool shape_of(vs_args *f, vs_ref ref, vs_part_shape *out, vs_part_box *box) {
  vs_scheme *vm = vs_call_vm(f);
  part p = { 0 };
  vs_mesh m = { 0 };
  vs_ref whole = { vs_node_retain(ref.node), ref.origin };
  *out = (vs_part_shape){ 0 };
  bool ok = vs_bend_resolve(vm, &whole) && part_open(&p, f, whole);
  if (ok && p.class_ == VS_CURVE) ok = curve_shape(&p, out);
  else if (ok) {
    for (size_t i = 0; ok && i < p.pieces.count; i++) ok = !counts(&p, i) || add_piece(f, piece_at(&p, i), &m);
    ok = ok && (vs_part_shape_of_mesh(&m, p.class_ == VS_SOLID, out) || vs_fail_memory(vm));
    if (ok && box) find_box(&p, &m, box);
  }
  vs_mesh_free(&m);
  vs_node_release(whole.node);
  return ok;
}

/* How much equal parts may differ: a share of their size, or a length, of which at most a hundredth of the size counts.
 * The larger of the two applies. */
typedef struct { double share, length; } allowance;

/* Returns the allowance for parts like s as a share of their size. */
static double allowed_share(const vs_part_shape *s, allowance a) {
  const double size = s->count ? vs_v3_length(s->corners[s->count - 1]) : pow(s->measure, 1.0 / s->dimension);
  return size > 0 ? fmax(a.share, fmin(0.01, a.length / size)) : a.share;
}

/* Sets group[i] to the index of the first part whose shape equals that of part i. */
static bool find_groups(vs_args *f, const vs_part_shape *shapes, size_t count, allowance allowed, size_t *group) {
  size_t *firsts = vs_bind_scratch(f, (count + 1) * sizeof *firsts), first_count = 0;
  if (!firsts) return false;
  for (size_t i = 0; i < count; i++) {
    const double slack = allowed_share(&shapes[i], allowed);
    size_t k = 0;
    while (k < first_count && !vs_part_shapes_equal(&shapes[firsts[k]], &shapes[i], slack)) k++;
    if (k == first_count) firsts[first_count++] = i;
    group[i] = firsts[k];
    if (!vs_poll(vs_call_vm(f), 64)) return false;
  }
  return true;
}

/* (%part-groups parts tolerance length): returns a list with, for each part, the index of the first part that has the
 * same shape, up to the allowance of both numbers. */
vs_status vs_p_part_groups(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const size_t n = vs_arg_refs(f, 0).count;
  vs_part_shape *shapes = vs_bind_scratch(f, (n + 1) * sizeof *shapes);
  size_t *group = vs_bind_scratch(f, (n + 1) * sizeof *group), made = 0;
  bool ok = shapes && group;
  while (ok && made < n) {
    ok = shape_of(f, vs_arg_refs(f, 0).at[made], &shapes[made], NULL) && vs_poll(vm, 64);
    made++;
  }
  ok = ok && find_groups(f, shapes, n, (allowance){ vs_arg_real(f, 1), vs_arg_real(f, 2) }, group);
  for (size_t i = 0; shapes && i < made; i++) vs_part_shape_free(&shapes[i]);
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  for (size_t i = n; ok && i-- > 0;) ok = vs_cons(vm, vs_fix((int64_t)group[i]), r[0], &r[0]);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* (%part-size o): returns a list: a matrix, then the lengths of the turned part's mesh along X, Y and Z. The matrix
 * turns the part so that the smallest box around it is along X, Y and Z. A curve is not turned, and its lengths are
 * infinite. */
vs_status vs_p_part_size(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_part_box box = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { INFINITY, INFINITY, INFINITY } };
  vs_part_shape shape;
  vs_affine turn = vs_affine_identity();
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  bool ok = shape_of(f, vs_arg_ref(f, 0), &shape, &box);
  vs_part_shape_free(&shape);
  for (int i = 0; i < 3; i++)
    turn.m[i][0] = box.axes[i].x, turn.m[i][1] = box.axes[i].y, turn.m[i][2] = box.axes[i].z;
  if (vs_affine_determinant(&turn) < 0)
    for (int j = 0; j < 3; j++) turn.m[2][j] = -turn.m[2][j];
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (int i = 3; ok && i-- > 0;) ok = vs_cons(vm, vs_flonum(box.size[i]), r[0], &r[0]);
  return ok && vs_bind_give_matrix(f, &turn, &r[1]) && vs_cons(vm, r[1], r[0], out) ? VS_OK : VS_ERROR;
}
