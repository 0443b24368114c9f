/* Implements operations on objects: booleans, placements, and objects that are made from a profile. */
#include "bind/constructors/operations.h"

#include <stdio.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/context.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/origins.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/records.h"
#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "geometry/plane/curve_crossings.h"
#include "geometry/plane/join.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/plane/plane.h"
#include "geometry/plane/slice.h"
#include "geometry/shapes/hull.h"
#include "geometry/tessellate.h"
#include "solids/resolve.h"

#define REAL(i) (f->arg[i].real)
#define POINT(i) (f->arg[i].point)
#define NODE(i) (f->arg[i].ref.node)

/* ---- boolean operations ---- */

static vs_status same(vs_args *f, vs_ref ref, vs_value *out) {
  return vs_bind_give_node(f, vs_node_retain(ref.node), out);
}

/* ---- boolean operations on areas: regions, and closed curves, which count as filled ---- */

typedef enum { AREAS_NOT, AREAS_APART, AREAS_ONE_PLANE } areas;

/* Classifies the objects: areas (regions and closed curves) in one plane, areas in several planes, or other objects.
 * Empty objects are ignored. If there are several planes, *a and *b are two of them that differ. */
static areas look_at_areas(const vs_ref *ref, size_t n, vs_shape_plane *a, vs_shape_plane *b) {
  bool any = false;
  for (size_t i = 0; i < n; i++) {
    const vs_node *o = ref[i].node;
    if (o->class_ == VS_NOTHING) continue;
    if (o->class_ != VS_REGION_CLASS && !(o->class_ == VS_CURVE && (o->flags & VS_NODE_CLOSED))) return AREAS_NOT;
  }
  for (size_t i = 0; i < n; i++) {
    vs_shape_plane here;
    if (ref[i].node->class_ == VS_NOTHING) continue;
    if (vs_node_plane(ref[i].node, &here) != VS_PLANE_ONE) return AREAS_NOT;
    if (!any) *a = here;
    else if (!vs_plane_same(a, &here)) return *b = here, AREAS_APART;
    any = true;
  }
  return any ? AREAS_ONE_PLANE : AREAS_NOT;
}

/* Refuses a closed curve that intersects itself. Regions need no test, since make-region has already made it. Open
 * curves may intersect themselves. */
vs_status vs_bind_uncrossed(vs_args *f, vs_ref ref, const char *what) {
  const vs_node *n = ref.node;
  vs_crossing x;
  vs_error e = { 0 };
  if (n->class_ != VS_CURVE || !(n->flags & VS_NODE_CLOSED) || n->flags & VS_NODE_UNRESOLVED) return VS_OK;
  while (n->kind == VS_TRANSFORM) n = n->children[0].node;
  if (n->kind == VS_CIRCLE || n->kind == VS_UNION) return VS_OK;
  if (!vs_curves_cross(&ref, 1, &x, &e)) return vs_bind_error(f->vm, &e);
  if (!x.found) return VS_OK;
  char at[3][32];
  const double p[] = { x.at.x, x.at.y, x.at.z };
  for (int i = 0; i < 3; i++) vs_bind_number_text(at[i], round(p[i] * 1e6) / 1e6 + 0.0);
  return vs_fail(f->vm, f->vm->sym.range, "%s must not cross itself; it does at (xyz %s %s %s)", what, at[0], at[1],
                 at[2]);
}

/* Replaces closed curves in the array by the regions that they enclose. */
static vs_status fill(vs_args *f, vs_ref *ref, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (ref[i].node->class_ == VS_CURVE) {
      if (!vs_bind_uncrossed(f, ref[i], "a closed curve that is taken as filled")) return VS_ERROR;
      vs_node *region = vs_node_new(f->store, VS_REGION, &(struct vs_region){ 0 }, &ref[i], 1);
      if (!vs_bind_keep(f, region)) return VS_ERROR;
      ref[i].node = region;
    }
  return VS_OK;
}

vs_status vs_bind_fill(vs_args *f, vs_ref *ref, size_t n) {
  vs_shape_plane a, b;
  return look_at_areas(ref, n, &a, &b) == AREAS_ONE_PLANE ? fill(f, ref, n) : VS_OK;
}

vs_status vs_p_unite(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].refs.count;
  if (n == 0) return vs_bind_empty(f, NULL, out);
  if (n == 1) return same(f, f->arg[0].refs.at[0], out);
  if (!vs_bind_fill(f, f->arg[0].refs.at, n)) return VS_ERROR;
  return vs_bind_make(f, VS_UNION, &(struct vs_union){ 0 }, f->arg[0].refs.at, n, out);
}

static void plane_text(const vs_shape_plane *p, char out[160]) {
  char n[6][32];
  /* The point of the plane that is nearest to the origin. It is the same for all figures in the plane. */
  vs_vec3 at = vs_v3_scale(p->normal, vs_v3_dot(p->normal, p->point));
  const double d[6] = { p->normal.x, p->normal.y, p->normal.z, at.x, at.y, at.z };
  for (int i = 0; i < 6; i++) vs_bind_number_text(n[i], round(d[i] * 1e6) / 1e6 + 0.0);
  snprintf(out, 160, "(make-plane (xyz %.20s %.20s %.20s) (vxyz %.20s %.20s %.20s))", n[3], n[4], n[5], n[0], n[1],
           n[2]);
}

/* Checks that the operands of intersect and subtract are either solids, or regions and closed curves. Replaces closed
 * curves in the array by the regions that they enclose. */
static vs_status filled(vs_args *f, vs_ref *ref, size_t n) {
  bool planar = false, solid = false;
  vs_shape_plane a, b;
  for (size_t i = 0; i < n; i++) {
    const vs_node *o = ref[i].node;
    if (o->class_ == VS_SOLID) solid = true;
    else if (o->class_ == VS_REGION_CLASS || (o->class_ == VS_CURVE && (o->flags & VS_NODE_CLOSED))) planar = true;
    else if (o->class_ != VS_NOTHING)
      return vs_fail(f->vm, f->vm->sym.type,
                     "objects must be solids, or regions and closed curves of one plane; one object is %s",
                     o->class_ == VS_CURVE && o->kind == VS_UNION ? "several curves"
                     : o->class_ == VS_CURVE                      ? "an open curve"
                     : o->class_ == VS_SURFACE                    ? "a surface"
                                                                  : "a union of solids with curves or surfaces");
  }
  if (planar && solid)
    return vs_fail(f->vm, f->vm->sym.type, "solids cannot be combined with flat regions: do-extrude the regions first");
  if (!planar) return VS_OK;
  switch (look_at_areas(ref, n, &a, &b)) {
    case AREAS_ONE_PLANE: return fill(f, ref, n);
    case AREAS_NOT:
      return vs_fail(
          f->vm, f->vm->sym.type,
          "objects must be solids, or regions and closed curves of one plane; one object does not lie in a plane");
    case AREAS_APART: break;
  }
  char one[160], other[160];
  plane_text(&a, one), plane_text(&b, other);
  return vs_fail(f->vm, f->vm->sym.type, "regions must lie in one plane; one region lies in %s, another in %s", one,
                 other);
}

vs_status vs_p_intersect(vs_args *f, vs_value *out) {
  vs_ref *ref = f->arg[0].refs.at;
  size_t n = f->arg[0].refs.count;
  if (n == 0)
    return vs_fail(f->vm, f->vm->sym.arity,
                   "needs at least one object: the intersection of nothing would be all of space");
  if (n == 1) return same(f, ref[0], out);
  if (!filled(f, ref, n)) return VS_ERROR;
  for (size_t i = 0; i < n; i++)
    if (vs_node_is_empty(ref[i].node)) return vs_bind_empty(f, NULL, out);
  return vs_bind_make(f, VS_INTERSECTION, &(struct vs_intersection){ 0 }, ref, n, out);
}

vs_status vs_p_subtract(vs_args *f, vs_value *out) {
  size_t n = f->arg[1].refs.count;
  if (n == 0 || vs_node_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  vs_ref *ref = vs_bind_scratch(f, (n + 1) * sizeof *ref);
  if (!ref) return VS_ERROR;
  ref[0] = f->arg[0].ref;
  memcpy(ref + 1, f->arg[1].refs.at, n * sizeof *ref);
  if (!filled(f, ref, n + 1)) return VS_ERROR;
  return vs_bind_make(f, VS_DIFFERENCE, &(struct vs_difference){ 0 }, ref, n + 1, out);
}

/* ---- placements ---- */

static vs_status placed(vs_args *f, vs_affine m, vs_value *out) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++)
      if (!isfinite(m.m[i][j]))
        return vs_fail(f->vm, f->vm->sym.range,
                       "the numbers are too large: the object would be infinitely far or large");
  if (vs_node_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  return vs_bind_make(f, VS_TRANSFORM, &(struct vs_transform){ .matrix = m }, &f->arg[0].ref, 1, out);
}

vs_status vs_p_do_move(vs_args *f, vs_value *out) { return placed(f, vs_affine_translation(POINT(1)), out); }
vs_status vs_p_do_rotate(vs_args *f, vs_value *out) {
  if (f->form == 0) return placed(f, vs_affine_rotation(f->arg[1].line.at, f->arg[1].line.direction, REAL(2)), out);
  return placed(f, vs_affine_rotation(POINT(1), POINT(2), REAL(3)), out);
}
vs_status vs_p_do_scale(vs_args *f, vs_value *out) {
  if (f->form == 0) return placed(f, vs_affine_scaling(vs_v3(0, 0, 0), POINT(1)), out);
  return placed(f, vs_affine_scaling(POINT(1), POINT(2)), out);
}
vs_status vs_p_do_mirror(vs_args *f, vs_value *out) {
  return placed(f, vs_affine_mirror(f->arg[1].line.at, f->arg[1].line.direction), out);
}
/* Slices an object with a plane. A solid is intersected with the half-space, a region with the half-plane in the
 * region's plane. A curve or surface becomes a node of kind SLICE. */
vs_status vs_p_do_slice(vs_args *f, vs_value *out) {
  struct vs_half_space h = { .point = f->arg[1].line.at, .normal = vs_v3_unit(f->arg[1].line.direction) };
  vs_ref pair[2] = { f->arg[0].ref };
  if (vs_node_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  vs_shape_plane flat;
  vs_bounds b;
  vs_error e = { 0 };
  if (NODE(0)->class_ == VS_REGION_CLASS && !(NODE(0)->flags & VS_NODE_UNRESOLVED) && NODE(0)->kind != VS_UNION &&
      vs_node_plane(NODE(0), &flat) == VS_PLANE_ONE) {
    if (!vs_node_bounds(NODE(0), &b, &e)) return vs_bind_error(f->vm, &e);
    return vs_bind_give_node(f, vs_slice_region(f->arg[0].ref, &flat, &b, h.point, h.normal), out);
  }
  if (NODE(0)->class_ != VS_SOLID)
    return vs_bind_make(f, VS_SLICE, &(struct vs_slice){ .point = h.point, .normal = h.normal }, pair, 1, out);
  pair[1] = (vs_ref){ vs_node_new(f->store, VS_HALF_SPACE, &h, NULL, 0), vs_bind_origin(f->bind) };
  if (!vs_bind_keep(f, pair[1].node)) return VS_ERROR;
  return vs_bind_make(f, VS_INTERSECTION, &(struct vs_intersection){ 0 }, pair, 2, out);
}

vs_status vs_p_do_transform(vs_args *f, vs_value *out) {
  double d = vs_affine_determinant(&f->arg[1].matrix);
  if (d == 0 || !isfinite(d))
    return vs_bind_refuse(f, "matrix", "a matrix that does not flatten space", f->arg[1].value);
  return placed(f, f->arg[1].matrix, out);
}

/* (do-resize o dx dy dz): scales the object so that its bounding box has these sizes; the box's least corner does not
 * move. If an axis has #f, its factor is that of the other axis that is given, or the geometric mean of the factors of
 * two given axes. */
vs_status vs_p_do_resize(vs_args *f, vs_value *out) {
  static const char *const names[] = { "o", "dx", "dy", "dz" };
  vs_bounds b;
  if (vs_node_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  vs_ref whole = f->arg[0].ref; /* the object to be scaled, as the user made it, before vs_bind_resolve replaces
                                 * sections and shadows in it by meshes */
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0) || !vs_bind_drawn_bounds(f, 0, &b)) return VS_ERROR;
  f->arg[0].ref = whole;
  if (vs_bounds_is_empty(&b)) return same(f, whole, out); /* the object has no points, such as an intersection of solids
                                                           * that have none in common */
  double size[3] = { b.max.x - b.min.x, b.max.y - b.min.y, b.max.z - b.min.z }, k[3], product = 1;
  int given = 0;
  for (int i = 0; i < 3; i++) {
    double want;
    k[i] = 0;
    if (f->arg[i + 1].value == VS_FALSE) continue;
    if (!vs_bind_take_number(f->vm, f->arg[i + 1].value, &want) || !(want > 0) || !isfinite(want))
      return vs_bind_refuse(f, names[i + 1], "positive, or #f", f->arg[i + 1].value);
    if (size[i] == 0)
      return vs_bind_refuse(f, names[i + 1], "#f: the object is flat in that direction", f->arg[i + 1].value);
    k[i] = want / size[i], product *= k[i], given++;
  }
  if (given == 0) return vs_fail(f->vm, f->vm->sym.range, "one of dx, dy, dz must be a number");
  double mean = given == 1 ? product : given == 2 ? sqrt(product) : 1;
  for (int i = 0; i < 3; i++)
    if (k[i] == 0) k[i] = mean;
  return placed(f, vs_affine_scaling(b.min, vs_v3(k[0], k[1], k[2])), out);
}

/* (hull o ...): creates the convex hull: a solid; a region if all points lie in one plane; a line if they lie on one
 * line. */
vs_status vs_p_hull(vs_args *f, vs_value *out) {
  vs_ref *child = f->arg[0].things.at;
  size_t count = 0;
  bool solid = false;
  for (size_t i = 0; i < f->arg[0].things.count; i++) {
    const vs_node *n = child[i].node;
    if (n->class_ == VS_NOTHING) continue;
    if (n->flags & VS_NODE_ENDLESS)
      return vs_fail(f->vm, f->vm->sym.range,
                     "objects must be finite: one of them is, or contains, an endless half-space");
    solid = solid || n->class_ == VS_SOLID || n->class_ == VS_MIXED;
    child[count++] = child[i];
  }
  vs_points *points = vs_points_new(f->store, f->arg[0].things.points, f->arg[0].things.point_count);
  struct vs_hull d = { .points = points, .dimension = 3 };
  vs_node *made = points ? vs_node_new(f->store, VS_HULL, &d, child, count) : NULL;
  if (points) vs_points_release(f->store, points);
  if (!vs_bind_keep(f, made)) return VS_ERROR;
  if (solid) return vs_bind_give_node(f, vs_node_retain(made), out);
  vs_bounds b;
  vs_cloud cloud = { 0 };
  vs_error e = { 0 };
  vs_status ok = VS_OK;
  /* whole: the hull node. Whether it is a solid, a region or a line is known only after sections and shadows in it are
   * computed. */
  vs_ref whole = { vs_node_retain(made), vs_bind_origin(f->bind) };
  vs_kernel_options options = { .job = vs_bind_job(f->vm) };
  if (!vs_resolve(&whole, 1, &(vs_fineness){ .tolerance = 0 }, &options, &e) || !vs_node_bounds(whole.node, &b, &e) ||
      !vs_hull_points(whole.node, &(vs_fineness){ .tolerance = vs_fineness_tolerance(&b) }, &cloud, &e))
    ok = vs_bind_error(f->vm, &e);
  else d.dimension = vs_cloud_dimension(&cloud);
  if (ok && d.dimension == 1) {
    vs_polyline ends = { 0 };
    vs_points *two = vs_cloud_polygon(&cloud, &ends) ? vs_points_new(f->store, ends.at, ends.count) : NULL;
    ok = two ? vs_bind_make(f, VS_LINE, &(struct vs_line){ .points = two }, NULL, 0, out) : vs_fail_memory(f->vm);
    if (two) vs_points_release(f->store, two);
    vs_polyline_free(&ends);
  } else if (ok && d.dimension < 1)
    ok = vs_bind_empty(f, d.dimension ? "there are no objects" : "all points are the same", out);
  else if (ok && d.dimension == 2) {
    d.points = VS_AS(hull, made)->points;
    bool planar = true; /* planar: whether the children can be used directly; a surface is replaced by its corners,
                         * since planar hulls use no meshes */
    for (size_t i = 0; i < count; i++)
      planar = planar && (child[i].node->class_ == VS_CURVE || child[i].node->class_ == VS_REGION_CLASS);
    vs_points *corners = planar ? NULL : vs_points_new(f->store, cloud.at, cloud.count);
    if (corners) d.points = corners;
    ok = !planar && !corners ? vs_fail_memory(f->vm)
                             : vs_bind_make(f, VS_HULL, &d, planar ? child : NULL, planar ? count : 0, out);
    if (corners) vs_points_release(f->store, corners);
  } else if (ok) ok = vs_bind_give_node(f, vs_node_retain(made), out);
  vs_cloud_free(&cloud);
  vs_node_release(whole.node);
  return ok;
}

/* ---- objects made from a profile ---- */

enum { MOST_TURNS = 1000 };

static vs_status check_twist(vs_args *f, double twist, vs_value got) {
  if (fabs(twist) <= 2 * 3.14159265358979 * MOST_TURNS) return VS_OK;
  return vs_bind_refuse(f, "twist", "at most 1000 turns (6283 radians)", got);
}

/* Checks a profile: a region or closed curve must lie in a plane. If its area is 0, sets *empty to true, and *out to
 * the empty object. */
static vs_status check_profile(vs_args *f, vs_shape_plane *plane, bool *empty, vs_value *out) {
  const vs_node *n = NODE(0);
  *empty = false;
  plane->normal = vs_v3(0, 0, 0); /* an open curve need not lie in a plane */
  if (n->class_ != VS_REGION_CLASS && !(n->flags & VS_NODE_CLOSED)) return VS_OK;
  switch (vs_node_plane(n, plane)) {
    case VS_PLANE_ONE: return vs_bind_uncrossed(f, f->arg[0].ref, "profile");
    case VS_PLANE_MANY: return *empty = true, vs_bind_empty(f, "the profile encloses no area", out);
    case VS_PLANE_NONE: break;
  }
  return vs_bind_refuse(f, "profile", "in one plane", f->arg[0].value);
}

/* Tests a curve by coarse samples. LEAVES_PLANE: sets *out to true if the curve leaves the plane through its start with
 * the given normal. LEAVES_LINE: sets *out to true if the curve leaves the line through its start in the given
 * direction. */
typedef enum { LEAVES_PLANE, LEAVES_LINE } leaving;
static vs_status leaves(vs_args *f, const vs_node *curve, leaving what, vs_vec3 direction, bool *out) {
  vs_fineness coarse = { 1e300, 8 };
  vs_polyline line = { 0 };
  vs_error e = { 0 };
  if (!vs_curve_sample(curve, &coarse, &line, &e)) return vs_polyline_free(&line), vs_bind_error(f->vm, &e);
  vs_vec3 d = vs_v3_unit(direction);
  double size = 0, away = 0;
  for (size_t i = 1; i < line.count; i++) {
    vs_vec3 v = vs_v3_sub(line.at[i], line.at[0]);
    size = fmax(size, vs_v3_length(v));
    away = fmax(away, what == LEAVES_PLANE ? fabs(vs_v3_dot(d, v)) : vs_v3_length(vs_v3_cross(d, v)));
  }
  vs_polyline_free(&line);
  *out = away > 1e-9 * size;
  return VS_OK;
}

/* Sets *out to true if the curve is one straight line, and *way to the vector from its start to its end. */
static vs_status is_straight(vs_args *f, const vs_node *curve, vs_vec3 *way, bool *out) {
  vs_fineness coarse = { .segments = 32 };
  vs_polyline line = { 0 };
  vs_error e = { 0 };
  bool bent = true;
  if (!vs_curve_sample(curve, &coarse, &line, &e)) return vs_polyline_free(&line), vs_bind_error(f->vm, &e);
  *out = line.count > 1 && !line.closed;
  if (*out) *way = vs_v3_sub(line.at[line.count - 1], line.at[0]);
  vs_polyline_free(&line);
  if (*out && !leaves(f, curve, LEAVES_LINE, *way, &bent)) return VS_ERROR;
  *out = *out && !bent;
  return VS_OK;
}

/* Returns false, with the error set, if the extrusion d cannot be tapered. */
static bool check_taper(vs_args *f, const struct vs_extrude *d) {
  if (d->twist != 0 || d->scale != 1) return vs_fail(f->vm, f->vm->sym.range,
      "give a taper, or #:twist and #:scale, not both"), false;
  if (NODE(0)->class_ == VS_CURVE && !(NODE(0)->flags & VS_NODE_CLOSED)) return vs_bind_refuse(f, "profile",
      "closed if a taper is given", f->arg[0].value), false;
  if (fabs(d->taper) >= 1.5707963) return vs_bind_refuse(f, "taper", "between -pi/2 and pi/2", f->arg[2].value), false;
  return true;
}

/* Checks that the extrusion's curve rises from the profile's plane along its whole length, since a taper depends on the
 * height above this plane. */
static bool check_rising(vs_args *f, const vs_node *curve, vs_vec3 normal) {
  vs_fineness coarse = { .segments = 64 };
  vs_polyline line = { 0 };
  vs_error e = { 0 };
  bool rising = true;
  if (!vs_curve_sample(curve, &coarse, &line, &e)) return vs_polyline_free(&line), vs_bind_error(f->vm, &e), false;
  double way = vs_v3_dot(vs_v3_sub(line.at[line.count - 1], line.at[0]), normal);
  for (size_t i = 1; i < line.count; i++) rising = rising && vs_v3_dot(vs_v3_sub(line.at[i], line.at[i - 1]),
      normal) * way > 0;
  rising = rising && !line.closed;
  vs_polyline_free(&line);
  if (!rising) vs_bind_refuse(f, "amount",
      "a curve that leads away from the profile's plane at every point, since a taper is given", f->arg[1].value);
  return rising;
}

vs_status vs_p_do_extrude(vs_args *f, vs_value *out) {
  struct vs_extrude d = { .taper = f->arg[2].given ? REAL(2) : 0,
                          .twist = f->key[0].given ? f->key[0].real : 0,
                          .scale = f->key[1].given ? f->key[1].real : 1,
                          .center = f->key[2].given && f->key[2].boolean };
  vs_ref child[2] = { f->arg[0].ref };
  bool path = vs_bind_take_ref(f->arg[1].value).node != NULL;
  vs_shape_plane plane;
  bool empty, leaving_it;
  if (vs_node_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  if (vs_is_several(NODE(0)) && !(NODE(0)->flags & VS_NODE_CLOSED)) return vs_bind_each_part(f, vs_p_do_extrude, out);
  if (!check_twist(f, d.twist, f->key[0].value) || !check_profile(f, &plane, &empty, out)) return VS_ERROR;
  if (empty) return VS_OK;
  bool flat = vs_v3_length(plane.normal) > 0, straight = false;
  vs_vec3 way = { 0, 0, 0 };
  if (path && d.taper != 0 && !vs_node_is_empty(f->arg[1].ref.node) &&
      !is_straight(f, f->arg[1].ref.node, &way, &straight))
    return VS_ERROR;
  if (path && !straight) {
    child[1] = f->arg[1].ref;
    if (vs_node_is_empty(child[1].node)) return vs_bind_empty(f, "the path is empty", out);
    if (d.taper != 0 && !check_taper(f, &d)) return VS_ERROR;
    if (d.twist != 0 || d.scale != 1)
      return vs_fail(f->vm, f->vm->sym.range,
                     "#:twist and #:scale need an amount that is a number or a gvector; along a curve use do-sweep");
    if (flat && !leaves(f, child[1].node, LEAVES_PLANE, plane.normal, &leaving_it)) return VS_ERROR;
    if (flat && !leaving_it)
      return vs_bind_refuse(f, "amount", "a curve that leaves the profile's plane", f->arg[1].value);
    if (d.taper != 0 && !check_rising(f, child[1].node, plane.normal)) return VS_ERROR;
    return vs_bind_make(f, VS_EXTRUDE, &d, child, 2, out);
  }
  d.along = straight ? way : vs_is_flat(f->arg[1].value, VS_FLAT_VECTOR) ? POINT(1) : vs_v3(0, 0, REAL(1));
  double length = vs_v3_length(d.along), steep;
  if (length == 0) return vs_bind_empty(f, "the amount is 0", out);
  if (d.taper != 0 && !check_taper(f, &d)) return VS_ERROR;
  if (!flat && !leaves(f, NODE(0), LEAVES_LINE, d.along, &leaving_it)) return VS_ERROR;
  if (!flat && !leaving_it) return vs_bind_empty(f, "a straight line is moved along itself", out);
  if (flat) {
    vs_vec3 n = plane.normal;
    steep = fabs(vs_v3_dot(n, d.along)) / length;
    if (steep < 1e-9) {
      char x[32], y[32], z[32];
      vs_bind_number_text(x, round(n.x * 1e6) / 1e6), vs_bind_number_text(y, round(n.y * 1e6) / 1e6),
          vs_bind_number_text(z, round(n.z * 1e6) / 1e6);
      /* The error suggests a correction: the user probably drew an arch in the ground plane, and gave the depth of its
       * wall as a gvector. */
      bool flat_arch = fabs(n.z) > .999999 && vs_is_flat(f->arg[1].value, VS_FLAT_VECTOR);
      const char *cure = "";
      if (flat_arch && fabs(d.along.x) > fabs(d.along.y)) cure = ", or make the profile with #:plane 'yz";
      else if (flat_arch)
        cure = ", or turn the profile upright: (do-rotate profile 'x pi/2), or make the profile with #:plane 'xz";
      return vs_fail(f->vm, f->vm->sym.range,
                     "the amount lies in the profile's own plane, whose normal is (vxyz %s %s %s); give a gvector that "
                     "leaves the plane%s",
                     x, y, z, cure);
    }
  }
  return vs_bind_make(f, VS_EXTRUDE, &d, child, 1, out);
}

vs_status vs_p_do_sweep(vs_args *f, vs_value *out) {
  struct vs_sweep d = { .twist = f->arg[2].given ? REAL(2) : 0,
                        .scale = f->arg[3].given ? REAL(3) : 1,
                        .has_base = f->key[0].given };
  if (d.has_base) d.base = f->key[0].point;
  if (f->key[1].given) d.up = f->key[1].point;
  vs_ref child[2] = { f->arg[0].ref, f->arg[1].ref };
  if (vs_node_is_empty(NODE(0))) return vs_bind_empty(f, "the profile is empty", out);
  if (vs_node_is_empty(NODE(1))) return vs_bind_empty(f, "the path is empty", out);
  vs_shape_plane plane;
  bool empty;
  if (!check_twist(f, d.twist, f->arg[2].value) || !check_profile(f, &plane, &empty, out)) return VS_ERROR;
  if (empty) return VS_OK;
  return vs_bind_make(f, VS_SWEEP, &d, child, 2, out);
}

vs_status vs_p_do_thicken(vs_args *f, vs_value *out) {
  struct vs_thicken d = { .width = REAL(1),
                          .segments = f->key[0].given ? (int32_t)f->key[0].integer : vs_bind_segments(f->vm) };
  if (vs_node_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  if (d.width == 0) return vs_bind_empty(f, "the width is 0", out);
  if (vs_is_several(NODE(0))) return vs_bind_each_part(f, vs_p_do_thicken, out);
  return vs_bind_make(f, VS_THICKEN, &d, &f->arg[0].ref, 1, out);
}
