/* Measures nodes by formula: volume, area, length, centroid. */
#include "geometry/measure/node_measures.h"

#include <stdlib.h>

#include "geometry/plane/curve.h"
#include "geometry/plane/offset.h"
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape.h"
#include "geometry/measure/moments.h"
#include "geometry/plane/areas.h"
#include "geometry/profiles/revolve.h"
#include "geometry/plane/planar_evaluation.h"
#include "model/store/array.h"
#include "model/walk.h"

static const double pi = 3.14159265358979323846;

/* Returns the circumference of a circle of radius r after the map a, which may make it an ellipse. The half axes of the
 * ellipse are the singular values of the map in the circle's plane, times r. */
static double measure_placed_circle(const vs_affine *a, double r) {
  vs_vec3 u = { a->m[0][0], a->m[1][0], a->m[2][0] }, v = { a->m[0][1], a->m[1][1], a->m[2][1] };
  double p = vs_v3_dot(u, u), q = vs_v3_dot(v, v), s = vs_v3_dot(u, v), mean = (p + q) / 2, off = hypot((p - q) / 2, s),
         most = sqrt(mean + off);
  return vs_ellipse_length(r * most, most > 0 ? r * vs_v3_length(vs_v3_cross(u, v)) / most : 0);
}

static bool measure_samples(const vs_node *n, const vs_affine *placed, vs_measure *m, vs_error *e) {
  vs_bounds b;
  vs_path path = { 0 };
  vs_vec3 sum = { 0, 0, 0 };
  if (!vs_node_bounds(n, &b, e)) return false;
  vs_fineness f = { fmax(vs_bounds_diagonal(&b) * 1e-8, 1e-300), 0 };
  if (!vs_curve_path(n, placed, &f, &path, e)) {
    vs_path_free(&path);
    return false;
  }
  for (size_t i = 0; i + (path.closed ? 0 : 1) < path.count; i++) {
    vs_vec3 p = path.at[i].at, q = path.at[i + 1 < path.count ? i + 1 : 0].at;
    double d = vs_v3_length(vs_v3_sub(q, p));
    sum = vs_v3_add(sum, vs_v3_scale(vs_v3_add(p, q), d / 2));
  }
  m->length = path.length;
  m->centroid = path.length > 0 ? vs_v3_scale(sum, 1 / path.length) : path.count ? path.at[0].at : sum;
  m->known = true;
  vs_path_free(&path);
  return true;
}

static bool measure_revolution(const vs_node *n, vs_measure *m, vs_error *e) {
  vs_bounds profile;
  if (!vs_node_bounds(n->children[0].node, &profile, e)) return false;
  vs_fineness f = { fmax(vs_bounds_diagonal(&profile) * 1e-7, 1e-300), 0 };
  return vs_revolve_measure(n, &f, m, e);
}

static bool measure_outline(const vs_node *n, vs_measure *m, vs_error *e) {
  vs_bounds b;
  vs_outline o;
  if (!vs_node_bounds(n, &b, e)) return false;
  vs_fineness f = { fmax(vs_bounds_diagonal(&b) * 1e-7, 1e-300), 0 };
  if (!vs_region_outline(n, &f, &o, e)) return false;
  bool exact, ok = vs_region_moments(n, &o, &m->area, &m->centroid, &exact, e);
  if (ok && !exact) m->area = o.count ? vs_outline_measure(&o, &m->centroid) : 0;
  m->known = m->area_known = true;
  vs_outline_free(&o);
  return ok;
}

/* Sets m->length to the sum of the lengths of the curves in a set. Each curve is measured with its own placement.
 * Returns false on failure. */
static bool measure_curves(const vs_node *n, vs_measure *m, vs_error *e) {
  vs_walk *w = vs_walk_new(n->store, (vs_ref){ (vs_node *)(uintptr_t)n, NULL });
  vs_affine *placed = NULL;
  size_t room = 0, depth;
  vs_ref at;
  vs_vec3 sum = { 0, 0, 0 };
  bool ok = w || vs_error_memory(e, NULL);
  *m = (vs_measure){ .known = true };
  for (vs_walk_event ev; ok && (ev = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE;) {
    if (ev == VS_WALK_LEAVE) continue;
    if (ev == VS_WALK_FAILED || !VS_GROW(placed, room, depth + 1)) {
      ok = vs_error_memory(e, NULL);
      break;
    }
    placed[depth] = depth ? placed[depth - 1] : vs_affine_identity();
    if (at.node->kind == VS_TRANSFORM)
      placed[depth] = vs_affine_multiply(&placed[depth], &VS_AS(transform, at.node)->matrix);
    if (vs_node_is_around(at.node) ||
        at.node->kind == VS_UNION)
      continue;
    vs_walk_skip(w);
    vs_measure one;
    vs_node *leaf =
        vs_node_new(at.node->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = placed[depth] }, &at, 1);
    ok = leaf ? vs_node_measure(leaf, &one, e) : vs_error_memory(e, NULL);
    vs_node_release(leaf);
    if (!ok) break;
    m->length += one.length;
    sum = vs_v3_add(sum, vs_v3_scale(one.centroid, one.length));
  }
  m->centroid = m->length > 0 ? vs_v3_scale(sum, 1 / m->length) : sum;
  vs_walk_free(w);
  free(placed);
  return ok;
}

/* Sets *straight to true if the curve is one straight line; *along is then the vector from its start to its end. */
static bool measure_straight(const vs_node *curve, vs_vec3 *along, bool *straight, vs_error *e) {
  vs_affine identity = vs_affine_identity();
  vs_path path = { 0 };
  *straight = vs_curve_is_straight(curve);
  if (!*straight) return true;
  bool ok = vs_curve_path(curve, &identity, &(vs_fineness){ 1, 0 }, &path, e);
  *straight = ok && path.count == 2 && !path.closed;
  if (*straight) *along = vs_v3_sub(path.at[1].at, path.at[0].at);
  vs_path_free(&path);
  return ok;
}

/* Measures an extrusion along a vector. Sets *known to true if there is a formula. Returns false on failure. */
static bool measure_extrusion(const vs_node *n, vs_measure *m, bool *known, vs_error *e) {
  const struct vs_extrude *x = VS_AS(extrude, n);
  const vs_node *profile = n->children[0].node;
  double radius = vs_profile_circle(profile), k = x->scale - 1, border = 0;
  vs_vec3 along = x->along;
  vs_outline o;
  vs_bounds b;
  *known = n->class_ == VS_SOLID && (x->taper == 0 || radius > 0);
  if (*known && n->child_count > 1 && !measure_straight(n->children[1].node, &along, known, e)) return false;
  if (!*known) return true;
  if (!vs_node_bounds(profile, &b, e) || !measure_outline(profile, m, e)) return false;
  vs_fineness f = { fmax(vs_bounds_diagonal(&b) * 1e-7, 1e-300), 0 };
  if (!vs_region_outline(profile, &f, &o, e)) return false;
  double height = fabs(vs_v3_dot(o.normal, along)), lean = fabs(vs_v3_length(along) - height);
  for (size_t l = 0; l < o.count; l++)
    for (size_t i = 0; i < o.loops[l].count; i++)
      border += vs_v3_length(vs_v3_sub(o.loops[l].at[(i + 1) % o.loops[l].count], o.loops[l].at[i]));
  vs_outline_free(&o);
  double area = radius > 0 ? pi * radius * radius : m->area, inwards = x->taper != 0 ? height * tan(x->taper) : 0;
  vs_vec3 base = x->center && n->child_count == 1 ? vs_v3_sub(m->centroid, vs_v3_scale(along, 0.5)) : m->centroid;
  if (radius > 0) border = 2 * pi * radius;
  if (x->taper != 0) { /* if the walls are inclined (taper), the extrusion of a circle is a truncated cone, possibly
                        * oblique; its volume depends only on the height */
    double top = fmax(radius - inwards, 0), part = inwards > radius ? radius / inwards : 1;
    vs_frustum_measure(m, base, radius, vs_v3_add(base, vs_v3_scale(along, part)), top);
    m->volume = pi * height * part * (radius * radius + radius * top + top * top) / 3;
  } else {
    m->volume = area * height * (1 + k + k * k / 3);
    m->area = border * height + 2 * area;
    m->centroid = vs_v3_add(base, vs_v3_scale(along, (0.5 + 2 * k / 3 + k * k / 4) / (1 + k + k * k / 3)));
  }
  m->area_known = lean <= 1e-12 * height && x->twist == 0 && x->scale == 1;
  return true;
}

/* The path of a sweep. length: its length; closed: true if it is closed; back: true if it turns back at some point. */
typedef struct { double length; bool closed, back; } vs_way;

static bool measure_way(const vs_node *curve, vs_way *way, vs_error *e) {
  vs_measure m;
  vs_bounds b;
  vs_path path = { 0 };
  vs_affine identity = vs_affine_identity();
  *way = (vs_way){ 0 };
  if (!vs_node_measure(curve, &m, e) || !vs_node_bounds(curve, &b, e)) return false;
  vs_fineness f = { vs_fineness_tolerance(&b), 0 };
  bool ok = vs_curve_path(curve, &identity, &f, &path, e);
  way->length = m.length;
  way->closed = path.closed;
  for (size_t i = path.closed ? 0 : 1; ok && i + !path.closed < path.count; i++) {
    way->back = way->back || vs_v3_dot(path.at[i].arriving, path.at[i].leaving) < -0.99;
  }
  vs_path_free(&path);
  return ok;
}

/* vs_sweep_measure uses Pappus's theorem: volume = area of the profile times length of the path, if the profile's
 * centroid is on the path. */
bool vs_sweep_measure(const vs_node *n, vs_measure *m, vs_error *e) {
  bool bar = n->kind == VS_THICKEN;
  const vs_node *profile = n->children[0].node;
  vs_way way;
  *m = (vs_measure){ 0 };
  if (n->class_ != VS_SOLID || (n->kind != VS_SWEEP && !bar) ||
      (bar ? profile->class_ != VS_CURVE : VS_AS(sweep, n)->has_base))
    return true;
  if (!measure_way(bar ? profile : n->children[1].node, &way, e)) return false;
  double twist = bar ? 0 : VS_AS(sweep, n)->twist, scale = bar ? 1 : VS_AS(sweep, n)->scale, border = 0;
  bool upright = !bar && vs_v3_length(VS_AS(sweep, n)->up) > 0; /* true if the profile is kept upright, so that it turns
                                                                 * about the path */
  if (way.back || !(way.length > 0)) return true;
  double radius = bar ? VS_AS(thicken, n)->width / 2 : vs_profile_circle(profile);
  bool even = true;
  if (radius > 0) {
    m->area = pi * radius * radius, border = 2 * pi * radius;
  } else {
    vs_outline o;
    vs_bounds b;
    vs_vec3 middle = { 0, 0, 0 };
    if (!vs_node_bounds(profile, &b, e) || !measure_outline(profile, m, e)) return false;
    vs_fineness f = { fmax(vs_bounds_diagonal(&b) * 1e-7, 1e-300), 0 };
    if (!vs_region_outline(profile, &f, &o, e)) return false;
    for (size_t l = 0; l < o.count; l++)
      for (size_t i = 0; i < o.loops[l].count; i++) {
        vs_vec3 p = o.loops[l].at[i], q = o.loops[l].at[(i + 1) % o.loops[l].count];
        double d = vs_v3_length(vs_v3_sub(q, p));
        middle = vs_v3_add(middle, vs_v3_scale(vs_v3_add(p, q), d / 2));
        border += d;
      }
    vs_outline_free(&o);
    even = border > 0 &&
           vs_v3_length(vs_v3_sub(vs_v3_scale(middle, 1 / border), m->centroid)) <= 1e-9 * vs_bounds_diagonal(&b);
  }
  double ends = way.closed && scale == 1 && (twist == 0 || radius > 0) ? 0 : 2 * m->area;
  m->known = m->area > 0;
  m->area_known = even && twist == 0 && scale == 1 && !upright;
  m->volume = m->area * way.length * (1 + scale + scale * scale) / 3;
  m->area = border * way.length + ends;
  return true;
}

/* ---- the measuring function of each kind ---- */

/* The object to be measured. whole: its node; n: the node inside all placements and wrappers around it. */
typedef struct {
  const vs_node *whole, *n;
  vs_affine placed; /* product of all the placements that were removed from around n */
} measured;

/* A function that measures the node of->n: it sets the members of m. Returns false on failure. */
typedef bool measure_rule(const measured *of, vs_measure *m, vs_error *e);

static bool measure_zero(const measured *of, vs_measure *m, vs_error *e) {
  (void)of, (void)m, (void)e;
  return true;
}

static bool measure_unknown(const measured *of, vs_measure *m, vs_error *e) {
  (void)of, (void)e;
  *m = (vs_measure){ 0 };
  return true;
}

static bool measure_endless(const measured *of, vs_measure *m, vs_error *e) {
  (void)of, (void)m;
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "the object has no end and cannot be measured");
}

/* Converts the measures m from the coordinates of the node of->n to those of the whole object, of->whole. */
static bool measure_place(const measured *of, vs_measure *m) {
  double k;
  m->volume *= fabs(vs_affine_determinant(&of->placed));
  m->area_known = vs_affine_even(&of->placed, &k) && m->area_known;
  m->area *= m->area_known ? k * k : 0;
  m->centroid = vs_affine_point(&of->placed, m->centroid);
  return true;
}

static bool measure_shape(const measured *of, vs_measure *m, vs_error *e) {
  if (!vs_shape_of(of->n)->measure(of->n, vs_affine_even(&of->placed, &(double){ 0 }), m, e)) return false;
  return m->known ? measure_place(of, m) : measure_unknown(of, m, e);
}

static bool measure_curve(const measured *of, vs_measure *m, vs_error *e) {
  vs_affine identity = vs_affine_identity();
  m->area_known = false;
  return measure_samples(of->whole, &identity, m, e);
}

/* Measures an offset of a circle or arc, which is a circle or arc again. The measures are exact if the placement maps
 * circles to circles. Returns false on failure. */
static bool measure_round(const measured *of, const vs_offset_exact *exact, vs_measure *m, vs_error *e) {
  const struct vs_arc *a = &exact->arc;
  double k, angle = fabs(a->end - a->start);
  bool full = angle >= 2 * pi * (1 - 1e-15);
  if (!measure_curve(of, m, e)) return false;
  if (full) m->centroid = vs_affine_point(&of->placed, a->center);
  else if (vs_affine_even(&of->placed, &k)) { /* the centroid of an arc is r sin(a/2) / (a/2) from the centre, in the
                                               * direction of the arc's middle */
    double mean = (a->start + a->end) / 2, away = a->radius * sin(angle / 2) / (angle / 2), sine, cosine;
    vs_sincos(mean, &sine, &cosine);
    m->centroid = vs_affine_point(&of->placed, vs_v3_add(a->center, vs_v3(away * cosine, away * sine, 0)));
  }
  if (vs_affine_even(&of->placed, &k)) m->length = k * angle * a->radius;
  else if (exact->circle) m->length = measure_placed_circle(&of->placed, a->radius);
  return true;
}

static bool measure_arc(const measured *of, vs_measure *m, vs_error *e) {
  return measure_round(of, &(vs_offset_exact){ false, *VS_AS(arc, of->n) }, m, e);
}

static bool measure_circle(const measured *of, vs_measure *m, vs_error *e) {
  const struct vs_circle *c = VS_AS(circle, of->n);
  vs_offset_exact exact = { true, { .center = c->center, .radius = c->radius, .end = 2 * pi } };
  return measure_round(of, &exact, m, e);
}

static bool measure_region(const measured *of, vs_measure *m, vs_error *e) { return measure_outline(of->whole, m, e); }

static bool measure_offset(const measured *of, vs_measure *m, vs_error *e) {
  vs_offset_exact exact;
  vs_affine place;
  if (of->n->class_ == VS_REGION_CLASS) return measure_region(of, m, e);
  if (!vs_offset_round(of->n, &place, &exact)) return measure_curve(of, m, e);
  return measure_round(&(measured){ of->whole, of->n, vs_affine_multiply(&of->placed, &place) }, &exact, m, e);
}

static bool measure_extrude(const measured *of, vs_measure *m, vs_error *e) {
  bool known;
  if (!measure_extrusion(of->n, m, &known, e)) return false;
  return known ? measure_place(of, m) : measure_unknown(of, m, e);
}

static bool measure_revolve(const measured *of, vs_measure *m, vs_error *e) {
  return measure_revolution(of->n, m, e) && measure_place(of, m);
}

static bool measure_hull(const measured *of, vs_measure *m, vs_error *e) {
  return of->n->class_ == VS_REGION_CLASS ? measure_region(of, m, e) : measure_unknown(of, m, e);
}

static bool measure_set(const measured *of, vs_measure *m, vs_error *e) {
  if (of->n->class_ == VS_CURVE) return measure_curves(of->whole, m, e);
  return measure_hull(of, m, e);
}

static measure_rule *const measure_rules[VS_KIND_COUNT] = { /* measure_rules[kind]: function that measures a node of
                                                             * this kind; NULL: the kind is a primitive solid, or there
                                                             * is no formula */
#define VS_RULE(kind, plane, measure) [VS_##kind] = measure_##measure,
#include "geometry/kind_rules.def"
};

bool vs_node_measure(const vs_node *n, vs_measure *m, vs_error *e) {
  measured of = { .whole = n, .n = n, .placed = vs_affine_identity() };
  while (of.n->kind == VS_TRANSFORM || vs_node_is_wrapper(of.n) || (of.n->kind == VS_UNION && of.n->child_count == 1)) {
    if (of.n->kind == VS_TRANSFORM) of.placed = vs_affine_multiply(&of.placed, &VS_AS(transform, of.n)->matrix);
    of.n = of.n->children[0].node;
  }
  *m = (vs_measure){ .known = true, .area_known = true };
  measure_rule *rule = measure_rules[of.n->kind];
  return rule ? rule(&of, m, e) : measure_shape(&of, m, e);
}
