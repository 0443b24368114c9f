/* Owns the operations: booleans, placements, and what is made from a profile. */
#include "bind/bind.h"

#include "geometry/hull.h"
#include "geometry/measure.h"

#define REAL(i) (f->arg[i].real)
#define POINT(i) (f->arg[i].point)
#define NODE(i) (f->arg[i].ref.node)

/* ---- booleans ---- */

static vs_status same(vs_frame *f, vs_ref ref, vs_value *out) { return vs_bind_node(f, vs_node_retain(ref.node), out); }

vs_status vs_p_unite(vs_frame *f, vs_value *out) {
  size_t n = f->arg[0].refs.count;
  if (n == 0) return vs_bind_empty(f, NULL, out);
  if (n == 1) return same(f, f->arg[0].refs.at[0], out);
  return vs_bind_make(f, VS_UNION, &(struct vs_union){ 0 }, f->arg[0].refs.at, n, out);
}

/* What intersect and subtract take: solids, or regions and closed curves (taken as filled) alone. Curves become regions in place. */
static vs_status filled(vs_frame *f, vs_ref *ref, size_t n) {
  bool planar = false, solid = false;
  for (size_t i = 0; i < n; i++) {
    const vs_node *o = ref[i].node;
    if (o->class_ == VS_SOLID) solid = true;
    else if (o->class_ == VS_REGION_CLASS || (o->class_ == VS_CURVE && (o->flags & VS_NODE_CLOSED))) planar = true;
    else if (o->class_ != VS_NOTHING)
      return vs_fail(f->vm, f->vm->sym.type, "objects must be solids, or regions and closed curves of one plane; one is %s",
                     o->class_ == VS_CURVE ? "an open curve" : o->class_ == VS_SURFACE ? "a surface" : "a union of solids with curves or surfaces");
  }
  if (planar && solid) return vs_fail(f->vm, f->vm->sym.type, "solids and flat regions do not meet: do-extrude the regions first");
  for (size_t i = 0; planar && i < n; i++)
    if (ref[i].node->class_ == VS_CURVE) {
      vs_node *region = vs_node_new(f->bind->store, VS_REGION, &(struct vs_region){ 0 }, &ref[i], 1);
      if (!vs_bind_keep(f, region)) return VS_ERROR;
      ref[i].node = region;
    }
  return VS_OK;
}

vs_status vs_p_intersect(vs_frame *f, vs_value *out) {
  vs_ref *ref = f->arg[0].refs.at;
  size_t n = f->arg[0].refs.count;
  if (n == 0) return vs_fail(f->vm, f->vm->sym.arity, "needs at least one object: the intersection of nothing would be all of space");
  if (n == 1) return same(f, ref[0], out);
  if (!filled(f, ref, n)) return VS_ERROR;
  for (size_t i = 0; i < n; i++)
    if (vs_bind_is_empty(ref[i].node)) return vs_bind_empty(f, NULL, out);
  return vs_bind_make(f, VS_INTERSECTION, &(struct vs_intersection){ 0 }, ref, n, out);
}

vs_status vs_p_subtract(vs_frame *f, vs_value *out) {
  size_t n = f->arg[1].refs.count;
  if (n == 0 || vs_bind_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  vs_ref *ref = vs_bind_scratch(f, (n + 1) * sizeof *ref);
  if (!ref) return VS_ERROR;
  ref[0] = f->arg[0].ref;
  memcpy(ref + 1, f->arg[1].refs.at, n * sizeof *ref);
  if (!filled(f, ref, n + 1)) return VS_ERROR;
  return vs_bind_make(f, VS_DIFFERENCE, &(struct vs_difference){ 0 }, ref, n + 1, out);
}

/* ---- placements ---- */

static vs_status placed(vs_frame *f, vs_affine m, vs_value *out) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++)
      if (!isfinite(m.m[i][j])) return vs_fail(f->vm, f->vm->sym.range, "the numbers are too large: the object would be infinitely far or large");
  if (vs_bind_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  return vs_bind_make(f, VS_TRANSFORM, &(struct vs_transform){ .matrix = m }, &f->arg[0].ref, 1, out);
}

vs_status vs_p_do_move(vs_frame *f, vs_value *out) { return placed(f, vs_affine_translation(POINT(1)), out); }
vs_status vs_p_do_rotate(vs_frame *f, vs_value *out) {
  if (f->form == 0) return placed(f, vs_affine_rotation(f->arg[1].line.at, f->arg[1].line.direction, REAL(2)), out);
  return placed(f, vs_affine_rotation(POINT(1), POINT(2), REAL(3)), out);
}
vs_status vs_p_do_scale(vs_frame *f, vs_value *out) {
  if (f->form == 0) return placed(f, vs_affine_scaling(vs_v3(0, 0, 0), POINT(1)), out);
  return placed(f, vs_affine_scaling(POINT(1), POINT(2)), out);
}
vs_status vs_p_do_mirror(vs_frame *f, vs_value *out) { return placed(f, vs_affine_mirror(f->arg[1].line.at, f->arg[1].line.direction), out); }
/* Of solids: the intersection with the half-space. Of curves, regions and surfaces: a kind of its own. */
vs_status vs_p_do_slice(vs_frame *f, vs_value *out) {
  struct vs_half_space h = { .point = f->arg[1].line.at, .normal = vs_v3_unit(f->arg[1].line.direction) };
  vs_ref pair[2] = { f->arg[0].ref };
  if (vs_bind_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  if (NODE(0)->class_ != VS_SOLID) return vs_bind_refuse(f, "o", "a solid", f->arg[0].value);
  pair[1] = (vs_ref){ vs_node_new(f->bind->store, VS_HALF_SPACE, &h, NULL, 0), vs_bind_origin(f->bind) };
  if (!vs_bind_keep(f, pair[1].node)) return VS_ERROR;
  return vs_bind_make(f, VS_INTERSECTION, &(struct vs_intersection){ 0 }, pair, 2, out);
}

vs_status vs_p_do_transform(vs_frame *f, vs_value *out) {
  double d = vs_affine_determinant(&f->arg[1].matrix);
  if (d == 0 || !isfinite(d)) return vs_bind_refuse(f, "matrix", "a matrix that does not flatten space", f->arg[1].value);
  return placed(f, f->arg[1].matrix, out);
}

/* (do-resize o dx dy dz): the bounds get these sizes, the least corner stays; #f keeps the proportion of the others' mean */
vs_status vs_p_do_resize(vs_frame *f, vs_value *out) {
  static const char *const names[] = { "o", "dx", "dy", "dz" };
  vs_bounds b;
  vs_error e = { 0 };
  if (vs_bind_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  if (!vs_node_bounds(NODE(0), &b, &e)) return vs_bind_error(f, &e);
  double size[3] = { b.max.x - b.min.x, b.max.y - b.min.y, b.max.z - b.min.z }, k[3], product = 1;
  int given = 0;
  for (int i = 0; i < 3; i++) {
    double want;
    k[i] = 0;
    if (f->arg[i + 1].value == VS_FALSE) continue;
    if (!vs_bind_number(f->vm, f->arg[i + 1].value, &want) || !(want > 0) || !isfinite(want)) return vs_bind_refuse(f, names[i + 1], "positive, or #f", f->arg[i + 1].value);
    if (size[i] == 0) return vs_bind_refuse(f, names[i + 1], "#f: the object is flat in that direction", f->arg[i + 1].value);
    k[i] = want / size[i], product *= k[i], given++;
  }
  if (given == 0) return vs_fail(f->vm, f->vm->sym.range, "one of dx, dy, dz must be a number");
  double mean = given == 1 ? product : given == 2 ? sqrt(product) : 1;
  for (int i = 0; i < 3; i++)
    if (k[i] == 0) k[i] = mean;
  return placed(f, vs_affine_scaling(b.min, vs_v3(k[0], k[1], k[2])), out);
}

/* (hull o ...): of what spans space, a solid; of what lies in one plane, a region; on one line, a line */
vs_status vs_p_hull(vs_frame *f, vs_value *out) {
  vs_ref *child = f->arg[0].things.at;
  size_t count = 0;
  bool solid = false;
  for (size_t i = 0; i < f->arg[0].things.count; i++) {
    const vs_node *n = child[i].node;
    if (n->class_ == VS_NOTHING) continue;
    if (n->flags & VS_NODE_ENDLESS) return vs_fail(f->vm, f->vm->sym.range, "things must be finite: one of them is a half-space, or a set of them, without an end");
    solid = solid || n->class_ == VS_SOLID || n->class_ == VS_MIXED;
    child[count++] = child[i];
  }
  vs_points *points = vs_points_new(f->bind->store, f->arg[0].things.points, f->arg[0].things.point_count);
  struct vs_hull d = { .points = points, .dimension = 3 };
  vs_node *made = points ? vs_node_new(f->bind->store, VS_HULL, &d, child, count) : NULL;
  if (points) vs_points_release(f->bind->store, points);
  if (!vs_bind_keep(f, made)) return VS_ERROR;
  if (solid) return vs_bind_node(f, vs_node_retain(made), out);
  vs_bounds b;
  vs_cloud cloud = { 0 };
  vs_error e = { 0 };
  vs_status ok = VS_OK;
  if (!vs_node_bounds(made, &b, &e) || !vs_hull_cloud(made, &(vs_facets){ .tolerance = vs_facets_tolerance(&b) }, &cloud, &e)) ok = vs_bind_error(f, &e);
  else d.dimension = vs_cloud_dimension(&cloud);
  if (ok && d.dimension == 1) {
    vs_polyline ends = { 0 };
    vs_points *two = vs_cloud_polygon(&cloud, &ends) ? vs_points_new(f->bind->store, ends.at, ends.count) : NULL;
    ok = two ? vs_bind_make(f, VS_LINE, &(struct vs_line){ .points = two }, NULL, 0, out) : vs_fail_memory(f->vm);
    if (two) vs_points_release(f->bind->store, two);
    vs_polyline_free(&ends);
  } else if (ok && d.dimension < 1) ok = vs_bind_empty(f, d.dimension ? "there is nothing to hold" : "all of it is one point", out);
  else if (ok && d.dimension == 2) {
    d.points = VS_AS(hull, made)->points;
    ok = vs_bind_make(f, VS_HULL, &d, child, count, out);
  } else if (ok) ok = vs_bind_node(f, vs_node_retain(made), out);
  vs_cloud_free(&cloud);
  return ok;
}

/* ---- from a profile ---- */

/* The direction that a flat profile faces, by what is cheap to know of it; false: not known here (geometry/ will look at it). */
static bool faces(const vs_node *n, vs_vec3 *normal) {
  vs_affine at = vs_affine_identity();
  for (;;) switch ((vs_kind)n->kind) {
    case VS_CIRCLE: case VS_ARC: case VS_TEXT: *normal = vs_v3(0, 0, 1); goto found;
    case VS_LINE: {
      const vs_points *p = VS_AS(line, n)->points;
      *normal = vs_v3(0, 0, 0);
      for (uint32_t i = 1; i + 1 < p->count; i++)
        *normal = vs_v3_add(*normal, vs_v3_cross(vs_v3_sub(p->at[i], p->at[0]), vs_v3_sub(p->at[i + 1], p->at[0])));
      if (vs_v3_equal(*normal, vs_v3(0, 0, 0))) return false;
      goto found;
    }
    case VS_TRANSFORM: at = vs_affine_multiply(&at, &VS_AS(transform, n)->matrix); n = n->children[0].node; continue;
    case VS_REGION: case VS_MATERIAL: case VS_LAYER: n = n->children[0].node; continue;
    case VS_E_CONE: case VS_SUPERELLIPSOID: case VS_HALF_SPACE: case VS_HEIGHT_FIELD: case VS_SLICE: case VS_HULL:
    case VS_EMPTY: case VS_SPLINE: case VS_BOX: case VS_WEDGE: case VS_SPHERE: case VS_CYLINDER: case VS_CONE: case VS_CUT_CONE: case VS_PYRAMID:
    case VS_REVOLVE: case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: case VS_GRID_MESH: case VS_GRID_SURFACE:
    case VS_TORUS: case VS_POLYFACE_MESH: case VS_EXTRUDE: case VS_SWEEP: case VS_THICKEN: case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE:
    case VS_KIND_COUNT: return false;
  }
found:;
  vs_affine inverse; /* normals go by the inverse transposed */
  if (!vs_affine_invert(&at, &inverse)) return false;
  vs_vec3 v = *normal;
  *normal = vs_v3(inverse.m[0][0] * v.x + inverse.m[1][0] * v.y + inverse.m[2][0] * v.z, inverse.m[0][1] * v.x + inverse.m[1][1] * v.y + inverse.m[2][1] * v.z,
                  inverse.m[0][2] * v.x + inverse.m[1][2] * v.y + inverse.m[2][2] * v.z);
  return true;
}

vs_status vs_p_do_extrude(vs_frame *f, vs_value *out) {
  struct vs_extrude d = { .taper = f->arg[2].given ? REAL(2) : 0, .twist = f->key[0].given ? f->key[0].real : 0, .scale = f->key[1].given ? f->key[1].real : 1,
                          .center = f->key[2].given && f->key[2].boolean };
  vs_ref child[2] = { f->arg[0].ref };
  bool path = vs_bind_shape(f->arg[1].value) != NULL;
  if (vs_bind_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  if (path) {
    child[1] = f->arg[1].ref;
    if (vs_bind_is_empty(child[1].node)) return vs_bind_empty(f, "the path is empty", out);
    if (d.taper != 0) return vs_fail(f->vm, f->vm->sym.range, "a taper goes with a number or a gvector, not with a curve");
    if (d.twist != 0 || d.scale != 1) return vs_fail(f->vm, f->vm->sym.range, "#:twist and #:scale go with a number or a gvector; along a curve use do-sweep");
    return vs_bind_make(f, VS_EXTRUDE, &d, child, 2, out);
  }
  d.along = vs_is_flat(f->arg[1].value, VS_FLAT_VECTOR) ? POINT(1) : vs_v3(0, 0, REAL(1));
  double length = vs_v3_length(d.along), steep;
  if (length == 0) return vs_bind_empty(f, "the amount is 0", out);
  if (fabs(d.taper) >= 1.5707963) return vs_bind_refuse(f, "taper", "between -pi/2 and pi/2", f->arg[2].value);
  vs_vec3 n;
  if (faces(NODE(0), &n) && (NODE(0)->class_ == VS_REGION_CLASS || NODE(0)->flags & VS_NODE_CLOSED)) {
    steep = fabs(vs_v3_dot(n, d.along)) / (vs_v3_length(n) * length);
    if (steep < 1e-9) {
      char x[32], y[32], z[32];
      double l = vs_v3_length(n);
      vs_bind_number_text(x, round(n.x / l * 1e6) / 1e6), vs_bind_number_text(y, round(n.y / l * 1e6) / 1e6), vs_bind_number_text(z, round(n.z / l * 1e6) / 1e6);
      return vs_fail(f->vm, f->vm->sym.range, "the profile would be moved within its own plane, whose normal is (vxyz %s %s %s); give a gvector that leaves it", x, y, z);
    }
  }
  return vs_bind_make(f, VS_EXTRUDE, &d, child, 1, out);
}

vs_status vs_p_do_sweep(vs_frame *f, vs_value *out) {
  struct vs_sweep d = { .twist = f->arg[2].given ? REAL(2) : 0, .scale = f->arg[3].given ? REAL(3) : 1, .has_base = f->key[0].given };
  if (d.has_base) d.base = f->key[0].point;
  vs_ref child[2] = { f->arg[0].ref, f->arg[1].ref };
  if (vs_bind_is_empty(NODE(0))) return vs_bind_empty(f, "the profile is empty", out);
  if (vs_bind_is_empty(NODE(1))) return vs_bind_empty(f, "the path is empty", out);
  return vs_bind_make(f, VS_SWEEP, &d, child, 2, out);
}

vs_status vs_p_do_thicken(vs_frame *f, vs_value *out) {
  struct vs_thicken d = { .width = REAL(1), .segments = f->key[0].given ? (int32_t)f->key[0].integer : vs_bind_segments(f->bind) };
  if (vs_bind_is_empty(NODE(0))) return same(f, f->arg[0].ref, out);
  if (d.width == 0) return vs_bind_empty(f, "the width is 0", out);
  return vs_bind_make(f, VS_THICKEN, &d, &f->arg[0].ref, 1, out);
}
