/* Implements the natives for outlines of regions and surfaces, and for level lines and slices of surfaces and
 * solids. */
#include "bind/workshop/outlines.h"

#include <stdlib.h>
#include <string.h>

#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/constructors/operations.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/node_measures.h"
#include "geometry/nets/contour_lines.h"
#include "geometry/parts.h"
#include "geometry/plane/inner_lines.h"
#include "geometry/plane/planar_evaluation.h"
#include "model/store/array.h"
#include "solids/sections.h"
#include "vm/machine/fail.h"

/* Returns a node of the line through the points of p, closed if p is closed. The node is released when the call ends.
 * If it fails, sets the error and returns NULL. */
static vs_node *line_of(vs_args *f, const vs_polyline *p) {
  vs_store *store = vs_call_store(f);
  vs_points *points = vs_points_new(store, p->at, p->count);
  vs_node *n =
      points ? vs_node_new(store, VS_LINE, &(struct vs_line){ .points = points, .closed = p->closed }, NULL, 0) : NULL;
  if (points) vs_points_release(store, points);
  return vs_bind_keep(f, n) ? n : NULL;
}

/* Returns true if the closed lines a and b have the same sequence of points, from any start, forwards or backwards. */
static bool same_loop(const vs_polyline *a, const vs_polyline *b) {
  bool forward = a->count == b->count, back = forward;
  for (size_t i = 0; (forward || back) && i < a->count; i++) {
    forward = forward && vs_v3_equal(a->at[i], b->at[i]);
    back = back && vs_v3_equal(a->at[i], b->at[a->count - 1 - i]);
  }
  return forward || back;
}

/* Sets curve[i] to the child of the region that has exactly the points of loop i of the outline o. If there is no such
 * child, the node of curve[i] is NULL. */
static bool match_curves(vs_args *f, const vs_node *region, const vs_fineness *facets, const vs_outline *o,
                         vs_ref *curve) {
  vs_scheme *vm = vs_call_vm(f);
  for (size_t i = 0; i < o->count; i++) curve[i] = (vs_ref){ 0 };
  if (region->kind != VS_REGION) return true;
  for (uint32_t c = 0; c < region->child_count; c++) {
    vs_polyline p = { 0 };
    vs_error e = { 0 };
    if (!vs_curve_sample(region->children[c].node, facets, &p, &e)) return vs_bind_error(vm, &e);
    if (p.closed)
      for (size_t i = 0; i < o->count; i++)
        if (!curve[i].node && same_loop(&p, &o->loops[i])) {
          curve[i] = region->children[c];
          break;
        }
    vs_polyline_free(&p);
    if (!vs_poll(vm, 16)) return false;
  }
  return true;
}

/* Adds curves for the loops of the outline o to the array `out`: holes if `holes` is true, otherwise outer loops. Each
 * curve gets the layers and materials of `whole`. */
static bool put_loops(vs_args *f, vs_ref whole, const vs_outline *o, const vs_ref *curve, bool holes, vs_ref *out,
                      size_t *count) {
  for (size_t i = 0; i < o->count; i++) {
    if (o->hole[i] != holes) continue;
    vs_ref inner = { curve && curve[i].node ? curve[i].node : line_of(f, &o->loops[i]), whole.origin };
    vs_node *made = inner.node ? vs_parts_within(whole, inner) : NULL;
    if (!inner.node || !vs_bind_keep(f, made)) return false;
    out[(*count)++] = (vs_ref){ made, whole.origin };
  }
  return true;
}

static vs_ref *of_outline(vs_args *f, vs_ref whole, const vs_outline *o, const vs_ref *curve, size_t *count) {
  vs_ref *out = vs_bind_scratch(f, (o->count + 1) * sizeof *out);
  *count = 0;
  bool ok = out && put_loops(f, whole, o, curve, false, out, count) && put_loops(f, whole, o, curve, true, out, count);
  return ok ? out : NULL;
}

static vs_ref *of_region(vs_args *f, vs_ref ref, size_t *count) {
  vs_scheme *vm = vs_call_vm(f);
  vs_outline o = { 0 };
  vs_error e = { 0 };
  const vs_node *n = ref.node;
  while (vs_is_wrapper(n)) n = n->children[0].node;
  vs_fineness facets = vs_bend_facets(vm, n);
  if (vs_bind_tolerance(vm) <= 0) facets.tolerance /= 16; /* outlines are as fine as sections of solids, since their
                                                           * lines become part of the model */
  if (!vs_region_outline(n, &facets, &o, &e)) return vs_bind_error(vm, &e), NULL;
  vs_ref *curve = vs_bind_scratch(f, (o.count + 1) * sizeof *curve);
  vs_ref *out = curve && match_curves(f, n, &facets, &o, curve) ? of_outline(f, ref, &o, curve, count) : NULL;
  vs_outline_free(&o);
  return out;
}

static vs_ref *of_surface(vs_args *f, vs_ref ref, size_t *count) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 };
  vs_outline o = { 0 };
  vs_error e = { 0 };
  vs_ref *out = NULL;
  vs_ref inner = ref;
  while (vs_is_wrapper(inner.node)) inner = inner.node->children[0];
  if (!vs_bend_triangles(vm, inner, &m)) return vs_mesh_free(&m), NULL;
  if (!vs_mesh_flat_outline(&m, &o, &e)) vs_bind_error(vm, &e);
  else out = of_outline(f, ref, &o, NULL, count);
  vs_outline_free(&o);
  vs_mesh_free(&m);
  return out;
}

static vs_ref *of_curves(vs_args *f, vs_ref ref, size_t *count) {
  vs_ref *parts;
  if (!vs_several_parts(ref, &parts, count)) return vs_fail_memory(vs_call_vm(f)), NULL;
  vs_ref *out = vs_bind_scratch(f, (*count + 1) * sizeof *out);
  bool ok = out != NULL;
  for (size_t i = 0; out && i < *count; i++) {
    out[i] = parts[i];
    ok = vs_bind_keep(f, vs_node_retain(parts[i].node)) && ok;
    if (ok && !(parts[i].node->flags & VS_NODE_CLOSED))
      ok = vs_bind_refuse(f, "o", "a region, a flat surface or closed curves", vs_arg_value(f, 0));
    ok = ok && vs_bind_uncrossed(f, parts[i], "a closed curve that is taken as filled");
  }
  vs_several_free(parts, *count);
  return ok ? out : NULL;
}

vs_ref *vs_bind_outlines(vs_args *f, vs_ref ref, size_t *count) {
  *count = 0;
  switch ((vs_class)ref.node->class_) {
  case VS_NOTHING: return vs_bind_scratch(f, sizeof(vs_ref));
  case VS_CURVE: return of_curves(f, ref, count);
  case VS_REGION_CLASS: return of_region(f, ref, count);
  case VS_SURFACE: return of_surface(f, ref, count);
  case VS_SOLID: case VS_MIXED: case VS_INHERIT: break;
  }
  return vs_bind_refuse_hint(f, "o", "a region, a flat surface or closed curves", vs_arg_value(f, 0),
                             "outline (do-section o plane)"),
         NULL;
}

/* (outline o): returns the closed curves around the region or flat surface. */
vs_status vs_p_outline(vs_args *f, vs_value *out) {
  size_t count;
  vs_kind kind = (vs_kind)vs_arg_ref(f, 0).node->kind;
  if (kind == VS_XLINE || kind == VS_RAY)
    return vs_bind_refuse(f, "o", "a region, a flat surface or closed curves", vs_arg_value(f, 0));
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_ref *curves = vs_bind_outlines(f, vs_arg_ref(f, 0), &count);
  return curves ? vs_bind_give_refs(vs_call_bind(f), curves, count, out) : VS_ERROR;
}

/* ---- level lines ---- */

typedef struct {
  vs_args *f;
  vs_ref *at;
  size_t count, room;
} level_lines;

static bool keep_line(void *context, const vs_polyline *line) {
  level_lines *l = context;
  if (!VS_GROW(l->at, l->room, l->count + 1)) return vs_fail_memory(vs_call_vm(l->f));
  l->at[l->count] = (vs_ref){ line_of(l->f, line), NULL };
  return l->at[l->count++].node != NULL;
}

/* Sets *out to the list of the curves in which a plane intersects an open mesh. */
static vs_status surface_level(vs_args *f, const vs_mesh *m, vs_vec3 at, vs_vec3 normal, vs_value *out) {
  level_lines lines = { .f = f };
  bool ok = vs_mesh_contour(m, at, normal, &(vs_line_put){ keep_line, &lines });
  if (!ok) vs_fail_memory(vs_call_vm(f)); /* vs_mesh_contour fails only when memory is out */
  ok = ok && vs_bind_give_refs(vs_call_bind(f), lines.at, lines.count, out);
  free(lines.at);
  return ok ? VS_OK : VS_ERROR;
}

/* Sets region->node to a region with the loops of the outline, or to NULL if the outline has no loops. */
static bool region_of(vs_args *f, const vs_outline *o, vs_ref *region) {
  vs_ref *refs = vs_bind_scratch(f, (o->count + 1) * sizeof *refs);
  bool ok = refs != NULL;
  *region = (vs_ref){ 0 };
  for (size_t i = 0; ok && i < o->count; i++) {
    refs[i] = (vs_ref){ line_of(f, &o->loops[i]), NULL };
    ok = refs[i].node != NULL;
  }
  if (!ok || !o->count) return ok;
  region->node = vs_node_new(vs_call_store(f), VS_REGION, &(struct vs_region){ 0 }, refs, o->count);
  return vs_bind_keep(f, region->node);
}

/* Sets *out to a list with the region in which a plane intersects a closed mesh, or to the empty list if there is no
 * intersection. */
static vs_status solid_level(vs_args *f, const vs_mesh *m, vs_vec3 at, vs_vec3 normal, vs_value *out) {
  vs_outline o = { 0 };
  vs_error e = { 0 };
  vs_ref region;
  if (!vs_mesh_section(m, at, normal, &o, &e)) return vs_bind_error(vs_call_vm(f), &e);
  bool ok = region_of(f, &o, &region) && vs_bind_give_refs(vs_call_bind(f), &region, region.node != NULL, out);
  vs_outline_free(&o);
  return ok ? VS_OK : VS_ERROR;
}

/* Sets *out to a pair of heights above the plane: the least and the greatest of the object's corners. Sets *out to #f
 * if the object has no corners. */
static vs_status give_span(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 };
  vs_vec3 point = vs_arg_line(f, 1).at, up = vs_v3_unit(vs_arg_line(f, 1).direction);
  double low = INFINITY, high = -INFINITY;
  if (!vs_bend_triangles(vm, vs_arg_ref(f, 0), &m)) return vs_mesh_free(&m), VS_ERROR;
  for (size_t i = 0; i < m.triangle_count; i++)
    for (int k = 0; k < 3; k++) {
      double d = vs_v3_dot(up, vs_v3_sub(m.vertices[m.triangles[i][k]], point));
      low = fmin(low, d), high = fmax(high, d);
    }
  vs_mesh_free(&m);
  *out = VS_FALSE;
  return low <= high ? vs_cons(vm, vs_flonum(low), vs_flonum(high), out) : VS_OK;
}

/* (%contours o plane heights): returns a list for each height above the plane, from the last height to the first. The
 * list contains the section of a solid, which is a region, or the curves of a surface. Without heights, returns the
 * pair of the object's least and greatest height, or #f. */
vs_status vs_p_levels(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 };
  vs_vec3 point = vs_arg_line(f, 1).at, normal = vs_arg_line(f, 1).direction, up = vs_v3_unit(normal);
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_class class_ = (vs_class)vs_arg_ref(f, 0).node->class_;
  *out = VS_FALSE;
  if (class_ == VS_NOTHING) return VS_OK;
  if (class_ != VS_SOLID && class_ != VS_SURFACE)
    return vs_bind_refuse(f, "o", "a solid or a surface", vs_arg_value(f, 0));
  if (vs_arg_value(f, 2) == VS_FALSE) return give_span(f, out);
  VS_ROOTS(vm, r, 3); /* roots of the garbage collector: the result, the list for one height, the remaining heights */
  r[0] = VS_NIL, r[2] = vs_arg_value(f, 2);
  bool ok = vs_bend_triangles(vm, vs_arg_ref(f, 0), &m);
  for (; ok && vs_is_pair(r[2]); r[2] = vs_cdr(r[2])) {
    double d = 0;
    vs_bind_take_number(vm, vs_car(r[2]), &d);
    vs_vec3 at = vs_v3_add(point, vs_v3_scale(up, d));
    ok = (class_ == VS_SOLID ? solid_level : surface_level)(f, &m, at, normal, &r[1]) &&
         vs_cons(vm, r[1], r[0], &r[0]) && vs_poll(vm, (uint64_t)m.triangle_count);
  }
  vs_mesh_free(&m);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- slices ---- */

/* (%slices-normal plane): returns the plane's normal, of length 1. */
vs_status vs_p_slices_normal(vs_args *f, vs_value *out) {
  return vs_bind_give_vector(f, vs_v3_unit(vs_arg_line(f, 0).direction), out);
}


/* Sets *out to the list of curves of the outline `above` that lie within the outline o. The curves are moved into the
 * plane of o. */
static bool add_engraved(vs_args *f, const vs_outline *o, const vs_outline *above, double slack, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_area a = { 0 }, b = { 0 };
  vs_inner_lines lines = { 0 };
  vs_error e = { 0 };
  vs_ref *refs = NULL;
  bool ok = vs_area_of_outline(o, &o->frame, &a) && vs_area_of_outline(above, &o->frame, &b);
  if (!ok) vs_fail_memory(vm);
  ok = ok && (vs_area_inner_lines(&a, &b, slack, "slices", &lines, &e) || vs_bind_error(vm, &e));
  ok = ok && (refs = vs_bind_scratch(f, (lines.line_count + 1) * sizeof *refs)) != NULL;
  for (size_t l = 0, first = 0; ok && l < lines.line_count; first += lines.lines[l++].size) {
    vs_polyline p = { .count = lines.lines[l].size, .closed = lines.lines[l].closed };
    p.at = vs_bind_scratch(f, p.count * sizeof *p.at);
    for (size_t i = 0; p.at && i < p.count; i++)
      p.at[i] = vs_affine_point(&o->frame, vs_v3(lines.at[first + i].x, lines.at[first + i].y, 0));
    refs[l] = (vs_ref){ p.at ? line_of(f, &p) : NULL, NULL };
    ok = refs[l].node != NULL;
  }
  ok = ok && vs_bind_give_refs(vs_call_bind(f), refs, lines.line_count, out);
  vs_inner_lines_free(&lines);
  vs_area_free(&a), vs_area_free(&b);
  return ok;
}

/* (%largest-circle region): returns the centre and the radius of the largest circle within the region, or #f. */
vs_status vs_p_largest_circle(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_outline o = { 0 };
  vs_area a = { 0 };
  vs_error e = { 0 };
  vs_vec2 at = { 0, 0 };
  double radius = 0;
  *out = VS_FALSE;
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  const vs_node *n = vs_arg_ref(f, 0).node;
  if (n->class_ == VS_NOTHING) return VS_OK;
  vs_fineness facets = vs_bend_facets(vm, n);
  bool ok = vs_region_outline(n, &facets, &o, &e) || vs_bind_error(vm, &e);
  ok = ok && (!o.count || vs_area_of_outline(&o, &o.frame, &a) || vs_fail_memory(vm));
  ok = ok && (vs_area_middle(&a, "largest circles", &at, &radius, &e) || vs_bind_error(vm, &e));
  VS_ROOTS(vm, r, 1);
  if (ok && radius > 0)
    ok = vs_bind_give_point(f, vs_affine_point(&o.frame, vs_v3(at.x, at.y, 0)), &r[0]) &&
         vs_cons(vm, r[0], vs_flonum(radius), out);
  vs_area_free(&a);
  vs_outline_free(&o);
  return ok ? VS_OK : VS_ERROR;
}

/* (%slices o plane heights): heights are descending. Returns a pair for each height, from the lowest: the section at
 * this height, which is a region or #f, and the curves of the next higher section that lie within it. Without heights,
 * returns the pair of the object's least and greatest height, or #f. */
vs_status vs_p_slices(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_mesh m = { 0 };
  vs_outline above = { 0 };
  vs_error e = { 0 };
  vs_vec3 point = vs_arg_line(f, 1).at, normal = vs_arg_line(f, 1).direction, up = vs_v3_unit(normal);
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  *out = VS_FALSE;
  if (vs_arg_ref(f, 0).node->class_ == VS_NOTHING) return VS_OK;
  if (vs_arg_ref(f, 0).node->class_ != VS_SOLID) return vs_bind_refuse(f, "o", "a solid", vs_arg_value(f, 0));
  if (vs_arg_value(f, 2) == VS_FALSE) return give_span(f, out);
  VS_ROOTS(vm, r, 4); /* roots of the garbage collector: the result, a pair, the region in the pair, the remaining
                       * heights */
  r[0] = VS_NIL, r[3] = vs_arg_value(f, 2);
  bool ok = vs_bend_triangles(vm, vs_arg_ref(f, 0), &m);
  vs_bounds b = vs_mesh_bounds(&m);
  for (; ok && vs_is_pair(r[3]); r[3] = vs_cdr(r[3])) {
    vs_outline here = { 0 };
    vs_ref region;
    double d = 0;
    vs_bind_take_number(vm, vs_car(r[3]), &d);
    ok = vs_mesh_section(&m, vs_v3_add(point, vs_v3_scale(up, d)), normal, &here, &e) || vs_bind_error(vm, &e);
    ok = ok && region_of(f, &here, &region);
    r[1] = VS_NIL, r[2] = VS_FALSE;
    if (ok && here.count && above.count) ok = add_engraved(f, &here, &above, 1e-6 * vs_bounds_diagonal(&b), &r[1]);
    if (ok && region.node) ok = vs_bind_give_ref(vs_call_bind(f), region, &r[2]);
    ok = ok && vs_cons(vm, r[2], r[1], &r[1]) && vs_cons(vm, r[1], r[0], &r[0]) &&
         vs_poll(vm, (uint64_t)m.triangle_count);
    vs_outline_free(&above);
    above = here;
  }
  vs_outline_free(&above);
  vs_mesh_free(&m);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
