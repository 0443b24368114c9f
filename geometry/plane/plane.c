/* Owns planes of curves and regions. The points that fix a shape (corners, knots with their tangents, a circle's centre
 * and axes) lie in a plane exactly where the shape does. */
#include "geometry/plane/plane.h"

#include "geometry/frame.h"
#include "geometry/plane/planar_evaluation.h"

bool vs_plane_same(const vs_shape_plane *a, const vs_shape_plane *b) {
  vs_vec3 between = vs_v3_sub(b->point, a->point);
  double reach = a->size + b->size + vs_v3_length(between);
  return vs_v3_length(vs_v3_cross(a->normal, b->normal)) <= 1e-6 && fabs(vs_v3_dot(a->normal, between)) <= 1e-6 * reach;
}

/* A point at a time: the farthest from the first gives a direction, the farthest from that line the plane. at(i) as an
 * array under a map. */
typedef struct { const vs_vec3 *at; size_t count; vs_vec3 more[4]; size_t more_count; vs_affine map; } vs_plane_points;

static vs_vec3 plane_point(const vs_plane_points *p, size_t i) {
  return vs_affine_point(&p->map, i < p->count ? p->at[i] : p->more[i - p->count]);
}

static vs_plane_count plane_through_points(const vs_plane_points *p, vs_shape_plane *out) {
  size_t n = p->count + p->more_count;
  vs_vec3 o = plane_point(p, 0), along = { 0, 0, 0 }, normal = { 0, 0, 0 };
  *out = (vs_shape_plane){ .point = o };
  for (size_t i = 1; i < n; i++) {
    vs_vec3 d = vs_v3_sub(plane_point(p, i), o);
    if (vs_v3_length(d) > out->size) {
      out->size = vs_v3_length(d);
      along = d;
    }
  }
  for (size_t i = 1; i < n; i++) {
    vs_vec3 c = vs_v3_cross(along, vs_v3_sub(plane_point(p, i), o));
    if (vs_v3_dot(c, c) > vs_v3_dot(normal, normal)) normal = c;
  }
  if (!(vs_v3_length(normal) > 1e-9 * out->size * out->size)) return VS_PLANE_MANY;
  out->normal = vs_plane_up(normal);
  for (size_t i = 1; i < n; i++)
    if (!(fabs(vs_v3_dot(out->normal, vs_v3_sub(plane_point(p, i), o))) <= 1e-6 * out->size)) return VS_PLANE_NONE;
  return VS_PLANE_ONE;
}

vs_plane_count vs_node_plane(const vs_node *n, vs_shape_plane *out) {
  vs_plane_points p = { .map = vs_affine_identity() };
  for (;;) {
    switch ((vs_kind)n->kind) {
      case VS_LINE:
        p.at = VS_AS(line, n)->points->at;
        p.count = VS_AS(line, n)->points->count;
        return plane_through_points(&p, out);
      case VS_SPLINE: {
        const struct vs_spline *s = VS_AS(spline, n);
        p.at = s->points->at;
        p.count = s->points->count;
        if (!p.count) return VS_PLANE_MANY;
        p.more[p.more_count++] = vs_v3_add(p.at[0], s->start_tangent);
        p.more[p.more_count++] = vs_v3_add(p.at[p.count - 1], s->end_tangent);
        return plane_through_points(&p, out);
      }
      case VS_CIRCLE: case VS_ARC: {
        vs_vec3 c = n->kind == VS_CIRCLE ? VS_AS(circle, n)->center : VS_AS(arc, n)->center;
        double r = n->kind == VS_CIRCLE ? VS_AS(circle, n)->radius : VS_AS(arc, n)->radius;
        p.more_count = 3;
        p.more[0] = vs_v3_add(c, vs_v3(r, 0, 0));
        p.more[1] = vs_v3_add(c, vs_v3(0, r, 0));
        p.more[2] = vs_v3_add(c, vs_v3(-r, 0, 0));
        return plane_through_points(&p, out);
      }
      case VS_TRANSFORM: p.map = vs_affine_multiply(&p.map, &VS_AS(transform, n)->matrix); break;
      case VS_TEXT: {
        vs_vec3 at = VS_AS(letters, n)->p;
        p.more_count = 3;
        p.more[0] = at;
        p.more[1] = vs_v3_add(at, vs_v3(1, 0, 0));
        p.more[2] = vs_v3_add(at, vs_v3(0, 1, 0));
        return plane_through_points(&p, out);
      }
      case VS_SECTION: case VS_PROJECT: {
        vs_vec3 at = n->kind == VS_SECTION ? VS_AS(section, n)->point : VS_AS(project, n)->point;
        vs_affine frame =
            vs_frame_on_axis(at, n->kind == VS_SECTION ? VS_AS(section, n)->normal : VS_AS(project, n)->normal);
        p.more_count = 3;
        p.more[0] = at;
        p.more[1] = vs_v3_add(at, vs_v3(frame.m[0][0], frame.m[1][0], frame.m[2][0]));
        p.more[2] = vs_v3_add(at, vs_v3(frame.m[0][1], frame.m[1][1], frame.m[2][1]));
        return plane_through_points(&p, out);
      }
      case VS_MATERIAL:
      case VS_LAYER:
      case VS_REGION:
      case VS_UNION:
      case VS_INTERSECTION:
      case VS_DIFFERENCE:
      case VS_OFFSET:
      case VS_SLICE:
      case VS_NATIVE: case VS_CUSTOM: case VS_HIGHLIGHT: case VS_ONLY: break;
      case VS_HULL: {
        vs_fineness coarse = { 1, 12 };
        vs_outline o = { 0 };
        vs_plane_count found = VS_PLANE_NONE;
        if (n->class_ == VS_REGION_CLASS && vs_region_outline(n, &coarse, &o, NULL) && o.count) {
          p.at = o.loops[0].at;
          p.count = o.loops[0].count;
          found = plane_through_points(&p, out);
        }
        vs_outline_free(&o);
        return found;
      }
      case VS_JOIN: { /* points of the curve */
        vs_fineness coarse = { 1, 12 };
        vs_polyline line = { 0 };
        vs_plane_count found = VS_PLANE_NONE;
        if (vs_curve_sample(n, &coarse, &line, NULL)) {
          p.at = line.at;
          p.count = line.count;
          found = p.count ? plane_through_points(&p, out) : VS_PLANE_MANY;
        }
        vs_polyline_free(&line);
        return found;
      }
      case VS_XLINE: case VS_RAY: case VS_EDGES: case VS_DEFORM: return VS_PLANE_NONE;
#include "model/cases/shape_cases.def"
      case VS_EMPTY:
      case VS_GHOST:
      case VS_POLYFACE_MESH:
#include "model/cases/body_cases.def"
      case VS_KIND_COUNT: return VS_PLANE_NONE;
    }
    uint32_t first = 0;
    while (first < n->child_count && n->children[first].node->class_ == VS_NOTHING) first++;
    if (first == n->child_count) return VS_PLANE_NONE;
    n = n->children[first].node;
  }
}
