/* Evaluates planar expressions: converts curves, regions and sets of regions to paths and outlines, within a tolerance.
 *
 * The evaluation uses two stacks: of frames and of values. A frame is a node that waits for its children. A value is
 * the result of a child. Frames contain the placements above the node, so every curve is sampled in its final position,
 * and sets are computed in their final plane. */
#include <stdlib.h>

#include "geometry/plane/planar_evaluation.h"

#include "geometry/plane/curve.h"
#include "geometry/plane/areas.h"
#include "geometry/plane/offset.h"
#include "geometry/text/typeset.h"
#include "model/store/array.h"

typedef struct {
  bool filled;         /* true if the value is an outline (of a region); false if it is a path (of a curve) */
  vs_path path;
  vs_outline outline;
} vs_flat_value;

typedef struct {
  const vs_ref *ref;
  uint32_t next;       /* index of the node's next child to evaluate */
  size_t first;        /* index, in the stack of results, of the result of the node's first child */
  vs_affine map;       /* map from the coordinates of the node's children to the final position: the placements above
                        * the node */
  vs_affine after;     /* for an offset: map from the coordinates in which the offset is computed to the final
                        * position */
  vs_fineness facets;
} vs_flat_frame;

typedef struct {
  vs_flat_frame *frames;
  size_t frame_count, frame_room;
  vs_flat_value *values;
  size_t value_count, value_room;
  vs_error *error;
} vs_flat;

static void flat_drop(vs_flat_value *v) {
  vs_path_free(&v->path);
  vs_outline_free(&v->outline);
}

static bool flat_fail(vs_flat *f, const vs_ref *ref, const char *what) {
  return vs_error_set(f->error, VS_ERROR_MODEL, ref->origin, "%s, got %s", what,
                      vs_kind_get((vs_kind)ref->node->kind)->name);
}

static vs_flat_value *flat_push(vs_flat *f) {
  if (!VS_GROW(f->values, f->value_room, f->value_count + 1)) return vs_error_memory(f->error, NULL), NULL;
  f->values[f->value_count] = (vs_flat_value){ 0 };
  return &f->values[f->value_count++];
}

static bool flat_open(vs_flat *f, const vs_ref *ref, const vs_affine *map, const vs_fineness *facets) {
  if (!VS_GROW(f->frames, f->frame_room, f->frame_count + 1)) return vs_error_memory(f->error, NULL);
  f->frames[f->frame_count++] = (vs_flat_frame){ ref, 0, f->value_count, *map, vs_affine_identity(), *facets };
  return true;
}

/* Makes the outline of text node n. Its loops are already nested. The outline is empty if the text has only blanks. */
static bool text_outline(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_outline *out,
                         vs_error *e) {
  if (!vs_text_loops(n, placed, f, out, e)) return false;
  if (!out->count) return true;
  if (!vs_outline_plane(out, e)) return vs_outline_free(out), false;
  vs_outline_orient(out);
  return true;
}

/* Makes the outline of hull node n, which lies in a plane. */
static bool hull_outline(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_outline *out,
                         vs_error *e) {
  vs_fineness inner = vs_fineness_placed(f, placed);
  vs_cloud cloud = { 0 };
  *out = (vs_outline){ .loops = vs_zeros(1, sizeof *out->loops), .hole = vs_zeros(1, sizeof *out->hole), .count = 1 };
  bool ok = (out->loops && out->hole) || vs_error_memory(e, NULL);
  ok = ok && vs_hull_cloud(n, vs_planar_corners, &inner, &cloud, e) &&
       (vs_cloud_polygon(&cloud, &out->loops[0]) || vs_error_memory(e, NULL));
  for (size_t i = 0; ok && i < out->loops[0].count; i++)
    out->loops[0].at[i] = vs_affine_point(placed, out->loops[0].at[i]);
  ok = ok && vs_outline_plane(out, e);
  if (ok) vs_outline_orient(out);
  vs_cloud_free(&cloud);
  if (!ok) vs_outline_free(out);
  return ok;
}

static bool flat_fill(vs_flat *f, const vs_ref *ref, vs_flat_value *v);

/* Evaluates the node of ref: pushes the result of a leaf onto the stack of values, or pushes a node with children onto
 * the stack of frames, where it waits for the children's results. */
static bool flat_enter(vs_flat *f, const vs_ref *ref, vs_affine map, const vs_fineness *facets) {
  for (;;) {
    const vs_node *n = ref->node;
    switch ((vs_kind)n->kind) {
      case VS_TRANSFORM:
        map = vs_affine_multiply(&map, &VS_AS(transform, n)->matrix);
        ref = &n->children[0];
        continue;
      case VS_MATERIAL: case VS_LAYER: case VS_NATIVE: case VS_CUSTOM: case VS_PART: case VS_HIGHLIGHT: case VS_ONLY:
        if (!vs_node_is_wrapper(n)) break;
        ref = &n->children[0];
        continue;
      case VS_LINE: case VS_ARC: case VS_CIRCLE: case VS_SPLINE: {
        vs_flat_value *v = flat_push(f);
        return v && (vs_curve_leaf(n, &map, facets, &v->path) || vs_error_memory(f->error, ref->origin));
      }
      case VS_OFFSET: {
        vs_affine identity = vs_affine_identity(), place;
        vs_offset_exact exact;
        if (vs_offset_round(n, &place, &exact)) {
          vs_flat_value *v = flat_push(f);
          map = vs_affine_multiply(&map, &place);
          if (!v || !(vs_curve_round(&exact.arc, exact.circle, &map, facets, &v->path) ||
                      vs_error_memory(f->error, ref->origin)))
            return false;
          return n->class_ == VS_CURVE || flat_fill(f, ref, v);
        }
        /* The offset's distance refers to the coordinates of its node, so the offset is computed in these. */
        vs_fineness inner = vs_fineness_placed(facets, &map);
        return flat_open(f, ref, &identity, &inner) && (f->frames[f->frame_count - 1].after = map, true);
      }
      case VS_HULL: if (n->class_ != VS_REGION_CLASS) break; /* fall through */
      case VS_TEXT: {
        vs_flat_value *v = flat_push(f);
        if (v) v->filled = true;
        return v && (n->kind == VS_TEXT ? text_outline : hull_outline)(n, &map, facets, &v->outline, f->error);
      }
      case VS_JOIN: case VS_REGION: return flat_open(f, ref, &map, facets);
      case VS_XLINE: case VS_RAY: return flat_fail(f, ref, "expected a curve with two ends or none");
      case VS_SECTION: case VS_PROJECT: case VS_EDGES: /* not reached, because solids/resolve.c has replaced these kinds
                                                        * by curves and regions */
      case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE:
        if (n->class_ == VS_REGION_CLASS) return flat_open(f, ref, &map, facets);
        if (n->child_count == 1) {
          ref = &n->children[0];
          continue;
        }
        return flat_fail(f, ref,
                         n->class_ == VS_CURVE ? "expected one curve; join-curves joins several curves"
                                               : "expected a curve or a region");
#include "model/cases/shape_cases.def"
      case VS_SLICE:
      case VS_DEFORM:
      case VS_EMPTY:
      case VS_GHOST:
      case VS_POLYFACE_MESH:
#include "model/cases/body_cases.def"
      case VS_KIND_COUNT: break;
    }
    return flat_fail(f, ref, "expected a curve or a region");
  }
}

/* Joins the paths of `count` curves end to end into *out. Reverses a curve if its end is nearer to the end of the
 * previous curve than its start. */
static bool flat_join(vs_flat *f, const vs_ref *ref, vs_flat_value *values, size_t count, vs_flat_value *out) {
  vs_path *to = &out->path;
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    vs_path *p = &values[i].path;
    if (values[i].filled || p->closed || p->count < 2) {
      ok = vs_error_set(f->error, VS_ERROR_MODEL, ref->origin, "join-curves: an open curve is expected");
    } else if (!i) {
      if (count > 1 && values[1].path.count > 1) {
        const vs_path *next = &values[1].path;
        double ahead = fmin(vs_v3_length(vs_v3_sub(p->at[p->count - 1].at, next->at[0].at)),
                            vs_v3_length(vs_v3_sub(p->at[p->count - 1].at, next->at[next->count - 1].at)));
        double behind = fmin(vs_v3_length(vs_v3_sub(p->at[0].at, next->at[0].at)),
                             vs_v3_length(vs_v3_sub(p->at[0].at, next->at[next->count - 1].at)));
        if (behind < ahead) vs_path_reverse(p);
      }
      *to = *p;
      *p = (vs_path){ 0 };
    } else {
      vs_vec3 end = to->at[to->count - 1].at;
      if (vs_v3_length(vs_v3_sub(end, p->at[p->count - 1].at)) < vs_v3_length(vs_v3_sub(end, p->at[0].at)))
        vs_path_reverse(p);
      to->at[to->count - 1].leaving = p->at[0].leaving;
      for (size_t k = 1; ok && k < p->count; k++)
        ok =
            vs_path_add(to, p->at[k].at, p->at[k].arriving, p->at[k].leaving) || vs_error_memory(f->error, ref->origin);
    }
  }
  if (ok && VS_AS(join, ref->node)->closed && to->count > 2) {
    to->at[0].arriving = to->at[--to->count].arriving;
    to->closed = true;
  }
  if (ok) vs_path_measure(to);
  return ok;
}

/* Converts a closed path to the outline of the area inside it. */
static bool flat_fill(vs_flat *f, const vs_ref *ref, vs_flat_value *v) {
  vs_polyline loop = { 0 };
  if (v->filled) return true;
  if (!v->path.closed || v->path.count < 3)
    return vs_error_set(f->error, VS_ERROR_MODEL, ref->origin, "a curve that bounds a region must be closed");
  if (!vs_polyline_from_path(&v->path, &loop)) return vs_error_memory(f->error, ref->origin);
  v->filled = vs_outline_of_loops(&loop, 1, &v->outline, f->error);
  if (!v->filled && f->error && !f->error->origin) f->error->origin = ref->origin;
  return v->filled;
}

static bool flat_region(vs_flat *f, const vs_ref *ref, vs_flat_value *values, size_t count, vs_flat_value *out) {
  vs_polyline *loops = vs_zeros(count, sizeof *loops);
  bool ok = loops || vs_error_memory(f->error, ref->origin);
  for (size_t i = 0; ok && i < count; i++) {
    if (!values[i].path.closed || values[i].path.count < 3)
      ok = vs_error_set(f->error, VS_ERROR_MODEL, ref->origin, "make-region: the curves do not close");
    else ok = vs_polyline_from_path(&values[i].path, &loops[i]) || vs_error_memory(f->error, ref->origin);
  }
  if (ok)
    ok = count ? vs_outline_of_loops(loops, count, &out->outline, f->error)
               : vs_error_set(f->error, VS_ERROR_MODEL, ref->origin, "make-region: no curves");
  for (size_t i = 0; loops && i < count; i++) vs_polyline_free(&loops[i]);
  free(loops);
  out->filled = true;
  return ok;
}

bool vs_outline_coplanar(const vs_outline *a, const vs_outline *b) {
  vs_bounds box = vs_bounds_empty();
  double off = 0;
  for (size_t l = 0; l < a->count; l++)
    for (size_t i = 0; i < a->loops[l].count; i++) vs_bounds_add(&box, a->loops[l].at[i]);
  for (size_t l = 0; l < b->count; l++)
    for (size_t i = 0; i < b->loops[l].count; i++) {
      vs_bounds_add(&box, b->loops[l].at[i]);
      off = fmax(off, fabs(vs_v3_dot(a->normal, vs_v3_sub(b->loops[l].at[i], a->point))));
    }
  return !b->count || !a->count || off <= 1e-6 * vs_bounds_diagonal(&box);
}

static bool flat_combine(vs_flat *f, const vs_ref *ref, vs_flat_value *values, size_t count, vs_flat_value *out) {
  vs_area *areas = vs_zeros(count, sizeof *areas), made = { 0 };
  bool ok = areas || vs_error_memory(f->error, ref->origin);
  const vs_outline *plane = NULL; /* outline of the first operand that is not empty; the result of the set lies in the
                                   * plane of this outline */
  for (size_t i = 0; ok && i < count; i++) {
    ok = flat_fill(f, ref, &values[i]);
    if (ok && (!plane || (!plane->count && values[i].outline.count))) plane = &values[i].outline;
  }
  for (size_t i = 0; ok && i < count; i++) {
    const vs_outline *o = &values[i].outline;
    if (!vs_outline_coplanar(plane, o))
      ok = vs_error_set(
          f->error, VS_ERROR_MODEL, ref->origin,
          "regions must lie in one plane: one region lies in the plane through (xyz %.6g %.6g %.6g) with the normal "
          "(vxyz %.6g %.6g %.6g), another in the plane through (xyz %.6g %.6g %.6g) with (vxyz %.6g %.6g %.6g)",
          plane->point.x, plane->point.y, plane->point.z, plane->normal.x, plane->normal.y, plane->normal.z, o->point.x,
          o->point.y, o->point.z, o->normal.x, o->normal.y, o->normal.z);
    else ok = vs_area_of_outline(o, &plane->frame, &areas[i]) || vs_error_memory(f->error, ref->origin);
  }
  vs_area_operation operation = ref->node->kind == VS_UNION          ? VS_AREA_UNION
                                : ref->node->kind == VS_INTERSECTION ? VS_AREA_INTERSECTION
                                                                     : VS_AREA_DIFFERENCE;
  if (ok && count)
    ok = vs_area_combine(operation, areas, count, vs_kind_get((vs_kind)ref->node->kind)->name, &made, f->error);
  if (ok && count) ok = vs_area_outline(&made, &plane->frame, &out->outline) || vs_error_memory(f->error, ref->origin);
  out->filled = true;
  for (size_t i = 0; areas && i < count; i++) vs_area_free(&areas[i]);
  free(areas);
  vs_area_free(&made);
  return ok;
}

static void flat_place(vs_flat_value *v, const vs_affine *map) {
  for (size_t l = 0; l < v->outline.count; l++)
    for (size_t i = 0; i < v->outline.loops[l].count; i++)
      v->outline.loops[l].at[i] = vs_affine_point(map, v->outline.loops[l].at[i]);
  for (size_t i = 0; i < v->path.count; i++) {
    vs_path_point *p = &v->path.at[i];
    *p = (vs_path_point){ vs_affine_point(map, p->at), vs_v3_unit(vs_affine_vector(map, p->arriving)),
                          vs_v3_unit(vs_affine_vector(map, p->leaving)), 0 };
  }
  vs_path_measure(&v->path);
}

/* Maps the outline of a region by `map`, and computes its plane and holes again. Even if it is empty, its plane is
 * mapped. */
static bool flat_settle(vs_flat *f, const vs_affine *map, vs_flat_value *v) {
  flat_place(v, map);
  if (!v->filled) return true;
  if (v->outline.count) {
    vs_outline again;
    bool ok = vs_outline_of_loops(v->outline.loops, v->outline.count, &again, f->error);
    vs_outline_free(&v->outline);
    v->outline = again;
    return ok;
  }
  v->outline.point = vs_affine_point(map, v->outline.point);
  return true;
}

static bool flat_offset(vs_flat *f, const vs_flat_frame *at, vs_flat_value *in, vs_flat_value *out) {
  const struct vs_offset *x = VS_AS(offset, at->ref->node);
  vs_offset_corners corners = *x->corners == 'r'   ? VS_OFFSET_ROUND
                              : *x->corners == 's' ? VS_OFFSET_SQUARE
                              : *x->corners == 'f' ? VS_OFFSET_FACETS
                                                   : VS_OFFSET_MITRE;
  vs_offset_rule rule = { x->distance, corners, &at->facets, x->segments };
  vs_area area = { 0 }, made = { 0 };
  vs_polyline line = { 0 };
  bool closed = in->filled || in->path.closed, ok;
  vs_affine frame = vs_affine_identity();
  if (closed) {
    ok = flat_fill(f, at->ref, in);
    frame = in->outline.frame;
    ok = ok && (vs_area_of_outline(&in->outline, &frame, &area) || vs_error_memory(f->error, at->ref->origin));
    ok = ok && vs_area_offset(&area, &rule, &made, f->error);
    ok = ok && (vs_area_outline(&made, &frame, &out->outline) || vs_error_memory(f->error, at->ref->origin));
    out->filled = true;
    /* The result of an offset of a curve is a curve, not a region, if it has a single loop. */
    if (ok && at->ref->node->class_ == VS_CURVE && out->outline.count == 1) {
      ok = vs_path_of_polyline(&out->outline.loops[0], &out->path) || vs_error_memory(f->error, at->ref->origin);
      vs_outline_free(&out->outline);
      out->filled = false;
    }
  } else {
    size_t n = 0;
    if (in->path.count < 2)
      return vs_error_set(f->error, VS_ERROR_MODEL, at->ref->origin, "do-offset: the curve is a point");
    vs_vec2 *flat = vs_fresh(in->path.count, sizeof *flat);
    ok = (flat && vs_polyline_from_path(&in->path, &line)) || vs_error_memory(f->error, at->ref->origin);
    ok = ok && vs_line_frame(&line, &frame, f->error);
    vs_vec3 u = { frame.m[0][0], frame.m[1][0], frame.m[2][0] }, v = { frame.m[0][1], frame.m[1][1], frame.m[2][1] };
    for (size_t i = 0; ok && i < line.count; i++) {
      vs_vec3 d = vs_v3_sub(line.at[i], vs_v3(frame.m[0][3], frame.m[1][3], frame.m[2][3]));
      vs_vec2 p = { vs_v3_dot(d, u), vs_v3_dot(d, v) };
      if (!n || flat[n - 1].x != p.x || flat[n - 1].y != p.y) flat[n++] = p;
    }
    vs_polyline_free(&line);
    vs_open_line open = { .at = flat, .count = n };
    for (int k = 0; ok && k < 2; k++) {
      vs_vec3 way = k ? in->path.at[in->path.count - 1].arriving : in->path.at[0].leaving;
      double wx = vs_v3_dot(way, u), wy = vs_v3_dot(way, v), length = hypot(wx, wy);
      open.ways[k] = (vs_vec2){ wx / length, wy / length };
    }
    ok = ok && (n < 2 || vs_line_offset(&open, &rule, &line, f->error));
    for (size_t i = 0; ok && i < line.count; i++) line.at[i] = vs_affine_point(&frame, line.at[i]);
    ok = ok && (vs_path_of_polyline(&line, &out->path) || vs_error_memory(f->error, at->ref->origin));
    free(flat);
  }
  vs_polyline_free(&line);
  vs_area_free(&area);
  vs_area_free(&made);
  return ok && flat_settle(f, &at->after, out);
}

static bool flat_leave(vs_flat *f) {
  vs_flat_frame at = f->frames[--f->frame_count];
  vs_flat_value made = { 0 }, *values = f->values + at.first;
  size_t count = f->value_count - at.first;
  bool ok = false;
  if (at.ref->node->kind == VS_REGION) ok = flat_region(f, at.ref, values, count, &made);
  else if (at.ref->node->kind == VS_JOIN) ok = flat_join(f, at.ref, values, count, &made);
  else if (at.ref->node->kind == VS_OFFSET)
    ok = count ? flat_offset(f, &at, values, &made) : flat_fail(f, at.ref, "expected a curve or a region");
  else ok = flat_combine(f, at.ref, values, count, &made);
  while (f->value_count > at.first) flat_drop(&f->values[--f->value_count]);
  vs_flat_value *place = ok ? flat_push(f) : NULL;
  if (place) *place = made;
  else flat_drop(&made);
  return place != NULL;
}

static bool flat_evaluate(const vs_node *n, const vs_affine *placed, const vs_fineness *facets, vs_flat_value *out,
                          vs_error *e) {
  vs_flat f = { .error = e };
  vs_ref root = { (vs_node *)(uintptr_t)n, NULL };
  bool ok = flat_enter(&f, &root, *placed, facets);
  while (ok && f.frame_count) {
    vs_flat_frame *top = &f.frames[f.frame_count - 1];
    if (top->next < top->ref->node->child_count) {
      const vs_ref *child = &top->ref->node->children[top->next++];
      vs_fineness inner = top->facets;
      /* Skips an empty operand, because it neither adds nor removes anything. */
      if (child->node->class_ != VS_NOTHING) ok = flat_enter(&f, child, top->map, &inner);
    } else ok = flat_leave(&f);
  }
  if (ok) *out = f.values[--f.value_count];
  while (f.value_count) flat_drop(&f.values[--f.value_count]);
  free(f.values);
  free(f.frames);
  return ok;
}

/* ---- the functions of planar_evaluation.h and curve.h ---- */

bool vs_curve_path(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_path *out, vs_error *e) {
  vs_flat_value v = { 0 };
  *out = (vs_path){ 0 };
  if (!flat_evaluate(n, placed, f, &v, e)) return false;
  bool ok = !v.filled || v.outline.count == 1;
  if (!ok) vs_error_set(e, VS_ERROR_MODEL, NULL, "expected one curve, got a region of %zu", v.outline.count);
  else if (v.filled) ok = vs_path_of_polyline(&v.outline.loops[0], out) || vs_error_memory(e, NULL);
  else {
    *out = v.path;
    v.path = (vs_path){ 0 };
  }
  flat_drop(&v);
  return ok;
}

bool vs_region_outline(const vs_node *n, const vs_fineness *f, vs_outline *out, vs_error *e) {
  vs_flat_value v = { 0 };
  vs_affine identity = vs_affine_identity();
  *out = (vs_outline){ 0 };
  if (!flat_evaluate(n, &identity, f, &v, e)) return false;
  bool ok = true;
  if (!v.filled) {
    vs_polyline loop = { 0 };
    if (v.path.closed ? v.path.count < 3 : v.path.count < 2)
      ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "the curve is a point");
    else if (!vs_polyline_from_path(&v.path, &loop)) ok = vs_error_memory(e, NULL);
    else ok = vs_outline_of_loops(&loop, 1, out, e);
    vs_polyline_free(&loop);
  } else {
    *out = v.outline;
    v.outline = (vs_outline){ 0 };
  }
  flat_drop(&v);
  return ok;
}

bool vs_curve_sample(const vs_node *curve, const vs_fineness *f, vs_polyline *out, vs_error *e) {
  vs_path path = { 0 };
  vs_affine identity = vs_affine_identity();
  bool ok =
      vs_curve_path(curve, &identity, f, &path, e) && (vs_polyline_from_path(&path, out) || vs_error_memory(e, NULL));
  vs_path_free(&path);
  return ok;
}

bool vs_planar_corners(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e) {
  bool ok = true;
  if (n->class_ == VS_CURVE) {
    vs_polyline p = { 0 };
    ok = vs_curve_sample(n, f, &p, e) && vs_cloud_add_all(out, placed, p.at, p.count, e);
    vs_polyline_free(&p);
  } else if (n->class_ == VS_REGION_CLASS) {
    vs_outline o;
    if (!vs_region_outline(n, f, &o, e)) return false;
    for (size_t i = 0; ok && i < o.count; i++) ok = vs_cloud_add_all(out, placed, o.loops[i].at, o.loops[i].count, e);
    vs_outline_free(&o);
  } else if (n->class_ != VS_NOTHING) {
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "a flat hull of a surface is made by solids/resolve.c before");
  }
  return ok;
}
