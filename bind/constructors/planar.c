/* Implements procedures that make regions from curves, join curves, and compute curves and regions from other
 * objects. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/operations.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/workshop/outlines.h"
#include "geometry/plane/offset.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdio.h>
#include <stdlib.h>

#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "geometry/plane/areas.h"
#include "geometry/plane/curve_crossings.h"
#include "geometry/plane/join.h"
#include "geometry/plane/plane.h"
#include "model/store/array.h"

#define POINT(i) (f->arg[i].point)
#define NODE(i) (f->arg[i].ref.node)

static bool is_closed(const vs_node *n) { return n->flags & VS_NODE_CLOSED; }

static const char *point_text(vs_vec3 p, char out[112]) {
  char n[3][32];
  const double d[3] = { p.x, p.y, p.z };
  for (int i = 0; i < 3; i++) vs_bind_number_text(n[i], round(d[i] * 1e6) / 1e6 + 0.0);
  snprintf(out, 112, "(xyz %s %s %s)", n[0], n[1], n[2]);
  return out;
}

/* ---- joining curves end to end ---- */

/* In the list of curves that is argument 0, replaces each union of curves and each solid of edges by single curves. The
 * list is freed when the call ends. */
static vs_status each_apart(vs_args *f) {
  vs_arg given = f->arg[0];
  vs_ref *refs = given.refs.at, *all = NULL;
  size_t count = 0, room = 0;
  vs_status status = VS_OK;
  for (size_t i = 0; status && i < given.refs.count; i++) {
    vs_ref *parts = NULL;
    size_t n = 0;
    if (refs[i].node->flags & VS_NODE_UNRESOLVED && refs[i].node->kind != VS_XLINE && refs[i].node->kind != VS_RAY) {
      f->arg[0].ref = refs[i];
      status = vs_bind_resolve(f, 0);
      refs[i] = f->arg[0].ref;
      f->arg[0] = given;
    }
    if (status && !(vs_several_parts(refs[i], &parts, &n) && VS_GROW(all, room, count + n)))
      status = vs_fail_memory(f->vm);
    for (size_t k = 0; k < n; k++) {
      if (status) all[count++] = parts[k];
      if (!vs_bind_keep(f, vs_node_retain(parts[k].node))) status = VS_ERROR;
    }
    vs_several_free(parts, n);
  }
  if (status && count != given.refs.count) {
    vs_ref *kept = vs_bind_scratch(f, (count + 1) * sizeof *kept);
    if (kept && count) memcpy(kept, all, count * sizeof *kept);
    if (!kept) status = VS_ERROR;
    else f->arg[0].refs.at = kept, f->arg[0].refs.count = count;
  }
  free(all);
  return status;
}

/* Sets *out to the curves of the first argument: empty curves are omitted, and open curves are joined end to end. The
 * list is freed when the call ends. */
static vs_status joined(vs_args *f, vs_ref **out, size_t *count) {
  if (!each_apart(f)) return VS_ERROR;
  vs_ref *c = f->arg[0].refs.at;
  vs_error e = { 0 };
  size_t n = 0;
  for (size_t i = 0; i < f->arg[0].refs.count; i++) {
    if (vs_node_is_empty(c[i].node)) continue;
    if (c[i].node->kind == VS_XLINE || c[i].node->kind == VS_RAY)
      return vs_fail(f->vm, f->vm->sym.type, "curves must be finite; one curve is endless");
    c[n++] = c[i];
  }
  if (!vs_curves_join(f->store, c, &n, &e)) return vs_bind_error(f->vm, &e);
  *out = c;
  *count = n;
  vs_status status = VS_OK;
  for (size_t i = 0; i < n; i++)
    if (!vs_bind_keep(f, c[i].node)) status = VS_ERROR; /* if vs_bind_keep fails, it has released the node */
  return status;
}

static vs_status open_end(vs_args *f, const vs_node *n) {
  vs_vec3 start, end;
  double size;
  vs_error e = { 0 };
  char one[112], other[112];
  if (!vs_curve_ends(n, &start, &end, &size, &e)) return vs_bind_error(f->vm, &e);
  return vs_fail(f->vm, f->vm->sym.type,
                 "curves must be closed, or open ones that meet end to end; one curve is open: it runs from %s to %s, "
                 "where no other curve begins",
                 point_text(start, one), point_text(end, other));
}

vs_status vs_p_join_curves(vs_args *f, vs_value *out) {
  vs_ref *c;
  size_t n;
  for (size_t i = 0; i < f->arg[0].refs.count; i++)
    if (is_closed(f->arg[0].refs.at[i].node))
      return vs_fail(f->vm, f->vm->sym.type, "curves must be open; one is closed");
  if (!joined(f, &c, &n)) return VS_ERROR;
  if (n == 0) return vs_bind_empty(f, f->arg[0].refs.count ? "every curve is empty" : "there are no curves", out);
  if (n == 1) return vs_bind_give_node(f, vs_node_retain(c[0].node), out);
  vs_vec3 start, end;
  double size;
  vs_error e = { 0 };
  char one[112], other[112];
  if (!vs_curve_ends(c[0].node, &start, &end, &size, &e)) return vs_bind_error(f->vm, &e);
  return vs_fail(f->vm, f->vm->sym.type,
                 "curves must meet end to end; they make %lu separate curves, the first from %s to %s",
                 (unsigned long)n, point_text(start, one), point_text(end, other));
}

/* ---- regions ---- */

vs_status vs_p_make_region(vs_args *f, vs_value *out) {
  vs_ref *c;
  size_t n, kept = 0;
  vs_error e = { 0 };
  vs_shape_plane first = { .size = 0 }, here;
  char text[112];
  if (!joined(f, &c, &n)) return VS_ERROR;
  if (n == 0) return vs_bind_empty(f, f->arg[0].refs.count ? "every curve is empty" : "there are no curves", out);
  for (size_t i = 0; i < n; i++)
    if (!is_closed(c[i].node)) return open_end(f, c[i].node);
  for (size_t i = 0; i < n; i++) {
    vs_plane_count planes = vs_node_plane(c[i].node, &here);
    if (planes == VS_PLANE_NONE)
      return vs_fail(f->vm, f->vm->sym.type, "curves must lie in one plane; curve %lu leaves every plane",
                     (unsigned long)i + 1);
    if (planes == VS_PLANE_MANY) continue; /* all curves so far lie on one line, and enclose no area */
    if (kept && !vs_plane_same(&first, &here)) {
      char other[112];
      return vs_fail(
          f->vm, f->vm->sym.type,
          "curves must lie in one plane; curve 1 lies in the plane through %s, curve %lu in the plane through %s",
          point_text(first.point, text), (unsigned long)i + 1, point_text(here.point, other));
    }
    if (!kept) first = here;
    c[kept++] = c[i];
  }
  if (kept == 0) return vs_bind_empty(f, "the curves enclose no area", out);
  vs_crossing x;
  if (!vs_curves_cross(c, kept, &x, &e)) return vs_bind_error(f->vm, &e);
  if (x.found && x.a == x.b)
    return vs_fail(f->vm, f->vm->sym.range, "curves must not cross; curve %lu crosses itself at %s",
                   (unsigned long)x.a + 1, point_text(x.at, text));
  if (x.found)
    return vs_fail(f->vm, f->vm->sym.range,
                   "curves must not cross; curves %lu and %lu cross at %s; unite, subtract or intersect their regions",
                   (unsigned long)x.a + 1, (unsigned long)x.b + 1, point_text(x.at, text));
  return vs_bind_make(f, VS_REGION, &(struct vs_region){ 0 }, c, kept, out);
}

/* ---- infinite lines ---- */

vs_status vs_p_make_xline(vs_args *f, vs_value *out) {
  if (vs_v3_equal(POINT(0), POINT(1))) return vs_bind_empty(f, "p and q are the same point", out);
  return vs_bind_make(f, VS_XLINE, &(struct vs_xline){ .p = POINT(0), .q = POINT(1) }, NULL, 0, out);
}

vs_status vs_p_make_ray(vs_args *f, vs_value *out) {
  return vs_bind_make(f, VS_RAY, &(struct vs_ray){ .p = POINT(0), .v = POINT(1) }, NULL, 0, out);
}

/* ---- offsets ---- */

/* Sets *count to the number of closed curves in the offset curve n. If the offset curve is open, sets *count to 1, or
 * to 0 if nothing remains. */
static bool what_is_left(const vs_node *n, size_t *count, vs_error *e) {
  vs_bounds b;
  vs_offset_exact exact;
  vs_affine place;
  *count = 1;
  if (vs_offset_round(n, &place, &exact)) return true;
  if (!vs_node_bounds(n->children[0].node, &b, e)) return false;
  vs_fineness facets = { vs_fineness_tolerance(&b), 0 };
  if (is_closed(n->children[0].node)) {
    vs_outline o;
    if (!vs_region_outline(n, &facets, &o, e)) return false;
    *count = o.count;
    vs_outline_free(&o);
    return true;
  }
  vs_polyline p = { 0 };
  bool ok = vs_curve_sample(n, &facets, &p, e);
  *count = p.count > 1;
  vs_polyline_free(&p);
  return ok;
}

vs_status vs_p_do_offset(vs_args *f, vs_value *out) {
  static const char *const names[] = { "mitre", "round", "square", "facets" };
  const char *corners = f->key[0].given ? f->key[0].text.at : names[0];
  struct vs_offset d = { .distance = f->arg[1].real,
                         .segments = f->key[1].given ? (int32_t)f->key[1].integer : vs_bind_segments(f->vm) };
  vs_error e = { 0 };
  vs_shape_plane plane;
  size_t i = 0, left;
  vs_ref whole = f->arg[0].ref;
  while (i < 4 && strcmp(corners, names[i])) i++;
  if (i == 4) return vs_bind_refuse(f, "corners", "'mitre, 'round, 'square or 'facets", f->key[0].value);
  if (vs_node_is_empty(NODE(0))) return vs_bind_give_node(f, vs_node_retain(NODE(0)), out);
  if (vs_is_several(NODE(0)) && !(NODE(0)->flags & VS_NODE_CLOSED)) return vs_bind_each_part(f, vs_p_do_offset, out);
  if (NODE(0)->kind == VS_XLINE || NODE(0)->kind == VS_RAY)
    return vs_bind_refuse(f, "s", "a finite curve, a closed curve or a region", f->arg[0].value);
  if (vs_node_plane(NODE(0), &plane) == VS_PLANE_NONE)
    return vs_bind_refuse(f, "s", "a curve or region that lies in one plane", f->arg[0].value);
  vs_bounds box;
  if (!vs_bind_resolve(f, 0) || !vs_bind_uncrossed(f, f->arg[0].ref, "s")) return VS_ERROR;
  if (!vs_node_bounds(NODE(0), &box, &e)) return vs_bind_error(f->vm, &e);
  if (!(fabs(d.distance) + vs_bounds_diagonal(&box) < 1e100))
    return vs_fail(f->vm, f->vm->sym.range, "the numbers are too large: the curve and d must stay below 1e100");
  f->arg[0].ref = whole;
  if (d.distance == 0) return vs_bind_give_node(f, vs_node_retain(NODE(0)), out);
  if (!(d.corners = vs_store_text(f->store, names[i], strlen(names[i])))) return vs_fail_memory(f->vm);
  vs_node *made = vs_node_new(f->store, VS_OFFSET, &d, &f->arg[0].ref, 1);
  if (!vs_bind_keep(f, made)) return VS_ERROR;
  f->arg[0].ref.node = made;
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_node *plain = NODE(0);
  f->arg[0].ref = whole;
  if (plain->class_ == VS_NOTHING) left = 0;
  else if (!what_is_left(plain, &left, &e)) return vs_bind_error(f->vm, &e);
  if (left == 0) return vs_bind_empty(f, "no part of the profile lies so far inside", out);
  d.filled = left > 1 && made->class_ == VS_CURVE;
  return d.filled ? vs_bind_make(f, VS_OFFSET, &d, &f->arg[0].ref, 1, out)
                  : vs_bind_give_node(f, vs_node_retain(made), out);
}

/* ---- sections, shadows, edges ---- */

vs_status vs_p_do_section(vs_args *f, vs_value *out) {
  vs_bounds b;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  if (NODE(0)->class_ == VS_NOTHING) return vs_bind_empty(f, NULL, out);
  struct vs_section d = { .point = f->arg[1].line.at, .normal = f->arg[1].line.direction };
  if (!vs_node_bounds(NODE(0), &b, &e)) return vs_bind_error(f->vm, &e);
  double low = INFINITY, high = -INFINITY;
  for (int i = 0; i < 8; i++) {
    vs_vec3 p = { i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z };
    double side = vs_v3_dot(vs_v3_unit(d.normal), vs_v3_sub(p, d.point));
    low = fmin(low, side), high = fmax(high, side);
  }
  double slack = 1e-9 * vs_bounds_diagonal(&b);
  if (low > slack || high < -slack) return vs_bind_empty(f, "the plane does not meet the solid", out);
  return vs_bind_make(f, VS_SECTION, &d, &f->arg[0].ref, 1, out);
}

vs_status vs_p_do_project(vs_args *f, vs_value *out) {
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  if (NODE(0)->class_ == VS_NOTHING) return vs_bind_empty(f, NULL, out);
  struct vs_project d = { .point = f->arg[1].line.at, .normal = f->arg[1].line.direction };
  return vs_bind_make(f, VS_PROJECT, &d, &f->arg[0].ref, 1, out);
}

vs_status vs_p_do_edges(vs_args *f, vs_value *out) {
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  if (NODE(0)->class_ == VS_NOTHING) return vs_bind_empty(f, NULL, out);
  if (NODE(0)->class_ == VS_REGION_CLASS) {
    size_t n;
    if (!vs_bind_resolve(f, 0)) return VS_ERROR;
    vs_ref *curves = vs_bind_outlines(f, f->arg[0].ref, &n);
    if (!curves) return VS_ERROR;
    if (n == 1) return vs_bind_give_ref(f->bind, curves[0], out);
    return n ? vs_bind_make(f, VS_UNION, &(struct vs_union){ 0 }, curves, n, out) : vs_bind_empty(f, NULL, out);
  }
  if (NODE(0)->class_ != VS_SOLID && NODE(0)->class_ != VS_SURFACE)
    return vs_bind_refuse(f, "o", "a solid, a surface or a region", f->arg[0].value);
  return vs_bind_make(f, VS_EDGES, &(struct vs_edges){ 0 }, &f->arg[0].ref, 1, out);
}
