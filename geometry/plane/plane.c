/* Finds the planes of curves and regions. A shape lies in a plane if the points that determine it do: corners, knots
 * with their tangents, the centre and axes of a circle. */
#include "geometry/plane/plane.h"

#include "geometry/frame.h"
#include "geometry/plane/planar_evaluation.h"

bool vs_plane_same(const vs_shape_plane *a, const vs_shape_plane *b) {
  vs_vec3 between = vs_v3_sub(b->point, a->point);
  double reach = a->size + b->size + vs_v3_length(between);
  return vs_v3_length(vs_v3_cross(a->normal, b->normal)) <= 1e-6 && fabs(vs_v3_dot(a->normal, between)) <= 1e-6 * reach;
}

/* Points that determine a plane: at[i] and more[i], mapped by `map`. The point farthest from the first point determines
 * a line; the point farthest from this line determines the plane. */
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

/* ---- the function of each kind ----
 *
 * A plane_rule is a function that finds the plane of nodes of one kind. It sets *found and returns true. If the node
 * has the plane of its first child, it multiplies p->map by the node's placement and returns false; the function of the
 * child's kind is then called. */

typedef bool plane_rule(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found);

static bool plane_none(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  (void)n, (void)p, (void)out;
  *found = VS_PLANE_NONE;
  return true;
}

static bool plane_child(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  (void)n, (void)p, (void)out, (void)found;
  return false;
}

static bool plane_transform(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  (void)out, (void)found;
  p->map = vs_affine_multiply(&p->map, &VS_AS(transform, n)->matrix);
  return false;
}

static bool plane_line(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  p->at = VS_AS(line, n)->points->at;
  p->count = VS_AS(line, n)->points->count;
  *found = plane_through_points(p, out);
  return true;
}

static bool plane_spline(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  const struct vs_spline *s = VS_AS(spline, n);
  p->at = s->points->at;
  p->count = s->points->count;
  *found = VS_PLANE_MANY;
  if (!p->count) return true;
  p->more[p->more_count++] = vs_v3_add(p->at[0], s->start_tangent);
  p->more[p->more_count++] = vs_v3_add(p->at[p->count - 1], s->end_tangent);
  *found = plane_through_points(p, out);
  return true;
}

/* Sets *out to the plane through three points. */
static bool plane_by(vs_plane_points *p, const vs_vec3 at[3], vs_shape_plane *out, vs_plane_count *found) {
  p->more_count = 3;
  for (int i = 0; i < 3; i++) p->more[i] = at[i];
  *found = plane_through_points(p, out);
  return true;
}

static bool plane_round(vs_vec3 c, double r, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  const vs_vec3 at[3] = { vs_v3_add(c, vs_v3(r, 0, 0)), vs_v3_add(c, vs_v3(0, r, 0)), vs_v3_add(c, vs_v3(-r, 0, 0)) };
  return plane_by(p, at, out, found);
}

static bool plane_circle(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  return plane_round(VS_AS(circle, n)->center, VS_AS(circle, n)->radius, p, out, found);
}

static bool plane_arc(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  return plane_round(VS_AS(arc, n)->center, VS_AS(arc, n)->radius, p, out, found);
}

static bool plane_text(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  vs_vec3 at = VS_AS(letters, n)->p;
  return plane_by(p, (const vs_vec3[]){ at, vs_v3_add(at, vs_v3(1, 0, 0)), vs_v3_add(at, vs_v3(0, 1, 0)) }, out, found);
}

/* Sets *out to the plane through the point `at`, perpendicular to the direction `normal`. */
static bool plane_across(vs_vec3 at, vs_vec3 normal, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  vs_affine frame = vs_frame_on_axis(at, normal);
  const vs_vec3 by[3] = { at, vs_v3_add(at, vs_v3(frame.m[0][0], frame.m[1][0], frame.m[2][0])),
                          vs_v3_add(at, vs_v3(frame.m[0][1], frame.m[1][1], frame.m[2][1])) };
  return plane_by(p, by, out, found);
}

static bool plane_section(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  return plane_across(VS_AS(section, n)->point, VS_AS(section, n)->normal, p, out, found);
}

static bool plane_project(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  return plane_across(VS_AS(project, n)->point, VS_AS(project, n)->normal, p, out, found);
}

static bool plane_hull(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  vs_fineness coarse = { 1, 12 };
  vs_outline o = { 0 };
  *found = VS_PLANE_NONE;
  if (n->class_ == VS_REGION_CLASS && vs_region_outline(n, &coarse, &o, NULL) && o.count) {
    p->at = o.loops[0].at;
    p->count = o.loops[0].count;
    *found = plane_through_points(p, out);
  }
  vs_outline_free(&o);
  return true;
}

/* Finds the plane of a join of curves from a coarse sample of it. */
static bool plane_join(const vs_node *n, vs_plane_points *p, vs_shape_plane *out, vs_plane_count *found) {
  vs_fineness coarse = { 1, 12 };
  vs_polyline line = { 0 };
  *found = VS_PLANE_NONE;
  if (vs_curve_sample(n, &coarse, &line, NULL)) {
    p->at = line.at;
    p->count = line.count;
    *found = p->count ? plane_through_points(p, out) : VS_PLANE_MANY;
  }
  vs_polyline_free(&line);
  return true;
}

static plane_rule *const plane_rules[VS_KIND_COUNT] = { /* plane_rules[kind]: function that finds the plane of a node of
                                                         * this kind; NULL for primitive solids, which have none */
#define VS_RULE(kind, plane, measure) [VS_##kind] = plane_##plane,
#include "geometry/kind_rules.def"
};

/* If a row of kind_rules.def (the rules of each kind of node) is missing, this constant does not compile. Each kind
 * except primitive solids must have a row. */
enum {
#define VS_RULE(kind, plane, measure) RULE_OF_##kind,
#include "geometry/kind_rules.def"
};
enum {
#define VS_NEEDED_SHAPE(upper) 0
#define VS_NEEDED_LEAF(upper) RULE_OF_##upper
#define VS_NEEDED_MADE(upper) RULE_OF_##upper
#define VS_NEEDED_PLACED(upper) RULE_OF_##upper
#define VS_NEEDED_WRAPPER(upper) RULE_OF_##upper
#define VS_NEEDED_SET(upper) RULE_OF_##upper
#define VS_KIND(upper, lower, name, class_, level, role, traits) NEEDED_BY_##upper = VS_NEEDED_##role(upper),
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
};

vs_plane_count vs_node_plane(const vs_node *n, vs_shape_plane *out) {
  vs_plane_points p = { .map = vs_affine_identity() };
  vs_plane_count found = VS_PLANE_NONE;
  for (;;) {
    plane_rule *rule = plane_rules[n->kind];
    if (!rule || rule(n, &p, out, &found)) return found;
    uint32_t first = 0;
    while (first < n->child_count && n->children[first].node->class_ == VS_NOTHING) first++;
    if (first == n->child_count) return VS_PLANE_NONE;
    n = n->children[first].node;
  }
}
